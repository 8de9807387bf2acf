// SPDX-License-Identifier: BSD-3-Clause
// ResidueWords: finds the residues that words select.
#include "chemistry/residue_words.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

#include "hinge/core/number_text.hpp"

namespace hinge::molecular {

namespace {

struct ResidueNumber {
  int number = 0;
  char insertion_code = '\0';
};

/// Reads "45", "-3" or "60A" and removes it from the text.
std::optional<ResidueNumber> read_number(std::string_view& text) {
  ResidueNumber result;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result.number);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (!text.empty() && text.front() != '-') {
    result.insertion_code = text.front();
    text.remove_prefix(1);
  }
  return result;
}

struct NumberRange {
  ResidueNumber first, last;
};

/// Reads "45", "10-20", "-5--1" or "60A-60C"; nullopt for any other form.
std::optional<NumberRange> read_range(std::string_view text) {
  const auto first = read_number(text);
  auto last = first;
  if (first && text.starts_with('-')) {
    text.remove_prefix(1);
    last = read_number(text);
  }
  if (!first || !last || !text.empty()) return std::nullopt;
  return NumberRange{*first, *last};
}

std::size_t read_count(const SelectionWord& word, std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value == 0) refuse(word, "a whole number above 0");
  return value;
}

}  // namespace

bool ResidueWords::in_polymer(std::uint32_t residue) const {
  return s_.residues[residue].kind == ResidueKind::amino_acid || s_.residues[residue].kind == ResidueKind::nucleotide;
}

bool ResidueWords::is_range(std::string_view text) { return read_range(text).has_value(); }

bool ResidueWords::is_in(std::uint32_t residue, std::string_view chain) const {
  return s_.chains[s_.residues[residue].chain].name == (chain == "_" ? std::string_view() : chain);
}

std::vector<bool> ResidueWords::select(const SelectionWord& word, std::span<const SelectionWord> /*bound*/) {
  if (auto found = find(word, word.text)) return *std::move(found);
  const std::size_t colon = word.text.find(':');
  if (colon == std::string_view::npos)
    refuse(word, "a chain (" + chains() + "), the name of a residue, CHAIN:RESIDUES or file:N" + left_out());
  refuse(word, "CHAIN:45, CHAIN:10-20 or CHAIN:NAME of a residue in the structure" + left_out());
}

std::optional<std::vector<bool>> ResidueWords::find(const SelectionWord& word, std::string_view text) const {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return find_bare(word, text);
  const std::string_view before = text.substr(0, colon), behind = text.substr(colon + 1);
  if (before == "file") return of_file(word, behind);
  if (before == "every") return every(read_count(word, behind));
  if (before == "count") return count(word, read_count(word, behind));
  return find_in_chain(word, before, behind);
}

std::vector<bool> ResidueWords::chain(const SelectionWord& word, std::string_view name) const {
  std::vector<bool> set(s_.residues.size(), false);
  for (std::uint32_t r = 0; r < set.size(); ++r) set[r] = is_in(r, name);
  if (std::ranges::none_of(set, [](bool in) { return in; }))
    refuse(word, "a chain (" + chains() + "); there is no chain '" + std::string(name) + "'" + left_out());
  return set;
}

std::optional<std::vector<bool>> ResidueWords::find_bare(const SelectionWord& word, std::string_view text) const {
  std::vector<bool> set(s_.residues.size(), text == "all");
  if (text == "all") return set;
  if (text == "loops") return loops(word);
  constexpr std::string_view confidence = "plddt";
  if (text.starts_with(confidence) && text.size() > confidence.size() &&
      (text[confidence.size()] == '<' || text[confidence.size()] == '>'))
    return by_confidence(word, text.substr(confidence.size()));
  for (std::uint32_t r = 0; r < set.size(); ++r) set[r] = text == "ligands" ? !in_polymer(r) : is_in(r, text);
  if (text == "ligands" || std::ranges::any_of(set, [](bool in) { return in; })) return set;
  for (std::uint32_t r = 0; r < set.size(); ++r) set[r] = s_.residues[r].name == text;
  if (auto found = named(word, std::move(set))) return found;
  if (is_range(text)) refuse(word, "a chain before the number of a residue, as in A:" + std::string(text));
  return std::nullopt;
}

/// Returns the set of residues of one name; nullopt if it is empty. Throws ModelError if it has several residues but
/// names must be unique.
std::optional<std::vector<bool>> ResidueWords::named(const SelectionWord& word, std::vector<bool> set) const {
  const auto count = static_cast<std::size_t>(std::ranges::count(set, true));
  if (count == 0) return std::nullopt;
  if (count == 1 || names_ == ResidueNames::all) return set;
  std::string some = std::to_string(count) + ":";
  for (std::uint32_t r = 0, shown = 0; r < set.size() && shown < 4; ++r)
    if (set[r]) {
      some += ' ' + residue_label(s_, r);
      ++shown;
    }
  refuse(word, "one residue, found " + some + (count > 4 ? " ..." : "") + "; choose one as CHAIN:NUMBER");
}

