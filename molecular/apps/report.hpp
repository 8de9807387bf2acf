// SPDX-License-Identifier: BSD-3-Clause
// Shared parts of the outputs of all commands. The JSON keys are a contract: docs/reference/biocd.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge/policy/collector.hpp"
#include "options.hpp"

namespace biocd {

/// JSON; keys keep the order in which they are written.
using Json = nlohmann::ordered_json;

/// Returns the molecule, the selection and the rules: the key `model` of every output.
Json model_json(const Options& options, const Job& job);
/// Returns a pair: atoms, distance and threshold (angstrom), and its class under the rules.
Json pair_json(const Job& job, const hinge::molecular::Contact& pair);
/// Returns the pairs that collide at every configuration of the selection.
Json constant_contacts_json(const Job& job);
/// Returns the closures by name with their residuals (angstrom). residuals: one per closure, or none for an empty list.
Json closures_json(const Job& job, const std::vector<double>& residuals);
/// Returns the name of a DOF, such as "A:LYS77:chi1" or "move B x".
std::string dof_label(const Job& job, hinge::DofId dof);
/// Returns true if the DOF is revolute (rad), false if it is prismatic (angstrom).
bool turns(const Job& job, hinge::DofId dof);
/// Converts a configuration for output: revolute DOF from rad to degrees; moves of placed parts stay in angstrom.
std::vector<double> in_degrees(const Job& job, std::vector<double> q);

/// Like in_degrees, but torsions are dihedral angles in (-180, 180], not turns from the reference.
std::vector<double> torsion_values(const Job& job, std::vector<double> q);
/// Returns [{torsion, reference_degrees}], one per selected DOF, in configuration order.
Json dofs_json(const Job& job);

/// Returns the names of the closures, in the order of the tree.
std::vector<std::string> closure_names(const Job& job);
/// Prints one line per closure. residuals: the worst of each closure (angstrom), or empty for no lines.
void print_closures(const Job& job, const std::vector<double>& residuals);
/// Rounds a length to thousandths: superposed coordinates differ in their last bits between instruction sets.
double rounded(double length);
/// Returns true if the mode asks for a list of pairs.
bool lists_pairs(const hinge::molecular::Mode& mode);
/// Returns one conformation's verdict. Its member `pairs`, if the mode lists pairs, is null: PairText writes them.
Json verdict_json(const Job& job, std::uint64_t index, const hinge::molecular::Verdict& verdict,
                  const hinge::molecular::Mode& mode);

/// Returns true if the rules have classes, or relative distances, of pairs.
bool has_classes(std::string_view rules);
bool has_relative_distance(std::string_view rules);

/// Columns of every CSV file. A conformation has one row per pair, or one row with empty fields if it has no pair.
inline constexpr const char* csv_columns =
    "index,collides,i,j,label_i,label_j,distance,threshold,pair_collides,overlap";
/// Returns the header line: csv_columns, the columns of the rules, and `more`: further columns, each after a comma.
std::string csv_header(const Options& options, const std::string& more);
/// Returns the CSV rows of one conformation, each with a line end. most_pairs: further pairs have no row.
std::string csv_rows(const Job& job, std::uint64_t index, const hinge::molecular::Verdict& verdict,
                     std::size_t most_pairs);

/// Returns the rows with `columns` appended to each; every column starts with a comma.
std::string with_columns(const std::string& rows, const std::string& columns);

/// Returns the question in words, as names and values: what is free, the rules, what was left out.
std::vector<std::pair<std::string, std::string>> question_words(const Options& options, const Job& job);

/// Returns the number of reference collisions that are exempt: all others are admitted.
std::size_t exempted_pairs(const Job& job);

/// Returns the notes of loader, builder and selection.
std::vector<std::string> all_notes(const Job& job);

/// Returns the heading of tables: the file, the selection, the rules and the constant contacts.
std::string heading(const Options& options, const Job& job);

/// Prints the constant contacts to standard error, for formats that have no field for them.
void print_constant_contacts(const Job& job);

/// Returns the residues that were left out, such as "left out: ACT x1, 333 waters (--hetero keeps ...)" with a line
/// end, or an empty text.
std::string left_out_line(const hinge::molecular::Structure& structure);
/// Prints left_out_line to standard error for CSV, which has no field for it.
void print_left_out(const Options& options, const Job& job);

/// Prints the notes of loader, builder, selection and closures to standard error.
void print_notes(const Job& job);

}  // namespace biocd
