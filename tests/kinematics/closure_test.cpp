// SPDX-License-Identifier: BSD-3-Clause
// Closed cycles: the solver against rings that are closed by construction, derivatives against finite differences,
// and rings that are known to be rigid or mobile.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/core/error.hpp"
#include "hinge/detail/kinematics/rigid_cycles.hpp"
#include "hinge/kinematics/closure_solver.hpp"

namespace hinge {
namespace closure_test {

using test::Random;

/// Pose of `link` as the plain product of transforms, independent of the solver.
Pose plain_pose(const KinematicTree& tree, const std::vector<double>& q, LinkId link) {
  Pose pose;
  for (; link != world; link = tree.parent(link)) {
    const Joint& joint = tree.joint(link);
    pose = joint.origin * motion(joint, joint.has_dof() ? q[index(tree.dof_of(link))] : 0.0) * pose;
  }
  return pose;
}

double plain_residual(const KinematicTree& tree, const std::vector<double>& q) {
  double worst = 0.0;
  for (const Closure& c : tree.closures())
    worst = std::max(worst, closure_residual(c, plain_pose(tree, q, c.first), plain_pose(tree, q, c.second)));
  return worst;
}

/// A polygon of atoms as a ring: one torsion per edge; the last edge is left to the closure.
KinematicTree ring(const std::vector<Vec3>& x) {
  KinematicTree tree;
  const LinkId base = tree.add_link(world, Fixed{});
  LinkId at = base;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) at = tree.add_link(at, Revolute{x[k + 1] - x[k], x[k], {}, {}});
  tree.add_closure({at, base, {x.back(), x[0]}, {x.back(), x[0]}, "ring"});
  return tree;
}

std::vector<Vec3> any_polygon(Random& random, std::size_t n) {
  std::vector<Vec3> x;
  for (std::size_t k = 0; k < n; ++k) x.push_back(random.vector(2.0));
  return x;
}

constexpr double bond = 1.54;  // angstrom, with tetrahedral angles

std::vector<Vec3> chair() {
  const double r = bond * std::sqrt(8.0) / 3.0, h = bond / 6.0;
  std::vector<Vec3> x;
  for (int k = 0; k < 6; ++k)
    x.emplace_back(r * std::cos(k * std::numbers::pi / 3), r * std::sin(k * std::numbers::pi / 3), k % 2 == 0 ? h : -h);
  return x;
}

std::vector<Vec3> boat() {
  const double a = bond * std::sqrt(2.0 / 3.0), y = bond * 5.0 / 6.0;
  const double z = std::sqrt(bond * bond - a * a - (y - bond / 2) * (y - bond / 2));
  return {{0, y, z}, {a, bond / 2, 0}, {a, -bond / 2, 0}, {0, -y, z}, {-a, -bond / 2, 0}, {-a, bond / 2, 0}};
}

std::size_t held(const KinematicTree& tree, const detail::GeometryTolerance& error = {}) {
  return rigid_cycle_dofs(tree, DofSelection::all(tree), error).size();
}

TEST(ClosureEquations, HaveTheDerivativesThatDifferencesSay) {
  Random random(11);
  for (int round = 0; round < 20; ++round) {
    KinematicTree tree = ring(any_polygon(random, 8));
    const LinkId branch = tree.add_link(LinkId{3}, Prismatic{random.vector(1.0), {}, {}});
    const LinkId twig = tree.add_link(branch, Revolute{random.vector(1.0), random.vector(1.0), {}, {}});
    tree.add_closure({twig,
                      LinkId{6},
                      {random.vector(1.0), random.vector(1.0)},
                      {random.vector(1.0), Vec3(9, 9, 9)},
                      "lengths",
                      std::array<double, 3>{1.0, 2.0, 3.0}});
    ClosureEquations equations(tree, DofSelection::all(tree));
    ASSERT_EQ(equations.rows(), 9U);
    std::vector<double> q(tree.dof_count());
    for (double& value : q) value = random.uniform(-2.0, 2.0);
    equations.set(q);
    equations.compute_jacobian();
    const std::vector<double> j = equations.jacobian();
    constexpr double step = 1e-6;
    for (std::size_t c = 0; c < equations.columns(); ++c) {
      std::vector<double> up = q, down = q;
      up[equations.position(c)] += step;
      down[equations.position(c)] -= step;
      equations.set(up);
      const std::vector<double> above = equations.residuals();
      equations.set(down);
      for (std::size_t r = 0; r < equations.rows(); ++r)
        EXPECT_NEAR(j[r * equations.columns() + c], (above[r] - equations.residuals()[r]) / (2 * step), 1e-7);
    }
  }
}

TEST(ClosureSolver, ClosesRingsAboutTheConformationTheyWereBuiltIn) {
  Random random(12);
  for (int round = 0; round < 200; ++round) {
    const KinematicTree tree = ring(any_polygon(random, 6 + static_cast<std::size_t>(round) % 15));
    ClosureSolver solver(tree, DofSelection::all(tree));
    std::vector<double> q(tree.dof_count());
    for (double& value : q) value = random.uniform(-0.05, 0.05);
    ASSERT_TRUE(solver.close(q)) << round << ": " << solver.residual();
    EXPECT_LE(plain_residual(tree, q), 1.001e-9) << round;
  }
}

TEST(ClosureSolver, ClosesFromAnywhereOrSaysThatItDidNot) {
  Random random(13);
  int closed = 0;
  for (int round = 0; round < 400; ++round) {
    const KinematicTree tree = ring(any_polygon(random, 6 + static_cast<std::size_t>(round) % 15));
    ClosureSolver solver(tree, DofSelection::all(tree));
    std::vector<double> q(tree.dof_count());
    for (double& value : q) value = random.uniform(-9.0, 9.0);
    const bool said = solver.close(q);
    closed += said ? 1 : 0;
    EXPECT_EQ(said, plain_residual(tree, q) <= 1.001e-9) << round;
    for (const double value : q) EXPECT_LE(std::abs(value), 3.1416);
  }
  EXPECT_GT(closed, 200);
}

TEST(ClosureSolver, ForgetsWhatItSolvedBefore) {
  Random random(14);
  const KinematicTree tree = ring(any_polygon(random, 9));
  ClosureSolver used(tree, DofSelection::all(tree));
  for (int round = 0; round < 20; ++round) {
    std::vector<double> q(tree.dof_count());
    for (double& value : q) value = random.uniform(-3.0, 3.0);
    std::vector<double> p = q;
    ClosureSolver fresh(tree, DofSelection::all(tree));
    EXPECT_EQ(used.close(q), fresh.close(p));
    EXPECT_EQ(q, p);
  }
}

TEST(ClosureSolver, DoesNotChangeHeldValues) {
  Random random(16);
  int closed = 0;
  for (int round = 0; round < 200; ++round) {
    const KinematicTree tree = ring(any_polygon(random, 14));
    std::vector<std::size_t> held;
    for (std::size_t k = 0; k < tree.dof_count(); ++k)
      if (random.one_in(3)) held.push_back(k);
    ClosureSolver solver(tree, DofSelection::all(tree), all_closures(tree), {}, held);
    const std::vector<bool> in_cycles = solver.dofs_in_cycles();
    std::vector<double> q(tree.dof_count());
    for (double& value : q) value = random.uniform(-0.2, 0.2);
    const std::vector<double> start = q;
    const bool said = solver.close(q);
    closed += said ? 1 : 0;
    EXPECT_EQ(said, plain_residual(tree, q) <= 1.001e-9) << round;
    for (const std::size_t k : held) {
      EXPECT_EQ(q[k], start[k]);
      EXPECT_FALSE(in_cycles[k]);
    }
  }
  EXPECT_GT(closed, 100);
  const KinematicTree tree = ring(any_polygon(random, 8));
  const std::vector<std::size_t> unknown{tree.dof_count()};
  EXPECT_THROW(ClosureSolver(tree, DofSelection::all(tree), all_closures(tree), {}, unknown), ModelError);
}

TEST(ClosureSolver, SaysThatWhatCannotCloseDoesNot) {
  KinematicTree tree;
  const LinkId arm = tree.add_link(world, Revolute{Vec3::UnitZ(), Vec3::Zero(), {}, {}});
  const LinkId hand = tree.add_link(arm, Revolute{Vec3::UnitZ(), Vec3(1, 0, 0), {}, {}});
  tree.add_closure({hand, world, {Vec3(2, 0, 0), Vec3(2, 0, 1)}, {Vec3(5, 0, 0), Vec3(5, 0, 1)}, "too far"});
  ClosureSolver solver(tree, DofSelection::all(tree));
  std::vector<double> q{0.3, 0.4};
  EXPECT_FALSE(solver.close(q));
  EXPECT_NEAR(solver.residual(), 3.0, 1e-3);  // the smallest residual of two arms of length 1
  const DofSelection none(tree, {});
  std::vector<double> nothing;
  EXPECT_FALSE(ClosureSolver(tree, none).close(nothing));
}

TEST(ClosureSolver, SurvivesLengthsOfEverySize) {
  Random random(19);
  const std::vector<Vec3> x = any_polygon(random, 9);
  for (const double scale : {1e-300, 1e-160, 1e-9, 1e9, 1e160, 1e300}) {
    std::vector<Vec3> scaled = x;
    for (Vec3& p : scaled) p *= scale;
    const KinematicTree tree = ring(scaled);
    ClosureSolver solver(tree, DofSelection::all(tree), {1e-9 * scale, 200});
    std::vector<double> q(tree.dof_count(), 0.1);
    const bool closed = solver.close(q);
    EXPECT_EQ(closed, plain_residual(tree, q) <= 1.001e-9 * scale) << scale;
    for (const double value : q) EXPECT_TRUE(std::isfinite(value)) << scale;
    if (scale > 1e-10 && scale < 1e10) {
      EXPECT_TRUE(closed) << scale;
    }
  }
}

TEST(ClosureSolver, ClosesWithSlidesAndKeptLengths) {
  KinematicTree tree;
  const LinkId rail = tree.add_link(world, Prismatic{Vec3::UnitX(), {}, {}});
  const LinkId arm = tree.add_link(rail, Revolute{Vec3::UnitZ(), Vec3::Zero(), {}, {}});
  const std::vector<double> wanted{0.7, -0.4};
  Closure rod{arm, world, {Vec3(0, 2, 0), Vec3(1, 3, 0)}, {Vec3(6, 3, 0), Vec3(6, 5, 1)}, "rod"};
  rod.lengths.emplace();
  const Pose pose = plain_pose(tree, wanted, arm);
  for (std::size_t k = 0; k < 3; ++k)
    (*rod.lengths)[k] = (pose * rod.in_first[kept_lengths[k][0]] - rod.in_second[kept_lengths[k][1]]).norm();
  tree.add_closure(rod);
  ClosureSolver solver(tree, DofSelection::all(tree), {1e-12, 200});
  std::vector<double> q{0.4, -0.1};
  ASSERT_TRUE(solver.close(q));
  EXPECT_NEAR(q[0], wanted[0], 1e-11);
  EXPECT_NEAR(q[1], wanted[1], 1e-11);
}

TEST(ClosureSolver, RefusesBadNumbers) {
  Random random(15);
  const KinematicTree tree = ring(any_polygon(random, 7));
  ClosureSolver solver(tree, DofSelection::all(tree));
  std::vector<double> q(tree.dof_count(), 0.0), few(2, 0.0);
  EXPECT_THROW(solver.close(few), ConfigurationError);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    q[3] = bad;
    EXPECT_THROW(solver.close(q), ConfigurationError);
  }
  EXPECT_THROW(ClosureSolver(tree, DofSelection::all(tree), {0.0, 10}), ModelError);
  EXPECT_THROW(ClosureSolver(tree, DofSelection::all(tree), {1e-9, -1}), ModelError);
  KinematicTree bad = tree;
  EXPECT_THROW(bad.add_closure({LinkId{1}, LinkId{2}, {}, {}, "", std::array<double, 3>{1.0, 0.0, 1.0}}), ModelError);
}

