// SPDX-License-Identifier: BSD-3-Clause
// check_dae_mesh: the primitives of one <mesh> of a COLLADA file, before a reader that trusts them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "description/read_xml.hpp"

namespace hinge::robotics {

/// The sources with an accessor to numbers, four at most for each element: by id, whether it has X, Y and Z.
using DaeSources = std::map<std::string, bool, std::less<>>;

/// The id in source="#id" or url="#id"; "" where there is none.
std::string named_by(const tinyxml2::XMLElement& element, const char* attribute);

/// LoadError, naming the line, for what assimp 5.2.5 reads wrongly, drops, or takes from beyond its arrays: indices
/// that are no whole numbers, or none for a count; primitives without their vertices; a mesh with more or less than one
/// position for a vertex; a polylist whose polygons do not have the indices. `room` is the size of the file.
void check_dae_mesh(const XmlFile& file, const tinyxml2::XMLElement& mesh, const DaeSources& sources,
                    std::int64_t room);

}  // namespace hinge::robotics
