// SPDX-License-Identifier: BSD-3-Clause
// Philox against published answers, and the distribution of SampleStream.
#include "hinge/core/philox.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hinge {
namespace philox_test {

TEST(Philox, GivesThePublishedAnswers) {
  // Known-answer vectors of the Random123 distribution for philox4x32-10.
  using Words = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t all = 0xffffffff;
  EXPECT_EQ(philox({all, all, all, all}, {all, all}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(SampleStream, IsNormalToTheKolmogorovSmirnovTest) {
  SampleStream stream(3, 4);
  std::vector<double> x(100000);
  for (double& value : x) value = stream.normal();
  std::sort(x.begin(), x.end());
  double worst = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double expected = 0.5 * std::erfc(-x[k] / std::sqrt(2.0));
    worst = std::max(worst, std::abs(expected - static_cast<double>(k) / static_cast<double>(x.size())));
  }
  EXPECT_LT(worst, 1.95 / std::sqrt(static_cast<double>(x.size()))) << "0.1 % level, seed 3";
}

}  // namespace philox_test
}  // namespace hinge
