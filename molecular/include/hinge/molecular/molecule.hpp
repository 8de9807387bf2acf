// SPDX-License-Identifier: BSD-3-Clause
// Molecule: a structure as an articulated mechanism: links, torsions as joints, basic groups, closures.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/model/model.hpp"
#include "hinge/molecular/held_placement.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/molecular/torsions.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::molecular {

/// A part with a free rigid-body placement, whatever turns inside it: a position x has away from its reference is first
/// turned about the centre, c + Rx(q3) Ry(q4) Rz(q5) (x - c), then moved by (q0, q1, q2).
struct PlacedPart {
  Part part;
  Vec3 centre = Vec3::Zero();   ///< mean position of its atoms in model 0, angstrom
  std::array<DofId, 6> dofs{};  ///< q0 ... q5: along x, y, z (angstrom), then about x, y, z (rad)
};

struct MoleculeOptions {
  /// The molecule is cut at their ends (find_loops): what comes behind a loop does not hang on it, and psi of its last
  /// residue is no DOF but follows where the loop's closure holds.
  std::vector<Loop> loops{};
  bool keep_hydrogen_bonds = false;   ///< backbone hydrogen bonds (find_hydrogen_bonds) are closures
  std::vector<Part> placed{};         ///< parts that get six DOF each
  std::vector<HeldPlacement> held{};  ///< are closures
};

/// Every torsion of the structure is a joint; primitive i is atom i of model 0, in angstrom. Joint values are turns
/// away from that reference (rad), so that all 0 gives back the coordinates read, bit for bit, and a torsion at q has
/// the dihedral angle reference + q. Rings stay rigid; cycles through disulphides and other cross-links are closures. A
/// disulphide keeps its length and its two angles; any other bond, and a torsion that closes a cycle, keeps the angles
/// at both ends as they are, free to turn; of a peptide bond that closes a cycle omega is kept as well.
/// What no bonds join keeps its place, but for placed parts.
class Molecule {
 public:
  /// ModelError: the last psi of a loop is undefined; a placed part that is empty, bonded to what it does not hold, or
  /// shares a residue with another.
  explicit Molecule(Structure structure, const MoleculeOptions& options = {});

  static constexpr std::size_t no_torsion = ~std::size_t{0};

  const Structure& structure() const noexcept { return structure_; }
  const Model<Point>& model() const noexcept { return *model_; }
  /// Torsions that are DOF, in residue order.
  std::span<const Torsion> torsions() const noexcept { return torsions_; }
  /// The DOF of torsions()[k].
  DofId dof(std::size_t k) const noexcept { return dof_[k]; }
  /// The torsion of a DOF: position in torsions(); no_torsion for those that place a part.
  std::size_t torsion_of(DofId dof) const noexcept { return torsion_of_[index(dof)]; }
  /// The selection that frees these torsions (positions in torsions()).
  DofSelection select(std::span<const std::size_t> torsions) const;
  /// As given to the constructor.
  std::span<const Loop> loops() const noexcept { return loops_; }
  /// These torsions and the placements of all placed parts.
  DofSelection select_placed(std::span<const std::size_t> torsions) const;
  /// In the order they were given.
  std::span<const PlacedPart> placed_parts() const noexcept { return placed_; }
  /// The two atoms that each closure of the tree joins: of a bond, a hydrogen bond, or two whose parts are held.
  std::span<const std::array<std::uint32_t, 2>> closure_atoms() const noexcept { return closure_atoms_; }
  /// What was decided while building: torsions inside cycles, closures.
  std::span<const std::string> notes() const noexcept { return notes_; }

 private:
  friend class MoleculeBuilder;
  Structure structure_;
  std::vector<Loop> loops_;
  std::vector<std::string> notes_;
  std::vector<Torsion> torsions_;
  std::vector<DofId> dof_;
  std::vector<std::size_t> torsion_of_;
  std::vector<PlacedPart> placed_;
  std::vector<std::array<std::uint32_t, 2>> closure_atoms_;
  std::optional<Model<Point>> model_;
};

/// BioCD's basic groups: pseudo-backbone (backbone and C-beta) and pseudo-side-chain of each residue, proline whole,
/// the side chains a disulphide joins as one; for nucleotides backbone and base; any other residue whole. One label per
/// atom.
std::vector<std::uint32_t> basic_groups(const Structure& structure);

}  // namespace hinge::molecular
