// SPDX-License-Identifier: BSD-3-Clause
// Finds the residues of a part by an expression.
#include "hinge/molecular/part.hpp"

#include <algorithm>
#include <cstddef>

#include "chemistry/residue_words.hpp"
#include "hinge/core/error.hpp"

namespace hinge::molecular {

Part find_part(const Structure& structure, std::string_view words, ResidueNames names) {
  ResidueWords meaning(structure, names);
  std::vector<bool> in(structure.residues.size(), false);
  for (const SelectionTerm& term : read_terms(words, words_of(meaning)))
    for (std::size_t r = 0; r < in.size(); ++r) in[r] = in[r] || term.selected[r];
  Part part;
  part.name = words;
  for (std::uint32_t r = 0; r < in.size(); ++r)
    if (in[r]) part.residues.push_back(r);
  if (part.residues.empty()) refuse({words, words}, "at least one residue; it selects none");
  return part;
}

Part rest_of(const Structure& structure, const Part& part) {
  Part rest;
  rest.name = "rest";
  for (std::uint32_t r = 0; r < structure.residues.size(); ++r)
    if (!std::ranges::binary_search(part.residues, r)) rest.residues.push_back(r);
  if (rest.residues.empty())
    throw ModelError("the rest of '" + part.name + "' is empty: the part holds all residues, expected fewer");
  return rest;
}

std::vector<bool> atoms_in(const Structure& structure, const Part& part) {
  std::vector<bool> in(structure.atoms.size(), false);
  for (const std::uint32_t r : part.residues)
    std::fill(in.begin() + structure.residues[r].first_atom, in.begin() + structure.residues[r].last_atom, true);
  return in;
}

}  // namespace hinge::molecular
