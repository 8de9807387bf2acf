// SPDX-License-Identifier: BSD-3-Clause
// Reading whole files.
#include "read_file.hpp"

#include "hinge/tool/input_file.hpp"

namespace hinge::robotics {

std::string read_file(const std::filesystem::path& path) { return tool::read_whole(path); }

}  // namespace hinge::robotics
