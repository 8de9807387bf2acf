// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd dial: its counts equal a count by plain loops, its recommendation holds on other seeds, and atoms that it
// calls unreachable are never reached.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "molecular/run_biocd.hpp"
#include "tool/temporary_folder.hpp"

namespace hinge::molecular {
namespace biocd_dial_test {

using Json = nlohmann::json;
using test::run_biocd;

const std::string file = std::string(HINGE_SOURCE_DIR) + "/molecular/data/1ubq.pdb";
const std::string asked = " " + file + " --exempt-reference --free A:66-76 ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Json row_of(const Json& dial, std::size_t section, const std::string& name) {
  for (const Json& row : dial.at("sections").at(section).at("rows"))
    if (row.at("name") == name) return row;
  ADD_FAILURE() << "no row " << name;
  return {};
}

/// Coordinates from torsions by plain rotations about bonds, from the last torsion of the chain to the first.
class Turned {
 public:
  Turned(const Molecule& molecule, const DofSelection& selection) : molecule_(molecule) {
    for (const DofId dof : selection.dofs()) {
      const Torsion& torsion = molecule.torsions()[molecule.torsion_of(dof)];
      moved_.push_back(far_side(torsion.atoms[1], torsion.atoms[2]));
      axes_.emplace_back(torsion.atoms[1], torsion.atoms[2]);
    }
    for (std::size_t k = 0; k < moved_.size(); ++k) order_.push_back(k);
    std::ranges::sort(order_, {}, [&](std::size_t k) { return moved_[k].size(); });  // fewer atoms: further out
  }

  std::vector<Vec3> at(const std::vector<double>& q) const {
    const std::vector<Vec3>& reference = molecule_.structure().models.front();
    std::vector<Vec3> x = reference;
    for (const std::size_t k : order_) {
      auto [a, b] = axes_[k];
      if (std::ranges::find(moved_[k], b) == moved_[k].end()) std::swap(a, b);
      const Vec3 axis = (reference[b] - reference[a]) / norm(Vec3(reference[b] - reference[a]));
      // A turn of the far side about the bond from the near atom to the far one, whichever side is far.
      const double c = std::cos(q[k]), s = std::sin(q[k]);
      for (const std::uint32_t i : moved_[k]) {
        const Vec3 r = x[i] - reference[b];
        x[i] = reference[b] + c * r + s * cross(axis, r) + (1.0 - c) * dot(axis, r) * axis;
      }
    }
    return x;
  }

 private:
  /// The atoms on the side of the bond that is not fixed: the smaller one.
  std::vector<std::uint32_t> far_side(std::uint32_t a, std::uint32_t b) const {
    const auto side = [&](std::uint32_t from, std::uint32_t other) {
      const auto neighbours = bonded_neighbours(molecule_.structure());
      std::vector<std::uint32_t> found{from};
      for (std::size_t n = 0; n < found.size(); ++n)
        for (const std::uint32_t next : neighbours[found[n]])
          if (!(found[n] == from && next == other) && std::ranges::find(found, next) == found.end())
            found.push_back(next);
      return found;
    };
    auto first = side(a, b), second = side(b, a);
    return first.size() < second.size() ? first : second;
  }

  const Molecule& molecule_;
  std::vector<std::vector<std::uint32_t>> moved_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> axes_;
  std::vector<std::size_t> order_;
};

struct Scene {
  std::shared_ptr<const Molecule> molecule;
  std::vector<std::size_t> torsions;

