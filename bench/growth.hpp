// SPDX-License-Identifier: BSD-3-Clause
// Growth: structures of any size (rows of copies, ideal helices), and their time and memory per atom.
#pragma once

#include <malloc.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "contestant.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/structure.hpp"
#include "results.hpp"
#include "scene.hpp"
#include "timing.hpp"

namespace hinge::bench {

/// Copies in a row along x, too far apart to touch natively. Chain names get a number: "A", "A2", "A3".
inline molecular::Structure copies(const molecular::Structure& one, std::size_t count) {
  constexpr double gap = 10;  // angstrom between neighbours
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& x : one.models.front()) {
    low = std::min(low, x[0]);
    high = std::max(high, x[0]);
  }
  molecular::Structure all = one;
  all.models.resize(1);
  for (std::size_t copy = 1; copy < count; ++copy) {
    const auto shift = [copy](std::uint32_t& value, std::size_t step) {
      value += static_cast<std::uint32_t>(copy * step);
    };
    for (molecular::Atom atom : one.atoms) {
      shift(atom.residue, one.residues.size());
      all.atoms.push_back(atom);
    }
    for (molecular::Residue residue : one.residues) {
      shift(residue.chain, one.chains.size());
      shift(residue.first_atom, one.atoms.size());
      shift(residue.last_atom, one.atoms.size());
      all.residues.push_back(residue);
    }
    for (molecular::Chain chain : one.chains) {
      chain.name += std::to_string(copy + 1);
      shift(chain.first_residue, one.residues.size());
      shift(chain.last_residue, one.residues.size());
      all.chains.push_back(chain);
    }
    for (molecular::Bond bond : one.bonds) {
      shift(bond.first, one.atoms.size());
      shift(bond.second, one.atoms.size());
      all.bonds.push_back(bond);
    }
    for (Vec3 x : one.models.front()) {
      x[0] += static_cast<double>(copy) * (high - low + gap);
      all.models.front().push_back(x);
    }
  }
  return all;
}

inline Protein ideal_helix(std::size_t residues) {
  return make_protein(molecular::build_ideal_protein(std::string(residues, 'L'), std::string(residues, 'H')));
}

/// Allocated bytes, as counted by the allocator.
inline double allocated() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// Time of a yes/no query if only the last ten residues of a helix move; the static remainder should not matter.
inline void run_tail(Results& results) {
  std::printf("\ntail: an ideal helix, its last ten residues free; yes/no, microseconds\n%8s %10s %10s %10s %10s\n",
              "atoms", "sampling", "simd", "lazy", "grid");
  for (const std::size_t residues : {150U, 1500U, 6000U}) {
    const std::string words = "A:" + std::to_string(residues - 9) + "-" + std::to_string(residues);
    Scene scene(ideal_helix(residues), words);
    std::vector<Contestant> all{engine<Simd>(scene, "simd", true), engine<Lazy>(scene, "lazy", false),
                                peer<Grid>(scene, "grid")};
    for (const Sampling sampling : {Sampling::random, Sampling::near_free}) {
      const Cell cell = Measurement(scene, all, Query::any, sampling).run({2.0, 100});
      std::printf("%8zu %10s %10.2f %10.2f %10.1f\n", scene.size(), name(sampling), cell.series[0].us,
                  cell.series[1].us, cell.series[2].us);
      for (const Series& s : cell.series)
        results.add({{"kind", "tail"},
                     {"atoms", scene.size()},
                     {"sampling", name(sampling)},
                     {"peer", s.name},
                     {"us", s.us},
                     {"differences", cell.differences}});
    }
  }
}

/// One residue in sixteen free, near-free sampling: time per atom of yes/no and of all pairs, and bytes per atom of
/// the hierarchy (without the shared molecule).
inline void run_growth(Results& results) {
  std::printf(
      "\ngrowth: one residue in 16 free, near-free; ns per atom, bytes per atom\n%-16s %8s %6s %10s %10s %10s %10s "
      "%7s\n",
      "structure", "atoms", "dof", "any", "all", "grid any", "grid all", "bytes");
  double reference_ns = 0.0;  // of the first structure of more than 5 000 atoms
  struct Step {
    const char *name, *file;
    std::size_t copies;
  };
  for (const Step step :
       {Step{"1mbn", "paper/1mbn.pdb", 1}, Step{"2d0f", "paper/2d0f.pdb", 1}, Step{"2d0f", "paper/2d0f.pdb", 4},
        Step{"2btv", "2btv.pdb.gz", 1}, Step{"2btv", "2btv.pdb.gz", 2}, Step{"2btv", "2btv.pdb.gz", 20}}) {
    std::string file = shared_molecule(step.file);
    const std::string called = (file.empty() ? "1ubq" : step.name) + std::string(" x ") + std::to_string(step.copies);
    if (file.empty()) file = ubiquitin();
    molecular::ReadOptions options;
    options.keep_hydrogens = false;
    options.model = 1;
    const molecular::Structure one = molecular::read_structure(file, options);
    Scene scene(make_protein(copies(one, step.copies)), "every:16");
    const Conformation conformation = scene.conformation(Sampling::near_free, 0);
    const double before = allocated();
    std::vector<Contestant> all{engine<Simd>(scene, "simd", true)};
    for (const Query query : all_queries) {  // scratch memory is allocated on first use
      Answer answer;
      all.front().prepare(conformation);
      all.front().ask(query, answer);
    }
    const double bytes = (allocated() - before) / static_cast<double>(scene.size());
    all.push_back(peer<Grid>(scene, "grid"));
    const double per_atom = 1e3 / static_cast<double>(scene.size());
    std::vector<double> ns;
    for (const std::size_t peer_number : {0U, 1U})
      for (const Query query : {Query::any, Query::all}) {
        const Cell cell = Measurement(scene, all, query, Sampling::near_free).run({5.0, 40});
        ns.push_back(cell.series[peer_number].us * per_atom);
      }
    std::printf("%-16s %8zu %6zu %10.1f %10.1f %10.1f %10.1f %7.0f\n", called.c_str(), scene.size(), scene.dof_count(),
                ns[0], ns[1], ns[2], ns[3], bytes);
    if (scene.size() > 5000) {
      if (reference_ns == 0.0) reference_ns = ns[0];
      results.print("growth any " + std::to_string(scene.size()) + "-atoms", ns[0] / reference_ns);
    }
    std::fflush(stdout);
    results.add({{"kind", "growth"},
                 {"structure", called},
                 {"atoms", scene.size()},
                 {"dof", scene.dof_count()},
                 {"any_ns", ns[0]},
                 {"all_ns", ns[1]},
                 {"grid_any_ns", ns[2]},
                 {"grid_all_ns", ns[3]},
                 {"bytes", bytes}});
  }
}

}  // namespace hinge::bench
