// SPDX-License-Identifier: BSD-3-Clause
// Divides the surface into patches of about equal size (Gonzalez, "Clustering to minimize the maximum intercluster
// distance", 1985, then centres moved as in Lloyd's algorithm). Around each patch it places the ball that protrudes
// least from the link: its centre is deep inside, its radius larger.
#include "approximation/fit_spheres.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "approximation/convex_hull.hpp"
#include "approximation/enclosing_ball.hpp"

namespace hinge::robotics {

namespace {

using Points = std::vector<Vec3>;

/// Returns the squared length of the longest edge and the edge's index.
std::pair<double, std::size_t> longest_edge(const Triangle& t) {
  const std::array<double, 3> square = {squared_norm(Vec3(t.b - t.a)), squared_norm(Vec3(t.c - t.b)),
                                        squared_norm(Vec3(t.a - t.c))};
  const auto longest = std::max_element(square.begin(), square.end());
  return {*longest, static_cast<std::size_t>(longest - square.begin())};
}

/// Bisects triangles at their longest edges until no edge exceeds a bound. The rounding of midpoints is far below the
/// margin of the spheres.
std::vector<Triangle> cut_up(std::span<const Triangle> triangles, double squared_longest) {
  std::vector<Triangle> left(triangles.begin(), triangles.end()), pieces;
  while (!left.empty()) {
    const Triangle t = left.back();
    left.pop_back();
    const auto [square, edge] = longest_edge(t);
    if (square <= squared_longest) {
      pieces.push_back(t);
      continue;
    }
    const std::array<Vec3, 3> v = {t.a, t.b, t.c};
    const Vec3 &from = v[edge], &to = v[(edge + 1) % 3], &apex = v[(edge + 2) % 3];
    const Vec3 middle = from + (to - from) / 2;
    left.push_back({from, middle, apex});
    left.push_back({middle, to, apex});
  }
  return pieces;
}

/// Returns an edge length (m) that gives dozens of pieces per sphere. The spheres are then about a tenth larger than
/// the best ones.
double piece_size(std::span<const Triangle> triangles, std::size_t most) {
  constexpr double pieces_per_sphere = 60.0;
  double area = 0.0, longest = 0.0;
  for (const Triangle& t : triangles) {
    area += std::sqrt(squared_norm(cross(Vec3(t.b - t.a), Vec3(t.c - t.a)))) / 2;
    longest = std::max(longest, longest_edge(t).first);
  }
  const double pieces = pieces_per_sphere * static_cast<double>(most);
  // Degenerate triangles have length but no area.
  return std::max(std::sqrt(2 * area / pieces), std::sqrt(longest) / pieces_per_sphere);
}

double farthest_squared(const Triangle& t, const Vec3& centre) {
  return std::max(
      {squared_norm(Vec3(t.a - centre)), squared_norm(Vec3(t.b - centre)), squared_norm(Vec3(t.c - centre))});
}

/// The planes of a convex hull, to measure how far a ball protrudes from it.
class Hull {
 public:
  explicit Hull(std::span<const Triangle> triangles) {
    Points corners;
    for (const Triangle& t : triangles) corners.insert(corners.end(), {t.a, t.b, t.c});
    for (const Triangle& t : convex_hull(corners)) {
      const Vec3 normal = cross(Vec3(t.b - t.a), Vec3(t.c - t.a));
      planes_.push_back({normal / std::sqrt(squared_norm(normal)), t.a});
    }
    size_ = enclosing_ball(corners).radius;
  }

  /// Returns the centre whose ball around the points protrudes least from the hull, by subgradient descent. Height over
  /// the planes and radius are convex functions of the centre.
  Vec3 deep_centre(const Points& points) const {
    // Weight of the radius relative to the height: balls should not fill concavities of a link without need.
    constexpr double per_radius = 1.05;
    constexpr int steps = 120;
    constexpr double shrink = 0.94;  // the last step is 10^-3 of the first
    Vec3 centre = enclosing_ball(points).centre, best = centre;
    double least = std::numeric_limits<double>::infinity(), step = size_ / 10;
    for (int k = 0; k < steps; ++k, step *= shrink) {
      const auto [height, up] = highest(centre);
      double squared = 0.0;
      Vec3 away = Vec3::Zero();
      for (const Vec3& p : points) {
        const Vec3 from = centre - p;
        if (squared_norm(from) <= squared) continue;
        squared = squared_norm(from);
        away = from;
      }
      const double radius = std::sqrt(squared), cost = height + per_radius * radius;
      if (cost < least) {
        least = cost;
        best = centre;
      }
      if (radius > 0.0) centre -= step * (up + away * (per_radius / radius));
    }
    return best;
  }

