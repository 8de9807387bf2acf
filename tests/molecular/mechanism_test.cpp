// SPDX-License-Identifier: BSD-3-Clause
// Tests torsions, selections, closures, basic groups and ideal proteins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/selection.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace mechanism_test {

Molecule ubiquitin() { return Molecule(read_structure(test::ubiquitin())); }

TEST(Torsions, OfUbiquitinAreCountedByThePapersConvention) {
  const Molecule m = ubiquitin();
  EXPECT_EQ(select_torsions(m, "all", true).size(), 374U);
  EXPECT_EQ(select_torsions(m, "all", false).size(), 299U);
  EXPECT_EQ(select_torsions(m, "omega", false).size(), 75U);
}

TEST(Torsions, OfMyoglobinAreThoseOfThePaper) {
  const auto file = test::molecule_file("paper/1mbn.pdb");
  const Molecule m(read_structure(file));
  EXPECT_EQ(select_torsions(m, "all", true).size(), 743U);
  EXPECT_EQ(select_torsions(m, "all", false).size(), 591U);
  EXPECT_EQ(select_torsions(m, "count:1", true).size(), 7U);
  EXPECT_EQ(select_torsions(m, "count:1", false).size(), 6U);
  EXPECT_EQ(m.structure().residues[m.torsions()[select_torsions(m, "count:1", false).front()].residue].sequence_number,
            77);
  std::map<std::string, int> names;
  for (const Torsion& t : m.torsions()) ++names[t.name.starts_with("chi") ? "chi" : t.name];
  EXPECT_EQ(names, (std::map<std::string, int>{{"phi", 148}, {"psi", 153}, {"omega", 152}, {"chi", 290}}));
}

TEST(Torsions, TurnTheDihedralByTheJointValue) {
  const Molecule m = ubiquitin();
  const auto all = select_torsions(m, "all", true);
  for (std::size_t k = 0; k < all.size(); k += 7) {
    const std::size_t one[] = {all[k]};
    Hierarchy hierarchy(m.model(), m.select(one), AdmitAll{}, UniformClearance{1.0});
    const double q[] = {0.7};
    hierarchy.update(q);
    const auto& a = m.torsions()[all[k]].atoms;
    const auto x = hierarchy.placed();
    const double angle = dihedral(x[a[0]].position, x[a[1]].position, x[a[2]].position, x[a[3]].position);
    const double turned = std::remainder(angle - m.torsions()[all[k]].reference - 0.7, 2 * std::numbers::pi);
    EXPECT_NEAR(turned, 0.0, 1e-12) << m.torsions()[all[k]].name;
  }
}

// So side chains turn, and the rest of their chain stays.
TEST(Torsions, MoveAtMostHalfOfTheAtomsOfTheirMolecule) {
  for (const char* name :
       {"1ubq", "1crn.pdb", "1l2y.pdb", "2src.pdb", "4hhb.pdb", "1d66.pdb", "1ehz.pdb", "5pti.pdb"}) {
    SCOPED_TRACE(name);
    const Molecule m(read_structure(name == std::string("1ubq") ? test::ubiquitin() : test::molecule_file(name)));
    const KinematicTree& tree = m.model().tree();
    std::vector<std::size_t> moved(tree.link_count(), 0);  // per link: atoms on it and beyond it
    for (const LinkId link : m.model().links()) ++moved[index(link)];
    std::vector<std::size_t> component(tree.link_count());  // per link: its ancestor on the world
    for (std::size_t l = 1; l < component.size(); ++l) {
      const LinkId parent = tree.parent(id<LinkId>(l));
      component[l] = parent == LinkId{0} ? l : component[index(parent)];
    }
    for (std::size_t l = component.size(); l-- > 1;)
      if (component[l] != l) moved[index(tree.parent(id<LinkId>(l)))] += moved[l];
    std::size_t joints = 0;
    for (std::size_t l = 1; l < component.size(); ++l) {
      if (component[l] == l) continue;
      ++joints;
      EXPECT_LE(2 * moved[l], moved[component[l]]) << l;
    }
    EXPECT_GT(joints, 30U);
  }
}

