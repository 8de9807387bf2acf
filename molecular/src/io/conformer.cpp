// SPDX-License-Identifier: BSD-3-Clause
// ConformerChoice: compares sums of occupancies by alternative location.
#include "io/conformer.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace hinge::molecular {

namespace {

/// Occupancies are hundredths: sums that differ by less are equal.
constexpr double occupancy_tie = 1e-3;

bool has_altloc(const RawResidue& residue, char altloc) {
  return std::any_of(residue.atoms.begin(), residue.atoms.end(), [&](const RawAtom& a) { return a.altloc == altloc; });
}

}  // namespace

ConformerChoice::ConformerChoice(const RawModel& first_model, const ReadOptions& options)
    : conformer_(options.altloc), asked_for_(options.altloc.has_value()) {
  if (asked_for_) return;
  std::map<char, double> sums;
  for (const RawResidue& residue : first_model.residues) {
    const bool read = residue.kind != ResidueKind::water && (residue.kind != ResidueKind::other || options.hetero);
    for (const RawAtom& atom : residue.atoms)
      if (read && atom.altloc != '\0') sums[atom.altloc] += atom.occupancy;
  }
  for (const auto& [altloc, sum] : sums)
    if (!conformer_ || sum > sums.at(*conformer_) + occupancy_tie) conformer_ = altloc;
}

double ConformerChoice::preference(const RawResidue& residue) const {
  if (conformer_ && has_altloc(residue, *conformer_)) return std::numeric_limits<double>::infinity();
  double best = 0.0;
  for (const RawAtom& atom : residue.atoms) best = std::max(best, atom.occupancy);
  return best;
}

char ConformerChoice::altloc_of(const RawResidue& residue) const {
  if (conformer_ && has_altloc(residue, *conformer_)) return *conformer_;
  std::map<char, double> highest;
  for (const RawAtom& atom : residue.atoms)
    if (atom.altloc != '\0') {
      double& occupancy = highest.emplace(atom.altloc, atom.occupancy).first->second;
      occupancy = std::max(occupancy, atom.occupancy);
    }
  char best = '\0';
  for (const auto& [altloc, occupancy] : highest)
    if (best == '\0' || occupancy > highest.at(best)) best = altloc;
  return best;
}

void ConformerChoice::count(char altloc, const std::string& residue) {
  if (altloc == '\0') return;
  if (conformer_ && altloc == *conformer_)
    ++inside_;
  else
    beside_.add([&] { return residue + " at " + altloc; });
}

void ConformerChoice::count_dropped(const std::string& atom) {
  dropped_.add([&] { return atom; });
}

std::string ConformerChoice::note() const {
  if (inside_ + beside_.number == 0) return {};
  std::string text = "alternative locations: ";
  if (conformer_)
    text += std::string(1, *conformer_) + (asked_for_ ? " (--altloc)" : " (highest summed occupancy)") +
            " is used in " + std::to_string(inside_) + " residues; ";
  if (beside_.number > 0)
    text += std::to_string(beside_.number) +
            " residues use their own location of highest occupancy (first: " + beside_.first + "); ";
  text += std::to_string(dropped_.number) + " atoms are left out";
  return text + (dropped_.number > 0 ? " (first: " + dropped_.first + ")" : "");
}

}  // namespace hinge::molecular
