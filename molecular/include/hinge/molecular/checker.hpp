// SPDX-License-Identifier: BSD-3-Clause
// Checker: tests conformations of a molecule for a selection and clash rules, with the engine chosen at run time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/batch/state_batch.hpp"
#include "hinge/core/api.hpp"
#include "hinge/detail/batch/faster_way.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/pair_scope.hpp"
#include "hinge/molecular/radii.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/query/mode.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::molecular {

/// The hierarchy of a molecule: atoms as points, thresholds by type.
template <template <class, class, class> class EngineOf>
using MolecularHierarchy = Hierarchy<Point, BondExclusions, TypedThresholds, EngineOf>;

using hinge::Mode;

/// Options of a Checker.
struct CheckOptions {
  ThresholdOptions thresholds;   ///< clash rules and radii
  std::optional<int> min_bonds;  ///< number of bonds from which a pair counts; nullopt: by the rules or radii set
  /// Leave out pairs that collide in the reference, except interfaces: pairs of two files, or of an atom in a placed
  /// part and one outside it.
  bool exempt_reference = false;
  bool exempt_interfaces = false;  ///< with exempt_reference: leave out interfaces too
  PairScope scope{};               ///< tested pairs, made for the molecule's structure; default: all
  std::string engine = "simd";     ///< "simd", "lazy" (the paper's) or "brute"
};

/// A pair, and whether it collides: near the threshold, the rounded distance in `hit` cannot tell.
struct Contact {
  Hit hit;                ///< atoms, distance and threshold M in angstrom
  bool collides = false;  ///< d < M, decided from the unrounded distance

  /// Returns true if all members are equal.
  friend bool operator==(const Contact&, const Contact&) = default;
};

/// The answer for one conformation. `pairs`: mode all: colliding pairs; within: pairs with d < M + margin; any and
/// closest: empty. `collides` is true if any tested pair collides. Pairs of constant distance are left out by
/// Checker::check, but not by check_coordinates.
struct Verdict {
  bool collides = false;           ///< a tested pair collides
  std::vector<Contact> pairs;      ///< by the mode, see above
  std::optional<Contact> closest;  ///< mode closest only: the pair of least d - M; one that collides, if any does
  double closure_residual = 0.0;   ///< largest of closure_residuals, angstrom; 0 for given coordinates
  /// One per closure of the molecule's tree, angstrom; empty for given coordinates.
  std::vector<double> closure_residuals{};
};

/// A smooth measure of the clashes of a conformation, with its derivatives.
struct Steric {
  /// Sum of (M + softness - d)^2 over the tested pairs with d < M + softness, square angstrom.
  double energy = 0.0;
  /// Derivatives of the energy, one per selected DOF: square angstrom per rad, or angstrom for slides. A pair of atoms
  /// at the same place adds nothing, because it has no direction.
  std::vector<double> gradient;
};

/// Tests conformations of one molecule. One per thread: checks change its state. Copies share all constant data.
class HINGE_API Checker {
 public:
  /// `molecule` is shared, not copied; null throws ModelError. Also throws ModelError if the engine, the rules or the
  /// radii set are unknown, a number is out of range, or an option is set that the rules fix.
  Checker(std::shared_ptr<const Molecule> molecule, DofSelection selection, const CheckOptions& options);

  /// The molecule. Valid for the lifetime of this object or of any copy.
  const Molecule& molecule() const noexcept { return *molecule_; }
  /// The thresholds in use. Valid as molecule().
  const Thresholds& thresholds() const noexcept { return *thresholds_; }
  /// The filter of pairs by bonds. Valid as molecule().
  const BondExclusions& exclusions() const noexcept { return *exclusions_; }
  /// The number of bonds from which pairs count.
  MinBonds min_bonds() const noexcept { return min_bonds_; }
  /// Pairs that collide in the reference coordinates, in decimals as the file gives them, sorted. All admitted pairs
  /// are tested, independent of the selection. Valid for the lifetime of this object or of any copy.
  std::span<const Hit> reference_collisions() const noexcept { return *reference_; }
  /// The reference collisions whose distance the selection cannot change, without exempted ones. Valid as above.
  std::span<const Hit> constant_contacts() const noexcept { return *constant_; }

