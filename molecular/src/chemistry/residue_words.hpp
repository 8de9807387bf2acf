// SPDX-License-Identifier: BSD-3-Clause
// ResidueWords: words that select residues: "A", "KNI", "A:45", "A:10-20", "_:60A", "A:HEM", "file:2", "loops",
// "every:4", "plddt<70".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/selection_expression.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Finds the residues that a word selects. Sets have one value per residue. The structure must outlive this object.
class ResidueWords {
 public:
  explicit ResidueWords(const Structure& structure, ResidueNames names = ResidueNames::all)
      : s_(structure), names_(names) {}

  /// The members that words_of() needs: no word binds another, and select() throws ModelError if `word` is unknown.
  static bool binds(std::string_view, std::string_view) { return false; }
  std::vector<bool> select(const SelectionWord& word, std::span<const SelectionWord> bound);

  /// Returns the residues that `text` selects; text is `word` or its beginning, for messages. nullopt if it does not
  /// have the form of a residue word. Throws ModelError if a chain, residue or file does not exist.
  std::optional<std::vector<bool>> find(const SelectionWord& word, std::string_view text) const;
  /// Returns the residues of a chain. Throws ModelError if there is no chain of that name.
  std::vector<bool> chain(const SelectionWord& word, std::string_view name) const;
  /// True for amino acids and nucleotides.
  bool in_polymer(std::uint32_t residue) const;
  /// True for the form of a residue number or range: "45", "10-20", "60A".
  static bool is_range(std::string_view text);

  /// Returns the names of all chains, "A B _".
  std::string chains() const;
  /// Returns " (12 hetero atoms were left out; --hetero keeps them)", or an empty string.
  std::string left_out() const;

 private:
  std::optional<std::vector<bool>> find_bare(const SelectionWord& word, std::string_view text) const;
  std::optional<std::vector<bool>> find_in_chain(const SelectionWord& word, std::string_view name,
                                                 std::string_view text) const;
  std::vector<bool> by_confidence(const SelectionWord& word, std::string_view comparison) const;
  std::vector<bool> of_file(const SelectionWord& word, std::string_view number) const;
  std::vector<bool> every(std::size_t n) const;
  std::vector<bool> count(const SelectionWord& word, std::size_t n) const;
  std::vector<bool> loops(const SelectionWord& word) const;
  std::optional<std::vector<bool>> named(const SelectionWord& word, std::vector<bool> set) const;
  std::vector<std::uint32_t> polymer() const;
  bool is_in(std::uint32_t residue, std::string_view chain) const;

  const Structure& s_;
  ResidueNames names_;
};

}  // namespace hinge::molecular
