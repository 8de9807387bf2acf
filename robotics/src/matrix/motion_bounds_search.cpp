// SPDX-License-Identifier: BSD-3-Clause
// Implements PairSearch: bisects boxes of joint values until each is proved or the budget is spent.
#include "matrix/motion_bounds_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hinge::robotics {

namespace {

/// Smallest fraction of a driver's interval that is still divided. Links that approach each other to about 1e-9 m stay
/// undecided.
constexpr double smallest_part = 0x1p-30;

/// Returns a lower bound (m) of the distance of two pieces over the box, radii not subtracted: their separation along
/// the unit vector n at the middles, minus the motion of the balls' centres and the rotation of the pieces about them.
double triangles_gap(const Vec3& n, const Triangle& p, const Triangle& q, const BallTree::Node& na,
                     const BallTree::Node& nb, const SweptTree::Swept& sa, const SweptTree::Swept& sb) {
  const double low = std::min({dot(n, q.a), dot(n, q.b), dot(n, q.c)});
  const double high = std::max({dot(n, p.a), dot(n, p.b), dot(n, p.c)});
  const double shift = dot(n, Vec3(sb.ball.centre() - sb.start)) - dot(n, Vec3(sa.ball.centre() - sa.start));
  const double moved = sa.ball.growth() + sb.ball.growth() + sa.ball.generators_along(n) + sb.ball.generators_along(n) +
                       sa.ball.turned() * na.extent + sb.ball.turned() * nb.extent;
  return (low - high) + shift - moved;
}

}  // namespace

SweptTree::SweptTree(const Robot& robot, const BallTree& tree)
    : robot_(&robot), tree_(&tree), made_for_(tree.size(), 0), place_(tree.size(), 0) {}

void SweptTree::begin(const Pose& pose, std::vector<detail::AxisInterval> joints) {
  pose_ = pose;
  joints_ = std::move(joints);
  swept_.clear();
  ++box_;
}

const SweptTree::Swept& SweptTree::swept(std::uint32_t node) {
  if (made_for_[node] == box_) return swept_[place_[node]];
  made_for_[node] = box_;
  place_[node] = static_cast<std::uint32_t>(swept_.size());
  const Vec3 start = pose_ * tree_->node(node).centre;
  Swept& made = swept_.emplace_back(Swept{start, detail::SweptBall(start)});
  for (const detail::AxisInterval& joint : joints_) made.ball.sweep(joint);
  return made;
}

void SweptTree::add_shares(std::uint32_t node, const Vec3& n, double turning, std::vector<double>& shares) {
  swept(node).ball.add_shares(n, shares);
  for (const detail::AxisInterval& joint : joints_)
    if (joint.kind == JointKind::revolute) shares[joint.joint] += turning * tree_->node(node).extent * joint.chord;
}

Triangle SweptTree::triangle(std::uint32_t leaf) const {
  return robot_->model().primitives()[index(tree_->piece(tree_->node(leaf)).triangle)].placed(pose_);
}

Triangle SweptTree::piece(std::uint32_t leaf) const { return tree_->piece(tree_->node(leaf)).part.placed(pose_); }

PairSearch::PairSearch(const Robot& robot, const LinkPath& path, const BallTree& a, const BallTree& b, double clearance)
    : path_(path),
      a_(robot, a),
      b_(robot, b),
      clearance_(clearance),
      enough_(clearance + path.rounding(a.reach(), b.reach())),
      shares_(path.drivers().size()) {}

