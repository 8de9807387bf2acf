// SPDX-License-Identifier: BSD-3-Clause
// Triangles against exact rationals: collision decisions without tolerance, distances within the stated bound.
#include "hinge/primitive/triangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <ostream>
#include <string>
#include <utility>

#if __has_include(<boost/multiprecision/cpp_int.hpp>)
#include "hinge/detail/exact/balls.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/sphere.hpp"
#include "primitive/triangle_families.hpp"
#include "primitive/triangle_oracle.hpp"

namespace hinge {
namespace triangle_test {

using test::Float50;
using test::OracleDistance;
using test::Random;
using test::TriangleFamily;

Float50 largest_difference(const Triangle& p, const Triangle& q) {
  Float50 largest = 0;
  const std::array<const Vec3*, 6> points{&p.a, &p.b, &p.c, &q.a, &q.b, &q.c};
  for (const Vec3* a : points)
    for (const Vec3* b : points)
      for (int k = 0; k < 3; ++k) largest = std::max(largest, Float50(abs(Float50((*a)[k]) - Float50((*b)[k]))));
  return largest;
}

double far_from_zero(const Triangle& p, const Triangle& q) {
  double far = 0.0;
  for (const Vec3* v : {&p.a, &p.b, &p.c, &q.a, &q.b, &q.c}) far = std::max(far, detail::largest(*v));
  return far;
}

std::string text(const Triangle& p, const Triangle& q) {
  std::string out;
  for (const Vec3* v : {&p.a, &p.b, &p.c, &q.a, &q.b, &q.c})
    for (int k = 0; k < 3; ++k) {
      std::array<char, 40> digits;
      std::snprintf(digits.data(), digits.size(), "%a, ", (*v)[k]);
      out += digits.data();
    }
  return out;
}

/// Largest errors of distances over a family, as shares of the stated bound and of the target.
struct Worst {
  double of_bound = 0.0;
  double of_target = 0.0;
  std::size_t together = 0;
};

/// Checks the documented error of distances: 28 half ulps of the largest coordinate difference plus 16 half ulps of
/// the distance, if the square of the distance is a normal double.
void check_distance(const Triangle& p, const Triangle& q, const Float50& exact, Worst& worst) {
  constexpr double half_ulp = 0x1p-53;
  const Float50 size = largest_difference(p, q);
  const double squared = squared_distance(p, q);
  if (exact > ldexp(Float50(1), 511) || exact < ldexp(Float50(1), -510)) {
    EXPECT_TRUE(squared > 0.0);
  } else {
    const Float50 error = abs(sqrt(Float50(squared)) - exact);
    const Float50 bound = half_ulp * (28 * size + 16 * exact), target = half_ulp * (16 * size + 32 * exact);
    EXPECT_LE(error, target) << "more than was ever seen, though less than the bound may be";
    EXPECT_LE(error, bound) << "distance " << exact << ", found " << std::sqrt(squared);
    worst.of_bound = std::max(worst.of_bound, static_cast<double>(error / bound));
    worst.of_target = std::max(worst.of_target, static_cast<double>(error / target));
  }
  const auto [x, y] = closest_points(p, q);
  Float50 between = 0;
  for (int k = 0; k < 3; ++k) between += (Float50(x[k]) - Float50(y[k])) * (Float50(x[k]) - Float50(y[k]));
  EXPECT_LE(abs(sqrt(between) - exact),
            half_ulp * (28 * size + 16 * exact + 8 * far_from_zero(p, q)) + ldexp(Float50(1), -1071));
}

void check_pair(const Triangle& p, const Triangle& q, Random& random, Worst& worst) {
  SCOPED_TRACE(text(p, q));
  const OracleDistance oracle(p, q);
  const bool meet = oracle.meet();
  EXPECT_EQ(closer_than(p, q, 0.0), meet);
  EXPECT_EQ(closer_than(q, p, 0.0), meet);
  EXPECT_EQ(squared_distance(p, q) == 0.0, meet);
  EXPECT_EQ(squared_distance(q, p) == 0.0, meet);
  const detail::ExactTriangles exact({p.a, p.b, p.c}, {q.a, q.b, q.c});
  const double in_whole_numbers = exact.nearest().squared;
  EXPECT_EQ(in_whole_numbers == 0.0, meet);
  worst.together += meet ? 1 : 0;
  if (meet) {
    const auto [x, y] = closest_points(p, q);
    EXPECT_EQ(x, y);
    EXPECT_TRUE(closer_than(p, q, std::abs(random.uniform(-1.0, 1.0))));
    EXPECT_TRUE(closer_than(p, q, 0x1p-1074));
    // A common point, up to the rounding of its coordinates.
    for (const Triangle* t : {&p, &q})
      EXPECT_LE(OracleDistance(*t, {x, x, x}).distance(),
                0x1p-53 * 16 * far_from_zero(p, q) + ldexp(Float50(1), -1071));
    return;
  }
  const Float50 distance = oracle.distance();
  check_distance(p, q, distance, worst);
  if (std::isnormal(in_whole_numbers)) {
    EXPECT_LE(abs(Float50(in_whole_numbers) - distance * distance), 0x1p-51 * distance * distance);
  }
  const auto d = static_cast<double>(distance);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double m : {d, std::nextafter(d, 0.0), std::nextafter(d, infinity), d * (1 + 1e-14), d * (1 - 1e-14),
                         d * random.uniform(0.0, 3.0)}) {
    if (m > std::numeric_limits<double>::max()) continue;
    EXPECT_EQ(closer_than(p, q, m), oracle.below(m)) << "m = " << m << ", d = " << distance;
    EXPECT_EQ(closer_than(q, p, m), oracle.below(m)) << "m = " << m << ", d = " << distance;
  }
  EXPECT_TRUE(closer_than(p, q, infinity));
}

class Families : public testing::TestWithParam<TriangleFamily> {};

TEST_P(Families, EqualExactVerdictsAndDistances) {
  const std::size_t cases = std::getenv("HINGE_TEST_ALL") != nullptr ? 100'000 : 1'000;
  constexpr std::uint64_t seed = 20;
  Random random(seed);
  Worst worst;
  for (std::size_t k = 0; k < cases; ++k) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(k));
    const auto [p, q] = GetParam().make(random);
    check_pair(p, q, random, worst);
    if (HasFailure()) return;
  }
  std::cout << GetParam().name << ": " << worst.together << " of " << cases << " meet; largest error of a distance "
            << worst.of_bound << " of the bound, " << worst.of_target << " of 16 ulp + 8 ulp of the size\n";
}

