// SPDX-License-Identifier: BSD-3-Clause
// Adds the options with their ranges, defaults and help texts.
#include "shared_options.hpp"

#include <string>

#include "hinge/core/error.hpp"
#include "hinge_tools/choice_option.hpp"
#include "hinge_tools/exit_zero_option.hpp"
#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/max_pairs_option.hpp"
#include "hinge_tools/mode_option.hpp"
#include "hinge_tools/parts_option.hpp"
#include "hinge_tools/repeatable_option.hpp"

namespace biocd {

using hinge::molecular::BondSearch;
using hinge::tool::add_choice;
using hinge::tool::add_number;
using hinge::tool::NumberRange;
using hinge::tool::repeatable;
using Reals = NumberRange<double>;
namespace title = hinge::tool::title;

namespace {

constexpr const char* conformations = "DCD, XTC, .npy, PDB, mmCIF, PQR, plain or .gz";

void add_input_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::input);
  command.add_option("FILE", o.file, "PDB, mmCIF or PQR file, plain or .gz")->required();
  repeatable(command.add_option("--with", o.with,
                                "one more file in addition to FILE; all of it is kept except waters (repeatable)"),
             "FILE");
  repeatable(command.add_option("--settings", o.settings,
                                "file of more options, one per line, as dial --apply writes it (repeatable)"),
             "FILE");
  add_number(command, "--model", o.read.model, NumberRange<int>{-99999999, 99999999}, "number of the model to use");
}

void add_free_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::free);
  CLI::Option* free = command.add_option("--free", o.free, "torsions that are free (with --loop: only side chains)")
                          ->capture_default_str()
                          ->type_name("SELECTION");
  command.add_flag("--omega", o.omega, "free omega, too");
  command
      .add_option("--loop", o.loop,
                  "loops such as A:40-52, free between two fixed ends; everything outside the loops is fixed")
      ->type_name("RESIDUES");
  const bool searches = command.get_name() == "plan" || command.get_name() == "relax";
  command.parse_complete_callback([&o, free, searches] {
    if (o.loop.empty() || free->count() > 0) return;
    o.free = searches || o.collision_free ? "(" + o.loop + ") and chi" : "none";
    o.free_by_loop = true;
  });
  command.add_flag("--keep-hbonds", o.keep_hydrogen_bonds,
                   "treat hydrogen bonds of the backbone (Kabsch & Sander) as closures");
  repeatable(command.add_option("--rigid-from", o.rigid_from,
                                std::string("conformations (") + conformations +
                                    ") from which rigid groups are found; torsions inside a rigid group stay at their "
                                    "reference (repeatable)"),
             "FILE");
  add_number(command, "--rigid-tolerance", o.rigid_tolerance, lengths_above_0,
             "largest standard deviation of a distance inside a rigid group")
      ->type_name("ANGSTROM");
}

void add_molecules_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::molecules);
  repeatable(
      command.add_option("--place", o.place,
                         "a chain, ligand or file that moves as one body relative to the rest; samples move it by at "
                         "most ANGSTROM and DEGREES (default: 10,180; repeatable)"),
      "PART[=ANGSTROM[,DEGREES]]");
  command.add_option("--between", o.between, "test only pairs of one atom from each part ('rest': all other atoms)")
      ->type_name("PART PART");
  repeatable(command.add_option("--inside", o.inside,
                                "test only pairs inside this part, in addition to the pairs of --between (repeatable)"),
             "PART");
}

