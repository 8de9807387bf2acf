// SPDX-License-Identifier: BSD-3-Clause
// biocd info: shows the content of a file and the DOF, rigid groups and constant contacts under a selection.
#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <numbers>
#include <string>

#include "hinge/molecular/summary.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/json_text.hpp"
#include "options.hpp"
#include "pair_table.hpp"
#include "report.hpp"
#include "rigid_ensemble.hpp"

namespace biocd {

namespace {

using namespace hinge::molecular;
using hinge::tool::counted;
using hinge::tool::noun_of;

const char* origin_name(BondOrigin origin) {
  switch (origin) {
    case BondOrigin::residue_template: return "residue template";
    case BondOrigin::peptide: return "peptide";
    case BondOrigin::phosphodiester: return "phosphodiester";
    case BondOrigin::disulphide: return "disulphide";
    case BondOrigin::record: return "record";
    case BondOrigin::component: return "component";
    case BondOrigin::covalent_radii: break;
  }
  return "covalent radii";
}

std::string text_or_empty(char c) { return c == '\0' ? std::string() : std::string(1, c); }

Json atoms_json(const Job& job) {
  const Structure& s = job.molecule->structure();
  const Thresholds& t = job.checker.thresholds();
  Json list = Json::array();
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) {
    const Atom& atom = s.atoms[i];
    const Residue& residue = s.residues[atom.residue];
    const auto& x = s.models.front()[i];
    list.push_back(Json{{"index", i},
                        {"name", atom.name},
                        {"residue", residue.name},
                        {"seq", residue.sequence_number},
                        {"icode", text_or_empty(residue.insertion_code)},
                        {"chain", s.chains[residue.chain].name},
                        {"element", atom.element},
                        {"type", t.type_names[t.matrix.type(hinge::id<hinge::PrimitiveId>(i))]},
                        {"x", x[0]},
                        {"y", x[1]},
                        {"z", x[2]},
                        {"group", hinge::index(job.checker.group_of(i))}});
  }
  return list;
}

Json bonds_json(const Structure& s) {
  Json list = Json::array();
  for (const Bond& bond : s.bonds) list.push_back({bond.first, bond.second});
  return list;
}

Json thresholds_json(const Thresholds& t) {
  Json list = Json::array();
  for (std::size_t a = 0; a < t.type_names.size(); ++a)
    for (std::size_t b = a; b < t.type_names.size(); ++b)
      list.push_back({t.type_names[a], t.type_names[b], t.between(a, b)});
  return list;
}

void print_table(const Options& options, const Job& job) {
  const Structure& s = job.molecule->structure();
  fmt::print("{}", heading(options, job));
  fmt::print("models: {}; waters left out: {}; hetero atoms left out: {}\n", s.models.size(), s.waters_dropped,
             s.hetero_dropped);
  for (const auto& [name, of_class] : residues_by_class(s)) {
    fmt::print("{}: {}, {}", name, counted(of_class.residues, "residue"), noun_of(of_class.chains.size(), "chain"));
    for (const auto& [chain, count] : of_class.chains) fmt::print(" {}", chain);
    const bool polymer = name == "protein" || name == "DNA" || name == "RNA";
    for (const auto& [residue, count] : of_class.names)
      if (!polymer) fmt::print("{} {} x{}", residue == of_class.names.begin()->first ? ";" : ",", residue, count);
    fmt::print("\n");
  }
  std::map<BondOrigin, std::size_t> origins;
  for (const Bond& bond : s.bonds) ++origins[bond.origin];
  for (const auto& [origin, count] : origins) fmt::print("bonds from {}: {}\n", origin_name(origin), count);
  fmt::print("torsions:");
  for (const auto& [name, count] : torsions_by_kind(s, job.molecule->torsions())) fmt::print(" {} {}", name, count);
  fmt::print("\nexcluded pairs: {}; secondary structure elements: {}\n", job.checker.exclusions().excluded_pairs(),
             s.secondary_structure.size());
  if (job.ensemble) fmt::print("{}", rigid_groups_text(options, job));
  fmt::print("{}", pair_table(options, job, contacts(job.checker.reference_collisions()), true, "  (reference)"));
}

}  // namespace

Exit run_info(const Options& options) {
  const Job job = load(options);
  print_notes(job);
  if (!options.explain.empty()) {
    explain(options, job);
  } else if (options.output == Output::json) {
    const Structure& s = job.molecule->structure();
    Json json{{"tool", "biocd"}, {"command", "info"}, {"model", model_json(options, job)}};
    json["notes"] = s.notes;
    for (const std::string& note : job.molecule->notes()) json["notes"].push_back(note);
    for (const std::string& note : job.selected.notes) json["notes"].push_back(note);
    for (const auto& [name, of_class] : residues_by_class(s))
      json["residue_classes"][name] = {
          {"residues", of_class.residues}, {"chains", of_class.chains}, {"names", of_class.names}};
    json["torsions"] = torsions_by_kind(s, job.molecule->torsions());
    json["bond_sources"] = Json::array();
    for (const BondSource& source : s.bond_sources)
      json["bond_sources"].push_back({{"residue", source.residue}, {"source", source.source}, {"count", source.count}});
    if (job.ensemble) json["rigid_ensemble"] = rigid_groups_json(options, job);
    json["constant_contacts"] = constant_contacts_json(job);
    if (options.atoms) {
      json["atoms"] = atoms_json(job);
      json["dofs"] = dofs_json(job);
      json["bonds"] = bonds_json(s);
      json["thresholds"] = thresholds_json(job.checker.thresholds());
    }
    fmt::print("{}\n", hinge::tool::json_text(json, 1));
  } else {
    print_table(options, job);
  }
  return Exit::free;
}

}  // namespace biocd
