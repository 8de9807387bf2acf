// SPDX-License-Identifier: BSD-3-Clause
// Writer and reader of recorded bonds: the reader finds by name exactly the bonds that the writer omits.
#include "chemistry/recorded_bonds.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "chemistry/bond_list.hpp"
#include "chemistry/nucleotide_table.hpp"
#include "chemistry/residue_bonds.hpp"
#include "chemistry/residue_table.hpp"
#include "hinge/molecular/components.hpp"

namespace hinge::molecular {

namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// The bond that joins two residues of a polymer by name and order, first < second.
struct PolymerPair {
  Pair atoms;
  BondOrigin origin = BondOrigin::peptide;
  bool closes = false;  ///< joins the last residue of a chain to its first
};

bool is_of_polymer(const Residue& residue) {
  return residue.kind == ResidueKind::amino_acid || residue.kind == ResidueKind::nucleotide || is_cap(residue.name);
}

std::vector<PolymerPair> polymer_pairs(const Structure& s) {
  std::vector<PolymerPair> pairs;
  const auto find = [&](std::uint32_t r, std::string_view name, bool nucleotide) {
    std::uint32_t i = s.residues[r].first_atom;
    while (i < s.residues[r].last_atom &&
           !(nucleotide ? is_nucleotide_atom(s.atoms[i].name, name) : s.atoms[i].name == name))
      ++i;
    return i < s.residues[r].last_atom ? std::optional(i) : std::nullopt;
  };
  const auto add = [&](std::uint32_t r, std::uint32_t t, bool closes) {
    for (const bool of_nucleotides : {false, true}) {
      if ((s.residues[r].kind == ResidueKind::nucleotide) != of_nucleotides ||
          (s.residues[t].kind == ResidueKind::nucleotide) != of_nucleotides)
        continue;
      const auto i = find(r, of_nucleotides ? "O3'" : "C", of_nucleotides),
                 j = find(t, of_nucleotides ? "P" : "N", of_nucleotides);
      if (i && j)
        pairs.push_back(
            {std::minmax(*i, *j), of_nucleotides ? BondOrigin::phosphodiester : BondOrigin::peptide, closes});
    }
  };
  for (const Chain& chain : s.chains) {
    std::optional<std::uint32_t> first, last;
    for (std::uint32_t r = chain.first_residue; r < chain.last_residue; ++r) {
      if (!is_of_polymer(s.residues[r])) continue;
      if (last) add(*last, r, false);
      if (!first) first = r;
      last = r;
    }
    if (first && last && *last > *first + 1) add(*last, *first, true);
  }
  return pairs;
}

bool inside_residue(const Structure& s, std::uint32_t i, std::uint32_t j) {
  return s.atoms[i].residue == s.atoms[j].residue;
}
bool hydrogen(const Structure& s, std::uint32_t i) { return s.atoms[i].element == "H"; }
bool heavy(const Structure& s, const Bond& bond) { return !hydrogen(s, bond.first) && !hydrogen(s, bond.second); }

/// Returns one value per residue: true if the built-in tables do not imply its bonds.
std::vector<bool> recorded_residues(const Structure& s) {
  std::vector<bool> recorded(s.residues.size(), false);
  for (const Bond& bond : s.bonds)
    if (inside_residue(s, bond.first, bond.second) && heavy(s, bond) && bond.origin != BondOrigin::residue_template)
      recorded[s.atoms[bond.first].residue] = true;
  return recorded;
}

}  // namespace

bool joins_neighbours(const Structure& s, const Bond& bond) {
  if (bond.origin != BondOrigin::peptide && bond.origin != BondOrigin::phosphodiester) return false;
  const std::string_view first = s.atoms[bond.first].name;
  // A bond that closes a cyclic backbone is reversed: N or P is in the earlier residue.
  return first != "N" && first != "P" && !inside_residue(s, bond.first, bond.second);
}

std::vector<std::uint32_t> copies_of_residues(const Structure& s) {
  std::map<std::tuple<std::string_view, int, char, std::string_view>, std::uint32_t> seen;
  std::vector<std::uint32_t> copies;
  for (const Residue& residue : s.residues)
    copies.push_back(
        seen[{s.chains[residue.chain].name, residue.sequence_number, residue.insertion_code, residue.name}]++);
  return copies;
}

