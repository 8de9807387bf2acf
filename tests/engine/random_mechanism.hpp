// SPDX-License-Identifier: BSD-3-Clause
// Random articulated models with random filters and matrices, for property tests of engines.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/model/model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"

namespace hinge::test {

/// A seeded generator; vector(s) has components in -s .. s, pose(s) any rotation and such a translation. A seed gives
/// the same numbers with every compiler: no argument list draws twice, because compilers evaluate arguments in any
/// order.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  Vec3 vector(double size) {
    const double x = uniform(-size, size), y = uniform(-size, size), z = uniform(-size, size);
    return {x, y, z};
  }
  Pose pose(double size) {
    Pose pose;
    const double angle = uniform(-std::numbers::pi, std::numbers::pi);
    pose.rotation = rotation_about(Vec3(vector(1.0).normalized()), angle);
    pose.translation = vector(size);
    return pose;
  }

 private:
  std::mt19937_64 engine_;
};

/// A list of excluded pairs, the most general filter.
class ExcludedPairs {
 public:
  /// `lists` holds the excluded partners of each primitive; each pair is in both lists.
  explicit ExcludedPairs(std::vector<std::vector<PrimitiveId>> lists) : excluded_(std::move(lists)) { sort(); }
  ExcludedPairs(std::size_t n, Random& random, std::size_t one_in) : excluded_(n) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (random.one_in(one_in)) {
          excluded_[i].push_back(id<PrimitiveId>(j));
          excluded_[j].push_back(id<PrimitiveId>(i));
        }
    sort();
  }
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    return !std::binary_search(excluded_[index(i)].begin(), excluded_[index(i)].end(), j);
  }
  std::span<const PrimitiveId> excluded(PrimitiveId i) const noexcept {
    return lists_ ? std::span<const PrimitiveId>(excluded_[index(i)]) : std::span<const PrimitiveId>();
  }
  std::size_t size() const noexcept { return excluded_.size(); }
  /// Makes excluded() empty: engines must call admits() for every pair. own_filter_test has types without lists.
  void list_nothing() noexcept { lists_ = false; }

 private:
  void sort() {
    for (auto& list : excluded_) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }
  std::vector<std::vector<PrimitiveId>> excluded_;
  bool lists_ = true;
};

static_assert(ListsExclusions<ExcludedPairs>);

/// The same exclusions without lists: engines must call admits() for every pair.
struct UnlistedPairs {
  ExcludedPairs pairs;
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return pairs.admits(i, j); }
};

static_assert(PairFilter<UnlistedPairs> && !ListsExclusions<UnlistedPairs>);

/// Thresholds for n primitives of three random types; about one entry in five is 0.
inline TypedThresholds random_thresholds(std::size_t n, Random& random) {
  constexpr std::size_t types = 3;
  std::vector<std::uint16_t> type(n);
  for (auto& t : type) t = static_cast<std::uint16_t>(random.below(types));
  std::vector<double> table(types * types);
  for (std::size_t s = 0; s < types; ++s)
    for (std::size_t t = 0; t <= s; ++t)
      table[s * types + t] = table[t * types + s] = random.one_in(5) ? 0.0 : random.uniform(0.0, 2.0);
  return {std::move(type), types, std::move(table)};
}

/// A random tree of up to `links` links with up to `per_link` primitives each. make(random, axis, point) returns one
/// primitive in the link's frame, sometimes on the joint axis (direction `axis`, through `point`).
template <class Make>
auto random_model(Random& random, std::size_t links, std::size_t per_link, bool basic_groups, const Make& make) {
  using P = decltype(make(random, Vec3(), Vec3()));
  ModelBuilder<P> builder;
  std::vector<LinkId> all{world};
  std::vector<std::uint32_t> labels;
  for (std::size_t l = random.below(links + 1); l-- > 0;) {
    const Vec3 axis = random.vector(1.0).normalized(), point = random.vector(3.0);
    std::vector<P> primitives;
    for (std::size_t k = random.below(per_link + 1); k-- > 0;) {
      primitives.push_back(make(random, axis, point));
      labels.push_back(static_cast<std::uint32_t>(random.below(20)));
    }
    Pose origin;
    if (random.one_in(2)) origin = random.pose(2.0);
    const LinkId parent = all[random.below(all.size())];
    Joint joint = Revolute{axis, point, origin, {}};
    if (random.one_in(5)) joint = Prismatic{axis, origin, {}};
    if (random.one_in(6)) joint = Fixed{origin};
    all.push_back(builder.add_link(parent, joint, primitives));
  }
  if (basic_groups && !labels.empty()) builder.set_basic_groups(labels);
  return builder.finish();
}

/// About two thirds of the DOF of `tree`.
inline DofSelection random_selection(const KinematicTree& tree, Random& random) {
  std::vector<DofId> free;
  for (std::size_t k = 0; k < tree.dof_count(); ++k)
    if (!random.one_in(3)) free.push_back(id<DofId>(k));
  return {tree, std::move(free)};
}

}  // namespace hinge::test
