// SPDX-License-Identifier: BSD-3-Clause
// biocd: self-collision of molecules on the command line. This file is the command line itself.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/components.hpp"
#include "hinge/simd/instruction_set.hpp"
#include "hinge/tool/number_option.hpp"
#include "hinge/tool/pick_instruction_set.hpp"
#include "hinge/tool/run_tool.hpp"
#include "hinge/version.hpp"
#include "options.hpp"
#include "results.hpp"

namespace {

using biocd::Exit;
using biocd::Options;
using hinge::tool::add_number;
using hinge::tool::NumberRange;
using Reals = NumberRange<double>;

constexpr NumberRange<std::uint64_t> counts{1, std::uint64_t{1} << 53};
constexpr NumberRange<std::uint64_t> seeds{0, UINT64_MAX};
constexpr Reals lengths_above_0{0.0, hinge::tool::largest_length, true};  // angstrom, or degrees
using hinge::molecular::BondSearch;

constexpr const char* footer =
    "Exit status: 0 free, 1 collision found, 2 usage, 3 bad input, 4 undecided (path).\n"
    "Selections (--free): all none loops every:N count:K backbone chi ligands, a torsion's name (phi psi omega "
    "chi1...,\n"
    "alpha beta gamma epsilon zeta chi kappa), a chain A, A:45, A:10-20, A:HEM, file:2, A:45:chi1, A:10-20:phi,psi, "
    "A:chi,\n"
    "a ligand's bond B:401:C5-C6; joined by ',' or 'or', and, not, parentheses: 'A and not (A:10-20 or omega)'.\n"
    "omega stays at its reference unless --omega is given or it is named.\n"
    "Parts (--place, --between, --inside): a chain (A), a ligand (KNI), residues (A:10-20), a file (file:2), joined in "
    "the\n"
    "same way; '+' is ',' here and there.";

void add_model_options(CLI::App& command, Options& o) {
  command.add_option("FILE", o.file, "PDB or mmCIF file, plain or .gz")->required();
  command.add_option("--with", o.with, "one more file beside FILE, kept whole but for its waters (repeatable)")
      ->allow_extra_args(false);
  CLI::Option* free = command.add_option("--free", o.free, "torsions that are free (with --loop: side chains only)")
                          ->capture_default_str();
  command.add_option("--loop", o.loop, "loops A:40-52,...: free with both ends held, all else stands still");
  command.parse_complete_callback([&o, free] {
    if (!o.loop.empty() && free->count() == 0) o.free = "none";
  });
  command.add_flag("--keep-hbonds", o.keep_hydrogen_bonds,
                   "hydrogen bonds of the backbone (Kabsch & Sander) are closures");
  command
      .add_option(
          "--rigid-from", o.rigid_from,
          "conformations (DCD, XTC, .npy, PDB, mmCIF): torsions inside groups that these keep rigid stay at their "
          "reference (repeatable)")
      ->allow_extra_args(false);
  add_number(command, "--rigid-tolerance", o.rigid_tolerance, lengths_above_0,
             "by how much distances inside a rigid group may vary: standard deviation, angstrom");
  command
      .add_option("--place", o.place,
                  "PART[=DISTANCE[,DEGREES]]: a chain, ligand or file that moves and turns as one against the rest, in "
                  "samples by up to so many angstrom and degrees (default 10,180; repeatable)")
      ->allow_extra_args(false);
  command.add_option("--between", o.between, "PART PART: only pairs of an atom of each count ('rest': of all others)");
  command.add_option("--inside", o.inside, "PART: only pairs inside it count, and those of --between (repeatable)")
      ->allow_extra_args(false);
  command.add_flag("--omega", o.omega, "free omega too");
  command
      .add_option("--rules", o.check.thresholds.rules,
                  "what a clash is: biocd (the next five options), severe, molprobity, chimerax, posebusters; auto: "
                  "severe for a structure with hydrogens unless one of these options is given, else biocd")
      ->capture_default_str();
  command.add_option("--radii", o.check.thresholds.radii, "radii set: bondi (default), probe, probe-united, amber");
  add_number(command, "--rho", o.check.thresholds.rho, Reals{0.0, 1000.0, true},
             "M = rho * (sum of radii) (default: 0.8)");
  add_number(command, "--min-bonds", o.check.min_bonds, NumberRange<int>{1, 1000},
             "pairs count from this bond distance on (default: the radii set's, 4 for bondi)");
  command
      .add_option_function<std::string>(
          "--hbond",
          [&o](const std::string& text) {
            if (text != "auto") o.check.thresholds.hydrogen_bonds = text == "on";
          },
          "hydrogen-bond rule: auto (on with hydrogens), on, off")
      ->check(CLI::IsMember({"auto", "on", "off"}));
  add_number(command, "--hbond-allowance", o.check.thresholds.hydrogen_bond_allowance, Reals{0.0, 1000.0},
             "taken from M(polar H, acceptor), angstrom (default: 0.4)");
  command
      .add_option_function<std::string>(
          "--hydrogens", [&o](const std::string& text) { o.read.keep_hydrogens = text == "keep"; },
          "hydrogens of the file: keep (default) or drop")
      ->check(CLI::IsMember({"keep", "drop"}));
  add_number(command, "--model", o.read.model, NumberRange<int>{-99999999, 99999999}, "number of the model to use");
  command.add_option_function<std::string>(
      "--altloc",
      [&o](const std::string& text) {
        if (text.size() != 1) throw CLI::ValidationError("--altloc", "one character expected");
        o.read.altloc = text.front();
      },
      "alternative location to use (default: the one of the highest summed occupancy); residues without it take their "
      "own "
      "best");
  command
      .add_option_function<std::string>(
          "--hetero",
          [&o](const std::string& word) {
            o.read.hetero = word != "none";
            o.read.waters = word == "waters";
          },
          "keep ligands (and ions and sugars; the same as --hetero alone), or waters too, or none (default)")
      ->check(CLI::IsMember({"none", "ligands", "waters"}));
  command
      .add_option("--components", o.read.components,
                  "CIF file with chemical components: bonds of residues by name (may be given more than once)")
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--dictionary", [&o](const std::string& text) { o.read.dictionary = text == "none" ? std::string() : text; },
          "folder of a monomer dictionary, or none (default: $CLIBD_MON, else Debian's refmac-dictionary)")
      ->default_str(o.read.dictionary.string());
  command
      .add_option_function<std::string>(
          "--bonds",
          [&o](const std::string& text) {
            o.read.bonds = text == "recorded" ? BondSearch::recorded : BondSearch::geometry;
          },
          "bonds between residues that no polymer makes: geometry (default: recorded ones, and by distance where "
          "valences and angles allow) or recorded")
      ->check(CLI::IsMember({"recorded", "geometry"}));
  CLI::Option* exempt =
      command.add_flag("--exempt-reference", o.check.exempt_reference,
                       "pairs that collide in the file's (first) model do not count, but for those of "
                       "two files, or of a placed part and the rest");
  command.add_flag("--exempt-interfaces", o.check.exempt_interfaces, "nor do these")->needs(exempt);
  command.add_option("--engine", o.check.engine, "wide, lazy (the paper's) or brute")->capture_default_str();
  command.add_option("--explain", o.explain, "say which rule keeps or drops the pair of atoms i,j (numbers from 0)");
}

