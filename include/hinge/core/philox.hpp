// SPDX-License-Identifier: BSD-3-Clause
// A counter-based random stream: sample `index` of a seed is the same in every thread, shard and run.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "hinge/detail/core/elementary.hpp"
#include "hinge/detail/core/sincos.hpp"

namespace hinge {

/// The Philox4x32-10 generator (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011).
/// Returns four random 32-bit words for one counter value.
inline std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                           std::array<std::uint32_t, 2> key) noexcept {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xD2511F53U} * counter[0];
    const std::uint64_t p1 = std::uint64_t{0xCD9E8D57U} * counter[2];
    counter = {static_cast<std::uint32_t>(p1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(p1),
               static_cast<std::uint32_t>(p0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(p0)};
    key = {key[0] + 0x9E3779B9U, key[1] + 0xBB67AE85U};
  }
  return counter;
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

  /// Returns the next 64 random bits.
  std::uint64_t bits() noexcept {
    if (used_ == 2) {
      const auto words = philox({block_++, stream_, index_[0], index_[1]}, key_);
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
    constexpr double two_pi = 6.283185307179586;
    const double radius = std::sqrt(-2.0 * detail::log(1.0 - uniform()));
    return radius * detail::sincos(two_pi * uniform()).cos;
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
