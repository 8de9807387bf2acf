// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd on ensembles: trajectories, filters, and the output of truncated files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"
#include "molecular/trajectory_files.hpp"

namespace hinge::molecular {
namespace biocd_ensemble_test {

using Json = nlohmann::json;
using test::Frame;
using test::run_biocd;
using test::Said;
using test::TemporaryFile;

std::string file() { return test::ubiquitin().string(); }

/// An output file for biocd; removed by the destructor.
struct Target {
  explicit Target(const std::string& extension) : file("", extension) {}
  std::string path() const { return file.path().string(); }
  TemporaryFile file;
};

/// Twelve conformations of ubiquitin; some of them are free under this rule.
const std::string rule = " --rho 0.7";
std::string sample_to(const Target& target) {
  return "sample " + file() + " -n 12 --seed 4 --sigma 0.4 --json --mode any --out " + target.path() + rule;
}

std::vector<bool> verdicts(const std::string& json) {
  std::vector<bool> all;
  const Json parsed = Json::parse(json);
  for (const Json& row : parsed.at("conformations")) all.push_back(row.at("collides").get<bool>());
  return all;
}

TEST(BiocdEnsemble, FindsTheSameInEveryFormat) {
  const Target npy(".npy"), dcd(".dcd"), pdb(".pdb");
  const std::vector<bool> expected = verdicts(run_biocd(sample_to(npy)).out);
  ASSERT_EQ(expected.size(), 12U);
  ASSERT_NE(std::count(expected.begin(), expected.end(), true), 0);
  ASSERT_NE(std::count(expected.begin(), expected.end(), false), 0);
  run_biocd(sample_to(dcd));
  run_biocd(sample_to(pdb));
  // The last question uses the PDB file as both topology and trajectory.
  for (const std::string& question :
       {file() + " " + npy.path(), file() + " " + dcd.path(), file() + " " + pdb.path(), pdb.path()}) {
    const Said said = run_biocd("check " + question + " --json" + rule);
    EXPECT_EQ(said.status, 1);
    EXPECT_EQ(verdicts(said.out), expected) << question;
  }
  const Json json = Json::parse(run_biocd("check " + file() + " " + npy.path() + " " + dcd.path() + " --json").out);
  ASSERT_EQ(json["trajectories"].size(), 2U);
  EXPECT_EQ(json["trajectories"][0]["frames"], 12);
  EXPECT_EQ(json["trajectories"][0]["atoms"], 602);
  EXPECT_EQ(json["conformations"][15]["index"], 15);
  EXPECT_EQ(json["conformations"][15]["trajectory"], 1);
  EXPECT_EQ(json["conformations"][15]["frame"], 3);
  EXPECT_EQ(json["summary"]["checked"], 24);
}

TEST(BiocdEnsemble, WritesTheFreeOnes) {
  const Target all(".npy");
  const std::vector<bool> expected = verdicts(run_biocd(sample_to(all)).out);
  const Structure s = read_structure(test::ubiquitin());
  const Trajectory whole(all.path(), s);
  for (const std::string extension : {".npy", ".dcd", ".pdb"}) {
    const Target out(extension);
    const std::string question = "check " + file() + " " + all.path() + rule + " --mode any --filter free --out ";
    EXPECT_EQ(run_biocd(question + out.path() + " --threads 3").status, 1);
    const Trajectory filtered(out.path(), s);
    std::size_t next = 0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      if (expected[k]) continue;
      ASSERT_LT(next, filtered.size());
      const Frame a = filtered.frame(next++), b = whole.frame(k);
      for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_LE((a[i] - b[i]).cwiseAbs().maxCoeff(), extension == ".npy" ? 0.0 : 0.0006);
    }
    EXPECT_EQ(next, filtered.size());
    const Said free = run_biocd("check " + file() + " " + out.path() + rule);
    EXPECT_EQ(free.status, 0) << free.out;
  }
}

TEST(BiocdEnsemble, KeepsWhatWasCheckedBeforeAFileBreaksOff) {
  const Structure s = read_structure(test::ubiquitin());
  std::vector<Frame> frames(40, s.models[0]);
  const std::string dcd = test::dcd_file(frames);
  frames[25][7][2] = std::numeric_limits<double>::infinity();
  const TemporaryFile cut(dcd.substr(0, dcd.size() - 1000), ".dcd"), odd(test::npy_file(frames), ".npy");
  const Target out(".npy");
  for (const auto& [path, whole, word] :
       {std::tuple(cut.path().string(), 39U, "cut short"), std::tuple(odd.path().string(), 25U, "frame 25: atom 7")})
    for (const std::string threads : {"1", "4"}) {
      const std::string question = "check " + file() + " " + path + " --mode any --threads " + threads;
      const Said json = run_biocd(question + " --json --out " + out.path() + " 2>/dev/null");
      EXPECT_EQ(json.status, 3);
      EXPECT_EQ(verdicts(json.out).size(), whole);
      EXPECT_NE(Json::parse(json.out)["summary"]["error"].get<std::string>().find(word), std::string::npos);
      EXPECT_EQ(Trajectory(out.path(), s).size(), whole);
      const Said said = run_biocd(question + " --csv 2>&1 >/dev/null | grep '^biocd: '");
      EXPECT_NE(said.out.find(word), std::string::npos);
      EXPECT_EQ(std::count(said.out.begin(), said.out.end(), '\n'), 1);
    }
  // If the file cannot be read at all, nothing is printed to standard output.
  for (const std::string& bytes : {std::string(), std::string("junk"), test::dcd_file({Frame(5, Vec3::Zero())})}) {
    const TemporaryFile bad(bytes, ".dcd");
    const Said said = run_biocd("check " + file() + " " + bad.path().string() + " --json 2>/dev/null");
    EXPECT_EQ(said.status, 3);
    EXPECT_EQ(said.out, "");
  }
  EXPECT_EQ(run_biocd("check " + file() + " --out /tmp/x.trr 2>&1").status, 2);
  EXPECT_EQ(run_biocd("check " + file() + " --filter free 2>&1").status, 2);
}

TEST(BiocdEnsemble, SaysWhichBondsAndClosuresABrokenConformationHas) {
  // Crambin's disulphides are closures. Moving its second half by 3 angstrom breaks bonds and some of the closures.
  const auto crambin = test::molecule_file("1crn.pdb");
  const Structure s = read_structure(crambin);
  Frame torn = s.models[0];
  for (std::size_t i = 0; i < torn.size(); ++i)
    if (s.atoms[i].residue >= 23) torn[i][0] += 3.0;
  const TemporaryFile frames(test::npy_file({s.models[0], torn}, "<f8"), ".npy");
  const std::string question = "check " + crambin.string() + " " + frames.path().string() + " --mode any ";
  const Json json = Json::parse(run_biocd(question + "--json 2>/dev/null").out);
  const Json &whole = json["conformations"][0], &broken = json["conformations"][1];
  EXPECT_EQ(whole["worst_bond"]["residual"], 0.0);
  ASSERT_EQ(whole["closures"].size(), 3U);
  for (const Json& closure : whole["closures"]) EXPECT_EQ(closure["residual"], 0.0);
  // The expected values are computed from the coordinates alone.
  const auto length = [&](const Frame& x, const Json& b) {
    return (x[b["i"].get<std::size_t>()] - x[b["j"].get<std::size_t>()]).norm();
  };
  const Json& bond = broken["worst_bond"];
  EXPECT_GT(bond["residual"].get<double>(), 1.0);
  EXPECT_DOUBLE_EQ(bond["length"].get<double>(), length(torn, bond));
  EXPECT_DOUBLE_EQ(bond["reference"].get<double>(), length(s.models[0], bond));
  int open = 0;
  for (const Json& closure : broken["closures"]) {
    const double residual = closure["residual"].get<double>();
    const std::string name = closure["bond"].get<std::string>();
    EXPECT_LE(residual, 3.0) << name;
    EXPECT_TRUE(residual < 1e-9 || residual > 0.2) << name << residual;
    open += residual > 0.2 ? 1 : 0;
  }
  EXPECT_GE(open, 1);
  EXPECT_EQ(json["summary"]["closures"].size(), 3U);
  double most = 0.0;
  for (const Json& closure : broken["closures"]) most = std::max(most, closure["residual"].get<double>());
  EXPECT_EQ(json["summary"]["worst_closure_residual"], most);
  const std::string table = run_biocd(question + "2>/dev/null").out;
  EXPECT_NE(table.find("frame 1: collides, bonds within "), std::string::npos) << table;
  EXPECT_NE(table.find("bond farthest from its length in the reference: A:"), std::string::npos) << table;
  EXPECT_NE(table.find("frame 0: free\n"), std::string::npos) << table;
  const std::string csv = run_biocd(question + "--csv 2>/dev/null").out;
  EXPECT_NE(csv.find("pair_collides,overlap,bond_residual,closure_residual\n0,0,,,,,,,,,0,0\n1,"), std::string::npos)
      << csv;
}

TEST(BiocdEnsemble, FindsRigidGroups) {
  // Two rigid halves, moved by phi and psi of one residue.
  const Target frames(".npy");
  run_biocd("sample " + file() + " --free A:35:backbone -n 30 --seed 3 --sigma 30 --out " + frames.path());
  const std::string from = file() + " --rigid-from " + frames.path();
  const Json json = Json::parse(run_biocd("info " + from + " --json --atoms 2>/dev/null").out);
  const Json& found = json["rigid_ensemble"];
  EXPECT_EQ(found["conformations"], 30);
  ASSERT_EQ(found["torsions"].size(), 2U) << found;
  EXPECT_EQ(found["torsions"][0]["torsion"], "A:GLY35:phi");
  EXPECT_EQ(found["torsions"][1]["torsion"], "A:GLY35:psi");
  EXPECT_NEAR(found["torsions"][0]["spread_degrees"].get<double>(), 30.0, 12.0);
  ASSERT_EQ(found["groups"].size(), 3U) << found;
  EXPECT_EQ(found["groups"][2]["atoms"], 1);  // C-alpha of the glycine between the halves
  EXPECT_EQ(json["model"]["dof"], 2);
  for (const Json& group : found["groups"]) {
    EXPECT_LE(group["superposed"]["worst_rmsd"].get<double>(), 0.001);
    EXPECT_EQ(group["segments"].size(), 1U);
  }
  EXPECT_LE(found["rebuilt"]["farthest"].get<double>(), 0.001);
  const std::string table = run_biocd("info " + from + " 2>/dev/null").out;
  EXPECT_NE(table.find("rigid groups of 30 conformations, tolerance 0.5 angstrom: 3\n"), std::string::npos) << table;
  EXPECT_NE(table.find("free A:GLY35:phi"), std::string::npos) << table;
  // sample uses the same model.
  EXPECT_EQ(Json::parse(run_biocd("sample " + from + " -n 2 --json 2>/dev/null").out)["model"]["dof"], 2);

  const auto refused = [&](const std::string& more, const std::string& message, int status) {
    const Said said = run_biocd("info " + more + " 2>&1");
    EXPECT_EQ(said.status, status) << said.out;
    EXPECT_NE(said.out.find(message), std::string::npos) << said.out;
  };
  refused(file() + " --rigid-from " + file(), "1 conformations, expected at least two", 2);
  refused(from + " --rigid-tolerance 0", "--rigid-tolerance '0': expected a number above 0", 2);
  refused(from + " --loop A:7-11", "--rigid-from and --loop are both given", 2);
  refused(file() + " --rigid-from /nonexistent", "/nonexistent", 3);
  Frame bad = read_structure(test::ubiquitin()).models[0];
  bad[7][1] = std::numeric_limits<double>::quiet_NaN();
  const TemporaryFile nan(test::npy_file({bad}, "<f8"), ".npy");
  refused(from + " --rigid-from " + nan.path().string(), "frame 0: atom 7", 3);
}

}  // namespace biocd_ensemble_test
}  // namespace hinge::molecular
