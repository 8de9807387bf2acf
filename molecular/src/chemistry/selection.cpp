// SPDX-License-Identifier: BSD-3-Clause
// read_selection: the words of a selection that mean torsions.
#include "hinge/molecular/selection.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "chemistry/residue_words.hpp"

namespace hinge::molecular {

namespace {

constexpr std::array<std::string_view, 14> torsion_names{"phi",  "psi",  "omega", "chi1",  "chi2",    "chi3", "chi4",
                                                         "chi5", "beta", "gamma", "alpha", "epsilon", "zeta", "kappa"};

bool is_bond_name(std::string_view word) { return word.find('-') != std::string_view::npos; }
bool is_torsion_name(std::string_view word) {
  return !word.empty() && std::ranges::find(torsion_names, word) != torsion_names.end();
}
/// True if the word may follow CHAIN: or CHAIN:RESIDUES: in a list.
bool is_torsion_word(std::string_view word) {
  return is_torsion_name(word) || word == "all" || word == "backbone" || word == "chi" || word == "delta";
}

class TorsionWords {
 public:
  TorsionWords(const Molecule& molecule, std::vector<std::string>& notes)
      : m_(molecule), s_(molecule.structure()), residues_(s_), named_omega_(m_.torsions().size()), notes_(notes) {}

  /// Torsions omega that a word names.
  const std::vector<bool>& named_omega() const { return named_omega_; }
  bool asked_for_none() const { return asked_for_none_; }

  bool binds(std::string_view word, std::string_view next) const {
    if (!is_torsion_word(next) && !(is_bond_name(next) && next.find(':') == std::string_view::npos)) return false;
    const std::size_t colon = word.rfind(':');
    if (colon == std::string_view::npos) return false;
    const std::string_view last = word.substr(colon + 1);
    return is_torsion_word(last) || (is_bond_name(last) && !ResidueWords::is_range(last));
  }

  std::vector<bool> select(const SelectionWord& word, std::span<const SelectionWord> bound) {
    const std::string_view text = word.text;
    const std::size_t colon = text.find(':'), last = text.rfind(':');
    const std::string before(last_residues_);
    last_residues_ = {};
    if (colon == std::string_view::npos) return bare(word, before);
    const std::string_view name = text.substr(last + 1);
    last_residues_ = text;
    std::optional<std::vector<bool>> in;
    if (colon != last) {
      in = residues_.find(word, text.substr(0, last));
      if (!in) refuse(word, "CHAIN:RESIDUES:TORSION, as in A:45:chi1 or A:10-20:backbone" + residues_.left_out());
    } else if (is_torsion_word(name) || name == "ligands") {
      in = residues_.chain(word, text.substr(0, colon));
    } else if (in = residues_.find(word, text); in) {
      std::vector<bool> chosen = choose(*in, "all");
      require_some(word, chosen, *in);
      return chosen;
    } else if (is_bond_name(name)) {
      in = residues_.chain(word, text.substr(0, colon));
    } else {
      refuse(word, "CHAIN:45, CHAIN:10-20, CHAIN:NAME, CHAIN:45:chi1 or CHAIN:chi1" + residues_.left_out());
    }
    last_residues_ = text.substr(0, last);
    std::vector<bool> chosen = named(word, *in, name);
    for (const SelectionWord& more : bound) {
      const std::vector<bool> also = named(more, *in, more.text);
      for (std::size_t k = 0; k < chosen.size(); ++k) chosen[k] = chosen[k] || also[k];
    }
    return chosen;
  }

 private:
  using Set = std::vector<bool>;
  static bool any(const Set& set) { return std::ranges::find(set, true) != set.end(); }

  /// Returns the torsions of the residues `in` by the name that follows them.
  Set named(const SelectionWord& word, const Set& in, std::string_view name) {
    if (!is_torsion_word(name) && name != "ligands" && !is_bond_name(name))
      refuse(word, "a torsion (" + names_in(in) + "), backbone, chi or all after the residues");
    Set chosen = choose(in, checked(word, name));
    require_some(word, chosen, in);
    return chosen;
  }

  /// Returns the torsions of a word without residues. before: the residues of the preceding word, for a note.
  Set bare(const SelectionWord& word, const std::string& before) {
    const std::string_view text = word.text;
    const Set everywhere(s_.residues.size(), true);
    if (text == "none") {
      asked_for_none_ = true;
      return Set(m_.torsions().size(), false);
    }
    if (is_torsion_word(text) && text != "all") {
      Set chosen = choose(everywhere, checked(word, text));
      const auto count = std::ranges::count(chosen, true);
      const std::string name(text);
      if (count == 0)
        notes_.push_back(about(word) + "selects nothing; the molecule has " + names_in(everywhere));
      else if (word.alternative && !before.empty())
        notes_.push_back(about(word) + "selects torsions of all residues (" + std::to_string(count) +
                         "), not only of " + before + "; write " + before + ":" + name + " for these residues");
      return chosen;
    }
    if (const auto in = residues_.find(word, text)) {
      Set chosen = choose(*in, "all");
      if (text == "all" || text == "loops" || text == "ligands") {
        if (!any(chosen) && text != word.expression) notes_.push_back(about(word) + "selects nothing");
        return chosen;
      }
      last_residues_ = text;
      require_some(word, chosen, *in);
      return chosen;
    }
    if (!is_bond_name(text))
      refuse(word, "all, none, backbone, chi, ligands, loops, every:N, count:K, the name of a torsion (" +
                       names_in(everywhere) + "), a chain (" + residues_.chains() +
                       "), the name of a residue, CHAIN:RESIDUES[:NAME] or file:N" + residues_.left_out());
    Set chosen = choose(everywhere, text);
    require_some(word, chosen, everywhere);
    return chosen;
  }

