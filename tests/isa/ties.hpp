// SPDX-License-Identifier: BSD-3-Clause
// Scenes with many exact ties and pairs one ulp from a tie. Coordinates are integers of a grid, moved by integers along
// the axes, so neither rounding nor contraction changes them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hinge/hierarchy.hpp"
#include "isa/mechanism.hpp"

namespace hinge::isa {

/// Binary: multiples of 1/8, where d = M can hold exactly. Decimal: multiples of 1/10 as in PDB files, where ties hold
/// only on paper and stored values are on either side.
enum class Grid : std::uint8_t { binary, decimal };

inline double grid_value(Grid grid, std::int64_t k) {
  return grid == Grid::binary ? static_cast<double>(k) * 0.125 : static_cast<double>(k) / 10.0;
}
inline double grid_value(Grid grid, Random& random, std::size_t below) {
  return grid_value(grid, static_cast<std::int64_t>(random.below(below)) - static_cast<std::int64_t>(below / 2));
}
inline Vec3 grid_point(Grid grid, Random& random, std::size_t below) {
  Vec3 v;
  for (int k = 0; k < 3; ++k) v[k] = grid_value(grid, random, below);
  return v;
}

inline Point tied(Grid grid, Random& random, const Point*) { return {grid_point(grid, random, 33)}; }
inline Sphere tied(Grid grid, Random& random, const Sphere*) {
  const Vec3 center = grid_point(grid, random, 33);
  return {center, grid_value(grid, static_cast<std::int64_t>(random.below(5)))};
}
inline Capsule tied(Grid grid, Random& random, const Capsule*) {
  const Vec3 a = grid_point(grid, random, 33);
  const Vec3 b = random.below(3) == 0 ? a : Vec3(a + grid_point(grid, random, 9));
  return {a, b, grid_value(grid, static_cast<std::int64_t>(random.below(4)))};
}
inline Triangle tied(Grid grid, Random& random, const Triangle*) {
  const Vec3 a = grid_point(grid, random, 33), by = grid_point(grid, random, 9);
  return {a, Vec3(a + by), Vec3(a + grid_point(grid, random, 9))};
}

/// Returns a triangle with integer corners, and a second one with a corner on its face or edge: at u a + v b + w c with
/// u + v + w = 2^20, in units of 2^-20, so exact. Every second one is then moved by an ulp.
inline std::pair<Triangle, Triangle> touching(Random& random) {
  constexpr std::int64_t whole = std::int64_t{1} << 20;
  const auto draw = [&] { return static_cast<std::int64_t>(random.below(4096)) - 2048; };
  std::int64_t corner[3][3];
  for (auto& c : corner)
    for (std::int64_t& x : c) x = draw();
  const auto u = static_cast<std::int64_t>(random.below(whole));
  const auto v = random.below(4) == 0 ? whole - u : static_cast<std::int64_t>(random.below(whole)) % (whole - u + 1);
  const std::int64_t share[3] = {u, v, whole - u - v};
  Vec3 at, away;
  for (int k = 0; k < 3; ++k) {
    std::int64_t sum = 0;
    for (int c = 0; c < 3; ++c) sum += share[c] * corner[c][k];
    at[k] = std::ldexp(static_cast<double>(sum), -30);
    away[k] = std::ldexp(static_cast<double>(draw()), -10);
  }
  if (random.below(2) == 0) {
    const int k = static_cast<int>(random.below(3));
    at[k] = std::nextafter(at[k], random.below(2) == 0 ? 8.0 : -8.0);
  }
  const auto point = [&](int c) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = std::ldexp(static_cast<double>(corner[c][k]), -10);
    return p;
  };
  Vec3 second;
  for (int k = 0; k < 3; ++k) second[k] = std::ldexp(static_cast<double>(draw()), -10);
  return {{point(0), point(1), point(2)}, {at, away, second}};
}

/// The world and a chain of three links that slide along x, y and z.
template <class P>
Model<P> tied_model(Grid grid, Random& random, std::size_t each) {
  ModelBuilder<P> builder;
  LinkId link = world;
  const P* kind = nullptr;
  for (int l = 0; l < 4; ++l) {
    if (l > 0) link = builder.add_link(link, Prismatic{Vec3(Vec3::Unit(l - 1)), {}, {}});
    for (std::size_t k = 0; k < each; ++k) builder.add_primitive(link, tied(grid, random, kind));
  }
  return builder.finish();
}

/// The same links; one triangle of each pair is on the world, the other on the last link. They touch at the reference.
inline Model<Triangle> touching_model(Random& random, std::size_t pairs) {
  ModelBuilder<Triangle> builder;
  std::vector<Triangle> others;
  for (std::size_t k = 0; k < pairs; ++k) {
    const auto [p, q] = touching(random);
    builder.add_primitive(world, p);
    others.push_back(q);
  }
  LinkId link = world;
  for (int l = 0; l < 3; ++l) link = builder.add_link(link, Prismatic{Vec3(Vec3::Unit(l)), {}, {}});
  for (const Triangle& q : others) builder.add_primitive(link, q);
  return builder.finish();
}

/// Thresholds on the grid or one ulp from it.
inline TypedThresholds tied_thresholds(Grid grid, std::size_t n, Random& random) {
  constexpr std::size_t types = 6;
  std::vector<std::uint16_t> type(n);
  for (auto& t : type) t = static_cast<std::uint16_t>(random.below(types));
  std::vector<double> table(types * types);
  for (std::size_t s = 0; s < types; ++s)
    for (std::size_t t = 0; t <= s; ++t) {
      const double m = grid_value(grid, static_cast<std::int64_t>(3 + random.below(10)));
      const std::size_t where = random.below(3);
      table[s * types + t] = table[t * types + s] = where == 0 ? m : std::nextafter(m, where == 1 ? 0.0 : 9.0);
    }
  return {std::move(type), types, std::move(table)};
}

/// Runs all queries at configurations on the grid, near the reference, where touching pairs almost touch.
template <class P, class F, class D, template <class, class, class> class EngineOf>
Answers tied_answers_of(std::uint64_t seed, Grid grid, const Model<P>& model, const F& filter, const D& matrix,
                        int configurations) {
  Random random(seed);
  Answers answers;
  Hierarchy<P, F, D, EngineOf> h(model, filter, matrix);
  auto other = h;
  std::vector<double> q(h.dof_count());
  for (int step = 0; step < configurations; ++step) {
    for (double& value : q) value = step == 0 ? 0.0 : grid_value(grid, random, 9);
    h.update(q);
    ask(h, other, {}, {}, answers);
    answers.add_pairs(h.self_within(grid_value(grid, static_cast<std::int64_t>(random.below(4)))));
    if (step % 3 == 2) other.update(q);
  }
  return answers;
}

}  // namespace hinge::isa
