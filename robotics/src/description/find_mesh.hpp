// SPDX-License-Identifier: BSD-3-Clause
// From the mesh name in a URDF to a file.
#pragma once

#include <filesystem>
#include <string>

#include "hinge/robotics/read_urdf.hpp"

namespace hinge::robotics {

/// `folder` is the URDF's. MissingMesh: there is no such file. LoadError: no path. Both say what was looked for and
/// where; without a file name in front.
std::filesystem::path find_mesh(const std::string& name, const std::filesystem::path& folder,
                                const UrdfOptions& options);

}  // namespace hinge::robotics
