// SPDX-License-Identifier: BSD-3-Clause
// Tests the pages of robocd --report: their data are those of the other outputs, for every command.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "robotics/run_robocd.hpp"
#include "tool/page_data.hpp"

namespace hinge::robotics {
namespace robocd_page_test {

using Json = nlohmann::json;
using test::page_data;
using test::run_robocd;
using test::unpacked;

struct RobocdPage : ::testing::Test {
  test::ArmFolder folder;
  std::string page = (folder.path() / "page.html").string();
  std::string report = " --report '" + page + "' ";

  static std::string name(const Json& robot, std::size_t part) {
    const std::size_t links = robot.at("links").size();
    return (part < links ? robot.at("links").at(part) : robot.at("bodies").at(part - links)).at("name");
  }
  static std::set<std::string> pairs_of_frame(const Json& data, const Json& frame) {
    std::set<std::string> found;
    for (const Json& row : frame.at("pairs"))
      if (row[4] == 1) found.insert(name(data.at("robot"), row[0]) + " " + name(data.at("robot"), row[1]));
    return found;
  }
  static std::set<std::string> pairs_of_row(const Json& row) {
    std::set<std::string> found;
    for (const char* list : {"pairs", "environment_pairs"})
      for (const Json& pair : row.value(list, Json::array()))
        found.insert(pair.at(pair.contains("link1") ? "link1" : "link").get<std::string>() + " " +
                     pair.at(pair.contains("link2") ? "link2" : "body").get<std::string>());
    return found;
  }
};

TEST_F(RobocdPage, ShowsConfigurationsWithTheirPairs) {
  const std::string check = "check" + folder.urdf() + " --random 80 --seed 2 --env 'wall=box:0.5 0.5 4,xyz=1 0 0' ";
  const Json json = Json::parse(run_robocd(check + "--json" + report + "2>/dev/null").out), data = page_data(page);
  ASSERT_EQ(data.at("all_frames").at("count"), 80);
  ASSERT_EQ(data.at("frames").size(), 50);
  const auto collides = unpacked<std::uint8_t>(data.at("all_frames").at("collides"));
  for (std::size_t k = 0; k < 80; ++k)
    EXPECT_EQ(collides.at(k) != 0, json.at("configurations").at(k).at("collides").get<bool>());
  std::size_t pairs = 0;
  for (const Json& frame : data.at("frames")) {
    const Json& row = json.at("configurations").at(frame.at("index").get<std::size_t>());
    EXPECT_EQ(frame.at("collides"), row.at("collides"));
    EXPECT_EQ(frame.at("values"), row.at("values"));
    EXPECT_EQ(pairs_of_frame(data, frame), pairs_of_row(row));
    pairs += frame.at("pairs").size();
  }
  EXPECT_GT(pairs, 10U);
  EXPECT_EQ(data.at("robot").at("joints").at(1).at("name"), "elbow");
  EXPECT_EQ(data.at("robot").at("joints").at(1).at("unit"), "m");
  EXPECT_EQ(data.at("robot").at("links").at(0).at("moves"), 0);
  EXPECT_EQ(data.at("robot").at("links").at(1).at("moves"), 1);
}

TEST_F(RobocdPage, PlacesMeshesWhereTheRobotIs) {
  run_robocd("check" + folder.urdf() + " --zero" + report + "2>/dev/null");
  const Json data = page_data(page);
  const auto poses = unpacked<float>(data.at("frames").at(0).at("poses"));
  const Json& links = data.at("robot").at("links");
  ASSERT_EQ(poses.size(), 12 * links.size());
  for (std::size_t k = 0; k < links.size(); ++k) {
    const auto vertices = unpacked<float>(links.at(k).at("vertices"));
    const auto triangles = unpacked<std::uint32_t>(links.at(k).at("triangles"));
    ASSERT_FALSE(vertices.empty());
    for (const std::uint32_t corner : triangles) EXPECT_LT(corner, vertices.size() / 3);
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (std::size_t v = 0; v < vertices.size(); v += 3)
      for (int row = 0; row < 3; ++row) {
        const float* pose = &poses[12 * k + 4 * static_cast<std::size_t>(row)];
        const double x = pose[0] * vertices[v] + pose[1] * vertices[v + 1] + pose[2] * vertices[v + 2] + pose[3];
        low[row] = std::min(low[row], x);
        high[row] = std::max(high[row], x);
      }
    const Vec3 centre = 0.5 * (low + high);
    const std::string link = links.at(k).at("name");
    const Vec3 expected = link == "upper"    ? Vec3(1, 0, 0)
                          : link == "fore"   ? Vec3(1.5, 0, 0)
                          : link == "camera" ? Vec3(1.5, 0, 0.5)
                          : link == "mast"   ? Vec3(0, 0, 1.25)
                                             : Vec3(0, 0, 0);
    EXPECT_LT((centre - expected).norm(), 1e-5) << link;
  }
  EXPECT_EQ(links.at(0).at("triangles").get<std::string>().size(), 12 * 12 * 4 / 3);  // the cube: 12 triangles
}

TEST_F(RobocdPage, PlaysPathsPlansAndRelaxations) {
  const auto path = run_robocd("path" + folder.urdf() + " --from zero --to 0.5,0.5" + report);
  EXPECT_EQ(path.status, 0);
  EXPECT_NE(path.out.find("report: " + page + " shows 201 configurations\n"), std::string::npos) << path.out;
  Json data = page_data(page);
  EXPECT_EQ(data.at("sequence"), "path");
  EXPECT_EQ(data.at("verdict").at("state"), "free");
  for (const Json& frame : data.at("frames")) EXPECT_FALSE(frame.at("collides").get<bool>());

  // The fore arm runs into the base.
  const std::string hit = "path" + folder.urdf() + " --from zero --to 0,-1.5 --json" + report + "2>/dev/null";
  const Json found = Json::parse(run_robocd(hit).out);
  data = page_data(page);
  EXPECT_EQ(data.at("verdict").at("state"), "collides");
  const auto shown = std::ranges::find_if(data.at("frames"),
                                          [&](const Json& frame) { return frame.at("values") == found.at("values"); });
  ASSERT_NE(shown, data.at("frames").end());
  EXPECT_EQ(pairs_of_frame(data, *shown), pairs_of_row(found));
  // Names are places on the asked path, in their order, also around the configuration that the answer names.
  EXPECT_NEAR(std::stod(shown->at("name").get<std::string>().substr(4)), found.at("parameter").get<double>(), 1e-4);
  ASSERT_EQ(data.at("frames").size(), 202);
  EXPECT_EQ(data.at("frames").at(0).at("name"), "start");
  double before = 0.0;
  for (std::size_t k = 1; k < data.at("frames").size(); ++k) {
    const Json& frame = data.at("frames").at(k);
    const double t = std::stod(frame.at("name").get<std::string>().substr(4));
    EXPECT_GT(t, before);
    EXPECT_NEAR(frame.at("values").at(1).get<double>(), -1.5 * t, 1e-3);
    before = t;
  }

  EXPECT_EQ(run_robocd("plan" + folder.urdf() + " --from zero --to 0.5,0.5" + report).status, 0);
  EXPECT_EQ(page_data(page).at("frames").size(), 201);
  EXPECT_EQ(run_robocd("relax" + folder.urdf() + " --from 0,-1.5" + report).status, 0);
  data = page_data(page);
  ASSERT_EQ(data.at("frames").size(), 2);
  EXPECT_TRUE(data.at("frames").at(0).at("collides").get<bool>());
  EXPECT_FALSE(data.at("frames").at(1).at("collides").get<bool>());
}

TEST_F(RobocdPage, ShowsTheMatrix) {
  const auto said = run_robocd("matrix" + folder.urdf() + " --samples 500" + report + "2>/dev/null");
  EXPECT_EQ(said.out.substr(0, 5), "<?xml");  // standard output holds the SRDF alone
  const Json data = page_data(page), &matrix = data.at("robot").at("matrix");
  const std::size_t links = data.at("robot").at("links").size();
  const auto cells = unpacked<std::uint8_t>(matrix.at("cells"));
  ASSERT_EQ(cells.size(), links * links);
  const auto word = [&](const std::string& a, const std::string& b) {
    std::size_t i = 0, j = 0;
    for (std::size_t k = 0; k < links; ++k) {
      if (name(data.at("robot"), k) == a) i = k;
      if (name(data.at("robot"), k) == b) j = k;
    }
    EXPECT_EQ(cells[i * links + j], cells[j * links + i]);
    return matrix.at("words").at(cells[i * links + j]).get<std::string>();
  };
  EXPECT_EQ(word("fore", "camera"), "adjacent");
  EXPECT_EQ(word("base", "fore"), "sometimes in collision");
  EXPECT_EQ(word("base", "base"), "not tested");
}

TEST_F(RobocdPage, DrawsLargeMeshesCoarser) {
  // A sphere-like heap of 120 000 triangles.
  std::string obj;
  constexpr int rows = 245;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j)
      obj += "v " + std::to_string(0.01 * i) + " " + std::to_string(0.01 * j) + " " +
             std::to_string(0.2 * std::sin(0.05 * i) * std::cos(0.07 * j)) + "\n";
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j + 1 < rows; ++j) {
      const int v = i * rows + j + 1;
      obj += "f " + std::to_string(v) + " " + std::to_string(v + 1) + " " + std::to_string(v + rows) + "\nf " +
             std::to_string(v + 1) + " " + std::to_string(v + rows + 1) + " " + std::to_string(v + rows) + "\n";
    }
  folder.write("hill.obj", obj);
  run_robocd("check" + folder.urdf() + " --zero --env hill=" + (folder.path() / "hill.obj").string() + ",xyz='5 5 5'" +
             report + "2>/dev/null");
  const Json data = page_data(page);
  EXPECT_NE(data.at("robot").at("cut").get<std::string>().find("drawn coarser"), std::string::npos);
  const auto triangles = unpacked<std::uint32_t>(data.at("robot").at("bodies").at(0).at("triangles"));
  EXPECT_LT(triangles.size() / 3, 100000U);
  EXPECT_GT(triangles.size() / 3, 20000U);
  EXPECT_EQ(unpacked<std::uint32_t>(data.at("robot").at("links").at(0).at("triangles")).size(), 36U);
}

