// SPDX-License-Identifier: BSD-3-Clause
// Robots for tests: the ten shared robots, if present, and temporary folders.
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/read_srdf.hpp"
#include "hinge/robotics/read_urdf.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "tool/temporary_folder.hpp"

namespace hinge::test {

/// Expected numbers of a shared robot, from the README of the shared data.
struct SharedRobot {
  std::string name;
  std::size_t links, links_with_geometry, groups_with_geometry, dofs, triangles, pairs;
};

/// Returns the ten shared robots.
inline const std::vector<SharedRobot>& shared_robots() {
  static const std::vector<SharedRobot> robots = {
      {"panda", 12, 11, 10, 8, 2364, 21},        {"fanuc_m10ia", 9, 7, 7, 6, 6934, 11},
      {"ur5_robotiq", 22, 18, 7, 6, 104197, 59}, {"ur10", 11, 8, 7, 6, 5874, 20},
      {"baxter", 49, 42, 15, 14, 4855, 561},     {"pr2", 82, 32, 27, 20, 5852, 239},
      {"icub", 56, 28, 28, 32, 3407, 340},       {"allegro_hand", 21, 21, 17, 16, 1484, 185},
      {"talos", 60, 52, 45, 32, 26726, 881},     {"snake40", 80, 80, 41, 40, 74000, 2965}};
  return robots;
}

/// Returns the folder of a shared robot, which may not exist.
inline std::filesystem::path shared_folder(const std::string& robot) {
  return std::filesystem::path(HINGE_SHARED_DATA) / "robots" / robot;
}

/// A robot tessellated as in the reference, and the pairs that the reference skips.
struct LoadedRobot {
  robotics::Robot robot;
  robotics::LinkPairs disabled;
};

/// Reads a shared robot with its SRDF and further excluded pairs.
inline LoadedRobot load_shared(const std::string& name) {
  using namespace robotics;
  const std::filesystem::path stem = shared_folder(name) / name;
  const auto with = [&](const std::string& extension) { return std::filesystem::path(stem.string() + extension); };
  LoadedRobot loaded{Robot(read_urdf(with(".urdf")), {Tessellation::Manner::inscribed}), LinkPairs()};
  // The SRDF of Baxter also names links of another variant.
  loaded.disabled = std::filesystem::exists(with(".srdf"))
                        ? read_srdf(with(".srdf"), loaded.robot, UnknownLinks::noted).disabled
                        : LinkPairs(loaded.robot.link_count());
  if (std::filesystem::exists(with(".acm_extra.txt")))
    read_link_pairs(with(".acm_extra.txt"), loaded.robot, loaded.disabled);
  return loaded;
}

/// Returns values of the independent joints, uniform within their limits.
inline std::vector<double> random_configuration(const robotics::Robot& robot, SampleStream& stream) {
  std::vector<double> q;
  for (std::size_t k = 0; k < robot.lower().size(); ++k)
    q.push_back(robot.lower()[k] + stream.uniform() * (robot.upper()[k] - robot.lower()[k]));
  return q;
}

/// Returns the message of the LoadError that `load` throws, without the folder's path; empty if it throws none.
template <class Load>
std::string refusal(const TemporaryFolder& folder, const Load& load) {
  try {
    load();
  } catch (const LoadError& error) {
    std::string what = error.what();
    const std::string prefix = folder.path().string() + "/";
    for (std::size_t at = what.find(prefix); at != std::string::npos; at = what.find(prefix))
      what.erase(at, prefix.size());
    return what;
  }
  return "";
}

}  // namespace hinge::test
