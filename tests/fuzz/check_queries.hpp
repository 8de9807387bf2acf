// SPDX-License-Identifier: BSD-3-Clause
// Runs every query on every engine over a generated scene, and compares the engines with each other and exact
// arithmetic.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "fuzz/answers.hpp"
#include "fuzz/bytes.hpp"
#include "fuzz/exact_pair.hpp"
#include "fuzz/numbers.hpp"
#include "fuzz/require.hpp"
#include "fuzz/scene.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"

namespace fuzz {

/// One model on the three engines; brute force is the reference.
template <class P>
struct Engines {
  template <template <class, class, class> class EngineOf>
  using On = hinge::Hierarchy<P, ExcludedPairs, hinge::TypedThresholds, EngineOf>;

  Engines(const hinge::Model<P>& model, const hinge::DofSelection& selection, const ExcludedPairs& excluded,
          const hinge::TypedThresholds& thresholds)
      : filter(excluded),
        matrix(thresholds),
        brute(model, selection, excluded, thresholds),
        lazy(model, selection, excluded, thresholds),
        simd(model, selection, excluded, thresholds) {}

  template <class F>
  void each(const F& f) {
    f(brute, "brute");
    f(lazy, "lazy");
    f(simd, "simd");
  }
  template <class F>
  void each(Engines& other, const F& f) {
    f(brute, other.brute, "brute");
    f(lazy, other.lazy, "lazy");
    f(simd, other.simd, "simd");
  }

  ExcludedPairs filter;
  hinge::TypedThresholds matrix;
  On<hinge::Brute> brute;
  On<hinge::Lazy> lazy;
  On<hinge::Simd> simd;
};

enum class State : std::uint8_t { configuration, poses, coordinates };

/// Compares the list with the exact verdict of every admitted pair, in order, until the budget of exact verdicts is
/// used. threshold(i, j) and admits(i, j) describe the rules of the query.
template <class P, class Threshold, class Admits>
void check_exactly(std::size_t& budget, const std::vector<hinge::Hit>& hits, double margin, std::span<const P> mine,
                   std::span<const P> theirs, bool self, const Threshold& threshold, const Admits& admits) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < mine.size(); ++i)
    for (std::size_t j = self ? i + 1 : 0; j < theirs.size(); ++j) {
      const bool listed =
          next < hits.size() && hinge::index(hits[next].first) == i && hinge::index(hits[next].second) == j;
      const std::string pair = "pair (" + std::to_string(i) + ", " + std::to_string(j) + ")";
      const double m = threshold(i, j), near = m + margin;
      if (!admits(i, j)) {
        if (listed) find(pair + " is listed though not admitted");
        continue;
      }
      std::optional<bool> truth;
      if (budget > 0) --budget, truth = exactly_closer(mine[i], theirs[j], near);
      if (truth && *truth != listed)
        find(pair + (listed ? " is listed though not" : " is not listed though") + " closer than " + text(near));
      if (!listed) continue;
      const hinge::Hit& hit = hits[next++];
      if (hit.threshold != m) find(pair + " has threshold " + text(hit.threshold) + ", expected " + text(m));
      if (budget == 0) continue;
      --budget;
      if (!distance_is_right(mine[i], theirs[j], hit.distance))
        find(pair + " has a wrong distance " + text(hit.distance));
    }
  require(next == hits.size(), "hits out of order or of no pair");
}

template <class P>
class QueryCheck {
 public:
  explicit QueryCheck(Bytes& bytes) : bytes_(bytes), numbers_(bytes) {}

  void run() {
    const ThresholdTable table(numbers_);
    Engines<P> first = make(table);
    if (bytes_.one_in(3)) first.each([](auto& h, const char*) { h.calibrate_pair_order(); });
    State state = State::configuration;
    check_self(first, state);
    std::optional<Engines<P>> second;
    if (bytes_.bit()) second.emplace(make(table));
    for (int step = 0; step < 3 && !bytes_.empty(); ++step) {
      state = change(first, state);
      check_self(first, state);
      if (!second) continue;
      if (bytes_.one_in(3)) change(*second, State::configuration);
      check_mutual(first, *second);
    }
  }

 private:
  // Enough primitives for several blocks of sixteen, few enough for rational arithmetic.
  static constexpr bool is_quick = std::is_same_v<P, hinge::Point> || std::is_same_v<P, hinge::Sphere>;
  static constexpr std::size_t most = is_quick ? 40 : 18;

  Engines<P> make(const ThresholdTable& table) {
    const hinge::Model<P> model = make_model<P>(numbers_, most);
    const hinge::DofSelection selection = make_selection(model.tree(), bytes_);
    const ExcludedPairs filter(model.size(), bytes_);
    return {model, selection, filter, table.of(model.size(), bytes_)};
  }

  State change(Engines<P>& engines, State state) {
    switch (bytes_.below(4)) {
      case 0: {
        std::vector<hinge::Pose> poses(engines.brute.model().groups()->size());
        for (std::size_t g = 1; g < poses.size(); ++g) poses[g] = make_pose(numbers_);
        engines.each([&](auto& h, const char*) { h.update_poses(poses); });
        return State::poses;
      }
      case 1: {
        std::vector<P> placed(engines.brute.placed().begin(), engines.brute.placed().end());
        for (P& p : placed)
          if (bytes_.one_in(4)) p = make_primitive<P>(numbers_);
        engines.each([&](auto& h, const char*) { h.update_placed(placed); });
        return State::coordinates;
      }
      default: break;
    }
    if (state != State::configuration || q_.size() != engines.brute.dof_count())
      q_.assign(engines.brute.dof_count(), 0.0);
    for (double& value : q_)
      if (bytes_.bit()) value = numbers_.number();
    engines.each([&](auto& h, const char*) { h.update(q_); });
    return State::configuration;
  }

