// SPDX-License-Identifier: BSD-3-Clause
// A protein and a second molecule with a free pose, each with torsions of its own, in one query.
#include <hinge/molecular/checker.hpp>
#include <hinge/molecular/ideal_protein.hpp>
#include <hinge/molecular/join_structures.hpp>
#include <hinge/molecular/part.hpp>
#include <hinge/molecular/read_structure.hpp>
#include <hinge/molecular/sampler.hpp>
#include <hinge/molecular/selection.hpp>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

int main() {
  using namespace hinge::molecular;
  // Two molecules in one structure, read or built separately. Both have a chain A, so the peptide's becomes chain B.
  Structure small = build_ideal_protein("RGDW", "CCCC");
  for (hinge::Vec3& x : small.models.front()) x += hinge::Vec3(30, 29, 0);  // angstrom: moves it next to the protein
  Structure both = join_structures({read_structure("molecular/data/1ubq.pdb"), small});
  const Part protein = find_part(both, "A"), peptide = find_part(both, "B");

  CheckOptions rules;
  rules.exempt_reference = true;
  // Tests only pairs between the two molecules. By default, pairs inside each molecule are tested as well.
  CheckOptions docking = rules;
  docking.scope = PairScope(both, std::vector{std::pair(protein, peptide)}, {});

  auto scene = std::make_shared<const Molecule>(std::move(both), MoleculeOptions{.placed = {peptide}});
  const auto torsions = select_torsions(*scene, "A:chi,B:all", /*omega=*/false);
  const auto selection = scene->select_placed(torsions);
  Checker all(scene, selection, rules), mutual(scene, selection, docking);

  // The peptide's six DOF: up to 20 angstrom from its position in the reference, with any rotation.
  const std::vector<PlacementRange> anywhere{{/*distance=*/20.0, /*turn, rad=*/std::numbers::pi}};
  int free = 0, apart = 0;
  for (std::uint64_t k = 0; k < 100; ++k) {
    const auto q = sample_configuration({/*seed=*/1, /*sigma, rad=*/0.05}, k, *scene, selection, anywhere);
    free += all.check(q, Mode::parse("any")).collides ? 0 : 1;
    apart += mutual.check(q, Mode::parse("any")).collides ? 0 : 1;
  }
  return selection.size() == torsions.size() + 6 && free > 0 && free <= apart && apart < 100 ? 0 : 1;
}
