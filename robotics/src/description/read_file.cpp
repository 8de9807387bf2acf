// SPDX-License-Identifier: BSD-3-Clause
// Implements read_file.
#include "description/read_file.hpp"

#include "hinge_tools/input_file.hpp"

namespace hinge::robotics {

std::string read_file(const std::filesystem::path& path) { return tool::read_whole(path); }

}  // namespace hinge::robotics
