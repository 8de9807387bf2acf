// SPDX-License-Identifier: BSD-3-Clause
// Pattern search over the direction of the axis. For each direction the axis is that of the smallest cylinder.
#include "approximation/fit_capsule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "approximation/convex_hull.hpp"
#include "approximation/enclosing_ball.hpp"

namespace hinge::robotics {

namespace {

using Points = std::vector<Vec3>;

Vec3 unit(const Vec3& v) { return v / std::sqrt(squared_norm(v)); }

struct SegmentFrame {
  Vec3 x, y, z;  // orthonormal, right-handed
};

SegmentFrame frame_along(const Vec3& direction) {
  const Vec3 z = unit(direction);
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(z[k]) < std::abs(z[least])) least = k;
  const Vec3 x = unit(cross(z, Vec3(Vec3::Unit(least))));
  return {x, cross(z, x), z};
}

struct Capsule {
  SegmentFrame frame;
  Vec3 centre = Vec3::Zero();
  double half_length = 0.0;
  double radius = 0.0;
  double volume = std::numeric_limits<double>::infinity();  // divided by pi
};

double volume_of(double radius, double half_length) { return radius * radius * (2 * half_length + radius * (4.0 / 3)); }

/// Returns the shortest capsule with the axis of `circle` and this radius, which must be at least that of the circle.
Capsule with_radius(const Points& local, const SegmentFrame& frame, const Circle& circle, double radius) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : local) {
    const double x = p[0] - circle.x, y = p[1] - circle.y;
    const double cap = std::sqrt(std::max(0.0, radius * radius - (x * x + y * y)));
    high = std::max(high, p[2] - cap);
    low = std::min(low, p[2] + cap);
  }
  const double half = std::max(0.0, (high - low) / 2);
  const Vec3 centre = frame.x * circle.x + frame.y * circle.y + frame.z * ((high + low) / 2);
  return {frame, centre, half, radius, volume_of(radius, half)};
}

Capsule along(const Points& points, const Vec3& direction) {
  const SegmentFrame frame = frame_along(direction);
  Points local;
  std::vector<std::array<double, 2>> flat;
  for (const Vec3& p : points) {
    local.emplace_back(dot(frame.x, p), dot(frame.y, p), dot(frame.z, p));
    flat.push_back({local.back()[0], local.back()[1]});
  }
  const Circle circle = smallest_circle(flat);
  Capsule best;
  // A larger radius may save more length than it costs, because the caps then cover the corners.
  for (const double factor : {1.0, 1.02, 1.05, 1.1, 1.2}) {
    const Capsule capsule = with_radius(local, frame, circle, circle.radius * factor);
    if (capsule.volume < best.volume) best = capsule;
  }
  return best;
}

/// Returns start directions: axes, diagonals, and the line between two distant points.
Points starts(const Points& points) {
  Points directions = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
  const auto farthest_from = [&](const Vec3& from) {
    return *std::max_element(points.begin(), points.end(), [&](const Vec3& p, const Vec3& q) {
      return squared_norm(Vec3(p - from)) < squared_norm(Vec3(q - from));
    });
  };
  const Vec3 one = farthest_from(points[0]), other = farthest_from(one);
  if (one != other) directions.push_back(other - one);
  return directions;
}

/// Tilts the axis towards eight directions while the volume decreases, then halves the tilt.
Capsule refined(const Points& points, Capsule best) {
  for (double tilt = 0.3; tilt > 1e-3; tilt /= 2) {  // rad; below this the volume changes in the fifth digit
    for (bool better = true; better;) {
      better = false;
      const SegmentFrame f = best.frame;
      for (const auto& [x, y] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}) {
        const Capsule capsule = along(points, f.z + tilt * (f.x * x + f.y * y));
        if (!(capsule.volume < best.volume * (1 - 1e-6))) continue;
        best = capsule;
        better = true;
      }
    }
  }
  return best;
}

double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a, from = p - a;
  const double square = squared_norm(along);
  const double share = square > 0.0 ? std::clamp(dot(from, along) / square, 0.0, 1.0) : 0.0;
  // Whatever the rounding of `share`, this is a point of the segment, so the result is never below the true distance.
  return squared_norm(Vec3(from - along * share));
}

}  // namespace

PlacedShape fit_capsule(std::span<const Vec3> points) {
  const Points extreme = extreme_points(points);
  Capsule best;
  for (const Vec3& direction : starts(extreme)) {
    const Capsule capsule = refined(extreme, along(extreme, direction));
    if (capsule.volume < best.volume) best = capsule;
  }
  const Ball ball = enclosing_ball(extreme);
  Vec3 half = Vec3::Zero();
  PlacedShape placed;
  if (best.half_length > 0.0 && best.volume < volume_of(ball.radius, 0.0)) {
    for (int k = 0; k < 3; ++k) {
      placed.origin.rotation(k, 0) = best.frame.x[k];
      placed.origin.rotation(k, 1) = best.frame.y[k];
      placed.origin.rotation(k, 2) = best.frame.z[k];
    }
    placed.origin.translation = best.centre;
    half[2] = best.half_length;
  } else {
    placed.origin.translation = ball.centre;
  }
  // The end points as the robot computes them.
  const Vec3 a = placed.origin * Vec3(-half), b = placed.origin * half;
  double farthest = 0.0;
  for (const Vec3& p : points) farthest = std::max(farthest, squared_distance_to_segment(p, a, b));
  const double radius = enclosing_radius(farthest);
  if (half[2] > 0.0)
    placed.shape = CapsuleShape{radius, 2 * half[2]};
  else
    placed.shape = SphereShape{radius};
  return placed;
}

}  // namespace hinge::robotics
