// SPDX-License-Identifier: BSD-3-Clause
// offer: the leaf kernel. The only place where a pair of primitives is judged, for every engine and every mode.
#pragma once

#include "hinge/core/id.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge {

/// Hands the pair to the collector when it is wanted: BioCD eq. (1) with threshold m (extra clearances included), a
/// double or the sum it is made of. The distance is looked at first and `admitted()` asked last: most pairs are far
/// apart, and knowing whether a pair counts may cost a look-up.
template <Collector C, Primitive P, class Threshold, class Admitted>
void offer(C& collector, PrimitiveId i, PrimitiveId j, const P& p, const P& q, const Threshold& m,
           Admitted&& admitted) {
  if constexpr (C::ranks) {
    const Hit hit{i, j, distance(p, q), m};
    if (hit.gap() <= collector.cutoff() && admitted()) collector.add(hit);
  } else {
    const auto near = m + collector.cutoff();
    if (closer_than(p, q, near) && admitted())
      // Nothing is closer than 0: solids that count at a threshold of 0 meet.
      collector.add(Hit{i, j, near > 0.0 ? distance(p, q) : 0.0, m});
  }
}

}  // namespace hinge
