// SPDX-License-Identifier: BSD-3-Clause
// The paper's set-ups in full, in microseconds: all samplings, queries and peers; rigid secondary structure; change
// of the selection; warm and cold caches; a tail that moves.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "contestant.hpp"
#include "growth.hpp"
#include "results.hpp"
#include "scene.hpp"
#include "timing.hpp"

namespace {

using namespace hinge;
using namespace hinge::bench;

void print_header(const char* title) {
  std::printf("\n%s\n%-7s %4s %5s %6s %-9s %-8s", title, "setup", "free", "dof", "atoms", "sampling", "query");
  for (const char* who : {"simd", "fcl", "grid", "lazy", "chain-s", "chain-b", "chain16b", "brute", "nanofl.", "gemmi"})
    std::printf(" %9s", who);
  std::printf(" collide diff\n");
}

void print_cell(const Setup& setup, const Scene& scene, Query query, Sampling sampling, const Cell& cell) {
  std::printf("%-7s %4d %5zu %6zu %-9s %-8s", setup.name.c_str(), setup.residues, scene.dof_count(), scene.size(),
              name(sampling), name(query));
  for (const char* who : {"simd", "fcl", "grid", "lazy", "chain-spheres", "chain-boxes", "chain16-boxes", "brute",
                          "nanoflann", "gemmi"}) {
    const auto s =
        std::find_if(cell.series.begin(), cell.series.end(), [who](const Series& x) { return x.name == who; });
    if (s == cell.series.end())
      std::printf(" %9s", "-");
    else
      std::printf(" %9.2f", s->us);
  }
  std::printf(" %5.0f %% %4d\n", 100.0 * cell.colliding / cell.conformations, cell.differences);
  std::fflush(stdout);
}

/// Times all samplings and queries of one scene. Returns the number of answers that differ.
int run_table(Results& results, const Setup& setup, Scene& scene, double seconds, Ratios* ratios) {
  std::vector<Contestant> all = contestants(scene);
  int differences = 0;
  for (const Sampling sampling : all_samplings)
    for (const Query query : all_queries) {
      const Cell cell = Measurement(scene, all, query, sampling).run({seconds, 100});
      print_cell(setup, scene, query, sampling, cell);
      add_cell(results, describe(setup, scene), query, sampling, cell);
      if (ratios != nullptr) ratios->add(query, sampling, cell);
      differences += cell.differences;
    }
  return differences;
}

/// Time to make a hierarchy for a selection of an existing molecule, in microseconds; best of five.
void run_selection_change(Results& results, const Setup& setup, const Scene& scene) {
  double simd = std::numeric_limits<double>::infinity(), lazy = simd;
  for (int k = 0; k < 5; ++k) {
    simd = std::min(simd, microseconds([&] { scene.make<Simd>(); }));
    lazy = std::min(lazy, microseconds([&] { scene.make<Lazy>(); }));
  }
  std::printf("%-7s %4d %5zu %6zu change of the selection: simd %.0f, lazy %.0f\n", setup.name.c_str(), setup.residues,
              scene.dof_count(), scene.size(), simd, lazy);
  Json row = {{"kind", "selection"}};
  row.update(describe(setup, scene));
  row.update({{"simd_us", simd}, {"lazy_us", lazy}});
  results.add(std::move(row));
}

/// Writes to more memory than all caches of a core hold.
class Eviction {
 public:
  void run() {
    for (std::size_t k = 0; k < data_.size(); k += 64) data_[k] = static_cast<unsigned char>(data_[k] + 1);
    std::atomic_signal_fence(std::memory_order_seq_cst);
  }

 private:
  std::vector<unsigned char> data_ = std::vector<unsigned char>(64 << 20);
};

/// Times each contestant alone on near-free conformations, with warm and with cold caches. The table interleaves
/// them.
void run_caches(Results& results, const Setup& setup, Scene& scene) {
  constexpr std::uint64_t conformations = 20;
  Eviction eviction;
  std::vector<Contestant> all = contestants(scene);
  for (const Query query : {Query::any, Query::all})
    for (Contestant& contestant : all) {
      double warm = 0.0, cold = 0.0;
      for (const bool evict : {false, true}) {
        std::vector<double> best(conformations, std::numeric_limits<double>::infinity());
        for (int repetition = 0; repetition < repetitions; ++repetition)
          for (std::uint64_t k = 0; k < conformations; ++k) {
            const Conformation c = scene.conformation(Sampling::near_free, k);
            contestant.prepare(c);
            if (evict) eviction.run();
            Answer answer;
            best[k] = std::min(best[k], microseconds([&] { contestant.ask(query, answer); }));
          }
        (evict ? cold : warm) = std::accumulate(best.begin(), best.end(), 0.0) / conformations;
      }
      std::printf("%-7s %4d %-5s %-14s warm %9.2f cold %9.2f\n", setup.name.c_str(), setup.residues, name(query),
                  contestant.name.c_str(), warm, cold);
      Json row = {{"kind", "caches"}};
      row.update(describe(setup, scene));
      row.update({{"query", name(query)}, {"peer", contestant.name}, {"warm_us", warm}, {"cold_us", cold}});
      results.add(std::move(row));
    }
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = Arguments::parse(argc, argv, 2, "SECONDS for each set-up, sampling and query");
  Results results("paper");
  const std::vector<Setup> setups = paper_setups();
  Ratios ratios;
  int differences = 0;
  print_header(
      "microseconds per conformation; without forward kinematics and coordinates, with each method's own update");
  Protein protein = read_protein(setups.front().file, setups.front().hydrogens);
  for (std::size_t k = 0; k < setups.size(); ++k) {
    if (k > 0 && setups[k].name != setups[k - 1].name) protein = read_protein(setups[k].file, setups[k].hydrogens);
    Scene scene(protein, setups[k].residues);
    differences += run_table(results, setups[k], scene, arguments.number, &ratios);
  }
  ratios.print(results);

  // One scene for each protein with a recorded secondary structure: loops free, helices and strands rigid.
  print_header("rigid secondary structure: only loops are free (free = 0)");
  for (std::size_t k = 0; k < setups.size(); ++k) {
    if (k > 0 && setups[k].name == setups[k - 1].name) continue;
    protein = read_protein(setups[k].file, setups[k].hydrogens);
    if (protein.molecule->structure().secondary_structure.empty()) continue;
    Scene scene(protein, "loops");
    Setup loops = setups[k];
    loops.residues = 0;
    differences += run_table(results, loops, scene, arguments.number / 4, nullptr);
  }

  std::printf("\nmicroseconds\n");
  for (const Setup& setup : setups)
    run_selection_change(results, setup, Scene(read_protein(setup.file, setup.hydrogens), setup.residues));
  std::printf("\nnear-free, microseconds: one method at a time (warm), and after writing 64 MB (cold)\n");
  for (const Setup& setup : all_free_setups(setups)) {
    Scene scene(read_protein(setup.file, setup.hydrogens), setup.residues);
    run_caches(results, setup, scene);
  }
  run_tail(results);
  std::printf("differences %d\n", differences);
  results.write(arguments.json);
  return differences == 0 ? 0 : 1;
}
