// SPDX-License-Identifier: BSD-3-Clause
// Tests trajectories: every variant of the formats, with files of known content, real files and damaged files.
#include "hinge/molecular/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "hinge/molecular/write_trajectory.hpp"
#include "molecular/test_files.hpp"
#include "molecular/trajectory_files.hpp"

namespace hinge::molecular {
namespace trajectory_test {

using test::carbons;
using test::dcd_file;
using test::DcdStyle;
using test::Frame;
using test::npy_file;
using test::TemporaryFile;
using test::XtcPacker;

/// Returns x rounded to floats, as the readers widen them.
Vec3 through_floats(Vec3 x) {
  for (Eigen::Index k = 0; k < 3; ++k) x[k] = detail::widened(static_cast<float>(x[k]));
  return x;
}

/// Returns frames of random atom chains with steps of about 1.5 angstrom, as doubles; rounded to floats if `single`.
std::vector<Frame> chains(std::size_t frames, std::size_t count, bool single) {
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) / 0x1p32; };
  std::vector<Frame> all(frames);
  for (Frame& frame : all) {
    Vec3 x(40 * uniform(), -30 * uniform(), 20 * uniform());
    for (std::size_t i = 0; i < count; ++i) {
      x += Vec3(3 * uniform() - 1.5, 3 * uniform() - 1.5, 3 * uniform() - 1.5);
      if (i % 17 == 16) x += Vec3(25 * uniform(), 0, -9);
      frame.push_back(single ? through_floats(x) : x);
    }
  }
  return all;
}

/// Returns the message of the first LoadError, from opening to the last frame; empty if there is none.
std::string refusal(const std::string& bytes, std::size_t count) {
  const TemporaryFile file(bytes, ".traj");
  const Structure molecule = carbons(count);
  try {
    const Trajectory trajectory(file.path(), molecule);
    for (std::size_t k = 0; k < trajectory.size(); ++k) {
      const Frame frame = trajectory.frame(k);
      EXPECT_EQ(frame.size(), count);
    }
  } catch (const LoadError& error) {
    EXPECT_EQ(std::string(error.what()).find(file.path().string()), 0U) << error.what();
    return error.what();
  }
  return "";
}

void expect_frames(const std::string& bytes, const std::vector<Frame>& expected) {
  const Structure molecule = carbons(expected[0].size());
  for (const std::string& stored : {bytes, test::gzipped(bytes)}) {
    const TemporaryFile file(stored, ".traj");
    const Trajectory trajectory(file.path(), molecule);
    ASSERT_EQ(trajectory.size(), expected.size());
    EXPECT_EQ(trajectory.atom_count(), expected[0].size());
    // Reads backwards: frames are independent of each other.
    for (std::size_t k = expected.size(); k-- > 0;) EXPECT_TRUE(trajectory.frame(k) == expected[k]) << k;
  }
}

TEST(Dcd, ReadsEveryVariant) {
  const auto frames = chains(4, 23, true);
  for (const bool big : {false, true})
    for (const std::size_t marker : {4U, 8U})
      for (const int variant : {0, 1, 2, 3}) {
        SCOPED_TRACE(testing::Message() << big << ' ' << marker << ' ' << variant);
        DcdStyle style;
        style.big = big;
        style.marker = marker;
        style.charmm = variant != 0;
        style.cell = variant >= 2;
        style.fourth = variant == 3;
        expect_frames(dcd_file(frames, style), frames);
      }
}

TEST(Dcd, TakesFixedAtomsFromTheFirstFrame) {
  const auto frames = chains(5, 12, true);
  DcdStyle style;
  style.cell = true;
  style.moving = {1, 4, 5, 11};
  auto expected = frames;
  for (std::size_t k = 1; k < frames.size(); ++k)
    for (std::size_t i = 0; i < 12; ++i)
      if (std::count(style.moving.begin(), style.moving.end(), i) == 0) expected[k][i] = frames[0][i];
  expect_frames(dcd_file(frames, style), expected);
}

