// SPDX-License-Identifier: BSD-3-Clause
// PairSearch: do two links keep their distance in a whole box of joint values? Branch and bound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/kinematics/swept_ball.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot.hpp"
#include "matrix/motion_bounds.hpp"
#include "matrix/motion_bounds_tree.hpp"

namespace hinge::robotics {

/// A tree's balls and triangles at the present box of joint values, made when first asked for.
class SweptTree {
 public:
  SweptTree(const Robot& robot, const BallTree& tree);

  const BallTree& tree() const noexcept { return *tree_; }
  /// joints: what the tree is swept by, in order.
  void begin(const Pose& pose, std::vector<detail::AxisInterval> joints);
  struct Swept {
    Vec3 start;              ///< the ball's centre at the middles of the intervals
    detail::SweptBall ball;  ///< of that centre
  };
  /// Valid until the next node is asked for.
  const Swept& swept(std::uint32_t node);
  /// What each driver contributes to the motion of a node along n.
  void add_shares(std::uint32_t node, const Vec3& n, double turning, std::vector<double>& shares);
  /// The whole triangle a leaf's piece is of, and the piece, at the middles of the intervals.
  Triangle triangle(std::uint32_t leaf) const;
  Triangle piece(std::uint32_t leaf) const;

 private:
  const Robot* robot_;
  const BallTree* tree_;
  Pose pose_;
  std::vector<detail::AxisInterval> joints_;
  std::uint64_t box_ = 0;
  std::vector<std::uint64_t> made_for_;  // by node: number of the box
  std::vector<std::uint32_t> place_;     // by node: in swept_
  std::vector<Swept> swept_;             // of the present box
};

class PairSearch {
 public:
  struct Result {
    enum class Verdict : std::uint8_t { apart, met, unknown } verdict = Verdict::unknown;
    std::size_t cells = 0;
    double smallest_gap = std::numeric_limits<double>::infinity();  ///< m, seen
  };

  /// clearance: m, beyond the radii triangles are grown by. Everything given outlives this.
  PairSearch(const Robot& robot, const LinkPath& path, const BallTree& a, const BallTree& b, double clearance);

  /// box: an interval per driver of the path. Tries at most `most_cells` boxes.
  Result run(const std::vector<Interval>& box, std::size_t most_cells);

 private:
  struct NodePair {
    std::uint32_t a = 0, b = 0;
  };
  /// A box that was tried and stayed open: from here on in `intervals_` and `pairs_`, up to the next cell's.
  struct Cell {
    std::size_t first_interval = 0;
    std::size_t first_pair = 0;
    std::size_t side = 0;  // to be halved
  };
  enum class Outcome : std::uint8_t { apart, met, open };

  void split_path();
  Outcome try_box();
  Outcome test(NodePair pair);
  bool triangles_apart(NodePair pair, bool& met);
  void blame(double gap, const Vec3& n, NodePair pair, double turning);
  std::size_t widest_share() const;

  const LinkPath& path_;
  SweptTree a_, b_;
  double clearance_;
  double enough_;  // clearance and rounding
  PathState state_;
  std::vector<Interval> present_;
  std::vector<Cell> cells_;
  std::vector<Interval> intervals_;  // of all open cells
  std::vector<NodePair> pairs_;      // of all open cells: not yet proved apart there
  std::vector<NodePair> parent_pairs_;
  std::vector<NodePair> stack_;
  Vec3 last_direction_ = Vec3::Zero();  // along which a pair was found apart
  double worst_gap_ = 0.0;
  std::vector<double> shares_;  // by driver, of the pair with the worst gap
  Result result_;
};

}  // namespace hinge::robotics
