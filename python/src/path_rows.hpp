// SPDX-License-Identifier: BSD-3-Clause
// Rows of the structured arrays of certify(), and its arguments.
#pragma once

#include <cstdint>
#include <string>

#include "arrays.hpp"
#include "hinge/core/id.hpp"
#include "hinge/path/path_answer.hpp"

namespace hinge::python {

/// The answer for one path. bind_core() registers its dtype.
struct PathRow {
  std::int8_t verdict;  ///< PathVerdict
  Padding<7> padding;
  double parameter, half_width;
  std::int64_t i, j;  ///< a pair that collides or is not proved apart; -1: none
  double distance, threshold;
  std::int64_t states;
};

inline PathRow path_row(const PathAnswer& answer) {
  PathRow row{static_cast<std::int8_t>(answer.verdict),
              {},
              answer.parameter,
              answer.half_width,
              -1,
              -1,
              0.0,
              0.0,
              static_cast<std::int64_t>(answer.counts.configurations)};
  if (answer.hit) {
    row.i = static_cast<std::int64_t>(index(answer.hit->first));
    row.j = static_cast<std::int64_t>(index(answer.hit->second));
    row.distance = answer.hit->distance;
    row.threshold = answer.hit->threshold;
  }
  return row;
}

/// Starts and ends of straight paths: as many starts as ends, or one for all.
struct Paths {
  /// from, to: the arguments a and b. Throws as as_configurations() does, and ValueError for different numbers.
  Paths(const pybind11::object& from, const pybind11::object& to, std::size_t dof)
      : a(as_configurations(from, "a", dof)), b(as_configurations(to, "b", dof)), count(a.one ? b.count : a.count) {
    if (a.count != b.count && !a.one && !b.one)
      throw pybind11::value_error("a and b: " + std::to_string(a.count) + " and " + std::to_string(b.count) +
                                  " configurations, expected the same number, or one");
  }
  std::span<const double> start(std::size_t k) const { return a[a.one ? 0 : k]; }
  std::span<const double> end(std::size_t k) const { return b[b.one ? 0 : k]; }

  Configurations a, b;
  std::size_t count;
};

}  // namespace hinge::python
