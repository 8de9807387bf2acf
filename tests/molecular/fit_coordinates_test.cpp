// SPDX-License-Identifier: BSD-3-Clause
// fit_coordinates: finds drawn conformations again, also from some atoms, in another frame or with noise; match_atoms:
// order, missing atoms, names of chains and residues.
#include "hinge/molecular/fit_coordinates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace fit_coordinates_test {

constexpr double degree = std::numbers::pi / 180.0;

Checker make_checker(const Structure& structure, const std::string& free) {
  const auto molecule = std::make_shared<const Molecule>(structure);
  return Checker(molecule, molecule->select(select_torsions(*molecule, free, false)), CheckOptions{});
}

std::vector<Vec3> positions_at(Checker checker, const std::vector<double>& q) {
  checker.check(q, Mode{});
  return checker.positions();
}

/// Keeps about `share` of the atoms, adds Gaussian noise (angstrom), and moves all of them rigidly.
TargetCoordinates target_of(const std::vector<Vec3>& positions, double share, double noise, SampleStream& stream) {
  const Mat3 turn = rotation_about(Vec3(Vec3::UnitX() * 0.6 + Vec3::UnitZ() * 0.8), 6.0 * stream.uniform());
  TargetCoordinates target;
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    if (stream.uniform() >= share) continue;
    const Vec3 off(stream.normal(), stream.normal(), stream.normal());
    target.atoms.push_back(i);
    target.positions.emplace_back(Vec3(turn * (positions[i] + noise * off)) + Vec3(30.0, -20.0, 10.0));
  }
  return target;
}

TEST(FitCoordinates, FindsDrawnConformations) {
  constexpr std::uint64_t seed = 7;
  RecordProperty("seed", static_cast<int>(seed));
  const Structure structure = read_structure(test::ubiquitin());
  for (const std::string free : {"all", "backbone", "A:60-76"}) {
    const Checker checker = make_checker(structure, free);
    for (std::uint64_t k = 0; k < 3; ++k) {
      SCOPED_TRACE(free + " " + std::to_string(k));
      SampleStream stream(seed, k);
      const std::vector<double> drawn = sample_configuration({seed, 8.0 * degree}, k, checker.dof_count());
      const std::vector<Vec3> positions = positions_at(checker, drawn);
      // All atoms: the torsions are read off.
      const CoordinateFit exact = fit_coordinates(checker, target_of(positions, 2.0, 0.0, stream));
      EXPECT_LT(exact.rmsd, 1e-9);
      for (std::size_t c = 0; c < drawn.size(); ++c)
        EXPECT_NEAR(std::remainder(exact.q[c] - drawn[c], 2.0 * std::numbers::pi), 0.0, 1e-6);
      // Two thirds of them: most torsions are not.
      const CoordinateFit some = fit_coordinates(checker, target_of(positions, 0.67, 0.0, stream));
      EXPECT_LT(some.rmsd, 0.02);
      EXPECT_GE(some.farthest, some.rmsd);
      // With noise, the fit is no worse than the conformation itself: sqrt(3) * 0.2 angstrom.
      const CoordinateFit noisy = fit_coordinates(checker, target_of(positions, 0.67, 0.2, stream));
      EXPECT_LT(noisy.rmsd, 0.36);
    }
  }
}

TEST(FitCoordinates, NoTorsionImprovesIt) {
  const Structure structure = read_structure(test::ubiquitin());
  const Checker checker = make_checker(structure, "A:60-76");
  SampleStream stream(3, 0);
  const std::vector<double> drawn = sample_configuration({3, 20.0 * degree}, 0, checker.dof_count());
  const TargetCoordinates target = target_of(positions_at(checker, drawn), 0.5, 0.5, stream);
  const CoordinateFit fit = fit_coordinates(checker, target);
  const auto rmsd = [&](const std::vector<double>& q) {
    const std::vector<Vec3> all = positions_at(checker, q);
    std::vector<Vec3> here;
    for (const std::uint32_t atom : target.atoms) here.push_back(all[atom]);
    return superpose(here, target.positions).rmsd;
  };
  EXPECT_NEAR(rmsd(fit.q), fit.rmsd, 1e-9);
  for (std::size_t k = 0; k < fit.q.size(); ++k)
    for (const double turn : {-0.02, 0.02}) {
      std::vector<double> q = fit.q;
      q[k] += turn;
      EXPECT_GT(rmsd(q), fit.rmsd - 1e-5) << "value " << k;
    }
}