RecordedBonds record_bonds(const Structure& structure) {
  const std::vector<bool> recorded = recorded_residues(structure);
  std::set<Pair> implied, found;
  for (const PolymerPair& pair : polymer_pairs(structure))
    if (!pair.closes) implied.insert(pair.atoms);
  RecordedBonds result{structure.atoms.size(), {}};
  for (const Bond& bond : structure.bonds) {
    const Pair atoms{bond.first, bond.second};
    if (inside_residue(structure, bond.first, bond.second)) {
      if (!recorded[structure.atoms[bond.first].residue]) continue;
    } else if (implied.contains(atoms)) {
      found.insert(atoms);
      continue;
    }
    result.bonds.push_back({bond.first, bond.second, bond.order, true});
  }
  for (const Pair& atoms : implied)
    if (!found.contains(atoms)) result.bonds.push_back({atoms.first, atoms.second, BondOrder::unknown, false});
  return result;
}

void take_recorded_bonds(Structure& s, const RecordedBonds& recorded) {
  s.bonds.clear();
  s.bond_sources.clear();
  std::map<std::uint32_t, std::uint32_t> atom_of;  // by Atom::record
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) atom_of.emplace(s.atoms[i].record, i);
  BondList list(s);
  std::set<Pair> broken, disulphides;
  std::map<Pair, BondOrder> between;
  std::vector<std::vector<Bond>> inside(s.residues.size());
  for (const RecordedBond& bond : recorded.bonds) {
    const auto a = atom_of.find(bond.first), b = atom_of.find(bond.second);
    if (a == atom_of.end() || b == atom_of.end()) continue;  // one atom was dropped
    const Pair atoms = std::minmax(a->second, b->second);
    const auto [i, j] = atoms;
    if (!bond.bonded)
      broken.insert(atoms);
    else if (inside_residue(s, i, j))
      inside[s.atoms[i].residue].push_back(hydrogen(s, i) || hydrogen(s, j)
                                               ? Bond{i, j, BondOrigin::residue_template, BondOrder::single}
                                               : Bond{i, j, BondOrigin::record, bond.order});
    else
      between.emplace(atoms, bond.order);
  }
  for (const BondRecord& bond : s.bond_records)
    if (bond.disulphide) disulphides.emplace(bond.first, bond.second);

  ComponentLibrary none;
  ResidueBonds by_name(s, list, none);
  std::map<std::string, std::size_t> sources;
  for (std::uint32_t r = 0; r < s.residues.size(); ++r) {
    if (inside[r].empty()) {
      by_name.add(r);
      continue;
    }
    for (const Bond& bond : inside[r]) list.add(bond.first, bond.second, bond.origin, bond.order);
    ++sources[s.residues[r].name];
  }
  for (const PolymerPair& pair : polymer_pairs(s)) {
    const bool is_recorded = between.erase(pair.atoms) > 0;
    if (pair.closes ? is_recorded : !broken.contains(pair.atoms))
      list.add(pair.atoms.first, pair.atoms.second, pair.origin);
  }
  for (const auto& [atoms, order] : between) {
    // If two residues share a number, SSBOND cannot address the second one; the names SG then identify a disulphide.
    const bool disulphide = disulphides.contains(atoms) || joins_sg(s, atoms.first, atoms.second);
    list.add(atoms.first, atoms.second, disulphide ? BondOrigin::disulphide : BondOrigin::record, order);
  }
  std::sort(s.bonds.begin(), s.bonds.end(),
            [](const Bond& a, const Bond& b) { return Pair(a.first, a.second) < Pair(b.first, b.second); });
  by_name.say();
  for (const auto& [name, count] : sources) s.bond_sources.push_back({name, "records of Hinge", count});
  std::sort(s.bond_sources.begin(), s.bond_sources.end(), [](const BondSource& a, const BondSource& b) {
    return std::pair(a.residue, a.source) < std::pair(b.residue, b.source);
  });
}

}  // namespace hinge::molecular
