// SPDX-License-Identifier: BSD-3-Clause
// The time of a Monte Carlo move: 1MBN (153 residues) and 2D0F (637), all torsions free, D of them changed per move.
#include "moves.hpp"

#include <cstdio>
#include <string>
#include <vector>

#include "results.hpp"
#include "scene.hpp"

namespace {

using namespace hinge;
using namespace hinge::bench;

struct Subject {
  std::string name, file;
};

std::vector<Subject> subjects() {
  std::vector<Subject> found;
  for (const char* name : {"1mbn", "2d0f"})
    if (const std::string file = shared_molecule(std::string("paper/").append(name).append(".pdb")); !file.empty())
      found.push_back({name, file});
  if (found.empty()) {
    std::printf("the shared proteins are missing: 1UBQ is used instead\n");
    found.push_back({"1ubq", ubiquitin()});
  }
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = Arguments::parse(argc, argv, 500, "STEPS of every walk");
  const auto steps = static_cast<std::size_t>(arguments.number);
  Results results("moves");
  std::size_t differences = 0;
  for (const Subject& subject : subjects()) {
    Scene scene(read_protein(subject.file, false), "all");
    std::printf("%s, %zu atoms, %zu dof; us per step, everything included (except the frames of the chains)\n",
                subject.name.c_str(), scene.size(), scene.dof_count());
    std::printf("   D  accepted  recalled  full queries  blocks |");
    for (const char* name : mover_names) std::printf(" %12s", name);
    std::printf(
        " | ratio to moves: full  chain-skip  chain16-skip | accepted: moves  full | rejected: moves  full | wrong\n");
    for (const std::size_t dofs : {1U, 3U, 10U, 100U}) {
      const Walk w = walk(scene, dofs, steps);
      differences += w.differences;
      const auto percent = [&](std::size_t n) { return 100.0 * static_cast<double>(n) / static_cast<double>(steps); };
      std::printf("%4zu  %6.1f %%  %6.1f %%      %6.1f %%  %6.1f |", dofs, percent(w.accepted), percent(w.recalled),
                  percent(w.full_queries), w.blocks);
      for (const double us : w.us) std::printf(" %12.2f", us);
      std::printf(" | %20.1f %11.1f %13.1f | %15.2f %5.1f | %15.2f %5.1f | %zu\n", w.ratio(mover_full),
                  w.ratio(mover_chain_skip), w.ratio(mover_chain16_skip), w.accepted_us[mover_moves],
                  w.accepted_us[mover_full], w.rejected_us[mover_moves], w.rejected_us[mover_full], w.differences);
      std::fflush(stdout);
      Json row = {{"setup", subject.name},  {"atoms", scene.size()},  {"dof", scene.dof_count()},
                  {"changed", dofs},        {"accepted", w.accepted}, {"steps", w.steps},
                  {"recalled", w.recalled}, {"full", w.full_queries}, {"differences", w.differences}};
      for (std::size_t m = 0; m < movers; ++m) row[std::string(mover_names[m]).append("_us")] = w.us[m];
      results.add(std::move(row));
    }
  }
  results.write(arguments.json);
  return differences == 0 ? 0 : 1;
}
