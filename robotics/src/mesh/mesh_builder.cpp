// SPDX-License-Identifier: BSD-3-Clause
// Implements MeshBuilder.
#include "mesh/mesh_builder.hpp"

#include "description/missing_mesh.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "mesh/cut_polygon.hpp"

namespace hinge::robotics {

std::string quoted(std::string_view word) {
  constexpr std::size_t most = 40;
  return std::string("'").append(word.substr(0, most)).append(word.size() > most ? "...'" : "'");
}

void MeshBuilder::add_polygon(std::span<const Vec3> corners, std::size_t line) {
  const std::size_t face = faces_++;
  if (corners.size() < 3) return leave_out(1);
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (const Vec3& x = corners[k]; !is_finite(x))
      refuse(line, "face " + std::to_string(face) + " (from 0): vertex " + std::to_string(k) + " is " +
                       number_text(x[0]) + " " + number_text(x[1]) + " " + number_text(x[2]) +
                       ", expected finite coordinates");
  if (corners.size() == 3) {
    mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  const std::vector<Triangle> triangles = cut_polygon(corners);
  mesh_.triangles.insert(mesh_.triangles.end(), triangles.begin(), triangles.end());
}

void MeshBuilder::refuse(std::size_t line, const std::string& what) const {
  throw LoadError(path_ + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what);
}

TriangleMesh MeshBuilder::finish(std::vector<std::string>* notes) {
  const std::string left_out = std::to_string(left_out_) + " lines or points";
  if (mesh_.triangles.empty())
    throw MissingMesh(path_ + ": has no triangles" + (left_out_ > 0 ? ", only " + left_out : std::string()));
  if (left_out_ > 0) note(left_out + " are left out, because they have no surface");
  if (notes != nullptr) notes->insert(notes->end(), notes_.begin(), notes_.end());
  return std::move(mesh_);
}

}  // namespace hinge::robotics
