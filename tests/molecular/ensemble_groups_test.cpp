// SPDX-License-Identifier: BSD-3-Clause
// Tests the rigid groups of ensembles with known groups: made by known turns, with noise, and of adenylate kinase.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/molecular/ensemble_groups.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace ensemble_groups_test {

constexpr double degree = std::numbers::pi / 180.0;

/// Makes conformations of a molecule: known turns of some torsions, Gaussian noise on every coordinate, and a random
/// rigid motion of the whole.
struct Ensemble {
  const Molecule& molecule;
  std::vector<std::size_t> turning;
  std::uint64_t seed;
  double noise = 0.0;  // angstrom

  std::vector<Vec3> conformation(std::mt19937_64& random, const std::vector<double>& q) const {
    Hierarchy hierarchy(molecule.model(), molecule.select(turning), AdmitAll{}, UniformClearance{1.0});
    hierarchy.update(q);
    std::normal_distribution<double> normal;
    const Vec3 move(10.0 * normal(random), 10.0 * normal(random), 10.0 * normal(random));
    const double a = normal(random), c = std::cos(a), s = std::sin(a);
    std::vector<Vec3> all;
    for (const Point& p : hierarchy.placed()) {
      const Vec3 x = p.position;
      all.emplace_back(Vec3(c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]) + move +
                       noise * Vec3(normal(random), normal(random), normal(random)));
    }
    return all;
  }
  EnsembleSpread spread(std::size_t count, double sigma, const std::vector<std::size_t>& torsions) const {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-std::sqrt(3.0) * sigma, std::sqrt(3.0) * sigma);
    EnsembleSpread spread(molecule, torsions);
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<double> q;
      for (std::size_t t = 0; t < turning.size(); ++t) q.push_back(uniform(random));
      spread.add(conformation(random, q));
    }
    return spread;
  }
};

Molecule two_domains() {
  return Molecule(build_ideal_protein("AKFDELLRAAGSGWSRKVEAAKFLDE", "HHHHHHHHHHCCCHHHHHHHHHHHHH"));
}

std::vector<std::size_t> named(const Molecule& m, const std::string& words) { return select_torsions(m, words, false); }

/// Returns the rigid groups of the model if exactly these torsions turn: the expected partition of the atoms.
std::vector<std::vector<std::uint32_t>> parts(const Molecule& m, const std::vector<std::size_t>& turning) {
  const TorsionBodies bodies(m, turning);
  std::vector<std::vector<std::uint32_t>> parts(bodies.size());
  for (std::uint32_t i = 0; i < bodies.of_atom().size(); ++i) parts[bodies.of_atom()[i]].push_back(i);
  std::erase_if(parts, [](const auto& part) { return part.empty(); });
  std::sort(parts.begin(), parts.end());
  return parts;
}

std::vector<std::vector<std::uint32_t>> parts(const EnsembleGroups& found) {
  std::vector<std::vector<std::uint32_t>> parts;
  for (const EnsembleGroup& group : found.groups) parts.push_back(group.atoms());
  std::sort(parts.begin(), parts.end());
  return parts;
}

TEST(EnsembleGroups, AreTheDomainsThatTwoTorsionsMove) {
  const Molecule m = two_domains();
  const std::vector<std::size_t> hinge = named(m, "A:12:backbone"), all = named(m, "all");
  ASSERT_EQ(hinge.size(), 2U);
  for (const double noise : {0.0, 0.01, 0.05, 0.1})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const EnsembleSpread spread = Ensemble{m, hinge, seed, noise}.spread(40, 40.0 * degree, all);
      const EnsembleGroups found = find_ensemble_groups(spread, 0.5);
      EXPECT_EQ(found.torsions, hinge) << noise << " seed " << seed;
      EXPECT_EQ(parts(found), parts(m, hinge)) << noise << " seed " << seed;
      for (const double turn : found.turn_spreads) EXPECT_NEAR(turn, 40.0 * degree, 12.0 * degree);
    }
}

TEST(EnsembleGroups, WrapAround) {
  // Turns close to pi: angles on both sides of the cut at pi are close to each other.
  const Molecule m = two_domains();
  const std::vector<std::size_t> hinge = named(m, "A:12:psi");
  std::mt19937_64 random(5);
  EnsembleSpread narrow(m, hinge), wide(m, hinge);
  const Ensemble ensemble{m, hinge, 5};
  for (int k = -10; k <= 10; ++k) {
    narrow.add(ensemble.conformation(random, {std::numbers::pi + 0.1 * degree * k}));
    wide.add(ensemble.conformation(random, {std::numbers::pi / 10.5 * k}));
  }
  EXPECT_NEAR(narrow.circular_std(0), 0.1 * degree * std::sqrt(110.0 / 3.0), 1e-4 * degree);
  EXPECT_GT(wide.circular_std(0), 120.0 * degree);
  EXPECT_TRUE(find_ensemble_groups(narrow, 0.5).torsions.empty());
  EXPECT_EQ(find_ensemble_groups(wide, 0.5).torsions, hinge);
}

