// SPDX-License-Identifier: BSD-3-Clause
// Tests that structures written as PDB and mmCIF are read back with the same atoms, bonds, torsions, thresholds and
// verdicts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/join_structures.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/torsions.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "hinge/molecular/write_trajectory.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace round_trip_test {

using test::TemporaryFile;

std::string written(const Structure& s, TrajectoryFormat format, const std::vector<Vec3>& positions) {
  std::ostringstream out;
  TrajectoryWriter writer(out, format, s, s.atoms.size());
  writer.add(positions, s.model_numbers.empty() ? 1 : s.model_numbers.front());
  writer.finish();
  return out.str();
}
std::string written(const Structure& s, TrajectoryFormat format) { return written(s, format, s.models.front()); }

ReadOptions everything() {
  ReadOptions options;
  options.hetero = options.waters = options.first_model = true;
  return options;
}

Structure again(const std::string& text, TrajectoryFormat format) {
  const TemporaryFile file(text, format == TrajectoryFormat::pdb ? ".pdb" : ".cif");
  return read_structure(file.path(), everything());
}

void expect_same_molecule(const Structure& a, const Structure& b) {
  ASSERT_EQ(a.atoms.size(), b.atoms.size());
  for (std::uint32_t i = 0; i < a.atoms.size(); ++i) {
    ASSERT_EQ(label(a, i), label(b, i));
    ASSERT_EQ(a.atoms[i].element, b.atoms[i].element) << label(a, i);
    ASSERT_EQ(a.residues[a.atoms[i].residue].kind, b.residues[b.atoms[i].residue].kind) << label(a, i);
    ASSERT_EQ(a.models[0][i], b.models[0][i]) << label(a, i);
    // The PDB format has six columns for the B factor, two of them after the point.
    ASSERT_NEAR(std::clamp(a.atoms[i].b_factor, -99.99, 999.99), std::clamp(b.atoms[i].b_factor, -99.99, 999.99),
                0.0051)
        << label(a, i);
  }
  ASSERT_EQ(a.bonds.size(), b.bonds.size());
  for (std::size_t k = 0; k < a.bonds.size(); ++k) {
    const Bond &p = a.bonds[k], &q = b.bonds[k];
    const std::string name = label(a, p.first) + " - " + label(a, p.second);
    ASSERT_EQ(std::pair(p.first, p.second), std::pair(q.first, q.second)) << name;
    if (p.order != BondOrder::unknown) {
      ASSERT_EQ(p.order, q.order) << name;
    }
    const auto is_backbone = [](const Bond& bond) {
      return bond.origin == BondOrigin::peptide || bond.origin == BondOrigin::phosphodiester;
    };
    ASSERT_EQ(is_backbone(p), is_backbone(q)) << name;
    ASSERT_EQ(p.origin == BondOrigin::disulphide, q.origin == BondOrigin::disulphide) << name;
  }
  ASSERT_EQ(a.secondary_structure.size(), b.secondary_structure.size());
  for (std::size_t k = 0; k < a.secondary_structure.size(); ++k) {
    const auto key = [](const SecondaryStructure& e) { return std::tuple(e.kind, e.first, e.last); };
    ASSERT_EQ(key(a.secondary_structure[k]), key(b.secondary_structure[k]));
  }
}

void expect_same_answers(const Structure& a, const Structure& b) {
  const auto checker = [](const Structure& s) {
    auto molecule = std::make_shared<const Molecule>(s);
    return Checker(molecule, molecule->select({}), {});
  };
  Checker p = checker(a), q = checker(b);
  const auto &torsions = p.molecule().torsions(), &others = q.molecule().torsions();
  ASSERT_EQ(torsions.size(), others.size());
  for (std::size_t k = 0; k < torsions.size(); ++k)
    ASSERT_EQ(torsion_label(a, torsions[k]), torsion_label(b, others[k]));
  ASSERT_EQ(p.exclusions().excluded_pairs(), q.exclusions().excluded_pairs());
  const Verdict v = p.check_coordinates(a.models[0], Mode::parse("all")),
                w = q.check_coordinates(b.models[0], Mode::parse("all"));
  ASSERT_EQ(v.pairs.size(), w.pairs.size());
  EXPECT_EQ(v.pairs, w.pairs);  // including thresholds
}

