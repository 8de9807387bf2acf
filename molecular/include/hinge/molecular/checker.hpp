// SPDX-License-Identifier: BSD-3-Clause
// Checker: a molecule, a selection and the rules of a check put together, with the engine chosen at run time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/pair_scope.hpp"
#include "hinge/molecular/radii.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge_tools/mode.hpp"

namespace hinge::molecular {

template <template <class, class, class> class EngineOf>
using MolecularHierarchy = Hierarchy<Point, BondExclusions, TypedThresholds, EngineOf>;

using hinge::Mode;

struct CheckOptions {
  ThresholdOptions thresholds;
  std::optional<int> min_bonds;    ///< pairs count from this bond distance on; none: the rules' or the radii set's
  bool exempt_reference = false;   ///< pairs that collide in the reference never count, but for those of interfaces:
  bool exempt_interfaces = false;  ///< of two files, or of a placed part and what is none of it; these neither, if set
  PairScope scope{};            ///< which pairs are asked about, made for the molecule's structure; none else is named
  std::string engine = "simd";  ///< "simd", "lazy" (the paper's) or "brute"
};

/// A pair and whether it collides, which its rounded distance cannot say.
struct Contact {
  Hit hit;
  bool collides = false;

  friend bool operator==(const Contact&, const Contact&) = default;
};

/// The answer for one conformation. `pairs` holds what the mode lists (all: colliding; within: closer than the margin;
/// any: none, it stops at the first), `closest` only in mode closest. Pairs of constant distance are not in it. It
/// collides exactly when a pair does.
struct Verdict {
  bool collides = false;
  std::vector<Contact> pairs;
  std::optional<Contact> closest;           ///< a pair that collides, where one does
  double closure_residual = 0.0;            ///< worst over the molecule's closures, angstrom; 0 for coordinates given
  std::vector<double> closure_residuals{};  ///< of each closure of the molecule's tree; none for coordinates given
};

/// One per thread; copies share everything constant.
class Checker {
 public:
  /// ModelError: unknown engine, rules or radii set, numbers out of range or beside rules that fix them.
  Checker(std::shared_ptr<const Molecule> molecule, DofSelection selection, const CheckOptions& options);

  const Molecule& molecule() const noexcept { return *molecule_; }
  const Thresholds& thresholds() const noexcept { return *thresholds_; }
  const BondExclusions& exclusions() const noexcept { return *exclusions_; }
  MinBonds min_bonds() const noexcept { return min_bonds_; }
  /// Pairs that collide in the reference coordinates, as written, all admitted pairs looked at, sorted.
  std::span<const Hit> reference_collisions() const noexcept { return *reference_; }
  /// Those whose distance the selection cannot change (and which are not exempted).
  std::span<const Hit> constant_contacts() const noexcept { return *constant_; }

  const DofSelection& selection() const;
  std::size_t dof_count() const;
  std::size_t rigid_group_count() const;
  GroupId group_of(std::uint32_t atom) const;
  /// Can the distance of two atoms not change under the selection?
  bool constant(std::uint32_t i, std::uint32_t j) const;

  /// The conformation at q: turns from the reference, rad, one per selected DOF.
  Verdict check(std::span<const double> q, const Mode& mode);
  /// Coordinates from elsewhere, angstrom, one per atom: every admitted pair counts, whatever the selection. Pairs of
  /// atoms whose coordinates have three decimals, as files give them, are decided in decimals (closer_as_written).
  Verdict check_coordinates(std::span<const Vec3> positions, const Mode& mode);
  /// The coordinates of the last check, angstrom.
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
};

}  // namespace hinge::molecular
