// SPDX-License-Identifier: BSD-3-Clause
// CertifiedPath: proves that a straight path is free in every state, or finds a state of it that collides.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/bounds/round.hpp"
#include "hinge/detail/path/displacements.hpp"
#include "hinge/detail/path/group_rates.hpp"
#include "hinge/detail/path/listed_pairs.hpp"
#include "hinge/detail/path/near_links.hpp"
#include "hinge/detail/path/path_segments.hpp"
#include "hinge/detail/path/prove_apart.hpp"
#include "hinge/detail/path/relative_motion.hpp"
#include "hinge/detail/primitive/triangle_leaf.hpp"
#include "hinge/detail/query/pair_threshold.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge/path/straight_path.hpp"
#include "hinge/query/link_pair_hits.hpp"

namespace hinge {

/// Checks paths with its own copy of a hierarchy. One per thread. Proof: docs/explanation/certified_paths.md.
template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
class CertifiedPath {
 public:
  /// Takes the model, the selected DOF, the filter and the matrix from `hierarchy`; its state does not matter.
  explicit CertifiedPath(Hierarchy<P, F, D, EngineOf> hierarchy)
      : hierarchy_(std::move(hierarchy)),
        rates_(hierarchy_.model()),
        list_limit_(rates_.extent() > 0.0 ? rates_.extent() * rates_.scale() * list_share : 1.0),
        near_links_(by_links ? hierarchy_.model().model().links() : std::span<const LinkId>()) {}

  /// from, to: dof_count values each, rad or length unit. Segments up to smallest_step, a share of the path, are not
  /// divided. between() precedes each segment and may throw. ConfigurationError: bad path (StraightPath), step not > 0.
  PathAnswer check(std::span<const double> from, std::span<const double> to, double smallest_step = smallest_path_step,
                   const std::function<void()>& between = {});

 private:
  static constexpr std::size_t most_segments = std::size_t{1} << 17;  // a path that needs more is left undecided
  // A segment whose displacement exceeds the limit by this factor is halved: speeds differ along the path.
  static constexpr double most_above_limit = 1.5;
  static constexpr double most_pieces = 4096.0;
  // Pairs of links are listed first if links have many primitives: their pairs of primitives would be too many.
  static constexpr bool by_links = detail::UsesStaticBvh<P>;
  // Largest listed displacement, as a share of the model's extent. A larger limit makes long lists, a smaller one many
  // lists. These values are near the best for proteins and robots (bench/paths.cpp); answers do not depend on them.
  static constexpr double list_share = by_links ? 1.0 / 160.0 : 1.0 / 40.0;
  // Pairs of primitives of two links that are tested one by one. With more near pairs, halving the segment is cheaper.
  static constexpr std::size_t most_near = 32;

  void place(double t);
  void list(const detail::PathSegment& segment);
  bool judge(const detail::PathSegment& segment);
  void cut_evenly(double largest);
  bool middle_collides(const detail::PathSegment& segment);
  bool find_near(const detail::PathPair& links, double closer, std::size_t most);
  bool collides(const detail::PathPair& pair, double t);
  void answer_collision(const Hit& hit, double t);
  void leave_undecided(const detail::PathSegment& segment, const detail::PathPair* pair);

  Hierarchy<P, F, D, EngineOf> hierarchy_;
  detail::GroupRates rates_;
  detail::Displacements displacements_;
  double list_limit_;
  StraightPath path_{{}, {}, 0};  // the last path
  double smallest_step_ = 0.0;
  PathAnswer answer_;
  std::vector<double> q_;
  std::vector<double> clearance_;
  detail::PathSegments segments_;
  std::vector<detail::PathPair> listed_, before_, after_, found_;
  LinkPairHits near_links_;
  detail::RelativeMotions motions_;
};

template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
PathAnswer CertifiedPath<P, F, D, EngineOf>::check(std::span<const double> from, std::span<const double> to,
                                                   double smallest_step, const std::function<void()>& between) {
  check_smallest_step(smallest_step);
  path_ = StraightPath(from, to, hierarchy_.dof_count());
  smallest_step_ = smallest_step;
  answer_ = {};
  answer_.verdict = PathVerdict::free;
  rates_.begin(path_);
  segments_.start();
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const detail::PathSegment segment = segments_[k];
    if (k == most_segments) {
      leave_undecided(segment, nullptr);
      break;
    }
    if (between) between();
    ++answer_.counts.segments;
    place(segment.middle());
    listed_.clear();
    if (segment.knows_pairs)
      segments_.get_pairs(segment, listed_);
    else
      list(segment);
    if (answer_.verdict == PathVerdict::colliding || judge(segment)) break;
  }
  return std::move(answer_);
}

