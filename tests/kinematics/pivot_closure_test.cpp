// SPDX-License-Identifier: BSD-3-Clause
// All closures of a chain with three pivots. Each solution closes the chain by the plain product of transforms, and a
// numerical search from many starts finds no further solution.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/kinematics/tripeptide_closure.hpp"
#include "hinge/kinematics/closure_solver.hpp"

namespace hinge {
namespace pivot_closure_test {

using test::Random;

/// A chain of three residues: random bond directions at each pivot, and peptide units of 3.8 angstrom between pivots.
detail::OpenChain any_chain(Random& random) {
  detail::OpenChain chain;
  Vec3 at = random.vector(1.0);
  for (detail::Pivot& pivot : chain.pivots) {
    pivot.at = at;
    pivot.before = at + 1.46 * random.vector(1.0).normalized();
    pivot.behind = at + 1.53 * random.vector(1.0).normalized();
    at += 3.8 * random.vector(1.0).normalized();
  }
  chain.end_at = chain.pivots[2].at;
  chain.end_behind = chain.pivots[2].behind;
  return chain;
}

/// The same chain as a tree: five torsions and the closing hinge.
KinematicTree as_tree(const detail::OpenChain& chain) {
  KinematicTree tree;
  LinkId at = tree.add_link(world, Fixed{});
  const LinkId base = at;
  for (std::size_t k = 0; k < 3; ++k) {
    const detail::Pivot& p = chain.pivots[k];
    at = tree.add_link(at, Revolute{p.at - p.before, p.before, {}, {}});
    if (k < 2) at = tree.add_link(at, Revolute{p.behind - p.at, p.at, {}, {}});
  }
  const detail::Pivot& last = chain.pivots[2];
  tree.add_closure({at, base, {last.at, last.behind}, {chain.end_at, chain.end_behind}, "end"});
  return tree;
}

double residual(const KinematicTree& tree, const detail::PivotTurns& q) {
  Pose pose;
  const Closure& closure = tree.closures()[0];
  for (LinkId link = closure.first; link != world; link = tree.parent(link)) {
    const Joint& joint = tree.joint(link);
    pose = joint.origin * motion(joint, joint.has_dof() ? q[index(tree.dof_of(link))] : 0.0) * pose;
  }
  return closure_residual(closure, pose, Pose{});
}

template <class A, class B>
double apart(const A& p, const B& q) {
  double most = 0.0;
  for (std::size_t k = 0; k < p.size(); ++k)
    most = std::max(most, std::abs(std::remainder(p[k] - q[k], 2 * std::numbers::pi)));
  return most;
}

TEST(TurnOf, IsTheAngleOfCosineAndSine) {
  for (int k = -1000; k <= 1000; ++k) {
    const double angle = k * std::numbers::pi / 1000, length = std::exp2(k % 40);
    EXPECT_NEAR(
        apart(std::array{detail::turn_of(length * std::cos(angle), length * std::sin(angle))}, std::array{angle}), 0.0,
        1e-15);
  }
}

TEST(PivotClosures, AllCloseAndHoldTheConformationTheChainWasClosedIn) {
  Random random(21);
  std::size_t most = 0;
  for (int round = 0; round < 300; ++round) {
    const detail::OpenChain chain = any_chain(random);
    const KinematicTree tree = as_tree(chain);
    const auto solutions = solve_tripeptide_closure(chain);
    most = std::max(most, solutions.size());
    EXPECT_LE(solutions.size(), 16U);
    EXPECT_EQ(solutions.size() % 2, 0U) << round;  // the roots of a periodic function come in pairs
    for (const detail::PivotTurns& q : solutions) EXPECT_LE(residual(tree, q), 1e-8) << round;
    EXPECT_TRUE(std::any_of(solutions.begin(), solutions.end(), [](const detail::PivotTurns& q) {
      return apart(q, detail::PivotTurns{}) < 1e-6;
    })) << round;
  }
  EXPECT_GE(most, 8U);
}

TEST(PivotClosures, AreThoseThatASearchFinds) {
  Random random(22);
  const int rounds = std::getenv("HINGE_TEST_ALL") != nullptr ? 200 : 8;
  for (int round = 0; round < rounds; ++round) {
    detail::OpenChain chain = any_chain(random);
    const KinematicTree closed = as_tree(chain);
    const auto solutions = solve_tripeptide_closure(chain);
    ClosureSolver solver(closed, DofSelection::all(closed));
    std::vector<bool> seen(solutions.size(), false);
    for (int start = 0; start < 400; ++start) {
      std::vector<double> q(5);
      for (double& value : q) value = random.uniform(-3.1, 3.1);
      if (!solver.close(q)) continue;
      const auto found = std::find_if(solutions.begin(), solutions.end(),
                                      [&](const detail::PivotTurns& known) { return apart(known, q) < 1e-4; });
      EXPECT_NE(found, solutions.end()) << round;
      if (found != solutions.end()) seen[static_cast<std::size_t>(found - solutions.begin())] = true;
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0) << round;  // the search reaches every solution
  }
}

TEST(PivotClosures, AreTheSameWhereverTheChainStartsFrom) {
  Random random(23);
  for (int round = 0; round < 50; ++round) {
    const detail::OpenChain chain = any_chain(random);
    const KinematicTree tree = as_tree(chain);
    // The same chain, opened by random torsions.
    detail::PivotTurns by;
    for (double& value : by) value = random.uniform(-3.0, 3.0);
    detail::OpenChain open = chain;
    std::array<Pose, 6> poses;
    for (std::size_t link = 2; link <= 6; ++link)
      poses[link - 1] = poses[link - 2] * motion(tree.joint(LinkId{static_cast<std::uint32_t>(link)}), by[link - 2]);
    open.pivots[0].behind = poses[1] * chain.pivots[0].behind;
    open.pivots[1] = {poses[2] * chain.pivots[1].before, poses[2] * chain.pivots[1].at,
                      poses[3] * chain.pivots[1].behind};
    open.pivots[2] = {poses[4] * chain.pivots[2].before, poses[4] * chain.pivots[2].at,
                      poses[5] * chain.pivots[2].behind};
    const auto from_closed = solve_tripeptide_closure(chain), from_open = solve_tripeptide_closure(open);
    ASSERT_EQ(from_closed.size(), from_open.size()) << round;
    for (detail::PivotTurns q : from_open) {
      for (std::size_t k = 0; k < q.size(); ++k) q[k] += by[k];
      EXPECT_TRUE(std::any_of(from_closed.begin(), from_closed.end(), [&](const detail::PivotTurns& other) {
        return apart(q, other) < 1e-6;
      })) << round;
    }
  }
}

TEST(PivotClosures, AreNoneWhereTheEndIsOutOfReach) {
  Random random(24);
  detail::OpenChain chain = any_chain(random);
  chain.end_at += Vec3(100, 0, 0);
  chain.end_behind += Vec3(100, 0, 0);
  EXPECT_TRUE(solve_tripeptide_closure(chain).empty());
  chain.end_at = chain.pivots[0].at;
  EXPECT_TRUE(solve_tripeptide_closure(chain).empty());
}

}  // namespace pivot_closure_test
}  // namespace hinge