void add_rules_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::rules);
  command
      .add_option("--rules", o.check.thresholds.rules,
                  "definition of a clash: biocd is set by the next five options, the others reproduce a program; auto "
                  "is severe for a structure with hydrogens if none of the five is given, otherwise biocd")
      ->capture_default_str()
      ->type_name("auto|biocd|severe|molprobity|chimerax|posebusters");
  command.add_option("--radii", o.check.thresholds.radii, "set of radii (default: bondi)")
      ->type_name("bondi|probe|probe-united|amber");
  add_number(command, "--rho", o.check.thresholds.rho, Reals{0.0, 1000.0, true},
             "factor of the threshold M = rho * (sum of radii) (default: 0.8)")
      ->type_name("NUMBER");
  add_number(command, "--min-bonds", o.check.min_bonds, NumberRange<int>{1, 1000},
             "smallest number of bonds between the atoms of a tested pair (default: set by --radii, 4 for bondi)");
  add_choice(
      command, "--hbond", {"auto", "on", "off"},
      [&o](const std::string& text) {
        if (text != "auto") o.check.thresholds.hydrogen_bonds = text == "on";
      },
      "hydrogen-bond rule; auto (default): on for a structure with hydrogens");
  add_number(command, "--hbond-allowance", o.check.thresholds.hydrogen_bond_allowance, Reals{0.0, 1000.0},
             "length subtracted from M(polar H, acceptor) (default: 0.4)")
      ->type_name("ANGSTROM");
  CLI::Option* exempt = command.add_flag(
      "--exempt-reference", o.check.exempt_reference,
      "ignore pairs that collide in the first model of the file, except pairs of two files and pairs of a "
      "placed part and the rest");
  command
      .add_flag("--exempt-interfaces", o.check.exempt_interfaces,
                "ignore the pairs that --exempt-reference excepts, too")
      ->needs(exempt);
}

void add_reading_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::reading);
  add_choice(
      command, "--hetero", {"none", "ligands", "waters"},
      [&o](const std::string& word) {
        o.read.hetero = word != "none";
        o.read.waters = word == "waters";
      },
      "hetero atoms to keep: none (default), ligands (with ions and sugars; the same as --hetero alone) or waters (and "
      "ligands)");
  add_choice(
      command, "--hydrogens", {"keep", "drop"},
      [&o](const std::string& text) { o.read.keep_hydrogens = text == "keep"; },
      "keep (default) or drop the hydrogens of the file");
  command
      .add_option_function<std::string>(
          "--altloc",
          [&o](const std::string& text) {
            if (text.size() != 1) throw hinge::ModelError("--altloc '" + text + "': expected one character");
            o.read.altloc = text.front();
          },
          "alternative location to use (default: the location of highest summed occupancy); residues without it use "
          "their own location of highest occupancy")
      ->type_name("LETTER");
  add_choice(
      command, "--bonds", {"geometry", "recorded"},
      [&o](const std::string& text) {
        o.read.bonds = text == "recorded" ? BondSearch::recorded : BondSearch::geometry;
      },
      "bonds between residues, apart from polymer bonds: recorded in the file, or geometry (default): also bonds found "
      "by distance, if valences and angles allow them");
  repeatable(command.add_option("--components", o.read.components,
                                "CIF file of chemical components, which give the bonds of residues by name "
                                "(repeatable)"),
             "FILE");
  command
      .add_option_function<std::string>(
          "--dictionary", [&o](const std::string& text) { o.read.dictionary = text == "none" ? std::string() : text; },
          "folder of a monomer dictionary, or none (default: $CLIBD_MON, otherwise Debian's refmac-dictionary)")
      ->type_name("FOLDER");
}

}  // namespace

void add_model_options(CLI::App& command, Options& o) {
  add_input_options(command, o);
  add_free_options(command, o);
  add_molecules_options(command, o);
  add_rules_options(command, o);
  add_reading_options(command, o);
  command.option_defaults()->group(title::performance);
  command.add_option("--engine", o.check.engine, "simd, lazy (the paper's) or brute (every pair)")
      ->capture_default_str()
      ->type_name("simd|lazy|brute");
}

void add_output_options(CLI::App& command, Options& o, bool with_csv) {
  command.option_defaults()->group(title::output);
  command.add_flag_callback(
      "--json", [&o] { o.output = Output::json; }, "print JSON on standard output");
  if (with_csv) {
    CLI::Option* csv = command.add_flag_callback(
        "--csv", [&o] { o.output = Output::csv; }, "print CSV on standard output");
    csv->excludes("--json");
    command
        .add_flag_callback(
            "--npy", [&o] { o.output = Output::npy; },
            "print verdicts as a NumPy array of bytes on standard output: 0 free, 1 collides, 2 not found")
        ->excludes("--json")
        ->excludes(csv);
  }
  hinge::tool::add_max_pairs(command, o.max_pairs);
}

