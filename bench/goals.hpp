// SPDX-License-Identifier: BSD-3-Clause
// Goals: what the rows of the summary should reach, and the rows that miss it.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace hinge::bench {

/// The value that a row should have at least, or at most. It holds for rows with this beginning and this end.
struct Goal {
  std::string_view beginning, end;
  double value;
  bool at_most = false;
};

/// The first goal that fits a row counts. Molecules: the geometric mean over the set-ups. Robots: each robot, and the
/// geometric mean over robots.
inline constexpr Goal all_goals[] = {
    {"ratio any near-free", " fcl", 55.0},
    {"ratio any near-free", " lazy", 9.0},
    {"ratio any near-free", " chain", 4.5},
    {"ratio any near-free", " chain16", 2.0},
    {"ratio ", " chain16", 1.5},
    {"ratio ", " grid", 2.0},
    {"list ", "", 8.0, true},
    {"growth any", "", 1.5, true},
    {"threads any", "", 1.8},
    {"floor any", "", 1.3, true},
    {"moves any", " chain16-skip", 5.0},
    {"path any k35-20deg", " sampled-0.1deg", 8.0},
    {"path any k153-1deg", " sampled-0.1deg", 2.0},
    {"ratio robot-independent", " single", 3.0},
    {"ratio robot-edges", " single", 6.0},
    {"ratio robot-any mean", " fcl-best", 28.0},
    {"ratio robot-all mean", " fcl-best", 28.0},
    {"ratio robot-distance mean", " fcl-best", 50.0},
    {"ratio robot-environment mean", " fcl-best", 18.0},
    {"ratio robot-build mean", " fcl-best", 4.0},
    {"ratio robot-any", " fcl-best", 13.0},
    {"ratio robot-all", " fcl-best", 13.0},
    {"ratio robot-distance", " fcl-best", 20.0},
    {"ratio robot-environment", " fcl-best", 8.0},
    {"ratio robot-build", " fcl-best", 3.0},
    {"ratio robot-any mean", " fcl-native-best", 16.0},
    {"ratio robot-all mean", " fcl-native-best", 15.0},
    {"ratio robot-distance mean", " fcl-native-best", 45.0},
    {"ratio robot-distance panda", " fcl-native-best", 30.0},
    {"ratio robot-environment mean", " fcl-native-best", 12.0},
    {"ratio robot-any", " fcl-native-best", 8.0},
    {"ratio robot-all", " fcl-native-best", 8.0},
    {"ratio robot-distance", " fcl-native-best", 8.0},
    {"ratio robot-environment", " fcl-native-best", 8.0},
};

/// A row that misses its goal.
struct Missed {
  std::string row;
  double value = 0.0;
  const Goal* goal = nullptr;
};

/// Compares rows with their goals.
class Goals {
 public:
  /// row: a line of the summary without its value.
  void check(std::string_view row, double value) {
    for (const Goal& goal : all_goals)
      if (row.starts_with(goal.beginning) && row.ends_with(goal.end)) return compare(row, value, goal);
  }
  const std::vector<Missed>& missed() const noexcept { return missed_; }
  /// Prints the rows that miss their goals.
  void print() const {
    std::printf("rows below target: %zu\n", missed_.size());
    for (const auto& [row, value, goal] : missed_)
      std::printf("below %s %.2f, target %s %g\n", row.c_str(), value, goal->at_most ? "at most" : "at least",
                  goal->value);
  }

 private:
  void compare(std::string_view row, double value, const Goal& goal) {
    if (!(goal.at_most ? value <= goal.value : value >= goal.value))
      missed_.push_back({std::string(row), value, &goal});
  }

  std::vector<Missed> missed_;
};

}  // namespace hinge::bench
