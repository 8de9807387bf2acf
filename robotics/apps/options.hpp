// SPDX-License-Identifier: BSD-3-Clause
// What the robocd command line asks for, after parsing, and the robot it is about.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bodies.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/read_srdf.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge_tools/run_tool.hpp"

namespace robocd {

using hinge::tool::Exit;

enum class Output : std::uint8_t { table, json, csv };

struct Options {
  std::string urdf;
  std::string srdf;                          // empty: none
  std::vector<std::string> skip_pairs;       // files of pairs of links, or of a link and a body, that are not tested
  bool note_unknown_links = false;           // in the SRDF, instead of refusing them
  bool reference_primitives = false;         // tessellated as the published reference data is
  std::vector<std::string> package_folders;  // for package://
  bool skip_missing_meshes = false;          // and go on with an incomplete model
  Output output = Output::table;
  // check: which configurations; one of the four
  std::uint64_t count = 0;
  std::uint64_t seed = 1;
  std::string csv_in;
  std::vector<std::string> states;  // GROUP/NAME
  bool zero = false;
  // check: what is asked of each
  std::string mode = "all";
  double clearance = 0.0;                                    // m
  std::vector<std::string> environment;                      // bodies, see bodies.hpp
  std::vector<std::pair<std::string, std::string>> allowed;  // a link and a body that may touch
  std::string floating_base;                                 // fixed or free; empty: not said
  std::string engine = "simd";
  bool contained = false;  // closed meshes are solid
  unsigned threads = 1;
  // path
  std::string from, to;           // see path_end.hpp
  std::string waypoints;          // CSV file of configurations instead of the two
  std::optional<double> sampled;  // rad or m, look at states this far apart; none: certify
  double min_step = hinge::smallest_path_step;
  // matrix
  hinge::robotics::MatrixOptions matrix;  // its clearance is the one above
  bool disable_unseen = false;
  // check: CSV file of the configurations, empty: none; matrix: SRDF file, empty: standard output
  std::string out;
};

/// A robot read, and the pairs of its links that are tested.
struct Job {
  std::shared_ptr<const hinge::robotics::Robot> robot;
  hinge::robotics::Srdf srdf;                                // without a file: nothing disabled
  std::vector<Body> bodies;                                  // of the environment
  std::vector<std::pair<std::string, std::string>> allowed;  // a link and a body, by name, that are not tested
  std::vector<std::string> notes;                            // what the user should know, a sentence each
  hinge::robotics::LinkPairs disabled;                       // by the SRDF and by files of pairs
  hinge::robotics::LinkPairs tested;
};

/// ModelError: --out would write over an input of the command, a directory or the file that the results go to. Meshes
/// are known once the robot is: load_robot looks at them.
void check_outputs(const Options& options);

/// With --contained closed meshes are made solid. `notes` gets what the reader says and the links whose meshes are
/// open. LoadError: one line naming file and element. ModelError: --floating-base is missing, or free.
std::shared_ptr<const hinge::robotics::Robot> load_robot(const Options& options, std::vector<std::string>& notes);
/// ModelError: options that do not fit the robot or each other.
Job load(const Options& options);

/// job.notes, on standard error.
void print_notes(const Job& job);

/// To go behind a verdict: " (incomplete model: ...)", empty when the geometry is whole.
std::string incomplete(const hinge::robotics::Robot& robot);

/// The same as a note at the end of the run, with the names of the links.
void print_incomplete(const hinge::robotics::Robot& robot);

Exit run_info(const Options& options);
Exit run_check(const Options& options);
Exit run_matrix(const Options& options);
Exit run_path(const Options& options);

}  // namespace robocd
