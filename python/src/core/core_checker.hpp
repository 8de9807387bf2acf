// SPDX-License-Identifier: BSD-3-Clause
// CoreChecker: a checker of a model from arrays, as Python holds it.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core_queries.hpp"
#include "made_caster.hpp"
#include "worker_pool.hpp"

namespace hinge::python {

/// One row of the structured arrays of pairs.
struct CorePairRow {
  std::int64_t configuration;
  std::uint32_t i, j;
  double distance, threshold;
};

inline CorePairRow row_of(std::size_t configuration, const Hit& hit) {
  return {static_cast<std::int64_t>(configuration), static_cast<std::uint32_t>(index(hit.first)),
          static_cast<std::uint32_t>(index(hit.second)), hit.distance, hit.threshold};
}

/// Joins the rows of all configurations, in their order.
inline std::vector<CorePairRow> joined(const std::vector<std::vector<CorePairRow>>& rows) {
  std::vector<CorePairRow> all;
  for (const auto& some : rows) all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// Many threads may call it at once.
struct CoreChecker {
  using MadeByInit = void;
  CoreChecker(const CoreQueries& queries, std::vector<std::uint32_t> groups, unsigned n)
      : pool(queries), group_of(std::move(groups)), dof(queries.dof), threads(n) {}
  WorkerPool<CoreQueries> pool;
  std::vector<std::uint32_t> group_of;  ///< per primitive
  std::size_t dof;
  unsigned threads;
};

/// Returns a margin from 0 to 1e300. Throws TypeError and ValueError.
double as_margin(const pybind11::object& within);

using CoreCheckerClass = pybind11::class_<CoreChecker>;
void add_core_paths(CoreCheckerClass& checker);  ///< proofs and samples along paths
void add_two_models(CoreCheckerClass& checker);  ///< against another checker

}  // namespace hinge::python
