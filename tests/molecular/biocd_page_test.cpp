// SPDX-License-Identifier: BSD-3-Clause
// Tests the pages of biocd --report: their data are those of the other outputs, for every command.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "hinge/molecular/read_structure.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"
#include "tool/page_data.hpp"
#include "tool/temporary_folder.hpp"

namespace hinge::molecular {
namespace biocd_page_test {

using Json = nlohmann::json;
using test::page_data;
using test::run_biocd;
using test::unpacked;

/// A folder for the pages.
struct BiocdPage : ::testing::Test {
  test::TemporaryFolder folder;
  std::string file = " " + test::ubiquitin().string() + " ";
  std::string page = (folder.path() / "page.html").string();
  std::string report = " --report " + page + " ";

  /// Returns the label of an atom of the page, in the words of the tables.
  static std::string label(const Json& molecule, std::size_t atom) {
    const auto residues = unpacked<std::uint32_t>(molecule.at("atoms").at("residues"));
    const Json& r = molecule.at("residues").at(residues.at(atom));
    return r[0].get<std::string>() + ":" + r[1].get<std::string>() + r[2].get<std::string>() + ":" +
           molecule.at("atoms").at("names").at(atom).get<std::string>();
  }

  /// Expects the rows of a frame to be the pairs of a JSON row.
  static void expect_same_pairs(const Json& data, const Json& frame, const Json& expected) {
    ASSERT_EQ(frame.at("pairs").size(), expected.size());
    std::vector<std::string> found, wanted;
    for (const Json& row : frame.at("pairs"))
      found.push_back(label(data.at("molecule"), row[0]) + " " + label(data.at("molecule"), row[1]) + " " +
                      std::to_string(row[2].get<double>()) + " " + std::to_string(row[5].get<double>()));
    for (const Json& pair : expected)
      wanted.push_back(pair.at("label_i").get<std::string>() + " " + pair.at("label_j").get<std::string>() + " " +
                       std::to_string(std::round(pair.at("distance").get<double>() * 1e3) / 1e3) + " " +
                       std::to_string(std::round(pair.at("overlap").get<double>() * 1e3) / 1e3));
    std::ranges::sort(found);
    std::ranges::sort(wanted);
    EXPECT_EQ(found, wanted);
  }
};

TEST_F(BiocdPage, ShowsTheWorstConformations) {
  const std::string sample = "sample" + file + "-n 120 --sigma 10 --seed 5 --max-pairs 0 ";
  const auto said = run_biocd(sample + "--json" + report);
  const Json json = Json::parse(said.out), data = page_data(page);
  ASSERT_EQ(data.at("all_frames").at("count"), 120);
  const auto counts = unpacked<std::uint32_t>(data.at("all_frames").at("pairs"));
  const auto collides = unpacked<std::uint8_t>(data.at("all_frames").at("collides"));
  for (std::size_t k = 0; k < 120; ++k) {
    const Json& row = json.at("conformations").at(k);
    EXPECT_EQ(counts.at(k), row.at("pairs").size());
    EXPECT_EQ(collides.at(k) != 0, row.at("collides").get<bool>());
  }
  ASSERT_EQ(data.at("frames").size(), 50);
  EXPECT_EQ(data.at("frames_left_out"), 70);
  std::uint32_t fewest = ~std::uint32_t{0};
  std::vector<bool> shown(120, false);
  for (const Json& frame : data.at("frames")) {
    const std::size_t k = frame.at("index");
    shown.at(k) = true;
    fewest = std::min(fewest, counts.at(k));
    expect_same_pairs(data, frame, json.at("conformations").at(k).at("pairs"));
  }
  for (std::size_t k = 0; k < 120; ++k)
    if (!shown[k]) {
      EXPECT_LE(counts[k], fewest);
    }
  // The same bytes for any number of threads.
  const auto bytes = [&](const std::string& options) {
    run_biocd(sample + options);
    Json again = page_data(page);
    again.erase("command");
    return again;
  };
  EXPECT_EQ(bytes("--threads 4 --json" + report), bytes("--json" + report));
}

TEST_F(BiocdPage, HoldsTheMoleculeAndItsCoordinates) {
  const auto said = run_biocd("check" + file + "--free A:70-76" + report);
  EXPECT_EQ(said.status, 1);
  EXPECT_NE(said.out.find("report: " + page + " shows 1 model\n"), std::string::npos) << said.out;
  const Json data = page_data(page);
  const Json& molecule = data.at("molecule");
  const Structure s = read_structure(test::ubiquitin());
  const auto moving = unpacked<std::uint8_t>(molecule.at("moving"));
  const auto grid = unpacked<std::int16_t>(data.at("frames").at(0).at("coordinates"));
  ASSERT_EQ(moving.size(), s.atoms.size());
  ASSERT_EQ(grid.size(), 3 * s.atoms.size());
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) {
    EXPECT_EQ(label(molecule, i), hinge::molecular::label(s, i));
    EXPECT_EQ(molecule.at("atoms").at("elements").at(i), s.atoms[i].element);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(molecule.at("origin").at(axis).get<double>() + 0.01 * grid[std::size_t{3} * i + axis],
                  s.models[0][i][static_cast<Eigen::Index>(axis)], 0.00501);
    // Residues before 69 stay; the last atoms move.
    if (s.residues[s.atoms[i].residue].sequence_number < 69) {
      EXPECT_EQ(moving[i], 0) << i;
    }
  }
  EXPECT_EQ(moving.back(), 1);
  EXPECT_EQ(unpacked<std::uint32_t>(molecule.at("bonds")).size(), 2 * s.bonds.size());
  EXPECT_EQ(data.at("verdict").at("state"), "collides");
  EXPECT_EQ(data.at("verdict").at("text"), "1 of 1 model collides");
  EXPECT_EQ(data.at("files").at(0).at("name"), test::ubiquitin().string());
  const auto sum = test::run_tool("sha256sum", file);
  EXPECT_EQ(data.at("files").at(0).at("sha256"), sum.out.substr(0, 64));
  EXPECT_NE(data.at("command").get<std::string>().find("check " + test::ubiquitin().string()), std::string::npos);
}

TEST_F(BiocdPage, PlaysPathsWalksPlansAndRelaxations) {
  const std::string tail = file + "--free A:74-76 ";
  EXPECT_EQ(run_biocd("path" + tail + "--from reference --to model:1" + report).status, 0);
  Json data = page_data(page);
  EXPECT_EQ(data.at("sequence"), "path");
  EXPECT_EQ(data.at("frames").size(), 61);
  EXPECT_EQ(data.at("verdict").at("state"), "free");

  // Turning psi of residue 30 by 180 degrees drives one half into the other: the colliding state is shown.
  const auto colliding = run_biocd("path" + file + "--free A:30:psi --from 0 --to 180 --json" + report);
  EXPECT_EQ(colliding.status, 1);
  data = page_data(page);
  const Json found = Json::parse(colliding.out);
  EXPECT_EQ(data.at("verdict").at("state"), "collides");
  const auto shown = std::ranges::find_if(data.at("frames"), [&](const Json& frame) {
    return frame.at("pairs").size() == found.at("pairs").size() && frame.at("collides");
  });
  ASSERT_NE(shown, data.at("frames").end());
  expect_same_pairs(data, *shown, found.at("pairs"));

  run_biocd("walk" + tail + "--steps 250" + report);
  EXPECT_EQ(page_data(page).at("frames").size(), 125);
  run_biocd("plan" + tail + "--to 60,0,0,0,0,0,0" + report + "2>/dev/null");
  data = page_data(page);
  EXPECT_LE(data.at("frames").size(), 200);
  for (const Json& frame : data.at("frames")) EXPECT_FALSE(frame.at("collides").get<bool>());
  run_biocd("relax" + file + report);
  data = page_data(page);
  ASSERT_EQ(data.at("frames").size(), 2);
  EXPECT_EQ(data.at("frames").at(0).at("pairs").size(), 1);
  EXPECT_EQ(data.at("frames").at(1).at("pairs").size(), 0);
  EXPECT_EQ(data.at("verdict").at("text"), "1 clash before, 0 clashes after");
}

TEST_F(BiocdPage, KeepsHostileNamesInsideTheirText) {
  const auto odd = folder.path() / "</script><b>\"'.pdb";
  std::filesystem::create_directories(odd.parent_path());
  std::filesystem::copy_file(test::ubiquitin(), odd);
  const std::string quoted = "'" + (folder.path() / "</script><b>\"'\\''.pdb").string() + "'";
  run_biocd("check " + quoted + report);
  const Json data = page_data(page);  // a "<" in the text would end the data early
  EXPECT_EQ(data.at("title"), odd.string());
}

TEST_F(BiocdPage, CutsLargeMoleculesDown) {
  // 36 copies of ubiquitin in a grid, each a chain: 21 672 atoms.
  const auto large = folder.path() / "large.pdb";
  {
    std::ofstream out(large);
    const Structure s = read_structure(test::ubiquitin());
    for (int copy = 0; copy < 36; ++copy) {
      const int row = copy / 6;
      for (std::size_t i = 0; i < s.atoms.size(); ++i) {
        const Residue& r = s.residues[s.atoms[i].residue];
        char line[96];
        std::snprintf(line, sizeof line, "ATOM  %5d %-4s %3s %c%4d    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n",
                      static_cast<int>((static_cast<std::size_t>(copy) * s.atoms.size() + i) % 99999 + 1),
                      (" " + s.atoms[i].name).c_str(), r.name.c_str(),
                      static_cast<char>(copy < 26 ? 'A' + copy : 'a' + copy - 26), r.sequence_number,
                      s.models[0][i].x() + 60.0 * (copy % 6), s.models[0][i].y() + 60.0 * row, s.models[0][i].z(),
                      s.atoms[i].element.c_str());
        out << line;
      }
    }
    out << "END\n";
  }
  EXPECT_EQ(run_biocd("check " + large.string() + report).status, 1);
  const Json data = page_data(page);
  const std::string cut = data.at("molecule").at("cut");
  EXPECT_NE(cut.find("of 21672 atoms are shown"), std::string::npos) << cut;
  EXPECT_LT(data.at("molecule").at("atoms").at("names").size(), 20000);
  EXPECT_EQ(data.at("frames").at(0).at("pairs").size(), 36);  // no pair is lost with its atoms
  EXPECT_EQ(data.at("frames").at(0).at("pairs_left_out"), 0);
  EXPECT_LT(std::filesystem::file_size(page), 2'500'000U);
}

TEST_F(BiocdPage, RefusesFilesThatAreNoPage) {
  const auto refused = [](const std::string& arguments) { return run_biocd(arguments + " 2>&1"); };
  const auto text = refused("check" + file + "--report page.txt");
  EXPECT_EQ(text.status, 2);
  EXPECT_NE(text.out.find("--report page.txt: expected a file name with .html"), std::string::npos) << text.out;
  const auto input = folder.path() / "input.html";
  std::filesystem::copy_file(test::ubiquitin(), input);
  EXPECT_EQ(refused("check " + input.string() + " --report " + input.string()).status, 2);
  EXPECT_EQ(std::filesystem::file_size(input), std::filesystem::file_size(test::ubiquitin()));
  EXPECT_EQ(refused("check" + file + "--report /nowhere/page.html").status, 3);
}

}  // namespace biocd_page_test
}  // namespace hinge::molecular
