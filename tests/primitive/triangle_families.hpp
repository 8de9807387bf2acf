// SPDX-License-Identifier: BSD-3-Clause
// Random pairs of triangles by family; families stress rounding, degeneracy and size.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::test {

using TrianglePairSample = std::pair<Triangle, Triangle>;

struct TriangleFamily {
  std::string name;
  TrianglePairSample (*make)(Random&);
};

inline Vec3 unit_vector(Random& r) { return r.vector(1.0); }
inline Triangle any_triangle(Random& r) { return {unit_vector(r), unit_vector(r), unit_vector(r)}; }

inline TrianglePairSample scaled(const TrianglePairSample& s, double f) {
  const auto times = [f](const Triangle& t) { return Triangle{t.a * f, t.b * f, t.c * f}; };
  return {times(s.first), times(s.second)};
}

inline TrianglePairSample moved(const TrianglePairSample& s, const Vec3& by) {
  const auto plus = [&by](const Triangle& t) { return Triangle{t.a + by, t.b + by, t.c + by}; };
  return {plus(s.first), plus(s.second)};
}

/// Moves some coordinates by a few ulps.
inline Vec3 nudged(Random& r, Vec3 p) {
  for (int k = 0; k < 3; ++k)
    for (std::size_t n = r.one_in(2) ? r.below(4) : 0; n-- > 0;) p[k] = std::nextafter(p[k], r.one_in(2) ? 4.0 : -4.0);
  return p;
}

inline Vec3 inside(Random& r, const Triangle& t) {
  const double u = r.uniform(0.0, 1.0), v = r.uniform(0.0, 1.0 - u);
  return t.a + u * (t.b - t.a) + v * (t.c - t.a);
}

inline Vec3 along(Random& r, const Vec3& a, const Vec3& b) { return a + r.uniform(0.0, 1.0) * (b - a); }

inline Vec3 normal_of(const Triangle& t) { return Vec3(cross(Vec3(t.b - t.a), Vec3(t.c - t.a)).normalized()); }

/// A triangle with a corner at `at` and its other corners on the side of t to which n points.
inline Triangle standing(Random& r, const Triangle& t, const Vec3& at, const Vec3& n) {
  const auto above = [&] {
    return Vec3(at + n * r.uniform(0.1, 1.0) + Vec3(t.b - t.a) * r.uniform(-1.0, 1.0) +
                Vec3(t.c - t.a) * r.uniform(-1.0, 1.0));
  };
  const Vec3 first = above(), second = above();
  return {at, first, second};
}

inline TrianglePairSample generic(Random& r) {
  const Triangle t = any_triangle(r);
  return {t, any_triangle(r)};
}

/// A corner that touches the other triangle up to rounding.
inline TrianglePairSample vertex_face(Random& r) {
  const Triangle t = any_triangle(r);
  const Vec3 at = nudged(r, inside(r, t));
  return {t, standing(r, t, at, normal_of(t))};
}

/// Two edges that cross up to rounding, with the triangles on opposite sides.
inline TrianglePairSample edge_edge(Random& r) {
  const Vec3 at = unit_vector(r), u = unit_vector(r), v = unit_vector(r), n = Vec3(cross(u, v).normalized());
  const double s = r.uniform(0.1, 1.0), t = r.uniform(0.1, 1.0);
  const Triangle p{nudged(r, at - s * u), at + u, at - n * r.uniform(0.1, 1.0) + 0.3 * u};
  return {p, Triangle{nudged(r, at - t * v), at + v, at + n * r.uniform(0.1, 1.0) - 0.2 * v}};
}

inline Vec3 whole_vector(Random& r, std::size_t below) {
  const auto one = [&] { return static_cast<double>(r.below(below)); };
  const double x = one(), y = one(), z = one();
  return {x, y, z};
}

/// Corners with small integer coordinates.
inline TrianglePairSample lattice(Random& r) {
  const auto t = [&] {
    const Vec3 a = whole_vector(r, 5), b = whole_vector(r, 5);
    return Triangle{a, b, whole_vector(r, 5)};
  };
  const Triangle p = t();
  return {p, t()};
}

