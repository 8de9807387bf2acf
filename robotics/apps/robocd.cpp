// SPDX-License-Identifier: BSD-3-Clause
// robocd: collision checks of robots on the command line. This file defines the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "help.hpp"
#include "hinge/detail/simd/instruction_set.hpp"
#include "hinge/version.hpp"
#include "hinge_tools/exit_zero_option.hpp"
#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/parse_command_line.hpp"
#include "hinge_tools/parts_option.hpp"
#include "hinge_tools/pick_instruction_set.hpp"
#include "hinge_tools/report_page.hpp"
#include "hinge_tools/run_tool.hpp"
#include "hinge_tools/this_program.hpp"
#include "options.hpp"
#include "shared_options.hpp"

namespace {

using robocd::Exit;
using robocd::Options;
namespace title = hinge::tool::title;

Exit run(int argc, char** argv) {
  Options o;
  o.command_line = hinge::tool::command_text("robocd", argc, argv);
  o.parts.words = hinge::tool::words_of_question(argc, argv);
  std::function<Exit(const Options&)> command;
  const hinge::tool::HelpTexts texts = robocd::help_texts();
  CLI::App app{"collisions of robots as articulated mechanisms", "robocd"};
  hinge::tool::add_general_options(
      app, texts,
      fmt::format("robocd {} ({})", hinge::version_string, hinge::detail::simd::name(hinge::tool::instruction_set)));

  CLI::App* info = app.add_subcommand("info", "show links, joints, rigid groups and tested pairs");
  robocd::add_robot_options(*info, o);
  robocd::add_pair_options(*info, o);
  robocd::add_json_option(*info, o);
  info->callback([&] { command = robocd::run_info; });

  CLI::App* check = app.add_subcommand("check", "check configurations: verdicts and colliding pairs of links");
  robocd::add_robot_options(*check, o);
  robocd::add_pair_options(*check, o);
  robocd::add_check_options(*check, o);
  check->callback([&] { command = robocd::run_check; });

  hinge::tool::add_merge(app, o.merged, o.out, o.exit_zero)->callback([&] { command = robocd::run_merge; });

  CLI::App* matrix =
      app.add_subcommand("matrix", "write an SRDF with the pairs of links that need no test, and the reasons");
  robocd::add_robot_options(*matrix, o);
  robocd::add_matrix_options(*matrix, o);
  matrix->callback([&] { command = robocd::run_matrix; });

  CLI::App* path =
      app.add_subcommand("path", "check the straight path between two configurations, by proof or by sampling");
  robocd::add_robot_options(*path, o);
  robocd::add_pair_options(*path, o);
  robocd::add_path_options(*path, o);
  path->callback([&] { command = robocd::run_path; });

  CLI::App* relax = app.add_subcommand("relax", "move a configuration out of collision, as little as possible");
  robocd::add_robot_options(*relax, o);
  robocd::add_pair_options(*relax, o);
  robocd::add_relax_options(*relax, o);
  relax->callback([&] { command = robocd::run_relax; });

  CLI::App* plan = app.add_subcommand("plan", "find a free motion between two configurations");
  robocd::add_robot_options(*plan, o);
  robocd::add_pair_options(*plan, o);
  robocd::add_plan_options(*plan, o);
  plan->callback([&] { command = robocd::run_plan; });

  CLI::App* dial =
      app.add_subcommand("dial", "measure what each choice costs and gets wrong on this robot, and recommend one");
  robocd::add_robot_options(*dial, o);
  robocd::add_pair_options(*dial, o);
  robocd::add_dial_options(*dial, o);
  dial->callback([&] { command = robocd::run_dial; });

  CLI::App* demo =
      app.add_subcommand("demo", "demonstrate the library on one robot: time, verify, prove a motion, draw");
  robocd::add_robot_options(*demo, o);
  robocd::add_pair_options(*demo, o);
  robocd::add_environment_option(*demo, o);
  demo->option_defaults()->group(title::ends);
  demo->add_option("--from", o.from, "start of the motion, in the words of path")->required()->type_name("END");
  demo->add_option("--to", o.to, "end of the motion")->required()->type_name("END");
  demo->option_defaults()->group(title::output);
  demo->add_option("--out", o.out, "SVG file to draw")->required()->type_name("FILE");
  demo->callback([&] { command = robocd::run_demo; });

  if (const auto status = hinge::tool::parse_command_line(app, {argv + 1, argv + argc}, texts)) return *status;
  robocd::check_outputs(o);
  return hinge::tool::final_status(command(o), o.exit_zero);
}

}  // namespace

int main(int argc, char** argv) {
  return hinge::tool::run_tool("robocd", [&] {
    hinge::tool::pick_instruction_set(argv);
    return run(argc, argv);
  });
}
