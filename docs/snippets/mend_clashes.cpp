// SPDX-License-Identifier: BSD-3-Clause
// Mends the clashes of a protein, and follows the gradient of its steric energy by hand.
#include <hinge/molecular/checker.hpp>
#include <hinge/molecular/molecule.hpp>
#include <hinge/molecular/read_structure.hpp>
#include <hinge/molecular/relax.hpp>
#include <hinge/molecular/selection.hpp>
#include <memory>
#include <vector>

int main() {
  using namespace hinge::molecular;
  const auto protein = std::make_shared<const Molecule>(read_structure("molecular/data/1ubq.pdb"));
  Checker checker(protein, protein->select(select_torsions(*protein, "chi", /*omega=*/false)), {});

  std::vector<double> q(checker.dof_count(), 0.0);  // the file's conformation
  const Relaxation relaxed = relax(checker, q);

  // One step down the gradient lowers the energy.
  const Steric here = checker.steric(q, /*softness, angstrom=*/0.1);
  for (std::size_t k = 0; k < q.size(); ++k) q[k] -= 1e-3 * here.gradient[k];
  const Steric there = checker.steric(q, 0.1);
  return relaxed.collisions_before == 1 && relaxed.collisions == 0 && there.energy < here.energy ? 0 : 1;
}