/// A longer name would push the coordinates out of their columns.
TEST(WritePdb, RefusesModelsWithNamesLongerThanTheirColumns) {
  const Structure protein = build_ideal_protein("AG", "CC");
  std::ostringstream out;
  write_pdb_model(out, protein, protein.models.front(), 1);
  Structure residue = protein, atom = protein;
  residue.residues.front().name = "ALANI";
  atom.atoms.front().name = "N1234";
  EXPECT_THROW(write_pdb_model(out, residue, protein.models.front(), 1), ModelError);
  EXPECT_THROW(write_pdb_model(out, atom, protein.models.front(), 1), ModelError);
}

TEST(RoundTrip, ResiduesWithoutNames) {
  const TemporaryFile file(
      "HETATM    1  C       A   1       0.095   0.011   0.000  1.00  0.00           C\n"
      "HETATM    2  O       A   1       0.513  -1.098  -0.004  1.00  0.00           O\n"
      "HETATM    3  H1      A   1      -0.998   0.149   0.015  1.00  0.00           H\n"
      "HETATM    4  H2      A   1       0.590   0.938  -0.011  1.00  0.00           H\nEND\n");
  const Structure s = read_structure(file.path(), everything());
  ASSERT_EQ(s.bonds.size(), 3U);
  for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif})
    expect_same_molecule(s, again(written(s, format), format));
}

TEST(RoundTrip, EveryFile) {
  const bool whole = std::getenv("HINGE_TEST_ALL") != nullptr;  // verdicts for 100 000 atoms take long
  std::size_t files = 0;
  std::vector<std::string> not_as_pdb;
  for (const std::filesystem::path& file : test::molecule_files()) {
    const std::string name = file.filename().string();
    if (name.find(".pdb") == std::string::npos && name.find(".cif") == std::string::npos) continue;
    SCOPED_TRACE(name);
    std::optional<Structure> s;
    try {
      s = read_structure(file, everything());
    } catch (const LoadError&) {
      continue;  // for example a damaged file
    }
    ++files;
    for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif}) {
      std::string text;
      try {
        text = written(*s, format);
      } catch (const ModelError& error) {
        const std::string what = error.what();
        EXPECT_EQ(format, TrajectoryFormat::pdb) << what;
        EXPECT_NE(what.find("write a .cif file instead"), std::string::npos) << what;
        not_as_pdb.push_back(name);
        continue;
      }
      const Structure other = again(text, format);
      expect_same_molecule(*s, other);
      if (whole || s->atoms.size() < 6000) expect_same_answers(*s, other);
    }
  }
  const bool shared = std::filesystem::exists(test::shared_molecules());
  EXPECT_GE(files, shared ? 60U : 20U);
  // Its chain names have three letters.
  EXPECT_EQ(not_as_pdb, shared ? std::vector<std::string>{"6zu5.cif.gz"} : std::vector<std::string>{});
}

/// In predicted models the column holds the confidence, which selections such as plddt<70 read.
TEST(RoundTrip, KeepsBFactors) {
  Structure s = build_ideal_protein("AG", "CC");
  const std::vector<double> values{0.0, 7.25, -3.5, 99.99, 100.0, 999.99, 1e-3, 54.321};
  for (std::size_t i = 0; i < s.atoms.size(); ++i) s.atoms[i].b_factor = values[i % values.size()];
  for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif}) {
    const Structure other = again(written(s, format), format);
    ASSERT_EQ(other.atoms.size(), s.atoms.size());
    for (std::size_t i = 0; i < s.atoms.size(); ++i)
      EXPECT_NEAR(other.atoms[i].b_factor, s.atoms[i].b_factor, format == TrajectoryFormat::pdb ? 0.00501 : 1e-5);
  }
  s.atoms.front().b_factor = 1e6;  // does not fit the PDB columns
  EXPECT_EQ(again(written(s, TrajectoryFormat::pdb), TrajectoryFormat::pdb).atoms.front().b_factor,
            static_cast<double>(999.99F));
}

