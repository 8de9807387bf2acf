// SPDX-License-Identifier: BSD-3-Clause
// Writes the question in words: the heading of tables, and the list of a page.
#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "hinge_tools/counted.hpp"
#include "pair_table.hpp"
#include "report.hpp"
#include "scene.hpp"

namespace biocd {

namespace {

using hinge::molecular::Checker;
using hinge::molecular::Structure;
using hinge::tool::counted;

/// Returns "d < 0.8 * (bondi v1 radii), pairs at least 4 bonds apart, ...", or the same with the name of the rules.
std::string rule_line(const Checker& checker) {
  const auto& t = checker.thresholds();
  const auto bonds = checker.min_bonds();
  std::string text =
      t.rho ? fmt::format("d < {} * ({} v{} radii)", *t.rho, t.radii, t.radii_version)
            : fmt::format("{} v{} ({} v{} radii)", t.rules->name, t.rules->version, t.radii, t.radii_version);
  text += fmt::format(", pairs at least {} apart", counted(static_cast<std::uint64_t>(bonds.heavy), "bond"));
  if (bonds.hydrogen != bonds.heavy) text += fmt::format(" ({} with a hydrogen)", bonds.hydrogen);
  if (!t.rules->inside_residues) text += ", not inside residues";
  return text + fmt::format(", hydrogen-bond rule {}", t.hydrogen_bonds ? "on" : "off");
}

std::string molecule_text(const Structure& s) {
  return fmt::format("{}, {}, {}, {}", counted(s.atoms.size(), "atom"), counted(s.residues.size(), "residue"),
                     counted(s.chains.size(), "chain"), counted(s.bonds.size(), "bond"));
}

/// Returns such as "all: 305 DOF, 207 rigid groups, 2 closures".
std::string selection_text(const Options& options, const Job& job) {
  return fmt::format("{}{}{}: {} DOF, {}, {}", options.free, options.omega ? " with omega" : "",
                     options.loop.empty() ? "" : " and loop " + options.loop, job.checker.dof_count(),
                     counted(job.checker.rigid_groups().size(), "rigid group"),
                     counted(job.molecule->model().tree().closures().size(), "closure"));
}

/// Returns the words to follow the rule: which pairs are exempt.
std::string exempt_text(const Options& options, const Checker& checker, std::size_t exempted) {
  if (!options.check.exempt_reference) return {};
  std::string text = ", reference collisions exempt";
  if (const std::size_t rest = checker.reference_collisions().size() - exempted; rest > 0)
    text += fmt::format(" except {} between molecules (--exempt-interfaces)", rest);
  return text;
}

/// Returns how many torsions each word of --free selects; empty if there is only one word.
std::string free_words_line(const Job& job) {
  if (job.selected.words.size() < 2) return "";
  std::string text = "selected by word:";
  for (const auto& word : job.selected.words) text += fmt::format(" [{}] {}", word.text, word.count);
  return text + "\n";
}

/// Returns the residues that were left out and the options that keep them; empty if none were.
std::string left_out_text(const Structure& s) {
  std::string what, options;
  constexpr std::size_t most_names = 6;
  std::size_t names = 0;
  for (const auto& [name, count] : s.hetero_residues_dropped) {
    if (++names > most_names) continue;
    what += fmt::format("{}{} x{}", what.empty() ? "" : ", ", name, count);
  }
  if (names > most_names) what += fmt::format(" and {}", counted(names - most_names, "more name"));
  if (s.waters_dropped > 0) what += (what.empty() ? "" : ", ") + counted(s.waters_dropped, "water");
  if (what.empty()) return {};
  if (names > 0) options = "--hetero keeps ligands and ions";
  if (s.waters_dropped > 0) options += names > 0 ? ", --hetero waters also keeps waters" : "--hetero waters keeps them";
  return fmt::format("{} ({})", what, options);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> question_words(const Options& options, const Job& job) {
  const Structure& s = job.molecule->structure();
  const Checker& checker = job.checker;
  std::vector<std::pair<std::string, std::string>> words{
      {"Molecule", molecule_text(s)},
      {"Free", selection_text(options, job)},
      {"A pair collides if", rule_line(checker) + exempt_text(options, checker, exempted_pairs(job))}};
  if (const std::string text = left_out_text(s); !text.empty()) words.emplace_back("Left out", text);
  words.emplace_back("In the file", counted(checker.reference_collisions().size(), "pair collides", "pairs collide"));
  if (const std::size_t constant = checker.constant_contacts().size(); constant > 0)
    words.emplace_back("Constant contacts", counted(constant, "pair collides", "pairs collide") +
                                                " whatever the free torsions are; the table does not list them");
  return words;
}

std::string heading(const Options& options, const Job& job) {
  const Checker& checker = job.checker;
  std::string text =
      fmt::format("{}: {}\nselection {}\nrule: {}{}\n", options.file, molecule_text(job.molecule->structure()),
                  selection_text(options, job), rule_line(checker), exempt_text(options, checker, exempted_pairs(job)));
  text += left_out_line(job.molecule->structure()) + free_words_line(job) + scene_lines(options, job);
  text +=
      fmt::format("reference: {}; constant contacts under this selection: {}\n",
                  counted(checker.reference_collisions().size(), "colliding pair"), checker.constant_contacts().size());
  text += pair_table(options, job, contacts(checker.constant_contacts()), true, "  (constant)");
  return text;
}

std::string left_out_line(const Structure& s) {
  const std::string text = left_out_text(s);
  return text.empty() ? text : "left out: " + text + "\n";
}

void print_left_out(const Options& options, const Job& job) {
  const std::string line = left_out_line(job.molecule->structure());
  if (options.output == Output::csv && !line.empty()) std::fprintf(stderr, "note: %s", line.c_str());
}

}  // namespace biocd
