// SPDX-License-Identifier: BSD-3-Clause
// Qhull finds the hull, exact predicates prove that it encloses the points. Qhull (5 MB installed, permissive licence)
// was chosen over CGAL (40 MB with Boost, GMP and MPFR; its hulls are under the GPL). Qhull does not guarantee the
// orientation of triangles cut from merged facets, nor a result for flat input. Therefore the points are joggled, so
// that all facets are simplicial and clearly convex, and flat input first gets a thickness.
#include "approximation/convex_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include <libqhull_r/qhull_ra.h>

#include "hinge/core/error.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/detail/exact/orient.hpp"
#include "hinge/detail/primitive/triangle_corners.hpp"

namespace hinge::robotics {

namespace {

using Points = std::vector<Vec3>;
using Triangles = std::vector<Triangle>;

/// m, half the edge of the cube that replaces a point if the hull would be flat. Its corners stay well within
/// most_hull_excess / 2.
constexpr double padding = most_hull_excess / 4;

/// The sign of orient3d(a, b, c, p) if p sees a, b, c clockwise, so p is behind the triangle.
constexpr int behind = 1;

Points each_once(std::span<const Vec3> points) {
  Points sorted(points.begin(), points.end());
  const auto key = [](const Vec3& v) { return std::array{v[0], v[1], v[2]}; };
  std::sort(sorted.begin(), sorted.end(), [&](const Vec3& a, const Vec3& b) { return key(a) < key(b); });
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  return sorted;
}

/// A run of Qhull, freed with the object. Uses the C interface, because the C++ one does not compile as C++20.
class Qhull {
 public:
  static constexpr std::size_t fewest_points = 4;

  Qhull(const Points& points, const char* options) {
    QHULL_LIB_CHECK
    qh_zero(&state_, nullptr);
    for (const Vec3& p : points) coordinates_.insert(coordinates_.end(), {p[0], p[1], p[2]});
    std::FILE* nowhere = std::fopen("/dev/null", "w");
    std::string command = std::string("qhull Pp ") + options;
    done_ = nowhere != nullptr && qh_new_qhull(&state_, 3, static_cast<int>(points.size()), coordinates_.data(), False,
                                               command.data(), nowhere, nowhere) == 0;
    if (nowhere != nullptr) std::fclose(nowhere);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  ~Qhull() {
    int rest = 0, total = 0;
    state_.ferr = nullptr;
    qh_freeqhull(&state_, !qh_ALL);
    qh_memfreeshort(&state_, &rest, &total);
  }

  /// False if Qhull failed, as it does on flat input.
  bool done() const noexcept { return done_; }

  /// Calls f(index of the point) for each vertex of the hull.
  template <class Visitor>
  void each_vertex(const Visitor& f) {
    for (const vertexT* v = state_.vertex_list; v != nullptr && v->next != nullptr; v = v->next)
      f(static_cast<std::size_t>(qh_pointid(&state_, v->point)));
  }

  /// Calls f(corners) for each facet; a simplicial facet has three corners.
  template <class Visitor>
  void each_facet(const Visitor& f) {
    for (const facetT* facet = state_.facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
      Points corners;
      for (int k = 0; k < qh_setsize(&state_, facet->vertices); ++k) {
        const auto* v = static_cast<const vertexT*>(SETelem_(facet->vertices, k));
        corners.emplace_back(v->point[0], v->point[1], v->point[2]);
      }
      f(corners);
    }
  }

 private:
  qhT state_;
  std::vector<double> coordinates_;
  bool done_ = false;
};

/// Returns the vertices of the hull without points inside merged faces and edges; empty if Qhull fails.
Points spanning(const Points& points) {
  Points found;
  if (points.size() < Qhull::fewest_points) return found;
  Qhull qhull(points, "");
  if (qhull.done()) qhull.each_vertex([&](std::size_t k) { found.push_back(points.at(k)); });
  return found;
}

/// Returns the facets of the joggled points, which Qhull moved by about 10^-11 of their extent. Corners in any order.
Triangles joggled_facets(const Points& points) {
  Triangles facets;
  if (points.size() < Qhull::fewest_points) return facets;
  Qhull qhull(points, "QJ");
  if (qhull.done()) qhull.each_facet([&](const Points& c) { facets.push_back({c.at(0), c.at(1), c.at(2)}); });
  return facets;
}

Vec3 centre_of(const Points& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Orients each triangle so that the centre is behind it. Returns false if the centre is in the plane of a triangle.
bool turn_outward(Triangles& triangles, const Vec3& centre) {
  for (Triangle& t : triangles) {
    const int side = detail::exact::orient3d(t.a, t.b, t.c, centre);
    if (side == 0) return false;
    if (side != behind) std::swap(t.b, t.c);
  }
  return true;
}

/// Returns the smallest distance of the centre from the planes of the triangles.
double inner_radius(const Triangles& triangles, const Vec3& centre) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) {
    const Vec3 normal = cross(Vec3(t.b - t.a), Vec3(t.c - t.a));
    least = std::min(least, dot(normal, Vec3(t.a - centre)) / std::sqrt(squared_norm(normal)));
  }
  return least;
}

Triangles grown(const Triangles& triangles, const Vec3& centre, double factor) {
  Triangles larger;
  const auto move = [&](const Vec3& v) { return Vec3(centre + (v - centre) * factor); };
  for (const Triangle& t : triangles) larger.push_back({move(t.a), move(t.b), move(t.c)});
  return larger;
}

/// Returns true if every point is strictly behind every triangle. The height over the plane decides if it exceeds the
/// rounding bound of six products of three differences; otherwise the exact predicate does. extent: largest difference
/// of two coordinates.
bool enclose(const Triangles& triangles, const Points& points, double extent) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    const Vec3 u = t.b - t.a, v = t.c - t.a, normal = cross(u, v);
    const double rounding = 48 * detail::exact::half_ulp * detail::largest(u) * detail::largest(v) * extent;
    return std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
      return dot(normal, Vec3(p - t.a)) < -rounding || detail::exact::orient3d(t.a, t.b, t.c, p) == behind;
    });
  });
}

