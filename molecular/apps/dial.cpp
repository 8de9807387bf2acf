// SPDX-License-Identifier: BSD-3-Clause
// biocd dial: measures what each choice costs and gets wrong on the user's molecule, and recommends one.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/dial_report.hpp"
#include "hinge_tools/json_text.hpp"
#include "hinge_tools/settings_file.hpp"
#include "molecule_dial.hpp"
#include "molecule_page.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

using hinge::molecular::Structure;

Exit run_dial(const Options& given) {
  Options options = given;
  options.rigid_from.clear();  // the rigid groups are one of the choices, not the reference
  const Job job = load(options);
  std::vector<std::string> ensemble = given.rigid_from;
  const Structure& s = job.molecule->structure();
  const bool can_be_read_again = std::filesystem::is_regular_file(options.file);  // not a pipe
  if (ensemble.empty() && can_be_read_again && (s.more_models || s.models.size() > 1)) ensemble = {options.file};
  hinge::tool::CompleteFile page(options.report), settings(options.dial.apply);
  print_notes(job);
  require_free_torsions(options, job);
  if (options.output == Output::table) fmt::print("{}\n", heading(options, job));
  MoleculeDial dial(options, job, ensemble);
  const hinge::tool::DialReport report = dial.run();
  if (options.output == Output::json) {
    Json json{{"tool", "biocd"}, {"command", "dial"}, {"model", model_json(options, job)}};
    json.update(hinge::tool::dial_json<Json>(report));
    fmt::print("{}\n", hinge::tool::json_text(json, 1));
  } else {
    fmt::print("{}", report_text(report));
  }
  write_dial_page<Json>(page, page_words(options, job), report);
  write_settings(settings, "biocd check and sample", options.command_line, report.advice.text, dial.settings());
  if (settings.wanted() && options.output == Output::table) fmt::print("options written to {}\n", options.dial.apply);
  if (page.wanted() && options.output == Output::table) fmt::print("report: {}\n", options.report);
  return Exit::free;
}

}  // namespace biocd
