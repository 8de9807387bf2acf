// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a SampleStream drawn eight at a time against the same numbers drawn one by one.
#include "hinge/detail/simd/fill_random.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace hinge::detail::simd {
namespace fill_random_test {

/// Expects the same bits from one call of `fill` for an array of `count` numbers as from `count` calls of `draw`, after
/// `before` other numbers of the stream, and the same next number.
template <class Fill, class Draw>
void expect_same_bits(SampleStream stream, std::size_t before, std::size_t count, const Fill& fill, const Draw& draw) {
  SampleStream other = stream;
  for (std::size_t k = 0; k < before; ++k) ASSERT_EQ(stream.bits(), other.bits());
  std::vector<double> values(count);
  fill(stream, values);
  for (const double value : values)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(draw(other)))
        << count << " numbers after " << before;
  EXPECT_EQ(stream.bits(), other.bits()) << count << " numbers after " << before;
}

void expect_same_bits(const SampleStream& stream, std::size_t before, std::size_t count) {
  expect_same_bits(stream, before, count, fill_normal, [](SampleStream& s) { return s.normal(); });
  expect_same_bits(stream, before, count, fill_uniform, [](SampleStream& s) { return s.uniform(); });
}

TEST(FillRandom, HasTheBitsOfSingleNumbers) {
  for (std::size_t before = 0; before < 4; ++before)
    for (std::size_t count = 0; count < 50; ++count) expect_same_bits({2005, count, 3}, before, count);
  constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
  expect_same_bits({largest, largest, std::numeric_limits<std::uint32_t>::max()}, 0, 100'000);
}

TEST(FillRandom, CountsBlocksBeyondTheLargestNumber) {
  SampleStream stream(1, 2);
  stream.skip_blocks(std::numeric_limits<std::uint32_t>::max() - 2);
  expect_same_bits(stream, 0, 40);
}

/// Expects the values of the scalar functions for words that hold the extremes of both numbers.
TEST(FillRandom, HandlesExtremeBits) {
  constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t words[] = {0,           1U << 11,  all,  all - (1U << 11), std::uint64_t{1} << 63,
                                 0xffff'ffff, all << 32, 12345};
  const Integer8 first(words);
  double uniform[8], logs[8];
  uniform_of(first).store(uniform);
  log(Double8(1.0) - uniform_of(first)).store(logs);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(uniform[k], static_cast<double>(words[k] >> 11) * 0x1p-53) << words[k];
    EXPECT_EQ(logs[k], detail::log(1.0 - uniform[k])) << words[k];
  }
}

}  // namespace fill_random_test
}  // namespace hinge::detail::simd