PairSearch::Result PairSearch::run(const std::vector<Interval>& box, std::size_t most_cells,
                                   const std::function<void()>& between) {
  result_ = {};
  last_direction_ = Vec3::Zero();
  cells_.clear();
  intervals_ = present_ = box;
  pairs_.clear();
  parent_pairs_ = {{0, 0}};
  Outcome outcome = most_cells > 0 ? try_box() : Outcome::open;
  // The links may collide in one half only, so both halves are tested before either is divided.
  while (outcome != Outcome::met && !cells_.empty() && result_.cells + 2 <= most_cells) {
    if (between) between();
    const Cell cell = cells_.back();
    cells_.pop_back();
    const auto at = [](auto& all, std::size_t k) { return all.begin() + static_cast<std::ptrdiff_t>(k); };
    const Interval whole = intervals_[cell.first_interval + cell.side];
    const Interval full = box[cell.side];
    const double middle = whole.middle();
    if (!(whole.upper - whole.lower > smallest_part * (full.upper - full.lower))) return result_;
    if (!(whole.lower < middle && middle < whole.upper)) return result_;
    // The last open cell is stored last, so its halves can overwrite it.
    parent_pairs_.assign(at(pairs_, cell.first_pair), pairs_.end());
    present_.assign(at(intervals_, cell.first_interval), intervals_.end());
    pairs_.resize(cell.first_pair);
    intervals_.resize(cell.first_interval);
    for (const Interval half : {Interval{whole.lower, middle}, Interval{middle, whole.upper}}) {
      if (outcome == Outcome::met) break;
      present_[cell.side] = half;
      outcome = try_box();
    }
  }
  if (outcome == Outcome::met) result_.verdict = Result::Verdict::met;
  if (outcome != Outcome::met && cells_.empty() && result_.cells > 0) result_.verdict = Result::Verdict::apart;
  return result_;
}

/// Splits the chain: the joints near A sweep A, the others sweep B. This gives the same relative motion for every
/// split; the cheapest one keeps lever arms short.
void PairSearch::split_path() {
  const auto& joints = state_.joints;
  std::vector<double> cost(joints.size() + 1, 0.0);
  const auto add_side = [&](const SweptTree& side, const Pose& pose, bool from_a) {
    const BallTree::Node& root = side.tree().node(0);
    detail::SweptBall ball(pose * root.centre);
    double chords = 0.0;
    for (std::size_t k = 0; k <= joints.size(); ++k) {
      const std::size_t at = from_a ? k : joints.size() - k;
      cost[at] += ball.extent() + chords * root.extent;
      if (k == joints.size()) break;
      const detail::AxisInterval& joint = joints[from_a ? k : joints.size() - 1 - k];
      ball.sweep(joint);
      if (joint.kind == JointKind::revolute) chords += joint.chord;
    }
  };
  add_side(a_, state_.first, true);
  add_side(b_, state_.second, false);
  const auto least = std::min_element(cost.begin(), cost.end()) - cost.begin();
  a_.begin(state_.first, {joints.begin(), joints.begin() + least});
  b_.begin(state_.second, {joints.rbegin(), joints.rend() - least});
}

/// Tests the current box and stores it if it stays open.
PairSearch::Outcome PairSearch::try_box() {
  ++result_.cells;
  path_.place(present_, state_);
  split_path();
  worst_gap_ = std::numeric_limits<double>::infinity();
  stack_ = parent_pairs_;
  const std::size_t before = pairs_.size();
  while (!stack_.empty()) {
    const NodePair pair = stack_.back();
    stack_.pop_back();
    const Outcome outcome = test(pair);
    if (outcome == Outcome::met) return Outcome::met;
    if (outcome == Outcome::open) pairs_.push_back(pair);
  }
  if (pairs_.size() == before) return Outcome::apart;
  cells_.push_back({intervals_.size(), before, widest_share()});
  intervals_.insert(intervals_.end(), present_.begin(), present_.end());
  return Outcome::open;
}

