// SPDX-License-Identifier: BSD-3-Clause
// Tests disulphides in sample, walk and path: kept by default, opened on request, and reported in notes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/kept_closures.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/moves/move_checker.hpp"
#include "hinge/moves/move_closer.hpp"
#include "hinge/moves/random_move.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_closures_test {

using Json = nlohmann::json;
using test::run_biocd;

constexpr double promised = 1e-6;  // angstrom: largest residual of a kept closure

/// Residues 14 to 28 of crambin, with the disulphide 16-26.
std::filesystem::path file() {
  return std::filesystem::path(HINGE_SOURCE_DIR) / "tests" / "molecular" / "data" / "disulphide.pdb";
}

/// Measures the change of the disulphide's length, and of the distances across its two angles, from the reference
/// (angstrom).
class Bridge {
 public:
  Bridge() : s_(read_structure(file())) {
    for (std::uint32_t i = 0; i < s_.atoms.size(); ++i) {
      const int residue = s_.residues[s_.atoms[i].residue].sequence_number;
      const std::size_t end = residue == 16 ? 0 : 2;
      if (residue != 16 && residue != 26) continue;
      if (s_.atoms[i].name == "CB") atoms_[end] = i;
      if (s_.atoms[i].name == "SG") atoms_[end + 1] = i;
    }
  }
  double opened(const std::vector<Vec3>& x) const {
    double worst = 0.0;
    for (const auto& ends : {std::pair(1, 3), std::pair(0, 3), std::pair(1, 2)}) {
      const std::uint32_t a = atoms_[static_cast<std::size_t>(ends.first)];
      const std::uint32_t b = atoms_[static_cast<std::size_t>(ends.second)];
      const auto length = [a, b](const std::vector<Vec3>& at) { return norm(Vec3(at[a] - at[b])); };
      worst = std::max(worst, std::abs(length(x) - length(s_.models.front())));
    }
    return worst;
  }
  std::size_t size() const { return s_.atoms.size(); }

 private:
  Structure s_;
  std::array<std::uint32_t, 4> atoms_{};  // CB, SG, CB, SG
};

