// SPDX-License-Identifier: BSD-3-Clause
// Exact answers in rationals. Compiled without sanitizers, which make it ten times slower.
#include "fuzz/exact_pair.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "primitive/triangle_oracle.hpp"

namespace fuzz {

namespace {

using Rational = boost::multiprecision::cpp_rational;
using hinge::test::OracleDistance;
using Digits = hinge::test::Float50;  // fifty digits

Rational sum(std::initializer_list<double> terms) {
  Rational total = 0;
  for (const double term : terms) total += Rational(term);
  return total;
}

/// Compares |a - b| with a length; returns the sign of the difference. Long doubles decide pairs that are not within
/// 2^-50 of a tie: they hold the squares of all doubles, and each of the few operations is accurate to 2^-64 (x87; on
/// other CPUs rationals decide all pairs).
int compare_distance(const hinge::Vec3& a, const hinge::Vec3& b, std::initializer_list<double> length) {
  using Limits = std::numeric_limits<long double>;
  if constexpr (Limits::digits >= 64 && Limits::max_exponent > 8192) {
    long double square = 0, wanted = 0;
    for (int k = 0; k < 3; ++k) {
      const long double d = static_cast<long double>(a[k]) - static_cast<long double>(b[k]);
      square += d * d;
    }
    for (const double term : length) wanted += static_cast<long double>(term);
    wanted *= wanted;
    const long double apart = square - wanted;
    if (std::abs(apart) > 0x1p-50L * (square + wanted)) return apart < 0 ? -1 : 1;
  }
  Rational square = 0;
  for (int k = 0; k < 3; ++k) {
    const Rational d = Rational(a[k]) - Rational(b[k]);
    square += d * d;
  }
  const Rational wanted = sum(length);
  return square.compare(wanted * wanted);
}

/// Returns true if the distance of the boxes proves that the shapes are farther apart than m.
bool boxes_apart(const hinge::Aabb& a, const hinge::Aabb& b, double m) {
  for (int k = 0; k < 3; ++k)
    for (const long double gap : {static_cast<long double>(a.lower[k]) - static_cast<long double>(b.upper[k]),
                                  static_cast<long double>(b.lower[k]) - static_cast<long double>(a.upper[k])})
      if (gap > static_cast<long double>(m) * (1 + 0x1p-40L)) return true;
  return false;
}

/// Returns the largest double <= x and the smallest double >= x.
std::pair<double, double> enclose(const Rational& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low = x.convert_to<double>();
  while (Rational(low) > x) low = std::nextafter(low, -infinity);
  while (Rational(std::nextafter(low, infinity)) <= x) low = std::nextafter(low, infinity);
  return {low, Rational(low) == x ? low : std::nextafter(low, infinity)};
}

/// Returns whether x is a multiple of 2^-8 below 2^12: squared distances of segments then have denominators below 2^86.
bool on_lattice(double x) { return std::abs(x) < 0x1p12 && x * 0x1p8 == std::floor(x * 0x1p8); }
bool on_lattice(std::initializer_list<hinge::Vec3> points) {
  for (const hinge::Vec3& x : points)
    for (int k = 0; k < 3; ++k)
      if (!on_lattice(x[k])) return false;
  return true;
}

// The cores of points, spheres and capsules as triangles without area, and the radii that inflate them.
hinge::Triangle core_of(const hinge::Point& p) { return {p.position, p.position, p.position}; }
hinge::Triangle core_of(const hinge::Sphere& s) { return {s.center, s.center, s.center}; }
hinge::Triangle core_of(const hinge::Capsule& c) { return {c.a, c.b, c.b}; }
hinge::Triangle core_of(const hinge::Triangle& t) { return t; }
double radius_of(const hinge::Point&) { return 0.0; }
double radius_of(const hinge::Sphere& s) { return s.radius; }
double radius_of(const hinge::Capsule& c) { return c.radius; }
double radius_of(const hinge::Triangle&) { return 0.0; }

template <class P>
bool is_right(const P& p, const P& q, double reported) {
  const hinge::Triangle a = core_of(p), b = core_of(q);
  hinge::Aabb box = a.bounds();
  box.extend(b.bounds());
  double extent = radius_of(p) + radius_of(q);
  for (int k = 0; k < 3; ++k) extent = std::max(extent, box.upper[k] - box.lower[k]);
  if (extent == 0.0) return reported == 0.0;
  if (!(extent < 0x1p480 && extent > 0x1p-440)) return true;
  Digits exact = OracleDistance(a, b).distance() - (Digits(radius_of(p)) + Digits(radius_of(q)));
  if (exact < 0) exact = 0;
  return abs(Digits(reported) - exact) <= Digits(64 * 0x1p-53 * extent);
}

}  // namespace

std::optional<bool> exactly_closer(const hinge::Point& p, const hinge::Point& q, double m) {
  return m > 0.0 && compare_distance(p.position, q.position, {m}) < 0;
}

std::optional<bool> exactly_closer(const hinge::Sphere& p, const hinge::Sphere& q, double m) {
  return compare_distance(p.center, q.center, {p.radius, q.radius, m}) < 0 ||
         compare_distance(p.center, q.center, {p.radius, q.radius}) <= 0;
}

std::optional<bool> exactly_closer(const hinge::Triangle& p, const hinge::Triangle& q, double m) {
  if (boxes_apart(p.bounds(), q.bounds(), m)) return false;
  const OracleDistance exact(p, q);
  return exact.meet() || exact.below(m);
}

std::optional<bool> exactly_closer(const hinge::Capsule& p, const hinge::Capsule& q, double m) {
  const hinge::Triangle a = core_of(p), b = core_of(q);
  if (boxes_apart(a.bounds(), b.bounds(), p.radius + q.radius + m)) return false;
  const OracleDistance exact(a, b);
  if (exact.meet()) return true;
  // The oracle compares with doubles, so each sum is enclosed by two doubles.
  const Rational touch = sum({p.radius, q.radius});
  const auto [near, above_near] = enclose(touch + Rational(m));
  const auto [at, above] = enclose(touch);
  if (exact.below(near) || exact.below(at)) return true;
  if (exact.below(above_near)) return {};
  // The pair is not closer than m: check whether it touches.
  if (!exact.below(std::nextafter(above, std::numeric_limits<double>::infinity()))) return false;
  const bool points = p.a == p.b && q.a == q.b;
  if (points) return compare_distance(p.a, q.a, {p.radius, q.radius}) <= 0;
  // For coordinates on the lattice, a distance equals `at` or differs from it by more than 2^-128 (relative), so fifty
  // digits decide.
  if (at != above || !on_lattice({p.a, p.b, q.a, q.b}) || !on_lattice(at)) return {};
  return abs(exact.distance() - Digits(at)) < Digits(0x1p-140) * Digits(at);
}

bool distance_is_right(const hinge::Point& p, const hinge::Point& q, double d) { return is_right(p, q, d); }
bool distance_is_right(const hinge::Sphere& p, const hinge::Sphere& q, double d) { return is_right(p, q, d); }
bool distance_is_right(const hinge::Capsule& p, const hinge::Capsule& q, double d) { return is_right(p, q, d); }
bool distance_is_right(const hinge::Triangle& p, const hinge::Triangle& q, double d) { return is_right(p, q, d); }

}  // namespace fuzz