template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
void CertifiedPath<P, F, D, EngineOf>::place(double t) {
  path_.at(t, q_);
  hierarchy_.update(q_);
  ++answer_.counts.configurations;
  rates_.set_middle(hierarchy_.frames());
  motions_.forget();
}

/// Lists the pairs that may come too close, or divides the segment if the displacements in it are large.
template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
void CertifiedPath<P, F, D, EngineOf>::list(const detail::PathSegment& segment) {
  if (segment.is_whole()) displacements_.begin(rates_.groups());
  const double largest = displacements_.find(rates_.groups(), segment.half());
  if (!(largest <= most_above_limit * list_limit_) && segment.length() > smallest_step_) {
    if (segment.is_whole()) {
      cut_evenly(largest);
    } else if (!middle_collides(segment)) {
      segments_.push_halves(segment);
    }
    return;
  }
  if (!is_length(largest / rates_.scale())) return leave_undecided(segment, nullptr);
  clearance_.clear();
  for (const double d : displacements_.of_groups()) clearance_.push_back(d / rates_.scale());
  const QueryOptions options{.clearance = clearance_};
  if constexpr (by_links) {
    near_links_.clear();
    hierarchy_.self_query(near_links_, options);
    for (const Hit& hit : near_links_.hits()) listed_.push_back({hit.first, hit.second, true});
  } else {
    detail::ListedPairs listed(
        listed_, detail::StaysApart{hierarchy_.model(), hierarchy_.matrix(), rates_, motions_, segment.half()});
    hierarchy_.self_query(listed, options);
    answer_.counts.pairs_listed += listed.proved();
    answer_.counts.pairs_proved += listed.proved();
  }
}

/// Decides the middle state by the exact query, where a list would be long.
template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
bool CertifiedPath<P, F, D, EngineOf>::middle_collides(const detail::PathSegment& segment) {
  AnyHit any;
  hierarchy_.self_query(any);
  if (!any.done()) return false;
  answer_collision(*any.hit(), segment.middle());
  return true;
}

/// Divides the path into enough pieces that the list of each is short.
template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
void CertifiedPath<P, F, D, EngineOf>::cut_evenly(double largest) {
  double pieces = 1.0;
  while (!(largest <= list_limit_) && pieces < most_pieces) {
    pieces = std::ceil(pieces * std::clamp(largest / list_limit_, 1.1, 2.0));
    largest = displacements_.find_again(rates_.groups(), 0.5 / pieces);
  }
  segments_.push_pieces(static_cast<std::uint64_t>(std::min(pieces, most_pieces)));
}