  static std::string_view checked(const SelectionWord& word, std::string_view name) {
    if (name == "delta") refuse(word, "a rotatable torsion; delta lies in the sugar ring, which is rigid");
    return name;
  }

  /// True if the torsion is about this bond, "C5-C6" in either order.
  bool is_bond(const Torsion& torsion, std::string_view word) const {
    const std::string &a = s_.atoms[torsion.atoms[1]].name, &b = s_.atoms[torsion.atoms[2]].name;
    return word.size() == a.size() + b.size() + 1 && (word == a + "-" + b || word == b + "-" + a);
  }

  /// Returns the torsions of these residues that match a name.
  Set choose(const Set& in, std::string_view name) {
    const bool by_atoms = is_bond_name(name), by_name = by_atoms || is_torsion_name(name);
    Set chosen(m_.torsions().size(), false);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const Torsion& torsion = m_.torsions()[k];
      if (!in[torsion.residue]) continue;
      const bool polymer = residues_.in_polymer(torsion.residue);
      const bool side_chain =
          polymer && (torsion.name.starts_with("chi") || torsion.name == "kappa" || is_bond_name(torsion.name));
      if (by_atoms)
        chosen[k] = is_bond(torsion, name);
      else if (name == "chi")
        chosen[k] = side_chain;
      else if (name == "ligands")
        chosen[k] = !polymer;
      else if (name == "backbone")
        chosen[k] = polymer && !side_chain;
      else
        chosen[k] = name == "all" || torsion.name == name;
      if (by_name && chosen[k] && torsion.name == "omega") named_omega_[k] = true;
    }
    return chosen;
  }

  void require_some(const SelectionWord& word, const Set& chosen, const Set& in) const {
    if (!any(chosen)) refuse(word, "a rotatable torsion of these residues; they have " + names_in(in));
  }

  /// Returns "phi, psi, chi1": the names of these residues' torsions, at most twelve.
  std::string names_in(const Set& in) const {
    std::vector<std::string> names;
    for (const Torsion& torsion : m_.torsions())
      if (in[torsion.residue] && std::ranges::find(names, torsion.name) == names.end()) names.push_back(torsion.name);
    if (names.empty()) return "none";
    std::string text;
    for (std::size_t k = 0; k < std::min<std::size_t>(names.size(), 12); ++k) text += (k == 0 ? "" : ", ") + names[k];
    return text + (names.size() > 12 ? " ..." : "");
  }

  static std::string about(const SelectionWord& word) {
    return "selection '" + std::string(word.expression) + "': '" + std::string(word.text) + "' ";
  }

  const Molecule& m_;
  const Structure& s_;
  ResidueWords residues_;
  Set named_omega_;
  bool asked_for_none_ = false;
  std::vector<std::string>& notes_;
  std::string_view last_residues_;  // residues of the preceding word; empty: it named none
};

}  // namespace

SelectedTorsions read_selection(const Molecule& molecule, std::string_view expression, bool omega) {
  SelectedTorsions result;
  TorsionWords words(molecule, result.notes);
  const auto torsions = molecule.torsions();
  std::vector<SelectionTerm> terms = read_terms(expression, words_of(words));
  const auto turns = [&](std::size_t k) { return omega || torsions[k].name != "omega" || words.named_omega()[k]; };
  std::vector<bool> chosen(torsions.size(), false);
  for (SelectionTerm& term : terms) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < torsions.size(); ++k) {
      if (!term.selected[k] || !turns(k)) continue;
      chosen[k] = true;
      ++count;
    }
    result.words.push_back({std::string(term.text), count});
  }
  std::size_t all = 0;
  for (std::size_t k = 0; k < torsions.size(); ++k) {
    if (chosen[k]) result.torsions.push_back(k);
    if (omega || torsions[k].name != "omega") ++all;
  }
  // "all" is the default, also for molecules without torsions.
  if (result.torsions.empty() && !words.asked_for_none() && expression != "all")
    refuse({expression, expression}, "at least one torsion to free; it selects nothing" +
                                         (result.notes.empty() ? std::string() : " (" + result.notes.front() + ")"));
  if (result.words.size() > 1)
    for (const SelectedTorsions::Word& word : result.words) {
      const std::string who = "selection '" + std::string(expression) + "': '" + word.text + "' ";
      if (word.count >= all && all > 0)
        result.notes.push_back(who + "frees all " + std::to_string(word.count) +
                               " torsions, regardless of the other words");
      else if (word.count == 0 && word.text != "none" &&
               std::ranges::none_of(result.notes, [&](const std::string& note) { return note.starts_with(who); }))
        result.notes.push_back(who + "selects nothing");
    }
  return result;
}

std::vector<std::size_t> select_torsions(const Molecule& molecule, std::string_view expression, bool omega) {
  return read_selection(molecule, expression, omega).torsions;
}

}  // namespace hinge::molecular