  /// Returns the largest coordinate; nothing if kinematics overflowed.
  static std::optional<double> size_of(std::span<const P> placed) {
    double size = 0.0;
    for (const P& p : placed) {
      const hinge::Aabb box = p.bounds();
      if (!hinge::is_finite(box.lower) || !hinge::is_finite(box.upper)) return {};
      for (int k = 0; k < 3; ++k) size = std::max({size, std::abs(box.lower[k]), std::abs(box.upper[k])});
    }
    return size;
  }
  /// Requires equal bits of coordinates on every engine; returns their size.
  static std::optional<double> placed_alike(Engines<P>& engines) {
    const std::span<const P> reference = engines.brute.placed();
    engines.each([&](auto& h, const char* name) {
      const std::span<const P> placed = h.placed();
      for (std::size_t i = 0; i < placed.size(); ++i) {
        const hinge::Aabb a = reference[i].bounds(), b = placed[i].bounds();
        if (hinge::is_finite(a.lower) && hinge::is_finite(a.upper) && (a.lower != b.lower || a.upper != b.upper))
          find("primitive " + std::to_string(i) + " is placed elsewhere by " + name);
      }
    });
    const std::optional<double> size = size_of(reference);
    return size && *size < 0x1p1005 ? size : std::nullopt;
  }

  std::vector<double> clearances(Engines<P>& engines) {
    std::vector<double> clearance;
    if (bytes_.one_in(4))
      for (std::size_t g = 0; g < engines.brute.model().groups()->size(); ++g) clearance.push_back(numbers_.positive());
    return clearance;
  }

  void check_self(Engines<P>& engines, State state) {
    const std::optional<double> size = placed_alike(engines);
    if (!size) return;
    const std::vector<double> clearance = clearances(engines);
    hinge::QueryOptions options;
    options.clearance = clearance;
    options.moved_only = bytes_.one_in(4);
    const double margin = numbers_.positive();
    double sizes = *size + margin;
    for (const double c : clearance) sizes = std::max(sizes, c);

    Answers all(sizes, "self all"), within(sizes, "self within"), closest(sizes, "self closest");
    engines.each([&](auto& h, const char* name) {
      all.lists(h.self_collisions(options), name);
      within.lists(h.self_within(margin, options), name);
      closest.closest(h.self_closest(options), name);
      all.collides(h.self_collides(options), name);
    });
    if (options.moved_only) return;
    const hinge::SelectedModel<P>& model = engines.brute.model();
    const auto threshold = [&](std::size_t i, std::size_t j) {
      const auto a = hinge::id<hinge::PrimitiveId>(i), b = hinge::id<hinge::PrimitiveId>(j);
      const double m = engines.matrix.threshold(a, b);
      return clearance.empty()
                 ? m
                 : m + (clearance[hinge::index(model.group_of(a))] + clearance[hinge::index(model.group_of(b))]);
    };
    const auto admits = [&](std::size_t i, std::size_t j) {
      const auto a = hinge::id<hinge::PrimitiveId>(i), b = hinge::id<hinge::PrimitiveId>(j);
      if (!engines.filter.admits(a, b)) return false;
      if (state == State::configuration) return !model.constant(a, b);
      return state == State::coordinates || model.group_of(a) != model.group_of(b);
    };
    const std::span<const P> placed = engines.brute.placed();
    check_exactly(budget_, all.list(), 0.0, placed, placed, true, threshold, admits);
    check_exactly(budget_, within.list(), margin, placed, placed, true, threshold, admits);
  }

  void check_mutual(Engines<P>& first, Engines<P>& second) {
    const std::optional<double> size = placed_alike(first), other_size = placed_alike(second);
    if (!size || !other_size) return;
    hinge::QueryOptions options;
    options.moved_only = bytes_.one_in(4);
    const double margin = numbers_.positive(), sizes = *size + *other_size + margin;
    Answers all(sizes, "mutual all"), within(sizes, "mutual within"), closest(sizes, "mutual closest");
    first.each(second, [&](auto& h, auto& other, const char* name) {
      all.lists(h.collisions(other, hinge::AdmitAll{}, options), name);
      within.lists(h.within(other, margin, hinge::AdmitAll{}, options), name);
      closest.closest(h.closest(other, hinge::AdmitAll{}, options), name);
      all.collides(h.collides(other, hinge::AdmitAll{}, options), name);
    });
    if (options.moved_only) return;
    const auto threshold = [&](std::size_t i, std::size_t j) {
      return first.matrix.threshold(hinge::id<hinge::PrimitiveId>(i), second.matrix, hinge::id<hinge::PrimitiveId>(j));
    };
    const auto admits = [](std::size_t, std::size_t) { return true; };
    const std::span<const P> mine = first.brute.placed(), theirs = second.brute.placed();
    check_exactly(budget_, all.list(), 0.0, mine, theirs, false, threshold, admits);
    check_exactly(budget_, within.list(), margin, mine, theirs, false, threshold, admits);
  }

  Bytes& bytes_;
  Numbers numbers_;
  std::size_t budget_ = is_quick ? 4000 : 100;  // exact verdicts; together at most a tenth of a second
  std::vector<double> q_;
};

template <class P>
int check_queries(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  // Numbers on joints may exceed the accepted range.
  accepts([&] { QueryCheck<P>(bytes).run(); });
  return 0;
}

}  // namespace fuzz
