// SPDX-License-Identifier: BSD-3-Clause
// Tests the grammar of selections: random expressions against a naive evaluator, operator binding, rejected input,
// notes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "extremes/refusal.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/selection.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace selection_test {

using Set = std::set<std::size_t>;

/// Returns a protein with chains A (1 ... 12), AB (60, 60A, -3, -2, -1) and an unnamed chain (1 ... 4).
Structure three_chains() {
  Structure s = build_ideal_protein("AKRMFPWSTCVLGHEDKNQRY", "HHHHHCCEEEECCHHCCCCCC");
  s.chains.assign({{"A", 0, 12}, {"AB", 12, 17}, {"", 17, 21}});
  for (std::uint32_t c = 0; c < 3; ++c)
    for (std::uint32_t r = s.chains[c].first_residue; r < s.chains[c].last_residue; ++r) s.residues[r].chain = c;
  const int numbers[] = {60, 60, -3, -2, -1, 1, 2, 3, 4};
  for (std::uint32_t k = 0; k < 9; ++k) s.residues[12 + k].sequence_number = numbers[k];
  s.residues[13].insertion_code = 'A';
  return s;
}

const Molecule& molecule() {
  static const Molecule m(three_chains());
  return m;
}

Set select(const std::string& words, bool omega = false) {
  const auto chosen = select_torsions(molecule(), words, omega);
  return {chosen.begin(), chosen.end()};
}

/// Returns the selected torsions as "INDEX NAME", with the index of the residue, such as "0 psi".
std::set<std::string> named(const std::string& words) {
  std::set<std::string> names;
  for (const std::size_t k : select(words))
    names.insert(std::to_string(molecule().torsions()[k].residue) + " " + molecule().torsions()[k].name);
  return names;
}

std::string refusal_of(const std::string& words) {
  return test::refusal<ModelError>([&] { select_torsions(molecule(), words, false); });
}

// --- random expressions ---

/// An expression, its torsions (including omega), and the omegas that it selects by name.
struct Example {
  std::string text;
  Set selected, omegas;
};