  explicit Scene(const std::string& words) {
    molecule = std::make_shared<const Molecule>(read_structure(file, {}));
    torsions = select_torsions(*molecule, words, false);
  }
  Checker checker(const CheckOptions& options) const { return {molecule, molecule->select_placed(torsions), options}; }
};

/// Whether a pair collides, by a loop over all pairs.
bool collides(const Checker& checker, const std::vector<Vec3>& x) {
  for (std::uint32_t i = 0; i < x.size(); ++i)
    for (std::uint32_t j = i + 1; j < x.size(); ++j) {
      const double squared = dot(Vec3(x[i] - x[j]), Vec3(x[i] - x[j]));
      if (squared > 16.0) continue;
      const auto a = id<PrimitiveId>(i), b = id<PrimitiveId>(j);
      const double m = checker.thresholds().matrix.threshold(a, b);
      if (squared < m * m && !checker.constant(i, j) && checker.exclusions().admits(a, b)) return true;
    }
  return false;
}

struct Counts {
  std::size_t colliding = 0, accepts = 0, rejects = 0;
  void add(bool truth, bool given) {
    colliding += truth ? 1U : 0U;
    accepts += truth && !given ? 1U : 0U;
    rejects += !truth && given ? 1U : 0U;
  }
  void expect(const Json& row, std::size_t count) const {
    EXPECT_EQ(row.at("count"), count) << row;
    EXPECT_EQ(row.at("colliding"), colliding) << row;
    EXPECT_EQ(row.at("false_accepts"), accepts) << row;
    EXPECT_EQ(row.at("false_rejects"), rejects) << row;
  }
};

TEST(BiocdDial, CountsAreThoseOfPlainLoops) {
  constexpr std::size_t count = 200;
  const Json dial = Json::parse(run_biocd("dial" + asked + "--sigma 2 -n 200 --seed 5 --time 5 --json").out);
  const Scene scene("A:66-76");
  CheckOptions plain, wide;
  plain.exempt_reference = wide.exempt_reference = true;
  wide.thresholds.rho = 0.85;
  const Checker checker = scene.checker(plain), wider = scene.checker(wide);
  const Turned turned(*scene.molecule, checker.selection());
  const std::vector<std::size_t> backbone = select_torsions(*scene.molecule, "backbone", false);
  Counts same, by_rho, by_backbone;
  for (std::uint64_t k = 0; k < count; ++k) {
    std::vector<double> q = sample_configuration({5, 2.0 * std::numbers::pi / 180.0}, k, checker.dof_count());
    const auto x = turned.at(q);
    const bool truth = collides(checker, x);
    same.add(truth, truth);
    by_rho.add(truth, collides(wider, x));
    const auto dofs = checker.selection().dofs();
    for (std::size_t j = 0; j < q.size(); ++j)
      if (!std::ranges::binary_search(backbone, scene.molecule->torsion_of(dofs[j]))) q[j] = 0.0;
    by_backbone.add(truth, collides(checker, turned.at(q)));
  }
  EXPECT_GT(same.colliding, 20U);
  EXPECT_LT(same.colliding, 180U);
  EXPECT_GT(by_rho.rejects, 0U);
  EXPECT_GT(by_backbone.accepts + by_backbone.rejects, 0U);
  for (const char* name : {"the given options", "engine lazy", "engine brute", "sixteen at a time"})
    same.expect(row_of(dial, 0, name), count);
  by_rho.expect(row_of(dial, 0, "rho 0.85"), count);
  std::string only;
  for (const Json& row : dial.at("sections")[0].at("rows"))
    if (row.at("name").get<std::string>().starts_with("only backbone free")) only = row.at("name");
  by_backbone.expect(row_of(dial, 0, only), count);
}

TEST(BiocdDial, RigidGroupsOfAnEnsembleCountAsPlainLoops) {
  const test::TemporaryFolder folder;
  const std::string ensemble = (folder.path() / "ensemble.pdb").string();
  const std::string moving = "A:72-74 and backbone";
  ASSERT_EQ(run_biocd("sample " + file + " --free '" + moving + "' --sigma 40 -n 6 --seed 3 --exit-zero --out " +
                      ensemble + " 2>/dev/null")
                .status,
            0);
  constexpr std::size_t count = 100;
  const std::string arguments = "dial" + asked + "--sigma 2 -n 100 --seed 5 --time 5 --json --rigid-from " + ensemble;
  const Json dial = Json::parse(run_biocd(arguments).out);
  const Scene scene("A:66-76");
  CheckOptions plain;
  plain.exempt_reference = true;
  const Checker checker = scene.checker(plain);
  const Turned turned(*scene.molecule, checker.selection());
  const std::vector<std::size_t> free = select_torsions(*scene.molecule, moving, false);
  ASSERT_EQ(free.size(), 6U);
  Counts same, rigid;
  for (std::uint64_t k = 0; k < count; ++k) {
    std::vector<double> q = sample_configuration({5, 2.0 * std::numbers::pi / 180.0}, k, checker.dof_count());
    const bool truth = collides(checker, turned.at(q));
    same.add(truth, truth);
    const auto dofs = checker.selection().dofs();
    for (std::size_t j = 0; j < q.size(); ++j)
      if (!std::ranges::binary_search(free, scene.molecule->torsion_of(dofs[j]))) q[j] = 0.0;
    rigid.add(truth, collides(checker, turned.at(q)));
  }
  EXPECT_GT(rigid.accepts, 0U);
  same.expect(row_of(dial, 0, "the given options"), count);
  const Json row = row_of(dial, 0, "rigid groups of the ensemble, 6 torsions");
  rigid.expect(row, count);
  EXPECT_TRUE(has(row.at("options"), "--rigid-from " + ensemble)) << row;
  // An ensemble in which nothing moves leaves no torsion to turn.
  const std::string still = "dial" + asked + "-n 10 --time 1 --rigid-from " + file + " --rigid-from " + file;
  EXPECT_TRUE(has(run_biocd(still).out, "rigid groups of the ensemble: left out, because no torsion would be free"));
  EXPECT_EQ(run_biocd("dial" + asked + "-n 10 --time 1 --rigid-from missing.pdb 2>/dev/null").status, 3);
}

/// Returns the verdicts of `biocd sample --mode any`, one digit each.
std::string verdicts(const std::string& arguments) {
  std::istringstream rows(run_biocd("sample" + arguments + " --csv 2>/dev/null").out);
  std::string line, all;
  std::getline(rows, line);
  while (std::getline(rows, line)) all += line[line.find(',') + 1];
  return all;
}

TEST(BiocdDial, ItsRecommendationHoldsOnOtherSeeds) {
  const test::TemporaryFolder folder;
  const std::string settings = (folder.path() / "s.settings").string();
  for (const std::string limits : {"", "--most-false-accepts 30 --most-false-rejects 60 "}) {
    const auto said = run_biocd("dial" + asked + "--time 3 --json " + limits + "--apply " + settings);
    ASSERT_EQ(said.status, 0) << said.out;
    const Json dial = Json::parse(said.out), &advice = dial.at("recommendation");
    const std::string options = advice.at("options");
    if (advice.at("check").is_null()) {
      EXPECT_TRUE(has(advice.at("text"), "keep the given options")) << advice;
      continue;
    }
    EXPECT_EQ(advice.at("check").at("holds"), true);
    const std::string draw = " " + file + " --exempt-reference -n 1000 --seed 77 --sigma 1.5 ";
    const std::string free = has(options, "--free") ? "" : " --free A:66-76";
    const std::string with_mode = has(options, "--mode") ? "" : " --mode any";
    const std::string plain = verdicts(draw + "--free A:66-76 --mode any");
    const std::string with_file = verdicts(draw + free + with_mode + " --settings " + settings);
    EXPECT_EQ(with_file, verdicts(draw + free + with_mode + " " + options));
    ASSERT_EQ(plain.size(), with_file.size());
    if (limits.empty()) {
      EXPECT_EQ(plain, with_file);
    }
  }
}

TEST(BiocdDial, NothingReachesAtomsThatItCallsUnreachable) {
  const std::string tail = " " + file + " --free A:75-76 ";
  const Json dial = Json::parse(run_biocd("dial" + tail + "-n 10 --time 1 --json").out);
  std::vector<std::uint32_t> unreachable;
  for (const Json& requirement : dial.at("requires"))
    for (const Json& item : requirement.at("items"))
      unreachable.push_back(static_cast<std::uint32_t>(std::stoul(item.get<std::string>())));
  EXPECT_GT(unreachable.size(), 100U);
  const Scene scene("A:75-76");
  Checker checker = scene.checker({});
  double closest = 1e9;
  for (std::uint64_t k = 0; k < 300; ++k) {
    checker.check(sample_configuration({3, {}}, k, checker.dof_count()), Mode{Mode::Kind::any});
    const std::vector<Vec3> x = checker.positions();
    for (const std::uint32_t i : unreachable)
      for (std::uint32_t j = 0; j < x.size(); ++j) {
        if (checker.group_of(j) == checker.group_of(i)) continue;
        const double m = checker.thresholds().matrix.threshold(id<PrimitiveId>(i), id<PrimitiveId>(j));
        closest = std::min(closest, norm(Vec3(x[i] - x[j])) - m);
      }
  }
  EXPECT_GT(closest, 0.0);
  EXPECT_LT(closest, 10.0);  // the bound is not far too wide
}

TEST(BiocdDial, SaysWhatItCannotMeasure) {
  const std::string said = run_biocd("dial " + file + " --free A:70-76 --time 1 2>&1").out;
  EXPECT_TRUE(has(said, "the reference collides, so sigma was not chosen for it")) << said;
  const std::string loop = run_biocd("dial " + file + " --loop A:44-50 --time 1 2>&1").out;
  EXPECT_TRUE(has(loop, "paths: not measured")) << loop;
  EXPECT_TRUE(has(run_biocd("dial " + file + " --free none 2>&1").out, "no torsion is free"));
  EXPECT_EQ(run_biocd("dial " + file + " --sigma 2 --uniform 2>/dev/null").status, 2);
  EXPECT_EQ(run_biocd("dial " + file + " --time -1 2>/dev/null").status, 2);
  EXPECT_EQ(run_biocd("dial " + file + " --apply " + file + " 2>/dev/null").status, 2);
}

TEST(BiocdDial, ExtremesAreDecidedExactly) {
  const Json dial = Json::parse(run_biocd("dial" + asked + "--sigma 2 -n 10 --time 1 --extremes --json").out);
  const Json& extremes = dial.at("extremes");
  ASSERT_EQ(extremes.at("columns").size(), 5U);
  const auto row = [&](const std::string& name) -> Json {
    for (const Json& r : extremes.at("rows"))
      if (r[0] == name) return r;
    ADD_FAILURE() << name;
    return {};
  };
  const Json near = row("nearly touching");
  EXPECT_EQ(near[1], "400");
  EXPECT_EQ(near[2], "200");  // of each two neighbours exactly one collides
  EXPECT_EQ(near[3], "same");
  EXPECT_NE(near[4], "right");  // floats cannot tell them apart
  EXPECT_TRUE(has(row("nearly touching, written with 2 decimals (XTC)")[3], "changed"));
}

}  // namespace biocd_dial_test
}  // namespace hinge::molecular