void add_explain_option(CLI::App& command, Options& o) {
  command.add_option("--explain", o.explain, "print which rule keeps or drops the pair of atoms I and J (from 0)")
      ->type_name("I,J");
}

void add_out_option(CLI::App& command, Options& o) {
  command.add_option("--out", o.out, "write conformations to this .pdb, .cif, .dcd, .xtc or .npy file")
      ->type_name("FILE");
}

void add_view_option(CLI::App& command, Options& o) {
  add_choice(
      command, "--view", {"chimerax", "pymol"},
      [&o](const std::string& text) { o.view = text == "pymol" ? Viewer::pymol : Viewer::chimerax; },
      "write a script for ChimeraX (.cxc) or PyMOL (.pml) that shows the conformation with the most clashes, and its "
      "structure: NAME_clashes.* with the name of --out, or of FILE in the working directory");
}

void add_report_option(CLI::App& command, Options& o) {
  command
      .add_option("--report", o.report,
                  "write an HTML page with the molecule, its conformations and their clashes, for any browser")
      ->type_name("FILE.html");
}

void add_check_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::question);
  hinge::tool::add_mode(
      command, o.mode, "angstrom",
      "any: yes or no; all: list colliding pairs; within:D: list pairs closer than their threshold + D angstrom; "
      "closest: the pair nearest to its threshold");
  add_output_options(command, o, true);
  add_out_option(command, o);
  add_choice(
      command, "--filter", {"all", "free"}, [&o](const std::string& text) { o.only_free = text == "free"; },
      "conformations that --out writes (default: all)")
      ->needs("--out");
  add_view_option(command, o);
  add_report_option(command, o);
  add_explain_option(command, o);
  hinge::tool::add_exit_zero(command, o.exit_zero);
  hinge::tool::add_parts(command, o.parts, "conformations");
  command.option_defaults()->group(title::performance);
  add_number(command, "--threads", o.threads, NumberRange<unsigned>{1, 1024},
             "number of worker threads; the output does not depend on it");
  command.option_defaults()->group(title::output);
}

void add_closures_option(CLI::App& command, Options& o) {
  add_choice(
      command, "--closures", {"keep", "open"}, [&o](const std::string& text) { o.keep_closures = text == "keep"; },
      "cycles through disulphides and other bonds: keep closed (default) or let open; loops stay closed");
}

void add_ends(CLI::App& command, Options& o, bool from_is_required) {
  constexpr const char* end =
      ": reference; coordinates that the torsions are fitted to, which are model:N of FILE, a PDB, mmCIF or PQR file "
      "(:N for its model N) or TRAJECTORY:FRAME; or changes from the reference, one per DOF in degrees, as a list "
      "joined by commas or in @FILE";
  CLI::Option* from = command.add_option("--from", o.from, std::string("start") + end)->type_name("END");
  if (from_is_required)
    from->required();
  else
    from->default_str("reference");
  command.add_option("--to", o.to, "end, in the same words")->required()->type_name("END");
}

void add_path_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::ends);
  add_ends(command, o, true);
  CLI::Option* sampled = add_number(command, "--sampled", o.sampled_degrees, lengths_above_0,
                                    "test states at most this far apart (default: certify every state)")
                             ->type_name("DEGREES");
  add_number(command, "--min-step", o.min_step, Reals{0.0, 1.0, true},
             "do not subdivide intervals shorter than this fraction of the path")
      ->excludes(sampled)
      ->type_name("FRACTION");
  add_output_options(command, o);
  add_view_option(command, o);
  add_report_option(command, o);
  add_explain_option(command, o);
  hinge::tool::add_exit_zero(command, o.exit_zero);
}

}  // namespace biocd
