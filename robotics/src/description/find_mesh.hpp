// SPDX-License-Identifier: BSD-3-Clause
// find_mesh: resolves the mesh name in a URDF file to a path.
#pragma once

#include <filesystem>
#include <string>

#include "hinge/robotics/read_urdf.hpp"

namespace hinge::robotics {

/// Returns the path of an existing file. folder: that of the URDF file. Throws MissingMesh if there is no such file,
/// LoadError if the name is not a path. The messages say what was searched and where; they do not name the URDF file.
std::filesystem::path find_mesh(const std::string& name, const std::filesystem::path& folder,
                                const UrdfOptions& options);

}  // namespace hinge::robotics
