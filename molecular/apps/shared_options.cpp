// SPDX-License-Identifier: BSD-3-Clause
// Adds the options with their ranges, defaults and help texts.
#include "shared_options.hpp"

#include <string>

#include "hinge/core/error.hpp"
#include "results.hpp"

namespace biocd {

using hinge::molecular::BondSearch;
using hinge::tool::add_number;
using hinge::tool::NumberRange;
using Reals = NumberRange<double>;

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
      .add_option("--rigid-from", o.rigid_from,
                  "conformations (DCD, XTC, .npy, PDB, mmCIF, plain or .gz): torsions inside groups that these keep "
                  "rigid stay at their reference (repeatable)")
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
  command.add_option("--engine", o.check.engine, "simd, lazy (the paper's) or brute")->capture_default_str();
  command.add_option("--explain", o.explain, "say which rule keeps or drops the pair of atoms i,j (numbers from 0)");
}

void add_json_option(CLI::App& command, Options& o) {
  command.add_flag_callback(
      "--json", [&o] { o.output = Output::json; }, "JSON on standard output");
}

void add_check_options(CLI::App& command, Options& o) {
  add_json_option(command, o);
  command
      .add_flag_callback(
          "--csv", [&o] { o.output = Output::csv; }, "CSV on standard output")
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
      "--shard", [&o](const std::string& text) { o.shard = parse_shard(text); },
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

}  // namespace biocd
