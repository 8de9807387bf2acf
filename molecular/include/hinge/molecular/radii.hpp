// SPDX-License-Identifier: BSD-3-Clause
// Radii sets and atom types: from a structure to the thresholds M = rho * d0 of pairs of types (BioCD section II-C).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/clash_rules.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/policy/distance_matrix.hpp"

namespace hinge::molecular {

/// Atom classes that radii sets distinguish (classify_atoms). Atoms of class `other` are distinguished by element.
enum class AtomClass : std::uint8_t {
  carbon,             ///< any other carbon
  carbon_aromatic,    ///< in a ring of Phe, Tyr, Trp or His; radii set probe: also of a base or haem
  carbon_carbonyl,    ///< at most three covalent bonds, one to an oxygen that has no other bond and is not a hydroxyl
  nitrogen,           ///< any other nitrogen, as one that bears a hydrogen or has three bonds
  nitrogen_acceptor,  ///< two heavy neighbours and no hydrogen, in a structure with hydrogens: accepts hydrogen bonds
  oxygen,
  oxygen_hydroxyl,  ///< with a hydrogen, explicit or implied: SER, THR, TYR, sugars, ligands' terminal C-O
  sulphur,
  phosphorus,
  hydrogen,        ///< any other hydrogen, as one bonded to aliphatic carbon
  hydrogen_alpha,  ///< bonded to carbon that has a neighbour N, O or S
  hydrogen_aromatic,
  hydrogen_polar,     ///< bonded to N or S
  hydrogen_hydroxyl,  ///< bonded to O
  other
};

/// A named, versioned set of radii in angstrom. d0 of a pair is the sum of its two radii.
struct RadiiSet {
  std::string_view name;     ///< name on the command line
  std::string_view version;  ///< changes with every change of a number
  std::string_view source;   ///< publication or program
  int default_min_bonds;     ///< default number of bonds from which a pair counts (MinBonds)
  double (*radius)(AtomClass, std::string_view element);  ///< angstrom
};

/// The sets bondi, probe, probe-united and amber; a static object.
HINGE_API const std::vector<RadiiSet>& radii_sets();

/// Returns the set of this name; a static object. Throws ModelError, with the known names, if there is none.
HINGE_API const RadiiSet& radii_set(std::string_view name);

/// Returns one class per atom, from elements, bonds, residues and the coordinates of the first model.
HINGE_API std::vector<AtomClass> classify_atoms(const Structure& structure);

/// Clash rules and radii. The default rules are `severe` for a structure with hydrogens. They are `biocd` for a
/// structure without hydrogens, and if any option of biocd is set.
struct ThresholdOptions {
  std::optional<std::string> radii{};    ///< radii set of biocd; nullopt: bondi
  std::optional<double> rho{};           ///< M = rho * d0; finite, > 0; nullopt: 0.8
  std::optional<bool> hydrogen_bonds{};  ///< use the hydrogen-bond rule; nullopt: if the structure has hydrogens
  /// Angstrom >= 0, subtracted from M of a polar H and an acceptor N, O or S. In a structure without hydrogens: from M
  /// of a donor and an acceptor among N, O and S. nullopt: 0.4.
  std::optional<double> hydrogen_bond_allowance{};
  std::string rules = "auto";  ///< "auto" or a name in all_clash_rules(); rules other than biocd fix all options above

  /// True if an option of biocd is set.
  bool choose_biocd() const noexcept { return radii || rho || hydrogen_bonds || hydrogen_bond_allowance; }
};

/// The thresholds of a structure and the data to report them. Tables are type x type, row-major, angstrom.
struct Thresholds {
  TypedThresholds matrix{{}, 0, {}};      ///< distance matrix: a type per atom, a threshold per pair of types
  std::vector<std::string> type_names{};  ///< name of each type: "C", "C.aromatic", "H.polar", "Zn"
  std::vector<double> table{};            ///< thresholds M
  std::vector<double> contact{};          ///< distance at which the overlap of two atoms is 0 (Severity)
  std::vector<double> allowance{};        ///< allowance for a hydrogen bond, already subtracted from `contact`
  const ClashRules* rules = nullptr;      ///< static object
  std::string_view radii{};               ///< name of the radii set in use
  std::string_view radii_version{};       ///< version of the radii set in use
  std::optional<double> rho{};            ///< nullopt: the rules are not M = rho * d0
  bool hydrogen_bonds = false;            ///< the hydrogen-bond rule is in use
  double hydrogen_bond_allowance = 0.0;   ///< angstrom
  MinBonds min_bonds{4};                  ///< default of the rules or the radii set

  /// Threshold of types s and t, angstrom; both below type_names.size().
  double between(std::size_t s, std::size_t t) const noexcept { return table[s * type_names.size() + t]; }
};

/// Returns the thresholds of a structure. Throws ModelError if the rules or the radii set are unknown, rho or the
/// allowance is out of range, or one of them is set together with rules that fix it.
HINGE_API Thresholds make_thresholds(const Structure& structure, const ThresholdOptions& options = {});

}  // namespace hinge::molecular
