// SPDX-License-Identifier: BSD-3-Clause
// Adds the options with their ranges, defaults and help texts.
#include "shared_options.hpp"

#include <cstdint>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge_tools/choice_option.hpp"
#include "hinge_tools/exit_zero_option.hpp"
#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/max_pairs_option.hpp"
#include "hinge_tools/mode_option.hpp"
#include "hinge_tools/number_option.hpp"
#include "hinge_tools/parts_option.hpp"
#include "hinge_tools/repeatable_option.hpp"

namespace robocd {

using hinge::tool::add_choice;
using hinge::tool::add_number;
using hinge::tool::count_range;
using hinge::tool::NumberRange;
using hinge::tool::repeatable;
using hinge::tool::seed_range;
using Reals = NumberRange<double>;
namespace title = hinge::tool::title;

namespace {

void add_report_option(CLI::App& command, Options& o) {
  command
      .add_option("--report", o.report,
                  "write an HTML page with the robot, its configurations and their collisions, for any browser")
      ->type_name("FILE.html");
}

void add_srdf_option(CLI::App& command, Options& o, const char* help) {
  command.option_defaults()->group(title::input);
  command.add_option("--srdf", o.srdf, help)->type_name("FILE");
  command.option_defaults()->group(title::reading);
  command.add_flag("--note-unknown-links", o.note_unknown_links,
                   "print a note, not an error, for SRDF pairs with links that the robot does not have");
}

void add_contained_option(CLI::App& command, Options& o) {
  command.add_flag("--contained", o.contained,
                   "treat closed meshes as solid, like boxes, cylinders, spheres and capsules");
}

void add_clearance_option(CLI::App& command, Options& o) {
  add_number(command, "--clearance", o.clearance, Reals{0.0, hinge::tool::largest_length},
             "links closer than this length collide; links that touch always collide")
      ->type_name("METRES");
}

void add_configuration_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::configurations);
  CLI::Option_group* source = command.add_option_group("configurations", "exactly one of these options");
  CLI::Option* random = add_number(*source, "--random", o.count, count_range,
                                   "number of random configurations, uniform within the joint limits")
                            ->default_str("");
  source
      ->add_option("--csv-in", o.csv_in,
                   "CSV file of configurations: a header of joint names, then one configuration per row")
      ->type_name("FILE");
  repeatable(source->add_option(
                 "--state", o.states,
                 "state of the SRDF; several states make one configuration, other joints are zero (repeatable)"),
             "GROUP/NAME");
  source->add_flag("--zero", o.zero, "the configuration with every joint at zero");
  source->require_option(1);
  command.option_defaults()->group(title::sampling);
  add_number(command, "--seed", o.seed, seed_range, "seed; random configuration k depends only on (seed, k)")
      ->needs(random)
      ->type_name("SEED");
}

/// Words for a configuration.
constexpr const char* end_words =
    "zero, state:GROUP/NAME (several names separated by commas), @FILE.csv, @FILE.csv:ROW (rows from 0), or values "
    "joined by commas, one per independent joint";

/// Adds the question about one motion or configuration, and the output.
void add_question_options(CLI::App& command, Options& o) {
  add_environment_option(command, o);
  command.option_defaults()->group(title::question);
  add_clearance_option(command, o);
  add_contained_option(command, o);
  add_json_option(command, o);
  add_report_option(command, o);
  hinge::tool::add_max_pairs(command, o.max_pairs);
  hinge::tool::add_exit_zero(command, o.exit_zero);
}

/// Adds the limits and the seed of a search.
void add_search_options(CLI::App& command, Options& o, std::uint64_t& tries, const char* help) {
  command.option_defaults()->group(title::sampling);
  add_number(command, "--tries", tries, count_range, help);
  add_number(command, "--time", o.seconds, Reals{0.0, hinge::tool::largest_length, true},
             "test nothing after this time")
      ->type_name("SECONDS");
  add_number(command, "--seed", o.seed, seed_range, "seed of the search")->type_name("SEED");
}

}  // namespace

void add_closeness_options(CLI::App& command, Options& o) {
  add_clearance_option(command, o);
  add_contained_option(command, o);
}

