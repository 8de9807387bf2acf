// SPDX-License-Identifier: BSD-3-Clause
// Exact answers for two primitives: are they closer than m, and is a reported distance right?
#pragma once

#include <optional>

#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"

namespace fuzz {

/// Returns whether p and q are closer than m (>= 0) by the rule of their type, on the stored doubles; nothing if
/// undecided.
std::optional<bool> exactly_closer(const hinge::Point& p, const hinge::Point& q, double m);
std::optional<bool> exactly_closer(const hinge::Sphere& p, const hinge::Sphere& q, double m);
std::optional<bool> exactly_closer(const hinge::Capsule& p, const hinge::Capsule& q, double m);
std::optional<bool> exactly_closer(const hinge::Triangle& p, const hinge::Triangle& q, double m);

/// Is a reported distance accurate to 64 half ulps of the largest size involved (twice the bound of the primitives)?
/// Also true if squares overflow or underflow, where nothing is guaranteed.
bool distance_is_right(const hinge::Point& p, const hinge::Point& q, double reported);
bool distance_is_right(const hinge::Sphere& p, const hinge::Sphere& q, double reported);
bool distance_is_right(const hinge::Capsule& p, const hinge::Capsule& q, double reported);
bool distance_is_right(const hinge::Triangle& p, const hinge::Triangle& q, double reported);

}  // namespace fuzz