/// Corners are exact multiples of u and v, so both triangles are exactly in one plane.
inline TrianglePairSample coplanar(Random& r, const Vec3& u, const Vec3& v) {
  const auto point = [&] {
    return Vec3(u * (static_cast<double>(r.below(64)) / 8) + v * (static_cast<double>(r.below(64)) / 8));
  };
  std::array<Vec3, 6> p;
  for (Vec3& x : p) x = point();
  return {{p[0], p[1], p[2]}, {p[3], p[4], p[5]}};
}

/// A triangle whose third corner is about 1e-16 to 0.1 from the edge of the others.
inline Triangle sliver_of(Random& r) {
  const Vec3 a = unit_vector(r), b = unit_vector(r);
  return {a, b, Vec3(along(r, a, b) + unit_vector(r) * std::pow(10.0, r.uniform(-16.0, -1.0)))};
}

inline TrianglePairSample sliver(Random& r) {
  const Triangle p = sliver_of(r);
  if (r.one_in(3)) return {p, sliver_of(r)};
  const Vec3 at = nudged(r, r.one_in(2) ? along(r, p.a, p.b) : inside(r, p)), b = unit_vector(r);
  return {p, Triangle{at, b, Vec3(along(r, at, b) + unit_vector(r) * std::pow(10.0, r.uniform(-16.0, -1.0)))}};
}

/// Triangles that are segments or points, often touching.
inline TrianglePairSample zero_area(Random& r) {
  const auto flat = [&](const Triangle& t) {
    if (r.one_in(3)) return Triangle{t.a, t.a, t.a};
    if (r.one_in(2)) return Triangle{t.a, t.a * 0.5 + t.b * 0.5, t.b};  // exact for the even coordinates below
    return Triangle{t.a, t.b, t.a};
  };
  auto [p, q] = r.one_in(2) ? scaled(lattice(r), 2.0) : generic(r);
  if (r.one_in(3)) p.a = q.a;
  if (r.one_in(3)) p.a = q.a * 0.5 + q.b * 0.5;
  return {flat(p), r.one_in(2) ? flat(q) : q};
}

inline TrianglePairSample third_of_each(Random& r) {
  const std::size_t k = r.below(3);
  return k == 0 ? generic(r) : k == 1 ? vertex_face(r) : edge_edge(r);
}

inline TrianglePairSample near_parallel_planes(Random& r) {
  const Triangle p = any_triangle(r);
  const Vec3 n = normal_of(p);
  const auto near = [&] {
    return Vec3(p.a + r.uniform(-1.0, 2.0) * (p.b - p.a) + r.uniform(-1.0, 2.0) * (p.c - p.a) +
                n * (r.one_in(2) ? r.uniform(-1e-15, 1e-15) : r.uniform(-1e-9, 1e-9)));
  };
  const Vec3 a = near(), b = near();
  return {p, {a, b, near()}};
}

inline TrianglePairSample near_parallel_edges(Random& r) {
  const Vec3 a = unit_vector(r), u = unit_vector(r), gap = unit_vector(r) * std::pow(10.0, r.uniform(-12.0, -1.0));
  const Vec3 turn = unit_vector(r) * std::pow(10.0, r.uniform(-15.0, -1.0));
  const Vec3 start = a + u * r.uniform(-0.5, 0.5);
  const Vec3 side = Vec3(gap.normalized());
  return {{a, a + u, Vec3(a - side + 0.5 * u)}, {start + gap, start + gap + u + turn, Vec3(start + side + 0.3 * u)}};
}

/// Triangles of sizes that differ by a factor of 1 to 1e9, with a shared origin.
inline TrianglePairSample mixed_scale(Random& r) {
  auto [p, q] = third_of_each(r);
  const double f = std::pow(10.0, r.uniform(0.0, 9.0));
  const Vec3 at = q.a;
  return {Triangle{Vec3((p.a - at) * f), Vec3((p.b - at) * f), Vec3((p.c - at) * f)},
          Triangle{Vec3::Zero(), Vec3(q.b - at), Vec3(q.c - at)}};
}

