// SPDX-License-Identifier: BSD-3-Clause
// Numbers: adversarial doubles: ties, neighbours of earlier numbers, lattice points, decimals, huge and tiny numbers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "fuzz/bytes.hpp"
#include "hinge/core/vec3.hpp"

namespace fuzz {

/// Generates finite numbers in the scale of one scene, with absolute values of at most `largest`.
class Numbers {
 public:
  /// Less than the limit of builders (hinge::largest_length), so that sums stay below it.
  static constexpr double largest = 0x1p990;

  explicit Numbers(Bytes& bytes) : bytes_(bytes) {
    // Usually an ordinary scale, sometimes one where squares overflow or underflow.
    constexpr std::array<int, 8> exponents{0, 0, 0, 0, -30, 40, 480, -520};
    unit_ = std::ldexp(1.0, exponents[bytes.below(exponents.size())]);
  }

  double number() {
    const double made = clamped(make());
    if (seen_.size() < 256) seen_.push_back(made);
    return made;
  }
  double positive() { return std::abs(number()); }
  hinge::Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  double unit() const noexcept { return unit_; }
  Bytes& bytes() noexcept { return bytes_; }

 private:
  static double clamped(double x) {
    if (!(std::abs(x) < std::numeric_limits<double>::infinity())) return 0.0;
    while (std::abs(x) > largest) x *= 0x1p-128;
    return x;
  }
  double make() {
    constexpr std::array<double, 12> special{0.0,     -0.0,    5e-324,  -5e-324,  0x1p-1022, 0x1p-537,
                                             0x1p511, 0x1p512, 0x1p513, 0x1p-512, 1.0 / 3.0, 0.1};
    switch (bytes_.below(10)) {
      case 0: return earlier();
      case 1: {
        double near = earlier();
        for (std::size_t k = 1 + bytes_.below(3); k-- > 0;) near = std::nextafter(near, 4.0 * near + unit_);
        return near;
      }
      case 2: {
        double near = earlier();
        for (std::size_t k = 1 + bytes_.below(3); k-- > 0;) near = std::nextafter(near, -4.0 * near - unit_);
        return near;
      }
      case 3: return unit_ * bytes_.int16() * 0x1p-8;
      case 4: return unit_ * (bytes_.int16() / 1000.0);
      case 5: return bytes_.any_double();
      case 6: return special[bytes_.below(special.size())];
      case 7: return earlier() + unit_ * static_cast<std::int8_t>(bytes_.byte());
      default: return unit_ * (static_cast<std::int8_t>(bytes_.byte()) % 16);
    }
  }
  double earlier() { return seen_.empty() ? 0.0 : seen_[bytes_.byte() % seen_.size()]; }

  Bytes& bytes_;
  double unit_ = 1.0;
  std::vector<double> seen_;
};

}  // namespace fuzz
