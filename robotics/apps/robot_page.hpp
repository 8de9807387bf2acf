// SPDX-License-Identifier: BSD-3-Clause
// RobotPage: the HTML file of --report, with the robot, the bodies around it, its configurations and their collisions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answer.hpp"
#include "hinge/robotics/collision_matrix.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/report_choice.hpp"
#include "hinge_tools/report_page.hpp"
#include "options.hpp"
#include "report.hpp"

namespace robocd {

/// Returns what a page says about the command, the question and the files; without a verdict.
hinge::tool::ReportWords page_words(const Options& options, const Job& job);

/// Collects what the page shows. Does nothing without --report. Refers to the options, the job and the worker.
class RobotPage {
 public:
  /// mode: pairs to list; those of the modes any and closest are the colliding ones. is_path: the configurations follow
  /// each other in time, and all are shown. worker: the page sets its configuration. Throws LoadError if the file
  /// cannot be written.
  RobotPage(const Options& options, const Job& job, Worker& worker, const hinge::robotics::Mode& mode, bool is_path);

  /// True if --report is given.
  bool wanted() const noexcept { return file_.wanted(); }

  /// Takes a configuration into account, in the order of the run.
  void offer(std::uint64_t index, const Answer& answer);
  /// Returns the indices of the configurations to add: the worst of the offered ones, in the order of the run.
  std::vector<std::uint64_t> chosen() const;
  /// Adds a chosen configuration, in the order of chosen(). q: one value per independent joint, rad or m.
  void add(const std::string& name, const std::vector<double>& q);
  /// Offers and adds a configuration.
  void add_next(const std::string& name, const std::vector<double>& q);
  /// Shows what is known about each pair of links. words: by kind.
  void set_matrix(const hinge::robotics::CollisionMatrix& matrix, const std::vector<std::string>& words);

  /// Writes the file. state: "free", "collides" or "undecided"; verdict: one sentence. Throws LoadError if it cannot be
  /// written.
  void write(const char* state, const std::string& verdict);

 private:
  Json frame_json(const std::string& name, const std::vector<double>& q);
  /// Returns the place of a body on the page. Held bodies are behind the links, because they move; then come the
  /// others.
  std::size_t place_of(hinge::robotics::BodyId body) const;

  const Options& options_;
  const Job& job_;
  Worker& worker_;
  hinge::tool::CompleteFile file_;
  double margin_;  // m, pairs closer than the clearance and this are listed
  hinge::tool::ReportChoice choice_;
  bool is_path_;
  Json frames_ = Json::array();
  Json matrix_;
  std::vector<std::size_t> order_;  // places of job.bodies among the bodies of the page
};

/// A configuration on the straight path between two waypoints.
struct MotionStop {
  std::size_t segment;  // from waypoints[segment] to the next one
  double parameter;     // from 0 to 1 along that segment
  std::vector<double> configuration;
};

/// Adds configurations of the straight paths between the waypoints, about 200 in all, to the page. stop: a further
/// configuration to add, at its place.
void add_motion(RobotPage& page, const std::vector<std::vector<double>>& waypoints,
                const std::optional<MotionStop>& stop = {});

}  // namespace robocd
