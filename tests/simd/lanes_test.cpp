// SPDX-License-Identifier: BSD-3-Clause
// Operations on lanes against the same operations on scalars.
#include "hinge/detail/simd/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/simd/gather_bits.hpp"
#include "hinge/detail/simd/sincos.hpp"

namespace hinge::detail::simd {
namespace lanes_test {

using test::Random;

TEST(Lanes, DoWhatScalarsDo) {
  Random random(1);
  std::array<float, width> a, b, c;
  for (int round = 0; round < 200; ++round) {
    for (std::size_t k = 0; k < width; ++k) {
      a[k] = static_cast<float>(random.uniform(-2.0, 2.0));
      b[k] = random.one_in(3) ? a[k] : static_cast<float>(random.uniform(-2.0, 2.0));
    }
    const Float16 x(a.data()), y(b.data());
    const auto expect = [&](const Float16& result, auto one) {
      result.store(c.data());
      for (std::size_t k = 0; k < width; ++k)
        EXPECT_EQ(std::bit_cast<std::uint32_t>(c[k]), std::bit_cast<std::uint32_t>(one(a[k], b[k])));
    };
    expect(x + y, [](float p, float q) { return p + q; });
    expect(x - y, [](float p, float q) { return p - q; });
    expect(x * y, [](float p, float q) { return p * q; });
    expect(min(x, y), [](float p, float q) { return p < q ? p : q; });
    expect(max(x, y), [](float p, float q) { return p > q ? p : q; });
    expect(abs(x), [](float p, float) { return std::abs(p); });
    expect(choose_less(x, y, x * y, x + y), [](float p, float q) { return p < q ? p * q : p + q; });
    Bits less_bits = 0, less_equal_bits = 0;
    for (std::size_t k = 0; k < width; ++k) {
      less_bits |= static_cast<Bits>(a[k] < b[k]) << k;
      less_equal_bits |= static_cast<Bits>(a[k] <= b[k]) << k;
    }
    EXPECT_EQ(less(x, y), less_bits);
    EXPECT_EQ(less_equal(x, y), less_equal_bits);
    EXPECT_EQ(smallest(x), *std::min_element(a.begin(), a.end()));
    EXPECT_EQ(largest(x), *std::max_element(a.begin(), a.end()));
  }
}

TEST(Lanes, CallNothingLessThanNan) {
  const Float16 nan(std::numeric_limits<float>::quiet_NaN()), one(1.0F);
  EXPECT_EQ(less(nan, one) | less(one, nan) | less_equal(nan, nan), 0U);
}

TEST(Lanes, RoundDoublesAsACastDoes) {
  const Double4 x = Double4::of(0.1, -1e300, 1.0 + 0x1p-24, 3e-46);
  std::array<double, 4> d;
  std::array<float, 4> f;
  x.store(d.data());
  x.store_rounded(f.data());
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(f[k], static_cast<float>(d[k]));
}

TEST(AppendLanes, ListsTheSetBits) {
  std::array<std::uint32_t, width> found, values;
  for (std::uint32_t k = 0; k < width; ++k) values[k] = 1000 + k;
  for (Bits mask = 0; mask <= all_bits; mask += mask < 300 ? 1 : 97) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t k = 0; k < width; ++k)
      if ((mask >> k & 1U) != 0) expected.push_back(1000 + k);
    const std::size_t n = append_lanes(mask, 1000, found.data());
    EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(n)), expected);
    found.fill(0);
    EXPECT_EQ(append_chosen(mask, values.data(), found.data()), n);
    EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(n)), expected);
  }
}

TEST(LookUp, TakesEveryLaneFromItsPlace) {
  Random random(2);
  std::array<float, width> table, found;
  std::array<std::uint8_t, width> index;
  for (std::size_t k = 0; k < width; ++k) table[k] = static_cast<float>(k) * 1.5F;
  for (int round = 0; round < 50; ++round) {
    for (auto& i : index) i = static_cast<std::uint8_t>(random.below(width));
    look_up(table.data(), Index16(index.data())).store(found.data());
    for (std::size_t k = 0; k < width; ++k) EXPECT_EQ(found[k], table[index[k]]);
  }
}

TEST(VectorSinCos, HasTheBitsOfTheScalarOne) {
  Random random(3);
  std::array<double, 8> x, s, c;
  for (int round = 0; round < 20000; ++round) {
    const double range = round % 3 == 0 ? 1e-3 : round % 3 == 1 ? 7.0 : 0x1p20;
    for (double& value : x) value = random.one_in(20) ? 0.0 : random.uniform(-range, range);
    Double8 sine, cosine;
    sincos(Double8(x.data()), sine, cosine);
    sine.store(s.data());
    cosine.store(c.data());
    for (std::size_t k = 0; k < 8; ++k) {
      const SinCos expected = hinge::detail::sincos(x[k]);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(s[k]), std::bit_cast<std::uint64_t>(expected.sin)) << x[k];
      ASSERT_EQ(std::bit_cast<std::uint64_t>(c[k]), std::bit_cast<std::uint64_t>(expected.cos)) << x[k];
    }
  }
}

/// On every instruction set, also for types that ask for a whole cache line.
TEST(AlignedVector, StartsAtACacheLine) {
  struct alignas(64) Line {
    std::array<float, 16> numbers;
  };
  AlignedVector<Line> lines;
  for (std::size_t n = 1; n <= 1000; ++n) {
    const AlignedVector<float> floats(n);
    lines.resize(n);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(floats.data()) % 64, 0U);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(lines.data()) % 64, 0U);
  }
}

}  // namespace lanes_test
}  // namespace hinge::detail::simd