std::optional<std::vector<bool>> ResidueWords::find_in_chain(const SelectionWord& word, std::string_view name,
                                                             std::string_view text) const {
  std::vector<bool> in = chain(word, name);
  const auto range = read_range(text);
  const auto position = [&](const ResidueNumber& wanted) {
    std::uint32_t r = 0;
    while (r < in.size() && !(in[r] && s_.residues[r].sequence_number == wanted.number &&
                              s_.residues[r].insertion_code == wanted.insertion_code))
      ++r;
    return r;
  };
  std::vector<bool> of_name(in.size(), false);
  for (std::uint32_t r = 0; r < in.size(); ++r) of_name[r] = in[r] && s_.residues[r].name == text;
  // Names may start with a digit, or be a number in an unusual form: "017".
  if (auto found = named(word, std::move(of_name))) {
    if (range && std::to_string(range->first.number) == text && position(range->first) < in.size())
      refuse(word, "a residue number or a residue name, but the chain has both: write " + std::string(name) + ":" +
                       std::string(text) + "-" + std::string(text) + " for the number, (" + std::string(name) +
                       " and " + std::string(text) + ") for the name");
    return found;
  }
  if (!range) return std::nullopt;
  const auto residue = [&](const ResidueNumber& wanted) {
    const std::uint32_t r = position(wanted);
    if (r < in.size()) return r;
    const auto first = std::ranges::find(in, true) - in.begin();
    const auto last = in.rend() - std::find(in.rbegin(), in.rend(), true) - 1;
    refuse(word, "a residue of chain " + std::string(name) + "; the chain has no residue " +
                     std::to_string(wanted.number) +
                     (wanted.insertion_code != '\0' ? std::string(1, wanted.insertion_code) : "") + ", it goes from " +
                     residue_label(s_, static_cast<std::uint32_t>(first)) + " to " +
                     residue_label(s_, static_cast<std::uint32_t>(last)));
  };
  const std::uint32_t from = residue(range->first), to = residue(range->last);
  if (from > to) refuse(word, "the first residue to come before the last");
  for (std::uint32_t r = 0; r < in.size(); ++r) in[r] = in[r] && from <= r && r <= to;
  return in;
}

/// comparison: "<70", "<=70", ">70" or ">=70".
std::vector<bool> ResidueWords::by_confidence(const SelectionWord& word, std::string_view comparison) const {
  const bool below = comparison.front() == '<', or_equal = comparison.size() > 1 && comparison[1] == '=';
  const std::string_view text = comparison.substr(or_equal ? 2 : 1);
  double limit = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), limit);
  if (error != std::errc{} || end != text.data() + text.size() || !(limit >= 0.0 && limit <= 100.0))
    refuse(word, "plddt<N, plddt<=N, plddt>N or plddt>=N with N from 0 to 100");
  for (const Atom& atom : s_.atoms)
    if (!(atom.b_factor >= 0.0 && atom.b_factor <= 100.0))
      refuse(word, "a predicted model, whose B-factor column holds pLDDT from 0 to 100; this one holds " +
                       number_text(atom.b_factor));
  std::vector<bool> set;
  for (const Residue& residue : s_.residues) {
    double sum = 0.0;
    for (std::uint32_t atom = residue.first_atom; atom < residue.last_atom; ++atom) sum += s_.atoms[atom].b_factor;
    const double mean = sum / static_cast<double>(residue.last_atom - residue.first_atom);
    set.push_back((below ? mean < limit : mean > limit) || (or_equal && mean == limit));
  }
  return set;
}

std::vector<bool> ResidueWords::of_file(const SelectionWord& word, std::string_view number) const {
  std::size_t wanted = 0, files = 0;
  for (const Chain& chain : s_.chains) files = std::max(files, std::size_t{chain.file} + 1);
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), wanted);
  if (error != std::errc{} || end != number.data() + number.size() || wanted == 0 || wanted > files)
    refuse(word, "file:N with N from 1 to " + std::to_string(files));
  std::vector<bool> set;
  for (const Residue& residue : s_.residues) set.push_back(s_.chains[residue.chain].file == wanted - 1);
  return set;
}

std::vector<std::uint32_t> ResidueWords::polymer() const {
  std::vector<std::uint32_t> residues;
  for (std::uint32_t r = 0; r < s_.residues.size(); ++r)
    if (in_polymer(r)) residues.push_back(r);
  return residues;
}

std::vector<bool> ResidueWords::every(std::size_t n) const {
  const std::vector<std::uint32_t> residues = polymer();
  std::vector<bool> set(s_.residues.size(), false);
  for (std::size_t k = 0; k < residues.size(); ++k)
    if ((k + 1) % n == 0) set[residues[k]] = true;
  return set;
}

std::vector<bool> ResidueWords::count(const SelectionWord& word, std::size_t n) const {
  const std::vector<std::uint32_t> residues = polymer();
  if (n > residues.size())
    refuse(word, "at most " + std::to_string(residues.size()) + ", the number of amino acids and nucleotides");
  std::vector<bool> set(s_.residues.size(), false);
  for (std::size_t i = 0; i < n; ++i) set[residues[(2 * i + 1) * residues.size() / (2 * n)]] = true;
  return set;
}

std::vector<bool> ResidueWords::loops(const SelectionWord& word) const {
  if (s_.secondary_structure.empty()) refuse(word, "a file with HELIX or SHEET records; this file has none");
  std::vector<bool> set(s_.residues.size(), true);
  for (const SecondaryStructure& element : s_.secondary_structure)
    for (std::uint32_t r = element.first; r <= element.last; ++r) set[r] = false;
  return set;
}

std::string ResidueWords::chains() const {
  std::vector<std::string> names;
  std::string text;
  for (const Chain& chain : s_.chains) {
    const std::string name = chain.name.empty() ? "_" : chain.name;
    if (std::ranges::find(names, name) != names.end()) continue;
    names.push_back(name);
    text += (text.empty() ? "" : " ") + name;
  }
  return text;
}

std::string ResidueWords::left_out() const {
  if (s_.hetero_dropped == 0) return "";
  return " (" + std::to_string(s_.hetero_dropped) + " hetero atoms were left out; --hetero keeps them)";
}

}  // namespace hinge::molecular
