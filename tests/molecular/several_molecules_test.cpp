// SPDX-License-Identifier: BSD-3-Clause
// Tests several molecules in one query: parts, joined files, placements, and scopes of pairs.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "extremes/refusal.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/join_structures.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/policy/laws.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace several_molecules_test {

constexpr double pi = std::numbers::pi;

Structure protein(const std::string& sequence) {
  return build_ideal_protein(sequence, std::string(sequence.size(), 'C'));
}

Structure moved(Structure structure, const Vec3& by) {
  for (auto& model : structure.models)
    for (Vec3& x : model) x += by;
  return structure;
}

/// A ring of six carbons with a tail of two, and an ion: hetero groups in the format of docking programs.
Structure ligand() {
  std::string text;
  char line[96];
  const auto add = [&](int serial, const char* name, const char* residue, int number, double x, double y, double z,
                       const char* element) {
    std::snprintf(line, sizeof line, "HETATM%5d  %-3s %3s L%4d    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n", serial,
                  name, residue, number, x, y, z, element);
    text += line;
  };
  for (int k = 0; k < 6; ++k)
    add(k + 1, ("C" + std::to_string(k + 1)).c_str(), "LIG", 1, 1.39 * std::cos(k * pi / 3),
        1.39 * std::sin(k * pi / 3), 0, "C");
  add(7, "C7", "LIG", 1, 2.9, 0, 0, "C");
  add(8, "O8", "LIG", 1, 3.6, 1.2, 0, "O");
  add(9, "ZN", " ZN", 2, 9.0, 0, 0, "ZN");
  const test::TemporaryFile file(text + "END\n");
  ReadOptions options;
  options.hetero = true;
  return read_structure(file.path(), options);
}

/// Two neighbouring proteins and the ligand.
Structure scene() {
  return join_structures({protein("AKFDE"), moved(protein("GWSR"), {4, 9, 3}), moved(ligand(), {-5, 4, 6})});
}

std::string refusal(const auto& act) { return test::refusal<ModelError>(act); }

std::vector<std::size_t> all_torsions(const Molecule& molecule) { return select_torsions(molecule, "all", true); }

// --- parts ---

TEST(Part, FindsChainsLigandsResiduesAndFiles) {
  const Structure s = scene();
  ASSERT_EQ(s.residues.size(), 11U);
  using Residues = std::vector<std::uint32_t>;
  EXPECT_EQ(find_part(s, "A").residues, (Residues{0, 1, 2, 3, 4}));
  EXPECT_EQ(find_part(s, "B").residues, (Residues{5, 6, 7, 8}));
  EXPECT_EQ(find_part(s, "L").residues, (Residues{9, 10}));
  EXPECT_EQ(find_part(s, "LIG").residues, (Residues{9}));
  EXPECT_EQ(find_part(s, "L:ZN").residues, (Residues{10}));
  EXPECT_EQ(find_part(s, "L:2").residues, (Residues{10}));
  EXPECT_EQ(find_part(s, "A:2-4").residues, (Residues{1, 2, 3}));
  EXPECT_EQ(find_part(s, "file:2").residues, (Residues{5, 6, 7, 8}));
  EXPECT_EQ(find_part(s, "L+A:2+A:2-3").residues, (Residues{1, 2, 9, 10}));
  EXPECT_EQ(find_part(s, "L+A:2+A:2-3").name, "L+A:2+A:2-3");
  EXPECT_EQ(rest_of(s, find_part(s, "file:1+file:3")).residues, (Residues{5, 6, 7, 8}));
  const std::vector<bool> in = atoms_in(s, find_part(s, "L:ZN"));
  EXPECT_EQ(std::count(in.begin(), in.end(), true), 1);
  EXPECT_TRUE(in.back());
}