void add_json_option(CLI::App& command, Options& o) {
  command.add_flag_callback(
      "--json", [&o] { o.output = biocd::Output::json; }, "JSON on standard output");
}

/// What check and sample share beyond the model.
void add_check_options(CLI::App& command, Options& o) {
  add_json_option(command, o);
  command
      .add_flag_callback(
          "--csv", [&o] { o.output = biocd::Output::csv; }, "CSV on standard output")
      ->excludes("--json");
  command
      .add_option_function<std::string>(
          "--mode",
          [&o](const std::string& text) {
            if (hinge::Mode::parse(text, "angstrom").margin > hinge::tool::largest_length)
              throw hinge::ModelError("--mode '" + text + "': expected D in angstrom, at most 1e+09");
            o.mode = text;
          },
          "any, all, within:D (angstrom) or closest")
      ->default_str(o.mode);
  command.add_option("--out", o.out, "write the conformations to this .pdb, .cif, .dcd or .npy file");
  command
      .add_option_function<std::string>(
          "--filter", [&o](const std::string& text) { o.only_free = text == "free"; },
          "conformations that --out gets: all (default) or free")
      ->check(CLI::IsMember({"all", "free"}))
      ->needs("--out");
  command.add_option_function<std::string>(
      "--shard", [&o](const std::string& text) { o.shard = biocd::parse_shard(text); },
      "i/n: part i of n (from 1), for biocd merge; with --json or --csv");
  add_number(command, "--threads", o.threads, NumberRange<unsigned>{1, 1024},
             "worker threads; the output does not depend on them");
}

