// SPDX-License-Identifier: BSD-3-Clause
// Tests reading of PDB and mmCIF files: atoms, models, conformers, repairs, rejected input.
#include "hinge/molecular/read_structure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace read_structure_test {

using test::gzipped;
using test::TemporaryFile;

/// Returns an ATOM record with columns as in PDB format 3.3.
std::string atom(int serial, const std::string& name, const std::string& residue, int number, double x, double y,
                 double z, char altloc = ' ', double occupancy = 1.0, const std::string& element = "C",
                 const std::string& record = "ATOM  ") {
  char line[100];
  std::snprintf(line, sizeof line, "%s%5d  %-3s%c%3s A%4d    %8.3f%8.3f%8.3f%6.2f%6.2f          %2s\n", record.c_str(),
                serial, name.c_str(), altloc, residue.c_str(), number, x, y, z, occupancy, 0.0, element.c_str());
  return line;
}

std::string alanine() {
  return atom(1, "N", "ALA", 1, 0, 0, 0, ' ', 1, "N") + atom(2, "CA", "ALA", 1, 1.46, 0, 0) +
         atom(3, "C", "ALA", 1, 2.0, 1.42, 0) + atom(4, "O", "ALA", 1, 1.25, 2.39, 0, ' ', 1, "O") +
         atom(5, "CB", "ALA", 1, 1.99, -0.77, -1.2);
}

/// Returns the message of the LoadError without the path, or an empty text if reading succeeds.
std::string refusal(const std::string& text, const ReadOptions& options = {}, const std::string& extension = ".pdb") {
  const TemporaryFile file(text, extension);
  try {
    read_structure(file.path(), options);
  } catch (const LoadError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find(file.path().string()), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what.substr(std::min(what.size(), what.find(file.path().string()) + file.path().string().size()));
  }
  return "";
}

