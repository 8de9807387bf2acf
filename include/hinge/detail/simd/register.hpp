// SPDX-License-Identifier: BSD-3-Clause
// Register<T, N>: N numbers in a register, on the vector extensions of g++ and clang.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <type_traits>
#include <utility>
#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace hinge::detail::simd {

/// One bit per lane; lane 0 is the lowest bit.
using Bits = std::uint32_t;

// HINGE_REGISTERS_ABI is an attribute of types that hold registers (see Lanes). It is a macro because the attribute
// takes only a literal.
#if defined(__AVX512F__)
inline constexpr std::size_t register_bytes = 64;
#define HINGE_REGISTERS_ABI [[gnu::abi_tag("registers64")]]
#elif defined(__AVX__)
inline constexpr std::size_t register_bytes = 32;
#define HINGE_REGISTERS_ABI [[gnu::abi_tag("registers32")]]
#else
inline constexpr std::size_t register_bytes = 16;
#define HINGE_REGISTERS_ABI [[gnu::abi_tag("registers16")]]
#endif

/// Operations on one register. They are forced inline for the reason that `Lanes` gives.
template <class T, std::size_t N>
struct Register {
  using Vector [[gnu::vector_size(N * sizeof(T))]] = T;
  using Bitwise = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
  /// The result of a comparison: all bits of a lane are equal.
  using Compared [[gnu::vector_size(N * sizeof(T))]] = Bitwise;
  /// The widest registers of AVX-512 have one bit per lane, as its comparisons do.
  static constexpr bool has_bit_masks = sizeof(Vector) == 64;

  [[gnu::always_inline]] static Vector filled(T value) noexcept { return filled(value, Numbers{}); }
  [[gnu::always_inline]] static Vector of(const T* from) noexcept { return of(from, Numbers{}); }
  /// Returns first, first + 1, ...
  [[gnu::always_inline]] static Vector numbered(std::size_t first) noexcept { return numbered(first, Numbers{}); }

  [[gnu::always_inline]] static auto less(const Vector& a, const Vector& b) noexcept {
#if defined(__AVX512F__)
    if constexpr (has_bit_masks)
      return compared_bits<_CMP_LT_OS>(a, b);
    else
#endif
      return a < b;
  }
  [[gnu::always_inline]] static auto less_equal(const Vector& a, const Vector& b) noexcept {
#if defined(__AVX512F__)
    if constexpr (has_bit_masks)
      return compared_bits<_CMP_LE_OS>(a, b);
    else
#endif
      return a <= b;
  }
  /// mask: from less() or less_equal().
  template <class Mask>
  [[gnu::always_inline]] static Bits bits(const Mask& mask) noexcept {
    if constexpr (has_bit_masks) {
      return mask;
#if defined(__AVX__)
    } else if constexpr (sizeof(Mask) == 32 && sizeof(T) == 4) {
      return static_cast<Bits>(_mm256_movemask_ps(std::bit_cast<__m256>(mask)));
    } else if constexpr (sizeof(Mask) == 32) {
      return static_cast<Bits>(_mm256_movemask_pd(std::bit_cast<__m256d>(mask)));
#endif
#if defined(__SSE2__)
    } else if constexpr (sizeof(T) == 4) {
      return static_cast<Bits>(_mm_movemask_ps(std::bit_cast<__m128>(mask)));
    } else {
      return static_cast<Bits>(_mm_movemask_pd(std::bit_cast<__m128d>(mask)));
#else
    } else {
      Compared lane;
      for (std::size_t k = 0; k < N; ++k) lane[k] = 1 << k;
      return static_cast<Bits>(combined(mask & lane, std::bit_or{}));
#endif
    }
  }

