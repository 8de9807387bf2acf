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
  command
      .add_option("--with", o.with, "one more file in addition to FILE; all of it is kept except waters (repeatable)")
      ->allow_extra_args(false);
  CLI::Option* free = command.add_option("--free", o.free, "torsions that are free (with --loop: only side chains)")
                          ->capture_default_str();
  command.add_option("--loop", o.loop,
                     "loops A:40-52,...: free between two fixed ends; everything outside the loops is fixed");
  command.parse_complete_callback([&o, free] {
    if (!o.loop.empty() && free->count() == 0) o.free = "none";
  });
  command.add_flag("--keep-hbonds", o.keep_hydrogen_bonds,
                   "treat hydrogen bonds of the backbone (Kabsch & Sander) as closures");
  command
      .add_option(
          "--rigid-from", o.rigid_from,
          "conformations (DCD, XTC, .npy, PDB, mmCIF, plain or .gz) from which rigid groups are found; torsions "
          "inside a rigid group stay at their reference (repeatable)")
      ->allow_extra_args(false);
  add_number(command, "--rigid-tolerance", o.rigid_tolerance, lengths_above_0,
             "largest standard deviation of a distance inside a rigid group, angstrom");
  command
      .add_option(
          "--place", o.place,
          "PART[=DISTANCE[,DEGREES]]: a chain, ligand or file that moves as one body relative to the rest; samples "
          "move it by at most DISTANCE angstrom and DEGREES (default 10,180; repeatable)")
      ->allow_extra_args(false);
  command.add_option("--between", o.between,
                     "PART PART: test only pairs of one atom from each part ('rest': all other atoms)");
  command
      .add_option("--inside", o.inside,
                  "PART: test only pairs inside this part, in addition to the pairs of --between (repeatable)")
      ->allow_extra_args(false);
  command.add_flag("--omega", o.omega, "free omega, too");
  command
      .add_option(
          "--rules", o.check.thresholds.rules,
          "definition of a clash: biocd (set by the next five options), severe, molprobity, chimerax, posebusters "
          "or auto (severe for a structure with hydrogens if none of the five options is given, otherwise biocd)")
      ->capture_default_str();
  command.add_option("--radii", o.check.thresholds.radii, "radii set: bondi (default), probe, probe-united, amber");
  add_number(command, "--rho", o.check.thresholds.rho, Reals{0.0, 1000.0, true},
             "M = rho * (sum of radii) (default: 0.8)");
  add_number(command, "--min-bonds", o.check.min_bonds, NumberRange<int>{1, 1000},
             "smallest number of bonds between the atoms of a tested pair (default: set by --radii, 4 for bondi)");
  command
      .add_option_function<std::string>(
          "--hbond",
          [&o](const std::string& text) {
            if (text != "auto") o.check.thresholds.hydrogen_bonds = text == "on";
          },
          "hydrogen-bond rule: auto (on with hydrogens), on, off")
      ->check(CLI::IsMember({"auto", "on", "off"}));
  add_number(command, "--hbond-allowance", o.check.thresholds.hydrogen_bond_allowance, Reals{0.0, 1000.0},
             "length subtracted from M(polar H, acceptor), angstrom (default: 0.4)");
  command
      .add_option_function<std::string>(
          "--hydrogens", [&o](const std::string& text) { o.read.keep_hydrogens = text == "keep"; },
          "hydrogens of the file: keep (default) or drop")
      ->check(CLI::IsMember({"keep", "drop"}));
  add_number(command, "--model", o.read.model, NumberRange<int>{-99999999, 99999999}, "number of the model to use");
  command.add_option_function<std::string>(
      "--altloc",
      [&o](const std::string& text) {
        if (text.size() != 1) throw CLI::ValidationError("--altloc", "expected one character");
        o.read.altloc = text.front();
      },
      "alternative location to use (default: the location of highest summed occupancy); residues without it use "
      "their own location of highest occupancy");
  command
      .add_option_function<std::string>(
          "--hetero",
          [&o](const std::string& word) {
            o.read.hetero = word != "none";
            o.read.waters = word == "waters";
          },
          "hetero atoms to keep: ligands (with ions and sugars; the same as --hetero alone), waters (these as well) "
          "or none (default)")
      ->check(CLI::IsMember({"none", "ligands", "waters"}));
  command
      .add_option("--components", o.read.components,
                  "CIF file of chemical components, which give the bonds of residues by name (repeatable)")
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--dictionary", [&o](const std::string& text) { o.read.dictionary = text == "none" ? std::string() : text; },
          "folder of a monomer dictionary, or none (default: $CLIBD_MON, otherwise Debian's refmac-dictionary)")
      ->default_str(o.read.dictionary.string());
  command
      .add_option_function<std::string>(
          "--bonds",
          [&o](const std::string& text) {
            o.read.bonds = text == "recorded" ? BondSearch::recorded : BondSearch::geometry;
          },
          "bonds between residues, apart from polymer bonds: recorded (only bonds recorded in the file) or geometry "
          "(default: also bonds found by distance, if valences and angles allow them)")
      ->check(CLI::IsMember({"recorded", "geometry"}));
  CLI::Option* exempt = command.add_flag(
      "--exempt-reference", o.check.exempt_reference,
      "ignore pairs that collide in the first model of the file, except pairs of two files and pairs of a "
      "placed part and the rest");
  command
      .add_flag("--exempt-interfaces", o.check.exempt_interfaces,
                "ignore the pairs that --exempt-reference excepts, too")
      ->needs(exempt);
  command.add_option("--engine", o.check.engine, "simd, lazy (the paper's) or brute")->capture_default_str();
  command.add_option("--explain", o.explain, "print which rule keeps or drops the pair of atoms i,j (numbers from 0)");
}