class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {
    for (std::size_t k = 0; k < molecule().torsions().size(); ++k) all_.insert(k);
  }

  Example alternatives(int depth) {
    Example one = conjunction(depth);
    for (std::size_t more = below(3); more > 0; --more) {
      // After a comma, a bare torsion name would belong to a preceding list; `or` or parentheses separate it.
      const Example other = conjunction(depth);
      one.text += below(2) == 0 ? " or " + other.text : " , (" + other.text + ")";
      add(one.selected, other.selected);
      add(one.omegas, other.omegas);
    }
    return one;
  }

 private:
  std::size_t below(std::size_t n) { return random_() % n; }
  static void add(Set& to, const Set& more) { to.insert(more.begin(), more.end()); }
  Set where(const std::function<bool(const Torsion&)>& holds) const {
    Set found;
    for (const std::size_t k : all_)
      if (holds(molecule().torsions()[k])) found.insert(k);
    return found;
  }

  Example conjunction(int depth) {
    Example one = factor(depth);
    for (std::size_t more = below(4) == 0 ? 1 : 0; more > 0; --more) {
      const Example other = factor(depth);
      one.text += " and " + other.text;
      Set both;
      std::ranges::set_intersection(one.selected, other.selected, std::inserter(both, both.end()));
      one.selected = both;
      add(one.omegas, other.omegas);
    }
    return one;
  }

  Example factor(int depth) {
    const std::size_t kind = below(5);
    if (kind == 0 && depth > 0) {
      Example inner = alternatives(depth - 1);
      inner.text = "( " + inner.text + ")";
      return inner;
    }
    if (kind == 1 && depth > 0) {
      Example inner = factor(depth - 1);
      Set rest;
      std::ranges::set_difference(all_, inner.selected, std::inserter(rest, rest.end()));
      return {"not " + inner.text, rest, inner.omegas};
    }
    return word();
  }

  struct Name {
    const char* text;
    std::function<bool(const std::string&)> holds;
  };
  Name name() {
    static const std::vector<Name> names{
        {"phi", [](const std::string& n) { return n == "phi"; }},
        {"psi", [](const std::string& n) { return n == "psi"; }},
        {"omega", [](const std::string& n) { return n == "omega"; }},
        {"chi1", [](const std::string& n) { return n == "chi1"; }},
        {"CA-C", [](const std::string& n) { return n == "psi"; }},
        {"chi", [](const std::string& n) { return n.starts_with("chi"); }},
        {"backbone", [](const std::string& n) { return !n.starts_with("chi"); }},
        {"all", [](const std::string&) { return true; }},
    };
    return names[below(names.size())];
  }

  Example word() {
    const auto omegas = [&](const Set& of, const Name& by) {
      Set found;
      if (std::string(by.text) == "omega")
        for (const std::size_t k : of)
          if (molecule().torsions()[k].name == "omega") found.insert(k);
      return found;
    };
    if (below(3) == 0) {
      const Name by = name();
      const Set chosen = where([&](const Torsion& t) { return by.holds(t.name); });
      return {by.text, chosen, omegas(chosen, by)};
    }
    struct Residues {
      const char* text;
      std::uint32_t first, last;
    };
    static const std::vector<Residues> stretches{
        {"A:2-9", 1, 8},       {"A:4", 3, 3},        {"A:7-8", 6, 7},       {"AB:60", 12, 12}, {"AB:60A", 13, 13},
        {"AB:60-60A", 12, 13}, {"AB:-3--1", 14, 16}, {"AB:60A--2", 13, 15}, {"_:1-3", 17, 19}, {"A:TRP", 6, 6}};
    static const std::vector<Residues> wholes{{"A", 0, 11}, {"AB", 12, 16}, {"_", 17, 20}, {"file:1", 0, 20}};
    const bool chain = below(4) == 0;
    const Residues in = chain ? wholes[below(4)] : stretches[below(stretches.size())];
    const auto inside = [&](const Torsion& t) { return in.first <= t.residue && t.residue <= in.last; };
    Example one{in.text, where(inside), {}};
    if (below(3) == 0) return one;
    // A list of torsions of these residues. Names that select nothing there are rejected, so they are left out.
    one.selected.clear();
    for (std::size_t more = 1 + below(3); more > 0; --more) {
      const Name by = name();
      const Set chosen = where([&](const Torsion& t) { return inside(t) && by.holds(t.name); });
      if (chosen.empty()) continue;
      one.text += (one.selected.empty() ? ":" : below(2) == 0 ? "," : " + ") + std::string(by.text);
      add(one.selected, chosen);
      add(one.omegas, omegas(chosen, by));
    }
    if (one.selected.empty()) one.selected = where(inside);
    return one;
  }

  std::mt19937 random_;
  Set all_;
};

TEST(SelectionGrammar, GivesWhatANaiveEvaluatorGives) {
  constexpr std::uint32_t seed = 20240607;
  std::size_t nothing = 0, some = 0;
  for (std::uint32_t n = 0; n < 4000; ++n) {
    const Example example = Generator(seed + n).alternatives(3);
    for (const bool omega : {false, true}) {
      Set expected;
      for (const std::size_t k : example.selected)
        if (omega || molecule().torsions()[k].name != "omega" || example.omegas.contains(k)) expected.insert(k);
      if (expected.empty()) {
        ++nothing;
        EXPECT_THROW(select(example.text, omega), ModelError) << "seed " << seed + n << ": " << example.text;
        continue;
      }
      ++some;
      Set found;
      ASSERT_NO_THROW(found = select(example.text, omega)) << "seed " << seed + n << ": " << example.text;
      ASSERT_EQ(found, expected) << "seed " << seed + n << ": " << example.text;
    }
  }
  EXPECT_GT(nothing, 100U);
  EXPECT_GT(some, 5000U);
}

// --- operator binding ---

TEST(SelectionGrammar, BindsListsOfTorsionsToTheirResidues) {
  EXPECT_EQ(named("A:4-5:phi,psi"), (std::set<std::string>{"3 phi", "3 psi", "4 phi", "4 psi"}));
  EXPECT_EQ(named("A:4-5:phi, psi,AB:-3:chi1"), (std::set<std::string>{"3 phi", "3 psi", "4 phi", "4 psi", "14 chi1"}));
  EXPECT_EQ(named("A:4-5:phi,A:7:psi"), (std::set<std::string>{"3 phi", "4 phi", "6 psi"}));
  EXPECT_EQ(select("A:4-5,A:7:phi"), select("A:4-5 or A:7:phi"));
  EXPECT_EQ(select("A:phi,psi"), select("A and (phi or psi)"));
  EXPECT_EQ(select("A:4:N-CA,CA-C"), select("A:4:phi,psi"));
  EXPECT_EQ(select("A:4-5:phi,psi and A:5"), select("A:5:phi,psi"));
  EXPECT_EQ(select("not A:4-5:phi,psi"), select("not (A:4-5 and (phi,psi))"));
  // Words that apply to all residues do not belong to a list. A list in parentheses is closed.
  EXPECT_EQ(select("A:4:phi,A"), select("A"));
  EXPECT_EQ(select("A:4:phi,every:2"), select("every:2 or A:4:phi"));
  EXPECT_EQ(select("(A:4:phi),psi"), select("psi or A:4:phi"));
  EXPECT_EQ(select("A:4:phi or psi"), select("psi or A:4:phi"));
  EXPECT_EQ(select("A:4,psi"), select("psi or A:4"));
}