TEST_F(RobocdPage, NamesEveryInputFile) {
  const std::string rock = folder.write("rock.stl", test::cube_stl(Vec3(5, 5, 5), 0.5));
  const std::string rows = folder.write("rows.csv", "shoulder,elbow\n0.5,0.25\n");
  const std::string srdf = folder.write("arm.srdf", test::arm_srdf);
  run_robocd("check" + folder.urdf() + " --srdf " + srdf + " --csv-in " + rows + " --env rock=" + rock +
             " --env 'ball=sphere:0.1,xyz=5 0 0'" + report + "2>/dev/null");
  std::vector<std::string> names, digests;
  const Json data = page_data(page);
  for (const Json& file : data.at("files")) {
    names.push_back(file.at("name"));
    digests.push_back(file.at("sha256"));
  }
  EXPECT_EQ(names.size(), 4U);
  for (const std::string& file : {srdf, rows, rock}) EXPECT_NE(std::ranges::find(names, file), names.end()) << file;
  for (const std::string& digest : digests) EXPECT_EQ(digest.size(), 64U);
}

TEST_F(RobocdPage, RefusesFilesThatAreNoPage) {
  const auto text = run_robocd("check" + folder.urdf() + " --zero --report page.txt 2>&1");
  EXPECT_EQ(text.status, 2);
  EXPECT_NE(text.out.find("--report page.txt: expected a file name with .html"), std::string::npos) << text.out;
  EXPECT_EQ(run_robocd("check" + folder.urdf() + " --zero --report /nowhere/page.html 2>&1").status, 3);
  const auto same = run_robocd("check" + folder.urdf() + " --zero --out '" + page + "'" + report + "2>&1");
  EXPECT_EQ(same.status, 2);
  EXPECT_NE(same.out.find(": is the file of --out, expected a different file"), std::string::npos) << same.out;
  EXPECT_FALSE(std::filesystem::exists(page));
}

}  // namespace robocd_page_test
}  // namespace hinge::robotics
