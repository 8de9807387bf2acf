// SPDX-License-Identifier: BSD-3-Clause
// The truth about atoms, in whole multiples of the smallest double (Boost.Multiprecision).
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
using Simd = boost::multiprecision::cpp_bin_float_50;

/// x / 2^-1074, whole for every double.
inline Big in_smallest_doubles(double x) {
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int shift = exponent - 53 + 1074;
  // Below the normal doubles the last bits of the mantissa are zeros.
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

/// d < m. Extended precision decides where its rounding cannot matter, and whole numbers the rest.
inline bool exactly_closer(const double* p, const double* q, double m) {
  long double squared = 0;
  for (int k = 0; k < 3; ++k) {
    const long double d = static_cast<long double>(p[k]) - q[k];
    squared += d * d;
  }
  const long double square = static_cast<long double>(m) * m, difference = squared - square;
  // Six roundings of half an epsilon at most; a NaN or an underflow to 0 decides nothing.
  const long double doubt = 8 * std::numeric_limits<long double>::epsilon() * std::max(squared, square);
  if (doubt > 0 && std::abs(difference) > doubt) return difference < 0;
  const Big threshold = in_smallest_doubles(m);
  return exact_square(p, q) < threshold * threshold;
}

/// One ulp to either side of the rounded value, except where it is exact in an obvious way.
inline robustness::Bracket bracket_of(const Simd& x) {
  const auto d = static_cast<double>(x);
  if (Simd(d) == x) return {d, d};
  return {std::nextafter(d, 0.0), std::nextafter(d, std::numeric_limits<double>::infinity())};
}

/// Of atoms that can be answered for.
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
      // Right to a few roundings of a longer mantissa: enough to find a pair as close as the closest.
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
  truth.distance = bracket_of(ldexp(sqrt(Simd(square)), -1074));
  return truth;
}

}  // namespace hinge::test
