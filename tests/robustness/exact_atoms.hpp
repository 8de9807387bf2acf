// SPDX-License-Identifier: BSD-3-Clause
// True answers for atoms, computed in integer multiples of the smallest double (Boost.Multiprecision).
#pragma once

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

#include "robustness/case.hpp"

namespace hinge::test {

using Big = boost::multiprecision::cpp_int;
using Float50 = boost::multiprecision::cpp_bin_float_50;

/// Returns x / 2^-1074, an integer for every double.
inline Big in_smallest_doubles(double x) {
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int shift = exponent - 53 + 1074;
  // For denormals the last bits of the mantissa are zeros.
  return shift >= 0 ? Big(mantissa) << static_cast<unsigned>(shift) : Big(mantissa / (std::int64_t{1} << -shift));
}

inline Big exact_square(const double* p, const double* q) {
  Big sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Big d = in_smallest_doubles(p[k]) - in_smallest_doubles(q[k]);
    sum += d * d;
  }
  return sum;
}

/// Returns whether d < m exactly. Extended precision decides if its rounding error cannot matter, otherwise integers
/// do.
inline bool exactly_closer(const double* p, const double* q, double m) {
  long double squared = 0;
  for (int k = 0; k < 3; ++k) {
    const long double d = static_cast<long double>(p[k]) - q[k];
    squared += d * d;
  }
  const long double square = static_cast<long double>(m) * m, difference = squared - square;
  // At most six roundings of half an epsilon. A NaN or an underflow to 0 leaves the decision to integers.
  const long double doubt = 8 * std::numeric_limits<long double>::epsilon() * std::max(squared, square);
  if (doubt > 0 && std::abs(difference) > doubt) return difference < 0;
  const Big threshold = in_smallest_doubles(m);
  return exact_square(p, q) < threshold * threshold;
}

/// Returns the two doubles next to the rounded value; the value itself twice if it is exact.
inline robustness::Bracket bracket_of(const Float50& x) {
  const auto d = static_cast<double>(x);
  if (Float50(d) == x) return {d, d};
  return {std::nextafter(d, 0.0), std::nextafter(d, std::numeric_limits<double>::infinity())};
}

/// Returns the true answer for valid atoms.
inline robustness::Truth exact_truth(const robustness::Atoms& atoms) {
  robustness::Truth truth;
  truth.pairs.emplace();
  std::set<std::pair<std::int64_t, std::int64_t>> excluded;
  for (std::size_t k = 0; k + 1 < atoms.excluded.size(); k += 2)
    excluded.insert(std::minmax(atoms.excluded[k], atoms.excluded[k + 1]));
  long double least = std::numeric_limits<long double>::infinity();
  std::pair<std::size_t, std::size_t> closest;
  const std::size_t n = atoms.group.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      if (atoms.group[i] == atoms.group[j]) continue;
      if (excluded.contains({static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)})) continue;
      const double *p = atoms.x.data() + 3 * i, *q = atoms.x.data() + 3 * j;
      // The error is a few roundings in extended precision, so the pair found is as close as the closest in double
      // precision.
      const long double d = std::hypot(static_cast<long double>(p[0]) - q[0], static_cast<long double>(p[1]) - q[1],
                                       static_cast<long double>(p[2]) - q[2]);
      if (d < least) least = d, closest = {i, j};
      const auto row = static_cast<std::size_t>(atoms.type[i] * atoms.type_count + atoms.type[j]);
      if (!exactly_closer(p, q, atoms.thresholds[row])) continue;
      truth.pairs->push_back(static_cast<std::uint32_t>(i));
      truth.pairs->push_back(static_cast<std::uint32_t>(j));
    }
  truth.pair_count = truth.pairs->size() / 2;
  truth.hit = !truth.pairs->empty();
  if (closest.second == 0) return truth;
  const Big square = exact_square(atoms.x.data() + 3 * closest.first, atoms.x.data() + 3 * closest.second);
  truth.distance = bracket_of(ldexp(sqrt(Float50(square)), -1074));
  return truth;
}

}  // namespace hinge::test
