// SPDX-License-Identifier: BSD-3-Clause
// detail::atan2 and detail::log against libm, at special values, and their bits.
#include "hinge/detail/core/elementary.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

namespace hinge {
namespace elementary_test {

double ulp(double value) { return std::nextafter(std::abs(value), 1e308) - std::abs(value); }

/// libm is within one ulp and detail::atan2 within three.
void expect_close(double y, double x) {
  const double expected = std::atan2(y, x), angle = detail::atan2(y, x);
  EXPECT_NEAR(angle, expected, 4 * ulp(expected)) << std::hexfloat << y << ' ' << x;
  EXPECT_EQ(std::signbit(angle), std::signbit(y));
  EXPECT_LE(std::abs(angle), std::numbers::pi);
}

TEST(Atan2, AgreesWithLibm) {
  std::mt19937_64 random(31);
  for (const double range : {1e-300, 1e-20, 1e-8, 1e-3, 1.0, 10.0, 1e8, 1e300}) {
    std::uniform_real_distribution<double> y(-range, range), x(-1.0, 1.0);
    for (int k = 0; k < 20000; ++k) expect_close(y(random), x(random));
  }
  for (int k = -4000; k <= 4000; ++k) {  // slopes around every multiple of pi / 4
    const double angle = k * std::numbers::pi / 1000.0;
    expect_close(std::sin(angle), std::cos(angle));
    expect_close(k * 0x1p-30, 1.0);
    expect_close(1.0 + k * 0x1p-52, 1.0);
    expect_close(1.0 + k * 0x1p-52, -1.0);
  }
}

TEST(Atan2, AgreesWithLibmAtSpecialValues) {
  using Limits = std::numeric_limits<double>;
  constexpr double values[] = {0.0, Limits::denorm_min(), Limits::min(), 1.0, Limits::max(), Limits::infinity()};
  for (const double y : values)
    for (const double x : values)
      for (const double signed_y : {y, -y})
        for (const double signed_x : {x, -x}) expect_close(signed_y, signed_x);
  EXPECT_TRUE(std::isnan(detail::atan2(Limits::quiet_NaN(), 1.0)));
  EXPECT_TRUE(std::isnan(detail::atan2(1.0, Limits::quiet_NaN())));
}

TEST(Log, AgreesWithLibm) {
  std::mt19937_64 random(32);
  for (const double range : {1e-300, 1e-8, 1.0, 2.0, 1e10, 1e300}) {
    std::uniform_real_distribution<double> x(range / 2.0, range);
    for (int k = 0; k < 20000; ++k) {
      const double value = x(random);
      EXPECT_NEAR(detail::log(value), std::log(value), 4 * ulp(std::log(value)) + 0x1p-54) << std::hexfloat << value;
    }
  }
  EXPECT_EQ(detail::log(1.0), 0.0);
}

TEST(Atan2, HasTheseBitsEverywhere) {
  // A hash over 200 000 values. Another hash means that the compiler contracts or reorders operations.
  std::uint64_t hash = 14695981039346656037ULL;
  double x = -1.0;
  for (int k = 0; k < 100000; ++k, x += 0.00002)
    for (const double y : {0.3, -7.0 * x * x})
      hash = (hash ^ std::bit_cast<std::uint64_t>(detail::atan2(y, x))) * 1099511628211ULL;
  EXPECT_EQ(hash, 0x2699f9c4f636860ULL);
}

}  // namespace elementary_test
}  // namespace hinge
