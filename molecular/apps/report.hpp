// SPDX-License-Identifier: BSD-3-Clause
// The parts that the outputs of info, check and sample share. The JSON keys are a contract:
// docs/reference/biocd.md.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge/policy/collector.hpp"
#include "options.hpp"

namespace biocd {

/// Keys keep the order they were written in.
using Json = nlohmann::ordered_json;

Json model_json(const Options& options, const Job& job);
Json pair_json(const Job& job, const hinge::molecular::Contact& pair);
Json constant_contacts_json(const Job& job);
/// Each closure of the molecule by name, with its residual (angstrom); empty without residuals.
Json closures_json(const Job& job, const std::vector<double>& residuals);
/// "A:LYS77:chi1" or "move B x".
std::string dof_label(const Job& job, hinge::DofId dof);
/// Does it turn (rad), or move (angstrom)?
bool turns(const Job& job, hinge::DofId dof);
/// A configuration's values as people give and read them: degrees, and angstrom of placed parts' moves.
std::vector<double> in_degrees(const Job& job, std::vector<double> q);

/// The same, but torsions as the angles they are, not as turns from the reference: in (-180, 180].
std::vector<double> torsion_values(const Job& job, std::vector<double> q);
/// [{torsion, reference_degrees}] of the selection, in the order in which configurations give their values.
Json dofs_json(const Job& job);

/// Their names, in the tree's order.
std::vector<std::string> closure_names(const Job& job);
/// A line for each of them; residuals: of each the worst, or none.
void print_closures(const Job& job, const std::vector<double>& residuals);
/// A length to thousandths: superposed coordinates are rounded differently on different instruction sets.
double rounded(double length);
Json verdict_json(const Job& job, std::uint64_t index, const hinge::molecular::Verdict& verdict,
                  const hinge::molecular::Mode& mode);

/// What every CSV file has: a row per pair, or one without a pair.
inline constexpr const char* csv_columns =
    "index,collides,i,j,label_i,label_j,distance,threshold,pair_collides,overlap";
/// And what else the rules have to say; more: further columns, each after a comma.
std::string csv_header(const Options& options, const std::string& more);
std::string csv_rows(const Job& job, std::uint64_t index, const hinge::molecular::Verdict& verdict);

/// The rows with further columns, each after a comma.
std::string with_columns(const std::string& rows, const std::string& columns);

/// "A:LYS77:NZ  A:GLU18:OE1  2.310 < 2.456, overlap 0.760"; ">=" when the pair does not collide, whatever rounding made
/// of its numbers.
std::string pair_line(const Job& job, const hinge::molecular::Contact& pair);

/// The rules of the check, the selection and its constant contacts, for people.
std::string heading(const Options& options, const Job& job);

/// Constant contacts on standard error, for outputs whose format has no place for them.
void print_constant_contacts(const Job& job);

/// "left out: 333 waters, 1 ACT (--hetero keeps ...)", or nothing.
std::string left_out_line(const hinge::molecular::Structure& structure);
/// The same on standard error, for CSV, which has no place for it.
void print_left_out(const Options& options, const Job& job);

/// Notes of loader and builder, on standard error.
void print_notes(const Job& job);

}  // namespace biocd
