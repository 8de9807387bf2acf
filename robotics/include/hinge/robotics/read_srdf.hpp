// SPDX-License-Identifier: BSD-3-Clause
// read_srdf: disabled pairs of links, groups of joints and named configurations from an SRDF file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

struct JointGroup {
  std::string name;
  std::vector<std::size_t> joints;  ///< movable ones, followers included: positions in description().joints, sorted
};

/// Values (rad or m) of independent joints; followers follow.
struct NamedConfiguration {
  std::string name;
  std::string group;                                   ///< empty: the file names none
  std::vector<std::pair<std::size_t, double>> values;  ///< position in independent_joints(), value

  /// GROUP/NAME; NAME alone when the file gives it no group.
  std::string full_name() const { return group.empty() ? name : group + "/" + name; }

  /// Puts its values into a configuration of the independent joints, leaving the others.
  void apply(std::span<double> independent) const noexcept {
    for (const auto& [position, value] : values) independent[position] = value;
  }
};

struct Srdf {
  LinkPairs disabled;
  LinkPairs enabled;  ///< by enable_collisions, and not disabled after all
  std::vector<JointGroup> groups;
  std::vector<NamedConfiguration> configurations;
  std::vector<std::string> notes;  ///< what was left out, one sentence each
};

/// What to do when a pair names a link the robot does not have. SRDF files of several variants of a robot do.
enum class UnknownLinks : std::uint8_t { refused, noted };

/// Virtual joints, end effectors and passive joints have no part in collisions and are passed over. So are, with a
/// note, joints, links, chains and subgroups in groups and configurations that the robot or the file does not have:
/// they change no verdict. Of a joint that a configuration names twice the last value counts. LoadError, one line
/// naming file, line and element: bad XML, a pair with an unknown link (unless noted), a group that contains itself, a
/// value that is not a finite number of at most 1e15.
Srdf read_srdf(const std::filesystem::path& path, const Robot& robot, UnknownLinks unknown = UnknownLinks::refused);

struct NamedPair {
  std::string first, second;
  int line = 0;  ///< in the file
};

/// The pairs of a text file, two names a line, separated by blanks or a comma; `#` starts a comment. LoadError: a line
/// with other than two names.
std::vector<NamedPair> read_named_pairs(const std::filesystem::path& path);
/// Adds them, as names of links. LoadError: also an unknown link.
void read_link_pairs(const std::filesystem::path& path, const Robot& robot, LinkPairs& pairs);

}  // namespace hinge::robotics
