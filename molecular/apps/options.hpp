// SPDX-License-Identifier: BSD-3-Clause
// The options of the biocd command line after parsing, and the molecule they load.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/ensemble_groups.hpp"
#include "hinge/molecular/kept_closures.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/torsion_prior.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge_tools/dial.hpp"
#include "hinge_tools/parts_folder.hpp"
#include "hinge_tools/rows.hpp"
#include "hinge_tools/run_tool.hpp"

namespace biocd {

using hinge::tool::Exit;
using hinge::tool::Output;

inline constexpr double degree = std::numbers::pi / 180.0;  // rad per degree

/// Program that --view writes a script for.
enum class Viewer : std::uint8_t { chimerax, pymol };

/// What a table of clashes counts by.
enum class By : std::uint8_t { residue, chain };

/// The values of the command line. Each option belongs to all commands with a molecule unless a command is named.
struct Options {
  std::string file;                                          ///< FILE
  std::vector<std::string> with;                             ///< further files
  std::vector<std::string> place;                            ///< "PART" or "PART=DISTANCE,DEGREES"
  std::vector<std::pair<std::string, std::string>> between;  ///< pairs of parts
  std::vector<std::string> inside;                           ///< parts
  std::vector<std::string> trajectories;                     ///< check: files of conformations
  hinge::molecular::ReadOptions read;                        ///< how to read files
  hinge::molecular::CheckOptions check;                      ///< rules of a check
  std::string free = "all";                                  ///< selection of free torsions
  bool free_by_loop = false;                                 ///< --loop chose `free`
  bool omega = false;                                        ///< free omega too
  std::string loop;                                          ///< residues of loops; empty: none
  bool keep_hydrogen_bonds = false;                          ///< backbone hydrogen bonds are closures
  std::vector<std::string> rigid_from;      ///< conformations whose rigid groups stay rigid; empty: none
  double rigid_tolerance = 0.5;             ///< angstrom
  std::optional<bool> keep_closures;        ///< true: close all cycles; false: only loops; nothing: close none
  bool draws = false;                       ///< sample: conformations are drawn at random
  bool collision_free = false;              ///< sample: only conformations that do not collide
  std::optional<std::uint64_t> most_tries;  ///< sample: starts for each conformation; relax: restarts; plan: motions
  std::optional<hinge::molecular::Prior> prior;  ///< sample: nothing: by sigma_degrees
  std::optional<double> seconds;                 ///< sample: no start after this time; relax, plan: the end
  std::string mode = "all";                      ///< check, sample: text of Mode::parse
  Output output = Output::table;                 ///< format of standard output
  std::optional<std::uint64_t> max_pairs;       ///< pairs printed per conformation, 0: all; nothing: see pairs_to_print
  std::optional<By> by;                         ///< check: a table of clashes over all conformations
  std::optional<Viewer> view;                   ///< write a viewer script (all but info, merge, demo)
  bool exit_zero = false;                       ///< status 0 whatever the verdict
  std::string explain;                          ///< "i,j"; empty: explain nothing
  bool atoms = false;                           ///< info: list atoms, bonds and thresholds too
  std::uint64_t count = 1000;                   ///< sample, demo: number of conformations
  std::uint64_t seed = 1;                       ///< sample, walk, relax, plan, demo
  std::optional<double> sigma_degrees;          ///< sample: standard deviation of a torsion; nothing: full range
  unsigned threads = 1;                         ///< check, sample: worker threads
  std::string out;                              ///< file of conformations; demo: folder
  std::string report;                           ///< HTML page to write (all but info, merge, demo); empty: none
  std::string command_line;                     ///< as typed, for the page
  bool torsions = false;                        ///< sample: rows contain the torsions
  std::string torsions_out;                     ///< sample: .npy file of the torsions
  bool only_free = false;                       ///< check, sample: `out` gets only conformations that do not collide
  hinge::tool::PartsOptions parts;              ///< check, sample
  std::string merged;                           ///< merge: folder of --parts
  std::uint64_t steps = 10000;                  ///< walk: moves to try
  double step_degrees = 3.0;                    ///< walk: standard deviation of a torsion's change
  std::uint64_t changes = 1;                    ///< walk: torsions per move
  std::uint64_t every = 100;                    ///< walk: steps from one written conformation to the next
  std::string from, to;                         ///< path, plan: ends, see path_end.hpp
  double frame_step = 5.0;                      ///< plan: largest turn between two written conformations, degrees
  std::optional<double> sampled_degrees;        ///< path: largest distance between sampled states; nothing: certify
  double min_step = hinge::smallest_path_step;  ///< path: intervals up to this share of the path are not split
  hinge::tool::DialOptions dial;                ///< dial
  bool uniform = false;                         ///< dial: the full range instead of sigma_degrees
  std::vector<std::string> settings;            ///< files whose options the parser has added
};

/// Returns the sampling that the options ask for.
inline hinge::molecular::Sampling sampling_of(const Options& options) {
  hinge::molecular::Sampling sampling{options.seed, {}};
  if (options.sigma_degrees) sampling.sigma = *options.sigma_degrees * degree;
  return sampling;
}

/// A molecule with its selection and rules, ready for queries.
struct Job {
  std::shared_ptr<const hinge::molecular::Molecule> molecule;  ///< all files joined
  hinge::molecular::Checker checker;                           ///< template for the checkers of threads: copy it
  hinge::molecular::SelectedTorsions selected;                 // torsions that --free selects
  hinge::molecular::KeptClosures kept;                         // closures to keep, and torsions that they hold fixed
  std::vector<hinge::molecular::PlacementRange> ranges;        // one per placed part
  std::optional<hinge::molecular::EnsembleGroups> ensemble{};  // rigid groups of --rigid-from
};

/// Reads the files and builds the molecule and the checker. Throws LoadError for bad files, ModelError for bad options.
Job load(const Options& options);

/// Throws ModelError if nothing is free.
void require_free_torsions(const Options& options, const Job& job);

/// The files that demo may write into its folder.
inline constexpr const char* demo_files[] = {"speed.svg", "tail.svg",  "worst.pdb",
                                             "worst.cif", "worst.cxc", "worst.pml"};

/// Returns the input files that the options name.
std::vector<std::filesystem::path> input_files(const Options& options);

/// Throws ModelError if --out, --torsions-out, --view or --report has another format than expected, or would overwrite
/// an input, a directory, the file of the results or each other. is_folder: --out names demo's folder.
void check_outputs(const Options& options, bool is_folder);

/// Each of these runs one command and returns its exit status. Throw LoadError for bad input, ModelError for bad
/// options.
Exit run_info(const Options& options);
Exit run_check(const Options& options);
Exit run_sample(const Options& options);
Exit run_walk(const Options& options);
Exit run_relax(const Options& options);
Exit run_merge(const Options& options);
Exit run_path(const Options& options);
Exit run_plan(const Options& options);
Exit run_dial(const Options& options);
Exit run_demo(const Options& options);

/// Prints which rule keeps or drops the pair of options.explain.
void explain(const Options& options, const Job& job);

}  // namespace biocd
