// SPDX-License-Identifier: BSD-3-Clause
// biocd: tests molecules for self-collision. This file defines the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "help.hpp"
#include "hinge/core/error.hpp"
#include "hinge/detail/simd/instruction_set.hpp"
#include "hinge/molecular/components.hpp"
#include "hinge/version.hpp"
#include "hinge_tools/choice_option.hpp"
#include "hinge_tools/exit_zero_option.hpp"
#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/number_option.hpp"
#include "hinge_tools/parse_command_line.hpp"
#include "hinge_tools/parts_option.hpp"
#include "hinge_tools/pick_instruction_set.hpp"
#include "hinge_tools/report_page.hpp"
#include "hinge_tools/run_tool.hpp"
#include "hinge_tools/this_program.hpp"
#include "options.hpp"
#include "report.hpp"
#include "shared_options.hpp"

namespace {

using biocd::Exit;
using biocd::lengths_above_0;
using biocd::Options;
using hinge::tool::add_number;
using hinge::tool::count_range;
using hinge::tool::NumberRange;
using hinge::tool::seed_range;
namespace title = hinge::tool::title;

/// Returns the arguments with a value after each --hetero: the parser needs one, and a bare --hetero means --hetero
/// ligands.
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
  o.command_line = hinge::tool::command_text("biocd", argc, argv);
  o.parts.words = hinge::tool::words_of_question(argc, argv);
  std::function<Exit(const Options&)> command;
  const hinge::tool::HelpTexts texts = biocd::help_texts();
  CLI::App app{"collisions of proteins and other molecules as articulated mechanisms", "biocd"};
  hinge::tool::add_general_options(
      app, texts,
      fmt::format("biocd {} ({})", hinge::version_string, hinge::detail::simd::name(hinge::tool::instruction_set)));

  CLI::App* info =
      app.add_subcommand("info", "show the contents of a file, its degrees of freedom and its rigid groups");
  biocd::add_model_options(*info, o);
  biocd::add_output_options(*info, o);
  info->add_flag("--atoms", o.atoms, "list atoms, bonds, thresholds and constant contacts too (with --json)");
  biocd::add_explain_option(*info, o);
  info->callback([&] { command = biocd::run_info; });

  CLI::App* check = app.add_subcommand("check", "check each model of a file, or each frame of trajectories");
  biocd::add_model_options(*check, o);
  check->option_defaults()->group(title::input);
  check->add_option(
      "TRAJECTORY", o.trajectories,
      "conformations to check instead of the models of FILE: DCD, XTC, .npy, PDB, mmCIF, PQR, plain or .gz");
  biocd::add_check_options(*check, o);
  check->option_defaults()->group(title::output);
  hinge::tool::add_choice(
      *check, "--by", {"residue", "chain"},
      [&o](const std::string& word) { o.by = word == "residue" ? biocd::By::residue : biocd::By::chain; },
      "count the clashes of all models or frames by pairs of residues or chains, most frequent first (a table, or with "
      "--json `clashes` in the summary)");
  check->callback([&] {
    if (o.by && o.output != biocd::Output::table && o.output != biocd::Output::json)
      throw hinge::ModelError("--by: expected a table or --json");
    if (o.by && !biocd::lists_pairs(hinge::Mode::parse(o.mode, "angstrom")))
      throw hinge::ModelError("--by: expected --mode all or within:D, which list pairs");
    command = biocd::run_check;
  });

  CLI::App* sample = app.add_subcommand("sample", "draw random conformations of the free torsions and check each one");
  biocd::add_model_options(*sample, o);
  biocd::add_check_options(*sample, o);
  sample->add_flag("--torsions", o.torsions,
                   "add every free torsion (degrees) and every placement to the rows of --json and --csv");
  sample
      ->add_option("--torsions-out", o.torsions_out,
                   "write the free torsions and placements to this .npy file: samples x DOF, 64-bit floats, in the "
                   "order of `dofs` in --json")
      ->type_name("FILE");
  sample->option_defaults()->group(title::sampling);
  add_number(*sample, "-n,--count", o.count, count_range, "number of conformations");
  add_number(*sample, "--seed", o.seed, seed_range, "seed; conformation k depends only on (seed, k)")
      ->type_name("SEED");
  add_number(*sample, "--sigma", o.sigma_degrees, lengths_above_0,
             "standard deviation of a Gaussian about the reference (default: uniform over the full range)")
      ->type_name("DEGREES");
  biocd::add_closures_option(*sample, o);
  sample->add_flag("--collision-free", o.collision_free,
                   "draw only conformations that do not collide: grow each one residue by residue (with --loop, the "
                   "loops' side chains are free by default)");
  hinge::tool::add_choice(
      *sample, "--prior", {"ramachandran", "uniform"},
      [&o](const std::string& word) {
        o.prior = word == "uniform" ? hinge::molecular::Prior::independent : hinge::molecular::Prior::ramachandran;
      },
      "with --collision-free: distribution of the torsions of proteins, by statistics of phi and psi and by rotamers "
      "of side chains, or uniform (default: ramachandran; with --sigma a Gaussian)");
  add_number(*sample, "--tries", o.most_tries, count_range,
             "largest number of starts for each conformation, with closed cycles (default: 100) or --collision-free "
             "(default: 1000)");
  add_number(*sample, "--time", o.seconds, lengths_above_0, "with --collision-free: begin no start after this time")
      ->type_name("SECONDS");
  sample->callback([&] {
    o.keep_closures = o.keep_closures.value_or(true);
    o.draws = true;
    if (!o.collision_free && (o.prior || o.seconds))
      throw hinge::ModelError(std::string(o.prior ? "--prior" : "--time") + ": expected with --collision-free only");
    if (o.prior && o.sigma_degrees)
      throw hinge::ModelError("--prior and --sigma are both given, expected one of the two");
    command = biocd::run_sample;
  });

