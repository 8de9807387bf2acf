// SPDX-License-Identifier: BSD-3-Clause
// plan: every motion is free by brute force, ends where it should, and is the same for every engine and thread; what
// has no motion is said.
#include "hinge/molecular/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/kinematics/closure_equations.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/fit_coordinates.hpp"
#include "hinge/molecular/fit_torsions.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "molecular/free_molecule.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace plan_test {

constexpr double pi = std::numbers::pi;

/// Ubiquitin with free torsions; pairs that collide in the file are left out.
struct Chain {
  explicit Chain(const std::string& free, const std::string& loop = "", const std::string& engine = "simd") {
    const test::FreeMolecule made(read_structure(test::ubiquitin()), free, loop);
    molecule = made.molecule;
    how.closures = made.kept.closures;
    CheckOptions options;
    options.exempt_reference = true;
    checker = made.checker(options, engine);
    brute = made.checker(options, "brute");
  }
  std::vector<double> reference() const { return std::vector<double>(checker->dof_count(), 0.0); }
  /// Returns free conformations: draws until enough do not collide.
  std::vector<std::vector<double>> draw_free(std::size_t count, double sigma, std::uint64_t seed) {
    std::vector<std::vector<double>> found;
    ClosedSampler sampler(*molecule, checker->selection(), {seed, sigma}, 100, how.closures, {});
    for (std::uint64_t k = 0; found.size() < count && k < 100000; ++k) {
      const ClosedSample sample = sampler.sample(k);
      if (sample.found() && !brute->check(sample.q, Mode{}).collides) found.push_back(sample.q);
    }
    return found;
  }
  /// Tests states between all waypoints by brute force. Returns their number.
  std::size_t expect_free(const PlannedMotion& motion, int states) {
    std::size_t tested = 0;
    std::optional<ClosureEquations> equations;
    if (!how.closures.empty()) equations.emplace(molecule->model().tree(), checker->selection(), how.closures);
    for (std::size_t w = 0; w < motion.waypoints.size(); ++w) {
      const std::vector<double>&b = motion.waypoints[w], &a = motion.waypoints[w == 0 ? 0 : w - 1];
      for (int s = 1; s <= states; ++s, ++tested) {
        std::vector<double> q(a.size());
        const double t = static_cast<double>(s) / states;
        for (std::size_t k = 0; k < q.size(); ++k) q[k] = t == 1.0 ? b[k] : a[k] + t * (b[k] - a[k]);
        EXPECT_FALSE(brute->check(q, Mode{}).collides) << "waypoint " << w << ", t " << t;
        if (!equations) continue;
        equations->set(q);
        EXPECT_LE(equations->worst(), t == 1.0 ? 1e-6 : 1.5 * motion.open + 1e-6);
      }
    }
    return tested;
  }

  std::shared_ptr<const Molecule> molecule;
  PlanOptions how{};
  std::optional<Checker> checker, brute;
};

void expect_ends(const PlannedMotion& motion, const std::vector<double>& from, const std::vector<double>& to) {
  EXPECT_EQ(motion.waypoints.front(), from);
  for (std::size_t k = 0; k < to.size() && motion.reached; ++k)
    EXPECT_NEAR(std::remainder(motion.waypoints.back()[k] - to[k], 2.0 * pi), 0.0, 1e-9);
}

TEST(Plan, MotionsOfATailAreFree) {
  constexpr std::uint64_t seed = 4711;
  RecordProperty("seed", static_cast<int>(seed));
  Chain chain("A:72-76:phi,psi");
  const std::size_t wanted = std::getenv("HINGE_TEST_ALL") != nullptr ? 60 : 12;
  std::size_t reached = 0, motions = 0;
  for (const std::vector<double>& to : chain.draw_free(wanted, 1.5, seed)) {
    chain.how.most_motions = 3000;
    const PlannedMotion motion = plan(*chain.checker, {chain.reference()}, {to}, chain.how);
    expect_ends(motion, chain.reference(), to);
    chain.expect_free(motion, 10);
    motions += motion.waypoints.size() - 1;
    reached += motion.reached ? 1 : 0;
    EXPECT_EQ(motion.reached, motion.remaining == 0.0);
    if (!motion.reached) continue;
    EXPECT_GE(motion.length, (1.0 - 1e-9) * motion.straight);
  }
  EXPECT_GE(2 * reached, wanted);  // some have none: phi of an amino acid does not pass 0
  EXPECT_GT(motions, wanted);
}

