// SPDX-License-Identifier: BSD-3-Clause
// detail::sincos against libm, at hard arguments, and its bits.
#include "hinge/detail/core/sincos.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

namespace hinge {
namespace sincos_test {

/// Both libm and detail::sincos have errors of about one ulp here, so they differ by at most 3 ulp.
void expect_close(double x) {
  const detail::SinCos sc = detail::sincos(x);
  const auto ulps = [](double value) { return 3 * (std::nextafter(std::abs(value), 2.0) - std::abs(value)); };
  EXPECT_NEAR(sc.sin, std::sin(x), ulps(std::sin(x))) << std::hexfloat << x;
  EXPECT_NEAR(sc.cos, std::cos(x), ulps(std::cos(x))) << std::hexfloat << x;
}

TEST(SinCos, IsExactAtZero) {
  EXPECT_EQ(detail::sincos(0.0).sin, 0.0);
  EXPECT_EQ(detail::sincos(0.0).cos, 1.0);
  EXPECT_EQ(detail::sincos(-0.0).cos, 1.0);
}

TEST(SinCos, AgreesWithLibmOverTheWholeRange) {
  std::mt19937_64 random(11);
  for (const double range : {1e-300, 1e-8, 0.5, 4.0, 1e3, 1e6, 1.1e6, 1e9, 1e22, 1e100, 1e307}) {
    std::uniform_real_distribution<double> uniform(-range, range);
    for (int k = 0; k < 2000; ++k) expect_close(uniform(random));
  }
  for (int k = -1000; k <= 1000; ++k) expect_close(k * std::numbers::pi / 4);
  for (const double x :
       {0x1p20, 0x1.0000000000001p20, std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min()}) {
    expect_close(x);
    expect_close(-x);
  }
}

TEST(SinCos, ReducesTheHardestArgument) {
  // The double nearest to a multiple of pi/2 (Muller, Elementary Functions, table 11.1). glibc 2.36 is 7 ulp off
  // here.
  EXPECT_NEAR(detail::sincos(6381956970095103.0 * 0x1p797).cos, -4.68716592425462761112e-19, 2e-34);
}

TEST(SinCos, HasTheseBitsEverywhere) {
  // A hash over 800 000 values. Another hash means that the compiler contracts or reorders operations.
  std::uint64_t hash = 14695981039346656037ULL;
  const auto mix = [&](double value) { hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211ULL; };
  double x = -50.0;
  for (int k = 0; k < 200000; ++k, x += 0.0007) {
    const detail::SinCos a = detail::sincos(x), b = detail::sincos(x * 1e9);
    mix(a.sin);
    mix(a.cos);
    mix(b.sin);
    mix(b.cos);
  }
  EXPECT_EQ(hash, 2513492045643707280ULL);
}

}  // namespace sincos_test
}  // namespace hinge