TEST(Part, SaysWhatItCouldNotFind) {
  const Structure s = join_structures({scene(), moved(ligand(), {20, 0, 0})});
  EXPECT_EQ(refusal([&] { find_part(s, "Q"); }),
            "selection 'Q': expected a chain (A B L C), the name of a residue, CHAIN:RESIDUES or file:N");
  EXPECT_EQ(refusal([&] { find_part(s, "Q:3"); }),
            "selection 'Q:3': expected a chain (A B L C); there is no chain 'Q'");
  EXPECT_EQ(
      refusal([&] { find_part(s, "A:99"); }),
      "selection 'A:99': expected a residue of chain A; the chain has no residue 99, it goes from A:ALA1 to A:GLU5");
  EXPECT_EQ(refusal([&] { find_part(s, "A:TRP"); }),
            "selection 'A:TRP': expected CHAIN:45, CHAIN:10-20 or CHAIN:NAME of a residue in the structure");
  EXPECT_EQ(refusal([&] { find_part(s, "A:4-2"); }),
            "selection 'A:4-2': expected the first residue to come before the last");
  EXPECT_EQ(refusal([&] { find_part(s, "file:5"); }), "selection 'file:5': expected file:N with N from 1 to 4");
  EXPECT_EQ(refusal([&] { find_part(s, "A+"); }), "selection 'A+', at its end: expected a selection word or '('");
  EXPECT_EQ(find_part(s, "LIG").residues.size(), 2U);
  EXPECT_EQ(refusal([&] { find_part(s, "LIG", ResidueNames::only); }),
            "selection 'LIG': expected one residue, found 2: L:LIG1 C:LIG1; choose one as CHAIN:NUMBER");
  EXPECT_EQ(refusal([&] { rest_of(s, find_part(s, "A+B+L+C")); }),
            "the rest of 'A+B+L+C' is empty: the part holds all residues, expected fewer");
}

// --- joined files ---

TEST(JoinStructures, KeepsEveryMoleculeAsItWas) {
  const std::vector<Structure> parts{protein("AKFDE"), moved(protein("GWSR"), {4, 9, 3}), moved(ligand(), {-5, 4, 6})};
  const Structure all = join_structures(parts);
  std::uint32_t atom = 0, file = 0;
  std::size_t bond = 0;
  for (const Structure& part : parts) {
    for (std::uint32_t i = 0; i < part.atoms.size(); ++i) {
      const Residue &joined = all.residues[all.atoms[atom + i].residue], &own = part.residues[part.atoms[i].residue];
      EXPECT_EQ(all.atoms[atom + i].name, part.atoms[i].name);
      EXPECT_EQ(joined.name, own.name);
      EXPECT_LE(joined.first_atom, atom + i);
      EXPECT_GT(joined.last_atom, atom + i);
      EXPECT_EQ(all.chains[joined.chain].file, file);
      EXPECT_EQ(all.models[0][atom + i], part.models[0][i]);
    }
    for (const Bond& own : part.bonds) {
      EXPECT_EQ(all.bonds[bond].first, own.first + atom);
      EXPECT_EQ(all.bonds[bond++].second, own.second + atom);
    }
    atom += static_cast<std::uint32_t>(part.atoms.size());
    ++file;
  }
  EXPECT_EQ(atom, all.atoms.size());
  EXPECT_EQ(bond, all.bonds.size());
  for (std::uint32_t c = 0; c < all.chains.size(); ++c)
    for (std::uint32_t r = all.chains[c].first_residue; r < all.chains[c].last_residue; ++r)
      EXPECT_EQ(all.residues[r].chain, c);
}

TEST(JoinStructures, RenamesChainsThatClashAndSaysSo) {
  const Structure all = join_structures({protein("AAA"), ligand(), protein("GG"), ligand()});
  std::vector<std::string> names;
  for (const Chain& chain : all.chains) names.push_back(chain.name);
  EXPECT_EQ(names, (std::vector<std::string>{"A", "L", "B", "C"}));
  const std::string note =
      "chain A of file 3 (" + protein("GG").name + ") is called B here: an earlier file has a chain A";
  EXPECT_NE(std::find(all.notes.begin(), all.notes.end(), note), all.notes.end());
  EXPECT_EQ(
      label(all, find_part(all, "file:4").residues.empty() ? 0 : static_cast<std::uint32_t>(all.atoms.size() - 1)),
      "C:ZN2:ZN");
}

TEST(JoinStructures, PairsModelsOfOneFileWithAllOthers) {
  Structure poses = ligand();
  for (int k = 2; k <= 3; ++k) {
    poses.models.push_back(moved(ligand(), {10.0 * k, 0, 0}).models[0]);
    poses.model_numbers.push_back(7 * k);
  }
  const Structure receptor = protein("AAA");
  for (const bool receptor_first : {true, false}) {
    const Structure all = receptor_first ? join_structures({receptor, poses}) : join_structures({poses, receptor});
    ASSERT_EQ(all.models.size(), 3U);
    EXPECT_EQ(all.model_numbers[2], 21);
    for (const auto& model : all.models) {
      ASSERT_EQ(model.size(), all.atoms.size());
      EXPECT_EQ(model[receptor_first ? 0 : poses.atoms.size()], receptor.models[0][0]);
    }
    EXPECT_EQ(all.models[2][receptor_first ? receptor.atoms.size() : 0], poses.models[2][0]);
  }
  EXPECT_EQ(refusal([&] {
              join_structures({poses, receptor, poses});
            }),
            "joining structures: " + poses.name + "+" + receptor.name + "+" + poses.name +
                " have 3 and 3 models, expected a single model in one of them");
  EXPECT_THROW(join_structures({}), ModelError);
}