void add_closures_option(CLI::App& command, Options& o) {
  command
      .add_option_function<std::string>(
          "--closures", [&o](const std::string& text) { o.keep_closures = text == "keep"; },
          "cycles through disulphides and other bonds: keep (default) or open; loops are always kept")
      ->check(CLI::IsMember({"open", "keep"}));
}

void add_path_options(CLI::App& command, Options& o) {
  add_json_option(command, o);
  constexpr const char* end =
      "reference, model:N (its torsions), @FILE or a list of turns from the reference, degrees, comma separated, one "
      "per DOF";
  command.add_option("--from", o.from, end)->required();
  command.add_option("--to", o.to, end)->required();
  CLI::Option* sampled = add_number(command, "--sampled", o.sampled_degrees, lengths_above_0,
                                    "look at states at most so many degrees apart (default: certify every state)");
  add_number(command, "--min-step", o.min_step, Reals{0.0, 1.0, true},
             "stretches no longer than this share of the path are not cut any more")
      ->excludes(sampled);
}

/// Arguments with a value behind each --hetero, which needs none: it stands for --hetero ligands.
std::vector<std::string> with_hetero_words(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    if (arguments[k] != "--hetero") continue;
    const std::string next = k + 1 < arguments.size() ? arguments[k + 1] : "";
    if (next != "none" && next != "ligands" && next != "waters") arguments[k] = "--hetero=ligands";
  }
  return arguments;
}