bool has_note(const Structure& s, const std::string& words) {
  return std::any_of(s.notes.begin(), s.notes.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

TEST(ReadStructure, ReadsAResidueWithItsTemplateBonds) {
  const TemporaryFile file(alanine() + "END\n");
  const Structure s = read_structure(file.path());
  ASSERT_EQ(s.atoms.size(), 5U);
  EXPECT_EQ(s.bonds.size(), 4U);
  EXPECT_EQ(label(s, 4), "A:ALA1:CB");
  EXPECT_EQ(s.models.front()[4], Vec3(1.99, -0.77, -1.2));
}

TEST(ReadStructure, RefusesABlankCoordinateNamingLineAtomAndColumns) {
  std::string text = alanine();
  text.replace(text.find("  -0.770"), 8, "        ");
  EXPECT_EQ(refusal(text), ":5: atom 5 CB: coordinate y is blank, expected a number in columns 39-46");
}

// The parser reads these records as atoms, and blank coordinates as zeros.
TEST(ReadStructure, RefusesBlankCoordinatesOfRecordsWithSixDigitsOrInLowerCase) {
  for (const std::string record : {"ATOM 100005", "atom 100005"}) {
    std::string text = alanine();
    const std::size_t last = text.rfind("ATOM");
    text.replace(last, 11, record);
    EXPECT_EQ(refusal(text), "");
    text.replace(last + 38, 8, "        ");
    EXPECT_EQ(refusal(text), ":5: atom 100005 CB: coordinate y is blank, expected a number in columns 39-46");
  }
}

TEST(ReadStructure, RefusesACoordinateThatIsNoNumber) {
  std::string text = alanine();
  text.replace(text.find("  -0.770"), 8, "     nan");
  EXPECT_NE(refusal(text).find("coordinate y is 'nan'"), std::string::npos);
}

TEST(ReadStructure, RefusesEmptyMissingAndCutShortFiles) {
  EXPECT_NE(refusal("").find("is empty"), std::string::npos);
  EXPECT_NE(refusal(" \n\n").find("is empty"), std::string::npos);
  EXPECT_NE(refusal("HEADER    NOTHING\nEND\n").find("no ATOM or HETATM record"), std::string::npos);
  const std::string cut = alanine().substr(0, alanine().size() - 10);
  EXPECT_NE(refusal("MODEL        1\n" + cut).find("has no ENDMDL"), std::string::npos);
  const std::string two = "MODEL        1\n" + alanine() + "ENDMDL\nMODEL        2\n" + alanine();
  EXPECT_NE(refusal(two).find("has no ENDMDL"), std::string::npos);
  EXPECT_NE(refusal("ATOM      1  N   ALA\n").find("expected coordinates"), std::string::npos);
  EXPECT_THROW(read_structure("/nonexistent/file.pdb"), LoadError);
  EXPECT_THROW(read_structure("/tmp"), LoadError);
  EXPECT_NE(refusal("data_x\nloop_\n_atom_site.id\n_atom_site.type_symbol\n1 C 2\n", {}, ".cif"), "");
}

/// Returns an mmCIF file of alanine with these columns of atom_site.
std::string cif_of_alanine(const std::vector<std::string>& columns) {
  const std::vector<std::map<std::string, std::string>> atoms = {
      {{"id", "1"}, {"type_symbol", "N"}, {"label_atom_id", "N"}, {"Cartn_x", "0.000"}, {"Cartn_y", "0.000"}},
      {{"id", "2"}, {"type_symbol", "C"}, {"label_atom_id", "CA"}, {"Cartn_x", "1.458"}, {"Cartn_y", "0.000"}},
      {{"id", "3"}, {"type_symbol", "C"}, {"label_atom_id", "C"}, {"Cartn_x", "2.009"}, {"Cartn_y", "1.420"}},
      {{"id", "4"}, {"type_symbol", "O"}, {"label_atom_id", "O"}, {"Cartn_x", "1.251"}, {"Cartn_y", "2.390"}}};
  const std::map<std::string, std::string> shared = {
      {"group_PDB", "ATOM"}, {"label_alt_id", "."}, {"label_comp_id", "ALA"},   {"label_asym_id", "A"},
      {"label_seq_id", "7"}, {"Cartn_z", "0.0"},    {"occupancy", "1.0"},       {"B_iso_or_equiv", "12.5"},
      {"auth_asym_id", "B"}, {"auth_seq_id", "7"},  {"pdbx_PDB_model_num", "1"}};
  std::string text = "data_x\nloop_\n";
  for (const std::string& column : columns) text += "_atom_site." + column + "\n";
  for (const auto& atom : atoms) {
    for (const std::string& column : columns)
      text += (atom.contains(column) ? atom.at(column) : shared.at(column)) + " ";
    text += "\n";
  }
  return text;
}

TEST(ReadStructure, ReadsMmcifWithoutTheColumnsThatSomeProgramsLeaveOut) {
  const std::vector<std::string> all = {
      "group_PDB",     "id",           "type_symbol",    "label_atom_id",     "label_alt_id", "label_comp_id",
      "label_asym_id", "label_seq_id", "Cartn_x",        "Cartn_y",           "Cartn_z",      "occupancy",
      "auth_asym_id",  "auth_seq_id",  "B_iso_or_equiv", "pdbx_PDB_model_num"};
  const TemporaryFile whole_file(cif_of_alanine(all), ".cif");
  const Structure whole = read_structure(whole_file.path());
  ASSERT_EQ(whole.atoms.size(), 4U);
  const auto without = [&](std::vector<std::string> left_out) {
    std::vector<std::string> columns;
    std::copy_if(all.begin(), all.end(), std::back_inserter(columns), [&](const std::string& column) {
      return std::find(left_out.begin(), left_out.end(), column) == left_out.end();
    });
    return cif_of_alanine(columns);
  };
  // PyMOL writes no auth_seq_id.
  for (const std::vector<std::string>& left_out :
       std::vector<std::vector<std::string>>{{"group_PDB"},
                                             {"auth_seq_id"},
                                             {"label_seq_id"},
                                             {"id"},
                                             {"type_symbol"},
                                             {"label_alt_id"},
                                             {"label_asym_id"},
                                             {"pdbx_PDB_model_num"},
                                             {"occupancy", "B_iso_or_equiv"}}) {
    SCOPED_TRACE(left_out.front());
    const TemporaryFile file(without(left_out), ".cif");
    const Structure s = read_structure(file.path());
    ASSERT_EQ(s.atoms.size(), 4U);
    EXPECT_EQ(s.models, whole.models);
    EXPECT_EQ(s.bonds.size(), whole.bonds.size());
    for (std::uint32_t i = 0; i < 4; ++i) {
      EXPECT_EQ(label(s, i), label(whole, i));
      EXPECT_EQ(s.atoms[i].element, whole.atoms[i].element);
    }
  }
  EXPECT_EQ(refusal(without({"label_seq_id", "auth_seq_id"}), {}, ".cif"),
            ": has no _atom_site.auth_seq_id and no _atom_site.label_seq_id, expected it for each atom");
  EXPECT_EQ(refusal(without({"Cartn_y"}), {}, ".cif"), ": has no _atom_site.Cartn_y, expected it for each atom");
}

TEST(ReadStructure, ReadsTheOneAtomOfMmcifWithoutALoop) {
  const TemporaryFile file(
      "data_x\n_atom_site.type_symbol ZN\n_atom_site.label_atom_id ZN\n_atom_site.label_comp_id ZN\n"
      "_atom_site.label_seq_id 5\n_atom_site.Cartn_x 1\n_atom_site.Cartn_y 2\n_atom_site.Cartn_z 3\n",
      ".cif");
  const Structure s = read_structure(file.path());
  ASSERT_EQ(s.atoms.size(), 1U);
  EXPECT_EQ(label(s, 0), "_:ZN5:ZN");
  EXPECT_EQ(s.models.front().front(), Vec3(1, 2, 3));
}

TEST(ReadStructure, SaysWhatAFileWithoutAtomsIs) {
  EXPECT_EQ(refusal("data_x\n_cell.length_a 1\n", {}, ".cif"),
            ": has no atoms, expected a CIF file with the category atom_site");
  EXPECT_EQ(refusal("data_ATP\nloop_\n_chem_comp_atom.comp_id\n_chem_comp_atom.atom_id\nATP PG\n", {}, ".cif"),
            ": has no atoms of a structure (atom_site), only components, which --components takes");
  EXPECT_EQ(refusal("BZh91AY&SY"), ": is packed by bzip2, expected text, plain or gzipped");
  EXPECT_EQ(refusal("\xfd"
                    "7zXZ"),
            ": is packed by xz, expected text, plain or gzipped");
  EXPECT_EQ(refusal("\x28\xb5\x2f\xfd"), ": is packed by zstd, expected text, plain or gzipped");
  EXPECT_EQ(refusal("PK\x03\x04"), ": is a zip archive, expected text, plain or gzipped");
  EXPECT_EQ(refusal("\x83\xa7"
                    "encoder"),
            ": is BinaryCIF, expected text, plain or gzipped");
}

TEST(ReadStructure, RefusesWholeNumbersThatNoIntHolds) {
  const auto text = [](const std::string& number, const std::string& first_tag = "") {
    std::string cif = "data_x\nloop_\n" + first_tag;
    for (const char* tag :
         {"group_PDB", "id", "type_symbol", "label_atom_id", "label_alt_id", "label_comp_id", "label_asym_id",
          "label_entity_id", "label_seq_id", "pdbx_PDB_ins_code", "Cartn_x", "Cartn_y", "Cartn_z", "occupancy",
          "B_iso_or_equiv", "auth_seq_id", "auth_asym_id", "pdbx_PDB_model_num"})
      cif.append("_atom_site.").append(tag).append("\n");
    return cif + (first_tag.empty() ? "" : "0 ") + "ATOM 1 N N . ALA A 1 46 ? 0 0 0 1.00 6.53 " + number + " A 1\n";
  };
  EXPECT_EQ(refusal(text("-99999999"), {}, ".cif"), "");
  EXPECT_EQ(refusal(text("9999999999946"), {}, ".cif"),
            ": _atom_site.auth_seq_id is 9999999999946, expected a number that starts with at most 9 digits");
  // With any text after the digits.
  for (const char* behind : {"A", "_x.9", ".5"})
    EXPECT_NE(refusal(text("9999999999" + std::string(behind)), {}, ".cif").find("at most 9 digits"), std::string::npos)
        << behind;
  // In every notation of the number, and in other loops.
  for (const std::string& cif : {text("'9999999999'"), text("' +9999999999'"), text("9999999999", "_other.id\n")})
    EXPECT_NE(refusal(cif, {}, ".cif").find("at most 9 digits"), std::string::npos) << cif;
  std::string upper = text("9999999999");
  for (std::size_t at = 0; (at = upper.find("_atom_site", at)) != std::string::npos;)
    upper.replace(at, 10, "_ATOM_SITE");
  EXPECT_NE(refusal(upper, {}, ".cif").find("at most 9 digits"), std::string::npos);
}

// Categories that are not read may be wrong, even declare 10^9 names.
TEST(ReadStructure, LooksAtNoOtherCategories) {
  const std::string atoms =
      "data_x\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_alt_id\n"
      "_atom_site.label_comp_id\n_atom_site.label_asym_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
      "_atom_site.Cartn_z\n_atom_site.occupancy\n_atom_site.B_iso_or_equiv\n_atom_site.auth_seq_id\n"
      "1 N N . ALA A 0 0 0 1 0 46\n";
  EXPECT_EQ(refusal(atoms, {}, ".cif"), "");
  for (const char* number : {"99999999999", "many"})
    EXPECT_EQ(refusal(atoms + "_refine.pdbx_refine_id x\n_refine.ls_number_reflns_obs " + number + "\n", {}, ".cif"),
              "");
  EXPECT_EQ(refusal(atoms + "_pdbx_struct_assembly.id 1\n_pdbx_struct_assembly.details author_defined_assembly\n"
                            "_pdbx_struct_assembly.method_details ?\n_pdbx_struct_assembly.oligomeric_details ?\n"
                            "_pdbx_struct_assembly.oligomeric_count 1\n_pdbx_struct_assembly_gen.assembly_id 1\n"
                            "_pdbx_struct_assembly_gen.oper_expression (1-999999999)\n"
                            "_pdbx_struct_assembly_gen.asym_id_list A\n",
                    {}, ".cif"),
            "");
}

TEST(ReadStructure, ReadsAnAtomWithoutAName) {
  const TemporaryFile file(alanine() + atom(6, "", "ALA", 1, 5, 5, 5) +
                           atom(7, "HB1", "ALA", 1, 3, -0.8, -1, ' ', 1, "H"));
  EXPECT_EQ(read_structure(file.path()).atoms.size(), 7U);
}

TEST(ReadStructure, TakesNoAtomsFromBehindTheEndOfALine) {
  // The parser stops splitting a line at the first non-ASCII byte, and would read a record after it.
  std::string text = alanine();
  text.insert(text.find('\n'), std::string(60, ' ') + "\x93" + atom(9, "CG", "ALA", 1, 9, 9, 9));
  const TemporaryFile file(text + "END\n");
  EXPECT_EQ(read_structure(file.path()).atoms.size(), 5U);
  text = alanine();
  text[text.find("CA")] = '\0';
  EXPECT_EQ(refusal(text), ":2: the line has a NUL character, expected the text of a PDB or mmCIF file");
}

TEST(ReadStructure, ReadsABondRecordThatEndsInTheMiddleOfANumber) {
  // The parser reads beyond "n" to look for "nan"; address sanitizer reports this.
  std::string link = "LINK         CA  ALA A   1                 CB  ALA A   1     1555   1555   n";
  for (const char* name : {"LINK  ", "link  ", "SSBOND"})
    EXPECT_EQ(refusal(link.replace(0, 6, name) + "\n" + alanine()), "");
}

TEST(ReadStructure, ReadsGzippedFilesAsTheirText) {
  std::ifstream in(test::ubiquitin());
  const TemporaryFile file(gzipped({std::istreambuf_iterator<char>(in), {}}, 1), ".pdb.gz");
  EXPECT_EQ(read_structure(file.path()).models, read_structure(test::ubiquitin()).models);
}

TEST(ReadStructure, ReadsAllMembersOfAGzippedFileOrRefusesIt) {
  const auto read = [](const std::string& bytes) {
    const TemporaryFile file(bytes, ".pdb.gz");
    return read_structure(file.path()).models.size();
  };
  const std::string first = gzipped("MODEL 1\n" + alanine() + "ENDMDL\n", 1),
                    second = gzipped("MODEL 2\n" + alanine() + "ENDMDL\n", 1);
  EXPECT_EQ(read(first + second), 2U);
  EXPECT_EQ(read(first + second + std::string(1000, '\0')), 2U) << "a tape's last block";
  const auto refused = [](const std::string& bytes, std::size_t byte, const char* why) {
    const std::string said = refusal(bytes, {}, ".pdb.gz");
    EXPECT_NE(said.find("cannot be read to its end: byte "), std::string::npos) << said;
    EXPECT_NE(said.find(why), std::string::npos) << said;
    const std::size_t at = said.find("byte ") + 5;
    EXPECT_NEAR(std::stod(said.substr(std::min(at, said.size()))), static_cast<double>(byte), 12.0) << said;
  };
  // Flips each bit of the first two bytes of the second member.
  for (std::size_t bit = 0; bit < 16; ++bit) {
    std::string flipped = first + second;
    flipped[first.size() + bit / 8] = static_cast<char>(flipped[first.size() + bit / 8] ^ (1 << bit % 8));
    refused(flipped, first.size(), "expected a gzip member or the end of the file");
  }
  refused(first + "more", first.size(), "expected a gzip member or the end of the file");
  refused(first + std::string(9, '\0') + "more", first.size() + 9, "expected only zeros");
  refused(first + second.substr(0, second.size() - 1), first.size() + second.size() - 1, "cut short");
  refused(first + second.substr(0, 5), first.size() + 5, "cut short");
  std::string wrong_sum = first;
  wrong_sum[first.size() - 5] = static_cast<char>(wrong_sum[first.size() - 5] ^ 1);
  refused(wrong_sum, first.size(), "damaged");
}

TEST(ReadStructure, RefusesAFileThatUnpacksWithoutEndNearlyAtOnce) {
  // 16 KiB of compressed data for each 16 MiB of blanks after the atoms, 256 MiB in all. Rejected before a third is
  // unpacked.
  const std::string bomb = gzipped(alanine() + std::string(std::size_t{16} << 20, ' '), 16);
  ASSERT_LT(bomb.size(), std::size_t{1} << 20);
  const std::string said = refusal(bomb, {}, ".pdb.gz"), words = "unpack to more than ";
  EXPECT_NE(said.find("expected at most 64 MiB + 200 times as many"), std::string::npos) << said;
  ASSERT_NE(said.find(words), std::string::npos);
  EXPECT_LT(std::stoul(said.substr(said.find(words) + words.size())), std::size_t{80} << 20);
}

TEST(ReadStructure, TakesAModelToTheEndOfAWholeFile) {
  for (const std::string end : {"", "END\n", "CONECT    1    2\n"}) {
    const TemporaryFile file("MODEL        0\n" + alanine() + end);
    const Structure s = read_structure(file.path());
    EXPECT_EQ(s.atoms.size(), 5U);
    EXPECT_TRUE(has_note(s, "line 1: MODEL has no ENDMDL")) << end;
  }
}

TEST(ReadStructure, TakesTheAtomsThatAllModelsHave) {
  const std::string two = "MODEL        1\n" + alanine() + "ENDMDL\nMODEL        2\n" +
                          alanine().substr(0, alanine().size() - 79) + "ENDMDL\n";
  const TemporaryFile file(two);
  const Structure s = read_structure(file.path());
  ASSERT_EQ(s.models.size(), 2U);
  EXPECT_EQ(s.atoms.size(), 4U);
  EXPECT_EQ(s.models[1].size(), 4U);
  EXPECT_EQ(s.bonds.size(), 3U);
  EXPECT_TRUE(
      has_note(s, "models differ: 1 atoms are left out, because some models lack them (first: A:ALA1:CB of model 1)"));
  // Another order of the atoms is the same molecule; another ion is not.
  const std::string last = alanine().substr(alanine().size() - 79), front = alanine().substr(0, alanine().size() - 79);
  const TemporaryFile order("MODEL        1\n" + alanine() + "ENDMDL\nMODEL        2\n" + last + front + "ENDMDL\n");
  const Structure turned = read_structure(order.path());
  ASSERT_EQ(turned.models.size(), 2U);
  EXPECT_EQ(turned.models[0], turned.models[1]);
  EXPECT_TRUE(has_note(turned, "models differ in the order of their atoms"));
  const std::string zinc = atom(6, "ZN", "ZN", 3, 20, 9, 9, ' ', 1, "ZN", "HETATM"),
                    renumbered = atom(6, "ZN", "ZN", 4, 20, 9, 9, ' ', 1, "ZN", "HETATM");
  const TemporaryFile ions("MODEL        1\n" + alanine() + zinc + "ENDMDL\nMODEL        2\n" + alanine() + renumbered +
                           "ENDMDL\n");
  ReadOptions hetero;
  hetero.hetero = true;
  EXPECT_EQ(read_structure(ions.path(), hetero).atoms.size(), 5U);
  EXPECT_TRUE(has_note(read_structure(ions.path(), hetero), "models differ: 2 atoms"));
  // Two ions with the same name and number are two atoms.
  const TemporaryFile twins("MODEL        1\n" + alanine() + zinc + "TER\n" + zinc + "ENDMDL\nMODEL        2\n" +
                            front + zinc + "TER\n" + zinc + "ENDMDL\n");
  EXPECT_EQ(read_structure(twins.path(), hetero).atoms.size(), 6U);
  std::string other = alanine();
  for (std::size_t at = 0; (at = other.find("A   1", at)) != std::string::npos;) other[at + 4] = '7';
  EXPECT_NE(refusal("MODEL        1\n" + alanine() + "ENDMDL\nMODEL        2\n" + other + "ENDMDL\n")
                .find("its models have no common atom"),
            std::string::npos);
}

TEST(ReadStructure, KeepsHeteroAtomsAndWatersWhereThereIsNothingElse) {
  const std::string water = atom(6, "O", "HOH", 2, 9, 9, 9, ' ', 1, "O", "HETATM"),
                    zinc = atom(7, "ZN", "ZN", 3, 20, 9, 9, ' ', 1, "ZN", "HETATM");
  const TemporaryFile waters(water), both(water + zinc), all(alanine() + water + zinc);
  Structure s = read_structure(waters.path());
  EXPECT_EQ(s.atoms.size(), 1U);
  EXPECT_TRUE(has_note(s, "the file holds only waters"));
  s = read_structure(both.path());
  EXPECT_EQ(s.atoms.size(), 1U);
  EXPECT_EQ(s.waters_dropped, 1U);
  EXPECT_TRUE(has_note(s, "no protein or nucleic acid"));
  ReadOptions options;
  options.waters = options.hetero = true;
  EXPECT_EQ(read_structure(all.path(), options).atoms.size(), 7U);
  EXPECT_EQ(read_structure(all.path()).hetero_residues_dropped.at("ZN"), 1U);
}

TEST(ReadStructure, RefusesModelsThatAreThereTwice) {
  const std::string two = "MODEL        1\n" + alanine() + "ENDMDL\nMODEL        2\n" + alanine() + "ENDMDL\n";
  ReadOptions options;
  options.model = 2;
  EXPECT_EQ(refusal(two, options), "");
  options.model = 3;
  EXPECT_NE(refusal(two, options).find("has no model 3"), std::string::npos);
}

TEST(ReadStructure, NumbersModelsAsTheirRecordsDo) {
  const auto numbers = [](const std::string& text, const std::string& extension = ".pdb") {
    const TemporaryFile file(text, extension);
    return read_structure(file.path()).model_numbers;
  };
  const std::string model = alanine() + "ENDMDL\n";
  EXPECT_EQ(numbers("MODEL        0\n" + model + "MODEL        1\n" + model), (std::vector<int>{0, 1}));
  EXPECT_EQ(numbers("MODEL 7\n" + model + "MODEL   \n" + model),
            (std::vector<int>{7, 2}));  // blank: position in the file
  EXPECT_EQ(numbers(model + model), (std::vector<int>{1, 2}));
  EXPECT_EQ(numbers("data_x\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
                    "_atom_site.label_alt_id\n_atom_site.label_comp_id\n_atom_site.label_asym_id\n"
                    "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.occupancy\n"
                    "_atom_site.B_iso_or_equiv\n_atom_site.auth_seq_id\n_atom_site.auth_asym_id\n"
                    "_atom_site.pdbx_PDB_model_num\n1 C CA . ALA A 1 2 3 1 0 1 A 0\n2 C CA . ALA A 1 2 3 1 0 1 A 4\n",
                    ".cif"),
            (std::vector<int>{0, 4}));
  std::string many;
  for (int k = 0; k < 10001; ++k)
    many += "MODEL     " + std::to_string(k % 9999 + 1) + "\n" + atom(1, "CA", "ALA", 1, 0, 0, 0) + "ENDMDL\n";
  EXPECT_EQ(numbers(many).size(), 10001U);
  EXPECT_EQ(numbers(many).back(), 10001);  // numbers repeat: position in the file
  const TemporaryFile joined("MODEL 1\n" + model + "MODEL 1\n" + model);
  EXPECT_EQ(read_structure(joined.path()).model_numbers, (std::vector<int>{1, 2}));
  EXPECT_TRUE(has_note(read_structure(joined.path()), "line 8: MODEL 1 occurs twice, so models are numbered by"));
  // gemmi compares four letters of a record's name, in either case.
  EXPECT_EQ(numbers("model\n" + alanine() + "ENDMDX\nMODEL\n" + alanine() + "endmdl\n"), (std::vector<int>{1, 2}));
  EXPECT_NE(refusal("MODEL 1\n" + model + "MODEL 2\nENDMDL\n").find(":8: the MODEL has no ATOM or HETATM record"),
            std::string::npos);
}

TEST(ReadStructure, TakesARecordedBondOfTwoSulphursForADisulphide) {
  const std::string cysteines = atom(1, "CB", "CYS", 1, 1.5, 0, 0) + atom(2, "SG", "CYS", 1, 3.3, 0, 0, ' ', 1, "S") +
                                atom(3, "CB", "CYS", 5, 7.1, 0.5, 0) +
                                atom(4, "SG", "CYS", 5, 5.3, 0.5, 0, ' ', 1, "S");
  const TemporaryFile file("LINK         SG  CYS A   1                 SG  CYS A   5     1555   1555  2.06\n" +
                           cysteines);
  ReadOptions options;
  options.bonds = BondSearch::recorded;
  const Structure s = read_structure(file.path(), options);
  EXPECT_TRUE(std::any_of(s.bonds.begin(), s.bonds.end(),
                          [](const Bond& bond) { return bond.origin == BondOrigin::disulphide; }));
}

/// Returns CG of LEU `number` with these altlocs and occupancies, at x = 10 * number + 0, 1 ...
std::string alternatives(int number, const std::vector<std::pair<char, double>>& occupancies) {
  std::string text;
  for (std::size_t k = 0; k < occupancies.size(); ++k)
    text += atom(10 * number + static_cast<int>(k), "CG", "LEU", number, 10.0 * number + static_cast<double>(k), 5, 5,
                 occupancies[k].first, occupancies[k].second);
  return text;
}

TEST(ReadStructure, ReadsOneConformerOfTheHighestSummedOccupancy) {
  // Sums: A 0.3 + 0.9 + 0.4, B 0.7 + 0.1 + 0.5; residue 5 has neither.
  const TemporaryFile file(alanine() + alternatives(2, {{'A', 0.3}, {'B', 0.7}}) +
                           alternatives(3, {{'A', 0.9}, {'B', 0.1}}) + alternatives(4, {{'A', 0.4}, {'B', 0.5}}) +
                           alternatives(5, {{'D', 0.5}, {'C', 0.5}}));
  Structure s = read_structure(file.path());
  ASSERT_EQ(s.atoms.size(), 9U);
  for (std::size_t k = 5; k < 8; ++k) EXPECT_EQ(s.atoms[k].altloc, 'A');
  EXPECT_EQ(s.atoms[8].altloc, 'C');
  EXPECT_EQ(s.models.front()[8][0], 51.0);
  EXPECT_TRUE(has_note(
      s,
      "alternative locations: A (highest summed occupancy) is used in 3 residues; 1 residues use "
      "their own location of highest occupancy (first: A:LEU5 at C); 4 atoms are left out (first: A:LEU2:CG at B)"));
  ReadOptions options;
  options.altloc = 'B';
  s = read_structure(file.path(), options);
  for (std::size_t k = 5; k < 8; ++k) EXPECT_EQ(s.atoms[k].altloc, 'B');
  EXPECT_EQ(s.atoms[8].altloc, 'C');
  EXPECT_TRUE(has_note(s, "alternative locations: B (--altloc) is used in 3 residues"));
}

TEST(ReadStructure, TakesTheFirstLetterOfEquallyOccupiedConformers) {
  const TemporaryFile file(alanine() + alternatives(2, {{'B', 0.5}, {'A', 0.5}}));
  EXPECT_EQ(read_structure(file.path()).models.front()[5][0], 21.0);
}

/// Residue 3 has no atom of conformer A, so it uses its own location of highest occupancy.
TEST(ReadStructure, TakesAnOccupancyThatIsNoNumberAsZero) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TemporaryFile file(alanine() + alternatives(2, {{'A', 0.9}, {'B', nan}}) +
                           alternatives(3, {{'C', nan}, {'D', 0.5}}));
  const Structure s = read_structure(file.path());
  ASSERT_EQ(s.atoms.size(), 7U);
  EXPECT_EQ(s.atoms[5].altloc, 'A');
  EXPECT_EQ(s.atoms[6].altloc, 'D');
}

TEST(ReadStructure, ReadsTheResidueTypeOfTheConformerWhereTwoShareAPosition) {
  // Serine has the higher occupancy at 3, but the structure uses conformer A.
  const std::string text = alanine() + alternatives(2, {{'A', 0.9}, {'B', 0.1}}) +
                           atom(40, "CG", "PRO", 3, 30, 5, 5, 'A', 0.4) +
                           atom(41, "OG", "SER", 3, 31, 5, 5, 'B', 0.6, "O");
  const TemporaryFile file(text);
  Structure s = read_structure(file.path());
  EXPECT_EQ(s.residues.back().name, "PRO");
  ReadOptions options;
  options.altloc = 'B';
  EXPECT_EQ(read_structure(file.path(), options).residues.back().name, "SER");
}

TEST(ReadStructure, LeavesOutWatersAndHeteroAtomsAndCountsThem) {
  const std::string text = alanine() + atom(6, "O", "HOH", 2, 9, 9, 9, ' ', 1, "O", "HETATM") +
                           atom(7, "ZN", "ZN", 3, 20, 9, 9, ' ', 1, "ZN", "HETATM");
  const TemporaryFile file(text);
  Structure s = read_structure(file.path());
  EXPECT_EQ(s.atoms.size(), 5U);
  EXPECT_EQ(s.waters_dropped, 1U);
  EXPECT_EQ(s.hetero_dropped, 1U);
  ReadOptions options;
  options.hetero = true;
  s = read_structure(file.path(), options);
  ASSERT_EQ(s.atoms.size(), 6U);
  EXPECT_EQ(s.atoms[5].element, "Zn");
}

TEST(ReadStructure, RepairsElementsThatContradictTheResidueAndSaysSo) {
  std::string text = alanine();
  text.replace(text.find("CA  ALA") - 1, 4, "CA  ");  // left-shifted: its columns mean calcium
  const std::size_t line = text.find("ATOM", 79);
  text.replace(line + 76, 2, "  ");
  const TemporaryFile file(text);
  const Structure s = read_structure(file.path());
  EXPECT_EQ(s.atoms[1].element, "C");
  EXPECT_TRUE(has_note(s, "elements of 1 atoms taken from their names"));
}

TEST(ReadStructure, FindsChainBreaksAndBuildsNoBondAcross) {
  std::string far = alanine();
  for (std::size_t at = far.find(" A   1"); at != std::string::npos; at = far.find(" A   1"))
    far.replace(at, 6, " A   9");
  for (std::size_t at = far.find("   0.000   0.000   0.000"); at != std::string::npos; at = std::string::npos)
    far.replace(at, 24, "  50.000   0.000   0.000");
  const TemporaryFile file(alanine() + far);
  const Structure s = read_structure(file.path());
  EXPECT_TRUE(has_note(s, "chain A: break between ALA1 and ALA9; no bond across"));
  EXPECT_TRUE(
      std::none_of(s.bonds.begin(), s.bonds.end(), [](const Bond& b) { return b.origin == BondOrigin::peptide; }));
}

TEST(ReadStructure, ReadsUbiquitin) {
  const Structure s = read_structure(test::ubiquitin());
  EXPECT_EQ(s.atoms.size(), 602U);
  EXPECT_EQ(s.residues.size(), 76U);
  EXPECT_EQ(s.bonds.size(), 608U);
  EXPECT_EQ(s.secondary_structure.size(), 7U);
  EXPECT_TRUE(s.notes.empty());
}

TEST(ReadStructure, ReadsOrRefusesEveryFileInOneLine) {
  int read = 0, refused = 0;
  for (const std::filesystem::path& file : test::molecule_files()) {
    const std::string extension = file.extension().string();
    if (extension == ".md" || extension == ".dcd" || extension == ".xtc") continue;
    SCOPED_TRACE(file.string());
    try {
      const Structure s = read_structure(file);
      EXPECT_FALSE(s.atoms.empty());
      ++read;
    } catch (const LoadError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find(file.filename().string()), std::string::npos) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      ++refused;
    }
  }
  std::printf("read %d files, refused %d\n", read, refused);
  EXPECT_GE(read, std::filesystem::exists(test::shared_molecules()) ? 55 : 20);
  EXPECT_LE(refused, 10);
}

TEST(ReadStructure, GivesTheSameMoleculeFromPdbAndMmcif) {
  for (const auto& [pdb, cif] : {std::pair("5pti.pdb", "5pti.cif"), std::pair("1a4w.pdb", "1a4w.cif"),
                                 std::pair("4hhb.pdb.gz", "4hhb.cif.gz")}) {
    SCOPED_TRACE(pdb);
    if (!std::filesystem::exists(test::molecule_file(cif))) continue;
    const Structure a = read_structure(test::molecule_file(pdb)), b = read_structure(test::molecule_file(cif));
    ASSERT_EQ(a.atoms.size(), b.atoms.size());
    EXPECT_EQ(a.models.front(), b.models.front());
    EXPECT_EQ(a.bonds.size(), b.bonds.size());
    EXPECT_EQ(a.residues.size(), b.residues.size());
  }
}

}  // namespace read_structure_test
}  // namespace hinge::molecular
