// SPDX-License-Identifier: BSD-3-Clause
// MoveCounts: the work done by Monte Carlo moves.
#pragma once

#include <cstdint>

#include "hinge/query/query_options.hpp"

namespace hinge {

/// Work done by moves; every tried move adds to it.
struct MoveCounts {
  std::uint64_t tried = 0;         ///< moves tried
  std::uint64_t full_queries = 0;  ///< moves answered by a query of the whole model
  std::uint64_t recalled = 0;      ///< other moves, rejected by a pair that collided in a recent move
  /// blocks (up to sixteen primitives each) moved by moves answered without a full query
  std::uint64_t blocks_moved = 0;
  QueryCounts query;  ///< work of those moves
};

}  // namespace hinge
