// SPDX-License-Identifier: BSD-3-Clause
// The trade between speed and accuracy: cheaper ways to query, their times, and their errors relative to a reference.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "contestant.hpp"
#include "hinge/molecular/radii.hpp"
#include "path_rows.hpp"
#include "results.hpp"
#include "robots/trade_tiers.hpp"
#include "scene.hpp"
#include "timing.hpp"

namespace {

using namespace hinge;
using namespace hinge::bench;
using molecular::Molecule;

/// Torsion angles relative to the reference, by (residue, torsion name). Molecules with different atoms can be moved
/// alike.
using Turns = std::map<std::pair<std::uint32_t, std::string>, double>;

Turns turns(const Molecule& molecule, const DofSelection& selection, const std::vector<double>& q) {
  Turns all;
  for (std::size_t k = 0; k < q.size(); ++k) {
    const molecular::Torsion& t = molecule.torsions()[molecule.torsion_of(selection.dofs()[k])];
    all[{t.residue, t.name}] = q[k];
  }
  return all;
}

/// The values of a selection's torsions. Angles of other torsions are dropped; torsions without an angle are 0.
std::vector<double> configuration(const Molecule& molecule, const DofSelection& selection, const Turns& turns) {
  std::vector<double> q;
  for (const DofId dof : selection.dofs()) {
    const molecular::Torsion& t = molecule.torsions()[molecule.torsion_of(dof)];
    const auto found = turns.find({t.residue, t.name});
    q.push_back(found == turns.end() ? 0.0 : found->second);
  }
  return q;
}

struct Outcome {
  bool collides = false;
  double gap = 0.0;
  double any_us = 0.0, closest_us = 0.0;  // from torsion angles to the answer, everything included
};

struct Variant {
  std::string name;
  std::function<Outcome(const Turns&)> ask;
};

/// Best time of the repetitions. `away` moves to the reference in between, so that no earlier result can be reused.
template <class Away, class Work>
double best_time(const Away& away, const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repetitions; ++k) {
    away();
    best = std::min(best, microseconds(work));
  }
  return best;
}

/// engine/simd with exact decisions.
Variant asked_exactly(std::string name, const Protein& protein, const DofSelection& selection) {
  const auto h =
      std::make_shared<Molecular<Simd>>(protein.molecule->model(), selection, protein.filter, protein.thresholds);
  return {std::move(name), [=](const Turns& turns) {
            const std::vector<double> q = configuration(*protein.molecule, selection, turns);
            const std::vector<double> home(q.size(), 0.0);
            const auto away = [&] {
              h->update(home);
              h->self_collides();
            };
            Outcome outcome;
            outcome.any_us = best_time(away, [&] {
              h->update(q);
              outcome.collides = h->self_collides();
            });
            outcome.closest_us = best_time(away, [&] {
              h->update(q);
              const auto hit = h->self_closest();
              outcome.gap = hit ? hit->gap() : std::numeric_limits<double>::infinity();
            });
            return outcome;
          }};
}

struct Errors {
  double false_accepts = 0.0, false_rejects = 0.0;  // percent of the colliding, of the free conformations
  double mean_gap = 0.0, largest_gap = 0.0;         // angstrom
  double any_us = 0.0, closest_us = 0.0;
};

Errors compare(const std::vector<Outcome>& reference, const std::vector<Outcome>& given) {
  Errors e;
  double colliding = 0.0;
  const auto n = static_cast<double>(reference.size());
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const double off = std::abs(given[k].gap - reference[k].gap);
    colliding += reference[k].collides ? 1 : 0;
    e.false_accepts += reference[k].collides && !given[k].collides ? 1 : 0;
    e.false_rejects += !reference[k].collides && given[k].collides ? 1 : 0;
    e.mean_gap += off / n;
    e.largest_gap = std::max(e.largest_gap, off);
    e.any_us += given[k].any_us / n;
    e.closest_us += given[k].closest_us / n;
  }
  e.false_accepts *= 100 / std::max(1.0, colliding);
  e.false_rejects *= 100 / std::max(1.0, n - colliding);
  return e;
}

/// The first variant is the reference. Conformations are Gaussian, with the sigma at which half of them collide.
void run(Results& results, const char* title, const Protein& protein, const DofSelection& selection,
         std::vector<Variant> variants, int conformations) {
  const double sigma = Scene(protein, selection).find_sigma(0.5);
  std::vector<std::vector<Outcome>> outcomes(variants.size());
  double colliding = 0.0;
  for (int k = 0; k < conformations; ++k) {
    const auto q = molecular::sample_configuration({seed, sigma}, static_cast<std::uint64_t>(k), selection.size());
    const Turns moved = turns(*protein.molecule, selection, q);
    for (std::size_t v = 0; v < variants.size(); ++v) outcomes[v].push_back(variants[v].ask(moved));
    colliding += outcomes[0].back().collides ? 1 : 0;
  }
  std::printf("\n%s (%d conformations, sigma %.3g degrees, %.0f %% collide)\n%-40s %9s %9s %8s %8s %10s %10s\n", title,
              conformations, sigma * 180 / std::numbers::pi, 100 * colliding / conformations, "", "any us",
              "closest us", "accept %", "reject %", "mean A", "largest A");
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const Errors e = compare(outcomes[0], outcomes[v]);
    std::printf("%-40s %9.1f %9.1f %8.2f %8.2f %10.2g %10.2g\n", variants[v].name.c_str(), e.any_us, e.closest_us,
                e.false_accepts, e.false_rejects, e.mean_gap, e.largest_gap);
    results.add({{"kind", "trade"},
                 {"title", title},
                 {"variant", variants[v].name},
                 {"any_us", e.any_us},
                 {"closest_us", e.closest_us},
                 {"false_accepts", e.false_accepts},
                 {"false_rejects", e.false_rejects},
                 {"mean_gap_error", e.mean_gap},
                 {"largest_gap_error", e.largest_gap}});
  }
  std::fflush(stdout);
}

