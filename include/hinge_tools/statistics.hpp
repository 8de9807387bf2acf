// SPDX-License-Identifier: BSD-3-Clause
// Confidence intervals of shares and medians.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hinge::tool {

/// A value and the ends of its 95 % confidence interval.
struct Estimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// The quantile of the normal distribution for 95 % intervals.
inline constexpr double quantile_95 = 1.959963984540054;

/// Returns the share part/all with Wilson's score interval (Wilson 1927, J. Am. Stat. Assoc. 22, 209). It is within
/// [0, 1], and of a share of 0 its upper end is about 3.8/all. all: > 0.
inline Estimate share_of(std::uint64_t part, std::uint64_t all) {
  const auto n = static_cast<double>(all);
  const double p = static_cast<double>(part) / n, z2 = quantile_95 * quantile_95;
  const double centre = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = quantile_95 / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  return {p, part == 0 ? 0.0 : std::max(0.0, centre - half), part == all ? 1.0 : std::min(1.0, centre + half)};
}

/// Returns the mean with the interval of the normal approximation, not below 0 if no value is. values: not empty.
inline Estimate mean_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double x : values) sum += x;
  const double mean = sum / n;
  for (const double x : values) squares += (x - mean) * (x - mean);
  const double half = n > 1.0 ? quantile_95 * std::sqrt(squares / (n - 1.0) / n) : 0.0;
  const double least = std::ranges::min(values) >= 0.0 ? std::max(0.0, mean - half) : mean - half;
  return {mean, least, mean + half};
}

/// Returns the median with an interval between two order statistics, which holds for any distribution (Conover 1999,
/// Practical Nonparametric Statistics, section 3.2). Of fewer than six values it is their whole range. values: not
/// empty.
inline Estimate median_of(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  const auto count = static_cast<double>(n);
  const double rank = std::floor((count - quantile_95 * std::sqrt(count)) / 2.0);  // from 1
  const std::size_t low = rank >= 1.0 ? static_cast<std::size_t>(rank) - 1 : 0;
  return {(values[(n - 1) / 2] + values[n / 2]) / 2.0, values[low], values[n - 1 - low]};
}

}  // namespace hinge::tool