TEST(Dcd, TrustsTheSizeNotTheHeader) {
  DcdStyle style;
  style.claimed = 500;
  const TemporaryFile file(dcd_file(chains(3, 10, true), style), ".dcd");
  const Structure molecule = carbons(10);
  const Trajectory trajectory(file.path(), molecule);
  EXPECT_EQ(trajectory.size(), 3U);
  ASSERT_EQ(trajectory.notes().size(), 1U);
  EXPECT_NE(trajectory.notes()[0].find("says 500 frames, the file holds 3"), std::string::npos);
}

TEST(Dcd, SaysWhereItIsCutShortOrDamaged) {
  const std::string whole = dcd_file(chains(3, 10, true));
  const std::size_t frame = std::size_t{3} * (8 + 40);
  // The complete frames before the cut can be read.
  const TemporaryFile file(whole.substr(0, whole.size() - 50), ".dcd");
  const Structure molecule = carbons(10);
  const Trajectory trajectory(file.path(), molecule);
  ASSERT_EQ(trajectory.size(), 3U);
  EXPECT_NO_THROW(trajectory.frame(1));
  EXPECT_THROW(trajectory.frame(2), LoadError);
  EXPECT_NE(refusal(whole.substr(0, whole.size() - 50), 10).find("frame 2"), std::string::npos);
  EXPECT_NE(refusal(whole.substr(0, whole.size() - 3 * frame), 10).find("holds no frame"), std::string::npos);
  std::string damaged = whole;
  damaged[whole.size() - 1] = 9;
  EXPECT_NE(refusal(damaged, 10).find("frame 2: a record of 40 bytes"), std::string::npos);
  for (std::size_t size = 1; size < whole.size() - 3 * frame; ++size)
    EXPECT_NE(refusal(whole.substr(0, size), 10), "") << size;
}

TEST(Npy, ReadsEveryType) {
  const auto doubles = chains(3, 7, false), floats = chains(3, 7, true);
  for (const int version : {1, 2, 3}) {
    expect_frames(npy_file(doubles, "<f8", version), doubles);
    expect_frames(npy_file(doubles, ">f8", version), doubles);
    expect_frames(npy_file(floats, "<f4", version), floats);
    expect_frames(npy_file(floats, ">f4", version), floats);
  }
  expect_frames(npy_file({doubles[0]}, "<f8", 1, "False", "(7, 3)"), {doubles[0]});
  expect_frames(npy_file(doubles, "<f8", 1, "True"), doubles);
  expect_frames(npy_file(floats, ">f4", 1, "True"), floats);
  expect_frames(npy_file({doubles[0]}, "<f8", 1, "True", "(7, 3)"), {doubles[0]});
}

TEST(Npy, RefusesWhatItCannotRead) {
  const auto frames = chains(2, 5, true);
  EXPECT_NE(refusal(npy_file(frames, "<f4", 1, "maybe"), 5).find("fortran_order"), std::string::npos);
  EXPECT_NE(refusal(npy_file(frames, "<i4"), 5).find("type '<i4'"), std::string::npos);
  EXPECT_NE(refusal(npy_file(frames, "<f4", 1, "False", "(2, 3, 5)"), 5).find("shape (2, 3, 5)"), std::string::npos);
  EXPECT_NE(refusal(npy_file(frames, "<f4", 1, "False", "(30,)"), 5).find("shape (30,)"), std::string::npos);
  EXPECT_NE(refusal(npy_file(frames, "<f4", 9), 5).find("version 9"), std::string::npos);
  EXPECT_EQ(refusal(npy_file({}, "<f4"), 5), "");  // 0 frames are allowed
  EXPECT_NE(refusal(npy_file(frames) + "more", 5).find("124 bytes of data"), std::string::npos);
  EXPECT_NE(refusal(npy_file(frames, "<f4", 1, "False", "(1, 5, 3)"), 5).find("120 bytes of data"), std::string::npos);
  const std::string whole = npy_file(frames);
  EXPECT_NE(refusal(whole.substr(0, whole.size() - 1), 5).find("inside frame 1"), std::string::npos);
  const std::string scattered = npy_file(frames, "<f4", 1, "True");
  EXPECT_NE(refusal(scattered.substr(0, scattered.size() - 1), 5).find("119 bytes of data"), std::string::npos);
  for (std::size_t size = 1; size < 128; ++size) EXPECT_NE(refusal(whole.substr(0, size), 5), "") << size;
}