TEST(Plan, MotionsOfALoopStayClosed) {
  constexpr std::uint64_t seed = 815;
  RecordProperty("seed", static_cast<int>(seed));
  Chain chain("none", "A:7-13");
  // In the long run a thousand motions between waypoints.
  const bool all = std::getenv("HINGE_TEST_ALL") != nullptr;
  const std::size_t wanted = all ? 150 : 5;
  const auto ends = chain.draw_free(wanted, 0.3, seed);
  ASSERT_EQ(ends.size(), wanted);
  std::size_t reached = 0, motions = 0;
  for (const std::vector<double>& to : ends) {
    chain.how.most_motions = 300;
    const PlannedMotion motion = plan(*chain.checker, {chain.reference()}, {to}, chain.how);
    expect_ends(motion, chain.reference(), to);
    chain.expect_free(motion, 4);
    EXPECT_LT(motion.open, 0.02);
    motions += motion.waypoints.size() - 1;
    reached += motion.reached ? 1 : 0;
  }
  EXPECT_GE(2 * reached, wanted);
  EXPECT_GT(motions, all ? 1000U : wanted);
}

TEST(Plan, SearchesForLoopsEnd) {
  constexpr std::uint64_t seed = 3;
  RecordProperty("seed", static_cast<int>(seed));
  // Short, so that closing turns most random steps aside.
  Chain chain("none", "A:7-11");
  chain.how.most_motions = 300;
  std::size_t missed = 0;
  for (const std::vector<double>& to : chain.draw_free(3, 2.0, seed)) {
    const PlannedMotion motion = plan(*chain.checker, {chain.reference()}, {to}, chain.how);
    expect_ends(motion, chain.reference(), to);
    chain.expect_free(motion, 4);
    EXPECT_LT(motion.motions, 1000U);
    missed += motion.reached ? 0 : 1;
    EXPECT_LE(motion.remaining, motion.straight);
    // The search asks stop() before every motion.
    std::uint64_t asked = 0;
    const PlannedMotion stopped =
        plan(*chain.checker, {chain.reference()}, {to}, chain.how, [&] { return ++asked > 20; });
    EXPECT_EQ(stopped.stopped, !stopped.reached);
    EXPECT_LT(stopped.motions, 40U);
  }
  EXPECT_GE(missed, 1U);
}

TEST(Plan, CountsTheAtomsThatMove) {
  // The end's coordinates belong to a conformation of a tail that lies in the chain: all atoms are near it long before
  // the tail is.
  Chain chain("A:74-76:phi,psi");
  const auto ends = chain.draw_free(1, 2.0, 12);
  chain.brute->check(ends.front(), Mode{});
  MotionEnd end{ends.front(), all_atoms(chain.brute->positions())};
  for (Vec3& at : end.target.positions) at += Vec3(0.002, -0.002, 0.002);
  end.target.positions.back() += Vec3(0.1, 0.1, 0.1);
  chain.how.most_motions = 3000;
  const PlannedMotion motion = plan(*chain.checker, {chain.reference()}, end, chain.how);
  std::size_t moved = 0;
  double square = 0.0;
  chain.brute->check(motion.waypoints.back(), Mode{});
  for (std::size_t a = 0; a < end.target.positions.size(); ++a) {
    if (chain.checker->group_of(static_cast<std::uint32_t>(a)) == GroupId{0}) continue;
    ++moved;
    square += (chain.brute->positions()[a] - end.target.positions[a]).squaredNorm();
  }
  EXPECT_GT(moved, 5U);
  EXPECT_LT(moved, 40U);
  EXPECT_TRUE(motion.reached);
  EXPECT_LE(std::sqrt(square / static_cast<double>(moved)), 1.05);
}