/// Proves listed pairs apart, and pushes new segments for the rest. Returns true when a pair collides.
template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
bool CertifiedPath<P, F, D, EngineOf>::judge(const detail::PathSegment& segment) {
  const double middle = segment.middle(), half = segment.half();
  const SelectedModel<P>& model = hierarchy_.model();
  before_.clear();
  after_.clear();
  detail::ProvedRadii shortest{half, half};
  for (std::size_t k = 0; k < listed_.size(); ++k) {
    const detail::PathPair pair = listed_[k];
    ++answer_.counts.pairs_listed;
    const auto a = static_cast<std::uint32_t>(index(model.group_of(pair.first)));
    const auto b = static_cast<std::uint32_t>(index(model.group_of(pair.second)));
    const double m = hierarchy_.matrix().threshold(pair.first, pair.second);
    const std::span<const detail::GroupRate> groups = rates_.groups();
    const detail::RelativeMotion& motion = motions_(groups, a, b, half);
    const P p = hierarchy_.placed(pair.first), q = hierarchy_.placed(pair.second);
    if constexpr (hull_size<P> == 1)
      if (detail::farther_than(p, q, m, motion.approach, rates_.scale())) {
        ++answer_.counts.pairs_proved;
        continue;
      }
    if (pair.stands_for_links) {
      // If few pairs of primitives of the two links may come too close, each of them is tested by itself.
      if (find_near(pair, approach(motion, groups[a], groups[b], half), most_near)) {
        ++answer_.counts.pairs_proved;
        listed_.insert(listed_.end(), found_.begin(), found_.end());
      } else if (!find_near(pair, 0.0, 0)) {
        return collides(found_.front(), middle);
      } else {
        before_.push_back(pair);
        after_.push_back(pair);
        shortest = {};
      }
      continue;
    }
    const detail::ProvedRadii radii = prove_apart(p, q, m, motion, half, rates_.scale());
    if (radii.before >= half && radii.after >= half) {
      ++answer_.counts.pairs_proved;
      continue;
    }
    if (radii.before == 0.0 && radii.after == 0.0) {
      if (collides(pair, middle)) return true;
      // A pair that does not move, or that no distance can bring below a threshold of 0, stays free.
      if ((groups[a].stands && groups[b].stands) || (IsPointLike<P> && m == 0.0)) {
        ++answer_.counts.pairs_proved;
        continue;
      }
      if (motion.still) {
        leave_undecided(segment, &pair);
        continue;
      }
    }
    if (radii.before < half) before_.push_back(pair);
    if (radii.after < half) after_.push_back(pair);
    shortest.before = std::min(shortest.before, radii.before);
    shortest.after = std::min(shortest.after, radii.after);
  }
  if (before_.empty() && after_.empty()) return false;
  if (segment.length() > smallest_step_) {
    segments_.push(segment.low, detail::next_up(middle - shortest.before), before_);
    segments_.push(detail::next_down(middle + shortest.after), segment.high, after_);
    return false;
  }
  // Test the ends as well: the path may touch in its first state.
  for (const double end : {segment.low, segment.high}) {
    place(end);
    for (const detail::PathPair& pair : listed_) {
      const bool near = !pair.stands_for_links || !find_near(pair, 0.0, 0);
      if (near && collides(pair.stands_for_links ? found_.front() : pair, end)) return true;
    }
  }
  leave_undecided(segment, before_.empty() ? &after_.front() : &before_.front());
  return false;
}

/// Finds the pairs of the two links with d - M < `closer` (scaled). Returns true if there are at most `most`.
template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
bool CertifiedPath<P, F, D, EngineOf>::find_near(const detail::PathPair& links, double closer, std::size_t most) {
  const double margin = closer / rates_.scale();
  found_.clear();
  if (!is_length(margin)) return false;
  detail::NearLinks near(hierarchy_.model().model().links(), links, margin, most, found_);
  hierarchy_.self_query(near);
  return found_.size() <= most;
}

/// Decides the pair by the exact rule in the last placed state, at t. Stores the answer if it collides.
template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
bool CertifiedPath<P, F, D, EngineOf>::collides(const detail::PathPair& pair, double t) {
  const P p = hierarchy_.placed(pair.first), q = hierarchy_.placed(pair.second);
  const auto m = detail::threshold_of(hierarchy_.matrix(), pair.first, pair.second);
  if (!closer_than(p, q, m)) return false;
  answer_collision({pair.first, pair.second, m > 0.0 ? distance(p, q) : 0.0, m}, t);
  return true;
}

template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
void CertifiedPath<P, F, D, EngineOf>::answer_collision(const Hit& hit, double t) {
  answer_.verdict = PathVerdict::colliding;
  answer_.parameter = t;
  answer_.half_width = 0.0;
  answer_.configuration = q_;
  answer_.hit = hit;
}

/// The answer reports the longest undecided segment.
template <Certifiable P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
void CertifiedPath<P, F, D, EngineOf>::leave_undecided(const detail::PathSegment& segment,
                                                       const detail::PathPair* pair) {
  if (answer_.verdict == PathVerdict::undecided && answer_.half_width >= segment.half()) return;
  answer_.verdict = PathVerdict::undecided;
  answer_.parameter = segment.middle();
  answer_.half_width = segment.half();
  path_.at(answer_.parameter, answer_.configuration);
  answer_.hit.reset();
  if (pair == nullptr) return;
  place(segment.middle());
  answer_.hit =
      Hit{pair->first, pair->second, distance(hierarchy_.placed(pair->first), hierarchy_.placed(pair->second)),
          hierarchy_.matrix().threshold(pair->first, pair->second)};
}

}  // namespace hinge