TEST(FitCoordinates, CanEndFree) {
  const Structure structure = read_structure(test::ubiquitin());
  const Checker checker = make_checker(structure, "all");
  Checker other = checker;
  for (std::uint64_t k = 0; k < 3; ++k) {
    SampleStream stream(31, k);
    const std::vector<double> drawn = sample_configuration({31, 1.0 * degree}, k, checker.dof_count());
    const TargetCoordinates target = target_of(positions_at(checker, drawn), 0.9, 0.2, stream);
    const CoordinateFit fit = fit_coordinates(checker, target);
    EXPECT_EQ(fit.collisions, other.check(fit.q, Mode{Mode::Kind::all}).pairs.size());
    EXPECT_GT(fit.collisions, 0U);
    const CoordinateFit free = fit_coordinates(checker, target, {{}, true});
    EXPECT_EQ(free.collisions, 0U);
    EXPECT_FALSE(other.check(free.q, Mode{}).collides);
    EXPECT_GE(free.rmsd, fit.rmsd);
    EXPECT_LT(free.rmsd, fit.rmsd + 0.3);
  }
}

TEST(FitCoordinates, OpensAdenylateKinase) {
  const auto folder = test::shared_molecules();
  if (!std::filesystem::exists(folder / "adk_dims.dcd")) GTEST_SKIP() << folder << " has no adk_dims.dcd";
  ReadOptions read;
  read.keep_hydrogens = false;
  const Structure structure = read_structure(folder / "adk_closed.pdb", read);
  const Checker checker = make_checker(structure, "all");
  const Trajectory trajectory(folder / "adk_dims.dcd", structure, read, true);
  const TargetCoordinates target = all_atoms(trajectory.kept(trajectory.frame(97)));
  EXPECT_LT(fit_coordinates(checker, target).rmsd, 1.0);
}

TEST(FitCoordinates, RefusesBadTargets) {
  const Checker checker = make_checker(read_structure(test::ubiquitin()), "A:70-76");
  EXPECT_THROW(fit_coordinates(checker, {}), ModelError);
  EXPECT_THROW(fit_coordinates(checker, {{0, 1}, {Vec3::Zero()}}), ModelError);
  EXPECT_THROW(fit_coordinates(checker, {{99999}, {Vec3::Zero()}}), ModelError);
  EXPECT_THROW(fit_coordinates(checker, {{0}, {Vec3(NAN, 0, 0)}}), ConfigurationError);
}

TEST(MatchAtoms, GoesByName) {
  const Structure structure = read_structure(test::ubiquitin());
  Structure other = structure;
  // Within each residue, the atoms come in the opposite order, and the first one is missing.
  std::vector<Atom> atoms;
  std::vector<Vec3> positions;
  for (Residue& residue : other.residues) {
    const auto first = static_cast<std::uint32_t>(atoms.size());
    for (std::uint32_t a = residue.last_atom; a-- > residue.first_atom + 1;) {
      atoms.push_back(structure.atoms[a]);
      positions.push_back(structure.models.front()[a]);
    }
    residue.first_atom = first;
    residue.last_atom = static_cast<std::uint32_t>(atoms.size());
  }
  other.atoms = std::move(atoms);
  other.models = {positions};
  for (const std::string chain : {"A", "Q"}) {  // no common chain: matched by order
    other.chains.front().name = chain;
    const TargetCoordinates target = match_atoms(structure, other, "other.pdb");
    ASSERT_EQ(target.atoms.size(), structure.atoms.size() - structure.residues.size());
    for (std::size_t k = 0; k < target.atoms.size(); ++k)
      EXPECT_EQ(target.positions[k], structure.models.front()[target.atoms[k]]);
  }
  other.residues[5].name = "TRP";
  try {
    match_atoms(structure, other, "other.pdb");
    FAIL() << "expected an error";
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("other.pdb: residue Q:TRP6 is TRP, expected LYS"), std::string::npos)
        << error.what();
  }
  for (Residue& residue : other.residues) residue.sequence_number += 1000;
  EXPECT_THROW(match_atoms(structure, other, "other.pdb"), LoadError);
}

}  // namespace fit_coordinates_test
}  // namespace hinge::molecular
