// SPDX-License-Identifier: BSD-3-Clause
// Points, spheres and capsules against exact rationals: collision decisions without tolerance, distances within the
// stated bounds.
// This file is compiled a second time with fused multiply-adds allowed, which must not change any answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/exact/balls.hpp"
#include "hinge/detail/exact/segments.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"

#if __has_include(<boost/multiprecision/cpp_int.hpp>)
#include "primitive/solid_oracle.hpp"

namespace hinge {
namespace exact_solids_test {

using test::Random;
using test::SolidOracle;
using Float50 = SolidOracle::Float50;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double half_ulp = 0x1p-53;
constexpr std::uint64_t seed = 31;

#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t most_cases = 10'000;  // AddressSanitizer is ten times slower
#else
constexpr std::size_t most_cases = 100'000;
#endif

std::size_t cases() { return std::getenv("HINGE_TEST_ALL") != nullptr ? most_cases : 1'000; }

double stepped(double x, int ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, infinity);
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -infinity);
  return x;
}

int some_ulps(Random& r) { return static_cast<int>(r.below(5)) - 2; }

// --- pairs of points, as (p, q) ---

using Points = std::pair<Vec3, Vec3>;
struct PointFamily {
  std::string name;
  std::function<Points(Random&)> make;
};

/// A vector of integers whose length is an integer.
Vec3 quadruple(Random& r) {
  // Lebesgue: (m^2 + n^2 - p^2 - q^2, 2 (m q + n p), 2 (n q - m p)) has the length m^2 + n^2 + p^2 + q^2.
  const auto one = [&r] { return static_cast<double>(r.below(1000)) - 500.0; };
  const double m = one(), n = one(), p = one(), q = one();
  return {m * m + n * n - p * p - q * q, 2 * (m * q + n * p), 2 * (n * q - m * p)};
}

Vec3 whole(Random& r, std::size_t below) {
  const auto one = [&] { return static_cast<double>(r.below(below)); };
  const double x = one(), y = one(), z = one();
  return {x, y, z};
}

Vec3 any_doubles(Random& r, int low, int high) {
  Vec3 x;
  for (int k = 0; k < 3; ++k) {
    const int exponent = low + static_cast<int>(r.below(static_cast<std::size_t>(high - low)));
    x[k] = r.one_in(5) ? 0.0 : std::ldexp(r.uniform(-1.0, 1.0), exponent);
  }
  return x;
}

Points scaled(const Points& s, int exponent) {
  const double f = std::ldexp(1.0, exponent);
  return {s.first * f, s.second * f};
}

Points generic(Random& r) {
  const Vec3 p = r.vector(4.0);
  return {p, r.vector(4.0)};
}

Points far_away(Random& r, double size) {
  const Vec3 p = r.vector(size), by = r.vector(4.0);
  return {p, p + by};
}

std::vector<PointFamily> point_families() {
  return {{"generic", generic},
          {"far_1e3", [](Random& r) { return far_away(r, 1e3); }},
          {"far_1e9", [](Random& r) { return far_away(r, 1e9); }},
          {"far_1e15", [](Random& r) { return far_away(r, 1e15); }},
          {"binary_ties",
           [](Random& r) {
             const Vec3 p = whole(r, 1000), d = quadruple(r);
             return scaled({p, p + d}, static_cast<int>(r.below(60)) - 30);
           }},
          {"lattice",
           [](Random& r) {
             const Vec3 p = whole(r, 8);
             return Points{p, whole(r, 8)};
           }},
          {"coincident",
           [](Random& r) {
             const Vec3 p = r.vector(100.0);
             Vec3 q = p;
             if (!r.one_in(3)) q[static_cast<int>(r.below(3))] = stepped(q[0], some_ulps(r));
             return Points{p, r.one_in(3) ? p : q};
           }},
          {"decimal_grid",
           [](Random& r) {
             const Vec3 p = whole(r, 20'000), q = p + whole(r, 4000);
             return Points{p / 1000.0, q / 1000.0};
           }},
          {"overflow", [](Random& r) { return scaled(generic(r), 500 + static_cast<int>(r.below(520))); }},
          {"underflow", [](Random& r) { return scaled(generic(r), -400 - static_cast<int>(r.below(400))); }},
          {"denormals", [](Random& r) { return scaled(generic(r), -1022 - static_cast<int>(r.below(52))); }},
          {"any_doubles", [](Random& r) {
             const int low = r.one_in(2) ? -1073 : -300;
             const Vec3 p = any_doubles(r, low, 1020);
             return Points{p, any_doubles(r, low, 1020)};
           }}};
}

// --- radii, and segments around the points ---

/// Radii for centres at distance `between`: both 0, of any size, or with a sum within about two ulps of the distance.
std::array<double, 2> radii(Random& r, double between) {
  const std::size_t kind = r.below(6);
  if (kind == 0 || !(between <= std::numeric_limits<double>::max() / 4)) return {0.0, 0.0};
  if (kind == 1) return {between * r.uniform(0.0, 0.7), between * r.uniform(0.0, 0.7)};
  if (kind == 2) return {0.0, std::abs(stepped(between, some_ulps(r)))};
  const double first = between * r.uniform(0.0, 1.0) * (kind == 3 ? 1e-10 : 1.0);
  return {first, std::max(0.0, stepped(between - first, some_ulps(r)))};
}

struct CapsuleFamily {
  std::string name;
  std::function<std::array<Vec3, 4>(Random&)> make;
};

std::array<Vec3, 4> ends(Random& r, const std::function<Vec3(Random&)>& one) {
  const Vec3 a = one(r), b = one(r), c = one(r);
  return {a, b, c, one(r)};
}

std::array<Vec3, 4> scaled(const std::array<Vec3, 4>& x, int exponent) {
  const double f = std::ldexp(1.0, exponent);
  return {x[0] * f, x[1] * f, x[2] * f, x[3] * f};
}

std::array<Vec3, 4> lattice_ends(Random& r) {
  return ends(r, [](Random& s) { return whole(s, 6); });
}

/// Segments on one line, parallel to each other, or nearly parallel.
std::array<Vec3, 4> parallel_ends(Random& r, double apart, double turn) {
  const Vec3 a = whole(r, 16), way = whole(r, 16) + Vec3(1, 0, 0), by = Vec3(r.vector(1.0) * apart);
  const auto at = [&r] { return static_cast<double>(r.below(17)) / 4.0 - 2.0; };
  const Vec3 c = a + by + way * at();
  return {a, a + way, c, c + way * at() + r.vector(1.0) * turn};
}

/// An inner point of one segment coincides with one of the other, exactly or up to rounding.
std::array<Vec3, 4> crossing_ends(Random& r) {
  if (r.one_in(2)) {
    const Vec3 at = whole(r, 64), u = whole(r, 16), v = whole(r, 16);
    return {at - u, at + u * 3.0, at - v * 2.0, at + v};
  }
  const Vec3 at = r.vector(1.0), u = r.vector(1.0), v = r.vector(1.0);
  return {at - u * r.uniform(0.0, 1.0), at + u, at - v * r.uniform(0.0, 1.0), at + v};
}

std::vector<CapsuleFamily> capsule_families() {
  const auto generic_ends = [](Random& r) { return ends(r, [](Random& s) { return s.vector(2.0); }); };
  return {
      {"generic", generic_ends},
      {"lattice", lattice_ends},
      {"crossing", crossing_ends},
      {"parallel", [](Random& r) { return parallel_ends(r, r.one_in(2) ? 1.0 : 0.0, 0.0); }},
      {"near_parallel",
       [](Random& r) {
         return parallel_ends(r, std::pow(10.0, r.uniform(-12.0, 0.0)), std::pow(10.0, r.uniform(-15.0, -1.0)));
       }},
      {"degenerate",
       [generic_ends](Random& r) {
         auto x = r.one_in(2) ? lattice_ends(r) : generic_ends(r);
         x[1] = x[0];
         if (r.one_in(2)) x[3] = x[2];
         if (r.one_in(4)) x[2] = x[0];
         return x;
       }},
      {"shared_end",
       [generic_ends](Random& r) {
         auto x = generic_ends(r);
         x[3] = x[0];
         return x;
       }},
      {"far_1e6",
       [generic_ends](Random& r) {
         auto x = generic_ends(r);
         const Vec3 by = r.vector(1e6);
         for (Vec3& end : x) end += by;
         return x;
       }},
      {"mixed_size",
       [generic_ends](Random& r) {
         auto x = generic_ends(r);
         const double f = std::pow(10.0, r.uniform(0.0, 9.0));
         x[1] = x[0] + (x[1] - x[0]) * f;
         return x;
       }},
      {"overflow", [generic_ends](Random& r) { return scaled(generic_ends(r), 150 + static_cast<int>(r.below(870))); }},
      {"underflow",
       [generic_ends](Random& r) {
         return scaled(r.one_in(2) ? crossing_ends(r) : generic_ends(r), -140 - static_cast<int>(r.below(930)));
       }},
      {"any_doubles", [](Random& r) {
         const int low = r.one_in(2) ? -1073 : -300;
         return ends(r, [low](Random& s) { return any_doubles(s, low, 1020); });
       }}};
}

// --- checks ---

/// The documented error bound of distances, in half ulps of three lengths: the largest coordinate difference, the
/// distance of centres or axes, and the gap.
struct Bound {
  double size, between, gap;
};
Bound bound(const Point&) { return {0, 0, 4}; }
Bound bound(const Sphere&) { return {8, 0, 10}; }
Bound bound(const Capsule&) { return {28, 17, 2}; }

bool last_rung(const Point& p, const Point& q, double m) {
  return detail::exact::points_closer_than(p.position, q.position, m);
}
bool last_rung(const Sphere& p, const Sphere& q, double m) {
  return detail::exact::balls_closer_than(p.center, q.center, {p.radius, q.radius, m});
}
bool last_rung(const Capsule& p, const Capsule& q, double m) {
  return detail::exact::segments_closer_than(p.a, p.b, q.a, q.b, {p.radius, q.radius, m});
}
double last_distance(const Point& p, const Point& q) {
  return detail::exact::squared_gap_of_balls(p.position, q.position, {});
}
double last_distance(const Sphere& p, const Sphere& q) {
  return detail::exact::squared_gap_of_balls(p.center, q.center, {p.radius, q.radius, 0.0});
}
double last_distance(const Capsule& p, const Capsule& q) {
  return detail::exact::nearest_of_segments(p.a, p.b, q.a, q.b, {p.radius, q.radius, 0.0}).squared_gap;
}

std::string text(const Vec3& v) {
  std::array<char, 120> digits;
  std::snprintf(digits.data(), digits.size(), "(%a, %a, %a) ", v[0], v[1], v[2]);
  return digits.data();
}
std::string text(const Point& p) { return text(p.position); }
std::string text(const Sphere& p) { return text(p.center) + text(Vec3(p.radius, 0, 0)); }
std::string text(const Capsule& p) { return text(p.a) + text(p.b) + text(Vec3(p.radius, 0, 0)); }

struct Worst {
  double of_bound = 0.0, of_target = 0.0;
  std::size_t together = 0, ties = 0;
};

template <class P>
void check_distance(const P& p, const P& q, const SolidOracle& oracle, Worst& worst) {
  const bool meet = oracle.meet();
  for (const double squared : {squared_distance(p, q), squared_distance(q, p), last_distance(p, q)})
    EXPECT_EQ(squared == 0.0, meet);
  if (meet) return;
  const Float50 gap = oracle.gap(), size = oracle.largest_difference();
  if (gap > ldexp(Float50(1), 511)) {
    EXPECT_GT(squared_distance(p, q), 0x1p1021);
  } else if (gap < ldexp(Float50(1), -510)) {
    EXPECT_LT(squared_distance(p, q), 0x1p-1019);
  } else {
    const Bound b = bound(p);
    const Float50 stated = half_ulp * (b.size * size + b.between * oracle.between() + b.gap * gap);
    const Float50 target = half_ulp * (16 * size + 32 * gap);
    const Float50 error = abs(Float50(std::sqrt(squared_distance(p, q))) - gap);
    EXPECT_LE(error, stated) << gap;
    EXPECT_LE(error, target) << "more than was ever seen, though less than the bound may be";
    worst.of_bound = std::max(worst.of_bound, static_cast<double>(error / stated));
    worst.of_target = std::max(worst.of_target, static_cast<double>(error / target));
    EXPECT_LE(abs(Float50(std::sqrt(last_distance(p, q))) - gap), 11 * half_ulp * gap);
  }
}

template <class P>
void check_pair(const P& p, const P& q, Random& random, Worst& worst) {
  SCOPED_TRACE(text(p) + "and " + text(q));
  const SolidOracle oracle(p, q);
  constexpr bool solid = !std::is_same_v<P, Point>;
  const bool meet = oracle.meet();
  worst.together += meet ? 1 : 0;
  for (const bool verdict : {closer_than(p, q, 0.0), closer_than(q, p, 0.0), last_rung(p, q, 0.0)})
    EXPECT_EQ(verdict, solid && meet);
  const auto gap = static_cast<double>(oracle.gap());
  std::vector<double> thresholds{0x1p-1074, random.uniform(0.0, 4.0)};
  if (gap > 0.0)
    for (int k = -3; k <= 3; ++k) thresholds.push_back(stepped(gap, k));
  thresholds.push_back(std::abs(gap) * (1 + 1e-14));
  thresholds.push_back(std::abs(gap) * (1 - 1e-14));
  thresholds.push_back(std::abs(gap) * random.uniform(0.0, 3.0));
  for (const double m : thresholds) {
    if (!(m > 0.0 && m <= std::numeric_limits<double>::max())) continue;
    const bool expected = oracle.below(m);
    for (const bool verdict : {closer_than(p, q, m), closer_than(q, p, m), last_rung(p, q, m)})
      EXPECT_EQ(verdict, expected) << "m = " << m << ", gap " << oracle.gap();
    worst.ties += m == gap && Float50(gap) == oracle.gap() ? 1 : 0;
  }
  EXPECT_TRUE(closer_than(p, q, infinity));
  check_distance(p, q, oracle, worst);
}

template <class Make>
void check_family(const std::string& name, const Make& make, std::size_t count = cases()) {
  Random random(seed);
  Worst worst;
  for (std::size_t k = 0; k < count && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(k));
    const auto [p, q] = make(random);
    check_pair(p, q, random, worst);
  }
  std::cout << name << ": " << worst.together << " of " << count << " meet, " << worst.ties
            << " have a double for their distance; largest error of a distance " << worst.of_bound << " of the bound, "
            << worst.of_target << " of 16 ulp + 8 ulp of the size\n";
}

class PointFamilies : public testing::TestWithParam<PointFamily> {};

TEST_P(PointFamilies, EqualExactVerdictsAndDistances) {
  check_family(GetParam().name, [](Random& r) {
    const auto [p, q] = GetParam().make(r);
    return std::pair(Point{p}, Point{q});
  });
}

TEST_P(PointFamilies, EqualExactVerdictsAndDistancesAsSpheres) {
  check_family(GetParam().name, [](Random& r) {
    const auto [p, q] = GetParam().make(r);
    const auto [s, t] = radii(r, static_cast<double>(SolidOracle(Point{p}, Point{q}).between()));
    return std::pair(Sphere{p, s}, Sphere{q, t});
  });
}

INSTANTIATE_TEST_SUITE_P(Solids, PointFamilies, testing::ValuesIn(point_families()),
                         [](const auto& family) { return family.param.name; });

class CapsuleFamilies : public testing::TestWithParam<CapsuleFamily> {};

TEST_P(CapsuleFamilies, EqualExactVerdictsAndDistances) {
  // Rationals of thousands of digits take milliseconds each.
  const std::size_t count = GetParam().name == "any_doubles" ? std::min<std::size_t>(cases(), 5'000) : cases();
  const auto make = [](Random& r) {
    const auto [a, b, c, d] = GetParam().make(r);
    const SolidOracle axes(Capsule{a, b, 0.0}, Capsule{c, d, 0.0});
    const auto [s, t] = radii(r, static_cast<double>(axes.between()));
    return std::pair(Capsule{a, b, s}, Capsule{c, d, t});
  };
  check_family(GetParam().name, make, count);
}

INSTANTIATE_TEST_SUITE_P(Solids, CapsuleFamilies, testing::ValuesIn(capsule_families()),
                         [](const auto& family) { return family.param.name; });

}  // namespace exact_solids_test
}  // namespace hinge

#else
TEST(Solids, NeedBoostMultiprecision) { GTEST_SKIP() << "boost/multiprecision was not found (libboost-dev)"; }
#endif