 private:
  struct Plane {
    Vec3 normal, point;
  };

  /// Returns the largest height over a plane, and this plane's normal.
  std::pair<double, Vec3> highest(const Vec3& p) const {
    std::pair<double, Vec3> most{-std::numeric_limits<double>::infinity(), Vec3::Zero()};
    for (const Plane& plane : planes_) {
      const double height = dot(plane.normal, Vec3(p - plane.point));
      if (height > most.first) most = {height, plane.normal};
    }
    return most;
  }

  std::vector<Plane> planes_;
  double size_ = 0.0;
};

/// Pieces of triangles and the centres that they are assigned to.
class Clusters {
 public:
  explicit Clusters(std::vector<Triangle> pieces)
      : pieces_(std::move(pieces)), owner_(pieces_.size()), squared_(pieces_.size()) {}

  void spread(std::size_t most) {
    centres_ = {enclosing_ball(corners_if([](std::size_t) { return true; })).centre};
    assign();
    while (centres_.size() < most) {
      const auto farthest = std::max_element(squared_.begin(), squared_.end());
      const Triangle& t = pieces_[static_cast<std::size_t>(farthest - squared_.begin())];
      const Vec3 middle = (t.a + t.b + t.c) / 3.0;
      // A new centre would not be closer to this piece.
      if (!(farthest_squared(t, middle) < *farthest)) break;
      centres_.push_back(middle);
      offer(centres_.size() - 1);
    }
  }

  /// Moves each centre to the centre of its pieces.
  void settle() {
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      const Points corners = corners_if([&](std::size_t piece) { return owner_[piece] == k; });
      if (!corners.empty()) centres_[k] = enclosing_ball(corners).centre;
    }
    assign();
  }

  double largest_squared() const { return *std::max_element(squared_.begin(), squared_.end()); }

  /// Returns one sphere around each patch.
  std::vector<PlacedShape> spheres(const Hull& hull) const {
    std::vector<PlacedShape> spheres;
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      const Points corners = corners_if([&](std::size_t piece) { return owner_[piece] == k; });
      if (corners.empty()) continue;
      PlacedShape& sphere = spheres.emplace_back();
      sphere.origin.translation = hull.deep_centre(corners);
      double squared = 0.0;
      for (const Vec3& p : corners) squared = std::max(squared, squared_norm(Vec3(p - sphere.origin.translation)));
      sphere.shape = SphereShape{enclosing_radius(squared)};
    }
    return spheres;
  }

 private:
  template <class Wanted>
  Points corners_if(const Wanted& wanted) const {
    Points corners;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      if (wanted(p)) corners.insert(corners.end(), {pieces_[p].a, pieces_[p].b, pieces_[p].c});
    return corners;
  }

  void assign() {
    std::fill(squared_.begin(), squared_.end(), std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < centres_.size(); ++k) offer(k);
  }

  void offer(std::size_t k) {
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const double squared = farthest_squared(pieces_[p], centres_[k]);
      if (!(squared < squared_[p])) continue;
      squared_[p] = squared;
      owner_[p] = k;
    }
  }

  std::vector<Triangle> pieces_;
  std::vector<std::size_t> owner_;  // by piece: index of its centre
  std::vector<double> squared_;     // by piece: squared distance of its farthest corner from its centre, m^2
  Points centres_;
};

}  // namespace

std::vector<PlacedShape> fit_spheres(std::span<const Triangle> triangles, std::size_t most) {
  constexpr int rounds = 5;  // later rounds change the radii by about a percent
  const double size = piece_size(triangles, most);
  Clusters clusters(cut_up(triangles, 4 * size * size));
  clusters.spread(most);
  Clusters best = clusters;
  for (int k = 0; k < rounds; ++k) {
    clusters.settle();
    if (clusters.largest_squared() < best.largest_squared()) best = clusters;
  }
  return best.spheres(Hull(triangles));
}

}  // namespace hinge::robotics
