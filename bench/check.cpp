// SPDX-License-Identifier: BSD-3-Clause
// engine/simd against brute force in double: the paper's set-ups and a capsid, all samplings, all modes.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "contestant.hpp"
#include "hinge/engine/brute.hpp"
#include "reference.hpp"
#include "results.hpp"
#include "scene.hpp"
#include "timing.hpp"

namespace {

using namespace hinge;
using namespace hinge::bench;

constexpr std::size_t large = 6000;  // atoms; brute force takes 10 ms at this size and grows quadratically
constexpr std::size_t engine_brute_share = 100;

struct Count {
  long long answers = 0, differences = 0;
};

/// conformations: number per sampling. engine/brute is tested too, at one conformation in a hundred.
Count check(Scene& scene, std::size_t conformations) {
  Contestant simd = engine<Simd>(scene, "simd", true), brute = engine<Brute>(scene, "brute", false);
  Reference reference(scene.input());
  Count count;
  for (const Sampling sampling : all_samplings) {
    std::vector<double> last;
    for (std::size_t k = 0; k < conformations; ++k) {
      std::vector<double> q = scene.configuration(sampling, k);
      // Every second update keeps half of the values, so that part of the model does not move.
      if (k % 2 == 1) std::copy_n(last.begin(), q.size() / 2, q.begin());
      last = q;
      const Conformation c = scene.conformation(std::move(q));
      const std::vector<Answer> expected = reference.ask(c.xyz);
      count.answers += static_cast<long long>(expected.size());
      count.differences += count_differences(simd, c, expected, k);
      if (k % engine_brute_share == 0 && scene.size() <= large)
        count.differences += count_differences(brute, c, expected, k);
    }
  }
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = Arguments::parse(argc, argv, 1000, "CONFORMATIONS of each sampling");
  Results results("check");
  std::vector<Setup> setups = paper_setups();
  if (const std::string capsid = shared_molecule("2btv.pdb.gz"); !capsid.empty())
    for (const int k : {10, 400}) setups.push_back({"2btv", capsid, false, k});
  Count total;
  Protein protein = read_protein(setups.front().file, setups.front().hydrogens);
  for (std::size_t k = 0; k < setups.size(); ++k) {
    const Setup& setup = setups[k];
    if (k > 0 && setup.name != setups[k - 1].name) protein = read_protein(setup.file, setup.hydrogens);
    Scene scene(protein, setup.residues);
    const auto start = Clock::now();
    const auto wanted = static_cast<std::size_t>(arguments.number);
    // Uses fewer conformations if a reference answer takes long.
    const std::size_t conformations = scene.size() <= large ? wanted : std::max<std::size_t>(2, wanted / 200);
    const Count count = check(scene, conformations);
    total.answers += count.answers;
    total.differences += count.differences;
    std::printf(
        "%-7s %4d free %5zu dof %6zu atoms: %zu conformations x 3 samplings x 4 modes, differences %lld (%.0f s)\n",
        setup.name.c_str(), setup.residues, scene.dof_count(), scene.size(), conformations, count.differences,
        seconds_since(start));
    std::fflush(stdout);
    Json row = {{"kind", "check"}};
    row.update(describe(setup, scene));
    row.update({{"answers", count.answers}, {"differences", count.differences}});
    results.add(std::move(row));
  }
  std::printf("checked %lld answers, differences %lld\n", total.answers, total.differences);
  results.write(arguments.json);
  return total.differences == 0 ? 0 : 1;
}