/// Returns the frames rounded to the grid of `precision` steps per nanometre, as doubles.
std::vector<Frame> on_grid(std::vector<Frame> frames, double precision) {
  for (Frame& frame : frames)
    for (Vec3& x : frame)
      for (Eigen::Index k = 0; k < 3; ++k)
        x[k] = static_cast<double>(std::llround(x[k] / 10.0 * precision)) * 10.0 / precision;
  return frames;
}

TEST(Xtc, ReadsWhatIsPacked) {
  for (const std::size_t count : {10U, 11U, 64U, 700U})
    for (const double precision : {1000.0, 100.0, 10000.0, 1e6, 1e7}) {
      SCOPED_TRACE(testing::Message() << count << ' ' << precision);
      const auto frames = chains(3, count, false);
      expect_frames(XtcPacker(precision).file(frames), on_grid(frames, precision));
      expect_frames(XtcPacker(precision, 2023).file(frames), on_grid(frames, precision));
    }
  // First all atoms at one position, then atoms too far apart to pack three numbers into one.
  const Frame still(20, Vec3(1, 2, 3));
  expect_frames(XtcPacker().file({still}), {still});
  Frame wide = chains(1, 40, false)[0];
  wide[7] = Vec3(190000, -200000, 3);
  expect_frames(XtcPacker().file({wide}), on_grid({wide}, 1000.0));
}

TEST(Xtc, ReadsSmallFramesAsPlainFloats) {
  auto frames = chains(3, 9, false);
  const std::string bytes = XtcPacker().file(frames);
  for (Frame& frame : frames)
    for (Vec3& x : frame) x = 10.0 * through_floats(x / 10.0);
  expect_frames(bytes, frames);
}

TEST(Xtc, SaysWhereItIsCutShort) {
  XtcPacker packer;
  const auto frames = chains(3, 50, false);
  const std::string whole = packer.file(frames), last = packer.frame(frames[2]);
  for (std::size_t cut = 4; cut < last.size(); cut += 3) {
    const std::string said = refusal(whole.substr(0, whole.size() - cut), 50);
    EXPECT_NE(said.find("may be cut short"), std::string::npos) << cut << said;
  }
  const TemporaryFile file(whole.substr(0, whole.size() - 10), ".xtc");
  const Structure molecule = carbons(50);
  const Trajectory trajectory(file.path(), molecule);
  EXPECT_EQ(trajectory.size(), 3U);
  EXPECT_TRUE(trajectory.frame(1) == on_grid(frames, 1000.0)[1]);
}

TEST(Xtc, SurvivesEveryDamagedByte) {
  const std::string whole = XtcPacker().file(chains(2, 40, false));
  std::size_t refused = 0;
  for (std::size_t k = 8; k < whole.size(); ++k)
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      std::string damaged = whole;
      damaged[k] = static_cast<char>(damaged[k] ^ flip);
      refused += refusal(damaged, 40).empty() ? 0U : 1U;
    }
  EXPECT_GT(refused, 100U);
}

TEST(Trajectory, NamesFrameAndAtomOfWhatIsNoNumber) {
  auto frames = chains(3, 6, true);
  frames[1][4][1] = std::numeric_limits<double>::quiet_NaN();
  for (const std::string& bytes : {dcd_file(frames), npy_file(frames), npy_file(frames, ">f8")}) {
    const std::string said = refusal(bytes, 6);
    EXPECT_NE(said.find("frame 1: atom 4 (from 0, A:UNL1:C): y is nan"), std::string::npos) << said;
  }
  frames[1][4][1] = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(dcd_file(frames), 6).find("y is inf"), std::string::npos);
}

