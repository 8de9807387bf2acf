// SPDX-License-Identifier: BSD-3-Clause
// Molecule: a structure as an articulated mechanism: links, torsions as joints, basic groups, closures.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/api.hpp"
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

/// A part with six DOF of its own, in addition to torsions inside it. A position x of the part is first rotated about
/// the centre, c + Rx(q3) Ry(q4) Rz(q5) (x - c), then translated by (q0, q1, q2).
struct PlacedPart {
  Part part;                    ///< the residues or atoms that move together
  Vec3 centre = Vec3::Zero();   ///< mean position of the part's atoms in model 0, angstrom
  std::array<DofId, 6> dofs{};  ///< q0 ... q5: along x, y, z (angstrom), then about x, y, z (rad)
};

/// Options of a Molecule.
struct MoleculeOptions {
  /// The chain is cut at the end of each loop (find_loops). Residues after a loop do not move with it. psi of the
  /// loop's last residue is not a DOF: it follows from the others if the loop's closure holds.
  std::vector<Loop> loops{};
  /// Make hydrogen bonds of the backbone closures (Kabsch & Sander, E < -0.5 kcal/mol).
  bool keep_hydrogen_bonds = false;
  std::vector<Part> placed{};         ///< parts that get six DOF each
  std::vector<HeldPlacement> held{};  ///< pairs of fragments that keep their relative pose, by closures
};

/// Every torsion of the structure is a joint; primitive i is atom i of model 0, in angstrom. Joint values are rotations
/// relative to this reference (rad): at 0 the coordinates are those of model 0, bit for bit, and a torsion at q has the
/// dihedral angle reference + q. Rings stay rigid. Cycles through disulphides and other cross-links are closures. The
/// closure of a disulphide keeps its length and two angles. The closure of another bond, or of a torsion that closes a
/// cycle, keeps the bond's length and the angles at both ends; only rotation about the bond is free. If its torsion is
/// an omega, that is fixed too. One rigid fragment of each connected component of the bond graph is fixed in the world,
/// or in its placed part. Views and references are valid for this object's lifetime. Const members may be called by
/// many threads at once.
class HINGE_API Molecule {
 public:
  /// Throws ModelError if psi of a loop's last residue is undefined, or a placed part is empty, is bonded to an atom
  /// outside it, or shares a residue with another.
  explicit Molecule(Structure structure, const MoleculeOptions& options = {});

  /// The value of torsion_of() for a DOF that places a part.
  static constexpr std::size_t no_torsion = ~std::size_t{0};

  /// The structure given to the constructor.
  const Structure& structure() const noexcept { return structure_; }
  /// The model of the hierarchy; link poses and primitives in angstrom, world frame = the file's frame.
  const Model<Point>& model() const noexcept { return *model_; }
  /// The torsions that are DOF, in residue order.
  std::span<const Torsion> torsions() const noexcept { return torsions_; }
  /// The DOF of torsions()[k]. k < torsions().size().
  DofId dof(std::size_t k) const noexcept { return dof_[k]; }
  /// The index in torsions() of a DOF's torsion, or no_torsion.
  std::size_t torsion_of(DofId dof) const noexcept { return torsion_of_[index(dof)]; }
  /// Returns the selection that frees these torsions (indices in torsions()). Throws std::out_of_range for a bad index.
  DofSelection select(std::span<const std::size_t> torsions) const;
  /// The loops given to the constructor.
  std::span<const Loop> loops() const noexcept { return loops_; }
  /// Returns the selection that frees these torsions and the placements of all placed parts.
  DofSelection select_placed(std::span<const std::size_t> torsions) const;
  /// The placed parts, in the order given to the constructor.
  std::span<const PlacedPart> placed_parts() const noexcept { return placed_; }
  /// The two atoms that each closure of the tree joins, in the order of the tree's closures: those of a bond or a
  /// hydrogen bond, or one atom in each of two held fragments.
  std::span<const std::array<std::uint32_t, 2>> closure_atoms() const noexcept { return closure_atoms_; }
  /// Decisions of the construction: undefined torsions, torsions in rings, closures. One sentence each.
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

/// Returns BioCD's basic groups, one label per atom. Amino acid: pseudo-backbone (backbone and C-beta) and
/// pseudo-side-chain; proline is one group; side chains that a disulphide joins are one group. Nucleotide: backbone and
/// base. Any other residue: one group.
HINGE_API std::vector<std::uint32_t> basic_groups(const Structure& structure);

}  // namespace hinge::molecular
