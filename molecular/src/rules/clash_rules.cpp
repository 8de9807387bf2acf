// SPDX-License-Identifier: BSD-3-Clause
// Defines the named clash rules and computes thresholds that reproduce their verdicts.
#include "hinge/molecular/clash_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "chemistry/atom_traits.hpp"
#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

/// Angstrom, added to thresholds. MolProbity and ChimeraX count an overlap equal to the cutoff as a clash; the engines
/// test d < M. Coordinates and radii are multiples of 0.001, so a distance that is not equal to a sum of radii differs
/// from it by at least 1e-7. Thresholds may have nine decimals.
constexpr double included = 1e-9;

constexpr double molprobity_cutoff = 0.4;        // angstrom of overlap: Probe's "bad overlap", MolProbity's clash
constexpr double severe_cutoff = 0.9;            // angstrom of overlap: no bond or hydrogen bond explains it
constexpr double molprobity_regular_bond = 0.6;  // angstrom of overlap that Probe allows for a hydrogen bond
constexpr double molprobity_charged_bond = 0.8;  // the same, between opposite charges
constexpr double chimerax_cutoff = 0.6;          // angstrom of overlap: default of the command `clashes`
constexpr double chimerax_bond = 0.4;            // angstrom: default hbondAllowance of `clashes`
constexpr double posebusters_relative_distance = 0.75;  // PoseBusters' clash_cutoff

/// Returns the double nearest to x rounded to nine decimals.
double decimal(double x) { return std::round(x * 1e9) / 1e9; }

bool may_bond(const AtomTraits& a, const AtomTraits& b) { return (a.donor && b.acceptor) || (b.donor && a.acceptor); }

/// The distances that a rule assigns to two atom types, angstrom.
struct Entry {
  double contact = 0.0;    ///< distance of overlap 0
  double allowance = 0.0;  ///< subtracted for a hydrogen bond
  double threshold = 0.0;
};

Entry probe_overlap(const AtomTraits& a, const AtomTraits& b, double cutoff) {
  double allowance = 0.0;
  // Charges of the same sign make no hydrogen bond.
  if (may_bond(a, b) && a.charge * b.charge <= 0)
    allowance = a.charge * b.charge < 0 ? molprobity_charged_bond : molprobity_regular_bond;
  const double contact = a.radius + b.radius - allowance;
  return {contact, allowance, contact - cutoff + included};
}
Entry molprobity(const AtomTraits& a, const AtomTraits& b) { return probe_overlap(a, b, molprobity_cutoff); }
Entry severe(const AtomTraits& a, const AtomTraits& b) { return probe_overlap(a, b, severe_cutoff); }

Entry chimerax(const AtomTraits& a, const AtomTraits& b) {
  const double allowance = may_bond(a, b) ? chimerax_bond : 0.0;
  const double contact = a.radius + b.radius - allowance;
  return {contact, allowance, contact - chimerax_cutoff + included};
}

Entry posebusters(const AtomTraits& a, const AtomTraits& b) {
  if (a.ignored || b.ignored) return {};
  const double sum = a.ion || b.ion ? a.covalent_radius + b.covalent_radius : a.radius + b.radius;
  return {sum, 0.0, posebusters_relative_distance * sum};
}

std::string full_name(const AtomTraits& atom) {
  std::string name = atom.name;
  if (atom.donor) name += ".donor";
  if (atom.acceptor) name += ".acceptor";
  if (atom.charge != 0) name += atom.charge > 0 ? ".plus" : ".minus";
  if (atom.ion) name += ".ion";
  return name;
}

}  // namespace

const std::vector<ClashRules>& all_clash_rules() {
  static const std::vector<ClashRules> rules{
      {"biocd", "1", "Ruiz de Angulo, Cortes, Simeon, RSS 2005, eq. (1)", "", "", 4, true, 0.0},
      {"severe",
       "1",
       "overlap of 0.9 angstrom as Probe measures it: the default with hydrogens",
       "probe",
       "5",
       {4, 5},
       true,
       molprobity_regular_bond},
      {"molprobity",
       "2",
       "Word et al., J. Mol. Biol. 285:1711 (1999); Probe's defaults, clashes as MolProbity counts them",
       "probe",
       "5",
       {4, 5},
       true,
       molprobity_regular_bond},
      {"chimerax", "1", "UCSF ChimeraX, command clashes with its defaults", "chimerax", "1", 5, false, chimerax_bond},
      {"posebusters", "1", "Buttenschoen et al., Chem. Sci. 15:3130 (2024); minimum distances", "rdkit", "1", 4, true,
       0.0},
  };
  return rules;
}

const ClashRules& clash_rules(std::string_view name) {
  std::string names;
  for (const ClashRules& rules : all_clash_rules()) {
    if (rules.name == name) return rules;
    names += (names.empty() ? "" : ", ") + std::string(rules.name);
  }
  throw ModelError("clash rules '" + std::string(name) + "': expected one of " + names);
}

Thresholds make_named_thresholds(const Structure& structure, const ClashRules& rules) {
  const auto [atoms,
              entry] = [&]() -> std::pair<std::vector<AtomTraits>, Entry (*)(const AtomTraits&, const AtomTraits&)> {
    if (rules.name == "severe") return {molprobity_atoms(structure), severe};
    if (rules.name == "molprobity") return {molprobity_atoms(structure), molprobity};
    if (rules.name == "chimerax") return {chimerax_atoms(structure), chimerax};
    return {posebusters_atoms(structure), posebusters};
  }();
  std::map<AtomTraits, std::uint16_t> type_of;
  for (const AtomTraits& atom : atoms) type_of.emplace(atom, 0);
  Thresholds made;
  for (auto& [traits, number] : type_of) {
    number = static_cast<std::uint16_t>(made.type_names.size());
    made.type_names.push_back(full_name(traits));
    for (const auto& [other, unused] : type_of) {
      const Entry e = entry(traits, other);
      made.table.push_back(std::max(0.0, decimal(e.threshold)));
      made.contact.push_back(decimal(e.contact));
      made.allowance.push_back(e.allowance);
    }
  }
  std::vector<std::uint16_t> types;
  types.reserve(atoms.size());
  for (const AtomTraits& atom : atoms) types.push_back(type_of.at(atom));
  made.matrix = TypedThresholds(std::move(types), made.type_names.size(), made.table);
  made.hydrogen_bonds = rules.hydrogen_bond_allowance > 0.0;
  made.hydrogen_bond_allowance = rules.hydrogen_bond_allowance;
  made.rules = &rules;
  made.radii = rules.radii;
  made.radii_version = rules.radii_version;
  made.rho.reset();
  made.min_bonds = rules.min_bonds;
  return made;
}

}  // namespace hinge::molecular