TEST(Molecule, GivesItsCoordinatesBackAtTheReference) {
  const Molecule m = ubiquitin();
  Hierarchy hierarchy(m.model(), AdmitAll{}, UniformClearance{1.0});
  hierarchy.update(std::vector<double>(hierarchy.dof_count(), 0.0));
  const auto x = hierarchy.placed();
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(x[i].position, m.structure().models.front()[i]);
}

TEST(Molecule, KeepsBondsAndAnglesWhateverTheTorsions) {
  const Molecule m = ubiquitin();
  Hierarchy hierarchy(m.model(), AdmitAll{}, UniformClearance{1.0});
  std::vector<double> q(hierarchy.dof_count());
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = std::sin(static_cast<double>(k)) * 3.0;
  hierarchy.update(q);
  const auto x = hierarchy.placed();
  const auto& y = m.structure().models.front();
  const auto neighbours = bonded_neighbours(m.structure());
  for (std::uint32_t i = 0; i < x.size(); ++i)
    for (const std::uint32_t j : neighbours[i]) {
      EXPECT_NEAR((x[i].position - x[j].position).norm(), (y[i] - y[j]).norm(), 1e-10);
      for (const std::uint32_t k : neighbours[i]) {
        if (k == j) continue;
        EXPECT_NEAR((x[k].position - x[j].position).norm(), (y[k] - y[j]).norm(), 1e-10);
      }
    }
}

TEST(Molecule, CallsConstantExactlyThePairsThatNeverMove) {
  const Molecule m = ubiquitin();
  const auto free = select_torsions(m, "count:6", true);
  Hierarchy hierarchy(m.model(), m.select(free), AdmitAll{}, UniformClearance{1.0});
  const std::size_t n = m.model().size();
  std::vector<std::vector<Vec3>> conformations;
  for (int step = 0; step < 4; ++step) {
    std::vector<double> q(hierarchy.dof_count());
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = std::sin(static_cast<double>(k + 1) * (step + 1)) * 2.0;
    hierarchy.update(q);
    conformations.emplace_back();
    for (const Point& p : hierarchy.placed()) conformations.back().push_back(p.position);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      double low = 1e9, high = 0.0;
      for (const auto& x : conformations) {
        low = std::min(low, (x[i] - x[j]).norm());
        high = std::max(high, (x[i] - x[j]).norm());
      }
      EXPECT_EQ(hierarchy.model().constant(id<PrimitiveId>(i), id<PrimitiveId>(j)), high - low < 1e-9)
          << i << " " << j << " " << high - low;
    }
}

TEST(Molecule, ReportsDisulphidesAsClosures) {
  const auto file = test::molecule_file("1crn.pdb");
  auto molecule = std::make_shared<const Molecule>(read_structure(file));
  EXPECT_EQ(molecule->model().tree().closures().size(), 3U);
  const auto all = select_torsions(*molecule, "all", false);
  const CheckOptions rules;
  Checker checker(molecule, molecule->select(all), rules);
  std::vector<double> q(all.size(), 0.0);
  EXPECT_EQ(checker.check(q, Mode::parse("any")).closure_residual, 0.0);
  double worst = 0.0;
  for (double& value : q) {
    value = 0.5;
    worst = std::max(worst, checker.check(q, Mode::parse("any")).closure_residual);
  }
  EXPECT_GT(worst, 1.0);
}

TEST(BasicGroups, PutExclusionsOnlyWhereThePaperSays) {
  const Molecule m = ubiquitin();
  const auto labels = basic_groups(m.structure());
  const BondExclusions exclusions(m.structure(), 4);
  // Label 2r is the pseudo-backbone of residue r, 2r + 1 its pseudo-side-chain.
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (const PrimitiveId j : exclusions.excluded(id<PrimitiveId>(i))) {
      const std::uint32_t a = std::min(labels[i], labels[index(j)]), b = std::max(labels[i], labels[index(j)]);
      const bool own = a / 2 == b / 2, next_backbone = a % 2 == 0 && b == a + 2;
      EXPECT_TRUE(own || next_backbone) << a << " " << b;
    }
}

