// SPDX-License-Identifier: BSD-3-Clause
#include "hinge/detail/engine/simd/tree/learned_order.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace {

using hinge::detail::LearnedOrder;

constexpr std::size_t things = 130;  // three words of marks
constexpr std::size_t none = things;

/// Marks these items and returns those that are visited, up to and including `last`.
std::vector<std::size_t> visited(LearnedOrder& order, const std::vector<std::size_t>& marked, std::size_t last = none) {
  std::vector<std::size_t> seen;
  order.start();
  for (const std::size_t thing : marked) order.mark(thing);
  order.each([&](std::size_t thing) {
    seen.push_back(thing);
    return thing != last;
  });
  return seen;
}

/// Items 7, 100 and 129 collide in three, two and one of four tests, the others never.
LearnedOrder learned() {
  LearnedOrder order(things);
  for (std::size_t thing = 0; thing < things; ++thing)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t hits = thing == 7 ? 3 : thing == 100 ? 2 : thing == 129 ? 1 : 0;
      order.add(thing, k < hits, 20);
    }
  return order;
}

using Items = std::vector<std::size_t>;

TEST(LearnedOrder, StartsWithTheItemsThatCollideMostOften) {
  LearnedOrder order = learned();
  EXPECT_EQ(visited(order, {3, 7, 64, 100, 129}), (Items{7, 100, 129, 3, 64}));
  EXPECT_EQ(visited(order, {129, 5}), (Items{129, 5}));
  EXPECT_EQ(visited(order, {}), Items{});
}

TEST(LearnedOrder, StartsWithTheItemThatEndedTheLastQuery) {
  LearnedOrder order = learned();
  EXPECT_EQ(visited(order, {7, 64, 100, 129}, 64), (Items{7, 100, 129, 64}));
  EXPECT_EQ(visited(order, {7, 64, 100, 129}), (Items{64, 7, 100, 129}));   // once, though it does not end this query
  EXPECT_EQ(visited(order, {7, 64, 100, 129}, 64), (Items{64}));            // and it is still the first
  EXPECT_EQ(visited(order, {7, 100, 129}, 100), (Items{7, 100}));           // it need not be marked
  EXPECT_EQ(visited(order, {7, 64, 100, 129}, 129), (Items{100, 7, 129}));  // the latest one counts
  EXPECT_EQ(visited(order, {64, 129}, 129), (Items{129}));
}

}  // namespace
