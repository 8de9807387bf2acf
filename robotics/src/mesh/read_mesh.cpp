// SPDX-License-Identifier: BSD-3-Clause
// Implements read_mesh: selects the reader by the extension of the file.
#include "hinge/robotics/read_mesh.hpp"

#include <algorithm>
#include <cctype>

#include "description/missing_mesh.hpp"
#include "description/read_file.hpp"
#include "mesh/formats.hpp"

namespace hinge::robotics {

TriangleMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>* notes) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".stl" && extension != ".obj" && extension != ".dae" && extension != ".ply")
    throw MissingMesh(path.string() + ": the mesh format is '" + extension + "', expected .stl, .obj, .dae or .ply");
  std::string bytes = read_file(path);
  MeshBuilder mesh(path.string());
  if (bytes.empty()) return mesh.finish(notes);  // throws: no triangles
  if (extension == ".stl") read_stl(bytes, mesh);
  if (extension == ".obj") read_obj(bytes, mesh);
  if (extension == ".ply") read_ply(bytes, mesh);
  if (extension == ".dae") read_dae(path, std::move(bytes), mesh);
  return mesh.finish(notes);
}

}  // namespace hinge::robotics
