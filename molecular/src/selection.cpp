// SPDX-License-Identifier: BSD-3-Clause
// The grammar of selections.
#include "hinge/molecular/selection.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string>

#include "residue_range.hpp"

namespace hinge::molecular {

namespace {

std::size_t read_count(std::string_view word, std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value == 0) refuse(word, "a whole number above 0");
  return value;
}

class Selector {
 public:
  Selector(const Molecule& molecule, bool omega)
      : molecule_(molecule), s_(molecule.structure()), omega_(omega), chosen_(molecule.torsions().size(), false) {
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r)
      if (in_polymer(r)) polymer_.push_back(r);
  }

  void add(std::string_view word) {
    if (word == "none") return;
    if (word == "all") return choose([](std::uint32_t) { return true; }, "all", word);
    if (word == "loops") return add_loops(word);
    if (word.starts_with("every:")) return add_every(word, read_count(word, word.substr(6)));
    if (word.starts_with("count:")) return add_count(word, read_count(word, word.substr(6)));
    if (word.find(':') == std::string_view::npos) return choose([](std::uint32_t) { return true; }, word, word);
    add_residues(word);
  }

  std::vector<std::size_t> take() const {
    std::vector<std::size_t> positions;
    for (std::size_t k = 0; k < chosen_.size(); ++k)
      if (chosen_[k]) positions.push_back(k);
    return positions;
  }

 private:
  bool in_polymer(std::uint32_t r) const {
    return s_.residues[r].kind == ResidueKind::amino_acid || s_.residues[r].kind == ResidueKind::nucleotide;
  }

  /// "C5-C6", either way round.
  static bool is_bond(const Structure& s, const Torsion& torsion, std::string_view word) {
    const std::string &a = s.atoms[torsion.atoms[1]].name, &b = s.atoms[torsion.atoms[2]].name;
    return word.size() == a.size() + b.size() + 1 && (word == a + "-" + b || word == b + "-" + a);
  }

  /// Frees the torsions of residues for which `in` holds whose name falls under `names`.
  template <class InResidues>
  void choose(const InResidues& in, std::string_view names, std::string_view word) {
    static constexpr std::array<std::string_view, 18> words{"all",  "backbone", "ligands", "phi",   "psi",  "omega",
                                                            "chi",  "chi1",     "chi2",    "chi3",  "chi4", "chi5",
                                                            "beta", "gamma",    "epsilon", "alpha", "zeta", "kappa"};
    if (names == "delta") refuse(word, "a torsion that turns; delta lies in the ring of the sugar, which is rigid");
    const bool by_atoms = names.find('-') != std::string_view::npos;
    if (!by_atoms && std::find(words.begin(), words.end(), names) == words.end())
      refuse(word,
             "all, none, backbone, chi, ligands, loops, every:N, count:K, a torsion name or CHAIN:RESIDUES[:NAME]");
    bool found = false;
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      const Torsion& torsion = molecule_.torsions()[k];
      if (!in(torsion.residue)) continue;
      const std::string_view name = torsion.name;
      const bool polymer = in_polymer(torsion.residue), bond = name.find('-') != std::string_view::npos;
      const bool side_chain = polymer && (name.starts_with("chi") || name == "kappa" || bond);
      bool wanted = by_atoms ? is_bond(s_, torsion, names) : name == names;
      if (names == "chi") wanted = side_chain;
      if (names == "ligands") wanted = !polymer;
      if (names == "all" || (names == "backbone" && polymer && !side_chain)) wanted = name != "omega" || omega_;
      found = found || wanted;
      if (wanted) chosen_[k] = true;
    }
    if (by_atoms && !found) refuse(word, "the two atoms of a bond that turns there");
  }

  void add_loops(std::string_view word) {
    std::vector<bool> structured(s_.residues.size(), false);
    for (const SecondaryStructure& element : s_.secondary_structure)
      std::fill(structured.begin() + element.first, structured.begin() + element.last + 1, true);
    if (s_.secondary_structure.empty()) refuse(word, "a file with HELIX or SHEET records; this one has none");
    choose([&](std::uint32_t r) { return !structured[r]; }, "all", word);
  }

  void add_every(std::string_view word, std::size_t n) {
    std::vector<std::uint32_t> residues;
    for (std::size_t k = n; k <= polymer_.size(); k += n) residues.push_back(polymer_[k - 1]);
    choose_residues(residues, word);
  }

  void add_count(std::string_view word, std::size_t count) {
    const std::size_t n = polymer_.size();
    if (count > n) refuse(word, "at most the " + std::to_string(n) + " amino acids and nucleotides there are");
    std::vector<std::uint32_t> residues;
    for (std::size_t i = 0; i < count; ++i) residues.push_back(polymer_[(2 * i + 1) * n / (2 * count)]);
    choose_residues(residues, word);
  }

  void choose_residues(const std::vector<std::uint32_t>& sorted, std::string_view word) {
    choose([&](std::uint32_t r) { return std::binary_search(sorted.begin(), sorted.end(), r); }, "all", word);
  }

  void add_residues(std::string_view word) {
    // No residue's number starts with a lower-case letter: torsions of a whole chain.
    if (const std::size_t colon = word.find(':');
        colon + 1 < word.size() && word[colon + 1] >= 'a' && word[colon + 1] <= 'z')
      return add_chain(word.substr(0, colon), word.substr(colon + 1), word);
    const ResidueRange range = read_residue_range(s_, word);
    const std::string_view name = range.rest.empty() ? "all" : range.rest.substr(1);
    choose([&](std::uint32_t r) { return range.first <= r && r <= range.last; }, name, word);
  }

  void add_chain(std::string_view chain, std::string_view names, std::string_view word) {
    const auto is_in = [&](std::uint32_t r) {
      return s_.chains[s_.residues[r].chain].name == (chain == "_" ? std::string_view() : chain);
    };
    bool seen = false;
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r) seen = seen || is_in(r);
    if (!seen) refuse(word, "a chain of the file; there is no chain '" + std::string(chain) + "'");
    choose(is_in, names, word);
  }

  const Molecule& molecule_;
  const Structure& s_;
  bool omega_;
  std::vector<bool> chosen_;
  std::vector<std::uint32_t> polymer_;
};

}  // namespace

std::vector<std::size_t> select_torsions(const Molecule& molecule, std::string_view spec, bool omega) {
  Selector selector(molecule, omega);
  while (true) {
    const std::size_t comma = spec.find(',');
    selector.add(spec.substr(0, comma));
    if (comma == std::string_view::npos) break;
    spec.remove_prefix(comma + 1);
  }
  return selector.take();
}

}  // namespace hinge::molecular