void add_json_option(CLI::App& command, Options& o) {
  command.add_flag_callback(
      "--json", [&o] { o.output = Output::json; }, "print JSON on standard output");
}

void add_check_options(CLI::App& command, Options& o) {
  add_json_option(command, o);
  command
      .add_flag_callback(
          "--csv", [&o] { o.output = Output::csv; }, "print CSV on standard output")
      ->excludes("--json");
  command
      .add_option_function<std::string>(
          "--mode",
          [&o](const std::string& text) {
            if (hinge::Mode::parse(text, "angstrom").margin > hinge::tool::largest_length)
              throw hinge::ModelError("--mode '" + text + "': expected D in angstrom, at most 1e+09");
            o.mode = text;
          },
          "question: any, all, within:D (angstrom) or closest")
      ->default_str(o.mode);
  command.add_option("--out", o.out, "write the conformations to this .pdb, .cif, .dcd or .npy file");
  command
      .add_option_function<std::string>(
          "--filter", [&o](const std::string& text) { o.only_free = text == "free"; },
          "conformations that --out writes: all (default) or free")
      ->check(CLI::IsMember({"all", "free"}))
      ->needs("--out");
  command.add_option_function<std::string>(
      "--shard", [&o](const std::string& text) { o.shard = parse_shard(text); },
      "i/n: run only part i of n (from 1), for biocd merge; needs --json or --csv");
  add_number(command, "--threads", o.threads, NumberRange<unsigned>{1, 1024},
             "number of worker threads; the output does not depend on it");
}

void add_closures_option(CLI::App& command, Options& o) {
  command
      .add_option_function<std::string>(
          "--closures", [&o](const std::string& text) { o.keep_closures = text == "keep"; },
          "cycles through disulphides and other bonds: keep closed (keep, default) or let open (open); loops "
          "stay closed")
      ->check(CLI::IsMember({"open", "keep"}));
}

void add_path_options(CLI::App& command, Options& o) {
  add_json_option(command, o);
  constexpr const char* end =
      "reference, model:N (the torsions of that model), @FILE, or comma-separated changes from the reference, one per "
      "DOF, degrees";
  command.add_option("--from", o.from, end)->required();
  command.add_option("--to", o.to, end)->required();
  CLI::Option* sampled = add_number(command, "--sampled", o.sampled_degrees, lengths_above_0,
                                    "test states at most this many degrees apart (default: certify every state)");
  add_number(command, "--min-step", o.min_step, Reals{0.0, 1.0, true},
             "do not subdivide intervals shorter than this fraction of the path")
      ->excludes(sampled);
}

}  // namespace biocd
