// SPDX-License-Identifier: BSD-3-Clause
// relax: mends the clashes of a conformation and moves it as little as possible.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/checker.hpp"

namespace hinge::molecular {

/// Options of relax().
struct RelaxOptions {
  std::vector<std::size_t> closures{};  ///< closures to keep (find_kept_closures), indices in the tree's
  std::uint64_t most_restarts = 1000;   ///< random restarts if descent alone does not mend all clashes
  std::uint64_t seed = 1;               ///< of the restarts
};

/// The result of relax().
struct Relaxation {
  /// One value per selected DOF, relative to the reference, rad or angstrom: the start itself if nothing better was
  /// found.
  std::vector<double> q;
  std::size_t collisions_before = 0;  ///< pairs that collide at the start
  std::size_t collisions = 0;         ///< pairs that collide at q
  double energy_before = 0.0;         ///< steric energy of softness 0 at the start, square angstrom
  double energy = 0.0;                ///< the same at q
  std::uint64_t restarts = 0;         ///< restarts that were made
  bool stopped = false;               ///< stop() ended the search
};

/// Moves the selected DOF until no tested pair collides, as little as possible, or until the restarts are used up.
///
/// It minimises Checker::steric(q, 0.02 angstrom) + mu * (sum of squared displacements of all atoms) with L-BFGS
/// (Nocedal 1980; NLopt), for mu from 0.01 down to 0, and stops at the first mu whose minimum is free by at least 0.002
/// angstrom, so that it stays free in a file with three decimals. Closures enter with their squared residuals and are
/// then closed by ClosureSolver.
///
/// If pairs still collide, restarts turn the torsions of one residue, or move one placed part, that is in the way: of
/// 32 random tries the one with the least energy is minimised, and kept if fewer pairs collide or the energy is
/// smaller. Torsions that move atoms of one residue only are drawn over the full range; others Gaussian about the
/// present value (15 degrees, 0.5 angstrom). A free conformation then returns towards the start as far as it stays
/// free.
///
/// The result never has more colliding pairs than the start; with as many, its energy is smaller. Pairs of constant
/// distance are not counted. It depends on the arguments alone. q: one value per selected DOF, with its closures
/// closed. stop: called at every evaluation of the energy; if it returns true, the search ends with
/// the best conformation so far. The checker is copied. Throws
/// ModelError if nothing is free, or a closure does not exist; ConfigurationError as Checker::check().
HINGE_API Relaxation relax(const Checker& checker, std::span<const double> q, const RelaxOptions& options = {},
                           const std::function<bool()>& stop = {});

}  // namespace hinge::molecular
