// SPDX-License-Identifier: BSD-3-Clause
// Models of one file with different atoms: comparison, and reduction to the common atoms.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

/// Chain, number, insertion code, residue name, atom name, and the number of atoms before with the same of these:
/// residues of one chain may have the same name and number.
using Key = std::tuple<std::string, int, char, std::string, std::string, std::uint32_t>;

std::map<Key, std::uint32_t> atoms_by_key(const Structure& s) {
  std::map<Key, std::uint32_t> atoms, numbers;
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) {
    const Residue& residue = s.residues[s.atoms[i].residue];
    Key key{s.chains[residue.chain].name,
            residue.sequence_number,
            residue.insertion_code,
            residue.name,
            s.atoms[i].name,
            0};
    std::get<5>(key) = numbers[key]++;
    atoms.emplace(std::move(key), i);
  }
  return atoms;
}

constexpr std::uint32_t not_kept = static_cast<std::uint32_t>(-1);

/// Returns the structure reduced to some atoms, at least one, with their coordinates.
Structure with_atoms(const Structure& all, const std::vector<bool>& keep) {
  Structure s = all;
  s.atoms.clear();
  s.residues.clear();
  s.chains.clear();
  std::vector<std::uint32_t> atom_of(all.atoms.size(), not_kept), residue_of(all.residues.size(), not_kept);
  std::uint32_t chain_before = not_kept;
  for (std::uint32_t i = 0; i < all.atoms.size(); ++i) {
    if (!keep[i]) continue;
    const std::uint32_t r = all.atoms[i].residue;
    const auto here = static_cast<std::uint32_t>(s.atoms.size());
    if (residue_of[r] == not_kept) {
      residue_of[r] = static_cast<std::uint32_t>(s.residues.size());
      const std::uint32_t chain = all.residues[r].chain;
      if (chain != chain_before) {
        s.chains.push_back(all.chains[chain]);
        s.chains.back().first_residue = residue_of[r];
        chain_before = chain;
      }
      s.residues.push_back(all.residues[r]);
      s.residues.back().chain = static_cast<std::uint32_t>(s.chains.size() - 1);
      s.residues.back().first_atom = here;
    }
    atom_of[i] = here;
    s.atoms.push_back(all.atoms[i]);
    s.atoms.back().residue = residue_of[r];
    s.residues.back().last_atom = here + 1;
    s.chains.back().last_residue = residue_of[r] + 1;
  }
  std::erase_if(s.bond_records, [&](const BondRecord& l) { return !keep[l.first] || !keep[l.second]; });
  for (BondRecord& bond : s.bond_records) {
    bond.first = atom_of[bond.first];
    bond.second = atom_of[bond.second];
  }
  std::erase_if(s.secondary_structure, [&](const SecondaryStructure& e) {
    return residue_of[e.first] == not_kept || residue_of[e.last] == not_kept;
  });
  for (SecondaryStructure& element : s.secondary_structure) {
    element.first = residue_of[element.first];
    element.last = residue_of[element.last];
  }
  for (std::size_t m = 0; m < s.models.size(); ++m) {
    s.models[m].clear();
    for (std::uint32_t i = 0; i < all.atoms.size(); ++i)
      if (keep[i]) s.models[m].push_back(all.models[m][i]);
  }
  return s;
}

}  // namespace

std::string first_difference(const Structure& other, const Structure& molecule) {
  std::uint32_t i = 0;
  const auto same = [&] {
    const Residue& a = other.residues[other.atoms[i].residue];
    const Residue& b = molecule.residues[molecule.atoms[i].residue];
    return other.atoms[i].name == molecule.atoms[i].name && a.sequence_number == b.sequence_number &&
           a.insertion_code == b.insertion_code;
  };
  while (i < other.atoms.size() && i < molecule.atoms.size() && same()) ++i;
  if (i == other.atoms.size() && i == molecule.atoms.size()) return {};
  if (i == other.atoms.size()) return label(molecule, i) + " is missing";
  if (i == molecule.atoms.size()) return label(other, i) + " is additional";
  return label(other, i) + " is in the place of " + label(molecule, i);
}

std::optional<MatchedAtoms> match_atoms(const Structure& other, const Structure& molecule) {
  const std::map<Key, std::uint32_t> atoms = atoms_by_key(other);
  MatchedAtoms matched{std::vector<Vec3>(molecule.atoms.size()), std::vector<std::uint32_t>(molecule.atoms.size())};
  for (const auto& [key, i] : atoms_by_key(molecule)) {
    const auto found = atoms.find(key);
    if (found == atoms.end()) return std::nullopt;
    matched.positions[i] = other.models[0][found->second];
    matched.records[i] = other.atoms[found->second].record;
  }
  return matched;
}

MatchedAtoms conformation(const Structure& other, const Structure& molecule, bool may_have_more,
                          const std::string& where) {
  const std::string difference = first_difference(other, molecule);
  if (difference.empty()) {
    MatchedAtoms same{other.models[0], {}};
    for (const Atom& atom : other.atoms) same.records.push_back(atom.record);
    return same;
  }
  if (may_have_more)
    if (auto matched = match_atoms(other, molecule)) return std::move(*matched);
  throw OtherAtoms(where + " has other atoms than the first model: " + difference + " (" +
                   std::to_string(other.atoms.size()) + " atoms, " + std::to_string(molecule.atoms.size()) +
                   " in the first model)");
}

std::vector<Structure> assemble_each(RawFile raw, const std::string& path, ReadOptions options) {
  std::vector<RawModel> models = std::exchange(raw.models, {});
  options.model.reset();
  std::vector<Structure> each;
  for (RawModel& model : models) {
    RawFile one = raw;
    one.models.push_back(std::move(model));
    each.push_back(assemble(std::move(one), path, options));
  }
  return each;
}

Structure assemble_common(RawFile raw, const std::string& path, const ReadOptions& options) {
  std::vector<Structure> each = assemble_each(std::move(raw), path, options);
  Structure& first = each.front();
  std::vector<std::map<Key, std::uint32_t>> atoms;
  for (const Structure& s : each) atoms.push_back(atoms_by_key(s));
  std::map<Key, std::uint32_t> left_out;  // atom -> a model that has it
  std::vector<bool> keep(first.atoms.size());
  for (std::uint32_t m = 0; m < each.size(); ++m)
    for (const auto& [key, i] : atoms[m]) {
      const auto has_atom = [&wanted = key](const auto& of) { return of.contains(wanted); };
      const bool common = std::all_of(atoms.begin(), atoms.end(), has_atom);
      if (common && m == 0) keep[i] = true;
      if (!common) left_out.emplace(key, m);
    }
  if (std::find(keep.begin(), keep.end(), true) == keep.end())
    throw OtherAtoms(path + ": its models have no common atom (" + first_difference(each[1], first) +
                     "), choose one with --model");
  Structure common = with_atoms(first, keep);
  common.models.resize(1);
  for (std::size_t m = 1; m < each.size(); ++m) {
    common.models.push_back(std::move(match_atoms(each[m], common)->positions));
    common.model_numbers.push_back(each[m].model_numbers[0]);
  }
  if (left_out.empty()) {
    common.notes.push_back("models differ in the order of their atoms; the order of the first one is used");
    return common;
  }
  const auto& [key, m] = *left_out.begin();
  common.notes.push_back(
      "models differ: " + std::to_string(left_out.size()) +
      " atoms are left out, because some models lack them (first: " + label(each[m], atoms[m].at(key)) + " of model " +
      std::to_string(each[m].model_numbers[0]) + ")");
  return common;
}

}  // namespace hinge::molecular
