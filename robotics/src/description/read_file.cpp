// SPDX-License-Identifier: BSD-3-Clause
// Reading whole files.
#include "description/read_file.hpp"

#include "hinge_tools/input_file.hpp"

namespace hinge::robotics {

std::string read_file(const std::filesystem::path& path) { return tool::read_whole(path); }

}  // namespace hinge::robotics
