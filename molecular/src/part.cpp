// SPDX-License-Identifier: BSD-3-Clause
// The grammar of parts.
#include "hinge/molecular/part.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>

#include "hinge/core/error.hpp"
#include "residue_range.hpp"

namespace hinge::molecular {

namespace {

class PartFinder {
 public:
  PartFinder(const Structure& structure, ResidueNames names) : s_(structure), names_(names) {}

  void add(std::string_view word) {
    word_ = word;
    if (word.empty()) refuse(word_, "a chain, a residue or a file on either side of '+'");
    const std::size_t colon = word.find(':');
    if (colon == std::string_view::npos) return add_name(word);
    if (word.starts_with("file:")) return add_file(word.substr(5));
    add_in_chain(word.substr(0, colon), word.substr(colon + 1));
  }

  std::vector<std::uint32_t> take() {
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    return std::move(found_);
  }

 private:
  /// Adds the residues for which `holds`; how many they are.
  template <class Holds>
  std::size_t add_where(const Holds& holds) {
    const std::size_t before = found_.size();
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r)
      if (holds(s_.residues[r])) found_.push_back(r);
    return found_.size() - before;
  }
  /// Residues of a name; false where there are none.
  template <class Holds>
  bool add_named(const Holds& holds) {
    const std::size_t count = add_where(holds);
    if (count > 1 && names_ == ResidueNames::only) refuse(word_, "one residue; there are " + some(count));
    return count > 0;
  }
  bool is_in(const Residue& residue, std::string_view chain) const {
    return s_.chains[residue.chain].name == (chain == "_" ? std::string_view() : chain);
  }

  void add_name(std::string_view name) {
    if (add_where([&](const Residue& residue) { return is_in(residue, name); }) > 0) return;
    if (!add_named([&](const Residue& residue) { return residue.name == name; }))
      refuse(word_, "a chain (" + chains() + "), the name of a residue, CHAIN:RESIDUES or file:N" + left_out());
  }

  void add_file(std::string_view text) {
    std::size_t number = 0, files = 0;
    for (const Chain& chain : s_.chains) files = std::max(files, std::size_t{chain.file} + 1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number == 0 || number > files)
      refuse(word_, "file:N with N from 1 to " + std::to_string(files));
    add_where([&](const Residue& residue) { return s_.chains[residue.chain].file == number - 1; });
  }

  void add_in_chain(std::string_view chain, std::string_view text) {
    if (std::ranges::none_of(s_.residues, [&](const Residue& residue) { return is_in(residue, chain); }))
      refuse(word_, "a chain (" + chains() + "); there is no chain '" + std::string(chain) + "'");
    // Names may start with a digit, or be a number that nobody would write so: "017".
    if (add_named([&](const Residue& residue) { return is_in(residue, chain) && residue.name == text; })) return;
    if (text.empty() || (text.front() != '-' && (text.front() < '0' || text.front() > '9')))
      refuse(word_, "CHAIN:45, CHAIN:10-20 or CHAIN:NAME of a residue there is" + left_out());
    const ResidueRange range = read_residue_range(s_, word_);
    if (!range.rest.empty()) refuse(word_, "CHAIN:45, CHAIN:10-20 or CHAIN:NAME");
    for (std::uint32_t r = range.first; r <= range.last; ++r)
      if (is_in(s_.residues[r], chain)) found_.push_back(r);
  }

  std::string chains() const {
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
  /// The last `count` residues found, the first few of them named.
  std::string some(std::size_t count) const {
    std::string text = std::to_string(count) + ":";
    for (std::size_t k = 0; k < std::min(count, std::size_t{4}); ++k) {
      const std::string atom = label(s_, s_.residues[found_[found_.size() - count + k]].first_atom);
      text += ' ';
      text += atom.substr(0, atom.rfind(':'));
    }
    return text + (count > 4 ? " ..." : "") + "; say which as CHAIN:NUMBER";
  }
  std::string left_out() const {
    if (s_.hetero_dropped == 0) return "";
    std::string text = " (";
    text += std::to_string(s_.hetero_dropped);
    return text + " hetero atoms were left out; they are kept on request)";
  }

  const Structure& s_;
  ResidueNames names_;
  std::string_view word_;
  std::vector<std::uint32_t> found_;
};

}  // namespace

Part find_part(const Structure& structure, std::string_view words, ResidueNames names) {
  PartFinder finder(structure, names);
  Part part;
  part.name = words;
  while (true) {
    const std::size_t plus = words.find('+');
    finder.add(words.substr(0, plus));
    if (plus == std::string_view::npos) break;
    words.remove_prefix(plus + 1);
  }
  part.residues = finder.take();
  return part;
}

Part rest_of(const Structure& structure, const Part& part) {
  Part rest;
  rest.name = "rest";
  for (std::uint32_t r = 0; r < structure.residues.size(); ++r)
    if (!std::ranges::binary_search(part.residues, r)) rest.residues.push_back(r);
  if (rest.residues.empty())
    throw ModelError("the rest of '" + part.name + "': expected a part that is not everything");
  return rest;
}

std::vector<bool> atoms_in(const Structure& structure, const Part& part) {
  std::vector<bool> in(structure.atoms.size(), false);
  for (const std::uint32_t r : part.residues)
    std::fill(in.begin() + structure.residues[r].first_atom, in.begin() + structure.residues[r].last_atom, true);
  return in;
}

}  // namespace hinge::molecular
