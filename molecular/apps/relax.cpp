// SPDX-License-Identifier: BSD-3-Clause
// biocd relax: mends the clashes of the file's conformation.
#include "hinge/molecular/relax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "conformation_file.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/severity.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/json_text.hpp"
#include "molecule_page.hpp"
#include "options.hpp"
#include "pair_table.hpp"
#include "report.hpp"
#include "view.hpp"

namespace biocd {

namespace {

using namespace hinge::molecular;
using hinge::tool::counted;

constexpr double rounding = 5e-4;        // angstrom; PDB files do not show smaller displacements
constexpr double listed_degrees = 0.05;  // JSON does not list smaller turns
constexpr double shown_degrees = 1.0;    // the table only counts smaller turns

/// A conformation, before or after.
struct Conformation {
  std::vector<Contact> pairs;
  std::vector<hinge::Vec3> positions;
  std::optional<double> largest_overlap{};  // angstrom
};

Conformation conformation_at(const Job& job, Checker& checker, const std::vector<double>& q) {
  Conformation made{checker.check(q, Mode{Mode::Kind::all}).pairs, checker.positions()};
  for (const Contact& pair : made.pairs) {
    const double overlap = severity_of(job.checker.thresholds(), pair.hit, true).overlap;
    made.largest_overlap = std::max(made.largest_overlap.value_or(overlap), overlap);
  }
  return made;
}

/// How far the atoms moved.
struct Motion {
  std::size_t atoms = 0;                // that moved
  double rmsd = 0.0, rmsd_moved = 0.0;  // angstrom; of all atoms, and of those that moved
  double farthest = 0.0;                // angstrom
};

Motion motion_between(const std::vector<hinge::Vec3>& before, const std::vector<hinge::Vec3>& after) {
  Motion motion;
  double squares = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double square = hinge::squared_norm(hinge::Vec3(after[i] - before[i]));
    squares += square;
    motion.farthest = std::max(motion.farthest, std::sqrt(square));
    if (square > rounding * rounding) ++motion.atoms;
  }
  motion.rmsd = std::sqrt(squares / static_cast<double>(before.size()));
  if (motion.atoms > 0) motion.rmsd_moved = std::sqrt(squares / static_cast<double>(motion.atoms));
  return motion;
}

/// A DOF that moved.
struct Change {
  std::string name;
  double amount = 0.0;  // degrees or angstrom
  bool turns = true;
};

/// Returns the DOF that moved by more than is listed, the largest changes first.
std::vector<Change> changes_of(const Job& job, const std::vector<double>& q) {
  std::vector<Change> changes;
  const std::vector<double> amounts = in_degrees(job, q);
  for (std::size_t k = 0; k < amounts.size(); ++k) {
    const hinge::DofId dof = job.checker.selection().dofs()[k];
    const bool turning = turns(job, dof);
    if (std::abs(amounts[k]) > (turning ? listed_degrees : rounding))
      changes.push_back({dof_label(job, dof), amounts[k], turning});
  }
  std::ranges::stable_sort(changes, [](const Change& a, const Change& b) {
    return std::pair(!a.turns, std::abs(a.amount)) > std::pair(!b.turns, std::abs(b.amount));
  });
  return changes;
}

void print_changes(const std::vector<Change>& changes) {
  std::size_t shown = 0;
  for (const Change& change : changes)
    if (!change.turns || std::abs(change.amount) >= shown_degrees) {
      fmt::print("  {:<20} {:9.2f} {}\n", change.name, change.amount, change.turns ? "degrees" : "angstrom");
      ++shown;
    }
  if (shown < changes.size())
    fmt::print("{} turned by less than {} degree\n",
               counted(changes.size() - shown, shown > 0 ? "more torsion" : "torsion"), shown_degrees);
}

Json side_json(const Options& options, const Job& job, const Conformation& side) {
  Json json{{"collisions", side.pairs.size()}};
  json["largest_overlap"] = side.largest_overlap ? Json(rounded(*side.largest_overlap)) : Json();
  json["pairs"] = Json::array();
  for (const Contact& pair : pairs_to_print(options, side.pairs)) json["pairs"].push_back(pair_json(job, pair));
  add_left_out(json, options, side.pairs, Mode{Mode::Kind::all});
  return json;
}

std::string overlap_text(const Conformation& side) {
  return side.largest_overlap ? fmt::format("{:.3f}", *side.largest_overlap) : std::string("-");
}

}  // namespace

