// SPDX-License-Identifier: BSD-3-Clause
// The grammar of selections.
#include "hinge/molecular/selection.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

[[noreturn]] void refuse(std::string_view word, const std::string& expected) {
  throw ModelError("selection '" + std::string(word) + "': expected " + expected);
}

struct ResidueNumber {
  int number;
  char insertion_code;
};

/// "45", "-3", "60A"; consumes what it read.
std::optional<ResidueNumber> read_number(std::string_view& text) {
  ResidueNumber result{0, '\0'};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result.number);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (!text.empty() && text.front() != '-' && text.front() != ':') {
    result.insertion_code = text.front();
    text.remove_prefix(1);
  }
  return result;
}

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
      if (s_.residues[r].kind == ResidueKind::amino_acid) amino_acids_.push_back(r);
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
  /// Frees the torsions of residues for which `in` holds whose name falls under `names`.
  template <class InResidues>
  void choose(const InResidues& in, std::string_view names, std::string_view word) {
    const bool known = names == "all" || names == "backbone" || names == "phi" || names == "psi" || names == "omega" ||
                       names == "chi" ||
                       (names.size() == 4 && names.starts_with("chi") && names[3] >= '1' && names[3] <= '5');
    if (!known)
      refuse(word, "all, none, backbone, chi, loops, every:N, count:K, a torsion name or CHAIN:RESIDUES[:NAME]");
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      const Torsion& torsion = molecule_.torsions()[k];
      if (!in(torsion.residue)) continue;
      const std::string_view name = torsion.name;
      const bool chi = name.starts_with("chi");
      bool wanted = name == names || (names == "chi" && chi);
      if (names == "all" || (names == "backbone" && !chi)) wanted = name != "omega" || omega_;
      if (wanted) chosen_[k] = true;
    }
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
    for (std::size_t k = n; k <= amino_acids_.size(); k += n) residues.push_back(amino_acids_[k - 1]);
    choose_residues(residues, word);
  }

  void add_count(std::string_view word, std::size_t count) {
    const std::size_t n = amino_acids_.size();
    if (count > n) refuse(word, "at most the " + std::to_string(n) + " amino acids there are");
    std::vector<std::uint32_t> residues;
    for (std::size_t i = 0; i < count; ++i) residues.push_back(amino_acids_[(2 * i + 1) * n / (2 * count)]);
    choose_residues(residues, word);
  }

  void choose_residues(const std::vector<std::uint32_t>& sorted, std::string_view word) {
    choose([&](std::uint32_t r) { return std::binary_search(sorted.begin(), sorted.end(), r); }, "all", word);
  }

  void add_residues(std::string_view word) {
    const std::string_view chain = word.substr(0, word.find(':'));
    std::string_view rest = word.substr(chain.size() + 1);
    const auto first = read_number(rest);
    auto last = first;
    if (first && rest.starts_with('-')) {
      rest.remove_prefix(1);
      last = read_number(rest);
    }
    if (!first || !last || !(rest.empty() || rest.starts_with(':')))
      refuse(word, "CHAIN:45, CHAIN:10-20 or CHAIN:45:chi1");
    const std::uint32_t from = find(chain, *first, word), to = find(chain, *last, word);
    if (from > to) refuse(word, "the first residue to come before the last");
    const std::string_view name = rest.empty() ? "all" : rest.substr(1);
    choose([&](std::uint32_t r) { return from <= r && r <= to; }, name, word);
  }

  std::uint32_t find(std::string_view chain, ResidueNumber wanted, std::string_view word) const {
    const std::string_view name = chain == "_" ? std::string_view() : chain;
    bool chain_seen = false;
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r) {
      const Residue& residue = s_.residues[r];
      if (s_.chains[residue.chain].name != name) continue;
      chain_seen = true;
      if (residue.sequence_number == wanted.number && residue.insertion_code == wanted.insertion_code) return r;
    }
    if (!chain_seen) refuse(word, "a chain of the file; there is no chain '" + std::string(chain) + "'");
    refuse(word, "a residue of chain " + std::string(chain) + "; it has no " + std::to_string(wanted.number) +
                     (wanted.insertion_code != '\0' ? std::string(1, wanted.insertion_code) : ""));
  }

  const Molecule& molecule_;
  const Structure& s_;
  bool omega_;
  std::vector<bool> chosen_;
  std::vector<std::uint32_t> amino_acids_;
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
