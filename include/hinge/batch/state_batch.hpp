// SPDX-License-Identifier: BSD-3-Clause
// StateBatch: answers up to sixteen neighbouring configurations from one list of pairs.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/batch/configuration_block.hpp"
#include "hinge/detail/batch/displacement_bounds.hpp"
#include "hinge/detail/batch/frame_lanes.hpp"
#include "hinge/detail/batch/list_allowance.hpp"
#include "hinge/detail/batch/near_list.hpp"
#include "hinge/detail/policy/largest_threshold.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/hierarchy.hpp"

namespace hinge {

/// How the configurations of a batch were answered.
struct BatchCounts {
  std::uint64_t in_lanes = 0;  ///< configurations tested against a list
  std::uint64_t alone = 0;     ///< configurations tested one by one, because they are too far apart
  std::uint64_t lists = 0;     ///< lists made
  std::uint64_t listed = 0;    ///< pairs in all lists
  std::uint64_t decided = 0;   ///< pairs decided in double in one configuration, because floats could not decide
};

/// For states along a path or samples around one state. At one of the states, the engine lists the pairs that are
/// nearer than their threshold plus the displacement of both groups in any other state. All other pairs are free there
/// (triangle inequality). Each SIMD lane tests the list for one configuration. The list is reused until a displacement
/// exceeds its allowance. Verdicts and pairs equal those of a Hierarchy, bit for bit. Configurations too far apart are
/// tested one by one. One per thread.
template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf = Simd>
class StateBatch {
 public:
  static constexpr std::size_t size = detail::FrameLanes::size;  ///< configurations in a full block

  /// Frees every DOF. Throws ModelError as Hierarchy does. Copies `model`, `filter` and `matrix`.
  StateBatch(const Model<P>& model, F filter, D matrix)
      : StateBatch(model, DofSelection::all(model.tree()), std::move(filter), std::move(matrix)) {}
  /// Frees only the selected DOF; all others stay at their reference. Throws ModelError as Hierarchy does.
  StateBatch(const Model<P>& model, DofSelection selection, F filter, D matrix)
      : single_(model, std::move(selection), std::move(filter), std::move(matrix)),
        frames_(*single_.model().groups()),
        travel_(single_.model()),
        near_(model.size()),
        allowed_(single_.model().groups()->size(), 0.0),
        usual_(allowed_),
        largest_threshold_(detail::LargestThreshold<D>(single_.matrix(), model.size()).within()) {}

  // --- A block holds 1 to 16 configurations, one after the other, dof_count() values each (rad or model length unit).
  // Both queries throw ConfigurationError if the number of values is wrong, or a value is not finite or too long a
  // slide. ---

  /// Returns a mask: bit k is set if configuration k collides.
  std::uint32_t collides(std::span<const double> block) {
    detail::simd::Bits hit = 0;
    for_lanes(
        block,
        [&](detail::simd::Bits lanes) {
          near_.visit(frames_, single_.model(), travel_, lanes,
                      [&](const auto& pair, detail::simd::Bits surely, detail::simd::Bits maybe) {
                        hit |= surely;
                        for (maybe &= ~hit; maybe != 0; maybe &= maybe - 1)
                          if (test_pair(pair, static_cast<std::size_t>(std::countr_zero(maybe)))) hit |= maybe & -maybe;
                        return (lanes & ~hit) != 0;
                      });
        },
        [&](std::size_t lane) { hit |= single_.self_collides() ? detail::simd::Bits{1} << lane : 0; });
    return hit;
  }

