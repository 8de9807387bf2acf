// SPDX-License-Identifier: BSD-3-Clause
// biocd check: the coordinates of the file, model by model, every admitted pair.
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "hinge/ensemble/ensemble.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

using namespace hinge::molecular;

Exit run_check(const Options& options) {
  const Job job = load(options);
  const Mode mode = Mode::parse(options.mode, "angstrom");
  print_notes(job);
  if (!options.explain.empty()) {
    explain(options, job);
    return Exit::free;
  }
  const Structure& s = job.molecule->structure();
  Json json{{"tool", "biocd"}, {"command", "check"}, {"model", model_json(options, job)}, {"mode", mode.text()}};
  json["constant_contacts"] = constant_contacts_json(job);
  json["conformations"] = Json::array();
  std::string table = heading(options, job), csv = csv_header();
  std::size_t colliding = 0;
  const auto judge = [&](Checker& checker, std::size_t m) { return checker.check_coordinates(s.models[m], mode); };
  const auto report = [&](std::size_t m, const Verdict& verdict) {
    colliding += verdict.collides ? 1 : 0;
    if (options.output == Output::json) {
      Json row = verdict_json(s, m, verdict, mode);
      row["model_number"] = s.model_numbers[m];
      json["conformations"].push_back(std::move(row));
    }
    if (options.output == Output::csv) csv += csv_rows(s, m, verdict);
    if (options.output != Output::table) return;
    table += fmt::format("model {}: {}", s.model_numbers[m], verdict.collides ? "collides" : "free");
    if (mode.kind == Mode::Kind::all) table += fmt::format(", {} pairs", verdict.pairs.size());
    if (mode.kind == Mode::Kind::within)
      table += fmt::format(", {} pairs closer than their threshold + {}", verdict.pairs.size(), mode.margin);
    table += "\n";
    for (const Contact& pair : verdict.pairs) table += pair_line(s, pair) + "\n";
    if (verdict.closest) table += pair_line(s, *verdict.closest) + "  (closest)\n";
  };
  hinge::Ensemble(job.checker, options.threads).run(s.models.size(), judge, report);
  if (options.output == Output::json) fmt::print("{}\n", json.dump(1));
  if (options.output == Output::csv) {
    print_constant_contacts(job);
    fmt::print("{}", csv);
  }
  if (options.output == Output::table) fmt::print("{}{} of {} models collide\n", table, colliding, s.models.size());
  return colliding > 0 ? Exit::collision : Exit::free;
}

}  // namespace biocd