TEST(Trajectory, RefusesOtherFiles) {
  EXPECT_NE(refusal("", 5).find("is empty"), std::string::npos);
  EXPECT_NE(refusal("no such thing\n", 5).find("expected DCD, XTC, NumPy, PDB or mmCIF"), std::string::npos);
  EXPECT_NE(refusal(dcd_file(chains(1, 6, true)), 5).find("frames of 6 atoms"), std::string::npos);
  const Structure molecule = carbons(5);
  EXPECT_THROW(Trajectory("/nonexistent.dcd", molecule), LoadError);
  EXPECT_THROW(Trajectory("/tmp", molecule), LoadError);
}

TEST(Trajectory, FindsTheMoleculesAtomsInFramesOfItsFile) {
  // Waters before ubiquitin and between its atoms.
  std::ifstream ubiquitin(test::ubiquitin());
  std::vector<std::string> records;
  std::string text;
  const auto add = [&](const std::string& record) {
    records.push_back(record);
    text += record + "\n";
  };
  for (std::string line; std::getline(ubiquitin, line);) {
    if (!line.starts_with("ATOM  ")) continue;
    if (records.size() % 7 == 0) add("HETATM    1  O   HOH W   1      99.000  99.000  99.000  1.00  0.00           O");
    add(line);
  }
  const TemporaryFile solvated(text);
  const Structure s = read_structure(solvated.path());
  ASSERT_EQ(s.atoms.size(), 602U);
  ASSERT_EQ(s.atom_records, records.size());
  ASSERT_GT(s.atom_records, 680U);
  // Atoms in the order of the file, including waters. Atom i of the frame is at (i, 0, 0), so its position identifies
  // it.
  Frame frame;
  for (std::size_t i = 0; i < s.atom_records; ++i) frame.emplace_back(static_cast<double>(i), 0, 0);
  const TemporaryFile file(npy_file({frame}), ".npy");
  const Trajectory trajectory(file.path(), s);
  const Frame kept = trajectory.kept(trajectory.frame(0));
  ASSERT_EQ(kept.size(), s.atoms.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::string& record = records[static_cast<std::size_t>(kept[i][0])];
    EXPECT_NE(record.find(" " + s.atoms[i].name + " "), std::string::npos) << record;
    EXPECT_EQ(std::stod(record.substr(30, 8)), s.models[0][i][0]);
  }
  const TemporaryFile own(npy_file({s.models[0]}, "<f8"), ".npy");
  const Trajectory same(own.path(), s);
  EXPECT_TRUE(same.kept(same.frame(0)) == s.models[0]);
  EXPECT_TRUE(same.notes().empty());
  Frame nanometres = s.models[0];
  for (Vec3& x : nanometres) x /= 10.0;
  const TemporaryFile small(npy_file({nanometres}), ".npy");
  ASSERT_EQ(Trajectory(small.path(), s).notes().size(), 1U);
  EXPECT_NE(Trajectory(small.path(), s).notes()[0].find("as in nanometres"), std::string::npos);
}

/// Returns a PDB file of these frames. change(k, text) may alter the text of frame k.
template <class Change>
std::string pdb_of(const Structure& s, const std::vector<Frame>& frames, const Change& change) {
  std::string all;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::ostringstream out;
    write_pdb_model(out, s, frames[k], static_cast<int>(k) + 1);
    all += change(k, out.str());
  }
  return all + "END\n";
}