Exit run(int argc, char** argv) {
  Options o;
  o.read.dictionary = hinge::molecular::installed_dictionary();
  std::function<Exit(const Options&)> command;
  CLI::App app{"biocd: self-collision of proteins and other molecules as articulated mechanisms"};
  app.footer(footer);
  app.set_version_flag(
      "--version", fmt::format("biocd {} ({})", hinge::version_string, hinge::simd::name(hinge::simd::compiled_for())));
  app.require_subcommand(1);

  CLI::App* info = app.add_subcommand("info", "what the file holds, its degrees of freedom and rigid groups");
  add_model_options(*info, o);
  add_json_option(*info, o);
  info->add_flag("--atoms", o.atoms, "list atoms, bonds, thresholds and constant contacts (with --json)");
  info->callback([&] { command = biocd::run_info; });

  CLI::App* check = app.add_subcommand("check", "verdict and pairs for each model of the file, or frame");
  add_model_options(*check, o);
  add_check_options(*check, o);
  check->add_option("TRAJECTORY", o.trajectories,
                    "conformations instead of the file's own: DCD, XTC, .npy, PDB, mmCIF");
  check->callback([&] { command = biocd::run_check; });

  CLI::App* sample = app.add_subcommand("sample", "random conformations of the free torsions, each checked");
  add_model_options(*sample, o);
  add_check_options(*sample, o);
  add_number(*sample, "-n,--count", o.count, counts, "number of conformations");
  add_number(*sample, "--seed", o.seed, seeds, "seed; conformation k is a function of (seed, k) alone");
  add_number(*sample, "--sigma", o.sigma_degrees, lengths_above_0,
             "Gaussian about the reference, degrees (default: full range)");
  add_closures_option(*sample, o);
  sample->add_flag("--collision-free", o.collision_free, "only conformations that do not collide");
  add_number(*sample, "--tries", o.most_tries, counts,
             "starts for each conformation at most, where cycles are closed or --collision-free");
  sample->add_flag("--torsions", o.torsions,
                   "rows of --json and --csv say every free torsion (degrees) and placement as drawn");
  sample->add_option("--torsions-out", o.torsions_out,
                     "write them to this .npy file: samples x DOF, 64-bit floats, in the order of `dofs` in --json");
  sample->callback([&] {
    o.keep_closures = o.keep_closures.value_or(true);
    o.draws = true;
    command = biocd::run_sample;
  });

  CLI::App* walk = app.add_subcommand("walk", "Monte Carlo walk of collision-free moves from the file's conformation");
  add_model_options(*walk, o);
  add_json_option(*walk, o);
  add_number(*walk, "--steps", o.steps, counts, "moves to try");
  add_number(*walk, "--step-size", o.step_degrees, lengths_above_0,
             "standard deviation of a torsion's change, degrees");
  add_number(*walk, "--changes", o.changes, counts, "torsions that a move changes");
  add_number(*walk, "--seed", o.seed, seeds, "seed; a walk is a function of it, the file and the options alone");
  walk->add_option("--out", o.out, "write conformations to this .pdb, .cif, .dcd or .npy file");
  add_number(*walk, "--every", o.every, counts, "steps from one conformation written to the next");
  add_closures_option(*walk, o);
  walk->callback([&] {
    o.keep_closures = o.keep_closures.value_or(true);
    command = biocd::run_walk;
  });

  CLI::App* merge = app.add_subcommand("merge", "joins the outputs of all shards of one run");
  merge->add_option("FILES", o.shards, "what --shard 1/n ... n/n printed")->required();
  merge->callback([&] { command = biocd::run_merge; });

  CLI::App* path =
      app.add_subcommand("path", "is the straight path between two conformations free? Proved, or sampled");
  add_model_options(*path, o);
  path->remove_option(path->get_option("--engine"));  // one engine proves
  add_path_options(*path, o);
  path->callback([&] { command = biocd::run_path; });

  CLI::App* demo = app.add_subcommand("demo", "the main job on one protein: sample, time, verify, draw");
  demo->add_option("FILE", o.file, "PDB or mmCIF file")->required();
  demo->add_option("--out", o.out, "folder for the plot and the viewer scripts")->required();
  add_number(*demo, "-n,--count", o.count, counts, "conformations per row");
  add_number(*demo, "--seed", o.seed, seeds, "seed");
  demo->callback([&] { command = biocd::run_demo; });

  try {
    app.name(argv[0]);
    std::vector<std::string> arguments = with_hetero_words(argc, argv);
    std::reverse(arguments.begin(), arguments.end());  // as the parser takes them
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error) == 0 ? Exit::free : Exit::usage;  // --help, --version
    throw hinge::ModelError(std::string(error.what()) + "; --help says more");
  }
  biocd::check_outputs(o, demo->parsed());
  return command(o);
}

}  // namespace

extern const char hinge_build_id[];  // made by the build: .cmake/write_build_id.cmake

int main(int argc, char** argv) {
  return hinge::tool::run_tool("biocd", [&] {
    hinge::tool::pick_instruction_set(argv, hinge_build_id);
    return run(argc, argv);
  });
}
