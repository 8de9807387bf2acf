// SPDX-License-Identifier: BSD-3-Clause
// AnyEngine: a hierarchy with one of the three engines behind functions, compiled once for several test files.
#pragma once

#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::test {

/// The functions of one engine; hierarchies are shared by copies.
template <class P>
struct AnyEngine {
  std::string name;
  std::function<void(std::span<const double>)> update;
  std::function<void(std::span<const Pose>)> update_poses;
  std::function<void(std::span<const P>)> update_placed;
  std::function<bool(const QueryOptions&)> collides;
  std::function<std::vector<Hit>(double margin, const QueryOptions&)> within;
  std::function<std::optional<Hit>(const QueryOptions&)> closest;
  std::function<std::span<const P>()> placed;
};

template <template <class, class, class> class EngineOf, class P, class F, class D>
AnyEngine<P> on_engine(const std::string& name, const Model<P>& model, const F& filter, const D& matrix) {
  const auto h = std::make_shared<Hierarchy<P, F, D, EngineOf>>(model, filter, matrix);
  return {name,
          [h](std::span<const double> q) { h->update(q); },
          [h](std::span<const Pose> poses) { h->update_poses(poses); },
          [h](std::span<const P> placed) { h->update_placed(placed); },
          [h](const QueryOptions& options) { return h->self_collides(options); },
          [h](double margin, const QueryOptions& options) { return h->self_within(margin, options); },
          [h](const QueryOptions& options) { return h->self_closest(options); },
          [h] { return h->placed(); }};
}

/// Returns the three engines; brute force is the first.
template <class P, class F, class D>
std::vector<AnyEngine<P>> on_three_engines(const Model<P>& model, const F& filter, const D& matrix) {
  return {on_engine<Brute>("brute", model, filter, matrix), on_engine<Lazy>("lazy", model, filter, matrix),
          on_engine<Simd>("simd", model, filter, matrix)};
}

/// Returns the three engines for points, with every pair admitted; compiled in three_engines_test.cpp.
std::vector<AnyEngine<Point>> atoms_on_three_engines(const Model<Point>& model, const TypedThresholds& matrix);

/// Returns one type for all atoms, with threshold m.
inline TypedThresholds one_type(std::size_t atoms, double m) { return {std::vector<std::uint16_t>(atoms, 0), 1, {m}}; }

/// Puts each point on its own prismatic joint along x, so that every pair is tested.
inline Model<Point> own_groups(const std::vector<Vec3>& points) {
  ModelBuilder<Point> builder;
  for (const Vec3& x : points) builder.add_link(world, Prismatic{Vec3::UnitX(), {}, {}}, {Point{x}});
  return builder.finish();
}

/// Returns whether tests run at full size (HINGE_TEST_ALL).
inline bool exhaustive() { return std::getenv("HINGE_TEST_ALL") != nullptr; }

}  // namespace hinge::test
