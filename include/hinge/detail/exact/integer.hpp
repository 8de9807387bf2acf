// SPDX-License-Identifier: BSD-3-Clause
// Integer: an integer of up to 12,800 bits on the stack. Finite doubles are integers times a power of two.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "hinge/detail/core/assert.hpp"
#include "hinge/detail/exact/error_free.hpp"

namespace hinge::detail::exact {

/// The number mantissa * 2^exponent, for magnitudes outside the range of doubles. |mantissa| is 0 or in [0.5, 1).
struct Scaled {
  double mantissa = 0.0;
  int exponent = 0;

  static Scaled of(double x) noexcept {
    Scaled s;
    s.mantissa = std::frexp(x, &s.exponent);
    return s;
  }
  /// Returns a / b, rounded once. b must not be 0.
  friend Scaled operator/(const Scaled& a, const Scaled& b) noexcept {
    Scaled s = of(a.mantissa / b.mantissa);
    s.exponent += a.exponent - b.exponent;
    return s;
  }
  /// Returns the square root of a number >= 0, rounded once.
  friend Scaled sqrt(const Scaled& a) noexcept {
    const int odd = a.exponent & 1;  // makes the exponent even, so that it can be halved
    return {std::sqrt(std::ldexp(a.mantissa, odd)), (a.exponent - odd) / 2};
  }
  /// Compares numbers >= 0.
  friend bool operator<(const Scaled& a, const Scaled& b) noexcept {
    if (a.mantissa == 0.0 || b.mantissa == 0.0 || a.exponent == b.exponent) return a.mantissa < b.mantissa;
    return a.exponent < b.exponent;
  }
  /// Returns the number times 2^shift as a double: rounded, and 0 or infinite outside the range of doubles.
  double value(int shift = 0) const noexcept { return std::ldexp(mantissa, exponent + shift); }
};

/// Returns the largest e for which the finite x is a multiple of 2^e, or `none` for x = 0.
inline int unit_exponent(double x, int none) noexcept {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t fraction = bits & 0xf'ffff'ffff'ffffULL;
  const auto biased = static_cast<int>((bits >> 52) & 0x7ffU);
  if (biased == 0) return fraction == 0 ? none : -1074 + std::countr_zero(fraction);
  return biased - 1075 + std::countr_zero(fraction | 0x10'0000'0000'0000ULL);
}

/// An exact integer as sign and magnitude; no operation rounds. The capacity suffices for sums of products of six
/// differences of doubles (each below 2^2100); callers need no more. Copies touch only the limbs in use.
class Integer {
 public:
  static constexpr std::size_t capacity = 200;  // limbs of 64 bits

  Integer() noexcept {}  // NOLINT(modernize-use-equals-default): = default would
                         // let {} clear all the limbs
  Integer(const Integer& other) noexcept { *this = other; }
  Integer& operator=(const Integer& other) noexcept {
    size_ = other.size_;
    negative_ = other.negative_;
    for (std::size_t k = 0; k < size_; ++k) limbs_[k] = other.limbs_[k];
    return *this;
  }

  /// Returns the finite x in units of 2^exponent. x must be a multiple of that unit.
  static Integer of(double x, int exponent) noexcept {
    Integer n;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const auto biased = static_cast<int>((bits >> 52) & 0x7ffU);
    std::uint64_t mantissa = bits & 0xf'ffff'ffff'ffffULL;
    if (biased != 0) mantissa |= 0x10'0000'0000'0000ULL;
    if (mantissa == 0) return n;
    const int zeros = std::countr_zero(mantissa), shift = std::max(biased, 1) - 1075 - exponent + zeros;
    HINGE_ASSERT(shift >= 0);
    mantissa >>= zeros;
    const std::size_t whole = static_cast<std::size_t>(shift) / 64;
    const int within = shift % 64;
    for (std::size_t k = 0; k < whole; ++k) n.limbs_[k] = 0;
    n.limbs_[whole] = mantissa << within;
    n.limbs_[whole + 1] = within == 0 ? 0 : mantissa >> (64 - within);
    n.size_ = whole + 2;
    n.negative_ = x < 0.0;
    n.trim();
    return n;
  }

  int sign() const noexcept { return size_ == 0 ? 0 : negative_ ? -1 : 1; }

  /// Returns the nearest Scaled value; its error is one rounding plus a relative 2^-63.
  Scaled scaled() const noexcept {
    if (size_ == 0) return {};
    const int zeros = std::countl_zero(limbs_[size_ - 1]);
    std::uint64_t top = limbs_[size_ - 1] << zeros;
    if (size_ > 1 && zeros > 0) top |= limbs_[size_ - 2] >> (64 - zeros);
    Scaled s = Scaled::of(static_cast<double>(top));
    s.exponent += 64 * static_cast<int>(size_ - 1) - zeros;
    if (negative_) s.mantissa = -s.mantissa;
    return s;
  }

  friend Integer operator-(Integer a) noexcept {
    a.negative_ = !a.negative_;
    return a;
  }
  friend Integer operator+(const Integer& a, const Integer& b) noexcept { return sum(a, b, b.negative_); }
  friend Integer operator-(const Integer& a, const Integer& b) noexcept { return sum(a, b, !b.negative_); }
  friend Integer operator*(const Integer& a, const Integer& b) noexcept {
    Integer n;
    if (a.size_ == 0 || b.size_ == 0) return n;
    HINGE_ASSERT(a.size_ + b.size_ <= capacity);
    n.size_ = a.size_ + b.size_;
    for (std::size_t k = 0; k < n.size_; ++k) n.limbs_[k] = 0;
    for (std::size_t i = 0; i < a.size_; ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < b.size_; ++j) {
        const Wide x = Wide{a.limbs_[i]} * b.limbs_[j] + n.limbs_[i + j] + carry;
        n.limbs_[i + j] = static_cast<std::uint64_t>(x);
        carry = static_cast<std::uint64_t>(x >> 64);
      }
      n.limbs_[i + b.size_] = carry;
    }
    n.negative_ = a.negative_ != b.negative_;
    n.trim();
    return n;
  }
  friend bool operator<(const Integer& a, const Integer& b) noexcept {
    if (a.sign() != b.sign()) return a.sign() < b.sign();
    const int order = compare_magnitudes(a, b);
    return a.negative_ ? order > 0 : order < 0;
  }
  friend bool operator<=(const Integer& a, const Integer& b) noexcept { return !(b < a); }
  /// Returns part / of, rounded. `of` must not be 0.
  friend double ratio(const Integer& part, const Integer& of) noexcept {
    return part.sign() == 0 ? 0.0 : (part.scaled() / of.scaled()).value();
  }

 private:
  __extension__ using Wide = unsigned __int128;

  void trim() noexcept {
    while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
  }

  static int compare_magnitudes(const Integer& a, const Integer& b) noexcept {
    if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
    for (std::size_t k = a.size_; k-- > 0;)
      if (a.limbs_[k] != b.limbs_[k]) return a.limbs_[k] < b.limbs_[k] ? -1 : 1;
    return 0;
  }

  /// Returns a + b, where b has the given sign and its own magnitude.
  static Integer sum(const Integer& a, const Integer& b, bool b_negative) noexcept {
    Integer n;
    if (a.negative_ == b_negative) {
      const Integer &longer = a.size_ >= b.size_ ? a : b, &shorter = a.size_ >= b.size_ ? b : a;
      HINGE_ASSERT(longer.size_ < capacity);
      std::uint64_t carry = 0;
      for (std::size_t k = 0; k < longer.size_; ++k) {
        const Wide x = Wide{longer.limbs_[k]} + (k < shorter.size_ ? shorter.limbs_[k] : 0) + carry;
        n.limbs_[k] = static_cast<std::uint64_t>(x);
        carry = static_cast<std::uint64_t>(x >> 64);
      }
      n.size_ = longer.size_;
      if (carry != 0) n.limbs_[n.size_++] = carry;
      n.negative_ = b_negative;
      return n;
    }
    const bool a_larger = compare_magnitudes(a, b) >= 0;
    const Integer &large = a_larger ? a : b, &small = a_larger ? b : a;
    std::uint64_t borrow = 0;
    for (std::size_t k = 0; k < large.size_; ++k) {
      const Wide x = Wide{large.limbs_[k]} - (k < small.size_ ? small.limbs_[k] : 0) - borrow;
      n.limbs_[k] = static_cast<std::uint64_t>(x);
      borrow = static_cast<std::uint64_t>(x >> 64) & 1U;
    }
    n.size_ = large.size_;
    n.negative_ = a_larger ? a.negative_ : b_negative;
    n.trim();
    return n;
  }

  std::size_t size_ = 0;  // limbs in use; the highest is not 0
  bool negative_ = false;
  std::array<std::uint64_t, capacity> limbs_;  // least significant limb first
};

}  // namespace hinge::detail::exact
