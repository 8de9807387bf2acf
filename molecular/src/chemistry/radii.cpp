// SPDX-License-Identifier: BSD-3-Clause
// The radii sets, and the threshold table of biocd's rules.
#include "hinge/molecular/radii.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "chemistry/atom_traits.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "rules/hydrogen_bonds.hpp"

namespace hinge::molecular {

namespace {

/// Radii of elements without a class, angstrom: Bondi 1964, otherwise Mantina et al. 2009.
double element_radius(std::string_view element) {
  static constexpr std::array<std::pair<std::string_view, double>, 31> table{{
      {"H", 1.20},  {"He", 1.40}, {"Li", 1.82}, {"Be", 1.53}, {"B", 1.92},  {"F", 1.47},  {"Ne", 1.54}, {"Na", 2.27},
      {"Mg", 1.73}, {"Al", 1.84}, {"Si", 2.10}, {"Cl", 1.75}, {"Ar", 1.88}, {"K", 2.75},  {"Ca", 2.31}, {"Ni", 1.63},
      {"Cu", 1.40}, {"Zn", 1.39}, {"Ga", 1.87}, {"As", 1.85}, {"Se", 1.90}, {"Br", 1.85}, {"Kr", 2.02}, {"Sr", 2.49},
      {"Pd", 1.63}, {"Ag", 1.72}, {"Cd", 1.58}, {"I", 1.98},  {"Pt", 1.75}, {"Au", 1.66}, {"Hg", 1.55},
  }};
  for (const auto& [symbol, radius] : table)
    if (symbol == element) return radius;
  return 2.00;  // Bondi's value for metals without data
}

double bondi(AtomClass c, std::string_view element) {
  switch (c) {
    case AtomClass::carbon:
    case AtomClass::carbon_aromatic:
    case AtomClass::carbon_carbonyl: return 1.70;
    case AtomClass::nitrogen:
    case AtomClass::nitrogen_acceptor: return 1.55;
    case AtomClass::oxygen:
    case AtomClass::oxygen_hydroxyl: return 1.52;
    case AtomClass::sulphur: return 1.80;
    case AtomClass::phosphorus: return 1.80;
    case AtomClass::hydrogen:
    case AtomClass::hydrogen_alpha:
    case AtomClass::hydrogen_aromatic:
    case AtomClass::hydrogen_polar:
    case AtomClass::hydrogen_hydroxyl: return 1.20;
    case AtomClass::other: break;
  }
  return element_radius(element);
}

/// Probe's radii of other elements, for explicit and implicit hydrogens (angstrom). Metals are ions (Pauling, Shannon).
/// Elements that Probe lacks have Bondi's radii.
double probe_element_radius(std::string_view element) {
  static constexpr std::array<std::pair<std::string_view, double>, 36> table{{
      {"F", 1.30},  {"Cl", 1.77}, {"Br", 1.95}, {"I", 2.10},  {"As", 2.00}, {"Se", 1.90}, {"Li", 0.60}, {"Na", 0.95},
      {"Al", 0.50}, {"K", 1.33},  {"Mg", 0.65}, {"Ca", 0.99}, {"Mn", 0.80}, {"Fe", 0.74}, {"Co", 0.70}, {"Ni", 0.66},
      {"Cu", 0.72}, {"Zn", 0.71}, {"Rb", 1.48}, {"Sr", 1.10}, {"Mo", 0.93}, {"Ag", 1.26}, {"Cd", 0.91}, {"In", 0.81},
      {"Cs", 1.69}, {"Ba", 1.29}, {"Au", 1.10}, {"Hg", 1.00}, {"Tl", 1.44}, {"Pb", 0.84}, {"V", 0.79},  {"Cr", 0.73},
      {"W", 0.66},  {"Pt", 0.63}, {"U", 1.03},  {"B", 0.20},
  }};
  for (const auto& [symbol, radius] : table)
    if (symbol == element) return radius;
  return element_radius(element);
}

/// Probe's atomprops with explicit hydrogens at electron-cloud bond lengths, angstrom.
double probe_explicit(AtomClass c, std::string_view element) {
  switch (c) {
    case AtomClass::carbon_aromatic: return 1.75;
    case AtomClass::carbon_carbonyl: return 1.65;
    case AtomClass::oxygen:
    case AtomClass::oxygen_hydroxyl: return 1.40;
    case AtomClass::hydrogen:
    case AtomClass::hydrogen_alpha: return 1.22;
    case AtomClass::hydrogen_aromatic:
    case AtomClass::hydrogen_polar:
    case AtomClass::hydrogen_hydroxyl: return 1.05;
    case AtomClass::other: return probe_element_radius(element);
    default: return bondi(c, element);
  }
}

/// Probe's radii with implicit hydrogens (united atoms), angstrom.
double probe_united(AtomClass c, std::string_view element) {
  switch (c) {
    case AtomClass::carbon:
    case AtomClass::carbon_aromatic:
    case AtomClass::carbon_carbonyl: return 1.90;
    case AtomClass::nitrogen:
    case AtomClass::nitrogen_acceptor: return 1.70;
    case AtomClass::oxygen:
    case AtomClass::oxygen_hydroxyl: return 1.50;
    case AtomClass::sulphur: return 1.90;
    case AtomClass::other: return probe_element_radius(element);
    default: return bondi(c, element);
  }
}

/// AMBER ff99SB-ILDN: Rmin / 2 = sigma 2^(1/6) / 2, angstrom.
double amber(AtomClass c, std::string_view element) {
  switch (c) {
    case AtomClass::carbon:
    case AtomClass::carbon_aromatic:
    case AtomClass::carbon_carbonyl: return 1.908;
    case AtomClass::nitrogen:
    case AtomClass::nitrogen_acceptor: return 1.824;
    case AtomClass::oxygen: return 1.661;
    case AtomClass::oxygen_hydroxyl: return 1.721;
    case AtomClass::sulphur: return 2.000;
    case AtomClass::phosphorus: return 2.100;
    case AtomClass::hydrogen: return 1.487;
    case AtomClass::hydrogen_alpha: return 1.387;
    case AtomClass::hydrogen_aromatic: return 1.459;
    case AtomClass::hydrogen_polar: return 0.600;
    case AtomClass::hydrogen_hydroxyl: return 0.0;
    case AtomClass::other: break;
  }
  return element_radius(element);
}

}  // namespace

bool is_polar_hydrogen(AtomClass c) { return c == AtomClass::hydrogen_polar || c == AtomClass::hydrogen_hydroxyl; }
bool is_acceptor(AtomClass c) {
  return c == AtomClass::nitrogen_acceptor || c == AtomClass::oxygen || c == AtomClass::oxygen_hydroxyl ||
         c == AtomClass::sulphur;
}

std::string type_name(AtomClass c, const std::string& element) {
  switch (c) {
    case AtomClass::carbon: return "C";
    case AtomClass::carbon_aromatic: return "C.aromatic";
    case AtomClass::carbon_carbonyl: return "C.carbonyl";
    case AtomClass::nitrogen: return "N";
    case AtomClass::nitrogen_acceptor: return "N.acceptor";
    case AtomClass::oxygen: return "O";
    case AtomClass::oxygen_hydroxyl: return "O.hydroxyl";
    case AtomClass::sulphur: return "S";
    case AtomClass::phosphorus: return "P";
    case AtomClass::hydrogen: return "H";
    case AtomClass::hydrogen_alpha: return "H.alpha";
    case AtomClass::hydrogen_aromatic: return "H.aromatic";
    case AtomClass::hydrogen_polar: return "H.polar";
    case AtomClass::hydrogen_hydroxyl: return "H.hydroxyl";
    case AtomClass::other: break;
  }
  return element;
}

const std::vector<RadiiSet>& radii_sets() {
  static const std::vector<RadiiSet> sets{
      {"bondi", "1", "Bondi, J. Phys. Chem. 68:441 (1964); Mantina et al. (2009)", 4, bondi},
      {"probe", "5", "Probe, explicit hydrogens, electron-cloud positions", 4, probe_explicit},
      // United atoms and AMBER's Rmin overlap at a distance of four bonds in every native structure (above all
      // O(i)...C(i+1)), so pairs count from five bonds on.
      {"probe-united", "2", "Probe, implicit hydrogens", 5, probe_united},
      {"amber", "2", "AMBER ff99SB-ILDN Rmin/2", 5, amber},
  };
  return sets;
}

const RadiiSet& radii_set(std::string_view name) {
  std::string names;
  for (const RadiiSet& set : radii_sets()) {
    if (set.name == name) return set;
    names += (names.empty() ? "" : ", ") + std::string(set.name);
  }
  throw ModelError("radii set '" + std::string(name) + "': expected one of " + names);
}

Thresholds make_thresholds(const Structure& structure, const ThresholdOptions& options) {
  std::string named = options.rules;
  if (named == "auto") named = has_hydrogens(structure) && !options.choose_biocd() ? "severe" : "biocd";
  const ClashRules& rules = clash_rules(named);
  if (rules.name != "biocd") {
    if (options.choose_biocd())
      throw ModelError("clash rules " + options.rules +
                       " set the radii, rho and the hydrogen-bond rule themselves, expected no option for them");
    return make_named_thresholds(structure, rules);
  }
  const RadiiSet& set = radii_set(options.radii.value_or("bondi"));
  const double rho = options.rho.value_or(0.8), allowance = options.hydrogen_bond_allowance.value_or(0.4);
  if (!is_finite(rho) || rho <= 0.0) throw ModelError("rho " + number_text(rho) + ": expected a finite number above 0");
  if (!is_finite(allowance) || allowance < 0.0)
    throw ModelError("hydrogen-bond allowance " + number_text(allowance) +
                     ": expected a finite length >= 0 (angstrom)");
  const std::vector<AtomClass> classes = set.name == "probe" ? probe_classes(structure) : classify_atoms(structure);
  const bool hydrogens = has_hydrogens(structure);
  const bool rule = options.hydrogen_bonds.value_or(hydrogens);
  // Explicit hydrogens tell which atoms form hydrogen bonds; without them the roles of heavy atoms do.
  std::vector<HydrogenBondRole> roles(classes.size());
  if (rule && !hydrogens) roles = hydrogen_bond_roles(structure);

  // Types: the classes that occur, in class order, and one per element of class `other`.
  using Type = std::tuple<AtomClass, std::string, HydrogenBondRole>;
  std::map<Type, std::uint16_t> type_of;
  const auto key = [&](std::size_t i) {
    return Type(classes[i], classes[i] == AtomClass::other ? structure.atoms[i].element : std::string(), roles[i]);
  };
  for (std::size_t i = 0; i < classes.size(); ++i) type_of.emplace(key(i), 0);
  std::vector<Type> types;
  for (auto& [type, number] : type_of) {
    number = static_cast<std::uint16_t>(types.size());
    types.push_back(type);
  }
  std::vector<std::uint16_t> atom_types(classes.size());
  for (std::size_t i = 0; i < classes.size(); ++i) atom_types[i] = type_of.at(key(i));

  Thresholds made;
  for (const auto& [c, element, role] : types) {
    made.type_names.push_back(type_name(c, element) + (role.donor ? ".donor" : "") +
                              (role.acceptor ? ".acceptor" : ""));
    for (const auto& [d, other, role_of_other] : types) {
      const double sum = set.radius(c, element) + set.radius(d, other);
      double m = rho * sum;
      const bool bonding = (is_polar_hydrogen(c) && is_acceptor(d)) || (is_polar_hydrogen(d) && is_acceptor(c)) ||
                           (role.donor && role_of_other.acceptor) || (role.acceptor && role_of_other.donor);
      if (rule && bonding) m = std::max(0.0, m - allowance);
      made.table.push_back(m);
      made.contact.push_back(sum);
      made.allowance.push_back(0.0);
    }
  }
  made.matrix = TypedThresholds(std::move(atom_types), types.size(), made.table);
  made.rules = &rules;
  made.radii = set.name;
  made.radii_version = set.version;
  made.rho = rho;
  made.hydrogen_bonds = rule;
  made.hydrogen_bond_allowance = allowance;
  made.min_bonds = set.default_min_bonds;
  return made;
}

}  // namespace hinge::molecular