// --- placed parts ---

Eigen::Matrix3d own_rotation(const std::array<double, 6>& q) {
  return (Eigen::AngleAxisd(q[3], Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(q[4], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(q[5], Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

/// Returns the values of PlacedPart::dofs of each placed part in q: angstrom, then rad.
std::vector<std::array<double, 6>> placements(const Molecule& molecule, const DofSelection& selection,
                                              const std::vector<double>& q) {
  std::vector<std::array<double, 6>> all;
  for (const PlacedPart& placed : molecule.placed_parts()) {
    all.emplace_back();
    for (std::size_t k = 0; k < 6; ++k)
      all.back()[k] =
          q[static_cast<std::size_t>(std::ranges::find(selection.dofs(), placed.dofs[k]) - selection.dofs().begin())];
  }
  return all;
}

TEST(PlacedPart, MovesAsOwnMatricesSayWhateverTurnsInside) {
  const auto still = std::make_shared<const Molecule>(scene());
  const auto molecule = std::make_shared<const Molecule>(
      scene(), MoleculeOptions{.placed = {find_part(scene(), "LIG"), find_part(scene(), "B+L:ZN")}});
  const Structure& s = molecule->structure();
  const DofSelection selection = molecule->select_placed(all_torsions(*molecule));
  const DofSelection torsions = still->select(all_torsions(*still));
  ASSERT_EQ(selection.size(), torsions.size() + 12);
  Checker placed(molecule, selection, {}), bare(still, torsions, {});
  const std::vector<PlacementRange> ranges{{20.0, pi}, {3.0, 1.0}};
  for (std::uint64_t k = 0; k < 200; ++k) {
    const auto q = sample_configuration({11, {}}, k, *molecule, selection, ranges);
    placed.check(q, Mode::parse("any"));
    bare.check(sample_configuration({11, {}}, k, torsions.size()), Mode::parse("any"));
    const auto got = placed.positions(), from = bare.positions();
    const auto values = placements(*molecule, selection, q);
    for (std::size_t p = 0; p < 2; ++p) {
      const std::vector<bool> in = atoms_in(s, molecule->placed_parts()[p].part);
      Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      double count = 0;
      for (std::size_t i = 0; i < in.size(); ++i)
        if (in[i]) {
          centre += s.models[0][i];
          ++count;
        }
      centre /= count;
      const Eigen::Matrix3d turn = own_rotation(values[p]);
      const Eigen::Vector3d move(values[p][0], values[p][1], values[p][2]);
      for (std::size_t i = 0; i < in.size(); ++i) {
        if (!in[i]) continue;
        ASSERT_LT((got[i] - (centre + turn * (from[i] - centre) + move)).norm(), 1e-10) << k << " atom " << i;
      }
    }
    for (std::uint32_t i = 0; i < s.residues[find_part(s, "A").residues.back()].last_atom; ++i)
      ASSERT_EQ(got[i], from[i]);
  }
  placed.check(std::vector<double>(selection.size(), 0.0), Mode::parse("any"));
  EXPECT_EQ(placed.positions(), s.models[0]) << "the reference, bit for bit";
}

TEST(PlacedPart, NamesEveryDegreeOfFreedom) {
  const Molecule molecule(scene(), {.placed = {find_part(scene(), "L:LIG")}});
  const KinematicTree& tree = molecule.model().tree();
  std::vector<std::string> names;
  for (const DofId dof : molecule.placed_parts()[0].dofs) names.push_back(tree.joint(tree.link_of(dof)).name);
  EXPECT_EQ(names, (std::vector<std::string>{"move L:LIG x", "move L:LIG y", "move L:LIG z", "turn L:LIG x",
                                             "turn L:LIG y", "turn L:LIG z"}));
  for (const DofId dof : molecule.placed_parts()[0].dofs) EXPECT_EQ(molecule.torsion_of(dof), Molecule::no_torsion);
  // The map from DOF to torsions stays correct.
  for (std::size_t k = 0; k < molecule.torsions().size(); ++k) EXPECT_EQ(molecule.torsion_of(molecule.dof(k)), k);
}

TEST(PlacedPart, IsRefusedWhereABondHoldsIt) {
  Structure bonded = join_structures({protein("AC"), moved(protein("CA"), {0, 0, 6})});
  std::uint32_t first = 0, second = 0;
  for (std::uint32_t i = 0; i < bonded.atoms.size(); ++i)
    if (bonded.atoms[i].name == "SG") (first == 0 ? first : second) = i;
  bonded.bonds.push_back({first, second, BondOrigin::disulphide});
  std::ranges::sort(bonded.bonds, {}, [](const Bond& b) { return std::pair(b.first, b.second); });
  EXPECT_EQ(refusal([&] { Molecule(bonded, {.placed = {find_part(bonded, "B")}}); }),
            "placing 'B': B:CYS1:SG is bonded to A:CYS2:SG outside the part, expected a part without "
            "bonds to the rest (write A+B to place A and B together)");
  EXPECT_NE(refusal([&] {
              Molecule(bonded, {.placed = {find_part(bonded, "A"), find_part(bonded, "B")}});
            }).find("is bonded to"),
            std::string::npos);
  EXPECT_NE(refusal([&] { Molecule(bonded, {.placed = {find_part(bonded, "A:1")}}); }).find("is bonded to A:CYS2:N"),
            std::string::npos);
  EXPECT_NO_THROW(Molecule(bonded, {.placed = {find_part(bonded, "A+B")}}));
  EXPECT_EQ(refusal([&] {
              Molecule(scene(), {.placed = {find_part(scene(), "L"), find_part(scene(), "LIG")}});
            }),
            "placing 'LIG': L:LIG1:C1 already belongs to placed part 'L'");
  EXPECT_EQ(refusal([&] { Molecule(scene(), {.placed = {Part{"x", {}}}}); }), "placing 'x': the part holds no atoms");
}

TEST(PlacedPart, LeavesPairsInsideARigidOneAlone) {
  const auto molecule = std::make_shared<const Molecule>(
      scene(), MoleculeOptions{.placed = {find_part(scene(), "B"), find_part(scene(), "L")}});
  const Structure& s = molecule->structure();
  const Checker checker(molecule, molecule->select_placed({}), {});
  const auto group = [&](const char* words) {
    return checker.group_of(s.residues[find_part(s, words).residues[0]].first_atom);
  };
  EXPECT_EQ(index(group("A")), 0U);
  EXPECT_NE(group("B"), group("L:LIG"));
  EXPECT_EQ(group("L:ZN"), group("L:LIG"));
  EXPECT_EQ(checker.rigid_groups().size(), 13U) << "six joints each, five of them between frames without atoms";
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i)
    for (std::uint32_t j = 0; j < i; ++j) EXPECT_EQ(checker.constant(i, j), checker.group_of(i) == checker.group_of(j));
}

// --- one query ---

/// Tests that the three engines give the same answers in every mode.
void expect_equal_engines(const std::shared_ptr<const Molecule>& molecule, const std::vector<std::size_t>& torsions,
                          const std::vector<PlacementRange>& ranges, CheckOptions rules, const Sampling& sampling,
                          std::uint64_t count) {
  const DofSelection selection = molecule->select_placed(torsions);
  Checker simd(molecule, selection, rules);
  rules.engine = "lazy";
  Checker lazy(molecule, selection, rules);
  rules.engine = "brute";
  Checker brute(molecule, selection, rules);
  std::uint64_t colliding = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto q = sample_configuration(sampling, k, *molecule, selection, ranges);
    for (const char* text : {"any", "all", "within:0.5", "closest"}) {
      const Mode mode = Mode::parse(text);
      const Verdict expected = brute.check(q, mode);
      for (Checker* checker : {&simd, &lazy}) {
        const Verdict verdict = checker->check(q, mode);
        ASSERT_EQ(verdict.collides, expected.collides) << text << " seed " << sampling.seed << " sample " << k;
        ASSERT_EQ(verdict.pairs, expected.pairs) << text << " seed " << sampling.seed << " sample " << k;
        ASSERT_EQ(verdict.closest, expected.closest) << text << " seed " << sampling.seed << " sample " << k;
      }
      if (mode.kind == Mode::Kind::any) colliding += expected.collides ? 1 : 0;
    }
    if (k % 10 != 0) continue;
    const auto positions = brute.positions();
    const Mode all = Mode::parse("all");
    ASSERT_EQ(simd.check_coordinates(positions, all).pairs, brute.check_coordinates(positions, all).pairs);
    ASSERT_EQ(lazy.check_coordinates(positions, all).pairs, brute.check_coordinates(positions, all).pairs);
  }
  std::printf("seed %d: %d of %d collide\n", static_cast<int>(sampling.seed), static_cast<int>(colliding),
              static_cast<int>(count));
}

std::uint64_t rounds(std::uint64_t few) { return std::getenv("HINGE_TEST_ALL") != nullptr ? 40 * few : few; }

PairScope scope(const Structure& s, const std::vector<std::pair<std::string, std::string>>& between,
                const std::vector<std::string>& inside) {
  std::vector<std::pair<Part, Part>> pairs;
  std::vector<Part> parts;
  for (const auto& [a, b] : between) pairs.emplace_back(find_part(s, a), find_part(s, b));
  for (const std::string& words : inside) parts.push_back(find_part(s, words));
  return {s, pairs, parts};
}

TEST(SeveralMolecules, GetTheSameAnswersFromEveryEngine) {
  const Structure s = scene();
  CheckOptions all, docking, mixed;
  docking.scope = scope(s, {{"L", "A+B"}}, {});
  mixed.scope = scope(s, {{"A", "B"}}, {"B"});
  std::uint64_t seed = 1;
  for (const auto& words : {std::vector<std::string>{"L"}, {"B", "LIG"}, {"A", "B", "L:LIG", "L:ZN"}, {"A+B"}}) {
    std::vector<Part> parts;
    std::vector<PlacementRange> ranges;
    for (const std::string& word : words) {
      parts.push_back(find_part(s, word));
      ranges.push_back({6.0, pi});
    }
    const auto molecule = std::make_shared<const Molecule>(s, MoleculeOptions{.placed = parts});
    for (const CheckOptions& rules : {all, docking, mixed})
      for (const char* free : {"none", "all", "B:chi"})
        expect_equal_engines(molecule, select_torsions(*molecule, free, false), ranges, rules, {seed++, {}},
                             rounds(30));
  }
}

/// Compares with an independent evaluation of pairs of rigid parts: own matrices, distances and bond graph.
TEST(SeveralMolecules, AgreeWithOwnMatricesAndDistances) {
  const Structure s =
      join_structures({protein("AKFDEGW"), moved(protein("GWSR"), {4, 9, 3}), moved(ligand(), {-5, 4, 6})});
  const auto molecule =
      std::make_shared<const Molecule>(s, MoleculeOptions{.placed = {find_part(s, "B"), find_part(s, "L")}});
  const DofSelection selection = molecule->select_placed({});
  Checker checker(molecule, selection, {});
  const TypedThresholds thresholds = make_thresholds(s).matrix;
  const std::vector<PlacementRange> ranges{{5.0, pi}, {8.0, pi / 3}};
  std::size_t colliding = 0;
  for (std::uint64_t k = 0; k < rounds(300); ++k) {
    const auto q = sample_configuration({5, {}}, k, *molecule, selection, ranges);
    std::vector<Eigen::Vector3d> x(s.models[0].begin(), s.models[0].end());
    std::vector<int> part_of(x.size(), -1);
    const auto values = placements(*molecule, selection, q);
    for (int p = 0; p < 2; ++p) {
      const PlacedPart& placed = molecule->placed_parts()[static_cast<std::size_t>(p)];
      const auto& value = values[static_cast<std::size_t>(p)];
      const std::vector<bool> in = atoms_in(s, placed.part);
      for (std::size_t i = 0; i < x.size(); ++i) {
        if (!in[i]) continue;
        part_of[i] = p;
        x[i] = own_rotation(value) * (x[i] - placed.centre) + placed.centre +
               Eigen::Vector3d(value[0], value[1], value[2]);
      }
    }
    std::set<std::pair<std::size_t, std::size_t>> expected;
    bool doubtful = false;
    double least = 1e9;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = i + 1; j < x.size(); ++j) {
        if (part_of[i] == part_of[j]) continue;  // constant; no bond joins different parts
        const double gap = (x[i] - x[j]).norm() - thresholds.threshold(id<PrimitiveId>(i), id<PrimitiveId>(j));
        doubtful = doubtful || std::abs(gap) < 1e-9;
        least = std::min(least, gap);
        if (gap < 0) expected.emplace(i, j);
      }
    if (doubtful) continue;
    const Verdict verdict = checker.check(q, Mode::parse("all"));
    std::set<std::pair<std::size_t, std::size_t>> found;
    for (const Contact& pair : verdict.pairs) found.emplace(index(pair.hit.first), index(pair.hit.second));
    ASSERT_EQ(found, expected) << "sample " << k;
    ASSERT_EQ(checker.check(q, Mode::parse("any")).collides, !expected.empty());
    ASSERT_NEAR(checker.check(q, Mode::parse("closest")).closest->hit.gap(), least, 1e-9);
    colliding += expected.empty() ? 0 : 1;
  }
  EXPECT_GT(colliding, rounds(300) / 10);
  EXPECT_LT(colliding, rounds(300) * 9 / 10);
}

// --- which pairs count ---

TEST(PairScope, HoldsWhatItsPartsSay) {
  // Expected by hand: a chain with residues A1 and A2, a residue B1, and two ligand residues L1 and L2.
  const Structure s = join_structures({protein("GG"), moved(protein("G"), {20, 0, 0}), moved(ligand(), {0, 20, 0})});
  const auto atom = [&](const char* words) {
    return id<PrimitiveId>(s.residues[find_part(s, words).residues[0]].first_atom);
  };
  const PrimitiveId a1 = atom("A:1"), a2 = atom("A:2"), b = atom("B"), l1 = atom("LIG"), l2 = atom("L:ZN");
  const auto held = [&](const PairScope& asked) {
    std::string text;
    const std::pair<const char*, PrimitiveId> atoms[] = {{"a1", a1}, {"a2", a2}, {"b", b}, {"l1", l1}, {"l2", l2}};
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = i + 1; j < 5; ++j) {
        EXPECT_EQ(asked.holds(atoms[i].second, atoms[j].second), asked.holds(atoms[j].second, atoms[i].second));
        if (asked.holds(atoms[i].second, atoms[j].second)) text += std::string(atoms[i].first) + atoms[j].first + " ";
      }
    return text;
  };
  EXPECT_EQ(held({}), "a1a2 a1b a1l1 a1l2 a2b a2l1 a2l2 bl1 bl2 l1l2 ");
  EXPECT_EQ(held(scope(s, {{"A", "B"}}, {})), "a1b a2b ");
  EXPECT_EQ(held(scope(s, {{"A:2", "L"}}, {})), "a2l1 a2l2 ");
  EXPECT_EQ(held(scope(s, {{"A", "B"}, {"LIG", "A+B"}}, {})), "a1b a1l1 a2b a2l1 bl1 ");
  EXPECT_EQ(held(scope(s, {}, {"A"})), "a1a2 ");
  EXPECT_EQ(held(scope(s, {}, {"A+LIG", "L"})), "a1a2 a1l1 a2l1 l1l2 ");
  EXPECT_EQ(held(scope(s, {{"A:1", "A:2"}}, {"B"})), "a1a2 ");
  EXPECT_EQ(refusal([&] {
              scope(s, {{"A", "B+A:2"}}, {});
            }),
            "between 'A' and 'B+A:2': both parts hold A:GLY2, expected two parts without common residues");
}

TEST(PairScope, MakesALawfulFilter) {
  const Structure s = join_structures({protein("GA"), moved(ligand(), {0, 20, 0})});
  for (const PairScope& asked : {PairScope(), scope(s, {{"A", "L"}}, {}), scope(s, {{"A:1", "L"}}, {"A"})})
    EXPECT_EQ(laws::check_pair_filter(BondExclusions(s, 4, {}, asked), s.atoms.size()), laws::Violations{});
}

/// Tests that a scoped query gives the answers of the whole query without the pairs outside its scope.
TEST(PairScope, LeavesOutNothingElse) {
  const Structure s = scene();
  const auto molecule =
      std::make_shared<const Molecule>(s, MoleculeOptions{.placed = {find_part(s, "B"), find_part(s, "L")}});
  const DofSelection selection = molecule->select_placed(all_torsions(*molecule));
  const std::vector<PlacementRange> ranges{{4.0, pi}, {4.0, pi}};
  for (const PairScope& asked : {scope(s, {{"A", "B"}}, {}), scope(s, {{"L", "A"}}, {"B"}), scope(s, {}, {"A"})})
    for (const char* engine : {"simd", "lazy", "brute"}) {
      CheckOptions rules;
      rules.engine = engine;
      Checker whole(molecule, selection, rules);
      rules.scope = asked;
      Checker part(molecule, selection, rules);
      std::vector<Hit> reference;
      for (const Hit& hit : whole.reference_collisions())
        if (asked.holds(hit.first, hit.second)) reference.push_back(hit);
      EXPECT_TRUE(std::ranges::equal(part.reference_collisions(), reference));
      for (std::uint64_t k = 0; k < rounds(20); ++k) {
        const auto q = sample_configuration({3, {}}, k, *molecule, selection, ranges);
        for (const char* text : {"all", "within:2"}) {
          std::vector<Contact> expected;
          for (const Contact& pair : whole.check(q, Mode::parse(text)).pairs)
            if (asked.holds(pair.hit.first, pair.hit.second)) expected.push_back(pair);
          ASSERT_EQ(part.check(q, Mode::parse(text)).pairs, expected) << engine << " " << text << " sample " << k;
        }
        const auto everything = whole.check(q, Mode::parse("within:200")).pairs;
        double least = 1e9;
        for (const Contact& pair : everything)
          if (asked.holds(pair.hit.first, pair.hit.second)) least = std::min(least, pair.hit.gap());
        ASSERT_EQ(part.check(q, Mode::parse("closest")).closest->hit.gap(), least) << engine << " sample " << k;
        ASSERT_EQ(part.check(q, Mode::parse("any")).collides, least < 0) << engine << " sample " << k;
      }
    }
}

// --- samples ---

TEST(SamplePlacement, StaysWithinItsRange) {
  for (const double turn : {0.0, 1e-6, 0.3, pi / 2, 1.7, 3.0, pi})
    for (const double distance : {0.0, 1e-3, 7.0}) {
      double farthest = 0, widest = 0;
      for (std::uint64_t k = 0; k < 400; ++k) {
        SampleStream stream(9, k);
        const auto q = sample_placement(stream, {distance, turn});
        farthest = std::max(farthest, Eigen::Vector3d(q[0], q[1], q[2]).norm());
        widest = std::max(widest, Eigen::AngleAxisd(own_rotation(q)).angle());
      }
      EXPECT_LE(farthest, distance * (1 + 1e-12));
      EXPECT_GE(farthest, 0.9 * distance);
      EXPECT_LE(widest, turn + 1e-7);
      EXPECT_GE(widest, 0.9 * turn);
    }
}

/// r^3 is uniform for a uniform ball; t - sin t and the axis are uniform for the invariant measure. The Kolmogorov
/// distance of 4000 samples exceeds 0.0257 for one seed in a hundred; this seed is fixed.
TEST(SamplePlacement, IsUniform) {
  constexpr std::size_t count = 4000;
  for (const double turn : {0.5, pi / 2, 2.0, pi}) {
    std::vector<double> radii, turns, heights, sines;
    for (std::uint64_t k = 0; k < count; ++k) {
      SampleStream stream(17, k);
      const auto q = sample_placement(stream, {2.0, turn});
      const Eigen::AngleAxisd rotation(own_rotation(q));
      radii.push_back(std::pow(Eigen::Vector3d(q[0], q[1], q[2]).norm() / 2.0, 3));
      turns.push_back((rotation.angle() - std::sin(rotation.angle())) / (turn - std::sin(turn)));
      heights.push_back((rotation.axis().y() + 1) / 2);
      sines.push_back((rotation.axis().x() + 1) / 2);
    }
    for (std::vector<double>* values : {&radii, &turns, &heights, &sines}) {
      std::ranges::sort(*values);
      double worst = 0;
      for (std::size_t k = 0; k < count; ++k)
        worst = std::max(worst, std::abs((*values)[k] - (static_cast<double>(k) + 0.5) / count));
      EXPECT_LT(worst, 0.0257) << "turn " << turn;
    }
  }
}

TEST(SampleConfiguration, KeepsTorsionsAndPlacementsWhateverElseIsFree) {
  const Structure s = scene();
  const Molecule molecule(s, {.placed = {find_part(s, "B")}}),
      more(s, {.placed = {find_part(s, "B"), find_part(s, "LIG")}});
  const DofSelection selection = molecule.select_placed(all_torsions(molecule));
  const Sampling sampling{42, 0.1};
  const std::vector<PlacementRange> ranges{{5, 1}};
  const auto q = sample_configuration(sampling, 3, molecule, selection, ranges);
  std::vector<double> torsions;
  for (std::size_t k = 0; k < selection.size(); ++k)
    if (std::ranges::find(molecule.placed_parts()[0].dofs, selection.dofs()[k]) ==
        molecule.placed_parts()[0].dofs.end())
      torsions.push_back(q[k]);
  EXPECT_EQ(torsions, sample_configuration(sampling, 3, selection.size() - 6));
  const DofSelection rigid = more.select_placed({});
  const std::vector<PlacementRange> two{{5, 1}, {7, 2}};
  const auto alone = placements(more, rigid, sample_configuration(sampling, 3, more, rigid, two));
  EXPECT_EQ(alone[0], placements(molecule, selection, q)[0]);
  EXPECT_NE(alone[0][0] / 5, alone[1][0] / 7) << "each part has a stream of its own";
  EXPECT_EQ(q, sample_configuration(sampling, 3, molecule, selection, ranges)) << "a function of (seed, index)";
  EXPECT_NE(q, sample_configuration(sampling, 4, molecule, selection, ranges));
  EXPECT_THROW(sample_configuration(sampling, 3, molecule, selection, {}), ModelError);
  for (const PlacementRange& bad : {PlacementRange{-1, 1}, {NAN, 1}, {1, -1}, {1, 4}, {1, NAN}, {INFINITY, 1}})
    EXPECT_THROW(sample_configuration(sampling, 3, molecule, selection, std::vector{bad}), ModelError);
}

// --- real complexes ---

Structure real(const char* name) {
  ReadOptions options;
  options.hetero = true;
  options.keep_hydrogens = false;
  return read_structure(test::molecule_file(name), options);
}

TEST(SeveralMolecules, RealComplexes) {
  struct Complex {
    const char* file;
    std::vector<std::string> placed;
    const char* free;
  };
  const Complex complexes[] = {{"1hpx.pdb", {"KNI"}, "A:48-52"},
                               {"1a4w.pdb", {"I", "H:DAR+H:ANS+H:2EP+H:KTH"}, "I:chi"},
                               {"1d66.pdb", {"D+E"}, "A:45-50"},
                               {"4hhb.pdb.gz", {"A+B"}, "none"}};
  std::uint64_t seed = 100;
  for (const Complex& c : complexes) {
    const Structure s = real(c.file);
    std::vector<Part> parts;
    std::vector<PlacementRange> near, far;
    for (const std::string& words : c.placed) {
      parts.push_back(find_part(s, words, ResidueNames::only));
      near.push_back({0.1, 0.01});
      far.push_back({30.0, pi});
    }
    CheckOptions rules;
    rules.scope = PairScope(s, std::vector{std::pair(parts[0], rest_of(s, parts[0]))}, {});
    rules.exempt_reference = rules.exempt_interfaces = true;
    const auto molecule = std::make_shared<const Molecule>(s, MoleculeOptions{.placed = parts});
    const auto torsions = select_torsions(*molecule, c.free, false);
    std::printf("%s: %zu atoms, %zu torsions free\n", c.file, s.atoms.size(), torsions.size());
    expect_equal_engines(molecule, torsions, near, rules, {seed++, 0.002}, rounds(2));
    expect_equal_engines(molecule, torsions, far, rules, {seed++, {}}, rounds(2));
  }
}

TEST(SeveralMolecules, RealChainsThatABondHolds) {
  const Structure thrombin = real("1a4w.pdb");
  EXPECT_NE(refusal([&] {
              Molecule(thrombin, {.placed = {find_part(thrombin, "L")}});
            }).find("placing 'L': L:CYS1:SG is bonded to H:CYS122:SG"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              Molecule(real("4hhb.pdb.gz"), {.placed = {find_part(real("4hhb.pdb.gz"), "HEM", ResidueNames::only)}});
            }).find("expected one residue, found 4: A:HEM142"),
            std::string::npos);
  if (!std::filesystem::exists(test::molecule_file("1igy.cif.gz"))) return;
  const Structure antibody = real("1igy.cif.gz");
  EXPECT_NE(refusal([&] { Molecule(antibody, {.placed = {find_part(antibody, "A")}}); }).find("is bonded to B:CYS"),
            std::string::npos);
}

}  // namespace several_molecules_test
}  // namespace hinge::molecular
