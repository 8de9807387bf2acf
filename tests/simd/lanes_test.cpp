// SPDX-License-Identifier: BSD-3-Clause
// Operations on lanes against the same operations on scalars.
#include "hinge/detail/simd/lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/simd/gather_bits.hpp"
#include "hinge/detail/simd/sincos.hpp"

namespace hinge::detail::simd {
namespace lanes_test {

using test::Random;

template <class T, std::size_t N>
struct Shape {
  using Number = T;
  static constexpr std::size_t size = N;
};
template <class OfShape>
class LanesOf : public testing::Test {};
using Shapes = testing::Types<Shape<float, 4>, Shape<float, 16>, Shape<double, 4>, Shape<double, 8>>;
TYPED_TEST_SUITE(LanesOf, Shapes);

/// Zeros of both signs, infinities, NaN, the largest and smallest numbers, and ordinary ones.
template <class T>
std::vector<T> special_values() {
  using Limits = std::numeric_limits<T>;
  const T infinity = Limits::infinity(), most = Limits::max(), least = Limits::denorm_min();
  std::vector<T> values = {T{0}, -T{0}, T{1}, -T{1}, infinity, -infinity, Limits::quiet_NaN(), most, -most};
  values.insert(values.end(), {Limits::min(), least, -least});
  Random random(1);
  for (int k = 0; k < 11; ++k) values.push_back(static_cast<T>(random.uniform(-2.0, 2.0)));
  return values;
}

template <class T>
auto bits_of(T x) {
  return std::bit_cast<std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>(x);
}

/// Every pair of special values in every lane, with the bits of scalar code.
TYPED_TEST(LanesOf, DoWhatScalarsDo) {
  using T = typename TypeParam::Number;
  constexpr std::size_t n = TypeParam::size;
  using L = Lanes<T, n>;
  const std::vector<T> values = special_values<T>();
  std::array<T, n> a, b, c;
  for (std::size_t shift = 0; shift < values.size() * values.size(); ++shift) {
    for (std::size_t k = 0; k < n; ++k) {
      a[k] = values[(shift + k) % values.size()];
      b[k] = values[(shift / values.size() + 5 * k) % values.size()];
    }
    const L x(a.data()), y(b.data());
    const auto expect = [&](const L& result, auto one) {
      result.store(c.data());
      for (std::size_t k = 0; k < n; ++k) {
        const T expected = one(a[k], b[k]);
        if (std::isnan(expected))
          EXPECT_TRUE(std::isnan(c[k])) << a[k] << ' ' << b[k];
        else
          EXPECT_EQ(bits_of(c[k]), bits_of(expected)) << a[k] << ' ' << b[k];
      }
    };
    expect(x + y, [](T p, T q) { return p + q; });
    expect(x - y, [](T p, T q) { return p - q; });
    expect(x * y, [](T p, T q) { return p * q; });
    expect(x / y, [](T p, T q) { return p / q; });
    expect(-x, [](T p, T) { return -p; });
    expect(min(x, y), [](T p, T q) { return p < q ? p : q; });
    expect(max(x, y), [](T p, T q) { return p > q ? p : q; });
    expect(abs(x), [](T p, T) { return std::abs(p); });
    expect(choose_less(x, y, x, -y), [](T p, T q) { return p < q ? p : -q; });
    expect(L(a[0]), [&](T, T) { return a[0]; });
    Bits less_bits = 0, less_equal_bits = 0;
    for (std::size_t k = 0; k < n; ++k) {
      less_bits |= static_cast<Bits>(a[k] < b[k]) << k;
      less_equal_bits |= static_cast<Bits>(a[k] <= b[k]) << k;
    }
    EXPECT_EQ(Bits{less(x, y)}, less_bits);
    EXPECT_EQ(Bits{less_equal(x, y)}, less_equal_bits);
    // Not less(x, y) & less_equal(x, y): g++ 12 then gives less(x, y) for less_equal(x, y) too, as it does for the
    // vectors of std::experimental::simd.
    EXPECT_EQ(Bits{less(x, y) | less_equal(x, x)}, Bits{less_equal(x, x)} | less_bits);
    EXPECT_EQ(Bits{less(x, y) & less(y, L(T{1}))}, less_bits & Bits{less(y, L(T{1}))});
  }
}

/// The extreme number is in each lane once.
TYPED_TEST(LanesOf, FindTheSmallestAndTheLargest) {
  using T = typename TypeParam::Number;
  constexpr std::size_t n = TypeParam::size;
  for (std::size_t k = 0; k < n; ++k) {
    std::array<T, n> a{};
    a[k] = T{-3};
    EXPECT_EQ(smallest(Lanes<T, n>(a.data())), T{-3});
    EXPECT_EQ(largest(Lanes<T, n>(a.data())), T{0});
    a[k] = T{3};
    EXPECT_EQ(smallest(Lanes<T, n>(a.data())), T{0});
    EXPECT_EQ(largest(Lanes<T, n>(a.data())), T{3});
  }
}

TYPED_TEST(LanesOf, StoreARangeOnly) {
  using T = typename TypeParam::Number;
  constexpr std::size_t n = TypeParam::size;
  std::array<T, n> from, to;
  for (std::size_t k = 0; k < n; ++k) from[k] = static_cast<T>(k) + T{0.5};
  for (std::size_t first = 0; first <= n; ++first)
    for (std::size_t last = first; last <= n; ++last) {
      to.fill(T{-1});
      Lanes<T, n>(from.data()).store_lanes(first, last, to.data());
      for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(to[k], first <= k && k < last ? from[k] : T{-1});
    }
}

TEST(Lanes, CompareIntegersWithoutSign) {
  constexpr std::uint32_t top = std::numeric_limits<std::uint32_t>::max();
  using L = Lanes<std::uint32_t, width>;
  std::array<std::uint32_t, width> a{0, 1, 2, top, top - 1, 0x80000000U, 0x7fffffffU, 5};
  for (const std::uint32_t limit : {0U, 1U, 5U, 0x7fffffffU, 0x80000000U, top}) {
    Bits less_bits = 0, less_equal_bits = 0;
    for (std::size_t k = 0; k < width; ++k) {
      less_bits |= static_cast<Bits>(a[k] < limit) << k;
      less_equal_bits |= static_cast<Bits>(limit <= a[k]) << k;
    }
    EXPECT_EQ(Bits{less(L(a.data()), L(limit))}, less_bits);
    EXPECT_EQ(Bits{less_equal(L(limit), L(a.data()))}, less_equal_bits);
  }
}

TEST(Lanes, RoundDoublesAsACastDoes) {
  const std::array<double, 8> d = {0.1, -1e300, 1.0 + 0x1p-24, 3e-46, -0.0, 1.0 + 0x1.8p-24, 0x1p-149, 7e-39};
  std::array<float, 8> f;
  Double8(d.data()).store_rounded(f.data());
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(bits_of(f[k]), bits_of(static_cast<float>(d[k])));
  std::array<double, 16> both;
  std::array<float, 16> g;
  for (std::size_t k = 0; k < 16; ++k) both[k] = k < 8 ? d[k] : 1.0 / static_cast<double>(k);
  Float16::rounded(Double8(both.data()), Double8(both.data() + 8)).store(g.data());
  for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(bits_of(g[k]), bits_of(static_cast<float>(both[k]))) << k;
  const Double4 x = Double4::of(0.1, -1e300, 1.0 + 0x1p-24, 3e-46);
  std::array<double, 4> e;
  x.store(e.data());
  x.store_rounded(f.data());
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(e[k], d[k]);
    EXPECT_EQ(f[k], static_cast<float>(d[k]));
  }
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