TEST(EnsembleGroups, ComeBackTogetherBehindTorsionsThatCompensate) {
  // A piece of the chain moves as a closed loop, so the atoms before and after it form one group.
  const Molecule m = two_domains();
  const std::vector<std::size_t> loop = named(m, "A:10-14:phi,A:10-14:psi"), all = named(m, "all");
  MoleculeOptions held;
  const std::uint32_t last = static_cast<std::uint32_t>(m.structure().atoms.size()) - 1;
  held.held = {{{0, last}, {0, 5, last - 5, last}}};
  const Molecule closed(m.structure(), held);
  ClosureSolver solver(closed.model().tree(), closed.select(loop));
  const Ensemble ensemble{closed, loop, 7, 0.02};
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-60.0 * degree, 60.0 * degree);
  EnsembleSpread spread(m, all);
  while (spread.conformations() < 40) {
    std::vector<double> q;
    for (std::size_t t = 0; t < loop.size(); ++t) q.push_back(uniform(random));
    if (solver.close(q)) spread.add(ensemble.conformation(random, q));
  }
  const EnsembleGroups found = find_ensemble_groups(spread, 0.5);
  const EnsembleGroup& core = found.groups.front();
  ASSERT_EQ(core.segments.size(), 2U);
  std::vector<std::uint32_t> seen;
  for (const std::uint32_t i : core.atoms()) seen.push_back(m.structure().atoms[i].residue);
  // Some atoms of the first and the last residue of the loop move, and some do not.
  for (std::uint32_t r = 0; r < 26; ++r)
    EXPECT_TRUE(r == 9 || r == 13 || std::binary_search(seen.begin(), seen.end(), r) == (r < 9 || r > 13)) << r;
  for (std::size_t g = 1; g < found.groups.size(); ++g) EXPECT_EQ(found.groups[g].segments.size(), 1U) << g;
  for (const std::size_t k : found.torsions) {
    EXPECT_GE(m.torsions()[k].residue, 9U);
    EXPECT_LE(m.torsions()[k].residue, 13U);
  }

  // In the model with held placements, closed conformations do not change the shape of the core.
  held.held = held_placements(m, found);
  const Molecule kept(m.structure(), held);
  ASSERT_EQ(kept.model().tree().closures().size(), 2U);
  const DofSelection selection = kept.select(found.torsions);
  ClosureSolver keeping(kept.model().tree(), selection);
  Hierarchy hierarchy(kept.model(), selection, AdmitAll{}, UniformClearance{1.0});
  int moved = 0;
  for (int k = 0; k < 20; ++k) {
    std::vector<double> q;
    for (std::size_t t = 0; t < selection.size(); ++t) q.push_back(0.5 * uniform(random));
    if (!keeping.close(q)) continue;
    hierarchy.update(q);
    double farthest = 0.0;
    for (std::uint32_t i = 0; i < hierarchy.placed().size(); ++i)
      farthest = std::max(farthest, (hierarchy.placed()[i].position - m.structure().models[0][i]).norm());
    for (const std::uint32_t i : core.atoms())
      EXPECT_NEAR((hierarchy.placed()[i].position - hierarchy.placed()[core.segments[0][0]].position).norm(),
                  (m.structure().models[0][i] - m.structure().models[0][core.segments[0][0]]).norm(), 1e-6);
    moved += farthest > 0.3 ? 1 : 0;
  }
  EXPECT_GE(moved, 5);
}

TEST(EnsembleGroups, RefuseWhatIsNoEnsemble) {
  const Molecule m = two_domains();
  EnsembleSpread spread(m, named(m, "all"));
  EXPECT_THROW(find_ensemble_groups(spread, 0.5), ModelError);
  spread.add(m.structure().models[0]);
  EXPECT_THROW(find_ensemble_groups(spread, 0.5), ModelError);
  spread.add(m.structure().models[0]);
  EXPECT_THROW(find_ensemble_groups(spread, 0.0), ModelError);
  EXPECT_THROW(find_ensemble_groups(spread, std::nan("")), ModelError);
  const EnsembleGroups one = find_ensemble_groups(spread, 0.5);
  EXPECT_TRUE(one.torsions.empty());
  EXPECT_EQ(one.groups.size(), 1U);
  std::vector<Vec3> flat(m.structure().models[0].size(), Vec3::Zero());
  EXPECT_THROW(spread.add(flat), LoadError);
}

TEST(EnsembleGroups, OfAdenylateKinaseAreItsDomains) {
  const auto topology = test::molecule_file("adk_closed.pdb"), frames = test::molecule_file("adk_dims.dcd");
  if (!std::filesystem::exists(frames)) GTEST_SKIP() << "shared data not found";
  const Molecule m(read_structure(topology));
  const Trajectory trajectory(frames, m.structure());
  EnsembleSpread spread(m, named(m, "backbone"));
  for (std::size_t k = 0; k < trajectory.size(); ++k) spread.add(trajectory.kept(trajectory.frame(k)));
  const EnsembleGroups found = find_ensemble_groups(spread, 2.0);
  // One group per domain (LID 122-159, NMP 30-59, core; C. Mueller et al., Structure 4:147, 1996), and no group with
  // atoms of two domains.
  int lid = 0, nmp = 0, core = 0;
  for (const EnsembleGroup& group : found.groups) {
    int in_lid = 0, in_nmp = 0, in_core = 0;
    for (const std::uint32_t i : group.atoms()) {
      if (m.structure().atoms[i].name != "CA") continue;
      const int number = m.structure().residues[m.structure().atoms[i].residue].sequence_number;
      ++(number >= 122 && number <= 159 ? in_lid : number >= 30 && number <= 59 ? in_nmp : in_core);
    }
    EXPECT_LE(in_lid + in_nmp + in_core - std::max({in_lid, in_nmp, in_core}), 8);
    lid = std::max(lid, in_lid);
    nmp = std::max(nmp, in_nmp);
    core = std::max(core, in_core);
    std::printf("group of LID %d NMP %d core %d\n", in_lid, in_nmp, in_core);
  }
  EXPECT_GE(lid, 30);
  EXPECT_GE(nmp, 18);
  EXPECT_GE(core, 70);
}

}  // namespace ensemble_groups_test
}  // namespace hinge::molecular
