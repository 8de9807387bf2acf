// SPDX-License-Identifier: BSD-3-Clause
// PairSearch: proves by branch and bound that two links keep a distance in a box of joint values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/kinematics/swept_ball.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot.hpp"
#include "matrix/motion_bounds.hpp"
#include "matrix/motion_bounds_tree.hpp"

namespace hinge::robotics {

/// The balls and triangles of a tree for the current box of joint values, computed when first needed.
class SweptTree {
 public:
  SweptTree(const Robot& robot, const BallTree& tree);

  const BallTree& tree() const noexcept { return *tree_; }
  /// Starts a new box. pose: link pose at the middles; joints: the joints that sweep the tree, in this order.
  void begin(const Pose& pose, std::vector<detail::AxisInterval> joints);
  struct Swept {
    Vec3 start;              ///< the ball's centre at the middles of the intervals
    detail::SweptBall ball;  ///< sweeps that centre
  };
  /// Returns a swept node. Valid until the next call.
  const Swept& swept(std::uint32_t node);
  /// Adds each driver's contribution to the motion of a node along n. turning: factor of the rotation of the node's
  /// extent.
  void add_shares(std::uint32_t node, const Vec3& n, double turning, std::vector<double>& shares);
  /// Returns the whole triangle of a leaf, or only its piece, at the middles of the intervals.
  Triangle triangle(std::uint32_t leaf) const;
  Triangle piece(std::uint32_t leaf) const;

 private:
  const Robot* robot_;
  const BallTree* tree_;
  Pose pose_;
  std::vector<detail::AxisInterval> joints_;
  std::uint64_t box_ = 0;
  std::vector<std::uint64_t> made_for_;  // by node: number of the box it was computed for
  std::vector<std::uint32_t> place_;     // by node: index into swept_
  std::vector<Swept> swept_;             // nodes of the current box
};

/// Searches for a proof, or for a configuration in which the two links are too close.
class PairSearch {
 public:
  struct Result {
    enum class Verdict : std::uint8_t { apart, met, unknown } verdict = Verdict::unknown;
    std::size_t cells = 0;                                          ///< number of boxes tried
    double smallest_gap = std::numeric_limits<double>::infinity();  ///< m, smallest computed distance of the surfaces
  };

  /// clearance: m, in addition to the radii. All arguments must outlive the object.
  PairSearch(const Robot& robot, const LinkPath& path, const BallTree& a, const BallTree& b, double clearance);

  /// Searches a box with one interval per driver of the path. Tries at most `most_cells` boxes. between: called from
  /// time to time; may throw to end the search.
  Result run(const std::vector<Interval>& box, std::size_t most_cells, const std::function<void()>& between = {});

 private:
  struct NodePair {
    std::uint32_t a = 0, b = 0;
  };
  /// A box that was tried and stayed open. Its data in intervals_ and pairs_ end at the first entry of the next cell.
  struct Cell {
    std::size_t first_interval = 0;
    std::size_t first_pair = 0;
    std::size_t side = 0;  // interval to divide
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
  double enough_;  // m, clearance plus rounding
  PathState state_;
  std::vector<Interval> present_;
  std::vector<Cell> cells_;
  std::vector<Interval> intervals_;  // of all open cells
  std::vector<NodePair> pairs_;      // of all open cells: pairs not proved apart
  std::vector<NodePair> parent_pairs_;
  std::vector<NodePair> stack_;
  Vec3 last_direction_ = Vec3::Zero();  // the direction that last separated a pair
  double worst_gap_ = 0.0;
  std::vector<double> shares_;  // by driver, for the pair with the worst gap
  Result result_;
};

}  // namespace hinge::robotics
