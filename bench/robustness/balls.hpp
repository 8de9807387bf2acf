// SPDX-License-Identifier: BSD-3-Clause
// Pairs of atoms and balls at and near a tie: Hinge, one comparison in double, and FCL against exact rationals.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "peers/fcl_triangles.hpp"
#include "robustness/plain_point.hpp"

namespace hinge::bench {

/// Two balls or atoms and a threshold.
struct BallPair {
  Vec3 p, q;
  double r, s;  ///< radii; as atoms, the pair collides if the distance is below m
  double m;
};

/// Two points of the grid of PDB files (0.001 angstrom), within `extent` angstrom, whose distance is a whole number
/// of thousandths. In exact decimals, radii and threshold are equal to the distance.
inline BallPair decimal_tie(test::Random& random, std::size_t extent) {
  std::int64_t a = 0, b = 0, c = 0, d = 0;
  while (d < 2400 || d > 3600) {  // 2.4 to 3.6 angstrom, the usual thresholds of atoms
    const auto draw = [&] { return static_cast<std::int64_t>(random.below(56)); };
    const std::int64_t k = draw(), l = draw(), m = draw(), n = draw();
    a = k * k + l * l - m * m - n * n;
    b = 2 * (k * n + l * m);
    c = 2 * (l * n - k * m);
    d = k * k + l * l + m * m + n * n;
  }
  const auto thousandths = [](std::int64_t x) { return static_cast<double>(x) / 1000.0; };
  const std::int64_t range = 2000 * static_cast<std::int64_t>(extent);
  std::array<std::int64_t, 3> at{};
  for (std::int64_t& x : at) x = static_cast<std::int64_t>(random.below(static_cast<std::size_t>(range))) - range / 2;
  const auto part = static_cast<std::int64_t>(random.below(static_cast<std::size_t>(d)));
  return {Vec3(thousandths(at[0]), thousandths(at[1]), thousandths(at[2])),
          Vec3(thousandths(at[0] + a), thousandths(at[1] + b), thousandths(at[2] + c)), thousandths(part),
          thousandths(d - part), thousandths(d)};
}

/// The threshold is the distance in double, or up to two ulps from it.
inline BallPair beside_tie(test::Random& random, double size) {
  BallPair pair{random.vector(100 * size), Vec3::Zero(), 0.0, 0.0, 0.0};
  pair.q = pair.p + random.vector(2 * size);
  const Vec3 apart = pair.p - pair.q;
  pair.m = std::hypot(apart[0], apart[1], apart[2]);
  const double toward = random.one_in(2) ? 0.0 : 2 * pair.m;
  for (std::size_t steps = random.below(3); steps-- > 0;) pair.m = std::nextafter(pair.m, toward);
  pair.r = random.uniform(0.0, 1.0) * pair.m;
  pair.s = pair.m - pair.r;
  return pair;
}

/// Counts wrong decisions of each contestant on `cases` pairs per family.
inline std::vector<Json> run_balls(std::size_t cases) {
  using Rational = boost::multiprecision::cpp_rational;
  struct Family {
    const char* name;
    BallPair (*make)(test::Random&);
  };
  constexpr Family families[] = {{"decimal tie, within 100", [](test::Random& r) { return decimal_tie(r, 100); }},
                                 {"decimal tie, within 10 000", [](test::Random& r) { return decimal_tie(r, 10'000); }},
                                 {"within two ulps of a tie", [](test::Random& r) { return beside_tie(r, 1.0); }},
                                 {"the same, times 2^-540", [](test::Random& r) { return beside_tie(r, 0x1p-540); }},
                                 {"the same, times 2^540", [](test::Random& r) { return beside_tie(r, 0x1p540); }}};
  std::vector<Json> rows;
  std::uint64_t number = 100;
  for (const Family& family : families) {
    test::Random random(robustness_seed + number++);
    std::size_t below = 0, touching = 0, point = 0, plain_point = 0, sphere = 0, plain_sphere = 0, fcl = 0;
    for (std::size_t k = 0; k < cases; ++k) {
      const BallPair pair = family.make(random);
      Rational squared = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Rational d = Rational(pair.p[axis]) - Rational(pair.q[axis]);
        squared += d * d;
      }
      const Rational m = Rational(pair.m), reach = Rational(pair.r) + Rational(pair.s);
      const bool is_below = squared < m * m, is_touching = squared <= reach * reach;
      const auto wrong = [](bool said, bool truth) -> std::size_t { return said != truth ? 1 : 0; };
      below += is_below ? 1 : 0;
      touching += is_touching ? 1 : 0;
      point += wrong(closer_than(Point{pair.p}, Point{pair.q}, pair.m), is_below);
      plain_point += wrong(closer_than(PlainPoint{{pair.p}}, PlainPoint{{pair.q}}, pair.m), is_below);
      sphere += wrong(closer_than(Sphere{pair.p, pair.r}, Sphere{pair.q, pair.s}, 0.0), is_touching);
      const double touch = pair.r + pair.s;
      plain_sphere += wrong(squared_norm(Vec3(pair.p - pair.q)) <= touch * touch, is_touching);
      fcl +=
          wrong(fcl_balls_collide({pair.p[0], pair.p[1], pair.p[2]}, pair.r, {pair.q[0], pair.q[1], pair.q[2]}, pair.s),
                is_touching);
    }
    rows.push_back({{"kind", "balls"},
                    {"family", family.name},
                    {"pairs", cases},
                    {"below", below},
                    {"touching", touching},
                    {"point", point},
                    {"plain_point", plain_point},
                    {"sphere", sphere},
                    {"plain_sphere", plain_sphere},
                    {"fcl", fcl}});
  }
  return rows;
}

}  // namespace hinge::bench
