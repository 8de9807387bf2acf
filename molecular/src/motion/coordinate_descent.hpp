// SPDX-License-Identifier: BSD-3-Clause
// CoordinateDescent: moves a conformation towards given coordinates, with or without collisions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/closure_equations.hpp"
#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/fit_coordinates.hpp"
#include "motion/minimise.hpp"

namespace hinge::molecular {

/// Throws as the constructor of CoordinateDescent for a bad target.
void check_target(const Checker& checker, const TargetCoordinates& target);

/// Minimises weight * (sum of squared distances of atoms from their target, after the best superposition) + the steric
/// energy, if wanted, + squared closure residuals. The distances are those of the atoms, not linear in the values, so
/// torsions that cancel each other cost nothing.
class CoordinateDescent {
 public:
  /// The checker and stop must outlive this object. stop: called at every evaluation; true ends the descent. Throws
  /// ModelError if the target has no atom or other numbers of atoms and positions, or an atom or closure does not
  /// exist; ConfigurationError if a position is not finite.
  CoordinateDescent(Checker& checker, const TargetCoordinates& target, std::span<const std::size_t> closures,
                    const std::function<bool()>& stop);

  /// Sets another target: one position per atom, angstrom, in any frame.
  void aim(std::vector<Vec3> positions);
  /// Returns the positions of the atoms at q, in the frame of the root. They are valid until the next call.
  const std::vector<Vec3>& place(std::span<const double> q);
  /// Returns the root mean square distance from the target at q, angstrom.
  double rmsd(std::span<const double> q);
  /// Moves q as near to the target as it gets in so many evaluations; collisions do not count. Closures may be open.
  void approach(std::vector<double>& q, int evaluations);
  /// Moves q away from collisions and otherwise as near to the target as it gets. Returns true if no pair collides,
  /// also after the rounding of a file, and all closures are closed; q is changed in any case. evaluations: largest
  /// number of each descent. stiffness: weight of squared changes of the values (rad, angstrom) against squared
  /// distances; it keeps torsions that cancel each other.
  bool make_free(std::vector<double>& q, int evaluations, double stiffness);
  /// Closes the closures of q. Returns false if they do not close.
  bool close(std::vector<double>& q) { return !solver_ || solver_->close(q); }
  /// True if stop() returned true.
  bool stopped() const noexcept { return minimiser_.stopped(); }

 private:
  enum class Clashes { ignored, avoided };

  /// What pulls values to where they were: stiffness * (value - start)^2.
  struct Pull {
    std::span<const double> start{};
    double stiffness = 0.0;
  };

  void minimise(std::vector<double>& q, double weight, Clashes clashes, int evaluations, const Pull& pull);
  /// Returns the objective at q and its derivatives by the values.
  double objective(std::span<const double> q, double weight, Clashes clashes, std::vector<double>& gradient);
  /// Returns the distance of atom k from its target, as a vector in the frame of the root. After place().
  Vec3 away(std::size_t k) const {
    return Vec3(here_[k] - centre_) - product(rotation_, Vec3(target_[k] - target_centre_));
  }
  void superpose_target();

  Checker& checker_;
  std::vector<Vec3> target_;
  Vec3 target_centre_ = Vec3::Zero();
  std::vector<std::size_t> group_;  // of each atom
  std::vector<Vec3> local_;         // its position in the frame of the group
  std::optional<ClosureEquations> equations_;
  std::optional<ClosureSolver> solver_;
  Minimiser minimiser_;
  // At the configuration of the last place():
  std::vector<Pose> poses_;
  std::vector<Vec3> here_;
  Vec3 centre_ = Vec3::Zero();
  Mat3 rotation_ = Mat3::Identity();  // from the target
};

}  // namespace hinge::molecular
