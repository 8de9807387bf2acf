// SPDX-License-Identifier: BSD-3-Clause
// Molecule: a structure as an articulated mechanism: links, torsions as joints, basic groups, closures.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/model/model.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/molecular/torsions.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::molecular {

struct MoleculeOptions {
  /// The molecule is cut at their ends (find_loops): what comes behind a loop does not hang on it, and psi of its last
  /// residue is no DOF but follows where the loop's closure holds.
  std::vector<Loop> loops{};
  bool keep_hydrogen_bonds = false;  ///< backbone hydrogen bonds (find_hydrogen_bonds) are closures
};

/// Every torsion of the structure is a joint; primitive i is atom i of model 0, in angstrom. Joint values are turns
/// away from that reference (rad), so that all 0 gives back the coordinates read, bit for bit, and a torsion at q has
/// the dihedral angle reference + q. Rings stay rigid; cycles through disulphides and other cross-links are closures. A
/// disulphide keeps its length and its two angles; any other bond, and a torsion that closes a cycle, keeps the angles
/// at both ends as they are, free to turn; of a peptide bond that closes a cycle omega is kept as well.
class Molecule {
 public:
  /// ModelError: the last psi of a loop is undefined.
  explicit Molecule(Structure structure, const MoleculeOptions& options = {});

  const Structure& structure() const noexcept { return structure_; }
  const Model<Point>& model() const noexcept { return *model_; }
  /// Torsions that are DOF, in residue order.
  std::span<const Torsion> torsions() const noexcept { return torsions_; }
  /// The DOF of torsions()[k].
  DofId dof(std::size_t k) const noexcept { return dof_[k]; }
  /// The torsion of a DOF: position in torsions().
  std::size_t torsion_of(DofId dof) const noexcept { return torsion_of_[index(dof)]; }
  /// The selection that frees these torsions (positions in torsions()).
  DofSelection select(std::span<const std::size_t> torsions) const;
  /// As given to the constructor.
  std::span<const Loop> loops() const noexcept { return loops_; }
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
  std::optional<Model<Point>> model_;
};

/// BioCD's basic groups: pseudo-backbone (backbone and C-beta) and pseudo-side-chain of each residue, proline whole,
/// the side chains a disulphide joins as one; for nucleotides backbone and base; any other residue whole. One label per
/// atom.
std::vector<std::uint32_t> basic_groups(const Structure& structure);

}  // namespace hinge::molecular
