// SPDX-License-Identifier: BSD-3-Clause
// is_finite of many numbers against std::isfinite.
#include "hinge/core/finite.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace hinge {
namespace finite_test {

TEST(IsFinite, FindsOneNumberAtEveryPlace) {
  using Limits = std::numeric_limits<double>;
  const std::vector<double> odd = {Limits::infinity(),
                                   Limits::quiet_NaN(),
                                   Limits::signaling_NaN(),
                                   Limits::max(),
                                   Limits::denorm_min(),
                                   Limits::min(),
                                   0.0,
                                   -0.0};
  for (std::size_t size = 0; size <= 40; ++size) {
    std::vector<double> numbers(size, -1.5);
    EXPECT_TRUE(is_finite(std::span<const double>(numbers)));
    for (std::size_t k = 0; k < size; ++k)
      for (const double number : odd)
        for (const double sign : {1.0, -1.0}) {
          numbers[k] = std::copysign(number, sign);
          EXPECT_EQ(is_finite(std::span<const double>(numbers)), std::isfinite(number)) << size << ' ' << k;
          numbers[k] = -1.5;
        }
  }
}

}  // namespace finite_test
}  // namespace hinge
