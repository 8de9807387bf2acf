// SPDX-License-Identifier: BSD-3-Clause
// Bytes: reads numbers and choices from a fuzzer's input; after its end all bytes are 0.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace fuzz {

/// Independent of the standard library, so that a stored find has the same meaning with every compiler.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

  bool empty() const noexcept { return rest_.empty(); }
  std::uint8_t byte() noexcept {
    if (rest_.empty()) return 0;
    const std::uint8_t first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }
  bool bit() noexcept { return (byte() & 1U) != 0; }
  /// 0 ... n - 1; n: 1 ... 256.
  std::size_t below(std::size_t n) noexcept { return byte() % n; }
  /// Returns true with probability 1 / n.
  bool one_in(std::size_t n) noexcept { return below(n) == n - 1; }
  std::int16_t int16() noexcept {
    const unsigned low = byte();
    return static_cast<std::int16_t>(low | static_cast<unsigned>(byte()) << 8U);
  }
  std::uint64_t word() noexcept {
    std::uint64_t bits = 0;
    for (unsigned k = 0; k < 8; ++k) bits |= std::uint64_t{byte()} << 8 * k;
    return bits;
  }
  /// Returns any bit pattern, including NaN, infinities and denormals.
  double any_double() noexcept { return std::bit_cast<double>(word()); }
  /// Returns the rest of the input.
  std::string_view text() noexcept {
    const auto all = rest_;
    rest_ = {};
    return {reinterpret_cast<const char*>(all.data()), all.size()};
  }

 private:
  std::span<const std::uint8_t> rest_;
};

}  // namespace fuzz