  CLI::App* walk =
      app.add_subcommand("walk", "make a Monte Carlo walk of collision-free moves from the conformation of the file");
  biocd::add_model_options(*walk, o);
  biocd::add_output_options(*walk, o);
  biocd::add_out_option(*walk, o);
  add_number(*walk, "--every", o.every, count_range, "number of steps between two written conformations");
  biocd::add_view_option(*walk, o);
  biocd::add_report_option(*walk, o);
  biocd::add_explain_option(*walk, o);
  hinge::tool::add_exit_zero(*walk, o.exit_zero);
  walk->option_defaults()->group(title::moves);
  add_number(*walk, "--steps", o.steps, count_range, "number of moves to try");
  add_number(*walk, "--step-size", o.step_degrees, lengths_above_0, "standard deviation of a torsion's change")
      ->type_name("DEGREES");
  add_number(*walk, "--changes", o.changes, count_range, "number of torsions that a move changes");
  add_number(*walk, "--seed", o.seed, seed_range, "seed; a walk depends only on the seed, the file and the options")
      ->type_name("SEED");
  biocd::add_closures_option(*walk, o);
  walk->callback([&] {
    o.keep_closures = o.keep_closures.value_or(true);
    command = biocd::run_walk;
  });

  CLI::App* relax = app.add_subcommand("relax", "mend the clashes of a conformation and move it as little as possible");
  biocd::add_model_options(*relax, o);
  biocd::add_output_options(*relax, o);
  biocd::add_out_option(*relax, o);
  biocd::add_view_option(*relax, o);
  biocd::add_report_option(*relax, o);
  biocd::add_explain_option(*relax, o);
  hinge::tool::add_exit_zero(*relax, o.exit_zero);
  relax->option_defaults()->group(title::moves);
  biocd::add_closures_option(*relax, o);
  add_number(*relax, "--tries", o.most_tries, count_range,
             "largest number of random restarts, if descent does not mend all clashes (default: 1000)");
  add_number(*relax, "--time", o.seconds, lengths_above_0, "end the search after this time")->type_name("SECONDS");
  add_number(*relax, "--seed", o.seed, seed_range, "seed of the restarts")->type_name("SEED");
  relax->callback([&] {
    o.keep_closures = o.keep_closures.value_or(true);
    command = biocd::run_relax;
  });

  hinge::tool::add_merge(app, o.merged, o.out, o.exit_zero)->callback([&] { command = biocd::run_merge; });

  CLI::App* path =
      app.add_subcommand("path", "check the straight path between two conformations, by proof or by sampling");
  biocd::add_model_options(*path, o);
  path->remove_option(path->get_option("--engine"));  // only one engine certifies paths
  biocd::add_path_options(*path, o);
  path->callback([&] { command = biocd::run_path; });

  CLI::App* plan = app.add_subcommand("plan", "find a motion between two conformations on which no pair collides");
  biocd::add_model_options(*plan, o);
  plan->option_defaults()->group(title::ends);
  biocd::add_ends(*plan, o, false);
  biocd::add_output_options(*plan, o);
  biocd::add_out_option(*plan, o);
  add_number(*plan, "--step", o.frame_step, lengths_above_0,
             "largest turn of a torsion between two written conformations (placed parts: a tenth of it in angstrom)")
      ->type_name("DEGREES");
  biocd::add_view_option(*plan, o);
  biocd::add_report_option(*plan, o);
  biocd::add_explain_option(*plan, o);
  hinge::tool::add_exit_zero(*plan, o.exit_zero);
  plan->option_defaults()->group(title::moves);
  biocd::add_closures_option(*plan, o);
  add_number(*plan, "--tries", o.most_tries, count_range, "largest number of motions to test (default: 100000)");
  add_number(*plan, "--time", o.seconds, lengths_above_0, "end the search after this time")->type_name("SECONDS");
  add_number(*plan, "--seed", o.seed, seed_range, "seed of the random conformations")->type_name("SEED");
  plan->callback([&] {
    o.keep_closures = o.keep_closures.value_or(true);
    if (o.from.empty()) o.from = "reference";
    command = biocd::run_plan;
  });

  CLI::App* dial =
      app.add_subcommand("dial", "measure what each choice costs and gets wrong on this molecule, and recommend one");
  biocd::add_model_options(*dial, o);
  biocd::add_dial_options(*dial, o);
  dial->callback([&] {
    o.keep_closures = o.keep_closures.value_or(true);
    o.draws = true;
    command = biocd::run_dial;
  });

  CLI::App* demo = app.add_subcommand("demo", "demonstrate the library on one protein: sample, time, verify, draw");
  demo->option_defaults()->group(title::input);
  demo->add_option("FILE", o.file, "PDB, mmCIF or PQR file, plain or .gz")->required();
  demo->option_defaults()->group(title::output);
  demo->add_option("--out", o.out, "folder for the plot and the viewer scripts")->required()->type_name("FOLDER");
  demo->option_defaults()->group(title::sampling);
  add_number(*demo, "-n,--count", o.count, count_range, "number of conformations per row");
  add_number(*demo, "--seed", o.seed, seed_range, "seed of the conformations")->type_name("SEED");
  demo->callback([&] { command = biocd::run_demo; });

  if (const auto status = hinge::tool::parse_command_line(app, with_hetero_words(argc, argv), texts)) return *status;
  biocd::check_outputs(o, demo->parsed());
  return hinge::tool::final_status(command(o), o.exit_zero);
}

}  // namespace

int main(int argc, char** argv) {
  return hinge::tool::run_tool("biocd", [&] {
    hinge::tool::pick_instruction_set(argv);
    return run(argc, argv);
  });
}
