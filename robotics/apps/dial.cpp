// SPDX-License-Identifier: BSD-3-Clause
// robocd dial: measures what each choice costs and gets wrong on the user's robot, and recommends one.
#include <fmt/format.h>

#include <string>

#include "answer.hpp"
#include "hinge/core/error.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/dial_report.hpp"
#include "hinge_tools/json_text.hpp"
#include "hinge_tools/settings_file.hpp"
#include "options.hpp"
#include "report.hpp"
#include "robot_dial.hpp"
#include "robot_page.hpp"

namespace robocd {

using hinge::tool::DialReport;

Exit run_dial(const Options& options) {
  if (!options.tiers.empty()) throw hinge::ModelError("--tier: dial measures the tiers itself, expected no --tier");
  Job job = load(options);
  hinge::tool::CompleteFile page(options.report), settings(options.dial.apply);
  RobotDial dial(options, job);
  for (const std::string& note : notes_on_bodies(options, dial.worker())) job.notes.push_back(note);
  print_notes(job);
  if (options.output == Output::table) fmt::print("{}\n", heading(options, job));
  const DialReport report = dial.run();
  if (options.output == Output::json) {
    Json json{{"tool", "robocd"}, {"command", "dial"}, {"robot", robot_json(options, job)}};
    json["clearance"] = options.clearance;
    add_surroundings(json, job);
    json.update(hinge::tool::dial_json<Json>(report));
    fmt::print("{}\n", hinge::tool::json_text(json, 1));
  } else {
    fmt::print("{}", report_text(report));
  }
  write_dial_page<Json>(page, page_words(options, job), report);
  write_settings(settings, "robocd check, path, relax and plan", options.command_line, report.advice.text,
                 dial.settings());
  if (settings.wanted() && options.output == Output::table) fmt::print("options written to {}\n", options.dial.apply);
  if (page.wanted() && options.output == Output::table) fmt::print("report: {}\n", options.report);
  print_incomplete(*job.robot);
  return Exit::free;
}

}  // namespace robocd