/// The same file with the radii and rules of a named set.
Protein with_radii(const std::string& file, bool hydrogens, const char* set) {
  molecular::ReadOptions options;
  options.keep_hydrogens = hydrogens;
  options.model = 1;
  auto molecule = std::make_shared<const Molecule>(molecular::read_structure(file, options));
  molecular::ThresholdOptions thresholds;
  thresholds.radii = set;
  TypedThresholds matrix = molecular::make_thresholds(molecule->structure(), thresholds).matrix;
  auto filter = exempt_native(*molecule, matrix, molecular::radii_set(set).default_min_bonds);
  return {std::move(molecule), std::move(matrix), std::move(filter)};
}

DofSelection select(const Protein& protein, const char* words) {
  return protein.molecule->select(molecular::select_torsions(*protein.molecule, words, true));
}

/// Times of certified and sampled paths, and the share of colliding paths that sampling calls free.
void trade_paths(Results& results, int count) {
  std::printf(
      "\nstraight paths: collisions that sampling misses, %d paths of each set-up\n%-12s %-16s %10s %10s %10s %9s "
      "%8s\n",
      count, "", "", "free us", "colliding", "us each", "missed", "missed %");
  const auto [protein, sets] = protein_paths();
  for (const ProteinPaths& set : sets) {
    const Scene scene(protein, set.free);
    const PathRow row = measure_paths(scene, set, count);
    const auto mean = [](double sum, int of) { return of > 0 ? sum / of : std::nan(""); };
    for (const PathMethod m : {certified, sampled_five, sampled_one, sampled_tenth})
      std::printf("%-12s %-16s %10.1f %10d %10.1f %9d %7.1f%%\n", set.name, path_method_names[m],
                  mean(row.free_us[m], row.free), row.colliding, mean(row.colliding_us[m], row.colliding),
                  row.missed[m], 100.0 * mean(row.missed[m], row.colliding));
    std::fflush(stdout);
    if (row.undecided > 0 || row.wrong > 0)
      std::printf("%-12s %d undecided, %d wrong\n", set.name, row.undecided, row.wrong);
    add_paths(results, set.name, scene.dof_count(), row);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = Arguments::parse(argc, argv, 1000, "CONFORMATIONS");
  const int n = static_cast<int>(arguments.number);
  Results results("trade");
  std::string heavy = shared_molecule("paper/1mbn.pdb"), hydrogens = shared_molecule("paper/2axd.pdb.gz");
  if (heavy.empty()) std::printf("the shared data is missing: 1UBQ is used instead of 1MBN\n");
  if (heavy.empty()) heavy = ubiquitin();

  const Protein protein = read_protein(heavy, false);
  const DofSelection all = select(protein, "all");
  run(results, "fewer torsions moved", protein, all,
      {asked_exactly("all residues", protein, all), asked_exactly("35 residues", protein, select(protein, "count:35")),
       asked_exactly("10 residues", protein, select(protein, "count:10"))},
      n);
  run(results, "rigid secondary structure", protein, all,
      {asked_exactly("all free", protein, all),
       asked_exactly("helices and strands rigid", protein, select(protein, "loops"))},
      n);
  if (hydrogens.empty()) {
    std::printf("explicit hydrogens are left out: the shared file with hydrogens is missing\n");
    hydrogens = heavy;
  }
  const bool explicit_hydrogens = hydrogens != heavy;
  if (explicit_hydrogens) {
    const Protein reference = with_radii(hydrogens, true, "probe"),
                  united = with_radii(hydrogens, false, "probe-united"), bare = with_radii(hydrogens, false, "bondi");
    const DofSelection moved = select(reference, "all");
    run(results, "explicit against united hydrogens", reference, moved,
        {asked_exactly("hydrogens explicit (probe)", reference, moved),
         asked_exactly("united with their carbons (probe-united)", united, select(united, "all")),
         asked_exactly("heavy atoms alone (bondi)", bare, select(bare, "all"))},
        n);
  }
  std::vector<Variant> sets;
  const Protein bondi = with_radii(hydrogens, explicit_hydrogens, "bondi");
  for (const char* set : {"bondi", "probe", "probe-united", "amber"}) {
    const Protein p = with_radii(hydrogens, explicit_hydrogens && std::string(set) != "probe-united", set);
    sets.push_back(asked_exactly(set, p, select(p, "all")));
  }
  run(results, "radii sets", bondi, select(bondi, "all"), std::move(sets), n);
  trade_paths(results, std::min(n, 400));
  trade_tiers(static_cast<std::size_t>(arguments.number), results);
  results.write(arguments.json);
  return 0;
}