Exit run_relax(const Options& options) {
  const Job job = load(options);
  print_notes(job);
  print_left_out(options, job);
  if (!options.explain.empty()) {
    explain(options, job);
    return Exit::free;
  }
  require_free_torsions(options, job);
  const Structure& s = job.molecule->structure();
  ConformationFile file(options, s, s.atoms.size(), false);
  MoleculePage page(options, job, true);
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  if (const std::size_t left = job.checker.reference_collisions().size(); options.check.exempt_reference && left > 0)
    fmt::print(stderr, "note: {} in the file; --exempt-reference leaves those that are not between parts as they are\n",
               counted(left, "pair collides", "pairs collide"));
  RelaxOptions how{.closures = job.kept.closures, .seed = options.seed};
  if (options.most_tries) how.most_restarts = *options.most_tries;
  const hinge::tool::TimeLimit out_of_time(options.seconds);
  const std::vector<double> reference(job.checker.dof_count(), 0.0);
  const Relaxation relaxed = relax(job.checker, reference, how, out_of_time);

  Checker checker = job.checker;
  const Conformation before = conformation_at(job, checker, reference);
  const Conformation after = conformation_at(job, checker, relaxed.q);
  const Motion motion = motion_between(before.positions, after.positions);
  const std::vector<Change> changes = changes_of(job, relaxed.q);
  file.add(after.positions, 1, !after.pairs.empty());
  file.finish();

  const std::size_t constant = job.checker.constant_contacts().size();
  if (options.output == Output::json) {
    Json json{{"tool", "biocd"}, {"command", "relax"}, {"model", model_json(options, job)}, {"seed", options.seed}};
    json["constant_contacts"] = constant_contacts_json(job);
    json["before"] = side_json(options, job, before);
    json["after"] = side_json(options, job, after);
    json["restarts"] = relaxed.restarts;
    json["atoms_moved"] = motion.atoms;
    json["rmsd"] = rounded(motion.rmsd);
    json["rmsd_moved"] = rounded(motion.rmsd_moved);
    json["farthest"] = rounded(motion.farthest);
    json["changes"] = Json::array();
    for (const Change& change : changes)
      json["changes"].push_back(
          {{"dof", change.name}, {change.turns ? "degrees" : "angstrom", rounded(change.amount)}});
    fmt::print("{}\n", hinge::tool::json_text(json, 1));
  } else {
    fmt::print("                             before      after\n");
    fmt::print("clashes                  {:10} {:10}\n", before.pairs.size(), after.pairs.size());
    fmt::print("largest overlap (angstrom) {:>8} {:>10}\n", overlap_text(before), overlap_text(after));
    if (constant > 0) fmt::print("constant contacts        {0:10} {0:10}\n", constant);
    if (motion.atoms > 0)
      fmt::print("{} of {} moved: RMSD {:.3f} angstrom, at most {:.3f}; RMSD of all atoms {:.3f}\n", motion.atoms,
                 counted(s.atoms.size(), "atom"), motion.rmsd_moved, motion.farthest, motion.rmsd);
    print_changes(changes);
    if (!after.pairs.empty()) fmt::print("these pairs still collide:\n{}", pair_table(options, job, after.pairs, true));
    if (file.size() > 0) fmt::print("written to {}\n", options.out);
  }
  if (constant > 0)
    fmt::print(stderr, "note: {} whatever the free torsions are (constant contacts); more free torsions may help\n",
               counted(constant, "pair collides", "pairs collide"));
  if (!after.pairs.empty()) {
    fmt::print(stderr, "note: {} after {}; {}\n",
               motion.atoms > 0 ? "clashes are left" : "no better conformation was found",
               counted(relaxed.restarts, "restart"),
               relaxed.stopped ? "--time has passed" : "more free torsions (--free) or restarts (--tries) may help");
  }
  if (options.view)
    write_view(options, job, {"the relaxed conformation", after.positions, after.pairs}, file.size() > 0);
  page.add_next({0, "before", !before.pairs.empty(), before.positions, before.pairs});
  page.add_next({1, "after", !after.pairs.empty(), after.positions, after.pairs});
  page.write(after.pairs.empty() && constant == 0 ? "free" : "collides",
             fmt::format("{} before, {} after", counted(before.pairs.size(), "clash", "clashes"),
                         counted(after.pairs.size(), "clash", "clashes")));
  return after.pairs.empty() && constant == 0 ? Exit::free : Exit::collision;
}

}  // namespace biocd
