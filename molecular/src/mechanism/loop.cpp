// SPDX-License-Identifier: BSD-3-Clause
// Finds the loops that an expression names, and their torsions.
#include "hinge/molecular/loop.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "chemistry/residue_words.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/selection.hpp"

namespace hinge::molecular {

namespace {

std::string name_of(const Structure& s, std::uint32_t r) {
  const Residue& residue = s.residues[r];
  std::string name = residue.name;
  name += std::to_string(residue.sequence_number);
  if (residue.insertion_code != '\0') name += residue.insertion_code;
  return name;
}

[[noreturn]] void refuse_loop(std::string_view word, const std::string& what) {
  std::string text = "loop '";
  text += word;
  throw ModelError(text + "': " + what);
}

/// Returns, per residue, the residue to which a peptide bond joins its C.
std::vector<std::optional<std::uint32_t>> residues_behind(const Structure& s) {
  std::vector<std::optional<std::uint32_t>> next(s.residues.size());
  for (const Bond& bond : s.bonds) {
    if (bond.origin != BondOrigin::peptide) continue;
    const bool first_is_c = s.atoms[bond.first].name == "C";
    const std::uint32_t c = first_is_c ? bond.first : bond.second, n = first_is_c ? bond.second : bond.first;
    next[s.atoms[c].residue] = s.atoms[n].residue;
  }
  return next;
}

void check_backbone(const Structure& s, std::uint32_t r, std::string_view word) {
  const Residue& residue = s.residues[r];
  for (const char* name : {"N", "CA", "C"}) {
    const auto begin = s.atoms.begin() + residue.first_atom, end = s.atoms.begin() + residue.last_atom;
    if (residue.kind != ResidueKind::amino_acid ||
        std::none_of(begin, end, [&](const Atom& atom) { return atom.name == name; }))
      refuse_loop(word, name_of(s, r) + " is not an amino acid with atoms N, CA and C");
  }
}

/// Returns the residues that a term selects. Throws ModelError if they are not contiguous.
Loop stretch_of(const Structure& s, const SelectionTerm& term) {
  const auto begin = std::ranges::find(term.selected, true);
  if (begin == term.selected.end()) refuse_loop(term.text, "selects no residues, expected CHAIN:FIRST-LAST");
  const auto end = std::find(begin, term.selected.end(), false);
  const auto first = static_cast<std::uint32_t>(begin - term.selected.begin());
  const auto last = static_cast<std::uint32_t>(end - term.selected.begin() - 1);
  if (std::find(end, term.selected.end(), true) != term.selected.end())
    refuse_loop(term.text, "its residues are not contiguous after " + name_of(s, last) +
                               ", expected CHAIN:FIRST-LAST, as in A:40-52");
  return {first, last};
}

}  // namespace

std::vector<Loop> find_loops(const Structure& structure, std::string_view words) {
  const auto next = residues_behind(structure);
  std::vector<Loop> loops;
  ResidueWords meaning(structure, ResidueNames::only);
  for (const SelectionTerm& term : read_terms(words, words_of(meaning))) {
    const std::string_view word = term.text;
    const Loop range = stretch_of(structure, term);
    for (std::uint32_t r = range.first; r <= range.last; ++r) check_backbone(structure, r, word);
    for (std::uint32_t r = range.first; r < range.last; ++r)
      if (next[r] != r + 1)
        refuse_loop(word, "no peptide bond joins " + name_of(structure, r) + " and " + name_of(structure, r + 1) +
                              ": a loop cannot cross a break of the chain");
    const auto before = std::find(next.begin(), next.end(), range.first);
    const bool starts = before == next.end(), ends = !next[range.last];
    if (starts || ends)
      refuse_loop(word,
                  name_of(structure, starts ? range.first : range.last) + " is the " + (starts ? "first" : "last") +
                      " residue of its chain, expected a residue before and after the loop; --free frees chain ends");
    for (const Loop& other : loops)
      if (range.first <= other.last && other.first <= range.last)
        refuse_loop(word, "shares residues with loop " + label(structure, other));
    loops.push_back(range);
  }
  return loops;
}

std::string label(const Structure& structure, const Loop& loop) {
  const std::string& chain = structure.chains[structure.residues[loop.first].chain].name;
  std::string text = chain.empty() ? "_" : chain;
  text += ':';
  text += name_of(structure, loop.first);
  text += '-';
  return text + name_of(structure, loop.last);
}

std::vector<std::size_t> select_loop_torsions(const Molecule& molecule, std::string_view side_chains, bool omega) {
  const auto torsions = molecule.torsions();
  std::vector<std::size_t> chosen = select_torsions(molecule, side_chains, false);
  for (const std::size_t k : chosen)
    if (!torsions[k].name.starts_with("chi"))
      throw ModelError("selection '" + std::string(side_chains) + "' frees " + torsions[k].name + " of " +
                       label(molecule.structure(), torsions[k].atoms[1]) +
                       ", expected only side chains (chi): all other torsions outside the loop are fixed");
  for (const Loop& loop : molecule.loops()) {
    std::size_t turns = 1;  // psi of the last residue: it follows from the others and is no DOF
    for (std::size_t k = 0; k < torsions.size(); ++k) {
      const Torsion& torsion = torsions[k];
      if (torsion.residue < loop.first || torsion.residue > loop.last) continue;
      if (torsion.name == "phi" || torsion.name == "psi" ||
          (omega && torsion.name == "omega" && torsion.residue < loop.last)) {
        chosen.push_back(k);
        ++turns;
      }
    }
    // A closed cycle of k torsions has k - 6 degrees of freedom. With k = 6 it has other isolated conformations; with k
    // < 6 it is rigid.
    if (turns < 6)
      refuse_loop(label(molecule.structure(), loop),
                  "has " + std::to_string(turns) +
                      " torsions, expected at least 6: with fewer it cannot move between its fixed ends");
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace hinge::molecular
