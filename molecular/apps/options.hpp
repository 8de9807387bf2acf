// SPDX-License-Identifier: BSD-3-Clause
// What the biocd command line asks for, after parsing, and the molecule it is about.
#pragma once

#include <cstdint>
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
#include "hinge/path/path_answer.hpp"
#include "hinge_tools/run_tool.hpp"

namespace biocd {

using hinge::tool::Exit;

inline constexpr double degree = std::numbers::pi / 180.0;  // rad

enum class Output : std::uint8_t { table, json, csv };

/// Part `index` of `of`, from 1.
struct Shard {
  std::uint64_t index = 1;
  std::uint64_t of = 1;
};

struct Options {
  std::string file;
  std::vector<std::string> with;                             // further files
  std::vector<std::string> place;                            // "PART" or "PART=DISTANCE,DEGREES"
  std::vector<std::pair<std::string, std::string>> between;  // parts
  std::vector<std::string> inside;                           // parts
  std::vector<std::string> trajectories;                     // check: files of conformations
  hinge::molecular::ReadOptions read;
  hinge::molecular::CheckOptions check;
  std::string free = "all";
  bool omega = false;
  std::string loop;  // residues of loops; empty: none
  bool keep_hydrogen_bonds = false;
  std::vector<std::string> rigid_from;  // conformations whose rigid groups stay rigid; empty: none
  double rigid_tolerance = 0.5;         // angstrom
  std::optional<bool> keep_closures;    // sample, walk: of all cycles, or of loops alone; none: nothing is closed
  bool draws = false;                   // sample: conformations are drawn at random
  bool collision_free = false;          // sample: only those that do not collide
  std::uint64_t most_tries = 100;       // sample: starts for each closed conformation
  std::string mode = "all";
  Output output = Output::table;
  std::string explain;         // "i,j"; empty: nothing to explain
  bool atoms = false;          // info: list atoms, bonds and thresholds too
  std::uint64_t count = 1000;  // sample: number of conformations
  std::uint64_t seed = 1;
  std::optional<double> sigma_degrees;
  unsigned threads = 1;
  std::string out;                    // check, sample, walk: conformations, by extension
  bool torsions = false;              // sample: rows say the torsions
  std::string torsions_out;           // sample: .npy file of them
  bool only_free = false;             // check, sample: `out` gets those that do not collide
  std::optional<Shard> shard;         // check, sample
  std::vector<std::string> shards{};  // merge
  std::uint64_t steps = 10000;        // walk
  double step_degrees = 3.0;
  std::uint64_t changes = 1;  // torsions per step
  std::uint64_t every = 100;  // steps from one conformation written to the next
  // path
  std::string from, to;                   // see path_end.hpp
  std::optional<double> sampled_degrees;  // look at states this far apart; none: certify
  double min_step = hinge::smallest_path_step;
};

inline hinge::molecular::Sampling sampling_of(const Options& options) {
  hinge::molecular::Sampling sampling{options.seed, {}};
  if (options.sigma_degrees) sampling.sigma = *options.sigma_degrees * degree;
  return sampling;
}

/// A file read, with its selection and rules, ready to be asked.
struct Job {
  std::shared_ptr<const hinge::molecular::Molecule> molecule;
  hinge::molecular::Checker checker;
  hinge::molecular::SelectedTorsions selected;                 // by --free
  hinge::molecular::KeptClosures kept;                         // closed cycles, and torsions selected that they hold
  std::vector<hinge::molecular::PlacementRange> ranges;        // per placed part
  std::optional<hinge::molecular::EnsembleGroups> ensemble{};  // of --rigid-from
};

Job load(const Options& options);

/// What demo writes into its folder.
inline constexpr const char* demo_files[] = {"speed.svg", "worst.pdb", "worst.cxc", "worst.pml"};

/// ModelError: --out would write over an input of the command, a directory or the file that the results go to.
/// is_folder: it names demo's folder.
void check_outputs(const Options& options, bool is_folder);

Exit run_info(const Options& options);
Exit run_check(const Options& options);
Exit run_sample(const Options& options);
Exit run_walk(const Options& options);
Exit run_merge(const Options& options);
Exit run_path(const Options& options);
Exit run_demo(const Options& options);

/// Prints which rule kept or dropped the pair named by options.explain.
void explain(const Options& options, const Job& job);

}  // namespace biocd
