// SPDX-License-Identifier: BSD-3-Clause
// Error-free transforms, big integers and orientation signs against Boost.Multiprecision.
#include "hinge/detail/exact/orient.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/detail/exact/integer.hpp"

#if __has_include(<boost/multiprecision/cpp_int.hpp>)
#include <boost/multiprecision/cpp_int.hpp>

namespace hinge::detail::exact {
namespace orient_test {

using test::Random;
using Big = boost::multiprecision::cpp_int;

/// Returns x * 2^1074, which is an integer.
Big big(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  const auto whole = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
  const int shift = exponent - 53 + 1074;
  return shift >= 0 ? Big(Big(whole) << static_cast<unsigned>(shift)) : Big(whole >> -shift);
}

double random_of_exponent(Random& random, int low, int high) {
  const int exponent = low + static_cast<int>(random.below(static_cast<std::size_t>(high - low) + 1));
  return std::ldexp(random.uniform(-1.0, 1.0), exponent);
}

std::size_t cases() { return std::getenv("HINGE_TEST_ALL") != nullptr ? 1'000'000 : 10'000; }

TEST(ErrorFree, SumsAndProductsLoseNothing) {
  Random random(1);
  for (std::size_t k = 0; k < cases(); ++k) {
    const double a = random_of_exponent(random, -400, 400), b = random_of_exponent(random, -400, 400);
    const ValueAndError sum = two_sum(a, b), difference = two_difference(a, b), product = two_product(a, b);
    EXPECT_EQ(sum.value, a + b);
    EXPECT_EQ(big(sum.value) + big(sum.rest), big(a) + big(b));
    EXPECT_EQ(big(difference.value) + big(difference.rest), big(a) - big(b));
    EXPECT_EQ(product.value, a * b);
    EXPECT_EQ((big(product.value) + big(product.rest)) << 1074, big(a) * big(b));
    const bool a_larger = std::abs(a) >= std::abs(b);
    EXPECT_EQ(fast_two_sum(a_larger ? a : b, a_larger ? b : a).rest, sum.rest);
  }
}

/// Expects the sign of `expected` and its value rounded to 53 bits.
void expect_same(const Integer& n, const Big& expected) {
  EXPECT_EQ(n.sign(), expected.sign());
  const Scaled s = n.scaled();
  const Big mantissa = static_cast<std::int64_t>(std::ldexp(s.mantissa, 53));
  const int shift = s.exponent - 53;
  if (shift > 0) {
    EXPECT_LE(abs(Big(expected - (mantissa << static_cast<unsigned>(shift)))), Big(1) << static_cast<unsigned>(shift));
  } else {
    EXPECT_EQ(expected << static_cast<unsigned>(-shift), mantissa);
  }
}

TEST(Integer, AgreesWithAnotherLibraryOnSumsAndProducts) {
  Random random(2);
  for (std::size_t k = 0; k < cases() / 10; ++k) {
    const int low = random.one_in(2) ? -1074 : -60, high = random.one_in(2) ? 1024 : 4;
    std::array<double, 6> x;
    Integer product = Integer::of(1.0, 0), sum;
    Big big_product = 1, big_sum = 0;
    for (double& value : x) {
      value = random.one_in(10) ? 0.0 : random_of_exponent(random, low, high);
      const double other = random_of_exponent(random, low, high);
      const Integer n = Integer::of(value, -1074) - Integer::of(other, -1074);
      const Big b = big(value) - big(other);
      product = product * n;
      big_product *= b;
      const bool turned = random.one_in(2);
      sum = turned ? n - sum : sum + n;
      big_sum = turned ? Big(b - big_sum) : Big(big_sum + b);
      expect_same(n, b);
      expect_same(sum, big_sum);
      expect_same(product, big_product);
    }
    const Integer a = Integer::of(x[0], -1074), c = Integer::of(x[1], -1074);
    expect_same(a * a * a - c * c * c, big(x[0]) * big(x[0]) * big(x[0]) - big(x[1]) * big(x[1]) * big(x[1]));
    expect_same(a * c + c * a, 2 * big(x[0]) * big(x[1]));
    expect_same(a * c - c * a, 0);
    EXPECT_EQ(a < c, x[0] < x[1]);
    EXPECT_EQ(a <= c, x[0] <= x[1]);
    EXPECT_TRUE(a <= a && !(a < a));
  }
}

TEST(Integer, HoldsTheLargestProductItPromises) {
  const double largest = std::numeric_limits<double>::max();
  const Integer difference = Integer::of(largest, -1074) - Integer::of(-largest, -1074);
  const Big big_difference = 2 * big(largest);
  Integer sixth = Integer::of(1.0, 0);
  Big big_sixth = 1;
  for (int k = 0; k < 6; ++k) {
    sixth = sixth * difference;
    big_sixth *= big_difference;
  }
  expect_same(sixth + sixth + sixth + sixth, 4 * big_sixth);
}

int expected3d(const std::array<Vec3, 4>& p) {
  std::array<std::array<Big, 3>, 3> r;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      r[i][k] = big(p[i][static_cast<Eigen::Index>(k)]) - big(p[3][static_cast<Eigen::Index>(k)]);
  return Big(r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
             r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]))
      .sign();
}

int expected2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const int x = axis == 0 ? 1 : axis == 1 ? 2 : 0, y = axis == 0 ? 2 : axis == 1 ? 0 : 1;
  const Big ax = big(a[x]), ay = big(a[y]), bx = big(b[x]), by = big(b[y]), cx = big(c[x]), cy = big(c[y]);
  return Big(ax * by - ay * bx + bx * cy - by * cx + cx * ay - cy * ax).sign();
}

