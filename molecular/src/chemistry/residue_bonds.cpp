// SPDX-License-Identifier: BSD-3-Clause
// ResidueBonds: each residue gets its bonds from the first source that knows it.
#include "chemistry/residue_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "chemistry/bond_judge.hpp"
#include "chemistry/nucleotide_table.hpp"
#include "chemistry/residue_table.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/bonds.hpp"

namespace hinge::molecular {

namespace {

/// Angstrom. X-H is at most 1.35 (S-H). A hydrogen farther from the atom that its name tells has a wrong name, as the
/// hydroxyls of four tyrosines in an old 5PTI. If it is farther from every heavy atom of its residue, it stays
/// unbonded.
constexpr double hydrogen_bond_max = 1.6;
/// A bond of a component is too long above `fitting_bond_max` times the sum of covalent radii: atoms two bonds apart
/// are at 1.6 times that sum. A bond is lacking between two atoms of a component whose distance is below that sum +
/// `lacking_max` (angstrom). A component is another molecule of the same name if more than one bond in `fitting_share`
/// is too long or lacking, or if no other bonds connect the two atoms of a lacking bond. Fewer such bonds are
/// inaccurate coordinates, as in the haems of 4HHB.
constexpr double fitting_bond_max = 1.5, lacking_max = 0.2;
constexpr std::size_t fitting_share = 4;

constexpr const char* by_table = "residue table";
constexpr const char* by_conect = "CONECT records";
constexpr const char* by_radii = "covalent radii";

std::string& append(std::string& list, const std::string& word) {
  if (!list.empty()) list += ", ";
  return list += word;
}

}  // namespace

ResidueBonds::ResidueBonds(Structure& structure, BondList& bonds, ComponentLibrary& components)
    : s_(structure), bonds_(bonds), components_(components) {
  for (const BondRecord& bond : s_.bond_records)
    if (bond.conect && s_.atoms[bond.first].residue == s_.atoms[bond.second].residue) conect_.push_back(bond);
  std::sort(conect_.begin(), conect_.end(), [](const BondRecord& a, const BondRecord& b) { return a.first < b.first; });
}

template <class Visit>
bool ResidueBonds::for_each_table_bond(std::uint32_t r, const Visit& visit) const {
  const Residue& residue = s_.residues[r];
  if (residue.kind == ResidueKind::amino_acid) {
    const ResidueTemplate* known = find_residue_template(residue.name);
    if (known == nullptr) return false;
    for_each_bond(backbone_bonds, visit);
    if (!bonds_.find(r, "O")) for_each_bond(gromos_terminal_bonds, visit);
    for_each_bond(known->side_chain, visit);
    return true;
  }
  const NucleotideTemplate* known =
      residue.kind == ResidueKind::nucleotide ? find_nucleotide_template(residue.name) : nullptr;
  if (known == nullptr) return false;
  for_each_bond(nucleotide_backbone_bonds, visit);
  for_each_bond(known->base, visit);
  return true;
}

/// Bonds by name are accepted at any length, except those of hydrogens.
bool ResidueBonds::may_bond(std::uint32_t i, std::uint32_t j) const {
  return (!bonds_.hydrogen(i) && !bonds_.hydrogen(j)) || bonds_.distance(i, j) < hydrogen_bond_max;
}

bool ResidueBonds::has_all(const std::set<std::uint32_t>& known, const Residue& residue) const {
  for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i)
    if (!bonds_.hydrogen(i) && !known.contains(i)) return false;
  return true;
}

