// SPDX-License-Identifier: BSD-3-Clause
// join_structures: shifts indices by the sizes of the preceding structures and renames chains.
#include "hinge/molecular/join_structures.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

/// Returns a chain name that is not taken.
std::string free_name(const std::set<std::string>& taken) {
  for (const char c : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"))
    if (!taken.contains({c})) return {c};
  throw ModelError("joining structures: no chain name of one character is left");
}

void rename_chains(const Structure& before, Structure& added) {
  std::set<std::string> used, taken;
  for (const Chain& chain : before.chains) used.insert(chain.name);
  taken = used;
  for (const Chain& chain : added.chains) taken.insert(chain.name);
  std::map<std::string, std::string> names;
  for (Chain& chain : added.chains) {
    if (!used.contains(chain.name)) continue;
    auto found = names.find(chain.name);
    if (found == names.end()) {
      found = names.emplace(chain.name, free_name(taken)).first;
      taken.insert(found->second);
      const std::string old = chain.name.empty() ? "_" : chain.name;
      added.notes.push_back("chain " + old + " of file " + std::to_string(chain.file + 1) + " (" + added.name +
                            ") is called " + found->second + " here: an earlier file has a chain " + old);
    }
    chain.name = found->second;
  }
}

void append(Structure& all, Structure added) {
  const auto atoms = static_cast<std::uint32_t>(all.atoms.size());
  const auto residues = static_cast<std::uint32_t>(all.residues.size());
  const auto chains = static_cast<std::uint32_t>(all.chains.size());
  const std::uint32_t file = all.chains.empty() ? 0 : all.chains.back().file + 1;
  for (Chain& chain : added.chains) chain.file += file;
  rename_chains(all, added);
  all.name += "+" + added.name;
  for (Atom& atom : added.atoms) {
    atom.residue += residues;
    atom.record += static_cast<std::uint32_t>(all.atom_records);
    all.atoms.push_back(std::move(atom));
  }
  for (Residue& residue : added.residues) {
    residue.chain += chains;
    residue.first_atom += atoms;
    residue.last_atom += atoms;
    all.residues.push_back(std::move(residue));
  }
  for (Chain& chain : added.chains) {
    chain.first_residue += residues;
    chain.last_residue += residues;
    all.chains.push_back(std::move(chain));
  }
  for (BondRecord bond : added.bond_records) {
    bond.first += atoms;
    bond.second += atoms;
    all.bond_records.push_back(bond);
  }
  for (Bond bond : added.bonds) {
    bond.first += atoms;
    bond.second += atoms;
    all.bonds.push_back(bond);
  }
  for (const BondSource& more : added.bond_sources) {
    const auto key = [](const BondSource& source) { return std::tie(source.residue, source.source); };
    const auto at = std::lower_bound(all.bond_sources.begin(), all.bond_sources.end(), more,
                                     [&](const BondSource& x, const BondSource& y) { return key(x) < key(y); });
    if (at != all.bond_sources.end() && key(*at) == key(more)) {
      at->count += more.count;
    } else {
      all.bond_sources.insert(at, more);
    }
  }
  for (const SecondaryStructure& element : added.secondary_structure)
    all.secondary_structure.push_back({element.kind, element.first + residues, element.last + residues});
  if (all.models.size() > 1 && added.models.size() > 1)
    throw ModelError("joining structures: " + all.name + " have " + std::to_string(all.models.size()) + " and " +
                     std::to_string(added.models.size()) + " models, expected a single model in one of them");
  if (added.models.size() > 1) {
    all.models.resize(added.models.size(), all.models.front());
    all.model_numbers = added.model_numbers;
  }
  for (std::size_t m = 0; m < all.models.size(); ++m) {
    const std::vector<Vec3>& more = added.models[added.models.size() == 1 ? 0 : m];
    all.models[m].insert(all.models[m].end(), more.begin(), more.end());
  }
  for (std::string& note : added.notes) all.notes.push_back(std::move(note));
  all.atom_records += added.atom_records;
  all.waters_dropped += added.waters_dropped;
  all.hetero_dropped += added.hetero_dropped;
  for (const auto& [name, count] : added.hetero_residues_dropped) all.hetero_residues_dropped[name] += count;
}

}  // namespace

Structure join_structures(std::vector<Structure> structures) {
  if (structures.empty()) throw ModelError("joining structures: got none, expected at least one");
  Structure all = std::move(structures.front());
  for (std::size_t k = 1; k < structures.size(); ++k) append(all, std::move(structures[k]));
  return all;
}

}  // namespace hinge::molecular