TEST(Read, TakesABFactorThatIsNoFiniteNumberAsZero) {
  Structure s = build_ideal_protein("AG", "CC");
  s.atoms.front().b_factor = 54.25;
  for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif})
    for (const char* value : {"  nan", "  inf", " -inf", "    ?", "    ."}) {
      std::string text = written(s, format);
      text.replace(text.find("54.25"), 5, value);
      EXPECT_EQ(again(text, format).atoms.front().b_factor, 0.0) << value;
    }
}

/// Returns a cystine, a ligand with a double bond (a repeated CONECT) bonded to the protein, and a metal.
std::string complex_text() {
  std::string text;
  const auto add = [&](const char* record, int serial, const char* name, const char* residue, char chain, int number,
                       double x, double y, double z, const char* element) {
    char line[96];
    std::snprintf(line, sizeof line, "%-6s%5d  %-3s %3s %c%4d    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n", record,
                  serial, name, residue, chain, number, x, y, z, element);
    text += line;
  };
  for (int k = 0; k < 2; ++k) {
    const double side = k == 0 ? 1 : -1;  // two chains; SG-SG is 2.05 A
    const int at = 6 * k;
    const char chain = k == 0 ? 'A' : 'B';
    add("ATOM", at + 1, "N", "CYS", chain, 1, side * 5.0, 1.4, 0, "N");
    add("ATOM", at + 2, "CA", "CYS", chain, 1, side * 3.9, 0.45, 0, "C");
    add("ATOM", at + 3, "C", "CYS", chain, 1, side * 4.2, -0.5, 1.2, "C");
    add("ATOM", at + 4, "O", "CYS", chain, 1, side * 5.1, -0.2, 2.0, "O");
    add("ATOM", at + 5, "CB", "CYS", chain, 1, side * 2.55, 1.13, 0.1, "C");
    add("ATOM", at + 6, "SG", "CYS", chain, 1, side * 1.025, 0.15, 0, "S");
  }
  add("HETATM", 13, "C1", "LIG", 'A', 9, 5.6, 2.7, 0.1, "C");  // bonded to N of the first cysteine
  add("HETATM", 14, "C2", "LIG", 'A', 9, 6.6, 3.6, 0.1, "C");
  add("HETATM", 15, "O3", "LIG", 'A', 9, 7.8, 3.3, 0.1, "O");
  add("HETATM", 16, "C4", "LIG", 'A', 9, 6.2, 5.0, 0.1, "C");
  add("HETATM", 17, "ZN", "ZN", 'A', 10, 9.5, 4.2, 0.1, "ZN");
  return text +
         "CONECT    6   12\nCONECT   13    1   14\nCONECT   14   13   15   15   16\nCONECT   15   14   14   17\nEND\n";
}

std::size_t bonds_between_residues(const Structure& s) {
  return static_cast<std::size_t>(std::count_if(s.bonds.begin(), s.bonds.end(), [&](const Bond& bond) {
    return s.atoms[bond.first].residue != s.atoms[bond.second].residue;
  }));
}

