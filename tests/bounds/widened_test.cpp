// SPDX-License-Identifier: BSD-3-Clause
// A double converted to float and back is rounded, even if the optimiser combines two conversions.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>

#include "hinge/detail/bounds/float_box.hpp"

namespace hinge {
namespace widened_test {

[[gnu::noinline]] std::array<double, 3> through_floats(const double* x) {
  return {detail::widened(static_cast<float>(x[0])), detail::widened(static_cast<float>(x[1])),
          detail::widened(static_cast<float>(x[2]))};
}

TEST(Widened, IsTheRoundedNumberWhereTwoAreConvertedAtOnce) {
  volatile double tenth = 0.1;  // prevents evaluation at compile time
  const std::array<double, 3> x{3.7 * tenth, 7.4 * tenth, -12.1 * tenth};
  const std::array<double, 3> rounded = through_floats(x.data());
  for (std::size_t k = 0; k < 3; ++k) {
    volatile float alone = static_cast<float>(x[k]);
    EXPECT_EQ(rounded[k], static_cast<double>(alone));
    EXPECT_NE(rounded[k], x[k]);
  }
}

}  // namespace widened_test
}  // namespace hinge
