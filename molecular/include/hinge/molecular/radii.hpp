// SPDX-License-Identifier: BSD-3-Clause
// Radii sets and atom types: from a structure to the thresholds M = rho * d0 by atom type (BioCD section II-C).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/molecular/clash_rules.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/policy/distance_matrix.hpp"

namespace hinge::molecular {

/// What distinguishes atoms in some radii set; `other` atoms are told apart by element.
enum class AtomClass : std::uint8_t {
  carbon,             ///< aliphatic
  carbon_aromatic,    ///< planar ring
  carbon_carbonyl,    ///< bonded to an oxygen that has no other bond
  nitrogen,           ///< cannot accept a hydrogen bond: bears hydrogen, or is bonded three times
  nitrogen_acceptor,  ///< two heavy neighbours at most and no hydrogen in a residue with hydrogens
  oxygen,
  oxygen_hydroxyl,  ///< bears a hydrogen, or single-bonded in SER, THR, TYR
  sulphur,
  phosphorus,
  hydrogen,        ///< bonded to aliphatic carbon
  hydrogen_alpha,  ///< bonded to carbon that is bonded to N, O or S
  hydrogen_aromatic,
  hydrogen_polar,     ///< bonded to N or S
  hydrogen_hydroxyl,  ///< bonded to O
  other
};

/// A named, versioned set of radii (angstrom). d0 of a pair is the sum of its radii.
struct RadiiSet {
  std::string_view name;     ///< as on the command line
  std::string_view version;  ///< changes whenever a number does
  std::string_view source;
  int default_min_bonds;  ///< bond distance at which a pair starts to count unless the user says otherwise
  double (*radius)(AtomClass, std::string_view element);
};

/// bondi, probe, probe-united, amber.
const std::vector<RadiiSet>& radii_sets();

/// ModelError, listing the names, when there is none of that name.
const RadiiSet& radii_set(std::string_view name);

/// One class per atom, from elements, bonds and residues.
std::vector<AtomClass> classify_atoms(const Structure& structure);

/// Rules and radii. By default those are `severe` for a structure with hydrogens, `biocd` for one without, or as soon
/// as one of the options of biocd is given.
struct ThresholdOptions {
  std::optional<std::string> radii{};    ///< none: bondi
  std::optional<double> rho{};           ///< M = rho * d0; finite, > 0; none: 0.8
  std::optional<bool> hydrogen_bonds{};  ///< hydrogen-bond rule; none: on when the structure has hydrogens
  /// Angstrom, taken from M(polar H, acceptor N, O or S), in a structure without hydrogens from M(N, O or S that may
  /// bear one, acceptor). None: 0.4.
  std::optional<double> hydrogen_bond_allowance{};
  std::string rules = "auto";  ///< or one of all_clash_rules(); others than biocd's fix all of the above

  /// Is one of the options of biocd given?
  bool choose_biocd() const noexcept { return radii || rho || hydrogen_bonds || hydrogen_bond_allowance; }
};

/// Thresholds with what is needed to print them. Tables are type x type, row-major, angstrom.
struct Thresholds {
  TypedThresholds matrix{{}, 0, {}};
  std::vector<std::string> type_names{};  ///< per type: "C", "C.aromatic", "H.polar", "Zn"
  std::vector<double> table{};
  std::vector<double> contact{};    ///< distance of two atoms whose overlap is 0 (Severity)
  std::vector<double> allowance{};  ///< for a hydrogen bond, already taken off contact
  const ClashRules* rules = nullptr;
  std::string_view radii{}, radii_version{};
  std::optional<double> rho{};  ///< none: the rules are not M = rho * d0
  bool hydrogen_bonds = false;
  double hydrogen_bond_allowance = 0.0;  ///< angstrom
  MinBonds min_bonds{4};                 ///< unless the user says otherwise

  double between(std::size_t s, std::size_t t) const noexcept { return table[s * type_names.size() + t]; }
};

/// ModelError: unknown rules or set, rho or allowance out of range, or chosen beside rules that fix them.
Thresholds make_thresholds(const Structure& structure, const ThresholdOptions& options = {});

}  // namespace hinge::molecular