TEST(RoundTrip, KeepsBondsWhateverTheCoordinates) {
  const Structure s = again(complex_text(), TrajectoryFormat::pdb);
  ASSERT_EQ(bonds_between_residues(s), 3U);  // S-S, N-C1, O3-ZN
  const auto double_bond = [](const Structure& of) {
    return std::count_if(of.bonds.begin(), of.bonds.end(),
                         [](const Bond& bond) { return bond.order == BondOrder::multiple; });
  };
  ASSERT_EQ(double_bond(s), 1);
  // With residues closer together, then far apart, distances do not determine the bonds.
  for (const double scale : {0.5, 3.0})
    for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif}) {
      std::vector<Vec3> x = s.models.front();
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += (scale - 1.0) * s.models[0][s.residues[s.atoms[i].residue].first_atom];
      const Structure other = again(written(s, format, x), format);
      ASSERT_EQ(other.bonds.size(), s.bonds.size());
      for (std::size_t k = 0; k < s.bonds.size(); ++k) {
        EXPECT_EQ(s.bonds[k].first, other.bonds[k].first);
        EXPECT_EQ(s.bonds[k].second, other.bonds[k].second);
      }
      EXPECT_EQ(double_bond(other), 1);
    }
}

TEST(RoundTrip, WritesTheRecordsOfTheFormat) {
  const Structure s = again(complex_text(), TrajectoryFormat::pdb);
  const std::string pdb = written(s, TrajectoryFormat::pdb), cif = written(s, TrajectoryFormat::cif);
  for (const char* line : {"SSBOND   1 CYS A    1    CYS B    1                          1555   1555  2.05\n",
                           "LINK         N   CYS A   1                 C1  LIG A   9     1555   1555  1.44\n",
                           "LINK         O3  LIG A   9                ZN    ZN A  10     1555   1555  1.92\n",
                           "\nTER\n", "\nCONECT    8    7    9    9   10\n"})
    EXPECT_NE(pdb.find(line), std::string::npos) << line << "\n" << pdb;
  for (const char* words : {" disulf CYS A 1 1 ? A SG CYS B 1 1 ? B SG 1_555 1_555", "metalc", "LIG C2 O3 delo"})
    EXPECT_NE(cif.find(words), std::string::npos) << words << "\n" << cif;
}

TEST(RoundTrip, KeepsABreakWhoseEndsComeClose) {
  Structure s = build_ideal_protein("AGSA", "CCCC");
  std::erase_if(
      s.bonds, [&](const Bond& bond) { return s.atoms[bond.first].residue == 1 && s.atoms[bond.second].residue == 2; });
  for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif})
    EXPECT_EQ(again(written(s, format), format).bonds.size(), s.bonds.size());
}

TEST(RoundTrip, KeepsMoleculesOfTwoFilesApart) {
  // The ligand's oxygen is at bond distance from a carbon of the protein: a collision in two files, so also in one
  // file.
  Structure protein = build_ideal_protein("AAA", "CCC"), ligand = again(complex_text(), TrajectoryFormat::pdb);
  const Vec3 by = protein.models[0][4] + Vec3(1.5, 0, 0) - ligand.models[0][14];
  for (Vec3& x : ligand.models[0]) x += by;
  for (Structure* s : {&protein, &ligand})
    for (Vec3& x : s->models[0])
      for (Eigen::Index k = 0; k < 3; ++k) x[k] = std::round(x[k] * 1000) / 1000;
  const Structure both = join_structures({protein, ligand});
  for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif}) {
    const Structure other = again(written(both, format), format);
    ASSERT_EQ(other.bonds.size(), both.bonds.size());
    expect_same_answers(both, other);
  }
}

TEST(RoundTrip, FilesThatSomebodyEditedAreReadLikeOthers) {
  const Structure s = again(complex_text(), TrajectoryFormat::pdb);
  std::string text = written(s, TrajectoryFormat::pdb);
  const std::size_t conect = text.find("CONECT");
  text.erase(conect, text.find('\n', conect) + 1 - conect);
  text.erase(text.find("CONECT"), text.find("END\n") - text.find("CONECT"));
  const Structure other = again(text, TrajectoryFormat::pdb);
  EXPECT_EQ(other.bonds.size(), s.bonds.size());  // distances find the same bonds here
  EXPECT_TRUE(std::none_of(other.bond_sources.begin(), other.bond_sources.end(),
                           [](const BondSource& source) { return source.source == "records of Hinge"; }));
}