void add_robot_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::input);
  command.add_option("URDF", o.urdf, "robot description with meshes in STL, OBJ, DAE or PLY")->required();
  repeatable(command.add_option("--settings", o.settings,
                                "file of more options, one per line, as dial --apply writes it (repeatable)"),
             "FILE");
  repeatable(command.add_option("--package-path", o.package_folders,
                                "folder of packages for package://, searched before ROS_PACKAGE_PATH and "
                                "AMENT_PREFIX_PATH (repeatable)"),
             "FOLDER");
  command.option_defaults()->group(title::reading);
  add_choice(
      command, "--missing-meshes", {"refuse", "skip"},
      [&o](const std::string& text) { o.skip_missing_meshes = text == "skip"; },
      "refuse (default) or skip: leave out geometry if its mesh is missing or empty, or its shape is not supported; "
      "every verdict then says that the model is incomplete");
  add_choice(
      command, "--primitives", {"exact", "reference"},
      [&o](const std::string& text) { o.reference_primitives = text == "reference"; },
      "exact (default): exact spheres and capsules, cylinders enclosed to 1 mm; reference: inscribed meshes of 32 "
      "sides "
      "per cylinder and 320 triangles per sphere");
  repeatable(command.add_option("--tier", o.tiers,
                                "shapes of all links, or of one link: mesh (default: as in the URDF), hull, capsule or "
                                "spheres; all but mesh enclose the link, so no contact of surfaces is missed "
                                "(repeatable)"),
             "[LINK=]TIER");
}

void add_pair_options(CLI::App& command, Options& o) {
  add_srdf_option(command, o, "SRDF file with disabled pairs of links and named states");
  command.option_defaults()->group(title::pairs);
  repeatable(command.add_option("--skip-pairs", o.skip_pairs,
                                "text file of more disabled pairs; each line names two links, or a link and a body of "
                                "--env (repeatable)"),
             "FILE");
  repeatable(command.add_option("--proved-apart", o.proved_apart,
                                "leave out this pair of links, which never meets within the joint limits; "
                                "configurations outside the limits are refused (repeatable)"),
             "LINK LINK");
  command
      .add_option("--made-for", o.made_for,
                  "digest of the model for which --proved-apart was found, as dial --apply writes it; another model is "
                  "refused")
      ->type_name("DIGEST");
}

void add_json_option(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::output);
  command.add_flag_callback(
      "--json", [&o] { o.output = robocd::Output::json; }, "print JSON on standard output");
}

void add_environment_option(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::surroundings);
  repeatable(command.add_option("--env", o.environment,
                                "body in the world, [NAME=]SHAPE[,xyz=X Y Z][,rpy=R P Y][,scale=S], where SHAPE is a "
                                "mesh file, 'box:X Y Z', 'sphere:R', 'cylinder:R L', 'capsule:R L' or 'points:FILE R' "
                                "(a text file of points x y z, each a sphere of radius R) (repeatable)"),
             "BODY");
  repeatable(command.add_option("--attach", o.attached,
                                "this link holds this body of --env, whose xyz and rpy are then in the frame of the "
                                "link; the body may touch the links that move with it (repeatable)"),
             "LINK BODY");
  repeatable(command.add_option("--allow", o.allowed,
                                "this link and this body may touch, for example a base and its table (repeatable)"),
             "LINK BODY");
  add_choice(
      command, "--floating-base", {"fixed", "free"}, [&o](const std::string& text) { o.floating_base = text; },
      "fixed: a robot with a floating base stands at the origin of its base joint; required with --env");
}