/// Reads an .npy file of doubles, frames x atoms x 3.
std::vector<std::vector<Vec3>> frames_of(const std::filesystem::path& path, std::size_t atoms) {
  std::ifstream in(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t start =
      10 + static_cast<unsigned char>(bytes.at(8)) + 256U * static_cast<unsigned char>(bytes.at(9));
  std::vector<std::vector<Vec3>> frames;
  for (std::size_t at = start; at + atoms * 24 <= bytes.size(); at += atoms * 24) {
    auto& frame = frames.emplace_back(atoms);
    for (std::size_t i = 0; i < atoms; ++i) {
      double x[3];
      std::memcpy(x, bytes.data() + at + 24 * i, 24);
      frame[i] = Vec3(x[0], x[1], x[2]);
    }
  }
  return frames;
}

double worst_of_samples(const std::string& more, int count) {
  const Bridge bridge;
  const auto out = std::filesystem::temp_directory_path() / "hinge_closures_test.npy";
  const auto said = run_biocd("sample " + file().string() + " --mode any --out " + out.string() + " -n " +
                              std::to_string(count) + " " + more + " 2>&1");
  EXPECT_LE(said.status, 1) << said.out;
  const auto frames = frames_of(out, bridge.size());
  std::filesystem::remove(out);
  EXPECT_EQ(frames.size(), static_cast<std::size_t>(count));
  double worst = 0.0;
  for (const auto& frame : frames) worst = std::max(worst, bridge.opened(frame));
  return worst;
}

TEST(BiocdClosures, SamplesKeepDisulphidesUnlessAskedOtherwise) {
  for (const std::string range : {"", "--sigma 5 "}) {
    EXPECT_LE(worst_of_samples(range, 20), promised);
    EXPECT_LE(worst_of_samples(range + "--closures keep", 20), promised);
    EXPECT_GT(worst_of_samples(range + "--closures open", 20), 0.05);
  }
}

TEST(BiocdClosures, WalksKeepDisulphidesUnlessAskedOtherwise) {
  const auto walk = [](const std::string& more) {
    const auto said =
        run_biocd("walk " + file().string() + " --rho 0.75 --steps 400 --seed 3 --json " + more + " 2>&1");
    EXPECT_EQ(said.status, 0) << said.out;
    return Json::parse(said.out.substr(said.out.find("{\n"))).at("summary");
  };
  const Json kept = walk(""), open = walk("--closures open");
  EXPECT_LE(kept.at("closure_residual").get<double>(), promised);
  EXPECT_GT(kept.at("accepted").get<int>(), 50);
  EXPECT_EQ(kept["accepted"].get<int>() + kept["rejected"].get<int>(), 400);
  EXPECT_GT(open.at("closure_residual").get<double>(), 0.05);
  EXPECT_EQ(open.at("unclosed"), 0);
}

TEST(BiocdClosures, WalksMoveLoops) {
  const auto said = run_biocd("walk " + test::ubiquitin().string() +
                              " --loop A:7-11 --steps 200 --exempt-reference --json 2>/dev/null");
  ASSERT_EQ(said.status, 0);
  const Json json = Json::parse(said.out);
  EXPECT_LE(json.at("summary").at("closure_residual").get<double>(), promised);
  EXPECT_GT(json.at("summary").at("accepted").get<int>(), 20);
}

TEST(BiocdClosures, SayWhatIsHeldAndWhatIsLeftOpen) {
  // Three torsions in a cycle with three fixed lengths cannot move.
  const std::string question = "sample " + file().string() + " --mode any -n 3 --free A:18:phi,psi,A:20:phi --json ";
  const auto held = run_biocd(question + "2>&1 >/dev/null");
  EXPECT_NE(held.out.find("3 torsions are held by closed cycles and stay at their reference: A:LEU18:phi"),
            std::string::npos)
      << held.out;
  EXPECT_EQ(Json::parse(run_biocd(question + "2>/dev/null").out).at("model").at("dof"), 0);
  EXPECT_EQ(Json::parse(run_biocd(question + "--closures open 2>/dev/null").out).at("model").at("dof"), 3);
  const auto walk = run_biocd("walk " + file().string() + " --free A:18:phi,psi,A:20:phi 2>&1");
  EXPECT_EQ(walk.status, 2);
  EXPECT_NE(walk.out.find("--closures open frees them"), std::string::npos) << walk.out;
}

TEST(BiocdClosures, AreKeptBesidePlacedParts) {
  const std::string two = "sample " + file().string() + " --with " + test::ubiquitin().string() +
                          " --place file:2=5,30 --mode any -n 5 --json ";
  const Json open = Json::parse(run_biocd(two + "--closures open 2>/dev/null").out),
             kept = Json::parse(run_biocd(two + "2>/dev/null").out),
             loop = Json::parse(run_biocd(two + "--loop B:7-11 2>/dev/null").out);
  EXPECT_LE(kept.at("summary").at("worst_closure_residual").get<double>(), promised);
  EXPECT_GT(open.at("summary").at("worst_closure_residual").get<double>(), 0.05);
  EXPECT_LE(loop.at("summary").at("worst_closure_residual").get<double>(), promised);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(kept.at("conformations")[k].at("placements"), open.at("conformations")[k].at("placements"));
}

TEST(BiocdClosures, OpenAlongPathsWithANote) {
  const auto path = [](const std::string& free) {
    return run_biocd("path " + file().string() + " --rho 0.6 --from reference --to " + free + " 2>&1 >/dev/null").out;
  };
  const std::string inside = path("2,3 --free A:18:phi,psi");
  EXPECT_NE(inside.find(
                "note: a straight path does not keep cycles closed: 1 of 1 closure opens on it, the most A:CYS16:SG - "
                "A:CYS26:SG, by 0."),
            std::string::npos)
      << inside;
  EXPECT_EQ(path("20 --free A:28:psi").find("does not keep cycles closed"), std::string::npos);
}

TEST(BiocdClosures, GiveTheSameBytesOnAnyNumberOfThreads) {
  const std::string question = "sample " + file().string() + " -n 12 --mode any --json 2>/dev/null";
  EXPECT_EQ(run_biocd(question).out, run_biocd(question + " --threads 3").out);
}

TEST(MoveCloser, WalksTheClosedSetWithTheVerdictsOfBruteForce) {
  const auto m = std::make_shared<const Molecule>(read_structure(file()));
  const KeptClosures kept = find_kept_closures(*m, select_torsions(*m, "all", false), Closures::all);
  ASSERT_EQ(kept.closures.size(), 1U);
  const DofSelection selection = m->select(kept.torsions);
  CheckOptions rules;
  rules.thresholds.rho = 0.75;
  rules.engine = "brute";
  Checker brute(m, selection, rules);
  MoveChecker<Point, BondExclusions, TypedThresholds> moves(
      MolecularHierarchy<Simd>(m->model(), selection, brute.exclusions(), brute.thresholds().matrix));
  MoveCloser closer(m->model().tree(), selection, kept.closures);
  const Bridge bridge;
  std::vector<DofChange> changes;
  std::size_t accepted = 0, rejected = 0;
  for (std::uint64_t step = 0; step < 300; ++step) {
    random_move(7, step, moves.configuration(), 2, 0.1, changes);
    if (!closer.close(moves.configuration(), changes)) continue;
    std::vector<double> q(moves.configuration().begin(), moves.configuration().end());
    for (const DofChange& change : changes) q[change.dof] = change.value;
    const bool free = moves.try_move(changes);
    const Verdict verdict = brute.check(q, Mode::parse("any"));
    ASSERT_EQ(free, !verdict.collides) << step;
    ASSERT_LE(bridge.opened(brute.positions()), promised) << step;
    if (free)
      moves.accept();
    else
      moves.reject();
    ++(free ? accepted : rejected);
  }
  EXPECT_GT(accepted, 30U);
  EXPECT_GT(rejected, 10U);
}

TEST(KeptClosures, LeaveOpenWhatDoesNotClose) {
  const Molecule m(read_structure(file()));
  const auto torsions = select_torsions(m, "all", false);
  const KeptClosures kept = find_kept_closures(m, torsions, Closures::all);
  EXPECT_EQ(kept.closures, std::vector<std::size_t>{0});
  EXPECT_TRUE(kept.notes.empty());
  EXPECT_TRUE(find_unclosable(m, m.select(kept.torsions), {1, {}}, {}, kept.closures).empty());
  const std::vector<std::size_t> open{0};
  const KeptClosures none = find_kept_closures(m, torsions, Closures::all, open);
  EXPECT_TRUE(none.closures.empty());
  EXPECT_EQ(none.torsions, torsions);
  EXPECT_EQ(none.notes,
            std::vector<std::string>{"closure A:CYS16:SG - A:CYS26:SG is left open: no random start could close it"});
  EXPECT_TRUE(find_kept_closures(m, torsions, Closures::of_loops).closures.empty());
}

TEST(BiocdClosures, ThatNoStartClosesAreGivenUpWithANote) {
  // The hydrogen bonds of ubiquitin join strands across the whole molecule; full turns cannot close all of them.
  const std::string question = "sample " + test::ubiquitin().string() +
                               " --keep-hbonds --mode any -n 2 --json 2>&1 >/dev/null",
                    why = " is left open: no random start could close it";
  const std::string notes = run_biocd(question).out;
  const Json said = Json::parse(
      run_biocd("sample " + test::ubiquitin().string() + " --keep-hbonds --mode any -n 2 --json 2>/dev/null").out);
  EXPECT_GT(said.at("model").at("closures_kept"), 0);
  EXPECT_EQ(said.at("summary").at("missing"), 0);
  std::size_t given_up = 0;
  for (const Json& closure : said.at("summary").at("closures")) {
    const std::string name = closure.at("bond");
    const bool open = notes.find("closure " + name + why) != std::string::npos;
    given_up += open ? 1 : 0;
    if (open) {
      EXPECT_GT(closure.at("residual"), promised) << name;
    } else {
      EXPECT_LE(closure.at("residual"), promised) << name;
    }
  }
  EXPECT_GT(given_up, 0U);
  EXPECT_LT(given_up, said.at("summary").at("closures").size());
}

}  // namespace biocd_closures_test
}  // namespace hinge::molecular