TEST(RoundTrip, NamesTheFormatThatHoldsWhatDoesNotFit) {
  Structure s = build_ideal_protein("AG", "CC");
  s.chains[0].name = "AB";
  const auto refusal = [&](const auto& act) -> std::string {
    try {
      act();
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal([&] { written(s, TrajectoryFormat::pdb); }).find("write a .cif file instead"), std::string::npos);
  expect_same_molecule(s, again(written(s, TrajectoryFormat::cif), TrajectoryFormat::cif));
  s.chains[0].name = "A";
  s.residues[1].sequence_number = 23456;
  Structure rounded = again(written(s, TrajectoryFormat::pdb), TrajectoryFormat::pdb);
  EXPECT_EQ(rounded.residues[1].sequence_number, 23456);
}

TEST(RoundTrip, KeepsResiduesOfTheSameNameAndNumberApart) {
  // All names and numbers occur twice, as in a duplicated box of water.
  const Structure once = again(complex_text(), TrajectoryFormat::pdb);
  Structure s = join_structures({once, once});
  s.chains.resize(1);
  s.chains[0].last_residue = static_cast<std::uint32_t>(s.residues.size());
  for (Residue& residue : s.residues) residue.chain = 0;
  for (std::size_t i = once.atoms.size(); i < s.atoms.size(); ++i) s.models[0][i] += Vec3(40, 0, 0);
  ASSERT_EQ(s.bonds.size(), 2 * once.bonds.size());
  for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif}) {
    const Structure other = again(written(s, format), format);
    ASSERT_EQ(other.atoms.size(), s.atoms.size());
    EXPECT_EQ(other.residues.size(), s.residues.size());
    EXPECT_EQ(other.models, s.models);
    ASSERT_EQ(other.bonds.size(), s.bonds.size());
    for (std::size_t k = 0; k < s.bonds.size(); ++k) {
      EXPECT_EQ(other.bonds[k].first, s.bonds[k].first);
      EXPECT_EQ(other.bonds[k].second, s.bonds[k].second);
      EXPECT_EQ(other.bonds[k].origin == BondOrigin::disulphide, s.bonds[k].origin == BondOrigin::disulphide);
    }
    expect_same_answers(s, other);
  }
  const std::string cif = written(s, TrajectoryFormat::cif);
  EXPECT_NE(cif.find(" LIG A-1 ? . ? "), std::string::npos) << cif;  // label_asym_id, no label_seq_id
  EXPECT_NE(cif.find(" CYS A ? 8 ? "), std::string::npos) << cif;
}

TEST(RoundTrip, WritesABlankChainNameAsEmptyText) {
  Structure s = build_ideal_protein("AG", "CC");
  s.chains[0].name.clear();
  for (Vec3& x : s.models[0])
    for (Eigen::Index k = 0; k < 3; ++k) x[k] = std::round(x[k] * 1000) / 1000;
  for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif})
    expect_same_molecule(s, again(written(s, format), format));
  const std::string cif = written(s, TrajectoryFormat::cif);
  EXPECT_NE(cif.find(" 1 '' 1\n"), std::string::npos) << cif;
}

TEST(RoundTrip, KeepsInsertionCodes) {
  Structure s = build_ideal_protein("AGSA", "CCCC");
  for (std::uint32_t r = 1; r < 4; ++r) {
    s.residues[r].sequence_number = 1;
    s.residues[r].insertion_code = static_cast<char>('A' + r - 1);
  }
  for (Vec3& x : s.models[0])
    for (Eigen::Index k = 0; k < 3; ++k) x[k] = std::round(x[k] * 1000) / 1000;
  for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif}) {
    const Structure other = again(written(s, format), format);
    expect_same_molecule(s, other);
    EXPECT_EQ(label(other, other.residues[3].first_atom), "A:ALA1C:N");
  }
}

}  // namespace round_trip_test
}  // namespace hinge::molecular
