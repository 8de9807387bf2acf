// SPDX-License-Identifier: BSD-3-Clause
// Options: the parsed command line of robocd. Job: the robot and the data loaded for it.
#pragma once

#include <cstdint>
#include <filesystem>
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
#include "hinge_tools/dial.hpp"
#include "hinge_tools/parts_folder.hpp"
#include "hinge_tools/rows.hpp"
#include "hinge_tools/run_tool.hpp"

namespace robocd {

using hinge::tool::Exit;
using hinge::tool::Output;

/// The options of all commands. Lengths in m, angles in rad.
struct Options {
  std::string urdf;
  std::string srdf;                          // empty: none
  std::vector<std::string> skip_pairs;       // files of pairs of links, or of a link and a body, that are not tested
  bool note_unknown_links = false;           // skip pairs with unknown links in the SRDF with a note
  bool reference_primitives = false;         // tessellate as in the published reference data
  std::vector<std::string> package_folders;  // for package://
  bool skip_missing_meshes = false;          // continue with an incomplete model
  std::vector<std::string> tiers;            // "TIER" for all links, "LINK=TIER" for one
  std::vector<std::pair<std::string, std::string>> proved_apart;  // links that never meet within the joint limits
  std::string made_for;               // digest of the model that proved_apart was found for; empty: not given
  std::vector<std::string> settings;  // files whose options the parser has added
  Output output = Output::table;
  std::optional<std::uint64_t> max_pairs;  // check, path: pairs printed per configuration, 0: all; empty: see
                                           // hinge::tool::pairs_to_print
  bool exit_zero = false;                  // check, path: status 0 whatever the verdict
  // check: source of the configurations, one of the four
  std::uint64_t count = 0;
  std::uint64_t seed = 1;
  std::string csv_in;
  std::vector<std::string> states;  // GROUP/NAME
  bool zero = false;
  // check: the question for each configuration
  std::string mode = "all";
  double clearance = 0.0;                                     // m
  std::vector<std::string> environment;                       // bodies, see bodies.hpp
  std::vector<std::pair<std::string, std::string>> allowed;   // a link and a body that may touch
  std::vector<std::pair<std::string, std::string>> attached;  // a link and a body that it holds
  std::string floating_base;                                  // "fixed" or "free"; empty: not given
  std::string engine = "simd";
  bool contained = false;  // closed meshes are solid
  unsigned threads = 1;
  hinge::tool::PartsOptions parts;  // check
  std::string merged;               // merge: folder of --parts
  // path
  std::string from, to;           // see path_end.hpp
  std::string waypoints;          // CSV file of configurations, instead of from and to
  std::optional<double> sampled;  // rad or m, test states at this distance; empty: certify
  double min_step = hinge::smallest_path_step;
  // relax: from, seed, out, and; plan: from, to, seed, out, and
  std::uint64_t tries = 20000;     // relax: largest number of configurations to test
  std::uint64_t motions = 100000;  // plan: largest number of motions to test
  std::optional<double> seconds;   // no test after this time
  std::optional<double> step;      // plan: rad or m, largest change between rows of `out`; empty: only waypoints
  // matrix
  hinge::robotics::MatrixOptions matrix;  // its clearance is replaced by `clearance` above
  bool disable_unseen = false;
  hinge::tool::DialOptions dial;
  std::string report;        // check, path, relax, plan, matrix, dial: HTML page to write; empty: none
  std::string command_line;  // as typed, for the page
  // check, relax, plan: CSV file of the configurations, empty: none; matrix: SRDF file, empty: standard output; demo:
  // SVG file
  std::string out;
};

/// The loaded robot, the bodies, and the pairs of links that are tested.
struct Job {
  std::shared_ptr<const hinge::robotics::Robot> robot;
  hinge::robotics::Srdf srdf;                                // without a file: nothing disabled
  std::vector<Body> bodies;                                  // of the environment
  std::vector<std::pair<std::string, std::string>> allowed;  // names of a link and a body that are not tested
  std::vector<std::string> notes;                            // one sentence each, for the user
  hinge::robotics::LinkPairs disabled;                       // by the SRDF and by files of pairs
  hinge::robotics::LinkPairs tested;
};

/// Returns the input files that the options name, without meshes.
std::vector<std::filesystem::path> input_files(const Options& options);

/// Throws ModelError if --parts does not fit the other options, or if --out or --report would overwrite an input of the
/// command, or is a directory or the file of standard output, or if --report has another extension than .html. Mesh
/// files are checked by load_robot(), which knows them.
void check_outputs(const Options& options);

/// Reads the robot. With --contained closed meshes become solid. `notes` receives the notes of the reader and the links
/// with open meshes. Throws LoadError (one line with file and element) for a bad file or another model than --made-for,
/// or ModelError if --floating-base is missing or "free".
std::shared_ptr<const hinge::robotics::Robot> load_robot(const Options& options, std::vector<std::string>& notes);
/// Reads the robot, the SRDF, the bodies and the pairs. Throws LoadError for bad files, ModelError for options that do
/// not fit the robot or each other.
Job load(const Options& options);

/// Returns a digest of the URDF file, its meshes, and the options on which proofs about pairs of links depend.
std::string model_digest(const Options& options, const hinge::robotics::RobotDescription& robot);

/// Prints job.notes on standard error.
void print_notes(const Job& job);

/// Returns the text to follow a verdict, " (incomplete model: ...)", or "" if the geometry is complete.
std::string incomplete(const hinge::robotics::Robot& robot);

/// Prints the same as a note on standard error, with the names of the links.
void print_incomplete(const hinge::robotics::Robot& robot);

Exit run_info(const Options& options);
Exit run_check(const Options& options);
Exit run_merge(const Options& options);
Exit run_matrix(const Options& options);
Exit run_path(const Options& options);
Exit run_relax(const Options& options);
Exit run_plan(const Options& options);
Exit run_dial(const Options& options);
Exit run_demo(const Options& options);

}  // namespace robocd
