// SPDX-License-Identifier: BSD-3-Clause
// Random pairs of small placed meshes by family, and invalid pairs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "robustness/case.hpp"
#include "robustness/family.hpp"

namespace hinge::test {

using robustness::Mesh;
using robustness::MeshPair;

using MeshFamily = Family<MeshPair>;

/// Returns a pose as 3 x 4 numbers, row-major.
inline std::vector<double> placement(const Pose& pose) {
  std::vector<double> m;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) m.push_back(pose.rotation(row, column));
    m.push_back(pose.translation[row]);
  }
  return m;
}

/// Returns a translation as 3 x 4 numbers, row-major.
inline std::vector<double> shifted(double x, double y, double z) {
  Pose pose;
  pose.translation = {x, y, z};
  return placement(pose);
}

/// Returns a box with half edge `half`; only the first `faces` of its faces (-x, +x and so on), two triangles each.
inline Mesh box(double half, std::size_t faces = 6) {
  Mesh mesh;
  for (std::size_t k = 0; k < 8; ++k)
    for (const std::size_t bit : {1U, 2U, 4U}) mesh.v.push_back((k & bit) != 0 ? half : -half);
  const std::vector<std::int64_t> f{0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3, 0, 4, 5, 0, 5, 1,
                                    2, 3, 7, 2, 7, 6, 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5};
  mesh.f.assign(f.begin(), f.begin() + static_cast<std::ptrdiff_t>(6 * faces));
  return mesh;
}

/// Returns an octahedron with corners at distance `size` on the axes: all eight triangles, or the four at the corner
/// -x.
inline Mesh octahedron(double size, bool half) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      for (int k = 0; k < 3; ++k) mesh.v.push_back(k == axis ? sign * size : 0.0);
  for (const std::int64_t x : {1, 0})
    for (const std::int64_t y : {2, 3})
      for (const std::int64_t z : {4, 5}) mesh.f.insert(mesh.f.end(), {x, y, z});
  if (half) mesh.f.resize(12);
  return mesh;
}

/// Returns separate random triangles.
inline Mesh soup(Random& r, std::size_t triangles, double size) {
  Mesh mesh;
  for (std::size_t k = 0; k < triangles; ++k) {
    const Vec3 at = r.vector(1.0);
    for (std::int64_t corner = 0; corner < 3; ++corner) {
      const Vec3 v = at + r.vector(size);
      mesh.v.insert(mesh.v.end(), v.data(), v.data() + 3);
      mesh.f.push_back(3 * static_cast<std::int64_t>(k) + corner);
    }
  }
  return mesh;
}

/// Returns 0 or a gap of either sign between 2^-43 and 2^-4.
inline double small_gap(Random& r) {
  const double gap = std::ldexp(1.0, -static_cast<int>(4 + r.below(40)));
  return r.one_in(3) ? 0.0 : r.one_in(2) ? gap : -gap;
}

/// Returns two boxes side by side, reduced to their x faces.
inline MeshPair facing(Random& r, double at, double gap) {
  return {box(1.0, 2), box(1.0, r.one_in(8) ? 6 : 2), shifted(at, r.one_in(2) ? -at : 0.0, 0.0),
          shifted(at + 2.0 + gap, r.one_in(2) ? -at : r.uniform(-2.0, 2.0), 0.25)};
}

inline MeshPair box_face_gap(Random& r) {
  const double at = r.one_in(2) ? 0.0 : std::ldexp(1.0, static_cast<int>(r.below(20)));
  return facing(r, at, small_gap(r));
}

inline MeshPair box_gap_far_offset(Random& r) {
  return facing(r, std::floor(std::pow(10.0, r.uniform(6.0, 9.0))), r.one_in(2) ? 0x1p-10 : -0x1p-10);
}

/// Returns an octahedron whose corner at -x is outside, on or inside the +x face of a large box.
inline MeshPair tiny_octahedron(Random& r) {
  const double size = std::ldexp(1.0, -static_cast<int>(10 + r.below(24)));
  const double gap =
      r.one_in(3) ? 0.0 : (r.one_in(2) ? 1.0 : -1.0) * size * std::ldexp(1.0, -static_cast<int>(r.below(8)));
  return {box(1.0, 2), octahedron(size, r.one_in(2)), shifted(0, 0, 0),
          shifted(1.0 + size + gap, size * r.uniform(-4.0, 4.0), r.uniform(-0.9, 0.9))};
}

inline MeshPair octahedra_tip_to_tip(Random& r) {
  const double at = r.one_in(2) ? 0.0 : r.uniform(-100.0, 100.0);
  Mesh left = octahedron(1.0, true);
  for (double& x : left.v) x = -x;
  return {left, octahedron(1.0, true), shifted(at, 0, 0), shifted(at + 2.0 + small_gap(r), 0, 0)};
}

inline Mesh needle(double width) {
  return {{-1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, width, 0.0, 0.0, 0.0, width}, {0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3}};
}

