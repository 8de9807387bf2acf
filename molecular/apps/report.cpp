// SPDX-License-Identifier: BSD-3-Clause
// Shared parts of the outputs.
#include "report.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "hinge/core/id.hpp"
#include "hinge/tool/csv_field.hpp"
#include "scene.hpp"

namespace biocd {

namespace {

using hinge::molecular::Checker;
using hinge::molecular::Contact;
using hinge::molecular::Mode;
using hinge::molecular::Structure;
using hinge::molecular::Verdict;
using hinge::tool::csv_field;

std::uint32_t atom(hinge::PrimitiveId i) { return static_cast<std::uint32_t>(hinge::index(i)); }

}  // namespace

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
              {"free", options.free},
              {"omega", options.omega},
              {"dof", checker.dof_count()},
              {"rigid_groups", checker.rigid_group_count()},
              {"closures", job.molecule->model().tree().closures().size()},
              {"loops", options.loop},
              {"held_torsions", job.held.size()},
              {"excluded_pairs", checker.exclusions().excluded_pairs()},
              {"exempt_reference", options.check.exempt_reference},
              {"radii", std::string(thresholds.set->name)},
              {"radii_version", std::string(thresholds.set->version)},
              {"rho", thresholds.rho},
              {"min_bonds", checker.min_bonds()},
              {"hydrogen_bonds", thresholds.hydrogen_bonds},
              {"hydrogen_bond_allowance", options.check.thresholds.hydrogen_bond_allowance},
              {"reference_collisions", checker.reference_collisions().size()},
              {"with", options.with},
              {"placed", placed_json(job)},
              {"between", options.between},
              {"inside", options.inside}};
}

Json pair_json(const Structure& structure, const Contact& pair) {
  const hinge::Hit& hit = pair.hit;
  return Json{{"i", atom(hit.first)},
              {"j", atom(hit.second)},
              {"label_i", label(structure, atom(hit.first))},
              {"label_j", label(structure, atom(hit.second))},
              {"distance", hit.distance},
              {"threshold", hit.threshold},
              {"collides", pair.collides}};
}

Json constant_contacts_json(const Job& job) {
  Json list = Json::array();
  for (const hinge::Hit& hit : job.checker.constant_contacts())
    list.push_back(pair_json(job.molecule->structure(), {hit, true}));
  return list;
}

Json closures_json(const Job& job, const std::vector<double>& residuals) {
  Json list = Json::array();
  for (std::size_t k = 0; k < residuals.size(); ++k)
    list.push_back({{"bond", job.molecule->model().tree().closures()[k].name}, {"residual", residuals[k]}});
  return list;
}

Json verdict_json(const Structure& structure, std::uint64_t index, const Verdict& verdict, const Mode& mode) {
  Json json{{"index", index}, {"collides", verdict.collides}};
  if (mode.kind == Mode::Kind::all || mode.kind == Mode::Kind::within) {
    Json pairs = Json::array();
    for (const Contact& pair : verdict.pairs) pairs.push_back(pair_json(structure, pair));
    json["pairs"] = std::move(pairs);
  }
  if (mode.kind == Mode::Kind::closest)
    json["closest"] = verdict.closest ? pair_json(structure, *verdict.closest) : Json();
  return json;
}

std::string csv_header(const std::string& more) {
  return "index,collides,i,j,label_i,label_j,distance,threshold,pair_collides" + more + "\n";
}

std::string csv_rows(const Structure& structure, std::uint64_t index, const Verdict& verdict) {
  std::string rows;
  const auto add = [&](const Contact& pair) {
    const hinge::Hit& hit = pair.hit;
    rows += fmt::format("{},{:d},{},{},{},{},{},{},{:d}\n", index, verdict.collides, atom(hit.first), atom(hit.second),
                        csv_field(label(structure, atom(hit.first))), csv_field(label(structure, atom(hit.second))),
                        hit.distance, hit.threshold, pair.collides);
  };
  for (const Contact& pair : verdict.pairs) add(pair);
  if (verdict.closest) add(*verdict.closest);
  if (rows.empty()) rows = fmt::format("{},{:d},,,,,,,\n", index, verdict.collides);
  return rows;
}

std::string pair_line(const Structure& structure, const Contact& pair) {
  const hinge::Hit& hit = pair.hit;
  return fmt::format("  {:<18} {:<18} {:8.3f} {} {:.3f}", label(structure, atom(hit.first)),
                     label(structure, atom(hit.second)), hit.distance, pair.collides ? "<" : ">=", hit.threshold);
}

std::string heading(const Options& options, const Job& job) {
  const Structure& s = job.molecule->structure();
  const Checker& checker = job.checker;
  const auto& thresholds = checker.thresholds();
  std::string text = fmt::format(
      "{}: {} atoms, {} residues, {} chains, {} bonds\nselection {}{}{}: {} DOF, {} rigid groups, {} closures\n"
      "rule: d < {} * ({} v{} radii), pairs at least {} bonds apart, hydrogen-bond rule {}{}\n",
      options.file, s.atoms.size(), s.residues.size(), s.chains.size(), s.bonds.size(), options.free,
      options.omega ? " with omega" : "", options.loop.empty() ? "" : " and loop " + options.loop, checker.dof_count(),
      checker.rigid_group_count(), job.molecule->model().tree().closures().size(), thresholds.rho, thresholds.set->name,
      thresholds.set->version, checker.min_bonds(), thresholds.hydrogen_bonds ? "on" : "off",
      options.check.exempt_reference ? ", reference collisions exempt" : "");
  text += scene_lines(options, job);
  text += fmt::format("reference: {} colliding pairs; constant contacts under this selection: {}\n",
                      checker.reference_collisions().size(), checker.constant_contacts().size());
  for (const hinge::Hit& hit : checker.constant_contacts()) text += pair_line(s, {hit, true}) + "  (constant)\n";
  return text;
}

void print_constant_contacts(const Job& job) {
  for (const hinge::Hit& hit : job.checker.constant_contacts())
    std::fprintf(stderr, "constant contact: %s\n", pair_line(job.molecule->structure(), {hit, true}).c_str());
}

void print_notes(const Job& job) {
  for (const std::string& note : job.molecule->structure().notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  for (const std::string& note : job.molecule->notes()) std::fprintf(stderr, "note: %s\n", note.c_str());
  for (const std::size_t k : job.held) {
    const auto& torsion = job.molecule->torsions()[k];
    std::fprintf(stderr, "note: torsion %s of %s: held by closed cycles, stays at its reference\n",
                 torsion.name.c_str(), label(job.molecule->structure(), torsion.atoms[1]).c_str());
  }
}

}  // namespace biocd