  /// Calls take(k, hit) for every colliding pair of configuration k. The pairs of one configuration come sorted by
  /// (first, second); those of several configurations are interleaved.
  template <class Take>
  void collisions(std::span<const double> block, const Take& take) {
    for_lanes(
        block,
        [&](detail::simd::Bits lanes) {
          near_.visit(frames_, single_.model(), travel_, lanes,
                      [&](const auto& pair, detail::simd::Bits surely, detail::simd::Bits maybe) {
                        for (detail::simd::Bits left = surely | maybe; left != 0; left &= left - 1) {
                          const auto lane = static_cast<std::size_t>(std::countr_zero(left));
                          const P p = placed(pair.first, lane), q = placed(pair.second, lane);
                          if (closer_than(p, q, pair.threshold))
                            take(lane, Hit{pair.first, pair.second, pair.threshold > 0.0 ? distance(p, q) : 0.0,
                                           pair.threshold});
                        }
                        return true;
                      });
        },
        [&](std::size_t lane) {
          for (const Hit& hit : single_.self_collisions()) take(lane, hit);
        });
  }

  /// Number of values per configuration.
  std::size_t dof_count() const noexcept { return single_.dof_count(); }
  /// How all configurations so far were answered. Valid for the life of the batch.
  const BatchCounts& counts() const noexcept { return counts_; }

 private:
  using List =
      detail::NearList<P, decltype(detail::threshold_of(std::declval<const D&>(), PrimitiveId{}, PrimitiveId{}))>;
  static constexpr std::size_t least_shared = 4;   // minimum number of configurations that share a list
  static constexpr std::size_t longest_rest = 64;  // blocks
  /// Cost of finding, sorting and storing a pair, in lane tests.
  static constexpr std::size_t tests_per_listed = 64;

  /// Collects pairs up to a maximum number.
  struct Found {
    static constexpr bool ranks = false;
    std::size_t most;
    std::vector<std::pair<PrimitiveId, PrimitiveId>>& pairs;
    void add(const Hit& hit) { pairs.emplace_back(hit.first, hit.second); }
    double cutoff() const noexcept { return 0.0; }
    bool done() const noexcept { return pairs.size() > most; }
  };

  template <class InLanes, class Alone>
  void for_lanes(std::span<const double> block, const InLanes& in_lanes, const Alone& alone);
  bool make_list(std::size_t first, std::size_t end);
  bool find_pairs(double factor);

  std::span<const double> configuration(std::size_t lane) const noexcept {
    return block_.subspan(lane * dof_count(), dof_count());
  }
  P placed(PrimitiveId i, std::size_t lane) const noexcept {
    const GroupId group = single_.model().group_of(i);
    const P& local = single_.model().primitives()[index(i)];
    return group == GroupId{0} ? local : local.placed(frames_.pose(group, lane));
  }
  bool test_pair(const typename List::Pair& pair, std::size_t lane) noexcept {
    ++counts_.decided;
    return closer_than(placed(pair.first, lane), placed(pair.second, lane), pair.threshold);
  }

  /// A list with more pairs costs about as much as testing the configurations one by one.
  std::size_t longest_list() const noexcept { return 16 * std::max<std::size_t>(single_.model().size(), 64); }
  /// The displacement that a list must allow for a group, model length unit.
  double needed(std::size_t g) const noexcept {
    // The engine adds thresholds and clearances in double: allow for two roundings.
    return travel_.bound(id<GroupId>(g)) * (1.0 + 0x1p-20) + 0x1p-51 * largest_threshold_;
  }
  bool covers() const noexcept {
    for (std::size_t g = 1; g < allowed_.size(); ++g)
      if (!(needed(g) <= allowed_[g])) return false;
    return true;
  }

