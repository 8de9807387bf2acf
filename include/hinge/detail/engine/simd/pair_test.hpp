// SPDX-License-Identifier: BSD-3-Clause
// SelfPairTest and CrossPairTest: decide pairs that floats cannot rule out.
#pragma once

#include "hinge/core/id.hpp"
#include "hinge/detail/query/test_pair.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// A collector that wants every pair which may lie within the cutoff, without an exact decision. Queries inside one
/// model pass it points by add_measured(hit, error) instead of add(hit), where floats hold the coordinates: the
/// distance of the hit has an error of at most `error` (model length unit), and distance - error < M + cutoff.
template <class C>
concept TakesMeasured = Collector<C> && !C::ranks && requires(C & collector, const Hit& hit, double error) {
  collector.add_measured(hit, error);
};

/// Pairs inside one model, in either order. `admits(i, j)` with i < j tells whether the pair counts.
template <Collector C, class Rules, class Admits>
struct SelfPairTest {
  C& collector;
  const Rules& rules;
  Admits admits;

  /// Returns the threshold of the pair, extra clearances included.
  auto threshold(PrimitiveId i, PrimitiveId j) const noexcept {
    return j < i ? rules.threshold(j, i) : rules.threshold(i, j);
  }
  /// Decides the pair with threshold m exactly. Returns true if the collector wanted it.
  template <Primitive P, class Threshold>
  [[gnu::always_inline]] bool operator()(PrimitiveId i, PrimitiveId j, const P& p, const P& q,
                                         const Threshold& m) const {
    const bool turned = j < i;
    const PrimitiveId first = turned ? j : i, second = turned ? i : j;
    return test_pair(collector, first, second, turned ? q : p, turned ? p : q, m,
                     [&] { return admits(first, second); });
  }
  template <Primitive P>
  [[gnu::always_inline]] bool operator()(PrimitiveId i, PrimitiveId j, const P& p, const P& q) const {
    return (*this)(i, j, p, q, threshold(i, j));
  }
  /// Adds the pair if its rounded d - M is at most `cutoff`.
  template <Primitive P>
  bool rounded(PrimitiveId i, PrimitiveId j, const P& p, const P& q, double cutoff) const {
    if (j < i) return rounded(j, i, q, p, cutoff);
    return test_rounded(collector, i, j, p, q, rules.threshold(i, j), cutoff, [&] { return admits(i, j); });
  }
  /// Adds the pair with its measured distance, unless it surely lies outside the cutoff. See TakesMeasured.
  [[gnu::always_inline]] void add_measured(PrimitiveId i, PrimitiveId j, double measured,
                                           double error) const requires TakesMeasured<C> {
    const PrimitiveId first = j < i ? j : i, second = j < i ? i : j;
    const double m = rules.threshold(first, second), near = m + collector.cutoff();
    if (near > 0.0 && measured - error < near && admits(first, second))
      collector.add_measured(Hit{first, second, measured, m}, error);
  }
};

/// Pairs of two models: i of the first, j of the second.
template <Collector C, class Rules>
struct CrossPairTest {
  C& collector;
  const Rules& rules;

  /// The same as in SelfPairTest.
  auto threshold(PrimitiveId i, PrimitiveId j) const noexcept { return rules.threshold(i, j); }
  template <Primitive P, class Threshold>
  bool operator()(PrimitiveId i, PrimitiveId j, const P& p, const P& q, const Threshold& m) const {
    return test_pair(collector, i, j, p, q, m, [&] { return rules.admits(i, j); });
  }
  template <Primitive P>
  bool operator()(PrimitiveId i, PrimitiveId j, const P& p, const P& q) const {
    return (*this)(i, j, p, q, threshold(i, j));
  }
  /// The same as in SelfPairTest.
  template <Primitive P>
  bool rounded(PrimitiveId i, PrimitiveId j, const P& p, const P& q, double cutoff) const {
    return test_rounded(collector, i, j, p, q, rules.threshold(i, j), cutoff, [&] { return rules.admits(i, j); });
  }
};

/// True if the pairs of a query may be added with measured distances.
template <class TestPair>
concept AddsMeasured = requires(const TestPair& test_pair, PrimitiveId i) {
  test_pair.add_measured(i, i, 0.0, 0.0);
};

template <Collector C, class Rules, class Admits>
SelfPairTest(C&, const Rules&, Admits) -> SelfPairTest<C, Rules, Admits>;
template <Collector C, class Rules>
CrossPairTest(C&, const Rules&) -> CrossPairTest<C, Rules>;

}  // namespace hinge::detail
