// SPDX-License-Identifier: BSD-3-Clause
// test_pair: the leaf kernel. The only place where a pair of primitives is judged, for every engine and every mode,
// exactly or by a distance that was only measured.
#pragma once

#include "hinge/core/id.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Hands the pair to the collector when it is wanted: BioCD eq. (1) with threshold m (extra clearances included), a
/// double or the sum it is made of. The distance is looked at first and `admitted()` asked last: most pairs are far
/// apart, and knowing whether a pair counts may cost a look-up. Was it wanted?
template <Collector C, Primitive P, class Threshold, class Admitted>
bool test_pair(C& collector, PrimitiveId i, PrimitiveId j, const P& p, const P& q, const Threshold& m,
               Admitted&& admitted) {
  if constexpr (C::ranks) {
    const Hit hit{i, j, distance(p, q), m};
    if (!(hit.gap() <= collector.cutoff()) || !admitted()) return false;
    collector.add(hit);
  } else {
    const auto near = m + collector.cutoff();
    if (!closer_than(p, q, near) || !admitted()) return false;
    // Nothing is closer than 0: solids that count at a threshold of 0 meet.
    collector.add(Hit{i, j, near > 0.0 ? distance(p, q) : 0.0, m});
  }
  return true;
}

/// The same for primitives without a body (never closer than 0) whose distance is within `error` of `measured`. What
/// that leaves open is for `precision` to say; returns 1 for such a pair, 0 for a decided one.
template <Collector C, class Admitted>
unsigned test_measured_pair(C& collector, Precision precision, PrimitiveId i, PrimitiveId j, double measured,
                            double error, double m, Admitted&& admitted) {
  const double near = m + collector.cutoff();
  if (!(near > 0.0) || measured - error >= near) return 0;
  const bool open = measured + error >= near;
  if (!admitted()) return 0;
  if (!open || precision == Precision::never_miss) {
    if constexpr (TakesErrors<C>)
      collector.add_measured(Hit{i, j, measured, m}, error);
    else
      collector.add(Hit{i, j, measured, m});
  }
  return open ? 1 : 0;
}

}  // namespace hinge::detail