/// Returns two long, thin needles that cross at a small distance.
inline MeshPair needles(Random& r) {
  Pose pose;
  pose.rotation = rotation_about(Vec3::UnitZ(), r.uniform(-3.0, 3.0));
  pose.translation = {r.uniform(-0.1, 0.1), 0.02, -std::pow(10.0, r.uniform(-9.0, -4.0))};
  return {needle(std::pow(10.0, r.uniform(-14.0, -3.0))), needle(std::pow(10.0, r.uniform(-9.0, -3.0))),
          shifted(0, 0, 0), placement(pose)};
}

/// Returns one mesh inside the other, which is no contact of surfaces, or the same mesh twice.
inline MeshPair nested_or_equal(Random& r) {
  const Mesh outer = box(1.0, 2);
  if (r.one_in(4)) return {outer, outer, shifted(0.5, 1, 2), shifted(0.5, 1, 2)};
  return {outer, octahedron(r.uniform(0.1, 0.9), true), shifted(0, 0, 0),
          placement({r.pose(0.1).rotation, Vec3::Zero()})};
}

inline MeshPair random_soup_rotated(Random& r) {
  return {soup(r, 4, 0.5), soup(r, 4, 0.5), placement(r.pose(0.5)), placement(r.pose(1.5))};
}

inline Mesh repeated(Mesh mesh, std::size_t times) {
  const auto once = mesh.f;
  while (--times > 0) mesh.f.insert(mesh.f.end(), once.begin(), once.end());
  return mesh;
}

inline MeshPair duplicated_triangles(Random& r) {
  return {repeated(box(1.0, 2), 2 + r.below(3)), soup(r, 2, 1.0), shifted(0, 0, 0), placement(r.pose(2.0))};
}

/// Returns triangles that include segments and points.
inline MeshPair zero_area_triangles(Random& r) {
  Mesh flat = soup(r, 3, 1.0);
  flat.f[1] = flat.f[0];
  if (r.one_in(2)) flat.f[2] = flat.f[0];
  for (std::size_t k = 18; k < 21; ++k) flat.v[k + 6] = flat.v[k];
  return {flat, r.one_in(2) ? flat : box(0.5, 2), placement(r.pose(0.5)), shifted(0, 0, 0)};
}

inline MeshPair one_empty(Random& r) {
  MeshPair pair{soup(r, 2, 1.0), soup(r, 2, 1.0), shifted(0, 0, 0), shifted(1, 0, 0)};
  const std::size_t which = r.below(3);
  if (which != 0) pair.a = {};
  if (which != 1) pair.b.f.clear();
  return pair;
}

inline MeshPair meshes_to_refuse(Random& r) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  Pose pose = r.pose(3.0);
  MeshPair pair{box(1.0, 2), box(1.0, 2), placement(pose), shifted(0, 0, 0)};
  if (r.one_in(2)) std::swap(pair.place_a, pair.place_b);
  auto& place = r.one_in(2) ? pair.place_a : pair.place_b;
  Mesh& mesh = r.one_in(2) ? pair.a : pair.b;
  const auto each = [&](auto change) {
    for (std::size_t k = 0; k < 12; ++k)
      if (k % 4 != 3) place[k] = change(place[k], k);
  };
  switch (r.below(9)) {
    case 0: mesh.v[r.below(24)] = nan; break;
    case 1: mesh.v[r.below(24)] = r.one_in(2) ? infinity : -infinity; break;
    case 2: mesh.f[r.below(12)] = r.one_in(2) ? 8 : -1; break;
    case 3: place[3 + 4 * r.below(3)] = r.one_in(2) ? nan : infinity; break;
    case 4: place[4 * r.below(3) + r.below(3)] = r.one_in(2) ? nan : -infinity; break;
    case 5: each([](double x, std::size_t) { return x * 1.001; }); break;
    case 6:  // sheared along z
      for (std::size_t k = 0; k < 12; k += 4) place[k + 1] += 0.01 * place[k];
      break;
    case 7: each([](double x, std::size_t k) { return k % 4 == 2 ? -x : x; }); break;  // mirrored
    default: each([](double, std::size_t) { return 0.0; }); break;
  }
  // A vertex without a triangle is no primitive and no error, so each such vertex gets a triangle.
  for (std::int64_t k = 0; k < 8; ++k)
    if (std::find(mesh.f.begin(), mesh.f.end(), k) == mesh.f.end()) mesh.f.insert(mesh.f.end(), {k, k, k});
  return pair;
}

inline const std::vector<MeshFamily>& mesh_families() {
  static const std::vector<MeshFamily> all{{"box_face_gap", box_face_gap},
                                           {"box_gap_far_offset", box_gap_far_offset},
                                           {"tiny_octa_vertex_face", tiny_octahedron},
                                           {"octa_vertex_touch", octahedra_tip_to_tip},
                                           {"needles", needles},
                                           {"nested_or_equal", nested_or_equal},
                                           {"random_soup_rotated", random_soup_rotated},
                                           {"duplicated_triangles", duplicated_triangles},
                                           {"zero_area_triangles", zero_area_triangles},
                                           {"empty", one_empty},
                                           {"must_refuse", meshes_to_refuse, true}};
  return all;
}

}  // namespace hinge::test