/// Returns the component of the residue's name; null if the dictionary's file cannot be read, or if the component is
/// from a dictionary and does not fit the coordinates.
const Component* ResidueBonds::fitting_component(std::uint32_t r) {
  const Residue& residue = s_.residues[r];
  const Component* component = nullptr;
  try {
    component = components_.find(residue.name);
  } catch (const LoadError& error) {  // thrown once for each name
    s_.notes.push_back(std::string("component ") + residue.name + " is not used: " + error.what());
  }
  if (component == nullptr || component->given) return component;
  BondJudge judge(s_, residue.first_atom, residue.last_atom);
  std::set<std::uint32_t> known;
  std::set<std::pair<std::uint32_t, std::uint32_t>> bonded;
  std::size_t too_long = 0, lacking = 0, disconnected = 0;
  for (const ComponentBond& bond : component->bonds) {
    const auto i = bonds_.find(r, bond.first), j = bonds_.find(r, bond.second);
    if ((i && bonds_.hydrogen(*i)) || (j && bonds_.hydrogen(*j))) continue;
    if (i) known.insert(*i);
    if (j) known.insert(*j);
    if (!i || !j || !bonded.insert(std::minmax(*i, *j)).second) continue;
    judge.join(*i, *j);
    if (bonds_.distance(*i, *j) > fitting_bond_max * bonds_.radii(*i, *j)) ++too_long;
  }
  for (const std::uint32_t i : known)
    for (const std::uint32_t j : known)
      if (i < j && !bonded.contains({i, j}) && !is_metal(s_.atoms[i].element) && !is_metal(s_.atoms[j].element) &&
          bonds_.within_radii(i, j) && bonds_.distance(i, j) < bonds_.radii(i, j) + lacking_max) {
        ++lacking;
        if (judge.bonds_around(i, j) == 0) ++disconnected;
      }
  if (disconnected == 0 && fitting_share * (too_long + lacking) <= bonded.size()) return component;
  misfits_[component->name].add([&] {
    return component->name + " of " + component->source + " does not fit the residue of " +
           label(s_, residue.first_atom) + ": " + std::to_string(too_long) + " of its " +
           std::to_string(bonded.size()) + " bonds are too long, and " + std::to_string(lacking) + " are lacking";
  });
  return nullptr;
}

/// Adds the bonds of CONECT records, if they connect all heavy atoms of the residue.
bool ResidueBonds::add_conect(const Residue& residue) {
  const auto before = [](const BondRecord& bond, std::uint32_t atom) { return bond.first < atom; };
  const auto first = std::lower_bound(conect_.begin(), conect_.end(), residue.first_atom, before);
  const auto last = std::lower_bound(first, conect_.end(), residue.last_atom, before);
  std::set<std::uint32_t> joined{residue.first_atom};
  bool orders = false;
  for (std::size_t size = 0; size != joined.size();) {  // repeats until no atom is added
    size = joined.size();
    for (auto link = first; link != last; ++link) {
      if (!bonds_.within_radii(link->first, link->second)) continue;
      orders = orders || link->order != BondOrder::unknown;
      if (joined.contains(link->first)) joined.insert(link->second);
      if (joined.contains(link->second)) joined.insert(link->first);
    }
  }
  if (!has_all(joined, residue)) return false;
  for (auto link = first; link != last; ++link)
    if (bonds_.within_radii(link->first, link->second))
      bonds_.add(link->first, link->second, BondOrigin::record,
                 orders && link->order == BondOrder::unknown ? BondOrder::single : link->order);
  return true;
}

/// Adds bonds by covalent radii. A pair that would close an impossible ring is a contact of the folded residue, not a
/// bond.
void ResidueBonds::add_by_radii(const Residue& residue, const std::set<std::uint32_t>& known) {
  std::vector<std::pair<double, std::pair<std::uint32_t, std::uint32_t>>> found;  // worst fit to the radii first
  BondJudge judge(s_, residue.first_atom, residue.last_atom);
  for (auto bond = s_.bonds.rbegin(); bond != s_.bonds.rend() && bond->first >= residue.first_atom; ++bond)
    judge.join(bond->first, bond->second, bond->order);
  for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i)
    for (std::uint32_t j = residue.first_atom; j < i; ++j)
      if (!bonds_.hydrogen(i) && !bonds_.hydrogen(j) && !(known.contains(i) && known.contains(j)) &&
          bonds_.within_radii(i, j)) {
        found.push_back({-std::abs(bonds_.distance(i, j) - bonds_.radii(i, j)), {j, i}});
        judge.join(j, i);
      }
  std::sort(found.begin(), found.end());
  for (const auto& [unused, pair] : found) {
    const auto [i, j] = pair;
    const int around = judge.bonds_around(i, j);
    if (around > 0 && !judge.may_close_ring(i, j, around))
      judge.part(i, j);
    else if (bonds_.add(i, j, BondOrigin::covalent_radii) && !known.empty())
      extended_.insert(residue.name);
  }
}

