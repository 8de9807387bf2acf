// SPDX-License-Identifier: BSD-3-Clause
// TreePairTest: the functions that traversals of trees call for pairs, for one model and for two.
#pragma once

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/pair_test.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/query/pair_rules.hpp"

namespace hinge::detail {

/// For i of the first model and j of the second: test_pair(i, j, p, q) decides a placed pair that floats could not rule
/// out; threshold(i, j); admits(i, j); admits_links(a, b) is false if all pairs of the two links are excluded.
template <class TestPair, class Threshold, class Admits, class AdmitsPairs>
struct TreePairTest {
  TestPair test_pair;
  Threshold threshold;
  Admits admits;
  AdmitsPairs admits_links;
};
template <class TestPair, class Threshold, class Admits, class AdmitsPairs>
TreePairTest(TestPair, Threshold, Admits, AdmitsPairs) -> TreePairTest<TestPair, Threshold, Admits, AdmitsPairs>;

/// Decisions go to the collector. The result refers to both arguments.
template <Collector C, Primitive P, PairFilter F, DistanceMatrix D>
auto tree_pair_test(C& collector, const SelfRules<P, F, D>& rules) {
  const auto in_order = [](PrimitiveId i, PrimitiveId j, const auto& say) { return j < i ? say(j, i) : say(i, j); };
  return TreePairTest{SelfPairTest{collector, rules, [&rules](auto i, auto j) { return rules.admits(i, j); }},
                      [&rules, in_order](PrimitiveId i, PrimitiveId j) {
                        return in_order(i, j, [&](auto k, auto l) { return rules.threshold(k, l); });
                      },
                      [&rules, in_order](PrimitiveId i, PrimitiveId j) {
                        return in_order(i, j, [&](auto k, auto l) { return rules.admits(k, l); });
                      },
                      [](LinkId, LinkId) { return true; }};
}
template <Collector C, Primitive P, PairFilter G, CrossMatrix D>
auto tree_pair_test(C& collector, const CrossRules<P, G, D>& rules) {
  return TreePairTest{CrossPairTest{collector, rules},
                      [&rules](PrimitiveId i, PrimitiveId j) { return rules.threshold(i, j); },
                      [&rules](PrimitiveId i, PrimitiveId j) { return rules.admits(i, j); },
                      [&](LinkId a, LinkId b) {
                        if constexpr (AdmitsLinks<G>) return rules.filter.admits(a, b);
                        return true;
                      }};
}

}  // namespace hinge::detail