  Hierarchy<P, F, D, EngineOf> single_;
  detail::FrameLanes frames_;
  detail::DisplacementBounds travel_;
  List near_;
  std::span<const double> block_{};  // while a query runs
  bool has_list_ = false;
  std::vector<double> allowed_;  // per group: the displacement that the list allows
  std::vector<double> usual_;    // per group: recent displacement
  double largest_threshold_;
  detail::ListAllowance allowance_;
  std::uint64_t tests_ = 0;                                 // tests spent on making the list
  std::vector<std::pair<PrimitiveId, PrimitiveId>> found_;  // scratch
  std::size_t span_ = size;                                 // lanes that share a list
  std::size_t blocks_alone_ = 0;                            // blocks still to be answered one by one
  std::size_t rest_ = 1;                                    // next value of blocks_alone_ if lists fail again
  BatchCounts counts_;
};

template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
template <class InLanes, class Alone>
void StateBatch<P, F, D, EngineOf>::for_lanes(std::span<const double> block, const InLanes& in_lanes,
                                              const Alone& alone) {
  const std::size_t count = detail::check_block(block, dof_count(), *single_.model().groups());
  const detail::PresentBlock present(block_, block);
  const auto one_by_one = [&](std::size_t first, std::size_t end) {
    for (std::size_t lane = first; lane < end; ++lane) {
      single_.update(configuration(lane));
      alone(lane);
    }
    counts_.alone += end - first;
  };
  if (blocks_alone_ > 0 || count < least_shared) {
    blocks_alone_ -= blocks_alone_ > 0 ? 1 : 0;
    return one_by_one(0, count);
  }
  std::size_t shared = 0, measured = has_list_ ? std::min(span_, count) : 0;
  travel_.begin(0, measured);
  frames_.set(block, dof_count(), [&](GroupId group) {
    if (measured != 0) travel_.measure(frames_, group);
  });
  travel_.finish();
  for (std::size_t first = 0; first < count;) {
    const std::size_t end = std::min(first + span_, count);
    if (has_list_ && end != std::exchange(measured, 0)) travel_.measure(frames_, first, end);
    if ((has_list_ && !allowance_.outlived() && covers()) || make_list(first, end)) {
      allowance_.serve();
      in_lanes(((detail::simd::Bits{1} << (end - first)) - 1) << first);
      shared += end - first;
      first = end;
    } else if (span_ > least_shared) {
      span_ /= 2;
    } else {
      one_by_one(first, end);
      first = end;
    }
  }
  counts_.in_lanes += shared;
  if (shared == 0) {
    blocks_alone_ = rest_;
    rest_ = std::min(2 * rest_, longest_rest);
    span_ = size;
  } else {
    rest_ = 1;
    if (span_ < size && near_.size() < longest_list() / 4) span_ *= 2;
  }
}

/// Lists the pairs near the present state of single_, allowing `factor` times the displacements. Returns true if they
/// are few enough.
template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
bool StateBatch<P, F, D, EngineOf>::find_pairs(double factor) {
  for (std::size_t g = 0; g < allowed_.size(); ++g) {
    const double need = needed(g);
    if (!is_length(factor * need)) return false;
    // Recent displacements are kept for a while: a group may have moved little this time by chance.
    usual_[g] = factor > 1.0 ? std::max(need, 0.75 * usual_[g]) : need;
    allowed_[g] = factor * usual_[g];
  }
  found_.clear();
  Found found{longest_list(), found_};
  QueryCounts counts;
  QueryOptions options;
  options.clearance = allowed_;
  options.counts = &counts;
  single_.self_query(found, options);
  tests_ += counts.boxes_tested + counts.pairs_tested + tests_per_listed * found_.size();
  return !found.done();
}

/// Makes a list for lanes first ... end - 1. Returns false if it would be too long.
template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
bool StateBatch<P, F, D, EngineOf>::make_list(std::size_t first, std::size_t end) {
  if (has_list_) allowance_.settle();
  has_list_ = false;
  const std::size_t middle = (first + end) / 2;
  travel_.set_reference(frames_, middle);
  travel_.measure(frames_, first, end);
  single_.update(configuration(middle));
  tests_ = 0;
  const double factor = allowance_.factor();
  if (!find_pairs(factor) && (factor == 1.0 || !find_pairs(1.0))) return false;
  std::sort(found_.begin(), found_.end());
  near_.assign(found_, single_.matrix(), single_.model(), travel_);
  allowance_.made(tests_, near_.size());
  has_list_ = true;
  ++counts_.lists;
  counts_.listed += near_.size();
  return true;
}

}  // namespace hinge
