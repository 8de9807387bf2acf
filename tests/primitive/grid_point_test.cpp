// SPDX-License-Identifier: BSD-3-Clause
// Decimal ties: a million pairs on the grid of a PDB file against integers. Decisions on doubles are random there.
#include "hinge/detail/primitive/grid_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>

#include "engine/random_mechanism.hpp"
#include "hinge/primitive/point.hpp"

#if __has_include(<boost/multiprecision/cpp_int.hpp>)
#include <boost/multiprecision/cpp_int.hpp>
#endif

namespace hinge {
namespace grid_point_test {

using test::Random;
using Whole3 = std::array<std::int64_t, 3>;

constexpr std::uint64_t seed = 41;

Whole3 random_whole(Random& r, std::int64_t below) {
  const auto one = [&] { return static_cast<std::int64_t>(r.below(static_cast<std::size_t>(2 * below))) - below; };
  const std::int64_t x = one(), y = one(), z = one();
  return {x, y, z};
}

detail::GridPoint moved(const detail::GridPoint& p, const Whole3& by) {
  return {{p.thousandths[0] + by[0], p.thousandths[1] + by[1], p.thousandths[2] + by[2]}};
}

/// An integer vector whose length is the integer m^2 + n^2 + p^2 + q^2 (Lebesgue).
Whole3 of_whole_length(Random& r, std::int64_t largest, std::int64_t& length) {
  const auto one = [&] { return static_cast<std::int64_t>(r.below(static_cast<std::size_t>(largest))); };
  const std::int64_t m = one(), n = one(), p = one(), q = one();
  length = m * m + n * n + p * p + q * q;
  return {m * m + n * n - p * p - q * q, 2 * (m * q + n * p), 2 * (n * q - m * p)};
}

TEST(GridPoint, DecidesAMillionDecimalTiesAsIntegersDo) {
  Random random(seed);
  std::size_t below_as_doubles = 0, wrong = 0;
  constexpr std::size_t count = 1'000'000;
  for (std::size_t k = 0; k < count; ++k) {
    std::int64_t length = 0;
    const detail::GridPoint p{random_whole(random, 100'000)};
    const detail::GridPoint q = moved(p, of_whole_length(random, 45, length));
    const double m = static_cast<double>(length) / 1000.0;
    const double next = static_cast<double>(length + 1) / 1000.0;
    // Thresholds are computed like this, as a factor times a sum.
    const double made = 0.8 * (static_cast<double>(length) / 1600.0 + static_cast<double>(length) / 1600.0);
    wrong += closer_than(p, q, m) || closer_than(q, p, m) || closer_than(p, q, made) || !closer_than(p, q, next);
    if (length > 0) {
      const double nanos = static_cast<double>(1'000'000 * length - 1) / 1e9;
      wrong += closer_than(p, q, nanos) || !closer_than(p, q, static_cast<double>(1'000'000 * length + 1) / 1e9);
    }
    below_as_doubles += closer_than(Point{p.position()}, Point{q.position()}, m) ? 1 : 0;
    wrong += detail::closer_as_written(Point{p.position()}, Point{q.position()}, m);
  }
  EXPECT_EQ(wrong, 0U) << "seed " << seed;
  std::cout << "of " << count << " decimal ties the stored doubles are below the stored threshold in "
            << below_as_doubles << " (seed " << seed << ")\n";
  EXPECT_GT(below_as_doubles, count / 3) << "the doubles toss a coin; if they do not, ties are not made well";
  EXPECT_LT(below_as_doubles, 2 * (count / 3));
}

TEST(GridPoint, DecidesAnyPairAsIntegersDo) {
  Random random(seed + 1);
  for (std::size_t k = 0; k < 100'000; ++k) {
    const std::int64_t size = std::int64_t{1} << random.below(20);
    const detail::GridPoint p{random_whole(random, 1'000'000)};
    const Whole3 by = random_whole(random, size);
    const detail::GridPoint q = moved(p, by);
    const std::int64_t squared = by[0] * by[0] + by[1] * by[1] + by[2] * by[2];
    const auto around = static_cast<std::int64_t>(std::sqrt(static_cast<double>(squared)));
    const std::int64_t n = std::max<std::int64_t>(0, around - 2 + static_cast<std::int64_t>(random.below(5)));
    ASSERT_EQ(closer_than(p, q, static_cast<double>(n) / 1000.0), squared < n * n) << "seed " << seed + 1 << ", " << k;
    ASSERT_EQ(squared_distance(p, q) == 0.0, squared == 0);
    const double d = std::sqrt(static_cast<double>(squared)) / 1000.0;
    ASSERT_NEAR(std::sqrt(squared_distance(p, q)), d, 0x1p-50 * d);
  }
}

TEST(GridPoint, HoldsAtTheEndsOfItsRange) {
  constexpr std::int64_t most = detail::GridPoint::most;
  const detail::GridPoint p{{-most, -most, -most}}, q{{most, most, most}}, o;
  EXPECT_FALSE(closer_than(p, q, 3.8e9));
  EXPECT_TRUE(closer_than(p, q, 3.9e9));
  EXPECT_FALSE(closer_than(o, o, 0.0));
  EXPECT_TRUE(closer_than(o, o, 0x1p-1074));
  EXPECT_TRUE(closer_than(p, q, std::numeric_limits<double>::max()));
  EXPECT_TRUE(closer_than(p, q, std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(closer_than(o, detail::GridPoint{{1, 0, 0}}, 0x1p-1074));
  EXPECT_FALSE(closer_than(o, detail::GridPoint{{most, 0, 0}}, static_cast<double>(most) / 1000.0));
}

TEST(GridPoint, IsReadFromDecimalsOnly) {
  Random random(seed + 2);
  for (std::size_t k = 0; k < 10'000; ++k) {
    const std::int64_t size = std::int64_t{1} << random.below(40);
    const detail::GridPoint p{random_whole(random, size)};
    const std::int64_t whole = std::abs(p.thousandths[0]);
    std::array<char, 40> text;
    std::snprintf(text.data(), text.size(), "%lld.%03lld", static_cast<long long>(whole / 1000),
                  static_cast<long long>(whole % 1000));
    const double read = std::copysign(std::strtod(text.data(), nullptr), p.thousandths[0] < 0 ? -1.0 : 1.0);
    ASSERT_EQ(p.position()[0], read) << text.data();
    const auto again = detail::GridPoint::of(p.position());
    ASSERT_TRUE(again.has_value());
    ASSERT_EQ(again->thousandths, p.thousandths);
    ASSERT_EQ(p.placed(Pose{}).thousandths, p.thousandths);
    const Vec3 x = p.position();
    ASSERT_FALSE(detail::GridPoint::of(Vec3(x[0], std::nextafter(x[1], 1e300), x[2])).has_value());
    ASSERT_TRUE(p.bounds().contains(Aabb(x)));
  }
  EXPECT_FALSE(detail::GridPoint::of(Vec3(1.2345, 0, 0)).has_value());
  EXPECT_FALSE(detail::GridPoint::of(Vec3(0, 1e30, 0)).has_value());
  EXPECT_FALSE(detail::GridPoint::of(Vec3(0, 0, std::numeric_limits<double>::quiet_NaN())).has_value());
  EXPECT_FALSE(detail::GridPoint::of(Vec3(0, 0, -std::numeric_limits<double>::infinity())).has_value());
}

TEST(GridPoint, LeavesOtherCoordinatesToTheDoubles) {
  const Point p{Vec3(0.0001, 0, 0)}, q{Vec3(3.0001, 0, 0)};
  EXPECT_EQ(detail::closer_as_written(p, q, 3.0), closer_than(p, q, 3.0));
  EXPECT_FALSE(detail::closer_as_written(Point{Vec3(0.1, 0, 0)}, Point{Vec3(0.4, 0, 0)}, 0.3));
}

#if __has_include(<boost/multiprecision/cpp_int.hpp>)
/// Thresholds that are not decimals: their value as a double decides.
TEST(GridPoint, TakesOtherThresholdsForWhatTheyAre) {
  using Big = boost::multiprecision::cpp_int;
  Random random(seed + 3);
  for (std::size_t k = 0; k < 20'000; ++k) {
    const detail::GridPoint p{random_whole(random, 10'000)};
    const Whole3 by = random_whole(random, 4000);
    const std::int64_t squared = by[0] * by[0] + by[1] * by[1] + by[2] * by[2];
    double m = std::sqrt(static_cast<double>(squared)) / 1000.0;
    for (std::size_t n = random.below(9); n > 0; --n) m = std::nextafter(m, random.one_in(2) ? 10.0 : 0.0);
    const double nanos = m * 1e9;
    if (m < 0.01 || std::abs(nanos - std::nearbyint(nanos)) < 1e-4) continue;  // skip decimals and values near them
    // whole = m * 2^60, an integer.
    const auto whole = static_cast<std::int64_t>(std::ldexp(m, 60));
    ASSERT_EQ(std::ldexp(m, 60), std::nearbyint(std::ldexp(m, 60)));
    Big square = whole, threshold = squared;
    square *= whole;
    square *= 1'000'000;
    threshold <<= 120;
    ASSERT_EQ(closer_than(p, moved(p, by), m), threshold < square) << "seed " << seed + 3 << ", case " << k;
  }
}
#endif

}  // namespace grid_point_test
}  // namespace hinge