TEST(SelectionGrammar, HasItsWordsAsPartsDo) {
  EXPECT_EQ(select("AB"), select("AB:all"));
  EXPECT_EQ(select("A:TRP"), select("A:7"));
  EXPECT_EQ(select("file:1:chi"), select("chi"));
  EXPECT_EQ(select("TRP"), select("A:7"));
  EXPECT_EQ(select("every:3:chi1"), select("chi1 and every:3"));
}

TEST(SelectionGrammar, SaysWhereItFailsAndWhatThereIs) {
  EXPECT_EQ(refusal_of("A:4:phi,Q:3"),
            "selection 'A:4:phi,Q:3', at character 9 ('Q:3'): expected a chain (A AB _); there is no chain 'Q'");
  EXPECT_EQ(
      refusal_of("A:99"),
      "selection 'A:99': expected a residue of chain A; the chain has no residue 99, it goes from A:ALA1 to A:LEU12");
  EXPECT_EQ(refusal_of("A:4-5:phi,chi7").find("selection 'A:4-5:phi,chi7', at character 11 ('chi7'): expected all"),
            0U);
  EXPECT_EQ(refusal_of("AB:60:chi1"),
            "selection 'AB:60:chi1': expected a rotatable torsion of these residues; they have phi, psi, omega");
  EXPECT_EQ(refusal_of("A:4 and (phi,psi"),
            "selection 'A:4 and (phi,psi', at character 9 ('('): expected ')' for each '('");
  EXPECT_EQ(refusal_of("phi,"), "selection 'phi,', at its end: expected a selection word or '('");
  EXPECT_EQ(refusal_of("phi psi"),
            "selection 'phi psi', at character 5 ('psi'): expected ',', '+', 'and', 'or' or the end of the selection");
  EXPECT_EQ(
      refusal_of("A:4-5,7-8"),
      "selection 'A:4-5,7-8', at character 7 ('7-8'): expected a chain before the number of a residue, as in A:7-8");
  EXPECT_EQ(refusal_of("A:4 and AB"),
            "selection 'A:4 and AB': expected at least one torsion to free; it selects nothing");
  EXPECT_NE(refusal_of("ligands").find("selects nothing"), std::string::npos);
  EXPECT_NE(refusal_of("not all").find("selects nothing"), std::string::npos);
  for (const char* words :
       {"",     " ",  ",",    "and",         "not",     "()",       "(",    ")",       "phi or",    "phi and and psi",
        "phi)", "A:", "A:4:", "A:4:phi:psi", "every:0", "count:22", "alll", "A:delta", "A:4:delta", "file:2"})
    EXPECT_THROW(select(words), ModelError) << words;
  EXPECT_THROW(select(std::string(101, '(') + "phi" + std::string(101, ')')), ModelError);
  EXPECT_EQ(select(std::string(100, '(') + "phi" + std::string(100, ')')), select("phi"));
  EXPECT_TRUE(select("none").empty());
  EXPECT_EQ(select("not none"), select("all"));
}

TEST(SelectionGrammar, NotesWhatMayNotBeMeant) {
  const auto notes = [](const std::string& words) { return read_selection(molecule(), words, false).notes; };
  using Notes = std::vector<std::string>;
  for (const char* fine :
       {"A:4-5:phi,psi", "phi,psi", "A:4 and phi", "phi,A:4:chi1", "A:4,AB", "all", "none", "not A:4"})
    EXPECT_EQ(notes(fine), Notes{}) << fine;
  EXPECT_EQ(notes("A:4-5,phi"),
            (Notes{"selection 'A:4-5,phi': 'phi' selects torsions of all residues (19), not only of "
                   "A:4-5; write A:4-5:phi for these residues"}));
  EXPECT_EQ(notes("A:4:psi or phi").size(), 1U);
  EXPECT_EQ(notes("A:4,all"), (Notes{"selection 'A:4,all': 'all' frees all " + std::to_string(select("all").size()) +
                                     " torsions, regardless of the other words"}));
  EXPECT_EQ(notes("A:4,ligands"), (Notes{"selection 'A:4,ligands': 'ligands' selects nothing"}));
  EXPECT_EQ(notes("A:4,(A:5 and AB)"), (Notes{"selection 'A:4,(A:5 and AB)': '(A:5 and AB)' selects nothing"}));
}

