// SPDX-License-Identifier: BSD-3-Clause
// Tests that files and messages have the same bytes if the locale of the program uses decimal commas and groups digits.
#include <gtest/gtest.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/clash_rules.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "hinge/molecular/write_trajectory.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace locale_test {

/// A locale with decimal commas, compiled into a folder that the destructor removes.
class GermanLocale {
 public:
  GermanLocale() : folder_(std::filesystem::temp_directory_path() / ("hinge-locale-" + std::to_string(getpid()))) {
    std::filesystem::create_directory(folder_);
    const std::string command = "localedef -i de_DE -f UTF-8 '" + (folder_ / name).string() + "' >/dev/null 2>&1";
    is_there_ = std::system(command.c_str()) == 0;
    setenv("LOCPATH", folder_.c_str(), 1);
  }
  GermanLocale(const GermanLocale&) = delete;
  GermanLocale& operator=(const GermanLocale&) = delete;
  ~GermanLocale() {
    std::locale::global(std::locale::classic());
    unsetenv("LOCPATH");
    std::filesystem::remove_all(folder_);
  }

  /// Sets the locale for C and C++. Returns false if this machine does not have it.
  bool use() const {
    if (!is_there_ || std::setlocale(LC_ALL, name) == nullptr) return false;
    std::locale::global(std::locale(name));
    return std::to_string(0.5) == "0,500000";
  }
  std::string environment() const { return "LOCPATH='" + folder_.string() + "' LC_ALL=" + name; }

 private:
  static constexpr const char* name = "de_DE.UTF-8";
  std::filesystem::path folder_;
  bool is_there_ = false;
};

std::string refusal(const auto& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Returns all text that the library writes: files, scripts, notes, type names, messages.
std::string all_texts() {
  // More than 1000 atoms, so that digits can be grouped; a cystine with too long a bond; a ligand.
  std::ostringstream text;
  Structure s = build_ideal_protein(std::string(80, 'W') + "CAC", std::string(83, 'C'));
  {
    std::ostringstream pdb;
    pdb.imbue(std::locale::classic());
    write_pdb_model(pdb, s, s.models[0], 1);
    std::string atoms = pdb.str();
    atoms = atoms.substr(0, atoms.find("ENDMDL"));
    atoms.erase(0, atoms.find('\n') + 1);
    const test::TemporaryFile file(
        "SSBOND   1 CYS A   81    CYS A   83                          1555   1555  2.05\n" + atoms +
        "HETATM 9998  C1  LIG A 999      90.000  90.125  90.250  1.00  0.00           C\n"
        "HETATM 9999  O1  LIG A 999      91.200  90.125  90.250  1.00  0.00           O\nEND\n");
    ReadOptions options;
    options.hetero = true;
    s = read_structure(file.path(), options);
    s.name = "test";
  }
  s.secondary_structure.push_back({SecondaryStructure::Kind::helix, 0, 9});
  s.secondary_structure.push_back({SecondaryStructure::Kind::strand, 10, 19});
  for (const std::string& note : s.notes)
    if (note.find('/') == std::string::npos) text << note << '\n';
  for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::cif}) {
    TrajectoryWriter writer(text, format, s, s.atoms.size());
    for (int model = 999; model < 1001; ++model) writer.add(s.models[0], model);
    writer.finish();
  }
  const auto molecule = std::make_shared<const Molecule>(s);
  for (const std::string rules : {"biocd", "severe", "molprobity", "chimerax", "posebusters"}) {
    CheckOptions options;
    options.thresholds.rules = rules;
    Checker checker(molecule, molecule->select({}), options);
    for (const std::string& name : checker.thresholds().type_names) text << name << ' ';
    const Verdict verdict = checker.check_coordinates(s.models[0], Mode::parse("within:0.25"));
    std::vector<Hit> hits;
    for (const Contact& pair : verdict.pairs) hits.push_back(pair.hit);
    write_chimerax_script(text, s, hits, {"x.pdb"});
    write_pymol_script(text, s, hits, {"x.pdb"});
    text << refusal([&] { checker.check_coordinates(s.models[0], Mode::parse("within:-0.25")); });
  }
  CheckOptions wrong;
  wrong.thresholds.rho = -1234.5;
  text << refusal([&] { Checker(molecule, molecule->select({}), wrong); });
  std::vector<Vec3> far = s.models[0];
  far[7][1] = 123456.75;
  text << refusal([&] { write_pdb_model(text, s, far, 1); });
  text << Mode::parse("within:0.25").text();
  return text.str();
}

TEST(Locale, ChangesNothingThatTheLibraryWrites) {
  const std::string expected = all_texts();
  for (const char* words : {"rho -1234.5", "coordinate 123456.75", "within:0.25", "1.20", "angstrom"})
    EXPECT_NE(expected.find(words), std::string::npos) << words;
  const GermanLocale german;
  if (!german.use()) GTEST_SKIP() << "localedef cannot make de_DE.UTF-8 here";
  const std::string same = all_texts();
  std::size_t at = 0;
  while (at < expected.size() && at < same.size() && expected[at] == same[at]) ++at;
  EXPECT_TRUE(same == expected) << same.substr(at < 60 ? 0 : at - 60, 120);
}

TEST(Locale, ChangesNothingThatTheToolWrites) {
  const GermanLocale german;
  if (!german.use()) GTEST_SKIP() << "localedef cannot make de_DE.UTF-8 here";
  const std::string sample = "sample '" + test::ubiquitin().string() + "' -n 3 --sigma 0.5 --mode within:0.25 ";
  for (const std::string output : {"--json", "--csv"}) {
    const auto plain = test::run_biocd(sample + output + " 2>&1", "LC_ALL=C"),
               comma = test::run_biocd(sample + output + " 2>&1", german.environment());
    EXPECT_EQ(plain.status, comma.status);
    EXPECT_GT(plain.out.size(), 100U);
    EXPECT_TRUE(plain.out == comma.out) << output;
  }
}

}  // namespace locale_test
}  // namespace hinge::molecular
