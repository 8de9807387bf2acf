// SPDX-License-Identifier: BSD-3-Clause
// Words that stand for residues: "A", "KNI", "A:45", "A:10-20", "_:60A", "A:HEM", "file:2", "loops", "every:4".
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

/// The residues that a word stands for. Sets have one value per residue.
class ResidueWords {
 public:
  explicit ResidueWords(const Structure& structure, ResidueNames names = ResidueNames::all)
      : s_(structure), names_(names) {}

  static bool binds(std::string_view, std::string_view) { return false; }
  std::vector<bool> select(const SelectionWord& word, std::span<const SelectionWord> bound);

  /// As `text`, the whole of `word` or its beginning, says; none when it has no form that residues have. ModelError: a
  /// chain, residue or file that is not there.
  std::optional<std::vector<bool>> find(const SelectionWord& word, std::string_view text) const;
  /// The residues of a chain. ModelError: there is none.
  std::vector<bool> chain(const SelectionWord& word, std::string_view name) const;
  bool in_polymer(std::uint32_t residue) const;
  /// "45", "10-20", "60A"?
  static bool is_range(std::string_view text);

  /// "A B _": the names of all chains.
  std::string chains() const;
  /// " (12 hetero atoms were left out; --hetero keeps them)", or nothing.
  std::string left_out() const;

 private:
  std::optional<std::vector<bool>> find_bare(const SelectionWord& word, std::string_view text) const;
  std::optional<std::vector<bool>> find_in_chain(const SelectionWord& word, std::string_view name,
                                                 std::string_view text) const;
  std::vector<bool> of_file(const SelectionWord& word, std::string_view number) const;
  std::vector<bool> every(std::size_t n) const;
  std::vector<bool> count(const SelectionWord& word, std::size_t n) const;
  std::vector<bool> loops(const SelectionWord& word) const;
  std::optional<std::vector<bool>> named(const SelectionWord& word, std::vector<bool> set) const;
  std::vector<std::uint32_t> polymer() const;
  bool is_in(std::uint32_t residue, std::string_view chain) const;
  std::string name_of(std::uint32_t residue) const;

  const Structure& s_;
  ResidueNames names_;
};

}  // namespace hinge::molecular