TEST(RigidCycles, HoldTheChairButNotTheBoat) {
  EXPECT_EQ(held(ring(chair())), 5U);
  EXPECT_EQ(held(ring(boat())), 0U);
  const detail::GeometryTolerance decimals{8.7e-4, 1.5e-3};
  EXPECT_EQ(held(ring(chair()), decimals), 5U);
  // A boat rounded to file decimals is rigid if its decimals are taken as exact. Within its tolerance it may move.
  std::vector<Vec3> rounded = boat();
  for (Vec3& x : rounded)
    for (double& value : x) value = std::round(value * 1000) / 1000;
  EXPECT_EQ(held(ring(rounded), decimals), 0U);
}

TEST(RigidCycles, MoveWithOneDofLessThanSixForEachTurn) {
  Random random(16);
  for (std::size_t n = 4; n <= 9; ++n)
    for (int round = 0; round < 20; ++round) EXPECT_EQ(held(ring(any_polygon(random, n))), n <= 6 ? n - 1 : 0U) << n;
}

/// The largest DOF value after one DOF of a closed ring is set to `push` and the ring is closed again.
double farthest(const KinematicTree& tree, double push) {
  ClosureSolver solver(tree, DofSelection::all(tree));
  double most = 0.0;
  for (std::size_t k = 0; k < tree.dof_count(); ++k) {
    std::vector<double> q(tree.dof_count(), 0.0);
    q[k] = push;
    if (!solver.close(q)) continue;
    for (const double value : q) most = std::max(most, std::abs(value));
  }
  return most;
}

