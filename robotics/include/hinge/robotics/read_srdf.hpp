// SPDX-License-Identifier: BSD-3-Clause
// read_srdf, parse_srdf: read disabled pairs of links, groups of joints and named configurations from an SRDF file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// A named group of joints.
struct JointGroup {
  std::string name;  ///< as in the file
  /// Indices into description().joints of the movable joints, mimic joints included, sorted.
  std::vector<std::size_t> joints;
};

/// Values (rad or m) of some independent joints. Mimic joints follow.
struct NamedConfiguration {
  std::string name;                                    ///< without the group
  std::string group;                                   ///< empty: the file names none
  std::vector<std::pair<std::size_t, double>> values;  ///< index into independent_joints(), value

  /// Returns GROUP/NAME, or NAME if the group is empty.
  std::string full_name() const { return group.empty() ? name : group + "/" + name; }

  /// Writes the values into a configuration of independent_joints().size() values; all other values are kept.
  void apply(std::span<double> independent) const noexcept {
    for (const auto& [position, value] : values) independent[position] = value;
  }
};

/// The contents of an SRDF file.
struct Srdf {
  LinkPairs disabled;              ///< pairs that the file disables
  LinkPairs enabled;               ///< by enable_collisions, unless disable_collisions disables them again
  std::vector<JointGroup> groups;  ///< in the order of the file
  std::vector<NamedConfiguration> configurations;  ///< states of groups, in the order of the file
  std::vector<std::string> notes;                  ///< one sentence for each kind of skipped element
};

/// What to do if a pair names an unknown link: throw LoadError, or skip the pair with a note. An SRDF file for several
/// variants of a robot has such pairs.
enum class UnknownLinks : std::uint8_t { refused, noted };

/// Reads an SRDF file for `robot`. Virtual joints, end effectors and passive joints do not affect collisions and are
/// ignored. Joints, links, chains and subgroups of groups and configurations that the robot or the file does not have
/// are skipped with a note, because they change no verdict. If a configuration names a joint twice, the last value
/// counts. Throws LoadError (one line with file, line and element) for bad XML, a pair with an unknown link (unless
/// noted), a group that contains itself, or a value that is not a finite number of at most 1e15.
HINGE_API Srdf read_srdf(const std::filesystem::path& path, const Robot& robot,
                         UnknownLinks unknown = UnknownLinks::refused);
/// The same for the text of an SRDF file that may be in memory only. path: names the text in messages.
HINGE_API Srdf parse_srdf(const std::string& text, const std::filesystem::path& path, const Robot& robot,
                          UnknownLinks unknown = UnknownLinks::refused);

/// A pair of names from a text file.
struct NamedPair {
  std::string first;   ///< first name of the line
  std::string second;  ///< second name of the line
  int line = 0;        ///< line number in the file, from 1
};

/// Reads pairs from a text file: two names per line, separated by blanks or a comma; `#` starts a comment. Throws
/// LoadError if the file cannot be read or a line does not have two names.
HINGE_API std::vector<NamedPair> read_named_pairs(const std::filesystem::path& path);
/// Reads pairs of link names and adds them to `pairs`. Throws LoadError as read_named_pairs(), and for an unknown link.
HINGE_API void read_link_pairs(const std::filesystem::path& path, const Robot& robot, LinkPairs& pairs);

}  // namespace hinge::robotics
