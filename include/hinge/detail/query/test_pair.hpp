// SPDX-License-Identifier: BSD-3-Clause
// test_pair: the leaf kernel. Every engine and query mode decides pairs of primitives here, exactly.
#pragma once

#include "hinge/core/id.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Passes the pair to the collector when its rounded d - M is at most `cutoff`. See test_pair.
template <Collector C, Primitive P, class Threshold, class Admitted>
bool test_rounded(C& collector, PrimitiveId i, PrimitiveId j, const P& p, const P& q, const Threshold& m, double cutoff,
                  Admitted&& admitted) {
  const Hit hit{i, j, distance(p, q), m};
  if (!(hit.gap() <= cutoff) || !admitted()) return false;
  collector.add(hit);
  return true;
}

/// Passes the pair to the collector when it satisfies BioCD eq. (1) with threshold m, extra clearances included. m is a
/// double or a RadiusSum. It tests the distance before admitted(): most pairs are far apart, and admitted() may cost a
/// look-up. Returns true when the collector received the pair.
template <Collector C, Primitive P, class Threshold, class Admitted>
bool test_pair(C& collector, PrimitiveId i, PrimitiveId j, const P& p, const P& q, const Threshold& m,
               Admitted&& admitted) {
  if constexpr (C::ranks) {
    return test_rounded(collector, i, j, p, q, m, collector.cutoff(), admitted);
  } else {
    const auto near = m + collector.cutoff();
    if (!closer_than(p, q, near) || !admitted()) return false;
    // Distances are never negative, so solids accepted at threshold 0 touch: their distance is 0.
    collector.add(Hit{i, j, near > 0.0 ? distance(p, q) : 0.0, m});
    return true;
  }
}

}  // namespace hinge::detail
