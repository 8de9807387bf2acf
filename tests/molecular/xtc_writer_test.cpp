// SPDX-License-Identifier: BSD-3-Clause
// Tests written XTC files: read again by this library, and by MDAnalysis and MDTraj if they are installed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "hinge/molecular/write_trajectory.hpp"
#include "io/pack_xtc.hpp"
#include "io/xtc_file.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace xtc_writer_test {

using test::run_biocd;
using test::TemporaryFile;

std::vector<std::vector<Vec3>> read(const std::string& bytes) {
  const TemporaryFile file(bytes, ".xtc");
  const XtcFile xtc{BinaryFile(file.path())};
  std::vector<std::vector<Vec3>> frames;
  for (std::size_t k = 0; k < xtc.size(); ++k) frames.push_back(xtc.frame(k));
  return frames;
}

/// Chains of atoms with steps and jumps from 0.0001 to 1e6 angstrom: all small ranges, axes packed together and alone.
TEST(XtcWriter, IsReadAgain) {
  constexpr unsigned seed = 1;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&](double scale) {
    return Vec3(scale * normal(random), scale * normal(random), scale * normal(random));
  };
  for (int test = 0; test < 500; ++test) {
    const std::size_t atoms = 1 + random() % 60;
    const double scale = std::pow(10.0, static_cast<double>(random() % 8) - 2.0);
    const double step = std::pow(10.0, static_cast<double>(random() % 7) - 4.0);
    std::vector<Vec3> positions;
    Vec3 at = vector(scale);
    for (std::size_t i = 0; i < atoms; ++i) {
      if (random() % 10 == 0) at = vector(scale);
      positions.push_back(at += vector(step));
    }
    const auto frames = read(xtc_frame(positions, 0) + xtc_frame(positions, 1));
    ASSERT_EQ(frames.size(), 2U) << "seed " << seed << " test " << test;
    for (const auto& frame : frames) {
      ASSERT_EQ(frame.size(), atoms);
      for (std::size_t i = 0; i < atoms; ++i) {
        const double error = (frame[i] - positions[i]).cwiseAbs().maxCoeff();
        // Few atoms are stored as floats, others on a grid of 0.01 angstrom.
        EXPECT_LE(error, atoms > 9 ? 0.005 + 1e-9 : 1e-6 * (1.0 + positions[i].norm()))
            << "seed " << seed << " test " << test;
      }
    }
  }
}

TEST(XtcWriter, IsSmallAndRefusesWhatDoesNotFit) {
  const Structure s = read_structure(test::ubiquitin());
  const std::vector<Vec3>& positions = s.models.front();
  EXPECT_LT(xtc_frame(positions, 0).size(), positions.size() * 5);  // 12 bytes as floats
  std::vector<Vec3> far(20, Vec3::Zero());
  far[3][1] = 1.2e8;
  EXPECT_THROW(xtc_frame(far, 0), ModelError);
  far[3][1] = std::nan("");
  EXPECT_THROW(xtc_frame(far, 0), ModelError);
}

TEST(XtcWriter, SharesItsFormatWithOtherPrograms) {
  const std::string name =
      (std::filesystem::temp_directory_path() / ("hinge_xtc_writer" + std::to_string(getpid()))).string();
  const std::string walk =
      "walk " + test::ubiquitin().string() + " --exempt-reference --steps 300 --every 50 --out " + name;
  for (const char* extension : {".xtc", ".npy", ".pdb", ".cif"}) ASSERT_EQ(run_biocd(walk + extension).status, 0);
  EXPECT_EQ(
      run_biocd("check " + test::ubiquitin().string() + " " + name + ".xtc --mode any --exit-zero | tail -n 1").status,
      0);
  EXPECT_EQ(run_biocd("check " + name + ".cif --mode any --exempt-reference --csv").status, 0);

  const TemporaryFile script(R"(import sys, warnings
warnings.simplefilter("ignore")
import numpy
name = sys.argv[2]
expected = numpy.load(name + ".npy")
if sys.argv[1] == "MDAnalysis":
    import MDAnalysis
    universe = MDAnalysis.Universe(name + ".pdb", name + ".xtc")
    got = numpy.array([frame.positions.copy() for frame in universe.trajectory])
else:
    import mdtraj
    got = 10 * mdtraj.load_xtc(name + ".xtc", top=name + ".pdb").xyz
assert got.shape == expected.shape, (got.shape, expected.shape)
assert abs(got - expected).max() < 0.00502, abs(got - expected).max()
)",
                             ".py");
  int readers = 0;
  for (const std::string reader : {"MDAnalysis", "mdtraj"}) {
    if (test::run_tool("/usr/bin/python3", "-c 'import numpy, " + reader + "' 2>/dev/null").status != 0) continue;
    ++readers;
    const auto said = test::run_tool("/usr/bin/python3", script.path().string() + " " + reader + " " + name + " 2>&1");
    EXPECT_EQ(said.status, 0) << reader << "\n" << said.out;
  }
  for (const char* extension : {".xtc", ".npy", ".pdb", ".cif"}) std::filesystem::remove(name + extension);
  if (readers == 0) GTEST_SKIP() << "neither MDAnalysis nor MDTraj is installed";
}

}  // namespace xtc_writer_test
}  // namespace hinge::molecular
