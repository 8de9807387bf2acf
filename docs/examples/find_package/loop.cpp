// SPDX-License-Identifier: BSD-3-Clause
// How many conformations of the last seven residues of a protein are free of collisions? Argument: a structure file.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numbers>

#include "hinge/molecular/molecular.hpp"

int main(int argc, char** argv) {
  using namespace hinge::molecular;
  if (argc != 2) return 2;
  const auto protein = std::make_shared<const Molecule>(read_structure(argv[1]));
  const auto torsions = select_torsions(*protein, "A:70-76", /*omega=*/false);
  CheckOptions rules;
  rules.exempt_reference = true;  // pairs that are too close in the file itself do not count
  Checker checker(protein, protein->select(torsions), rules);

  const Sampling sampling{/*seed=*/1, /*sigma, rad=*/5 * std::numbers::pi / 180};
  int free = 0;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const auto q = sample_configuration(sampling, k, checker.dof_count());
    if (!checker.check(q, hinge::Mode::parse("any")).collides) ++free;
  }
  std::printf("%d of 1000 conformations are free\n", free);
}
