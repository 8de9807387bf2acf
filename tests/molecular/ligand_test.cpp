// SPDX-License-Identifier: BSD-3-Clause
// Tests ligands, sugars, modified residues and metals: the sources of their bonds, their rotatable bonds, and engines
// against brute force.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/components.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/summary.hpp"
#include "molecular/dictionary_bonds.hpp"
#include "molecular/engines_agree.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace ligand_test {

using Counts = std::map<std::string, std::size_t>;
using test::TemporaryFile;

struct LigandAtom {
  const char* name;
  const char* element;
  Vec3 x;
};

std::string hetatm(const std::vector<LigandAtom>& atoms, const char* residue, int first_serial = 1, int number = 1,
                   const char* record = "HETATM") {
  std::string text;
  for (const LigandAtom& atom : atoms) {
    std::array<char, 100> line{};
    std::snprintf(line.data(), line.size(), "%s%5d %-4s %3s L%4d    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n", record,
                  first_serial++, (std::string(" ") + atom.name).c_str(), residue, number, atom.x[0], atom.x[1],
                  atom.x[2], atom.element);
    text += line.data();
  }
  return text;
}

/// Returns a zigzag of carbons C1, C2 ... with these bond lengths (angstrom).
std::vector<LigandAtom> zigzag(const std::vector<double>& lengths) {
  static constexpr std::array<const char*, 8> names{"C1", "C2", "C3", "C4", "C5", "C6", "C7", "C8"};
  std::vector<LigandAtom> atoms{{names[0], "C", Vec3(0, 0, 0)}};
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const Vec3 step(0.8, k % 2 == 0 ? 0.6 : -0.6, 0.0);
    atoms.push_back({names[k + 1], "C", atoms.back().x + lengths[k] * step});
  }
  return atoms;
}

/// Returns a component in the format of wwPDB.
std::string component(const std::string& name, const std::string& bonds) {
  return "data_" + name + "\nloop_\n_chem_comp_bond.comp_id\n_chem_comp_bond.atom_id_1\n_chem_comp_bond.atom_id_2\n" +
         "_chem_comp_bond.value_order\n_chem_comp_bond.pdbx_aromatic_flag\n" + bonds + "#\n";
}

Structure read(const std::string& text, const std::optional<std::string>& components = std::nullopt,
               const std::filesystem::path& dictionary = {}) {
  const TemporaryFile file(text);
  ReadOptions options;
  options.hetero = true;
  options.dictionary = dictionary;
  const TemporaryFile definitions(components.value_or(""), ".cif");
  if (components) options.components = {definitions.path()};
  return read_structure(file.path(), options);
}

Molecule shared(const std::string& name, const std::filesystem::path& dictionary = {}) {
  ReadOptions options;
  options.hetero = true;
  options.dictionary = dictionary;
  return Molecule(read_structure(test::molecule_file(name), options));
}

Counts bonds_that_turn(const Molecule& m) {
  Counts counts = torsions_by_kind(m.structure(), m.torsions());
  std::erase_if(counts, [](const auto& kind) { return !kind.first.starts_with("bonds of "); });
  return counts;
}

std::string source_of(const Structure& s, const std::string& residue) {
  for (const BondSource& source : s.bond_sources)
    if (source.residue == residue) return source.source;
  return "";
}

std::vector<std::string> names(const Molecule& m) {
  std::vector<std::string> result;
  for (const Torsion& t : m.torsions()) result.push_back(t.name);
  return result;
}

