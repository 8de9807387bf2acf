// SPDX-License-Identifier: BSD-3-Clause
// Packs coordinates as GROMACS' XTC files do; the reverse of unpack_xtc(), written from the same description. Every
// choice of runs and ranges gives a valid file, so this one keeps the rules simple.
#include "io/pack_xtc.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "io/xtc_ranges.hpp"

namespace hinge::molecular {

namespace {

using Cell = std::array<std::int64_t, 3>;  // grid steps

constexpr double steps_per_nanometre = 1000.0;
constexpr std::size_t most_plain = 9;  // frames of so few atoms are plain floats
constexpr unsigned longest_run = 8;    // small atoms after a large one

/// Appends a number with the most significant byte first.
template <class Number>
void put_big_endian(std::string& bytes, Number number) {
  auto own = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if constexpr (std::endian::native == std::endian::little) std::ranges::reverse(own);
  bytes.append(own.data(), own.size());
}

/// Writes bits, the most significant one of each byte first.
class BitWriter {
 public:
  /// Appends the lowest `count` bits of the value; at most 32.
  void number(unsigned count, std::uint64_t value) {
    for (unsigned k = count; k-- > 0;) {
      if (free_ == 0) {
        bytes_ += '\0';
        free_ = 8;
      }
      --free_;
      if ((value >> k & 1U) != 0) bytes_.back() = static_cast<char>(bytes_.back() | 1 << free_);
    }
  }
  /// Appends the lowest `count` bits, least significant byte first; the last byte may be partial.
  void bytes(unsigned count, UInt128 value) {
    for (; count > 8; count -= 8, value >>= 8) number(8, static_cast<std::uint64_t>(value & 0xff));
    number(count, static_cast<std::uint64_t>(value & 0xff));
  }
  const std::string& text() const { return bytes_; }

 private:
  std::string bytes_;
  unsigned free_ = 0;  // bits of the last byte
};

/// Returns the coordinates in grid steps.
std::vector<Cell> on_grid(std::span<const Vec3> positions) {
  std::vector<Cell> cells;
  cells.reserve(positions.size());
  for (const Vec3& x : positions) {
    Cell& cell = cells.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const double coordinate = x[static_cast<Eigen::Index>(k)];
      const double steps = std::round(coordinate / 10.0 * steps_per_nanometre);
      constexpr double most = 1 << 30;  // so that the range of an axis fits 32 bits
      if (!(std::abs(steps) < most))
        throw ModelError("a coordinate of " + number_text(coordinate) + " angstrom does not fit an XTC file");
      cell[k] = static_cast<std::int64_t>(steps);
    }
  }
  return cells;
}

/// Returns the largest difference of two cells along an axis.
std::uint64_t distance(const Cell& a, const Cell& b) {
  std::uint64_t most = 0;
  for (std::size_t k = 0; k < 3; ++k)
    most = std::max<std::uint64_t>(most, static_cast<std::uint64_t>(std::abs(a[k] - b[k])));
  return most;
}

std::uint64_t half(std::int32_t range) { return small_ranges[static_cast<std::size_t>(range)] / 2; }

/// Returns the first small range whose half is above the distance of every second pair of neighbours.
std::int32_t usual_range(const std::vector<Cell>& cells) {
  std::vector<std::uint64_t> distances;
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) distances.push_back(distance(cells[i], cells[i + 1]));
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  std::int32_t range = first_range;
  while (range + 1 < static_cast<std::int32_t>(small_ranges.size()) && half(range) <= *middle) ++range;
  return range;
}