  [[gnu::always_inline]] static Vector min(const Vector& a, const Vector& b) noexcept { return a < b ? a : b; }
  [[gnu::always_inline]] static Vector max(const Vector& a, const Vector& b) noexcept { return a > b ? a : b; }
  [[gnu::always_inline]] static Vector abs(const Vector& v) noexcept {
    constexpr auto all_but_sign = std::numeric_limits<Bitwise>::max();
    return reinterpret_cast<Vector>(reinterpret_cast<Compared>(v) & all_but_sign);
  }
  /// T: double.
  [[gnu::always_inline]] static Vector sqrt(const Vector& v) noexcept {
#if defined(__AVX512F__)
    if constexpr (sizeof(Vector) == 64) return _mm512_maskz_sqrt_pd(every_lane, v);
#endif
#if defined(__AVX__)
    if constexpr (sizeof(Vector) == 32) return _mm256_sqrt_pd(v);
#endif
#if defined(__SSE2__)
    if constexpr (sizeof(Vector) == 16) return _mm_sqrt_pd(v);
#endif
    Vector r;
    for (std::size_t k = 0; k < N; ++k) r[k] = std::sqrt(v[k]);
    return r;
  }
  /// Multiplies the lower halves of two 64-bit integers.
  [[gnu::always_inline]] static Vector product_of_low(const Vector& a, const Vector& b) noexcept {
#if defined(__AVX512F__)
    if constexpr (sizeof(Vector) == 64)
      return std::bit_cast<Vector>(
          _mm512_maskz_mul_epu32(every_lane, std::bit_cast<__m512i>(a), std::bit_cast<__m512i>(b)));
#endif
#if defined(__AVX2__)
    if constexpr (sizeof(Vector) == 32)
      return std::bit_cast<Vector>(_mm256_mul_epu32(std::bit_cast<__m256i>(a), std::bit_cast<__m256i>(b)));
#endif
#if defined(__SSE2__)
    if constexpr (sizeof(Vector) == 16)
      return std::bit_cast<Vector>(_mm_mul_epu32(std::bit_cast<__m128i>(a), std::bit_cast<__m128i>(b)));
#endif
    constexpr T low = 0xffff'ffff;
    return (a & low) * (b & low);
  }
  [[gnu::always_inline]] static T smallest(const Vector& v) noexcept {
    return combined(
        v, [](const auto& a, const auto& b) __attribute__((always_inline)) { return a < b ? a : b; });
  }
  [[gnu::always_inline]] static T largest(const Vector& v) noexcept {
    return combined(
        v, [](const auto& a, const auto& b) __attribute__((always_inline)) { return a > b ? a : b; });
  }

 private:
#if defined(__AVX512F__)
  /// For intrinsics with a mask. Inside those without one, g++ 12 warns of an operand that is not initialised.
  static constexpr __mmask8 every_lane = 0xff;

  /// predicate: _CMP_LT_OS or _CMP_LE_OS, which are _MM_CMPINT_LT and _MM_CMPINT_LE too.
  template <int predicate>
  [[gnu::always_inline]] static Bits compared_bits(const Vector& a, const Vector& b) noexcept {
    static_assert(_CMP_LT_OS == int{_MM_CMPINT_LT} && _CMP_LE_OS == int{_MM_CMPINT_LE});
    if constexpr (std::is_same_v<T, float>)
      return _mm512_cmp_ps_mask(a, b, predicate);
    else if constexpr (std::is_same_v<T, double>)
      return _mm512_cmp_pd_mask(a, b, predicate);
    else
      return _mm512_cmp_epu32_mask(std::bit_cast<__m512i>(a), std::bit_cast<__m512i>(b), predicate);
  }
#endif

  using Numbers = std::make_index_sequence<N>;
  template <std::size_t... k>
  [[gnu::always_inline]] static Vector filled(T value, std::index_sequence<k...>) noexcept {
    return Vector{(static_cast<void>(k), value)...};
  }
  template <std::size_t... k>
  [[gnu::always_inline]] static Vector of(const T* from, std::index_sequence<k...>) noexcept {
    return Vector{from[k]...};
  }
  template <std::size_t... k>
  [[gnu::always_inline]] static Vector numbered(std::size_t first, std::index_sequence<k...>) noexcept {
    return Vector{static_cast<T>(first + k)...};
  }
  /// Returns op(v[0], op(v[1], ...)) in any order.
  template <class V, class Op>
  [[gnu::always_inline]] static auto combined(const V& v, const Op& op) noexcept {
    constexpr std::size_t half = sizeof v / sizeof v[0] / 2;
    if constexpr (half == 1)
      return op(v[0], v[1]);
    else
      return [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
        return combined(op(__builtin_shufflevector(v, v, k...), __builtin_shufflevector(v, v, (half + k)...)), op);
      }
    (std::make_index_sequence<half>{});
  }
};

}  // namespace hinge::detail::simd