  /// The free DOF; valid until this object is assigned to or destroyed.
  const DofSelection& selection() const;
  /// Number of values of a configuration.
  std::size_t dof_count() const;
  /// The rigid groups under the selection, including the world's; valid as selection().
  const RigidGroups& rigid_groups() const;
  /// The rigid group of an atom.
  GroupId group_of(std::uint32_t atom) const;
  /// True if the selection cannot change the distance of atoms i and j.
  bool constant(std::uint32_t i, std::uint32_t j) const;
  /// The atoms of the fixed rigid group that no moving atom can bring within a threshold, for any values of the free
  /// torsions, in increasing order. It is proved from the lengths of the chains between torsions. Modes any and all of
  /// engine simd leave these atoms out.
  std::vector<std::uint32_t> out_of_reach() const;

  /// Tests the conformation at q. q: dof_count() values, angles in rad and slides in angstrom, relative to the
  /// reference. Throws ConfigurationError if their number is wrong or a value is not finite.
  Verdict check(std::span<const double> q, const Mode& mode);
  /// Tests only the pairs whose rigid group of the larger index is in `groups` (QueryOptions::groups), at q. The values
  /// of later groups do not matter. Returns true if one collides. Throws ConfigurationError as above.
  bool collides_in(std::span<const double> q, GroupRange groups);
  /// Returns the pairs of the same kind that collide at the conformation of the last check, sorted.
  std::vector<Hit> collisions_in(GroupRange groups) const;
  /// Returns one verdict per conformation: 1 if it collides, otherwise 0, as check() in mode any. conformations: one
  /// after the other, dof_count() values each; the last one becomes the state. The SIMD engine tests them one by one or
  /// sixteen at a time (see StateBatch), whichever way was faster recently. Sixteen at a time is faster for
  /// conformations that are near each other and mostly free. Throws ConfigurationError if the number of values is
  /// wrong, or as check(), naming the configuration.
  std::vector<std::uint8_t> check_batch(std::span<const double> conformations);
  /// Returns the steric energy at q and its gradient. Pairs of constant distance do not count. Costs one query and one
  /// sweep from the outermost rigid groups to the root. softness: angstrom. The bits of the result do not depend on the
  /// engine or the instruction set. Throws ConfigurationError as check(), and if softness is negative or not finite.
  Steric steric(std::span<const double> q, double softness);
  /// Tests given coordinates. positions: angstrom, one per atom. Every admitted pair is tested, independent of the
  /// selection. Distances of atoms whose coordinates have at most three decimals, as in files, are compared in exact
  /// decimals.
  Verdict check_coordinates(std::span<const Vec3> positions, const Mode& mode);
  /// The coordinates of one atom at the last check, angstrom.
  Vec3 position(std::uint32_t atom) const;
  /// The coordinates of the last check, angstrom, one per atom.
  std::vector<Vec3> positions();

 private:
  using AnyHierarchy = std::variant<MolecularHierarchy<Simd>, MolecularHierarchy<Lazy>, MolecularHierarchy<Brute>>;
  AnyHierarchy make(const std::string& engine, DofSelection selection) const;

  std::shared_ptr<const Molecule> molecule_;
  std::shared_ptr<const Thresholds> thresholds_;
  std::shared_ptr<const BondExclusions> exclusions_;
  std::shared_ptr<const std::vector<Hit>> reference_;
  std::shared_ptr<const std::vector<Hit>> constant_;
  MinBonds min_bonds_{4};
  std::optional<AnyHierarchy> hierarchy_;
  std::optional<StateBatch<Point, BondExclusions, TypedThresholds>> batch_;  // made by the first check_batch()
  hinge::detail::FasterWay faster_;                                          // 0: one by one, 1: batch_
  bool mostly_collide_ = true;  // most of the last block of check_batch() collided; at first, one by one
};

}  // namespace hinge::molecular
