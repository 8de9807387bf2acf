// SPDX-License-Identifier: BSD-3-Clause
// Unpacks the coordinates of GROMACS' XTC files (F. van Hoesel's xdr3dfcoord; GROMACS manual, "xtc"); written from its
// description. Coordinates are integers. An atom is packed in the range of all atoms; up to ten atoms after it are
// packed as small differences from their predecessor.
#include "io/xtc_coordinates.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "hinge/core/error.hpp"
#include "io/xtc_ranges.hpp"

namespace hinge::molecular {

namespace {

/// Reads bits, from the most significant one of each byte.
class BitReader {
 public:
  explicit BitReader(std::span<const char> bits) : bits_(bits), end_(8 * (bits.size() - xtc_padding)) {}

  /// Returns the next `count` bits as a number; at most 32.
  std::uint32_t number(unsigned count) noexcept {
    const std::uint64_t value = count == 0 ? 0 : window() >> (64 - count);
    position_ += count;
    return static_cast<std::uint32_t>(value);
  }

  /// Returns the next `count` bits (at most 72) as a number, least significant byte first; the last byte may be
  /// partial.
  UInt128 bytes(unsigned count) noexcept {
    if (count > 64) {
      const UInt128 low = bytes(64);
      return low | UInt128{number(count - 64)} << 64;
    }
    const std::uint64_t read = window();
    position_ += count;
    const unsigned whole = count / 8 * 8;
    const std::uint64_t part = count == whole ? 0 : read << whole >> (64 - count + whole);
    const std::uint64_t low = whole == 0 ? 0 : __builtin_bswap64(read) << (64 - whole) >> (64 - whole);
    return whole == 64 ? low : low | part << whole;
  }

  /// True if bits after the end were read.
  bool overrun() const noexcept { return position_ > end_; }

 private:
  /// Returns the next 64 bits without consuming them.
  std::uint64_t window() const noexcept {
    // A read after the end returns the last words again; overrun() reports it later.
    const std::size_t byte = std::min(position_ / 8, bits_.size() - 9);
    const unsigned shift = position_ % 8;
    std::uint64_t word = 0;
    std::memcpy(&word, bits_.data() + byte, 8);
    if constexpr (std::endian::native == std::endian::little) word = __builtin_bswap64(word);
    const auto next = static_cast<unsigned char>(bits_[byte + 8]);
    return shift == 0 ? word : word << shift | std::uint64_t{next} >> (8 - shift);
  }

  std::span<const char> bits_;
  std::size_t end_;
  std::size_t position_ = 0;
};

using Steps = std::array<std::int64_t, 3>;

/// Unpacks three numbers, each below its size, from one number in mixed radix.
Steps unpack(BitReader& bits, unsigned count, const std::array<std::uint64_t, 3>& sizes) noexcept {
  const UInt128 packed = bits.bytes(count);
  Steps cell{};
  if (count <= 64) {
    auto value = static_cast<std::uint64_t>(packed);
    cell[2] = static_cast<std::int64_t>(value % sizes[2]);
    value /= sizes[2];
    cell[1] = static_cast<std::int64_t>(value % sizes[1]);
    cell[0] = static_cast<std::int64_t>(value / sizes[1] & 0xffffffff);
  } else {
    cell[2] = static_cast<std::int64_t>(packed % sizes[2]);
    cell[1] = static_cast<std::int64_t>(packed / sizes[2] % sizes[1]);
    cell[0] = static_cast<std::int64_t>(packed / sizes[2] / sizes[1] & 0xffffffff);
  }
  return cell;
}

Steps operator+(const Steps& a, const Steps& b) noexcept { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

}  // namespace

std::vector<Vec3> unpack_xtc(const XtcBlock& block, std::span<const char> bits, std::size_t atoms,
                             const std::string& what) {
  const auto refuse = [&](const std::string& why) { throw LoadError(what + ": " + why); };
  std::array<std::uint64_t, 3> sizes{};
  Steps least{};
  for (std::size_t k = 0; k < 3; ++k) {
    least[k] = block.least[k];
    if (block.most[k] < block.least[k]) refuse("the largest coordinate is below the smallest");
    sizes[k] = static_cast<std::uint64_t>(block.most[k] - least[k]) + 1;
    if (sizes[k] >> 32 != 0) refuse("coordinates take more than 32 bits");
  }
  const bool together = *std::max_element(sizes.begin(), sizes.end()) <= largest_together;
  const unsigned together_bits = bits_of(UInt128{sizes[0]} * sizes[1] * (together ? sizes[2] : 1));
  std::int32_t small = block.small;
  const auto check_small = [&] {
    if (small < first_range || small >= static_cast<std::int32_t>(small_ranges.size()))
      refuse("small range number " + std::to_string(small) + ", expected " + std::to_string(first_range) + " to " +
             std::to_string(small_ranges.size() - 1));
  };
  check_small();

  std::vector<Vec3> positions;
  positions.reserve(atoms);
  const auto put = [&](const Steps& cell) {
    const auto angstrom = [&](std::int64_t c) { return static_cast<double>(c) * 10.0 / block.per_nanometre; };
    positions.emplace_back(angstrom(cell[0]), angstrom(cell[1]), angstrom(cell[2]));
  };
  BitReader reader(bits);
  unsigned run = 0;  // number of small atoms that follow; unchanged if the flag bit is 0
  while (positions.size() < atoms) {
    Steps large{};
    if (together)
      large = unpack(reader, together_bits, sizes);
    else
      for (std::size_t k = 0; k < 3; ++k) large[k] = reader.number(static_cast<unsigned>(std::bit_width(sizes[k])));
    large = large + least;
    std::int32_t change = 0;  // of the number of the small range
    if (reader.number(1) != 0) {
      const std::uint32_t said = reader.number(5);
      run = said / 3;
      change = static_cast<std::int32_t>(said % 3) - 1;
    }
    if (positions.size() + 1 + run > atoms) refuse("the coordinates hold more atoms than the header says");
    const auto size = small_ranges[static_cast<std::size_t>(small)];
    const Steps half = {-std::int64_t{size / 2}, -std::int64_t{size / 2}, -std::int64_t{size / 2}};
    Steps last = large;
    for (unsigned k = 0; k < run; ++k) {
      last = unpack(reader, static_cast<unsigned>(small), {size, size, size}) + last + half;
      put(last);
      if (k == 0) put(large);  // the first two are swapped: a water's oxygen, stored second, is near both hydrogens
    }
    if (run == 0) put(large);
    if (reader.overrun()) refuse("the coordinates need more bytes than the header says");
    if (change != 0) {
      small += change;
      check_small();
    }
  }
  return positions;
}

}  // namespace hinge::molecular
