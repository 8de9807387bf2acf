// SPDX-License-Identifier: BSD-3-Clause
// FasterWay uses the faster of two ways for nearly all pieces, also when the other one becomes the faster.
#include "hinge/detail/batch/faster_way.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace hinge {
namespace faster_way_test {

/// Number of `pieces` that way 1 did.
std::size_t done_by_second(detail::FasterWay& way, std::size_t pieces, double first_seconds, double second_seconds) {
  std::size_t second = 0;
  for (std::size_t k = 0; k < pieces; ++k) {
    second += way.next();
    way.took(way.next() == 0 ? first_seconds : second_seconds);
  }
  return second;
}

TEST(FasterWay, DoesNearlyAllWithTheFasterWay) {
  detail::FasterWay first, second;
  EXPECT_LT(done_by_second(first, 10'000, 1.0, 100.0), 25U);
  EXPECT_GT(done_by_second(second, 10'000, 1.0, 0.9), 9'970U);
}

TEST(FasterWay, FollowsAChange) {
  detail::FasterWay way;
  done_by_second(way, 1000, 1.0, 2.0);
  const std::size_t second = done_by_second(way, 10'000, 1.0, 0.5);
  EXPECT_GT(second, 8'000U);
  EXPECT_LT(done_by_second(way, 20'000, 0.1, 0.5), 16'000U);
}

}  // namespace faster_way_test
}  // namespace hinge
