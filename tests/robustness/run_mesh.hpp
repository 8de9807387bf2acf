// SPDX-License-Identifier: BSD-3-Clause
// Runs two placed meshes in two ways: as links of one model with given poses, and as two models with fixed joints.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "robustness/run_tri.hpp"

namespace hinge::robustness {

/// Throws ModelError: incomplete vertices or triangles, or an unknown vertex.
inline std::vector<Triangle> triangles_in(const Mesh& mesh) {
  if (mesh.v.size() % 3 != 0) throw ModelError("vertices: " + std::to_string(mesh.v.size()) + " numbers, expected 3n");
  if (mesh.f.size() % 3 != 0) throw ModelError("faces: " + std::to_string(mesh.f.size()) + " indices, expected 3n");
  const std::size_t vertices = mesh.v.size() / 3;
  std::vector<Triangle> triangles;
  for (std::size_t k = 0; k < mesh.f.size(); k += 3) {
    std::array<Vec3, 3> corner;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int64_t vertex = mesh.f[k + c];
      if (vertex < 0 || vertex >= static_cast<std::int64_t>(vertices))
        throw ModelError("face " + std::to_string(k / 3) + ": vertex " + std::to_string(vertex) + ", expected below " +
                         std::to_string(vertices));
      const double* x = mesh.v.data() + 3 * static_cast<std::size_t>(vertex);
      corner[c] = {x[0], x[1], x[2]};
    }
    triangles.push_back({corner[0], corner[1], corner[2]});
  }
  return triangles;
}

inline Pose pose_of(const std::vector<double>& m, const char* who) {
  if (m.size() != 12)
    throw ModelError("placement of " + std::string(who) + ": " + std::to_string(m.size()) + " numbers, expected 3 x 4");
  Pose pose;
  for (int row = 0; row < 3; ++row) {
    const double* entries = m.data() + std::ptrdiff_t{4} * row;
    for (int column = 0; column < 3; ++column) pose.rotation(row, column) = entries[column];
    pose.translation[row] = entries[3];
  }
  return pose;
}

template <template <class, class, class> class EngineOf>
std::vector<Answer> run_mesh(const MeshPair& pair) {
  return {asked("two links",
                [&] {
                  ModelBuilder<Triangle> builder;
                  builder.add_link(world, Prismatic{}, triangles_in(pair.a));
                  builder.add_link(world, Prismatic{}, triangles_in(pair.b));
                  auto both = triangles_of<EngineOf>(builder);
                  both.update_poses(std::array{Pose{}, pose_of(pair.place_a, "a"), pose_of(pair.place_b, "b")});
                  return self_answer(both);
                }),
          asked("two models", [&] {
            ModelBuilder<Triangle> builder;
            builder.add_link(world, Fixed{pose_of(pair.place_a, "a")}, triangles_in(pair.a));
            auto a = triangles_of<EngineOf>(builder);
            builder.add_link(world, Fixed{pose_of(pair.place_b, "b")}, triangles_in(pair.b));
            auto b = triangles_of<EngineOf>(builder);
            return mutual_answer(a, b);
          })};
}

}  // namespace hinge::robustness