TEST(RigidCycles, AreThoseThatReturnWhenTheyArePushed) {
  EXPECT_LT(farthest(ring(chair()), 0.05), 1e-8);
  EXPECT_GT(farthest(ring(boat()), 0.05), 0.01);
  Random random(17);
  EXPECT_GT(farthest(ring(any_polygon(random, 7)), 0.05), 0.005);
}

TEST(RigidCycles, AreFoundWhereSeveralCyclesTogetherHoldThem) {
  Random random(18);
  // A ring of seven moves. A second closure across it makes it rigid. A further joint outside the ring stays free.
  const std::vector<Vec3> x = any_polygon(random, 7);
  KinematicTree tree = ring(x);
  tree.add_link(LinkId{2}, Revolute{Vec3::UnitX(), Vec3::Zero(), {}, {}});
  EXPECT_EQ(held(tree), 0U);
  tree.add_closure({LinkId{5}, LinkId{1}, {x[1], x[4]}, {x[1], x[4]}, "across"});
  const std::vector<DofId> dofs = detail::rigid_cycle_dofs(tree, DofSelection::all(tree));
  EXPECT_EQ(dofs.size(), 6U);
  EXPECT_EQ(std::count(dofs.begin(), dofs.end(), DofId{6}), 0);
  // A DOF that is not selected cannot move: a ring of seven with only six selected DOF is rigid.
  const KinematicTree seven = ring(x);
  EXPECT_EQ(
      detail::rigid_cycle_dofs(seven, DofSelection(seven, {DofId{0}, DofId{1}, DofId{2}, DofId{4}, DofId{5}})).size(),
      5U);
}

TEST(RigidCycles, AreNoneWhereTheReferenceIsOpen) {
  KinematicTree tree = ring(chair());
  KinematicTree open;
  LinkId at = open.add_link(world, Fixed{});
  for (std::size_t k = 2; k < tree.link_count(); ++k)
    at = open.add_link(at, tree.joint(LinkId{static_cast<unsigned>(k)}));
  Closure closure = tree.closures()[0];
  closure.in_second[0] += Vec3(0, 0, 0.1);
  open.add_closure(closure);
  EXPECT_EQ(held(open), 0U);
}

}  // namespace closure_test
}  // namespace hinge
