// SPDX-License-Identifier: BSD-3-Clause
// Writes the parts that several outputs share.
#include "report.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string_view>
#include <utility>

#include "hinge/core/id.hpp"
#include "hinge/molecular/severity.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/csv_field.hpp"
#include "pair_table.hpp"
#include "scene.hpp"

namespace biocd {

namespace {

using hinge::molecular::Checker;
using hinge::molecular::Contact;
using hinge::molecular::Mode;
using hinge::molecular::Severity;
using hinge::molecular::Structure;
using hinge::molecular::Verdict;
using hinge::tool::counted;
using hinge::tool::csv_field;

std::uint32_t atom(hinge::PrimitiveId i) { return static_cast<std::uint32_t>(hinge::index(i)); }

Severity severity(const Job& job, const Contact& pair) {
  return severity_of(job.checker.thresholds(), pair.hit, pair.collides);
}

Json free_words_json(const Job& job) {
  Json list = Json::array();
  for (const auto& word : job.selected.words) list.push_back({{"word", word.text}, {"torsions", word.count}});
  return list;
}

}  // namespace

std::vector<std::string> all_notes(const Job& job) {
  std::vector<std::string> notes = job.molecule->structure().notes;
  notes.insert(notes.end(), job.molecule->notes().begin(), job.molecule->notes().end());
  notes.insert(notes.end(), job.selected.notes.begin(), job.selected.notes.end());
  return notes;
}

std::size_t exempted_pairs(const Job& job) {
  return static_cast<std::size_t>(std::ranges::count_if(job.checker.reference_collisions(), [&](const hinge::Hit& hit) {
    return !job.checker.exclusions().admits(hit.first, hit.second);
  }));
}

bool has_classes(std::string_view rules) {
  return rules == "molprobity" || rules == "chimerax" || rules == "posebusters";
}
bool has_relative_distance(std::string_view rules) { return rules == "posebusters"; }

Json model_json(const Options& options, const Job& job) {
  const Structure& s = job.molecule->structure();
  const Checker& checker = job.checker;
  const auto& thresholds = checker.thresholds();
  return Json{{"file", options.file},
              {"name", s.name},
              {"atoms", s.atoms.size()},
              {"bonds", s.bonds.size()},
              {"residues", s.residues.size()},
              {"chains", s.chains.size()},
              {"models", s.models.size()},
              {"waters_left_out", s.waters_dropped},
              {"hetero_atoms_left_out", s.hetero_dropped},
              {"hetero_residues_left_out", s.hetero_residues_dropped},
              {"free", options.free},
              {"free_words", free_words_json(job)},
              {"omega", options.omega},
              {"dof", checker.dof_count()},
              {"rigid_groups", checker.rigid_groups().size()},
              {"closures", job.molecule->model().tree().closures().size()},
              {"loops", options.loop},
              {"rigid_from", options.rigid_from},
              {"rigid_tolerance", options.rigid_from.empty() ? Json() : Json(options.rigid_tolerance)},
              {"closures_kept", job.kept.closures.size()},
              {"held_torsions", job.kept.held.size()},
              {"excluded_pairs", checker.exclusions().excluded_pairs()},
              {"exempt_reference", options.check.exempt_reference},
              {"exempt_interfaces", options.check.exempt_interfaces},
              {"exempted_pairs", exempted_pairs(job)},
              {"rules", std::string(thresholds.rules->name)},
              {"rules_version", std::string(thresholds.rules->version)},
              {"radii", std::string(thresholds.radii)},
              {"radii_version", std::string(thresholds.radii_version)},
              {"rho", thresholds.rho ? Json(*thresholds.rho) : Json()},
              {"min_bonds", checker.min_bonds().heavy},
              {"min_bonds_hydrogen", checker.min_bonds().hydrogen},
              {"hydrogen_bonds", thresholds.hydrogen_bonds},
              {"hydrogen_bond_allowance", thresholds.hydrogen_bond_allowance},
              {"reference_collisions", checker.reference_collisions().size()},
              {"notes", all_notes(job)},
              {"with", options.with},
              {"placed", placed_json(job)},
              {"between", options.between},
              {"inside", options.inside}};
}

Json pair_json(const Job& job, const Contact& pair) {
  const Structure& structure = job.molecule->structure();
  const hinge::Hit& hit = pair.hit;
  const Severity of = severity(job, pair);
  Json json{{"i", atom(hit.first)},
            {"j", atom(hit.second)},
            {"label_i", label(structure, atom(hit.first))},
            {"label_j", label(structure, atom(hit.second))},
            {"distance", hit.distance},
            {"threshold", hit.threshold},
            {"collides", pair.collides},
            {"overlap", of.overlap}};
  const std::string_view rules = job.checker.thresholds().rules->name;
  if (has_classes(rules)) json["class"] = std::string(of.kind);
  if (has_relative_distance(rules))
    json["relative_distance"] = of.relative_distance ? Json(*of.relative_distance) : Json();
  return json;
}

Json constant_contacts_json(const Job& job) {
  Json list = Json::array();
  for (const hinge::Hit& hit : job.checker.constant_contacts()) list.push_back(pair_json(job, {hit, true}));
  return list;
}

Json closures_json(const Job& job, const std::vector<double>& residuals) {
  Json list = Json::array();
  for (std::size_t k = 0; k < residuals.size(); ++k)
    list.push_back({{"bond", job.molecule->model().tree().closures()[k].name}, {"residual", residuals[k]}});
  return list;
}

std::vector<std::string> closure_names(const Job& job) {
  std::vector<std::string> names;
  for (const hinge::Closure& closure : job.molecule->model().tree().closures()) names.push_back(closure.name);
  return names;
}

void print_closures(const Job& job, const std::vector<double>& residuals) {
  for (std::size_t k = 0; k < residuals.size(); ++k)
    fmt::print("  closure {:<34} worst residual {:.3g} angstrom\n", job.molecule->model().tree().closures()[k].name,
               residuals[k]);
}

bool lists_pairs(const Mode& mode) { return mode.kind == Mode::Kind::all || mode.kind == Mode::Kind::within; }

double rounded(double length) { return std::round(length * 1e3) / 1e3; }

Json verdict_json(const Job& job, std::uint64_t index, const Verdict& verdict, const Mode& mode) {
  Json json{{"index", index}, {"collides", verdict.collides}};
  if (lists_pairs(mode)) json["pairs"] = Json();
  if (mode.kind == Mode::Kind::closest) json["closest"] = verdict.closest ? pair_json(job, *verdict.closest) : Json();
  return json;
}

std::string csv_header(const Options& options, const std::string& more) {
  const std::string& rules = options.check.thresholds.rules;
  return fmt::format("{}{}{}{}\n", csv_columns, has_classes(rules) ? ",class" : "",
                     has_relative_distance(rules) ? ",relative_distance" : "", more);
}

std::string csv_rows(const Job& job, std::uint64_t index, const Verdict& verdict, std::size_t most_pairs) {
  const Structure& structure = job.molecule->structure();
  const std::string_view rules = job.checker.thresholds().rules->name;
  std::string rows;
  const auto add = [&](const Contact& pair) {
    const hinge::Hit& hit = pair.hit;
    const Severity of = severity(job, pair);
    fmt::format_to(std::back_inserter(rows), FMT_COMPILE("{},{:d},{},{},{},{},{},{},{:d},{}"), index, verdict.collides,
                   atom(hit.first), atom(hit.second), csv_field(label(structure, atom(hit.first))),
                   csv_field(label(structure, atom(hit.second))), hit.distance, hit.threshold, pair.collides,
                   of.overlap);
    if (has_classes(rules)) rows += fmt::format(",{}", of.kind);
    if (has_relative_distance(rules))
      rows += of.relative_distance ? fmt::format(",{}", *of.relative_distance) : std::string(",");
    rows += '\n';
  };
  for (std::size_t k = 0; k < std::min(most_pairs, verdict.pairs.size()); ++k) add(verdict.pairs[k]);
  if (verdict.closest) add(*verdict.closest);
  if (rows.empty())
    rows = fmt::format("{},{:d},,,,,,,,{}{}\n", index, verdict.collides, has_classes(rules) ? "," : "",
                       has_relative_distance(rules) ? "," : "");
  return rows;
}

std::string with_columns(const std::string& rows, const std::string& columns) {
  std::string text;
  for (std::size_t at = 0; at < rows.size();) {
    const std::size_t end = rows.find('\n', at);
    text.append(rows, at, end - at).append(columns) += '\n';
    at = end + 1;
  }
  return text;
}

void print_constant_contacts(const Job& job) {
  for (const hinge::Hit& hit : job.checker.constant_contacts())
    std::fprintf(stderr, "constant contact: %s\n", pair_sentence(job, {hit, true}).c_str());
}

void print_notes(const Job& job) {
  for (const std::string& note : all_notes(job)) std::fprintf(stderr, "note: %s\n", note.c_str());
  if (job.checker.thresholds().rules->name == "molprobity" && !has_hydrogens(job.molecule->structure()))
    std::fprintf(stderr, "note: rules molprobity: the structure has no hydrogens, but MolProbity adds them first\n");
  for (const std::string& note : job.kept.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  if (job.kept.held.empty()) return;
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, job.kept.held.size()); ++k)
    text += fmt::format(" {}", torsion_label(job.molecule->structure(), job.molecule->torsions()[job.kept.held[k]]));
  const bool one = job.kept.held.size() == 1;
  std::fprintf(stderr, "note: %s held by closed cycles and %s reference:%s%s\n",
               counted(job.kept.held.size(), "torsion is", "torsions are").c_str(),
               one ? "stays at its" : "stay at their", text.c_str(), job.kept.held.size() > most ? " ..." : "");
}

}  // namespace biocd