/// Tests one pair of nodes. A pair stays open if smaller balls cannot help: the motion dominates their extent, or both
/// are leaves.
PairSearch::Outcome PairSearch::test(NodePair pair) {
  const BallTree::Node &na = a_.tree().node(pair.a), &nb = b_.tree().node(pair.b);
  const SweptTree::Swept &sa = a_.swept(pair.a), &sb = b_.swept(pair.b);
  const Vec3 between = sb.ball.centre() - sa.ball.centre();
  const double distance = norm(between);
  const Vec3 n = distance > 0.0 ? Vec3(between / distance) : Vec3(Vec3::UnitX());
  const double moved = sa.ball.growth() + sb.ball.growth() + sa.ball.generators_along(n) + sb.ball.generators_along(n);
  const double gap = distance - (na.extent + nb.extent + na.radius + nb.radius) - moved;
  // Written so that NaN does not count as apart.
  if (gap > enough_) return Outcome::apart;
  if (na.is_leaf && nb.is_leaf) {
    bool met = false;
    if (triangles_apart(pair, met)) return Outcome::apart;
    return met ? Outcome::met : Outcome::open;
  }
  // If the motion exceeds twice the extent, dividing the box of joint values helps more than smaller balls.
  constexpr double worth_opening = 0.5;
  const bool open_a = !na.is_leaf && (nb.is_leaf || na.extent >= nb.extent);
  if (std::max(na.extent, nb.extent) < worth_opening * moved) {
    blame(gap, n, pair, 0.0);
    return Outcome::open;
  }
  for (std::uint32_t child = 0; child < 2; ++child)
    stack_.push_back(open_a ? NodePair{na.first + child, pair.b} : NodePair{pair.a, nb.first + child});
  return Outcome::apart;  // the children are tested later
}

bool PairSearch::triangles_apart(NodePair pair, bool& met) {
  const BallTree::Node &na = a_.tree().node(pair.a), &nb = b_.tree().node(pair.b);
  const SweptTree::Swept &sa = a_.swept(pair.a), &sb = b_.swept(pair.b);
  const double radii = na.radius + nb.radius;
  const Triangle p = a_.piece(pair.a), q = b_.piece(pair.b);
  const auto [x, y] = closest_points(p, q);
  const double distance = norm(y - x);
  result_.smallest_gap = std::min(result_.smallest_gap, std::max(distance - radii, 0.0));
  if (distance <= enough_ + radii) {
    met = closer_than(a_.triangle(pair.a), b_.triangle(pair.b), RadiusSum{na.radius, nb.radius, clearance_});
    if (met) return false;
  }
  // Any direction may separate the pieces. Tried are: the direction of the distance; the one that separated an earlier
  // pair, often a neighbour; and the normals, along which faces that slide past each other stay apart.
  double best = -std::numeric_limits<double>::infinity();
  Vec3 along = Vec3::UnitX();
  for (const Vec3& direction :
       {Vec3(y - x), last_direction_, cross(p.b - p.a, p.c - p.a), cross(q.b - q.a, q.c - q.a)}) {
    const double length = norm(direction);
    if (!(length > 0.0)) continue;
    const double sign = dot(direction, sb.start - sa.start) < 0.0 ? -1.0 : 1.0;
    const Vec3 n = direction * (sign / length);
    const double gap = triangles_gap(n, p, q, na, nb, sa, sb) - radii;
    if (gap > enough_) {
      last_direction_ = n;
      return true;
    }
    if (gap > best) along = n;
    best = std::max(best, gap);
  }
  blame(best, along, pair, 1.0);
  return false;
}

/// Remembers the drivers' contributions for the pair with the worst gap. turning: factor of the rotation of the pieces
/// about the balls' centres.
void PairSearch::blame(double gap, const Vec3& n, NodePair pair, double turning) {
  if (!(gap < worst_gap_)) return;
  worst_gap_ = gap;
  std::fill(shares_.begin(), shares_.end(), 0.0);
  a_.add_shares(pair.a, n, turning, shares_);
  b_.add_shares(pair.b, n, turning, shares_);
}

std::size_t PairSearch::widest_share() const {
  return static_cast<std::size_t>(std::max_element(shares_.begin(), shares_.end()) - shares_.begin());
}

}  // namespace hinge::robotics
