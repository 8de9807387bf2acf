// SPDX-License-Identifier: BSD-3-Clause
// read_stl, read_obj, read_ply, read_dae: one reader for each format of meshes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/mesh_builder.hpp"

namespace hinge::robotics {

// Each reader adds the surfaces of a file to a mesh, in the order of the file. Numbers in text become the nearest
// double. All throw LoadError, with the line in text, if anything that belongs to a surface is missing or damaged.

/// Binary files have 84 + 50 n bytes, whatever their first word is. Text files may hold several solids.
void read_stl(std::string_view bytes, MeshBuilder& mesh);

/// Reads v, f and fo; counts l and p. Names, materials, normals and texture coordinates are skipped, unknown statements
/// with a note: FCL's files begin with a number. Free-form surfaces are refused.
void read_obj(std::string_view bytes, MeshBuilder& mesh);

/// Reads the elements vertex and face of text and binary files; counts edges; refuses tristrips; skips others.
void read_ply(std::string_view bytes, MeshBuilder& mesh);

/// Reads what the scene of a COLLADA file shows: positions with the transforms of nodes and <unit>, without <up_axis>.
/// Shapes that are not read (controllers, polygons with holes, <brep>, other files) are refused.
void read_dae(const std::filesystem::path& path, std::string bytes, MeshBuilder& mesh);

}  // namespace hinge::robotics
