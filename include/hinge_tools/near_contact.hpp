// SPDX-License-Identifier: BSD-3-Clause
// Configurations that nearly touch, and counts of wrong verdicts about them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/number_text.hpp"

namespace hinge::tool {

/// How far configurations are moved from a contact, in rad or m, with its name.
inline constexpr std::array<std::pair<double, const char*>, 3> steps_from_contact = {
    {{1e-3, "10^-3"}, {1e-6, "10^-6"}, {1e-9, "10^-9"}}};

/// Returns the configuration at t on the straight line between two others.
inline std::vector<double> between(const std::vector<double>& from, const std::vector<double>& to, double t) {
  std::vector<double> q(from.size());
  for (std::size_t j = 0; j < q.size(); ++j) q[j] = from[j] + t * (to[j] - from[j]);
  return q;
}

/// Returns q moved towards another configuration until its largest change is `step`, or as far as the other one.
inline std::vector<double> moved(const std::vector<double>& q, const std::vector<double>& to, double step) {
  double largest = 0.0;
  for (std::size_t j = 0; j < q.size(); ++j) largest = std::max(largest, std::abs(to[j] - q[j]));
  return largest > step ? between(q, to, step / largest) : to;
}

/// Pairs of a free and a colliding configuration that nearly touch.
class NearContacts {
 public:
  /// Adds a free and a colliding configuration on the line between two of them, at neighbouring values of t.
  /// collides(q): the verdict.
  template <class Collides>
  void add(const Collides& collides, const std::vector<double>& free, const std::vector<double>& colliding) {
    double low = 0.0, high = 1.0;
    for (double middle = 0.5; middle > low && middle < high; middle = low + (high - low) / 2.0)
      (collides(between(free, colliding, middle)) ? high : low) = middle;
    near_.push_back(between(free, colliding, low));
    near_.push_back(between(free, colliding, high));
    ends_.push_back(free);
    ends_.push_back(colliding);
  }

  /// Returns the configurations: a free one, then the colliding one next to it.
  const std::vector<std::vector<double>>& all() const { return near_; }
  /// Returns them moved away from the contact by `step`, towards the ends of the line.
  std::vector<std::vector<double>> apart(double step) const {
    std::vector<std::vector<double>> all;
    for (std::size_t n = 0; n < near_.size(); ++n) all.push_back(moved(near_[n], ends_[n], step));
    return all;
  }

 private:
  std::vector<std::vector<double>> near_, ends_;
};

/// Counts wrong verdicts.
struct WrongVerdicts {
  std::size_t missed = 0;  ///< colliding, but called free
  std::size_t added = 0;   ///< free, but called colliding

  void count(bool truth, bool given) {
    missed += truth && !given ? 1U : 0U;
    added += !truth && given ? 1U : 0U;
  }
  /// Returns "right" or "3 missed, 5 false".
  std::string text() const {
    if (missed + added == 0) return "right";
    return number_text(missed) + " missed, " + number_text(added) + " false";
  }
};

}  // namespace hinge::tool