INSTANTIATE_TEST_SUITE_P(Triangle, Families, testing::ValuesIn(test::triangle_families()),
                         [](const auto& family) { return family.param.name; });

/// Returns the value of `key` in one line of JSON. Numbers are stored as strings and the key's text occurs once.
std::string field(const std::string& line, const std::string& key) {
  const std::size_t start = line.find("\"" + key + "\":");
  if (start == std::string::npos) return "";
  const std::size_t value = start + key.size() + 3;
  return line.substr(value, line.find_first_of(line[value] == '[' ? "]" : ",}", value) - value);
}

Triangle triangle_of(const std::string& list) {
  std::array<double, 9> x{};
  std::size_t at = 0;
  for (double& value : x) {
    at = list.find_first_of("-0123456789", at);
    std::size_t length = 0;
    value = std::stod(list.substr(at), &length);
    at += length;
  }
  return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}};
}

TEST(TriangleFiles, AgreeWithStoredExactAnswers) {
  std::size_t cases = 0;
  Random random(21);
  Worst worst;
  for (const char* name : {"tri_tri.jsonl", "tri_tri_f32.jsonl"}) {
    std::ifstream file(std::string(HINGE_SHARED_DATA) + "/robustness/" + name);
    for (std::string line; std::getline(file, line); ++cases) {
      SCOPED_TRACE(field(line, "id"));
      const Triangle p = triangle_of(field(line, "a")), q = triangle_of(field(line, "b"));
      const bool meet = field(line, "intersect") == "true";
      EXPECT_EQ(OracleDistance(p, q).meet(), meet) << "the oracle";
      const std::string stored = field(line, "dist");
      const double d = std::stod(stored.substr(1));
      EXPECT_EQ(static_cast<double>(OracleDistance(p, q).distance()), d) << "the oracle";
      check_pair(p, q, random, worst);
    }
  }
  if (cases == 0) GTEST_SKIP() << "no files in " << HINGE_SHARED_DATA << "/robustness";
  std::cout << cases << " stored cases, largest error " << worst.of_target << " of 16 ulp + 8 ulp of the size\n";
}

