// SPDX-License-Identifier: BSD-3-Clause
// Target: expressions that select torsions, on a protein of three chains with helices and strands.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fuzz/bytes.hpp"
#include "fuzz/require.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/selection.hpp"

namespace {

using hinge::molecular::Molecule;
using hinge::molecular::Structure;

/// Chain A has residues 1 to 12, chain B 60, 60A and -3, and a chain without a name has one residue.
Molecule make_molecule() {
  Structure s = hinge::molecular::build_ideal_protein("AKRMFPWSTCVLGHED", "HHHHHCCEEEECCHHC");
  s.chains.assign({{"A", 0, 12}, {"B", 12, 15}, {"", 15, 16}});
  for (std::uint32_t c = 0; c < 3; ++c)
    for (std::uint32_t r = s.chains[c].first_residue; r < s.chains[c].last_residue; ++r) s.residues[r].chain = c;
  s.residues[12].sequence_number = 60;
  s.residues[13].sequence_number = 60;
  s.residues[13].insertion_code = 'A';
  s.residues[14].sequence_number = -3;
  return Molecule(std::move(s));
}

using Positions = std::vector<std::size_t>;

std::optional<Positions> select(const Molecule& molecule, std::string_view words, bool omega) {
  std::optional<Positions> chosen;
  fuzz::accepts([&] { chosen = hinge::molecular::select_torsions(molecule, words, omega); });
  if (!chosen) return chosen;
  fuzz::require(std::is_sorted(chosen->begin(), chosen->end()) &&
                    std::adjacent_find(chosen->begin(), chosen->end()) == chosen->end(),
                "positions not sorted or not unique");
  fuzz::require(chosen->empty() || chosen->back() < molecule.torsions().size(), "a torsion that is not there");
  return chosen;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Molecule molecule = make_molecule();
  const std::string_view words = fuzz::Bytes(data, size).text();
  const auto without = select(molecule, words, false), with = select(molecule, words, true);
  fuzz::require(with.has_value() || !without, "omega decides what is a word");
  if (!with || !without) return 0;  // the expression selects omega only, which is not available without it
  fuzz::require(std::includes(with->begin(), with->end(), without->begin(), without->end()),
                "omega takes torsions away");
  // Parentheses around a whole expression change nothing, and selections obey the laws of sets.
  const std::string whole = "(" + std::string(words) + ")";
  const auto expect = [&](const std::string& other, const Positions& expected, const char* what) {
    const auto found = select(molecule, other, true);
    fuzz::require(found && *found == expected, what);
  };
  if (words.size() > 1000 || std::ranges::count(words, '(') > 90) return 0;
  expect(whole, *with, "parentheses change what is selected");
  expect(whole + "," + whole, *with, "a union with itself is something else");
  expect(whole + " and " + whole, *with, "an intersection with itself is something else");
  expect("not not " + whole, *with, "not not is something else");
  Positions rest;
  const auto all = select(molecule, "all", true);
  std::set_difference(all->begin(), all->end(), with->begin(), with->end(), std::back_inserter(rest));
  if (!rest.empty()) expect("not " + whole, rest, "not is something else than the rest");
  // An expression with `or` selects the union of what its parts select.
  const auto comma = words.find(" or ");
  if (comma == std::string_view::npos || words.find('(') != std::string_view::npos) return 0;
  const auto head = select(molecule, words.substr(0, comma), true),
             tail = select(molecule, words.substr(comma + 4), true);
  Positions both;
  if (head) both = *head;
  if (tail) {
    const Positions left = std::move(both);
    both.clear();
    std::set_union(left.begin(), left.end(), tail->begin(), tail->end(), std::back_inserter(both));
  }
  fuzz::require(both == *with, "a list selects something else than its parts");
  return 0;
}
