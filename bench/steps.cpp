// SPDX-License-Identifier: BSD-3-Clause
// The steps of one query on 1UBQ, timed separately: forward kinematics, placement, each mode, change of the
// selection.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/radii.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"

namespace {

using namespace hinge;
using namespace hinge::molecular;
using Molecular = Hierarchy<Point, BondExclusions, TypedThresholds, Simd>;

const Molecule& ubiquitin() {
  static const Molecule molecule(read_structure(std::string(HINGE_SOURCE_DIR) + "/molecular/data/1ubq.pdb"));
  return molecule;
}

/// Gaussian about the native structure, sigma 0.2 degrees. Most conformations are free, the worst case of a yes/no
/// query.
std::vector<std::vector<double>> conformations(std::size_t dof) {
  std::vector<std::vector<double>> all;
  for (std::uint64_t k = 0; k < 64; ++k) all.push_back(sample_configuration({1, 0.0035}, k, dof));
  return all;
}

Molecular hierarchy(std::int64_t residues) {
  const Molecule& m = ubiquitin();
  return {m.model(), m.select(select_torsions(m, "count:" + std::to_string(residues), true)),
          BondExclusions(m.structure(), 4), make_thresholds(m.structure()).matrix};
}

template <class Ask>
void run(benchmark::State& state, const Ask& ask) {
  Molecular h = hierarchy(state.range(0));
  const auto q = conformations(h.dof_count());
  std::size_t k = 0;
  for (auto _ : state) {
    h.update(q[k++ % q.size()]);
    ask(h);
  }
  state.counters["dof"] = static_cast<double>(h.dof_count());
}

void coordinates(benchmark::State& state) {
  run(state, [](Molecular& h) { benchmark::DoNotOptimize(h.placed().data()); });
}
void any(benchmark::State& state) {
  run(state, [](Molecular& h) { benchmark::DoNotOptimize(h.self_collides()); });
}
void all(benchmark::State& state) {
  run(state, [](Molecular& h) { benchmark::DoNotOptimize(h.self_collisions()); });
}
void within(benchmark::State& state) {
  run(state, [](Molecular& h) { benchmark::DoNotOptimize(h.self_within(1.0)); });
}
void closest(benchmark::State& state) {
  run(state, [](Molecular& h) { benchmark::DoNotOptimize(h.self_closest()); });
}
void change_selection(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(hierarchy(state.range(0)).dof_count());
}

BENCHMARK(coordinates)->Arg(1)->Arg(10)->Arg(76)->Unit(benchmark::kMicrosecond);
BENCHMARK(any)->Arg(1)->Arg(10)->Arg(76)->Unit(benchmark::kMicrosecond);
BENCHMARK(all)->Arg(1)->Arg(10)->Arg(76)->Unit(benchmark::kMicrosecond);
BENCHMARK(within)->Arg(1)->Arg(10)->Arg(76)->Unit(benchmark::kMicrosecond);
BENCHMARK(closest)->Arg(1)->Arg(10)->Arg(76)->Unit(benchmark::kMicrosecond);
BENCHMARK(change_selection)->Arg(1)->Arg(76)->Unit(benchmark::kMicrosecond);

/// Growth: an ideal helix of n residues with the last ten free.
void tail(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Molecule m(build_ideal_protein(std::string(n, 'L'), std::string(n, 'H')));
  const std::string last = "A:" + std::to_string(n - 9) + "-" + std::to_string(n);
  Molecular h(m.model(), m.select(select_torsions(m, last, false)), BondExclusions(m.structure(), 4),
              make_thresholds(m.structure()).matrix);
  const auto q = conformations(h.dof_count());
  std::size_t k = 0;
  for (auto _ : state) {
    h.update(q[k++ % q.size()]);
    benchmark::DoNotOptimize(h.self_collides());
  }
  state.counters["atoms"] = static_cast<double>(m.model().size());
}
BENCHMARK(tail)->Arg(150)->Arg(1500)->Arg(6000)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