double largest_distance(const Points& points, const Vec3& centre) {
  double squared = 0.0;
  for (const Vec3& p : points) squared = std::max(squared, squared_norm(Vec3(p - centre)));
  return std::sqrt(squared);
}

/// Returns the hull of `corners`, scaled about its centre until it encloses `points`: by at least `depth` and at most
/// most_hull_excess. Returns nothing if this fails.
Triangles hull_around(const Points& corners, const Points& points, double depth) {
  Triangles facets = joggled_facets(corners);
  const Vec3 centre = centre_of(corners);
  if (facets.empty() || !turn_outward(facets, centre)) return {};
  const double farthest = largest_distance(corners, centre);
  for (double share = depth / inner_radius(facets, centre); share * farthest <= most_hull_excess / 2; share *= 4) {
    Triangles hull = grown(facets, centre, 1.0 + share);
    if (turn_outward(hull, centre) && enclose(hull, points, 4 * farthest)) return hull;
  }
  return {};
}

Points cubes_around(const Points& points) {
  Points corners;
  for (const Vec3& p : points)
    for (unsigned k = 0; k < 8; ++k)
      corners.push_back(p + padding * Vec3((k & 1U) != 0 ? 1 : -1, (k & 2U) != 0 ? 1 : -1, (k & 4U) != 0 ? 1 : -1));
  return corners;
}

}  // namespace

std::vector<Vec3> extreme_points(std::span<const Vec3> points) {
  Points once = each_once(points), extreme = spanning(once);
  return extreme.empty() ? once : extreme;
}

std::vector<Triangle> convex_hull(std::span<const Vec3> points) {
  const Points once = each_once(points);
  const Points corners = spanning(once);
  Triangles hull = hull_around(corners, once, 2 * enclosing_margin);
  if (!hull.empty()) return hull;
  // Flat or nearly flat input. The cubes already enclose the points; scaling only has to undo the joggling.
  const Points padded = spanning(cubes_around(corners.empty() ? once : corners));
  hull = hull_around(padded, once, 0x1p-60);
  if (hull.empty())
    throw ModelError("no convex hull of " + std::to_string(once.size()) +
                     " points was found: their coordinates are too large or too far apart");
  return hull;
}

}  // namespace hinge::robotics