TEST(Plan, FollowsCoordinatesWithAllTorsionsFree) {
  constexpr std::uint64_t seed = 1616;
  RecordProperty("seed", static_cast<int>(seed));
  Chain chain("all");
  chain.how.most_motions = 2000;
  const std::size_t wanted = std::getenv("HINGE_TEST_ALL") != nullptr ? 12 : 3;
  for (std::uint64_t k = 0; k < wanted; ++k) {
    SCOPED_TRACE(k);
    // Coordinates of a conformation that collides, with noise that no torsions follow.
    SampleStream stream(seed, k);
    std::vector<double> q(chain.checker->dof_count());
    for (double& value : q) value = 0.02 * stream.normal();
    chain.brute->check(q, Mode{});
    MotionEnd end{{}, all_atoms(chain.brute->positions())};
    for (Vec3& at : end.target.positions) at += 0.2 * Vec3(stream.normal(), stream.normal(), stream.normal());
    const auto rmsd = [&](const std::vector<double>& at) {
      chain.brute->check(at, Mode{});
      return superpose(chain.brute->positions(), end.target.positions).rmsd;
    };
    const CoordinateFit nearest = fit_coordinates(*chain.checker, end.target);
    EXPECT_GT(nearest.collisions, 0U);
    end.q = nearest.q;
    const PlannedMotion motion = plan(*chain.checker, {chain.reference()}, end, chain.how);
    ASSERT_TRUE(motion.reached);
    chain.expect_free(motion, 8);
    EXPECT_EQ(motion.waypoints.front(), chain.reference());
    EXPECT_NEAR(motion.end_rmsd, rmsd(motion.waypoints.back()), 1e-9);
    EXPECT_GE(motion.end_rmsd, nearest.rmsd - 1e-3);
    EXPECT_LE(motion.end_rmsd, 1.0);
    EXPECT_EQ(motion.start_rmsd, 0.0);
    EXPECT_GE(motion.length, motion.straight - motion.end_rmsd - nearest.rmsd);
    // The other way round, the start is the end that may be replaced.
    const PlannedMotion back = plan(*chain.checker, end, {chain.reference()}, chain.how);
    ASSERT_TRUE(back.reached);
    EXPECT_EQ(back.waypoints.back(), chain.reference());
    EXPECT_NEAR(back.start_rmsd, rmsd(back.waypoints.front()), 1e-9);
    EXPECT_EQ(back.end_rmsd, 0.0);
    std::vector<std::vector<double>> reversed(back.waypoints.rbegin(), back.waypoints.rend());
    EXPECT_EQ(reversed, motion.waypoints);
    // A start that may be replaced has to be free if the end may be replaced, too.
    EXPECT_THROW(plan(*chain.checker, end, end, chain.how), ConfigurationError);
  }
}

TEST(Plan, OpensAdenylateKinase) {
  const auto folder = test::shared_molecules();
  if (std::getenv("HINGE_TEST_ALL") == nullptr) GTEST_SKIP() << "takes minutes: HINGE_TEST_ALL";
  if (!std::filesystem::exists(folder / "adk_dims.dcd")) GTEST_SKIP() << folder << " has no adk_dims.dcd";
  const Structure structure = read_structure(folder / "adk_closed.pdb");
  const auto molecule = std::make_shared<const Molecule>(structure);
  CheckOptions options;
  const Checker checker(molecule, molecule->select(select_torsions(*molecule, "all", false)), options);
  const Trajectory trajectory(folder / "adk_dims.dcd", structure, {}, true);
  MotionEnd open{{}, all_atoms(trajectory.kept(trajectory.frame(97)))};
  open.q = fit_coordinates(checker, open.target).q;
  const PlannedMotion motion = plan(checker, {std::vector<double>(checker.dof_count(), 0.0)}, open);
  ASSERT_TRUE(motion.reached);
  EXPECT_LE(motion.end_rmsd, 1.0);
  EXPECT_GT(motion.straight, 6.0);
  options.engine = "brute";
  Checker brute(molecule, checker.selection(), options);
  for (std::size_t w = 1; w < motion.waypoints.size(); ++w)
    for (const double t : {0.25, 0.5, 0.75, 1.0}) {
      std::vector<double> q = motion.waypoints[w - 1];
      for (std::size_t k = 0; k < q.size(); ++k) q[k] += t * (motion.waypoints[w][k] - q[k]);
      EXPECT_FALSE(brute.check(q, Mode{}).collides) << w << " " << t;
    }
}