/// Packs the cells after their smallest values. sizes: of the axes. range: of all small atoms.
std::string packed(const std::vector<Cell>& cells, const Cell& least, const std::array<std::uint64_t, 3>& sizes,
                   std::int32_t range) {
  const bool together = *std::ranges::max_element(sizes) <= largest_together;
  const unsigned together_bits = bits_of(UInt128{sizes[0]} * sizes[1] * (together ? sizes[2] : 1));
  BitWriter bits;
  const auto put_large = [&](const Cell& cell) {
    std::array<std::uint64_t, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = static_cast<std::uint64_t>(cell[k] - least[k]);
    if (together)
      bits.bytes(together_bits, (UInt128{at[0]} * sizes[1] + at[1]) * sizes[2] + at[2]);
    else
      for (std::size_t k = 0; k < 3; ++k) bits.number(static_cast<unsigned>(std::bit_width(sizes[k])), at[k]);
  };
  const std::uint64_t size = small_ranges[static_cast<std::size_t>(range)];
  const auto put_small = [&](const Cell& cell, const Cell& last) {
    UInt128 value = 0;
    for (std::size_t k = 0; k < 3; ++k)
      value = value * size + static_cast<std::uint64_t>(cell[k] - last[k] + static_cast<std::int64_t>(half(range)));
    bits.bytes(static_cast<unsigned>(range), value);
  };
  unsigned previous = 0;  // length of the last run; readers start with 0
  for (std::size_t i = 0; i < cells.size();) {
    unsigned run = 0;
    while (run < longest_run && i + run + 1 < cells.size() &&
           distance(cells[i + run], cells[i + run + 1]) < half(range))
      ++run;
    // The first two atoms of a run are swapped, so the third must be near the first.
    if (run > 1 && distance(cells[i], cells[i + 2]) >= half(range)) run = 1;
    put_large(cells[run > 0 ? i + 1 : i]);
    bits.number(1, run != previous ? 1 : 0);
    constexpr unsigned same_range = 1;
    if (run != previous) bits.number(5, 3 * run + same_range);
    previous = run;
    if (run > 0) put_small(cells[i], cells[i + 1]);
    for (unsigned k = 2; k <= run; ++k) put_small(cells[i + k], cells[k == 2 ? i : i + k - 1]);
    i += run + 1;
  }
  return bits.text();
}

}  // namespace

std::string xtc_frame(std::span<const Vec3> positions, std::size_t number) {
  constexpr std::int32_t magic = 1995;
  constexpr std::size_t most_atoms = 298261617;  // larger systems have another format
  if (positions.size() > most_atoms) throw ModelError("an XTC file holds at most 298261617 atoms");
  const auto atoms = static_cast<std::int32_t>(positions.size());
  std::string frame;
  put_big_endian(frame, magic);
  put_big_endian(frame, atoms);
  put_big_endian(frame, static_cast<std::int32_t>(number));
  put_big_endian(frame, static_cast<float>(number));
  for (int k = 0; k < 9; ++k) put_big_endian(frame, 0.0F);  // the unit cell
  put_big_endian(frame, atoms);
  const std::vector<Cell> cells = on_grid(positions);
  if (positions.size() <= most_plain) {
    for (const Vec3& x : positions)
      for (const double c : {x[0], x[1], x[2]}) put_big_endian(frame, static_cast<float>(c / 10.0));
    return frame;
  }
  Cell least = cells.front(), most = cells.front();
  std::array<std::uint64_t, 3> sizes{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Cell& cell : cells) {
      least[k] = std::min(least[k], cell[k]);
      most[k] = std::max(most[k], cell[k]);
    }
    sizes[k] = static_cast<std::uint64_t>(most[k] - least[k]) + 1;
  }
  const std::int32_t range = usual_range(cells);
  const std::string bits = packed(cells, least, sizes, range);
  put_big_endian(frame, static_cast<float>(steps_per_nanometre));
  for (const std::int64_t c : least) put_big_endian(frame, static_cast<std::int32_t>(c));
  for (const std::int64_t c : most) put_big_endian(frame, static_cast<std::int32_t>(c));
  put_big_endian(frame, range);
  put_big_endian(frame, static_cast<std::int32_t>(bits.size()));
  frame += bits;
  frame.resize((frame.size() + 3) / 4 * 4);
  return frame;
}

}  // namespace hinge::molecular
