// SPDX-License-Identifier: BSD-3-Clause
// TorsionPrior: the distribution that torsions are drawn from: protein statistics, uniform or Gaussian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

class BackboneGeometry;

/// Distributions of torsions.
enum class Prior : std::uint8_t {
  /// Each torsion by itself: uniform over the full turn, or Gaussian about the reference.
  independent,
  /// Amino acids: phi and psi of a residue together by its Ramachandran distribution, in six kinds of residues; side
  /// chains by rotamers, each torsion Gaussian about the rotamer's mean; omega Gaussian about the reference, standard
  /// deviation 5 degrees. D residues: the mirror image. Everything else: as independent.
  ramachandran
};

/// Draws the torsions of a selection in groups ("units"), each with torsions of one residue.
///
/// Source of the statistics: the Top8000 data set of the Richardson laboratory (B. J. Hintze, S. M. Lewis, J. S.
/// Richardson, D. C. Richardson, "MolProbity's ultimate rotamer-library distributions for model validation", Proteins
/// 84, 2016; licence CC BY 4.0), https://github.com/rlabduke/reference_data. Bins of phi and psi are 10 degrees wide.
class HINGE_API TorsionPrior {
 public:
  /// units: for each unit the positions of its torsions in a configuration of the selection, in the order in which
  /// draw() will be called. No unit has a DOF that places a part. sigma (rad): standard deviation of the Gaussian;
  /// nullopt: uniform. Throws ModelError if Prior::ramachandran comes with sigma.
  TorsionPrior(const Molecule& molecule, const DofSelection& selection, Prior prior, std::optional<double> sigma,
               std::vector<std::vector<std::size_t>> units);

  /// Draws the torsions of a unit. Writes them to q: rotations relative to the reference, rad, one per selected DOF. If
  /// only one of phi and psi is in the unit and the other one is fixed or was drawn in an earlier unit, it is drawn
  /// given that value.
  void draw(std::size_t unit, SampleStream& stream, std::span<double> q) const;

 private:
  static constexpr std::size_t none = ~std::size_t{0};

  /// phi and psi of one residue. A torsion that is not free keeps its reference.
  struct Backbone {
    std::array<std::size_t, 2> position{none, none};  // of phi and psi in a configuration; none: not free
    std::array<double, 2> reference{};                // rad
    std::array<bool, 2> drawn{};                      // in this unit
    bool given = false;                               // the other torsion is fixed or was drawn earlier
    bool mirrored = false;                            // D residue
    std::size_t table = 0;                            // in the Ramachandran tables
  };
  struct SideChain {
    std::size_t first_rotamer = 0, rotamers = 0;                  // in the table of rotamers
    std::array<std::size_t, 4> position{none, none, none, none};  // of chi1 ... chi4; none: not free
    std::array<double, 4> reference{};                            // rad
    bool mirrored = false;
  };
  struct Unit {
    std::optional<Backbone> backbone;
    std::optional<SideChain> side_chain;
    std::vector<std::size_t> omegas, others;  // positions
  };
  static Unit make(const Molecule& molecule, const DofSelection& selection, const BackboneGeometry& geometry,
                   const std::vector<std::size_t>& positions, const std::vector<bool>& drawn_before);
  static void draw_backbone(const Backbone& backbone, SampleStream& stream, std::span<double> q);
  static void draw_side_chain(const SideChain& side_chain, SampleStream& stream, std::span<double> q);

  std::optional<double> sigma_;
  std::vector<Unit> units_;
};

}  // namespace hinge::molecular
