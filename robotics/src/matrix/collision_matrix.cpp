// SPDX-License-Identifier: BSD-3-Clause
// Implements find_collision_matrix: samples first, then searches for proofs for the pairs that no sample found too
// close.
#include "hinge/robotics/collision_matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "checking/find_inside.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/query/link_pair_hits.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/random_configuration.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "matrix/motion_bounds.hpp"
#include "matrix/motion_bounds_search.hpp"
#include "matrix/motion_bounds_tree.hpp"

namespace hinge::robotics {

namespace {

using Progress = std::function<void(const MatrixProgress&)>;

/// Returns every pair of links with geometry. Pairs that are not tested are marked adjacent.
std::vector<MatrixEntry> all_pairs(const Robot& robot, const LinkPairs& tested) {
  std::vector<MatrixEntry> entries;
  for (std::size_t k = 1; k < robot.link_count(); ++k)
    for (std::size_t l = k + 1; l < robot.link_count(); ++l) {
      const LinkId a = id<LinkId>(k), b = id<LinkId>(l);
      if (robot.triangle_count(a) == 0 || robot.triangle_count(b) == 0) continue;
      MatrixEntry entry{a, b};
      if (!tested.contains(a, b)) entry.kind = PairKind::adjacent;
      entries.push_back(entry);
    }
  return entries;
}

/// Counts the hits of every tested pair and sets the kinds that samples can determine.
void sample(const Robot& robot, const LinkPairs& tested, const MatrixOptions& options, const Progress& progress,
            std::vector<MatrixEntry>& entries) {
  std::map<std::pair<LinkId, LinkId>, MatrixEntry*> entry_of;
  for (MatrixEntry& entry : entries) entry_of[{entry.link1, entry.link2}] = &entry;
  Hierarchy arm(robot.model(), LinkPairFilter(robot, tested), LinkMargins(robot, options.clearance));
  const auto links = robot.model().links();
  LinkPairHits hits(links);
  std::vector<double> full(robot.model().tree().dof_count());
  const SolidPairs solid_pairs(arm, robot, tested);
  std::vector<std::array<double, 3>> scratch;
  const auto look = [&](std::span<const double> q, const auto& count) {
    robot.expand(q, full);
    arm.update(full);
    hits.clear();
    arm.self_query(hits);
    solid_pairs.find(arm, robot, scratch, [&](const Inside& inside) {
      hits.add(inside.hit(options.clearance));
      return false;
    });
    for (const Hit& hit : hits.hits()) {
      const LinkId a = links[index(hit.first)], b = links[index(hit.second)];
      count(*entry_of.at({std::min(a, b), std::max(a, b)}));
    }
  };
  const std::vector<double> start = default_configuration(robot);
  std::vector<double> q(start.size());
  for (std::size_t k = 0; k < options.samples; ++k) {
    random_configuration(robot, options.seed, k, q);
    look(q, [](MatrixEntry& entry) { ++entry.hits; });
    if (progress && k % 64 == 0)
      progress({MatrixProgress::Stage::sampling, static_cast<double>(k) / static_cast<double>(options.samples)});
  }
  for (MatrixEntry& entry : entries) {
    if (entry.kind == PairKind::adjacent) continue;
    entry.samples = options.samples;
    if (entry.hits > 0) entry.kind = entry.hits == entry.samples ? PairKind::always : PairKind::sometimes;
  }
  look(start, [](MatrixEntry& entry) {
    if (entry.kind != PairKind::always) entry.kind = PairKind::in_default;
  });
}

/// Searches the joint values of every unseen pair. While surfaces stay apart, no component enters or leaves a solid. No
/// link of an unseen pair is inside the other in the default configuration, so surfaces that are apart everywhere prove
/// the pair.
void prove(const Robot& robot, const MatrixOptions& options, const Progress& progress,
           std::vector<MatrixEntry>& entries) {
  const bool some_settled = options.settled.size() > 0;
  const auto is_open = [&](const MatrixEntry& entry) {
    return entry.kind == PairKind::unseen && !(some_settled && options.settled.contains(entry.link1, entry.link2));
  };
  const auto open = static_cast<std::size_t>(std::count_if(entries.begin(), entries.end(), is_open));
  const KinematicTree& tree = robot.model().tree();
  const RigidGroups groups(tree, DofSelection::all(tree));
  std::vector<std::unique_ptr<const BallTree>> balls(robot.link_count());
  const auto balls_of = [&](LinkId link) -> const BallTree& {
    auto& made = balls[index(link)];
    if (!made) made = std::make_unique<const BallTree>(robot, link);
    return *made;
  };
  std::size_t done = 0;
  for (MatrixEntry& entry : entries) {
    if (!is_open(entry)) continue;
    const LinkPath path(robot, groups, entry.link1, entry.link2);
    std::vector<Interval> box;
    for (const std::size_t k : path.drivers()) box.push_back({robot.lower()[k], robot.upper()[k]});
    PairSearch search(robot, path, balls_of(entry.link1), balls_of(entry.link2), options.clearance);
    const auto tell = [&] {
      if (progress) progress({MatrixProgress::Stage::proving, static_cast<double>(done) / static_cast<double>(open)});
    };
    const PairSearch::Result result = search.run(box, options.cells, tell);
    entry.cells = result.cells;
    if (is_finite(result.smallest_gap)) entry.smallest_gap = result.smallest_gap;
    if (result.verdict == PairSearch::Result::Verdict::apart) entry.kind = PairKind::never;
    if (result.verdict == PairSearch::Result::Verdict::met) entry.kind = PairKind::sometimes;
    ++done;
    tell();
  }
}

}  // namespace

std::vector<double> default_configuration(const Robot& robot) {
  std::vector<double> q;
  for (std::size_t k = 0; k < robot.lower().size(); ++k) {
    const double low = robot.lower()[k], high = robot.upper()[k];
    q.push_back(low <= 0.0 && 0.0 <= high ? 0.0 : low + (high - low) / 2);
  }
  return q;
}

CollisionMatrix find_collision_matrix(const Robot& robot, const MatrixOptions& options, const Progress& progress) {
  if (!is_finite(options.clearance) || options.clearance < 0.0)
    throw ModelError("clearance " + number_text(options.clearance) +
                     " of the collision matrix: expected a finite "
                     "length >= 0");
  if (options.settled.size() > 0 && options.settled.link_count() != robot.link_count())
    throw ModelError("settled pairs of the collision matrix: got pairs of " +
                     std::to_string(options.settled.link_count()) + " links, expected " +
                     std::to_string(robot.link_count()));
  const LinkPairs tested = tested_pairs(robot);
  CollisionMatrix matrix{all_pairs(robot, tested)};
  sample(robot, tested, options, progress, matrix.entries);
  if (options.cells > 0) prove(robot, options, progress, matrix.entries);
  return matrix;
}

bool is_disabled(PairKind kind, UnseenPairs unseen) noexcept {
  switch (kind) {
    case PairKind::adjacent:
    case PairKind::always:
    case PairKind::in_default:
    case PairKind::never: return true;
    case PairKind::unseen: return unseen == UnseenPairs::disabled;
    case PairKind::sometimes: break;
  }
  return false;
}

LinkPairs disabled_pairs(const Robot& robot, const CollisionMatrix& matrix, UnseenPairs unseen) {
  LinkPairs pairs(robot.link_count());
  for (const MatrixEntry& entry : matrix.entries)
    if (is_disabled(entry.kind, unseen)) pairs.insert(entry.link1, entry.link2);
  return pairs;
}

}  // namespace hinge::robotics
