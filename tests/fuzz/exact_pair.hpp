// SPDX-License-Identifier: BSD-3-Clause
// The real-number answers for two primitives: do they come closer than m, and is their distance right?
#pragma once

#include <optional>

#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"

namespace fuzz {

/// Whether p and q come closer than m (>= 0) by the rule of their kind, on the stored doubles; none: not decided.
std::optional<bool> exactly_closer(const hinge::Point& p, const hinge::Point& q, double m);
std::optional<bool> exactly_closer(const hinge::Sphere& p, const hinge::Sphere& q, double m);
std::optional<bool> exactly_closer(const hinge::Capsule& p, const hinge::Capsule& q, double m);
std::optional<bool> exactly_closer(const hinge::Triangle& p, const hinge::Triangle& q, double m);

/// Is the distance a query reported right to 64 half ulps of the largest size involved (twice what the primitives
/// promise)? True also where squares leave the range of doubles, which promises nothing.
bool distance_is_right(const hinge::Point& p, const hinge::Point& q, double reported);
bool distance_is_right(const hinge::Sphere& p, const hinge::Sphere& q, double reported);
bool distance_is_right(const hinge::Capsule& p, const hinge::Capsule& q, double reported);
bool distance_is_right(const hinge::Triangle& p, const hinge::Triangle& q, double reported);

}  // namespace fuzz
