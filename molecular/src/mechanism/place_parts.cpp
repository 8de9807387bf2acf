// SPDX-License-Identifier: BSD-3-Clause
// Adds the six joints of a placed part: three prismatic joints, then three revolute joints about the centre of the
// part.
#include "mechanism/place_parts.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/kinematics/joint.hpp"

namespace hinge::molecular {

PartPlacer::PartPlacer(const Structure& structure, std::span<PlacedPart> placed)
    : placed_(placed), part_of_(structure.atoms.size(), none), base_(placed.size(), world) {
  for (std::uint32_t k = 0; k < placed.size(); ++k) {
    PlacedPart& one = placed[k];
    const std::string who = "placing '" + one.part.name + "': ";
    const std::vector<bool> in = atoms_in(structure, one.part);
    double count = 0.0;
    for (std::uint32_t atom = 0; atom < in.size(); ++atom) {
      if (!in[atom]) continue;
      if (part_of_[atom] != none)
        throw ModelError(who + label(structure, atom) + " already belongs to placed part '" +
                         placed[part_of_[atom]].part.name + "'");
      part_of_[atom] = k;
      one.centre += structure.models.front()[atom];
      count += 1.0;
    }
    if (count == 0.0) throw ModelError(who + "the part holds no atoms");
    one.centre /= count;
  }
  for (const Bond& bond : structure.bonds) {
    if (part_of_[bond.first] == part_of_[bond.second]) continue;
    const bool first = part_of_[bond.first] != none;
    const std::uint32_t in = first ? bond.first : bond.second, out = first ? bond.second : bond.first;
    throw ModelError(
        "placing '" + placed[part_of_[in]].part.name + "': " + label(structure, in) + " is bonded to " +
        label(structure, out) +
        " outside the part, expected a part without bonds to the rest (write A+B to place A and B together)");
  }
}

LinkId PartPlacer::base_of(std::uint32_t atom, ModelBuilder<Point>& model) {
  if (part_of_[atom] == none) return world;
  LinkId& link = base_[part_of_[atom]];
  if (link != world) return link;
  PlacedPart& one = placed_[part_of_[atom]];
  const std::array<Vec3, 3> axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (std::size_t k = 0; k < 6; ++k) {
    one.dofs[k] = id<DofId>(model.tree().dof_count());
    std::string name = k < 3 ? "move " : "turn ";
    name += one.part.name;
    name += std::array{" x", " y", " z"}[k % 3];
    if (k < 3)
      link = model.add_link(link, Prismatic{axes[k], {}, name});
    else
      link = model.add_link(link, Revolute{axes[k - 3], one.centre, {}, name});
  }
  return link;
}

DofSelection Molecule::select_placed(std::span<const std::size_t> torsions) const {
  const DofSelection turning = select(torsions);
  std::vector<DofId> free(turning.dofs().begin(), turning.dofs().end());
  for (const PlacedPart& placed : placed_) free.insert(free.end(), placed.dofs.begin(), placed.dofs.end());
  return {model_->tree(), std::move(free)};
}

}  // namespace hinge::molecular
