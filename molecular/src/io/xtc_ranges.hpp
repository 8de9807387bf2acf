// SPDX-License-Identifier: BSD-3-Clause
// Numbers that the reader and the writer of XTC coordinates share.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace hinge::molecular {

__extension__ using UInt128 = unsigned __int128;

/// Small ranges by number: about the cube root of 2^number, so that three values take that many bits.
inline constexpr std::array<std::uint32_t, 73> small_ranges = {
    0,       0,       0,       0,       0,        0,        0,       0,       0,       8,       10,
    12,      16,      20,      25,      32,       40,       50,      64,      80,      101,     128,
    161,     203,     256,     322,     406,      512,      645,     812,     1024,    1290,    1625,
    2048,    2580,    3250,    4096,    5060,     6501,     8192,    10321,   13003,   16384,   20642,
    26007,   32768,   41285,   52015,   65536,    82570,    104031,  131072,  165140,  208063,  262144,
    330280,  416127,  524287,  660561,  832255,   1048576,  1321122, 1664510, 2097152, 2642245, 3329021,
    4194304, 5284491, 6658042, 8388607, 10568983, 13316085, 16777216};
inline constexpr std::int32_t first_range = 9;
/// Axes with larger ranges are packed separately.
inline constexpr std::uint64_t largest_together = 0xffffff;

/// Returns the number of bits of the value; 0 for 0.
inline unsigned bits_of(UInt128 value) noexcept {
  const auto high = static_cast<std::uint64_t>(value >> 64);
  return static_cast<unsigned>(high != 0 ? 64 + std::bit_width(high)
                                         : std::bit_width(static_cast<std::uint64_t>(value)));
}

}  // namespace hinge::molecular
