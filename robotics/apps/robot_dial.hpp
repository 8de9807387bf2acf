// SPDX-License-Identifier: BSD-3-Clause
// RobotDial: measures the choices of robocd dial and finds a recommendation.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "answer.hpp"
#include "dial_choices.hpp"
#include "dial_scene.hpp"
#include "hinge_tools/dial_report.hpp"
#include "options.hpp"

namespace robocd {

class RobotDial {
 public:
  /// Refers to both arguments. Throws as make_worker().
  RobotDial(const Options& options, Job& job);

  /// Measures for about options.dial_seconds.
  hinge::tool::DialReport run();

  /// Returns the worker of the reference.
  Worker& worker() { return worker_; }
  /// Returns the recommended options, one with its values per line. Empty before run(), and if there are none.
  const std::vector<std::string>& settings() const { return settings_; }

 private:
  /// A choice of shapes, pairs and threads, which can be combined.
  struct Selected {
    std::vector<hinge::robotics::Tier> tiers;  // by link of the description
    bool leaves_out = false;                   // without the pairs proved apart
    unsigned threads = 1;
  };

  /// Returns configurations of a seed, or the rows of --csv-in.
  std::shared_ptr<Questions> questions(std::uint64_t drawn_from) const;
  hinge::tool::DialEffort effort(double share) const;
  Worker worker_of(const Selected& selected) const;
  bool is_exact(const Selected& selected) const;
  hinge::tool::Sound sound_of(const Selected& selected) const;
  std::vector<std::string> lines_of(const Selected& selected) const;
  std::string sentence(const Selected& selected, const hinge::tool::DialRow& row) const;

  /// Configurations of a file may be outside the limits, where proofs about pairs do not hold.
  void leave_out_proofs_outside_limits();
  void add(const char* kind, std::string name, const Selected& selected);
  void add_engines();
  void add_tiers();
  void add_fewer_pairs_and_threads();
  void note_sufficient_tiers();
  void recommend();
  /// Measures a candidate on fresh configurations. Returns true if it keeps the limits and wins time.
  bool try_advice(const Selected& selected, double share);

  const Options& options_;
  Job& job_;
  Worker worker_;
  LinkShapes shapes_;
  RobotScene scene_;
  std::shared_ptr<Questions> questions_;
  hinge::tool::DialSection section_;
  std::vector<std::string> section_notes_;    // choices that were not measured
  std::map<std::string, Selected> selected_;  // by the name of the choice
  std::vector<std::string> settings_;
  hinge::tool::DialReport report_;
};

}  // namespace robocd