/// Bisects a translation until two adjacent positions differ in touching by the double distance, and returns one of
/// them. The oracle has the exact verdict.
inline TrianglePairSample bisected(Random& r) {
  const Triangle p = any_triangle(r), q = any_triangle(r);
  const Vec3 way = unit_vector(r) * 4.0;
  double low = 0.0, high = 1.0;
  const auto shifted = [&](double s) { return Triangle{q.a + s * way, q.b + s * way, q.c + s * way}; };
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (squared_distance(p, shifted(middle)) < 1e-32 ? low : high) = middle;
  }
  return {p, shifted(r.one_in(2) ? low : high)};
}

/// Coordinates of any size that a double can have.
inline TrianglePairSample any_doubles(Random& r) {
  const int low = r.one_in(2) ? -1073 : -300;
  const auto one = [&] {
    const int exponent = low + static_cast<int>(r.below(static_cast<std::size_t>(1020 - low)));
    return r.one_in(4) ? 0.0 : std::ldexp(r.uniform(-1.0, 1.0), exponent);
  };
  std::array<Vec3, 6> p;
  for (Vec3& x : p)
    for (int k = 0; k < 3; ++k) x[k] = one();
  if (r.one_in(3)) p[3] = p[0];
  if (r.one_in(3)) p[4] = p[1] * 0.5 + p[2] * 0.5;
  return {{p[0], p[1], p[2]}, {p[3], p[4], p[5]}};
}

/// Scales by a power of two, which is exact except for denormal results.
inline TrianglePairSample of_size(Random& r, int exponent) {
  return scaled(r.one_in(4) ? lattice(r) : third_of_each(r), std::ldexp(1.0, exponent));
}

inline const std::vector<TriangleFamily>& triangle_families() {
  static const std::vector<TriangleFamily> all = {
      {"generic", generic},
      {"vertex_face", vertex_face},
      {"edge_edge", edge_edge},
      {"shared_vertex",
       [](Random& r) {
         auto s = generic(r);
         s.second.b = s.first.c;
         return s;
       }},
      {"shared_edge",
       [](Random& r) {
         auto s = generic(r);
         s.second.b = s.first.c;
         s.second.a = s.first.a;
         return s;
       }},
      {"coplanar_axis", [](Random& r) { return coplanar(r, Vec3(1, 0, 0), Vec3(0, 0, 1)); }},
      {"coplanar_tilted", [](Random& r) { return coplanar(r, Vec3(1, 2, -1), Vec3(3, -1, 2)); }},
      {"lattice", lattice},
      {"sliver", sliver},
      {"zero_area", zero_area},
      {"offset_1e6", [](Random& r) { return moved(third_of_each(r), unit_vector(r) * 1e6); }},
      {"offset_1e9", [](Random& r) { return moved(third_of_each(r), unit_vector(r) * 1e9); }},
      {"tiny_1e_9", [](Random& r) { return scaled(third_of_each(r), 1e-9); }},
      {"submillimetre", [](Random& r) { return scaled(third_of_each(r), 1e-4); }},
      {"mixed_scale", mixed_scale},
      {"near_parallel_planes", near_parallel_planes},
      {"near_parallel_edges", near_parallel_edges},
      {"huge_2_300", [](Random& r) { return of_size(r, 300); }},
      {"tiny_2_minus_300", [](Random& r) { return of_size(r, -300); }},
      {"tiny_1e_160", [](Random& r) { return scaled(third_of_each(r), 1e-160); }},
      {"huge_2_500", [](Random& r) { return of_size(r, 500); }},
      {"denormal", [](Random& r) { return of_size(r, -1060); }},
      {"window_low", [](Random& r) { return of_size(r, -149 - static_cast<int>(r.below(4))); }},
      {"window_high", [](Random& r) { return of_size(r, 145 + static_cast<int>(r.below(6))); }},
      {"bisected", bisected},
      {"identical_or_turned",
       [](Random& r) {
         const Triangle t = any_triangle(r);
         return TrianglePairSample{t, {t.b, t.c, t.a}};
       }},
      {"any_doubles", any_doubles}};
  return all;
}

}  // namespace hinge::test
