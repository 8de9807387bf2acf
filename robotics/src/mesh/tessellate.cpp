// SPDX-License-Identifier: BSD-3-Clause
// Implements tessellate: prisms and subdivided icosahedra, inscribed or circumscribed; points and segments with a
// radius.
#include "hinge/robotics/tessellate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <variant>

#include "description/check_description.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/detail/core/sincos.hpp"

namespace hinge::robotics {

namespace {

using Triangles = std::vector<Triangle>;

constexpr double pi = 3.141592653589793;
// Limit per shape. A tolerance that needs more triangles is a mistake.
constexpr std::size_t most_triangles = 1'000'000;

[[noreturn]] void refuse_tolerance(double tolerance) {
  throw ModelError("tessellation tolerance " + number_text(tolerance) +
                   " m: expected a finite length above 0 that needs at most 10^6 triangles");
}

// Shapes without volume get the fewest triangles: a point or a segment is one triangle without area.
Triangles segment(const Vec3& end) { return {{-end, end, end}}; }

Triangles box(const Vec3& size) {
  const auto flat = std::count(size.data(), size.data() + 3, 0.0);
  if (flat >= 2) return segment(size / 2);
  std::array<Vec3, 8> corner;
  for (std::size_t k = 0; k < 8; ++k)
    for (int axis = 0; axis < 3; ++axis) corner[k][axis] = (k >> axis & 1U) != 0 ? size[axis] / 2 : -size[axis] / 2;
  // Corner k is on the upper side of axis a if bit a of k is set. Faces are oriented outward.
  constexpr std::array<std::array<std::size_t, 4>, 6> faces = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  Triangles triangles;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    // A flat box has one face, normal to its thin axis.
    if (flat == 1 && (k % 2 == 0 || size[static_cast<int>(k / 2)] > 0.0)) continue;
    const auto& f = faces[k];
    triangles.push_back({corner[f[0]], corner[f[1]], corner[f[2]]});
    triangles.push_back({corner[f[0]], corner[f[2]], corner[f[3]]});
  }
  return triangles;
}

/// A prism over the regular polygon with a vertex at angle 0. Caps are fans around their centres.
Triangles prism(double radius, double length, std::size_t sides) {
  const double h = length / 2;
  const auto vertex = [&](std::size_t i) {
    const detail::SinCos sc = detail::sincos(2 * pi * static_cast<double>(i % sides) / static_cast<double>(sides));
    return Vec3(radius * sc.cos, radius * sc.sin, 0.0);
  };
  const Vec3 up(0, 0, h);
  Triangles triangles;
  for (std::size_t i = 0; i < sides; ++i) {
    const Vec3 a = vertex(i), b = vertex(i + 1);
    if (length == 0.0) {  // a disc
      triangles.push_back({up, a, b});
      continue;
    }
    triangles.push_back({a - up, b - up, b + up});
    triangles.push_back({a - up, b + up, a + up});
    triangles.push_back({-up, b - up, a - up});
    triangles.push_back({up, a + up, b + up});
  }
  return triangles;
}

/// The vertices of the circumscribed polygon are radius / cos(pi / sides) from the axis.
Triangles around_cylinder(const CylinderShape& cylinder, double tolerance) {
  for (std::size_t sides = 3; 4 * sides <= most_triangles; ++sides) {
    const double radius = cylinder.radius / detail::sincos(pi / static_cast<double>(sides)).cos;
    if (radius - cylinder.radius <= tolerance) return prism(radius, cylinder.length, sides);
  }
  refuse_tolerance(tolerance);
}

constexpr double golden = 1.618033988749895;  // (1 + sqrt 5) / 2

const std::array<std::array<std::size_t, 3>, 20>& icosahedron_faces() {
  static constexpr std::array<std::array<std::size_t, 3>, 20> faces = {
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  return faces;
}

const std::array<Vec3, 12>& icosahedron_vertices() {
  constexpr double t = golden;
  static const std::array<Vec3, 12> vertices = {Vec3(-1, t, 0), {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                                                {0, -1, t},     {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                                                {t, 0, -1},     {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
  return vertices;
}

/// Divides one face of the icosahedron into parts^2 equal triangles and scales their vertices to the unit sphere.
Triangles unit_face(const std::array<std::size_t, 3>& face, std::size_t parts) {
  const std::array<Vec3, 12>& v = icosahedron_vertices();
  const Vec3 &a = v[face[0]], &b = v[face[1]], &c = v[face[2]];
  const auto n = static_cast<double>(parts);
  const auto vertex = [&](std::size_t i, std::size_t j) {
    // Weighted so that both faces at an edge compute the same bits.
    const Vec3 flat =
        (a * (n - static_cast<double>(i + j)) + b * static_cast<double>(i) + c * static_cast<double>(j)) / n;
    return Vec3(flat / std::sqrt(squared_norm(flat)));
  };
  Triangles triangles;
  for (std::size_t i = 0; i < parts; ++i)
    for (std::size_t j = 0; i + j < parts; ++j) {
      triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
      if (i + j + 1 < parts) triangles.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return triangles;
}

Triangles geodesic(double radius, std::size_t parts) {
  Triangles triangles;
  for (const auto& face : icosahedron_faces())
    for (const Triangle& t : unit_face(face, parts)) triangles.push_back({t.a * radius, t.b * radius, t.c * radius});
  return triangles;
}

/// Returns the distance of the closest face plane of the unit geodesic polyhedron from its centre. All twenty faces are
/// congruent.
double inner_radius(std::size_t parts) {
  double nearest = 1.0;
  for (const Triangle& t : unit_face(icosahedron_faces()[0], parts)) {
    const Vec3 normal = cross(Vec3(t.b - t.a), Vec3(t.c - t.a));
    nearest = std::min(nearest, std::abs(dot(normal, t.a)) / std::sqrt(squared_norm(normal)));
  }
  return nearest;
}

/// Scales the polyhedron so that no face plane cuts the ball. The polyhedron is star-shaped about the centre, so it
/// then encloses the ball. Its vertices are its farthest points.
Triangles around_sphere(double radius, double tolerance) {
  for (std::size_t parts = 1; 20 * parts * parts <= most_triangles; ++parts) {
    const double outer = radius / inner_radius(parts);
    if (outer - radius <= tolerance) return geodesic(outer, parts);
  }
  refuse_tolerance(tolerance);
}

/// Sweeps a convex polyhedron along a segment of the z axis: faces with upward normals move up, the others down, and
/// walls connect them.
Triangles drawn_apart(const Triangles& polyhedron, double length) {
  using Edge = std::array<double, 6>;
  const auto edge = [](const Vec3& a, const Vec3& b) { return Edge{a[0], a[1], a[2], b[0], b[1], b[2]}; };
  const Vec3 up(0, 0, length / 2);
  Triangles triangles;
  std::set<Edge> upper;
  for (const Triangle& t : polyhedron) {
    const bool looks_up = cross(Vec3(t.b - t.a), Vec3(t.c - t.a))[2] >= 0.0;
    const Vec3 move = looks_up ? up : Vec3(-up);
    triangles.push_back({t.a + move, t.b + move, t.c + move});
    if (looks_up) upper.insert({edge(t.a, t.b), edge(t.b, t.c), edge(t.c, t.a)});
  }
  for (const Edge& e : upper) {
    const Vec3 a(e[0], e[1], e[2]), b(e[3], e[4], e[5]);
    if (upper.contains(edge(b, a))) continue;
    triangles.push_back({b + up, a + up, a - up});
    triangles.push_back({b + up, a - up, b - up});
  }
  return triangles;
}

Triangles scaled(const MeshShape& shape) {
  Triangles triangles = shape.mesh->triangles;
  if (shape.scale == Vec3::Ones()) return triangles;
  for (Triangle& t : triangles)
    for (Vec3* vertex : {&t.a, &t.b, &t.c}) *vertex = vertex->cwiseProduct(shape.scale);
  return triangles;
}

constexpr std::size_t inscribed_sides = 32;
constexpr std::size_t inscribed_parts = 4;  // every edge bisected twice: 320 triangles

/// Converts any shape to triangles without radius.
struct InTriangles {
  bool inscribed = false;
  double tolerance = 0.0;

  Triangles operator()(const MeshShape& mesh) const { return scaled(mesh); }
  Triangles operator()(const BoxShape& shape) const { return box(shape.size); }
  Triangles operator()(const CylinderShape& cylinder) const {
    if (cylinder.radius == 0.0) return segment({0, 0, cylinder.length / 2});
    return inscribed ? prism(cylinder.radius, cylinder.length, inscribed_sides) : around_cylinder(cylinder, tolerance);
  }
  Triangles operator()(const SphereShape& sphere) const {
    if (sphere.radius == 0.0) return segment(Vec3::Zero());
    return inscribed ? geodesic(sphere.radius, inscribed_parts) : around_sphere(sphere.radius, tolerance);
  }
  Triangles operator()(const CapsuleShape& capsule) const {
    if (capsule.radius == 0.0) return segment({0, 0, capsule.length / 2});
    const Triangles sphere = (*this)(SphereShape{capsule.radius});
    return capsule.length == 0.0 ? sphere : drawn_apart(sphere, capsule.length);
  }
  Triangles operator()(const PointCloudShape& cloud) const {
    const Triangles sphere = (*this)(SphereShape{cloud.radius});
    if (cloud.points->size() > most_triangles / sphere.size())
      throw ModelError("a point cloud of " + std::to_string(cloud.points->size()) +
                       " points needs more than 10^6 triangles as meshes; use exact spheres, or fewer points");
    Triangles triangles;
    triangles.reserve(cloud.points->size() * sphere.size());
    for (const Vec3& point : *cloud.points)
      for (const Triangle& t : sphere) triangles.push_back({t.a + point, t.b + point, t.c + point});
    return triangles;
  }
};

}  // namespace

Surface tessellate(const Shape& shape, const Tessellation& tessellation) {
  const std::string problem = problem_of(shape);
  if (!problem.empty()) throw ModelError(problem);
  const double tolerance = tessellation.tolerance;
  if (!is_finite(tolerance) || !(tolerance > 0.0)) refuse_tolerance(tolerance);
  if (tessellation.manner == Tessellation::Manner::rounded) {
    if (const auto* sphere = std::get_if<SphereShape>(&shape)) return {{Triangle{}}, sphere->radius};
    if (const auto* capsule = std::get_if<CapsuleShape>(&shape)) {
      const Vec3 end(0, 0, capsule->length / 2);
      return {{{-end, end, end}}, capsule->radius};
    }
    if (const auto* cloud = std::get_if<PointCloudShape>(&shape)) {
      Triangles points;
      points.reserve(cloud->points->size());
      for (const Vec3& point : *cloud->points) points.push_back({point, point, point});
      return {std::move(points), cloud->radius};
    }
  }
  const bool inscribed = tessellation.manner == Tessellation::Manner::inscribed;
  return {std::visit(InTriangles{inscribed, tolerance}, shape), 0.0};
}

std::vector<Triangle> drawn_triangles(const Shape& shape, const Pose& pose) {
  std::vector<Triangle> triangles = tessellate(shape, {Tessellation::Manner::inscribed}).triangles;
  for (Triangle& t : triangles) t = {pose * t.a, pose * t.b, pose * t.c};
  return triangles;
}

}  // namespace hinge::robotics