TEST(Selection, UnderstandsItsWords) {
  const Molecule m = ubiquitin();
  EXPECT_TRUE(select_torsions(m, "none", true).empty());
  EXPECT_EQ(select_torsions(m, "A:48", false).size(), 6U);  // lysine
  EXPECT_EQ(select_torsions(m, "A:48", true).size(), 7U);
  EXPECT_EQ(select_torsions(m, "A:48:chi1", false).size(), 1U);
  EXPECT_EQ(select_torsions(m, "A:48:chi1,A:48", false).size(), 6U);
  EXPECT_EQ(select_torsions(m, "A:47-48:backbone", false).size(), 4U);
  EXPECT_EQ(select_torsions(m, "backbone", false).size() + select_torsions(m, "chi", false).size(), 299U);
  EXPECT_EQ(select_torsions(m, "phi,psi", false), select_torsions(m, "backbone", false));
  const auto loops = select_torsions(m, "loops", false);
  for (const std::size_t k : loops)
    for (const auto& element : m.structure().secondary_structure)
      EXPECT_FALSE(element.first <= m.torsions()[k].residue && m.torsions()[k].residue <= element.last);
  std::set<std::uint32_t> residues;
  for (const std::size_t k : select_torsions(m, "every:4", false)) residues.insert(m.torsions()[k].residue);
  EXPECT_EQ(*residues.begin(), 3U);
  EXPECT_EQ(residues.size(), 19U);
}

TEST(Selection, RefusesWhatItDoesNotUnderstand) {
  const Molecule m = ubiquitin();
  for (const char* word :
       {"", "alll", "A:", "A:500", "B:1", "A:20-10", "A:5:chi9", "count:0", "count:77", "every:x", "chi9"})
    EXPECT_THROW(select_torsions(m, word, false), ModelError) << word;
}

TEST(IdealProtein, HasIdealBondsClosedRingsAndTheHandOfNature) {
  const std::string sequence = "ACDEFGHIKLMNPQRSTVWYPA";
  const Structure s = build_ideal_protein(sequence, std::string(sequence.size(), 'C'));
  const auto& x = s.models.front();
  for (const Bond& bond : s.bonds) {
    const double d = (x[bond.first] - x[bond.second]).norm();
    EXPECT_GT(d, 1.2) << label(s, bond.first) << " " << label(s, bond.second);
    EXPECT_LT(d, 1.82) << label(s, bond.first) << " " << label(s, bond.second);
  }
  EXPECT_TRUE(s.notes.empty());
  const auto chirality = [](const Structure& t, const Residue& residue) {
    std::map<std::string, Vec3> at;
    for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i) at[t.atoms[i].name] = t.models.front()[i];
    return dihedral(at.at("C"), at.at("N"), at.at("CA"), at.at("CB"));
  };
  const Structure natural = read_structure(test::ubiquitin());
  const double reference = chirality(natural, natural.residues[0]);
  for (const Residue& residue : s.residues)
    if (residue.name != "GLY") {
      EXPECT_NEAR(chirality(s, residue), reference, 0.2) << residue.name;
    }
}

TEST(IdealProtein, RefusesBadInputNamingThePosition) {
  EXPECT_THROW(build_ideal_protein("", ""), ModelError);
  EXPECT_THROW(build_ideal_protein("AA", "H"), ModelError);
  EXPECT_THROW(build_ideal_protein("AXA", "HHH"), ModelError);
  EXPECT_THROW(build_ideal_protein("AAA", "HQH"), ModelError);
}

}  // namespace mechanism_test
}  // namespace hinge::molecular