/// Adds the residue's heavy-atom bonds, and a component's bonds of hydrogens. Returns their source.
std::string ResidueBonds::source_of(std::uint32_t r) {
  const Residue& residue = s_.residues[r];
  std::set<std::uint32_t> known;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  const bool has_table = for_each_table_bond(r, [&](std::string_view a, std::string_view b) {
    const auto i = bonds_.find(r, a), j = bonds_.find(r, b);
    if (i) known.insert(*i);
    if (j) known.insert(*j);
    if (i && j) found.emplace_back(*i, *j);
  });
  if (has_table && known.empty()) unknown_.add([&] { return label(s_, residue.first_atom); });
  const bool complete = has_table && has_all(known, residue);
  if (const Component* component = complete ? nullptr : fitting_component(r)) {
    known.clear();
    for (const ComponentBond& bond : component->bonds) {
      const auto i = bonds_.find(r, bond.first), j = bonds_.find(r, bond.second);
      if (i) known.insert(*i);
      if (j) known.insert(*j);
      if (i && j && may_bond(*i, *j)) bonds_.add(*i, *j, BondOrigin::component, bond.order);
    }
    add_by_radii(residue, known);
    return component->source;
  }
  if (!complete && add_conect(residue)) return by_conect;
  for (const auto& [i, j] : found) bonds_.add(i, j, BondOrigin::residue_template);
  if (!complete) add_by_radii(residue, known);
  return has_table ? by_table : by_radii;
}

void ResidueBonds::add(std::uint32_t r) {
  const Residue& residue = s_.residues[r];
  const std::size_t before = s_.bonds.size();
  std::string source = source_of(r);
  std::vector<std::uint32_t> hydrogens;
  for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i)
    if (bonds_.hydrogen(i)) hydrogens.push_back(i);
  std::set<std::uint32_t> borne;
  for (std::size_t k = before; k < s_.bonds.size() && !hydrogens.empty(); ++k)
    borne.insert({s_.bonds[k].first, s_.bonds[k].second});
  for (const std::uint32_t h : hydrogens)
    if (!borne.contains(h)) add_hydrogen(h, r);
  if (residue.last_atom - residue.first_atom > hydrogens.size() + 1) ++sources_[{residue.name, std::move(source)}];
}

/// Adds the one bond of a hydrogen: to the atom that its name tells, else to the nearest heavy atom of its residue.
void ResidueBonds::add_hydrogen(std::uint32_t h, std::uint32_t r) {
  const Residue& residue = s_.residues[r];
  std::optional<std::uint32_t> bearer;
  const auto offer = [&](std::uint32_t i) {
    if (!bearer || bonds_.distance(i, h) < bonds_.distance(*bearer, h)) bearer = i;
  };
  for (const std::uint32_t i : bearers_by_name(s_, h))
    if (may_bond(i, h)) offer(i);
  if (!bearer)
    for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i)
      if (!bonds_.hydrogen(i) && may_bond(i, h)) offer(i);
  if (bearer)
    bonds_.add(*bearer, h, BondOrigin::residue_template, BondOrder::single);
  else
    alone_.add([&] { return label(s_, h); });
}

void ResidueBonds::say() {
  for (const auto& [name, misfit] : misfits_)
    s_.notes.push_back(misfit.first +
                       (misfit.number > 1 ? " (and " + std::to_string(misfit.number - 1) + " more residues)" : ""));
  if (unknown_.number > 0)
    s_.notes.push_back("residues without any atom of their template: " + std::to_string(unknown_.number) +
                       " (first: " + unknown_.first + "); beads of a coarse-grained model get radii of atoms, which " +
                       "are too small for them");
  if (alone_.number > 0)
    s_.notes.push_back("hydrogens without a bond, because no heavy atom of their residue is within 1.6 angstrom: " +
                       std::to_string(alone_.number) + " (first: " + alone_.first + ")");
  std::string names;
  for (const std::string& name : extended_) append(names, name);
  if (!names.empty()) s_.notes.push_back("bonds by covalent radii for atoms that the template lacks: " + names);
  std::map<std::string, std::string> by_source;
  for (const auto& [key, count] : sources_) {
    s_.bond_sources.push_back({key.first, key.second, count});
    if (key.second != by_table) append(by_source[key.second], key.first).append(" x").append(std::to_string(count));
  }
  for (const auto& [source, residues] : by_source)
    s_.notes.push_back("bonds by " + source + (source == by_radii ? ", no template for: " : ": ") + residues);
}

}  // namespace hinge::molecular