/// Counts signs -1, 0 and 1, so a test can show that all of them occurred.
struct Seen {
  std::array<std::size_t, 3> times{};
  void add(int sign) { ++times[sign < 0 ? 0U : sign == 0 ? 1U : 2U]; }
};

template <class Make>
Seen check_orientations(std::uint64_t seed, std::size_t count, const Make& make) {
  Random random(seed);
  Seen seen;
  for (std::size_t n = 0; n < count && !testing::Test::HasFailure(); ++n) {
    const std::array<Vec3, 4> p = make(random);
    const int expected = expected3d(p);
    EXPECT_EQ(orient3d(p[0], p[1], p[2], p[3]), expected) << "seed " << seed << " case " << n;
    EXPECT_EQ(orient3d(p[1], p[0], p[2], p[3]), -expected);
    EXPECT_EQ(orient3d_in_integers(p[0], p[1], p[2], p[3]), expected);
    seen.add(expected);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(orient2d(p[0], p[1], p[2], axis), expected2d(p[0], p[1], p[2], axis)) << seed << " " << n;
  }
  return seen;
}

Vec3 nudged(Random& random, Vec3 p) {
  for (int k = 0; k < 3; ++k)
    for (std::size_t times = random.below(3); times-- > 0;)
      p[k] = std::nextafter(p[k], random.one_in(2) ? 1e300 : -1e300);
  return p;
}

TEST(Orient, IsRightForRandomPoints) {
  for (const double scale : {1e-160, 1e-100, 1e-3, 1.0, 1e8, 1e100, 1e160})
    check_orientations(3, cases() / 10, [scale](Random& r) {
      return std::array<Vec3, 4>{r.vector(scale), r.vector(scale), r.vector(scale), r.vector(scale)};
    });
}

TEST(Orient, IsRightForPointsRoundedOntoPlanesAndLines) {
  for (const double scale : {1e-300, 1e-160, 1.0, 1e120, 1e300}) {
    const Seen seen = check_orientations(4, cases() / 4, [scale](Random& r) {
      const Vec3 far = Vec3(r.vector(1.0) * (r.one_in(3) ? 1e5 * scale : scale));
      const Vec3 a = far + r.vector(1.0) * scale, b = far + r.vector(1.0) * scale;
      const double s = r.uniform(-2.0, 3.0), t = r.uniform(-2.0, 3.0);
      const Vec3 c = r.one_in(3) ? Vec3(a + s * (b - a)) : Vec3(far + r.vector(1.0) * scale);
      return std::array<Vec3, 4>{a, b, c, nudged(r, a + s * (b - a) + t * (c - a))};
    });
    EXPECT_GT(seen.times[0], cases() / 100) << scale;
    EXPECT_GT(seen.times[2], cases() / 100);
  }
}

TEST(Orient, IsZeroForPointsInOnePlane) {
  const Seen seen = check_orientations(5, cases(), [](Random& r) {
    const auto whole = [&r] {
      const auto one = [&r] { return static_cast<double>(r.below(4)) - 1.0; };
      const double x = one(), y = one(), z = one();
      return Vec3(x, y, z);
    };
    return std::array<Vec3, 4>{whole(), whole(), whole(), whole()};
  });
  EXPECT_GT(seen.times[1], cases() / 10);
}

TEST(Orient, IsRightWhereDoublesEnd) {
  check_orientations(6, cases() / 2, [](Random& r) {
    const int low = r.one_in(2) ? -1074 : 900, high = r.one_in(2) ? 1024 : low + 100;
    std::array<Vec3, 4> p;
    for (Vec3& x : p)
      for (int k = 0; k < 3; ++k) x[k] = r.one_in(6) ? 0.0 : random_of_exponent(r, low, high);
    if (r.one_in(3)) p[3] = p[0] * 0.25 + p[1] * 0.25 + p[2] * 0.5;
    return p;
  });
  const double largest = std::numeric_limits<double>::max(), smallest = 0x1p-1074;
  EXPECT_EQ(orient3d(Vec3(largest, -largest, 0), Vec3(-largest, largest, largest), Vec3(largest, largest, -largest),
                     Vec3(-largest, -largest, smallest)),
            expected3d({Vec3(largest, -largest, 0), Vec3(-largest, largest, largest), Vec3(largest, largest, -largest),
                        Vec3(-largest, -largest, smallest)}));
  EXPECT_EQ(orient3d(Vec3(smallest, 0, 0), Vec3(0, smallest, 0), Vec3(0, 0, smallest), Vec3(0, 0, 0)), 1);
}

}  // namespace orient_test
}  // namespace hinge::detail::exact

#else
TEST(Orient, NeedsBoostMultiprecision) { GTEST_SKIP() << "boost/multiprecision was not found (libboost-dev)"; }
#endif