TEST(SelectionGrammar, CountsByWord) {
  const auto words = read_selection(molecule(), "A:4-5:phi,psi, AB:-3:chi1 or chi2", false).words;
  ASSERT_EQ(words.size(), 3U);
  EXPECT_EQ(words[0].text, "A:4-5:phi,psi");
  EXPECT_EQ(words[0].count, 4U);
  EXPECT_EQ(words[1].text, "AB:-3:chi1");
  EXPECT_EQ(words[1].count, 1U);
  EXPECT_EQ(words[2].text, "chi2");
  EXPECT_EQ(words[2].count, select("chi2").size());
}

TEST(SelectionGrammar, IsThatOfPartsAndLoops) {
  const Structure s = three_chains();
  using Residues = std::vector<std::uint32_t>;
  EXPECT_EQ(find_part(s, "A and not A:3-12").residues, (Residues{0, 1}));
  EXPECT_EQ(find_part(s, "A:1,AB:60A or _:4").residues, (Residues{0, 13, 20}));
  EXPECT_EQ(find_part(s, "not (A+AB)").residues, (Residues{17, 18, 19, 20}));
  EXPECT_THROW(find_part(s, "A and AB"), ModelError);
  EXPECT_THROW(find_part(s, "A:4:phi"), ModelError);
  EXPECT_THROW(find_part(s, "phi"), ModelError);
  const Structure ubiquitin = read_structure(test::ubiquitin());
  const auto loops = find_loops(ubiquitin, "A:7-11 or (A:30-52 and not A:30-39)");
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_EQ(label(ubiquitin, loops[1]), "A:GLN40-ASP52");
  EXPECT_THROW(find_loops(ubiquitin, "A:7-20 and not A:12"), ModelError);
}

TEST(SelectionGrammar, SelectsByConfidence) {
  Structure s = three_chains();
  using Residues = std::vector<std::uint32_t>;
  EXPECT_EQ(read_structure(test::molecule_file("1crn.pdb")).atoms.front().b_factor,
            static_cast<double>(13.79F));  // the first atom record
  for (std::uint32_t r = 0; r < s.residues.size(); ++r)
    for (std::uint32_t atom = s.residues[r].first_atom; atom < s.residues[r].last_atom; ++atom)
      s.atoms[atom].b_factor = 4.0 * r;
  EXPECT_EQ(find_part(s, "plddt<8").residues, (Residues{0, 1}));
  EXPECT_EQ(find_part(s, "plddt<=8").residues, (Residues{0, 1, 2}));
  EXPECT_EQ(find_part(s, "plddt>76").residues, (Residues{20}));
  EXPECT_EQ(find_part(s, "plddt>=76 and _").residues, (Residues{19, 20}));
  EXPECT_EQ(find_part(s, "A and not plddt>=4.5").residues, (Residues{0, 1}));
  // A mean over the atoms of a residue.
  s.atoms[s.residues[0].first_atom].b_factor = 100.0;
  EXPECT_EQ(find_part(s, "plddt<8").residues, (Residues{1}));
  const Molecule m(s);
  for (const std::size_t k : select_torsions(m, "plddt>=40 and chi", false)) EXPECT_GE(m.torsions()[k].residue, 10U);
  for (const char* bad : {"plddt<", "plddt<x", "plddt>101", "plddt<-1", "plddt<nan", "plddt", "plddt=3", "plddt<7,0"})
    EXPECT_THROW(find_part(s, bad), ModelError) << bad;
  EXPECT_THROW(select_torsions(m, "plddt>99.5", false), ModelError);  // selects nothing
  s.atoms[3].b_factor = 131.0;
  EXPECT_NE(test::refusal<ModelError>([&] { find_part(s, "plddt<8"); }).find("this one holds 131"), std::string::npos);
}

}  // namespace selection_test
}  // namespace hinge::molecular
