// SPDX-License-Identifier: BSD-3-Clause
// Reads residue ranges.
#include "residue_range.hpp"

#include <charconv>
#include <optional>
#include <system_error>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

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

std::uint32_t find(const Structure& s, std::string_view chain, ResidueNumber wanted, std::string_view word) {
  const std::string_view name = chain == "_" ? std::string_view() : chain;
  bool chain_seen = false;
  for (std::uint32_t r = 0; r < s.residues.size(); ++r) {
    const Residue& residue = s.residues[r];
    if (s.chains[residue.chain].name != name) continue;
    chain_seen = true;
    if (residue.sequence_number == wanted.number && residue.insertion_code == wanted.insertion_code) return r;
  }
  if (!chain_seen) refuse(word, "a chain of the file; there is no chain '" + std::string(chain) + "'");
  refuse(word, "a residue of chain " + std::string(chain) + "; it has no " + std::to_string(wanted.number) +
                   (wanted.insertion_code != '\0' ? std::string(1, wanted.insertion_code) : ""));
}

}  // namespace

void refuse(std::string_view word, const std::string& expected) {
  throw ModelError("selection '" + std::string(word) + "': expected " + expected);
}

ResidueRange read_residue_range(const Structure& structure, std::string_view word) {
  const std::string_view chain = word.substr(0, word.find(':'));
  std::string_view rest = chain.size() < word.size() ? word.substr(chain.size() + 1) : std::string_view();
  const auto first = read_number(rest);
  auto last = first;
  if (first && rest.starts_with('-')) {
    rest.remove_prefix(1);
    last = read_number(rest);
  }
  if (!first || !last || !(rest.empty() || rest.starts_with(':')))
    refuse(word, "CHAIN:45, CHAIN:10-20 or CHAIN:45:chi1");
  const std::uint32_t from = find(structure, chain, *first, word), to = find(structure, chain, *last, word);
  if (from > to) refuse(word, "the first residue to come before the last");
  return {from, to, rest};
}

}  // namespace hinge::molecular
