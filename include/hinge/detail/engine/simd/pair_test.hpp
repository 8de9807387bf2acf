// SPDX-License-Identifier: BSD-3-Clause
// SelfPairTest and CrossPairTest: decide pairs that floats cannot rule out, exactly or by a measured distance.
#pragma once

#include "hinge/core/id.hpp"
#include "hinge/detail/query/test_pair.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Pairs inside one model, in either order. `admits(i, j)` with i < j tells whether the pair counts.
template <Collector C, class Rules, class Admits>
struct SelfPairTest {
  C& collector;
  const Rules& rules;
  Admits admits;

  /// Decides the pair exactly. Returns true if the collector wanted it.
  template <Primitive P>
  [[gnu::always_inline]] bool operator()(PrimitiveId i, PrimitiveId j, const P& p, const P& q) const {
    const bool turned = j < i;
    const PrimitiveId first = turned ? j : i, second = turned ? i : j;
    return test_pair(collector, first, second, turned ? q : p, turned ? p : q, rules.threshold(first, second),
                     [&] { return admits(first, second); });
  }
  /// Decides by a measured distance with error at most `error`. Returns the number of undecided pairs, 0 or 1.
  [[gnu::always_inline]] unsigned operator()(PrimitiveId i, PrimitiveId j, double measured, double error) const {
    const PrimitiveId first = j < i ? j : i, second = j < i ? i : j;
    return test_measured_pair(collector, rules.options.precision, first, second, measured, error,
                              rules.threshold(first, second), [&] { return admits(first, second); });
  }
};

/// Pairs of two models: i of the first, j of the second.
template <Collector C, class Rules>
struct CrossPairTest {
  C& collector;
  const Rules& rules;

  template <Primitive P>
  bool operator()(PrimitiveId i, PrimitiveId j, const P& p, const P& q) const {
    return test_pair(collector, i, j, p, q, rules.threshold(i, j), [&] { return rules.admits(i, j); });
  }
  unsigned operator()(PrimitiveId i, PrimitiveId j, double measured, double error) const {
    return test_measured_pair(collector, rules.options.precision, i, j, measured, error, rules.threshold(i, j),
                              [&] { return rules.admits(i, j); });
  }
};

template <Collector C, class Rules, class Admits>
SelfPairTest(C&, const Rules&, Admits) -> SelfPairTest<C, Rules, Admits>;
template <Collector C, class Rules>
CrossPairTest(C&, const Rules&) -> CrossPairTest<C, Rules>;

}  // namespace hinge::detail