// A component of the normal overflows, so the height of each corner is infinite, with the sign of a term that another
// term outweighs.
TEST(Triangles, MeetWhereANormalOverflows) {
  const double wide = 0x1p-448, low = 0x1p-1048;
  const Triangle large{{0, 0, 0}, {0, 0, -0x1p400}, {0x1p654, 0x1p531, 0}};
  const Triangle small{{wide, low, -1}, {-wide, low, -1}, {-wide, low, -2}};
  const Triangle beside{{-wide, low, -1}, {-2 * wide, low, -1}, {-wide, low, -2}};
  for (const Triangle& other : {small, beside}) {
    const bool meet = OracleDistance(large, other).meet();
    EXPECT_EQ(meet, other.a == small.a);
    for (const auto& [p, q] : {std::pair(large, other), std::pair(other, large)}) {
      EXPECT_EQ(closer_than(p, q, 0.0), meet);
      EXPECT_EQ(distance(p, q) == 0.0, meet);
    }
  }
}

/// Triangles with zero-length sides and radii against the equal spheres and capsules, at contact to the last bit and
/// a few ulps from it. Other tests compare these solids with rationals.
TEST(GrownTriangles, MeetAsTheSolidsTheyAreDo) {
  Random random(47);
  std::size_t touching = 0, hits = 0, cases = 0;
  for (std::size_t k = 0; k < 20'000; ++k) {
    // A distance that is exact in double: along an axis, or a multiple of the vector (3, 4, 0).
    const bool slanted = random.one_in(2);
    const double scale = std::ldexp(1.0, static_cast<int>(random.below(40)) - 20);
    const double t = scale * static_cast<double>(1 + random.below(1'000'000));
    const double distance = slanted ? 5 * t : t;
    const Vec3 p(0, 0, 0), q = slanted ? Vec3(3 * t, 4 * t, 0) : Vec3(t, 0, 0);
    const double m = random.one_in(3) ? distance * random.uniform(0.0, 0.5) : 0.0;
    const double r = (distance - m) * random.uniform(0.0, 1.0);
    double s = distance - m - r;  // accurate to half an ulp
    for (std::size_t n = random.below(4); n > 0; --n) s = std::nextafter(s, random.one_in(2) ? 1e300 : 0.0);
    s = std::max(s, 0.0);
    const RadiusSum reach{r, s, m};
    const bool expected = closer_than(Sphere{p, r}, Sphere{q, s}, m);
    ++cases;
    hits += expected ? 1 : 0;
    touching +=
        expected && m == 0.0 && !detail::exact::balls_closer_than(p, q, {r, s > 0 ? std::nextafter(s, 0.0) : s, 0.0});
    const Vec3 along = Vec3(0, 0, random.uniform(0.1, 2.0) * distance), across = Vec3(-q[1], q[0], 0) * 0.5;
    ASSERT_EQ(closer_than(Triangle{p, p, p}, Triangle{q, q, q}, reach), expected) << k;
    ASSERT_EQ(closer_than(Triangle{q, q, q}, Triangle{p, p, p}, RadiusSum{s, r, m}), expected) << k;
    // The nearest points are still p and q.
    ASSERT_EQ(closer_than(Triangle{p, p, p + along}, Triangle{q, q, q}, reach), expected) << k;
    ASSERT_EQ(closer_than(Capsule{p, p + along, r}, Capsule{q, q, s}, m), expected) << k;
    if (!slanted) {
      const Triangle face{p - along - across, p + along, p - along + across};
      ASSERT_EQ(closer_than(face, Triangle{q, q, q}, reach), expected) << k;
    }
    ASSERT_EQ(closer_than(Triangle{p, p, p}, Triangle{q, q, q}, RadiusSum{0.0, 0.0, distance}), false) << k;
  }
  EXPECT_GT(touching, cases / 20);
  EXPECT_GT(hits, cases / 3);
  EXPECT_LT(hits, cases - cases / 5);
}

}  // namespace triangle_test
}  // namespace hinge

#else
TEST(Triangle, NeedsBoostMultiprecision) { GTEST_SKIP() << "boost/multiprecision was not found (libboost-dev)"; }
#endif