TEST(Plan, DependsOnTheArgumentsAlone) {
  Chain chain("A:72-76:phi,psi"), lazy("A:72-76:phi,psi", "", "lazy"), brute("A:72-76:phi,psi", "", "brute");
  const std::vector<double> to = chain.draw_free(1, 1.5, 99).front();
  chain.how.most_motions = 500;
  const auto ask = [&](Chain& other) { return plan(*other.checker, {other.reference()}, {to}, chain.how).waypoints; };
  const auto expected = ask(chain);
  EXPECT_EQ(ask(chain), expected);
  EXPECT_EQ(ask(lazy), expected);
  EXPECT_EQ(ask(brute), expected);
  std::vector<std::vector<std::vector<double>>> found(2);
  std::thread first([&] { found[0] = ask(chain); }), second([&] { found[1] = ask(lazy); });
  first.join();
  second.join();
  EXPECT_EQ(found[0], expected);
  EXPECT_EQ(found[1], expected);
}

TEST(Plan, SaysThatThereIsNone) {
  // phi alone: the chain meets itself on both ways round.
  Chain chain("A:60:phi");
  chain.how.most_motions = 200;
  const std::vector<double> to{pi};
  const PlannedMotion motion = plan(*chain.checker, {chain.reference()}, {to}, chain.how);
  expect_ends(motion, chain.reference(), to);
  chain.expect_free(motion, 20);
  EXPECT_FALSE(motion.reached);
  EXPECT_FALSE(motion.stopped);
  EXPECT_GT(motion.remaining, 0.0);
  EXPECT_LT(motion.remaining, motion.straight);
  EXPECT_GE(motion.motions, 200U);
  EXPECT_LT(motion.motions, 1000U);
  const PlannedMotion stopped = plan(*chain.checker, {chain.reference()}, {to}, chain.how, [] { return true; });
  EXPECT_TRUE(stopped.stopped);
  EXPECT_FALSE(stopped.reached);
  EXPECT_LT(stopped.motions, 10U);
}

TEST(Plan, RefusesBadEnds) {
  Chain chain("A:72-76:phi,psi");
  const std::vector<double> good = chain.reference();
  EXPECT_THROW(plan(*chain.checker, {good}, {std::vector<double>(3, 0.0)}), ConfigurationError);
  EXPECT_THROW(plan(*chain.checker, {good}, {std::vector<double>(good.size(), NAN)}), ConfigurationError);
  PlanOptions none;
  none.most_motions = 0;
  EXPECT_THROW(plan(*chain.checker, {good}, {good}, none), ModelError);
  EXPECT_THROW(plan(*Chain("none").checker, MotionEnd{}, MotionEnd{}), ModelError);
  std::vector<double> bad(good);
  bad[0] = pi;
  while (!chain.brute->check(bad, Mode{}).collides) bad[0] -= 0.1;
  try {
    plan(*chain.checker, {good}, {bad});
    FAIL() << "expected an error";
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("the end of the motion collides: A:"), std::string::npos) << error.what();
  }
  for (const TargetCoordinates& wrong :
       {TargetCoordinates{{99999}, {Vec3::Zero()}}, TargetCoordinates{{0, 1}, {Vec3::Zero()}}}) {
    EXPECT_THROW(plan(*chain.checker, {good}, {good, wrong}), ModelError);
    EXPECT_THROW(plan(*chain.checker, {good, wrong}, {good}), ModelError);
  }
  Chain loop("none", "A:7-13");
  std::vector<double> open = loop.reference();
  open[0] = 1e-3;
  EXPECT_THROW(plan(*loop.checker, {loop.reference()}, {open}, loop.how), ConfigurationError);
}

}  // namespace plan_test
}  // namespace hinge::molecular
