// SPDX-License-Identifier: BSD-3-Clause
// Fills arrays with the numbers of a SampleStream, eight at a time. The bits are those of its own functions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

#include "hinge/core/philox.hpp"
#include "hinge/detail/core/elementary.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/detail/simd/sincos.hpp"

namespace hinge::detail::simd {

/// Computes both halves of the next eight blocks of the stream.
[[gnu::always_inline]] inline void peek_blocks(const SampleStream& stream, Integer8& first, Integer8& second) noexcept {
  const std::array<std::uint32_t, 4> counter = stream.counter();
  const std::uint64_t b = counter[0];
  Integer8 c0 = Integer8::of(b, b + 1, b + 2, b + 3, b + 4, b + 5, b + 6, b + 7), c1(counter[1]), c2(counter[2]),
           c3(counter[3]);
  philox_rounds(c0, c1, c2, c3, stream.key());
  const Integer8 low(0xffff'ffff);
  first = (c0 << 32) | (c1 & low);
  second = (c2 << 32) | (c3 & low);
}

/// Converts integers below 2^52, exactly. No instruction set before AVX-512 converts 64-bit integers, so each becomes
/// the mantissa of a double from 2^52 on.
[[gnu::always_inline]] inline Double8 as_double(const Integer8& integer) noexcept {
  constexpr std::uint64_t bits_of_two_52 = 0x4330'0000'0000'0000;
  return (integer | Integer8(bits_of_two_52)).bits_as<double>() - Double8(0x1p52);
}

/// The same as SampleStream::uniform() of these bits: the upper 53 of them, in two parts. All operations are exact.
[[gnu::always_inline]] inline Double8 uniform_of(const Integer8& bits) noexcept {
  const Double8 high = as_double(bits >> 32), low = as_double((bits >> 11) & Integer8(0x1f'ffff));
  return (high * Double8(0x1p21) + low) * Double8(0x1p-53);
}

/// The same as detail::log per lane.
[[gnu::always_inline]] inline Double8 log(const Double8& x) noexcept {
  const Integer8 bits = x.bits_as<std::uint64_t>();
  const Double8 m = ((bits & Integer8(mantissa_bits)) | Integer8(exponent_of_one)).bits_as<double>(), root(root_of_two);
  const Double8 exponent = as_double(bits >> 52) - Double8(1023.0);
  return log_of_parts(choose_less(root, m, m * Double8(0.5), m),
                      choose_less(root, m, exponent + Double8(1.0), exponent));
}

/// The same as SampleStream::normal() of the bits of a block.
[[gnu::always_inline]] inline Double8 normal_of(const Integer8& first, const Integer8& second) noexcept {
  const Double8 radius = sqrt(Double8(-2.0) * log(Double8(1.0) - uniform_of(first)));
  Double8 sine, cosine;
  sincos(Double8(2.0 * std::numbers::pi) * uniform_of(second), sine, cosine);
  return radius * cosine;
}

/// Fills `out` with the values that calls of stream.normal() return, one after another.
inline void fill_normal(SampleStream& stream, std::span<double> out) noexcept {
  Integer8 first, second;
  std::array<double, 8> values;
  while (!out.empty() && stream.begins_block()) {
    peek_blocks(stream, first, second);
    normal_of(first, second).store(values.data());
    const std::size_t count = std::min(out.size(), values.size());
    std::copy_n(values.begin(), count, out.begin());
    stream.skip_blocks(count);
    out = out.subspan(count);
  }
  for (double& value : out) value = stream.normal();
}

/// Fills `out` with the values that calls of stream.uniform() return, one after another.
inline void fill_uniform(SampleStream& stream, std::span<double> out) noexcept {
  if (!out.empty() && !stream.begins_block()) {
    out.front() = stream.uniform();
    out = out.subspan(1);
  }
  Integer8 first, second;
  std::array<double, 8> even, odd;
  while (out.size() >= 2) {
    peek_blocks(stream, first, second);
    uniform_of(first).store(even.data());
    uniform_of(second).store(odd.data());
    const std::size_t blocks = std::min(out.size() / 2, even.size());
    for (std::size_t k = 0; k < blocks; ++k) {
      out[2 * k] = even[k];
      out[2 * k + 1] = odd[k];
    }
    stream.skip_blocks(blocks);
    out = out.subspan(2 * blocks);
  }
  for (double& value : out) value = stream.uniform();
}

}  // namespace hinge::detail::simd