void add_check_options(CLI::App& command, Options& o) {
  add_configuration_options(command, o);
  command.option_defaults()->group(title::question);
  hinge::tool::add_mode(
      command, o.mode, "metres",
      "any: yes or no; all: list colliding pairs; within:D: list pairs closer than the clearance + D metres; "
      "closest: the pair with the smallest distance");
  add_closeness_options(command, o);
  add_environment_option(command, o);
  command.option_defaults()->group(title::performance);
  command.add_option("--engine", o.engine, "simd, lazy (the paper's) or brute (every pair)")
      ->capture_default_str()
      ->type_name("simd|lazy|brute");
  add_number(command, "--threads", o.threads, NumberRange<unsigned>{1, 1024},
             "number of worker threads; the output does not depend on it");
  add_json_option(command, o);
  CLI::Option* csv = command.add_flag_callback(
      "--csv", [&o] { o.output = robocd::Output::csv; }, "print CSV on standard output");
  csv->excludes("--json");
  command
      .add_flag_callback(
          "--npy", [&o] { o.output = robocd::Output::npy; },
          "print verdicts as a NumPy array of bytes on standard output: 0 free, 1 collides")
      ->excludes("--json")
      ->excludes(csv);
  hinge::tool::add_max_pairs(command, o.max_pairs);
  add_report_option(command, o);
  command.add_option("--out", o.out, "write the configurations to this CSV file, in the format of --csv-in")
      ->type_name("FILE");
  hinge::tool::add_exit_zero(command, o.exit_zero);
  hinge::tool::add_parts(command, o.parts, "configurations");
}

void add_matrix_options(CLI::App& command, Options& o) {
  constexpr NumberRange<std::size_t> numbers{0, std::size_t{1} << 53};
  add_srdf_option(command, o, "SRDF file to extend: its contents are kept, and pairs that it disables are not proved");
  command.option_defaults()->group(title::proofs);
  add_number(command, "--samples", o.matrix.samples, numbers, "number of random configurations to test");
  add_number(command, "--seed", o.matrix.seed, seed_range, "seed of the random configurations")->type_name("SEED");
  add_number(command, "--cells", o.matrix.cells, numbers,
             "largest number of boxes of joint values that a proof may use per pair; 0: no proofs");
  command.option_defaults()->group(title::question);
  add_closeness_options(command, o);
  command.option_defaults()->group(title::output);
  command.add_flag("--disable-unseen", o.disable_unseen,
                   "also disable pairs that were not seen in collision, although this is not a proof");
  command.add_option("--out", o.out, "SRDF file to write (default: standard output)")->type_name("FILE");
  add_report_option(command, o);
}

void add_path_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::ends);
  CLI::Option_group* ends = command.add_option_group("path", "either --from and --to, or --waypoints");
  CLI::Option* from = ends->add_option("--from", o.from, std::string("start: ") + end_words)->type_name("END");
  CLI::Option* to = ends->add_option("--to", o.to, "end, in the same words")->type_name("END");
  from->needs(to);
  to->needs(from);
  ends->add_option("--waypoints", o.waypoints,
                   "CSV file of configurations, in the format of check --csv-in; the path joins each row to the next")
      ->excludes(from)
      ->excludes(to)
      ->type_name("FILE");
  ends->require_option(1, 2);
  CLI::Option* sampled = add_number(command, "--sampled", o.sampled, Reals{0.0, hinge::tool::largest_length, true},
                                    "test states at most this far apart, rad or m (default: certify every state)")
                             ->type_name("STEP");
  add_number(command, "--min-step", o.min_step, Reals{0.0, 1.0, true},
             "do not subdivide intervals shorter than this fraction of the path")
      ->excludes(sampled)
      ->type_name("FRACTION");
  add_question_options(command, o);
}

void add_relax_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::configurations);
  command.add_option("--from", o.from, std::string("configuration to start from: ") + end_words)
      ->required()
      ->type_name("END");
  add_search_options(command, o, o.tries, "largest number of configurations to test");
  add_question_options(command, o);
  command.add_option("--out", o.out, "write the configuration to this CSV file, in the format of check --csv-in")
      ->type_name("FILE");
}

void add_plan_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::ends);
  command.add_option("--from", o.from, std::string("start: ") + end_words)->required()->type_name("END");
  command.add_option("--to", o.to, "end, in the same words")->required()->type_name("END");
  add_search_options(command, o, o.motions, "largest number of motions to test before the end is reached");
  add_question_options(command, o);
  CLI::Option* out =
      command.add_option("--out", o.out, "write the waypoints to this CSV file, in the format of path --waypoints")
          ->type_name("FILE");
  add_number(command, "--step", o.step, Reals{0.0, hinge::tool::largest_length, true},
             "add rows to the file of --out, so that no joint changes by more than this, rad or m, from row to row")
      ->needs(out)
      ->type_name("STEP");
}

}  // namespace robocd
