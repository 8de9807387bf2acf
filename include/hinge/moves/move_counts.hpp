// SPDX-License-Identifier: BSD-3-Clause
// MoveCounts: what Monte Carlo moves report about their work.
#pragma once

#include <cstdint>

#include "hinge/query/query_options.hpp"

namespace hinge {

/// Work done by moves; added to by every move that is tried.
struct MoveCounts {
  std::uint64_t tried = 0;
  std::uint64_t full_queries = 0;  ///< moves that were answered by a query over all of the model
  std::uint64_t recalled = 0;      ///< of the others, those found colliding by a pair that collided lately
  std::uint64_t blocks_moved = 0;  ///< sixteens of primitives, or fewer, that the others take along
  QueryCounts query;               ///< of the others
};

}  // namespace hinge
