// SPDX-License-Identifier: BSD-3-Clause
// From a structure file to collision results.
#include <hinge/molecular/checker.hpp>
#include <hinge/molecular/read_structure.hpp>
#include <hinge/molecular/sampler.hpp>
#include <hinge/molecular/selection.hpp>
#include <memory>

int main() {
  using namespace hinge::molecular;
  auto protein = std::make_shared<const Molecule>(read_structure("molecular/data/1ubq.pdb"));
  const auto loop = select_torsions(*protein, "A:30-39", /*omega=*/false);
  CheckOptions rules;  // Bondi radii, rho 0.8, pairs at least four bonds apart
  rules.exempt_reference = true;
  Checker checker(protein, protein->select(loop), rules);

  int free = 0;
  for (std::uint64_t k = 0; k < 100; ++k) {
    const auto q = sample_configuration({/*seed=*/1, /*sigma, rad=*/0.01}, k, checker.dof_count());
    if (!checker.check(q, Mode::parse("any")).collides) ++free;
  }
  return free > 0 && checker.reference_collisions().size() == 1 ? 0 : 1;
}