bool has_note(const Structure& s, const std::string& words) {
  return std::any_of(s.notes.begin(), s.notes.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

TEST(RotatableBonds, AreSingleAndNotTerminal) {
  const std::string text = hetatm(zigzag({1.53, 1.53, 1.53, 1.53, 1.53}), "UNL");
  EXPECT_EQ(names(Molecule(read(text))), (std::vector<std::string>{"C2-C3", "C3-C4", "C4-C5"}));
  // If a component gives bond orders, they decide instead of lengths.
  const auto with = [&](const char* order) {
    return Molecule(read(text, component("UNL", std::string("UNL C1 C2 SING N\nUNL C2 C3 SING N\nUNL C3 C4 ") + order +
                                                    "\nUNL C4 C5 SING N\nUNL C5 C6 SING N\n")));
  };
  EXPECT_EQ(names(with("SING N")), (std::vector<std::string>{"C2-C3", "C3-C4", "C4-C5"}));
  for (const char* order : {"DOUB N", "TRIP N", "AROM N", "DELO N", "SING Y"})
    EXPECT_EQ(names(with(order)), (std::vector<std::string>{"C2-C3", "C4-C5"})) << order;
}

TEST(RotatableBonds, OfUnknownOrderAreToldByTheirLengths) {
  const Molecule diene(read(hetatm(zigzag({1.50, 1.34, 1.46, 1.34, 1.50}), "UNL")));
  EXPECT_EQ(names(diene), std::vector<std::string>{"C3-C4"});
  EXPECT_EQ(source_of(diene.structure(), "UNL"), "covalent radii");
}

TEST(RotatableBonds, AreNoAmides) {
  // An amide with an ethyl group on its nitrogen: C2-C3 rotates, C3-N does not, even if the component calls it single.
  std::vector<LigandAtom> atoms = zigzag({1.53, 1.53, 1.33, 1.45, 1.53});
  atoms[3].name = "N", atoms[3].element = "N";
  atoms.push_back({"O", "O", atoms[2].x + Vec3(0.0, -1.23, 0.0)});
  const std::string bonds =
      "UNL C1 C2 SING N\nUNL C2 C3 SING N\nUNL C3 N SING N\nUNL C3 O DOUB N\n"
      "UNL N C5 SING N\nUNL C5 C6 SING N\n";
  const std::vector<std::string> expected{"C2-C3", "N-C5"};
  EXPECT_EQ(names(Molecule(read(hetatm(atoms, "UNL"), component("UNL", bonds)))), expected);
  EXPECT_EQ(names(Molecule(read(hetatm(atoms, "UNL")))), expected);
}

TEST(RotatableBonds, LieInNoRing) {
  // A six-membered ring with a tail of two atoms.
  std::vector<LigandAtom> atoms;
  static constexpr std::array<const char*, 6> ring{"C1", "C2", "C3", "C4", "C5", "C6"};
  for (std::size_t k = 0; k < 6; ++k) {
    const double angle = 2 * std::acos(-1.0) / 6 * static_cast<double>(k);
    atoms.push_back({ring[k], "C", 1.52 * Vec3(std::cos(angle), std::sin(angle), 0.0)});
  }
  atoms.push_back({"C7", "C", Vec3(2.95, 0.5, 0.2)});
  atoms.push_back({"C8", "C", Vec3(3.9, -0.6, 0)});
  const Molecule m(read(hetatm(atoms, "UNL")));
  EXPECT_EQ(names(m), std::vector<std::string>{"C1-C7"});
  EXPECT_EQ(select_torsions(m, "L:1:C7-C1", false).size(), 1U);
  EXPECT_EQ(select_torsions(m, "C1-C7", false).size(), 1U);
  EXPECT_EQ(select_torsions(m, "ligands", false).size(), 1U);
  EXPECT_THROW(select_torsions(m, "L:1:C1-C2", false), ModelError);
}

TEST(RotatableBonds, OfARingOfResiduesKeepEveryBondButTheClosures) {
  // Eight carbons in a ring, four per residue: neither residue contains a ring.
  std::vector<LigandAtom> atoms;
  static constexpr std::array<const char*, 4> names{"C1", "C2", "C3", "C4"};
  for (std::size_t k = 0; k < 8; ++k) {
    const double angle = 2 * std::acos(-1.0) / 8 * static_cast<double>(k);
    atoms.push_back({names[k % 4], "C", 2.0 * Vec3(std::cos(angle), std::sin(angle), 0.05 * (k % 2 == 0 ? 1 : -1))});
  }
  const auto m = std::make_shared<const Molecule>(
      read(hetatm({atoms.begin(), atoms.begin() + 4}, "LGD") + hetatm({atoms.begin() + 4, atoms.end()}, "LGD", 5, 2)));
  EXPECT_EQ(m->torsions().size(), 7U);
  ASSERT_EQ(m->model().tree().closures().size(), 1U);
  const std::string& closure = m->model().tree().closures().front().name;
  Checker checker(m, m->select(select_torsions(*m, "all", false)), {});
  EXPECT_GT(checker.check(std::vector<double>(7, 0.5), Mode::parse("any")).closure_residual, 0.1);
  const auto turned = checker.positions();
  const auto& x = m->structure().models.front();
  std::size_t kept = 0;
  for (const Bond& bond : m->structure().bonds) {
    if (label(m->structure(), bond.first) + " - " + label(m->structure(), bond.second) == closure) continue;
    EXPECT_NEAR((turned[bond.first] - turned[bond.second]).norm(), (x[bond.first] - x[bond.second]).norm(), 1e-12);
    ++kept;
  }
  EXPECT_EQ(kept, 7U);
}

TEST(Components, AreReadInBothLayoutsManyToAFile) {
  const TemporaryFile file(component("AAA", "AAA C1 \"C2'\" SING N\nAAA \"C2'\" C3 doub N\n") +
                               "data_comp_BBB\nloop_\n_chem_comp_bond.comp_id\n_chem_comp_bond.atom_id_1\n"
                               "_chem_comp_bond.atom_id_2\n_chem_comp_bond.type\n_chem_comp_bond.value_dist\n"
                               "BBB N1 \"H1 \" single 1.0\nBBB N1 C2 aromatic 1.3\nBBB N1 ZN metal 2.0\n",
                           ".cif");
  ComponentLibrary library;
  library.add_file(file.path());
  const Component* first = library.find("AAA");
  ASSERT_NE(first, nullptr);
  ASSERT_EQ(first->bonds.size(), 2U);
  EXPECT_EQ(first->bonds[0].second, "C2'");
  EXPECT_EQ(first->bonds[1].order, BondOrder::multiple);
  const Component* second = library.find("BBB");
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(second->bonds[0].second, "H1");
  EXPECT_EQ(second->bonds[1].order, BondOrder::multiple);
  EXPECT_EQ(second->bonds[2].order, BondOrder::coordination);
  EXPECT_EQ(library.find("CCC"), nullptr);
}

TEST(Components, OfBadFilesAreRefusedSayingWhy) {
  for (const auto& [text, words] :
       {std::pair(std::string("data_x\n_cell.length_a 1\n"), "has no chem_comp_bond"),
        std::pair(component("AAA", "AAA C1 C2 SOFT N\n"), "of order 'soft'"),
        std::pair(component("AAA", "AAA C1 C1 SING N\n"), "expected two different atoms"),
        std::pair(component("AAA", "AAA C1 ? SING N\n"), "expected two different atoms"),
        std::pair(component("AAA", "AAA C1 C2 SING\n"), "Wrong number of values"), std::pair(std::string(), "is empty"),
        std::pair(std::string("ATOM      1  CA\n"), "")}) {
    const TemporaryFile file(text, ".cif");
    ComponentLibrary library;
    try {
      library.add_file(file.path());
      ADD_FAILURE() << "expected a LoadError: " << words;
    } catch (const LoadError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(file.path().string()), std::string::npos) << error.what();
    }
  }
  ComponentLibrary library;
  EXPECT_THROW(library.add_file("/nonexistent.cif"), LoadError);
  EXPECT_THROW(ComponentLibrary("/nonexistent"), LoadError);
}

/// A dictionary with one monomer; removed by the destructor.
class Dictionary {
 public:
  Dictionary(const std::string& name, const std::string& text)
      : path_(std::filesystem::temp_directory_path() / ("hinge-dictionary-" + std::to_string(getpid()))) {
    const auto folder = path_ / std::string(1, static_cast<char>(std::tolower(static_cast<unsigned char>(name[0]))));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / (name + ".cif")) << text;
  }
  Dictionary(const Dictionary&) = delete;
  Dictionary& operator=(const Dictionary&) = delete;
  ~Dictionary() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(Components, OfADictionaryAreFoundByName) {
  const Dictionary dictionary("LGD", component("LGD", "LGD C1 C2 SING N\nLGD C2 C3 DOUB N\nLGD C3 C4 SING N\n"));
  const auto atoms = zigzag({1.53, 1.53, 1.53});
  const Structure s = read(hetatm(atoms, "LGD"), std::nullopt, dictionary.path());
  EXPECT_EQ(source_of(s, "LGD"), dictionary.path().string());
  EXPECT_TRUE(has_note(s, "bonds by " + dictionary.path().string() + ": LGD x1"));
  EXPECT_TRUE(Molecule(s).torsions().empty());
  // A given component has priority. Only the exact name is looked up.
  EXPECT_EQ(names(Molecule(read(hetatm(atoms, "LGD"),
                                component("LGD", "LGD C1 C2 SING N\nLGD C2 C3 SING N\nLGD C3 C4 SING N\n"),
                                dictionary.path()))),
            std::vector<std::string>{"C2-C3"});
  EXPECT_EQ(source_of(read(hetatm(atoms, "..."), std::nullopt, dictionary.path()), "..."), "covalent radii");
}

TEST(Components, OfADictionaryThatOnlyShareTheNameAreNotUsed) {
  const Dictionary dictionary("LGD", component("LGD", "LGD C1 C4 SING N\nLGD C2 C4 SING N\nLGD C3 C1 SING N\n"));
  const Structure s = read(hetatm(zigzag({1.53, 1.53, 1.53}), "LGD"), std::nullopt, dictionary.path());
  EXPECT_EQ(source_of(s, "LGD"), "covalent radii");
  EXPECT_TRUE(has_note(s, "does not fit the residue of L:LGD1:C1: "));
  EXPECT_EQ(s.bonds.size(), 3U);
}

/// As HIS.cif of Debian's refmac-dictionary 5.41: the file does not start with data_.
TEST(Components, OfADictionaryThatCannotBeReadAreNoted) {
  const Dictionary dictionary("LGD", "f#\n" + component("LGD", "LGD C1 C2 SING N\n"));
  const auto atoms = hetatm(zigzag({1.53, 1.53, 1.53}), "LGD");
  const Structure s = read(atoms + hetatm(zigzag({1.53}), "LGD", 2, 5), std::nullopt, dictionary.path());
  EXPECT_EQ(source_of(s, "LGD"), "covalent radii");
  EXPECT_EQ(std::count_if(s.notes.begin(), s.notes.end(),
                          [&](const std::string& note) {
                            return note.starts_with("component LGD is not used: " +
                                                    (dictionary.path() / "l" / "LGD.cif").string() + ":1:1: expected");
                          }),
            1);
}

/// Its bonds are as long as bonds, but atoms that it knows are bonded otherwise: a truncated or reused name.
TEST(Components, OfADictionaryThatLackBondsAreNotUsed) {
  const Dictionary dictionary("LGD", component("LGD", "LGD C1 C2 SING N\nLGD C3 C7 SING N\nLGD C4 C8 SING N\n"));
  const std::string atoms = hetatm(zigzag({1.53, 1.53, 1.53}), "LGD");
  const Structure s = read(atoms, std::nullopt, dictionary.path());
  EXPECT_EQ(source_of(s, "LGD"), "covalent radii");
  EXPECT_TRUE(has_note(s, "0 of its 1 bonds are too long, and 2 are lacking"));
  EXPECT_EQ(s.bonds.size(), 3U);
}

TEST(Components, LeaveAtomsTheyDoNotKnowToRadii) {
  const Structure s =
      read(hetatm(zigzag({1.53, 1.53, 1.53}), "LGD"), component("LGD", "LGD C1 C2 SING N\nLGD C2 C3 SING N\n"));
  EXPECT_EQ(s.bonds.size(), 3U);
  EXPECT_TRUE(has_note(s, "that the template lacks: LGD"));
}

TEST(Components, NameTheBearersOfHydrogens) {
  // The hydrogen of C1 is closer to C2.
  auto atoms = zigzag({1.53, 1.53});
  atoms.push_back({"H1", "H", atoms[1].x + Vec3(-0.35, -0.5, 0.2)});
  const auto bearer = [](const Structure& s) {
    for (const Bond& bond : s.bonds)
      if (s.atoms[bond.second].name == "H1") return s.atoms[bond.first].name;
    return std::string();
  };
  EXPECT_EQ(bearer(read(hetatm(atoms, "LGD"))), "C2");
  EXPECT_EQ(
      bearer(read(hetatm(atoms, "LGD"), component("LGD", "LGD C1 C2 SING N\nLGD C2 C3 SING N\nLGD C1 H1 SING N\n"))),
      "C1");
}

TEST(Residues, OfACoarseGrainedModelAreNoted) {
  const std::vector<LigandAtom> beads{{"BB", "F", Vec3(22.2, 42.3, 23.9)}, {"SC1", "S", Vec3(23.6, 44.3, 24.6)}};
  const std::string text = hetatm(beads, "THR", 1, 1, "ATOM  ") + hetatm(beads, "THR", 3, 2, "ATOM  ");
  EXPECT_TRUE(has_note(read(text), "residues without any atom of their template: 2 (first: L:THR1:BB)"));
  // A trace of C-alphas has one atom of each template.
  EXPECT_FALSE(has_note(read(hetatm({{"CA", "C", Vec3(0, 0, 0)}}, "THR", 1, 1, "ATOM  ")), "without any atom"));
}

TEST(Hydrogens, WithoutAHeavyAtomNearAreNotedTogether) {
  auto atoms = zigzag({1.53});
  atoms.push_back({"H1", "H", Vec3(0, 9, 0)});
  atoms.push_back({"H2", "H", Vec3(0, 0, 9)});
  const Structure s = read(hetatm(atoms, "LGD"));
  EXPECT_TRUE(has_note(s, "no heavy atom of their residue is within 1.6 angstrom: 2 (first: L:LGD1:H1)"));
  EXPECT_EQ(s.bonds.size(), 1U);
}

TEST(Hydrogens, OfAminoAcidsAreBondedByTheirNames) {
  // HG of serine is closer to CB than to OG, as in a bad model.
  const Structure ideal = build_ideal_protein("S", "C");
  std::map<std::string, Vec3> at;
  std::vector<LigandAtom> atoms;
  for (std::uint32_t i = 0; i < ideal.atoms.size(); ++i) {
    at[ideal.atoms[i].name] = ideal.models.front()[i];
    atoms.push_back({ideal.atoms[i].name.c_str(), ideal.atoms[i].element.c_str(), ideal.models.front()[i]});
  }
  const Vec3 along = at.at("CB") - at.at("OG");
  Vec3 aside = along.cross(Vec3(0.3, 0.5, 0.8));
  aside = aside / aside.norm();
  for (const auto& [name, bearer] : {std::pair("HG", "OG"), std::pair("1HB", "CB"), std::pair("Q", "CB")}) {
    auto with = atoms;
    with.push_back({name, "H", at.at("OG") + 0.7 * along + 0.3 * aside});
    const Structure s = read(hetatm(with, "SER", 1, 1, "ATOM  "));
    const auto neighbours = bonded_neighbours(s);
    ASSERT_EQ(neighbours.back().size(), 1U) << name;
    EXPECT_EQ(s.atoms[neighbours.back().front()].name, bearer) << name;
  }
  // A hydrogen whose name does not fit is bonded to the nearest atom.
  atoms.push_back({"HA", "H", at.at("OG") - 0.6 * along});
  const Structure s = read(hetatm(atoms, "SER", 1, 1, "ATOM  "));
  EXPECT_EQ(s.atoms[bonded_neighbours(s).back().front()].name, "OG");
}

TEST(ModifiedResidues, KeepTheirOxygensFromTheBackbone) {
  const auto file = test::molecule_file("1a4w.cif");
  // O1 and O2 in the sulphate of sulphotyrosine are also GROMOS' names of terminal oxygens.
  const Structure s = read_structure(file);
  for (const Bond& bond : s.bonds)
    if (s.residues[s.atoms[bond.first].residue].name == "TYS") {
      EXPECT_LT((s.models.front()[bond.first] - s.models.front()[bond.second]).norm(), 2.0) << label(s, bond.second);
    }
}

TEST(Conect, JoinsTheAtomsOfALigandAndDoublesDoubleBonds) {
  const std::string atoms = hetatm(zigzag({1.53, 1.53, 1.53, 1.53}), "LGD", 11);
  const std::string chain = "CONECT   11   12\nCONECT   12   11   13   13\nCONECT   13   12   14\nCONECT   14   15\n";
  const Structure s = read(atoms + chain);
  EXPECT_EQ(source_of(s, "LGD"), "CONECT records");
  EXPECT_EQ(names(Molecule(s)), std::vector<std::string>{"C3-C4"});
  // Records are ignored if they leave an atom without a bond. Atom numbers that do not exist or are no numbers are
  // skipped.
  EXPECT_EQ(source_of(read(atoms + "CONECT   11   12\nCONECT   12   13\n"), "LGD"), "covalent radii");
  EXPECT_EQ(read(atoms + "CONECT   11   99\nCONECT  x1   12\nCONECT\n").bonds.size(), 4U);
}

TEST(Metals, AreBondedToWhatTheFileSaysAndClashWithNone) {
  // Mg-O 2.55 A, longer than the covalent radii, in a LINK record; a carbon is close to the metal.
  std::string text = hetatm({{"C", "C", Vec3(0, 0, 0)}, {"O", "O", Vec3(1.22, 0, 0)}}, "ACE", 1, 1, "ATOM  ");
  text += hetatm({{"MG", "MG", Vec3(3.77, 0, 0)}}, "MG", 3, 2);
  const auto clashes = [](const Structure& s) {
    const auto m = std::make_shared<const Molecule>(s);
    return Checker(m, m->select({}), {}).reference_collisions().size();
  };
  EXPECT_EQ(clashes(read(text)), 1U);
  std::string link(80, ' ');
  const auto put = [&](std::size_t column, const std::string& word) { link.replace(column - 1, word.size(), word); };
  put(1, "LINK"), put(14, "O"), put(18, "ACE L   1"), put(43, "MG"), put(48, "MG  L   2"),
      put(60, "  1555   1555  2.55");
  const Structure s = read(link + "\n" + text);
  EXPECT_EQ(clashes(s), 0U);
  ASSERT_EQ(s.bonds.size(), 2U);
  EXPECT_EQ(s.bonds[1].order, BondOrder::coordination);
}

TEST(AlternativeLocations, ThatAreLeftOutAreCounted) {
  const auto file = test::molecule_file("1ejg.pdb");
  EXPECT_TRUE(has_note(read_structure(file), "alternative locations: "));
}

TEST(Ligands, OfRealStructuresTurnAsCountedByHand) {
  // KNI-272: five rings, four amides and eleven terminal bonds do not rotate; fourteen bonds do.
  const Molecule protease = shared("1hpx.pdb");
  EXPECT_EQ(bonds_that_turn(protease), (Counts{{"bonds of KNI", 14}}));
  EXPECT_EQ(source_of(protease.structure(), "KNI"), "CONECT records");
  // Thrombin: dansyl-arginine-ethylpiperidine and thiazole are four residues joined by LINK records. Sulphotyrosine has
  // two rotatable bonds after chi2.
  EXPECT_EQ(
      bonds_that_turn(shared("1a4w.pdb")),
      (Counts{
          {"bonds of 2EP", 1}, {"bonds of ANS", 1}, {"bonds of DAR", 7}, {"bonds of KTH", 2}, {"bonds of TYS", 2}}));
  // Src: phosphotyrosine, and AMP-PNP with five rotatable bonds in its phosphate chain and three in its sugar.
  EXPECT_EQ(bonds_that_turn(shared("2src.pdb")), (Counts{{"bonds of ANP", 8}, {"bonds of PTR", 2}}));
}

TEST(Ligands, OfAnMmcifFileBringTheirOwnComponents) {
  const auto file = test::molecule_file("1igy.cif.gz");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "shared data not found";
  // Each sugar has the rotatable bond C5-C6, and N-acetyl C2-N2. Two more bonds join it to the next sugar or to
  // asparagine.
  const Molecule m = shared("1igy.cif.gz");
  EXPECT_EQ(source_of(m.structure(), "NAG"), file.string());
  EXPECT_EQ(bonds_that_turn(m).at("bonds of NAG"), 6U * 4U);
}

TEST(Ligands, AreTheSameFromEverySource) {
  const auto file = test::molecule_file("1hpx.pdb");
  const Molecule by_conect = shared("1hpx.pdb");
  std::string text, line;
  std::istringstream in(test::gunzipped(file));
  while (std::getline(in, line))
    if (!line.starts_with("CONECT")) text += line + "\n";
  const Molecule by_radii(read(text));
  EXPECT_EQ(source_of(by_radii.structure(), "KNI"), "covalent radii");
  EXPECT_EQ(names(by_radii), names(by_conect));
  if (!std::filesystem::exists(test::dictionary)) GTEST_SKIP() << "refmac-dictionary is not installed";
  const Molecule by_dictionary = shared("1hpx.pdb", test::dictionary);
  EXPECT_EQ(source_of(by_dictionary.structure(), "KNI"), test::dictionary.string());
  EXPECT_EQ(names(by_dictionary), names(by_conect));
  // The haems of 4HHB have bonds of 2.3 angstrom, longer than the covalent radii allow; each has eight rotatable bonds.
  EXPECT_EQ(bonds_that_turn(shared("4hhb.pdb.gz", test::dictionary)), (Counts{{"bonds of HEM", 32}}));
}

TEST(NativeContacts, OfEveryKindOfMoleculeAreThoseOfTheDocs) {
  for (const auto& [file, expected] :
       {std::pair("1bna.pdb", 0U), std::pair("1ehz.pdb.gz", 4U), std::pair("1d66.pdb", 3U), std::pair("1hpx.pdb", 0U),
        std::pair("1a4w.pdb", 8U), std::pair("2src.pdb", 3U), std::pair("1igy.cif.gz", 19U)}) {
    if (!std::filesystem::exists(test::molecule_file(file))) continue;
    ReadOptions options = test::heavy_atoms();
    options.hetero = true;
    const auto m = std::make_shared<const Molecule>(read_structure(test::molecule_file(file), options));
    EXPECT_EQ(Checker(m, m->select({}), {}).reference_collisions().size(), expected) << file;
  }
}

TEST(Ligands, GiveEqualAnswersOnAllEngines) {
  for (const auto& [file, spec, count] :
       {std::tuple("1hpx.pdb", "all", 5), std::tuple("1a4w.pdb", "all", 3), std::tuple("2src.pdb", "ligands", 2),
        std::tuple("4hhb.pdb.gz", "ligands", 1), std::tuple("1igy.cif.gz", "ligands", 1)}) {
    if (!std::filesystem::exists(test::molecule_file(file))) continue;
    test::expect_engines_agree(std::make_shared<const Molecule>(shared(file)), spec, count);
  }
}

TEST(Ligands, InARibosomeGiveEqualAnswersOnSimdAndLazy) {
  const auto file = test::molecule_file("6zu5.cif.gz");
  if (std::getenv("HINGE_TEST_ALL") == nullptr || !std::filesystem::exists(file))
    GTEST_SKIP() << "shared data and HINGE_TEST_ALL only";
  // 3910 nucleotides in 3 chains with 21 breaks, 10 308 amino acids in 71 chains.
  const auto m = std::make_shared<const Molecule>(shared("6zu5.cif.gz"));
  const auto classes = residues_by_class(m->structure());
  EXPECT_EQ(classes.at("RNA").residues, 3910U);
  EXPECT_EQ(classes.at("protein").residues, 10308U);
  EXPECT_EQ(classes.at("ion").residues, 187U);
  const Counts kinds = torsions_by_kind(m->structure(), m->torsions());
  EXPECT_EQ(kinds.at("epsilon"), 3910U - 21U);
  EXPECT_EQ(kinds.at("gamma"), 3910U);
  const auto selection = m->select(select_torsions(*m, "ligands,alpha", false));
  CheckOptions rules;
  Checker simd(m, selection, rules);
  rules.engine = "lazy";
  Checker lazy(m, selection, rules);
  const auto q = sample_configuration({7, {}}, 0, simd.dof_count());
  EXPECT_EQ(simd.check(q, Mode::parse("all")).pairs, lazy.check(q, Mode::parse("all")).pairs);
}

}  // namespace ligand_test
}  // namespace hinge::molecular