TEST(PdbModels, AreThoseOfTheWholeFile) {
  const Structure s = read_structure(test::ubiquitin());
  std::vector<Frame> frames(4, s.models[0]);
  for (std::size_t k = 0; k < frames.size(); ++k)
    for (Vec3& x : frames[k]) x[0] += static_cast<double>(k) / 8.0;
  const auto same = [](std::size_t, const std::string& text) { return text; };
  // Models with additional waters or another occupancy are read by the slow parser.
  const auto changed = [](std::size_t k, std::string text) {
    const std::size_t end = text.find("ENDMDL");
    if (k == 1) text.insert(end, "HETATM 9999  O   HOH A 999      10.000  10.000  10.000  1.00  0.00           O  \n");
    if (k == 2) text.replace(text.find("ATOM") + 54, 6, "  0.50");
    return text;
  };
  // The parser accepts record names in lower case.
  const auto small = [](std::size_t, std::string text) { return text.replace(text.find("ATOM      2"), 4, "atom"); };
  for (const std::string& text : {pdb_of(s, frames, same), pdb_of(s, frames, changed), pdb_of(s, frames, small)}) {
    const TemporaryFile file(text);
    const Structure all = read_structure(file.path());
    ReadOptions options;
    options.first_model = true;
    const Structure first = read_structure(file.path(), options);
    EXPECT_TRUE(first.more_models);
    EXPECT_EQ(first.models.size(), 1U);
    const Trajectory trajectory(file.path(), first, options);
    ASSERT_EQ(trajectory.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(trajectory.number(k), static_cast<int>(k) + 1);
      EXPECT_TRUE(trajectory.frame(k) == all.models[k]) << k;
    }
  }
}

TEST(PdbModels, KnowsTheBondsThatAreListedBehindThem) {
  const std::string atoms =
      "HETATM    1  C1  LIG A   1       0.000   0.000   0.000  1.00  0.00           C\n"
      "HETATM    2  C2  LIG A   1       1.340   0.000   0.000  1.00  0.00           C\n";
  std::string models;
  // Enough models to put the bonds into another block of the file than the first model.
  for (int k = 1; k <= 900; ++k) models += "MODEL     " + std::to_string(1000 + k) + "\n" + atoms + "ENDMDL\n";
  const auto read = [&](const std::string& text, bool first_model) {
    ReadOptions options;
    options.hetero = true;
    options.first_model = first_model;
    const TemporaryFile file(text);
    Structure s = read_structure(file.path(), options);
    EXPECT_EQ(s.more_models, first_model);
    return s;
  };
  for (const std::string end :
       {"CONECT    1    2\nCONECT    1    2", "CONECT    1    2\nCONECT    1    2\nEND\n", "END\n"}) {
    const Structure all = read(models + end, false), first = read(models + end, true);
    ASSERT_EQ(first.bonds.size(), 1U);
    EXPECT_EQ(first.bonds[0].origin, all.bonds[0].origin);
    EXPECT_EQ(first.bonds[0].order, all.bonds[0].order);
    EXPECT_EQ(first.bonds[0].origin == BondOrigin::record, end != "END\n");
    EXPECT_EQ(first.bond_records.size(), all.bond_records.size());
    EXPECT_EQ(first.atom_records, 2U);
  }
}

