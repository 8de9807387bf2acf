// SPDX-License-Identifier: BSD-3-Clause
// check_dae_mesh: checks the primitives of one <mesh> of a COLLADA file, because assimp trusts them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "description/read_xml.hpp"

namespace hinge::robotics {

/// Sources whose accessor has at most four numbers per element. By id: true if it has X, Y and Z.
using DaeSources = std::map<std::string, bool, std::less<>>;

/// Returns the id in source="#id" or url="#id", or "" if there is none.
std::string named_by(const tinyxml2::XMLElement& element, const char* attribute);

/// Throws LoadError, naming the line, for faults that assimp 5.2.5 misreads, drops, or reads out of bounds: indices
/// that are not whole numbers or do not match the count, primitives without vertices, a mesh without exactly one
/// POSITION, and a polylist whose <vcount> does not match the indices. room: size of the file in bytes.
void check_dae_mesh(const XmlFile& file, const tinyxml2::XMLElement& mesh, const DaeSources& sources,
                    std::int64_t room);

}  // namespace hinge::robotics
