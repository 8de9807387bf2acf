// SPDX-License-Identifier: BSD-3-Clause
// A counter-based random stream: sample `index` of a seed is the same in every thread, shard and run.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "hinge/detail/core/elementary.hpp"
#include "hinge/detail/core/sincos.hpp"

namespace hinge {

namespace detail {

/// Multiplies the lower halves of two integers.
[[gnu::always_inline]] inline std::uint64_t product_of_low(std::uint64_t a, std::uint64_t b) noexcept {
  return (a & 0xffff'ffffU) * (b & 0xffff'ffffU);
}

/// The ten rounds of Philox4x32-10. Word: std::uint64_t, or SIMD lanes of it. Only the lower half of each word counts.
template <class Word>
[[gnu::always_inline]] inline void philox_rounds(Word& c0, Word& c1, Word& c2, Word& c3,
                                                 std::array<std::uint32_t, 2> key) noexcept {
  for (int round = 0; round < 10; ++round) {
    const Word p0 = product_of_low(Word(0xD2511F53U), c0), p1 = product_of_low(Word(0xCD9E8D57U), c2);
    c0 = (p1 >> 32) ^ c1 ^ Word(key[0]);
    c1 = p1;
    c2 = (p0 >> 32) ^ c3 ^ Word(key[1]);
    c3 = p0;
    key = {key[0] + 0x9E3779B9U, key[1] + 0xBB67AE85U};
  }
}

}  // namespace detail

/// The Philox4x32-10 generator (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011).
/// Returns four random 32-bit words for one counter value.
inline std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                           std::array<std::uint32_t, 2> key) noexcept {
  std::uint64_t c0 = counter[0], c1 = counter[1], c2 = counter[2], c3 = counter[3];
  detail::philox_rounds(c0, c1, c2, c3, key);
  return {static_cast<std::uint32_t>(c0), static_cast<std::uint32_t>(c1), static_cast<std::uint32_t>(c2),
          static_cast<std::uint32_t>(c3)};
}

/// Random numbers of one sample. The sequence depends on (seed, index, stream) alone. Different streams of one sample
/// are independent, so one consumer's number of draws does not shift another's sequence. The code uses only + - * / and
/// sqrt, so the bits are the same on every CPU. Not thread-safe: use one object per thread.
class SampleStream {
 public:
  /// seed: the run. index: the sample. stream: an independent sequence within the sample.
  SampleStream(std::uint64_t seed, std::uint64_t index, std::uint32_t stream = 0) noexcept
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
        index_{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32)},
        stream_(stream) {}

  /// Returns the key of all blocks. A block is one answer of philox(): 128 bits, which bits() returns in two halves.
  std::array<std::uint32_t, 2> key() const noexcept { return key_; }
  /// Returns the counter of the next block. Counters of later blocks differ in the first word, which grows by one.
  std::array<std::uint32_t, 4> counter() const noexcept { return {block_, stream_, index_[0], index_[1]}; }
  /// Returns true if the next bits begin a block.
  bool begins_block() const noexcept { return used_ == 2; }
  /// Leaves out the rest of a block that was begun, and `count` blocks.
  void skip_blocks(std::size_t count) noexcept {
    used_ = 2;
    block_ += static_cast<std::uint32_t>(count);
  }

  /// Returns the next 64 random bits.
  std::uint64_t bits() noexcept {
    if (used_ == 2) {
      const auto words = philox(counter(), key_);
      ++block_;
      for (std::size_t k = 0; k < 2; ++k) ready_[k] = std::uint64_t{words[2 * k]} << 32 | words[2 * k + 1];
      used_ = 0;
    }
    return ready_[used_++];
  }

  /// Returns the next uniform value in [0, 1), with 53 random bits.
  double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Returns the next standard normal value (Box & Muller 1958). Its absolute value is below 8.6, because 1 - uniform()
  /// is at least 2^-53.
  double normal() noexcept {
    const double radius = std::sqrt(-2.0 * detail::log(1.0 - uniform()));
    return radius * detail::sincos(2.0 * std::numbers::pi * uniform()).cos;
  }

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 2> index_;
  std::uint32_t stream_;
  std::array<std::uint64_t, 2> ready_{};
  std::size_t used_ = 2;
  std::uint32_t block_ = 0;
};

}  // namespace hinge