TEST(PdbModels, RefusesAnotherMoleculeAndBlankCoordinates) {
  const Structure s = read_structure(test::ubiquitin());
  const std::vector<Frame> frames(3, s.models[0]);
  const auto said = [&](const auto& change) -> std::string {
    const TemporaryFile file(pdb_of(s, frames, change));
    try {
      const Trajectory trajectory(file.path(), s);
      EXPECT_NO_THROW(trajectory.frame(0));
      for (std::size_t k = 1; k < trajectory.size(); ++k) trajectory.frame(k);
    } catch (const LoadError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(said([](std::size_t, const std::string& text) { return text; }), "");
  const auto blank = said([](std::size_t k, std::string text) {
    if (k == 2) text.replace(text.find('\n') + 1 + 38, 8, "        ");
    return text;
  });
  // Two models of 605 lines each (with MODEL, TER, ENDMDL), one MODEL line, and the record itself.
  EXPECT_NE(blank.find(":1212: atom 1 N: coordinate y is blank"), std::string::npos) << blank;
  const auto renamed = said([](std::size_t k, std::string text) {
    if (k == 1) text.replace(text.find(" CA  MET"), 8, " CX  MET");
    return text;
  });
  EXPECT_NE(renamed.find("model 2 has other atoms than the first"), std::string::npos) << renamed;
  EXPECT_NE(renamed.find("A:MET1:CX is in the place of A:MET1:CA"), std::string::npos) << renamed;
  EXPECT_NE(said([](std::size_t k, std::string text) { return k == 2 ? text.substr(0, 20000) + "\n" : text; }), "");
}

TEST(Trajectory, ReadsTheSameModelsFromEveryFormat) {
  const auto models = test::molecule_file("1l2y.pdb");
  const Structure s = read_structure(models);
  const Trajectory pdb(models, s), dcd(test::molecule_file("1l2y.dcd"), s), xtc(test::molecule_file("1l2y.xtc"), s);
  ASSERT_EQ(pdb.size(), 38U);
  ASSERT_EQ(dcd.size(), 38U);
  ASSERT_EQ(xtc.size(), 38U);
  for (std::size_t k = 0; k < 38; ++k) {
    EXPECT_TRUE(pdb.frame(k) == s.models[k]);
    EXPECT_TRUE(xtc.frame(k) == s.models[k]) << "its grid has the PDB file's three decimals";
    const Frame frame = dcd.frame(k);
    for (std::size_t i = 0; i < frame.size(); ++i)
      EXPECT_LE((frame[i] - s.models[k][i]).cwiseAbs().maxCoeff(),
                4e-6);  // 2 ulps of floats below 32
  }
}

TEST(Trajectory, ReadsLessThanAHeaderClaims) {
  const auto folder = test::shared_molecules();
  if (!std::filesystem::exists(folder / "adk_dims.dcd")) GTEST_SKIP() << "no shared data";
  const Structure s = read_structure(folder / "adk_closed.pdb");
  EXPECT_EQ(s.atom_records, 3341U);
  const Trajectory dcd(folder / "adk_dims.dcd", s);
  EXPECT_EQ(dcd.size(), 98U);
  EXPECT_EQ(dcd.notes().size(), 1U);
  for (std::size_t k = 0; k < 98; ++k) EXPECT_EQ(dcd.kept(dcd.frame(k)).size(), s.atoms.size());
}

TEST(TrajectoryWriter, WritesWhatIsReadAgain) {
  const Structure s = read_structure(test::ubiquitin());
  std::vector<Frame> frames(3, s.models[0]);
  for (Vec3& x : frames[1]) x *= 0.5;
  for (const TrajectoryFormat format : {TrajectoryFormat::pdb, TrajectoryFormat::dcd, TrajectoryFormat::npy})
    for (const bool single : {false, true}) {
      std::ostringstream out;
      TrajectoryWriter writer(out, format, s, s.atoms.size(), single);
      for (std::size_t k = 0; k < frames.size(); ++k) writer.add(frames[k], static_cast<int>(k));
      writer.finish();
      EXPECT_EQ(writer.size(), 3U);
      const TemporaryFile file(out.str(), ".traj");
      const Trajectory trajectory(file.path(), s);
      ASSERT_EQ(trajectory.size(), 3U);
      EXPECT_TRUE(trajectory.notes().empty());
      for (std::size_t k = 0; k < 3; ++k) {
        const Frame frame = trajectory.frame(k);
        for (std::size_t i = 0; i < frame.size(); ++i) {
          const Vec3& x = frames[k][i];
          const bool rounds = format == TrajectoryFormat::dcd || (format == TrajectoryFormat::npy && single);
          if (format == TrajectoryFormat::pdb)
            EXPECT_LE((frame[i] - x).cwiseAbs().maxCoeff(), 0.0005 + 1e-12);  // three decimals
          else
            EXPECT_TRUE(frame[i] == (rounds ? through_floats(x) : x));
        }
      }
    }
  std::ostringstream out;
  TrajectoryWriter writer(out, TrajectoryFormat::dcd, s, 1);
  EXPECT_THROW(writer.add({{Vec3(1e39, 0, 0)}}, 1), ModelError);
  EXPECT_THROW(writer.add(s.models[0], 1), ModelError);
}

}  // namespace trajectory_test
}  // namespace hinge::molecular
