// SPDX-License-Identifier: BSD-3-Clause
// CheckerHandle: a checker as Python holds it; many threads may call it at once.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "arrays.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/kept_closures.hpp"
#include "hinge/molecular/path_checker.hpp"
#include "molecule_handle.hpp"
#include "worker_pool.hpp"

namespace hinge::python {

/// One row of the structured arrays of pairs.
struct PairRow {
  std::int64_t conformation;
  std::uint32_t i, j;
  double distance, threshold;
  bool collides;
  Padding<7> padding{};
};

/// A checker with what its molecule needs for samples and moves.
struct CheckerHandle {
  using MadeByInit = void;
  CheckerHandle(MoleculeHandle of, molecular::KeptClosures kept_closures, const molecular::Checker& checker, unsigned n)
      : molecule(std::move(of)), kept(std::move(kept_closures)), pool(checker), threads(n) {}

  MoleculeHandle molecule;
  molecular::KeptClosures kept;
  WorkerPool<molecular::Checker> pool;
  unsigned threads;  ///< default of calls

  const molecular::Checker& checker() const noexcept { return pool.prototype(); }
  std::size_t dof() const { return checker().dof_count(); }
};

using CheckerClass = pybind11::class_<CheckerHandle>;

/// Returns a row of a contact.
inline PairRow pair_row(std::int64_t conformation, const molecular::Contact& contact) {
  return {conformation,
          static_cast<std::uint32_t>(index(contact.hit.first)),
          static_cast<std::uint32_t>(index(contact.hit.second)),
          contact.hit.distance,
          contact.hit.threshold,
          contact.collides};
}

/// Returns the mode of a list of pairs with d < threshold + within. Throws TypeError, and ValueError unless `within` is
/// a length from 0 to 1e9 angstrom.
molecular::Mode as_mode(const pybind11::object& within);

/// Joins the rows of all conformations, in their order.
std::vector<PairRow> joined(const std::vector<std::vector<PairRow>>& rows);

void add_facts(CheckerClass& checker);        ///< rules and selection
void add_coordinates(CheckerClass& checker);  ///< answers for given coordinates
void add_sampling(CheckerClass& checker);     ///< samples and walks
void add_paths(CheckerClass& checker);        ///< certified paths
void add_relaxation(CheckerClass& checker);   ///< steric energies, relaxation
void add_planning(CheckerClass& checker);     ///< planned motions, fitted conformations

}  // namespace hinge::python
