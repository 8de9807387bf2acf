// SPDX-License-Identifier: BSD-3-Clause
// Converts bit masks to index lists, and looks up small tables. Standard SIMD types lack both operations.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "hinge/detail/simd/lanes.hpp"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace hinge::detail::simd {

#if defined(__AVX2__) && !defined(__AVX512F__)
/// Lists of the set bits of bytes. A loop over the set bits would end at an unpredictable place.
class BitLists {
 public:
  constexpr BitLists() noexcept {
    for (std::size_t byte = 0; byte < lists_.size(); ++byte)
      for (std::size_t bit = 0, n = 0; bit < 8; ++bit)
        if ((byte >> bit & 1U) != 0) lists_[byte][n++] = static_cast<std::uint8_t>(bit);
  }
  /// Returns the numbers of the set bits of a byte, lowest first, then zeros.
  [[gnu::always_inline]] __m256i of(std::size_t byte) const noexcept {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(lists_[byte].data())));
  }

 private:
  alignas(64) std::array<std::array<std::uint8_t, 8>, 256> lists_{};
};
inline constexpr BitLists bit_lists;

/// Writes value(numbers of the set bits, first lane) for each half of the lanes, and returns the number of set bits.
template <class Value>
[[gnu::always_inline]] inline std::size_t append_halves(Bits mask, std::uint32_t* to, const Value& value) noexcept {
  const std::size_t low = mask & 0xffU, high = mask >> 8;
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), value(bit_lists.of(low), 0));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + std::popcount(low)), value(bit_lists.of(high), 8));
  return static_cast<std::size_t>(std::popcount(mask));
}
#endif

/// Writes base + lane for every set bit to `to`, lowest lane first, and returns the number of set bits. It may write up
/// to `width` entries for any mask, so `to` needs that much space.
[[gnu::always_inline]] inline std::size_t append_lanes(Bits mask, std::uint32_t base, std::uint32_t* to) noexcept {
#if defined(__AVX512F__)
  const __m512i lanes = _mm512_add_epi32(_mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0),
                                         _mm512_set1_epi32(static_cast<int>(base)));
  // Compress into a register: the form that writes to memory is slow on some CPUs.
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), lanes));
  return static_cast<std::size_t>(std::popcount(mask));
#elif defined(__AVX2__)
  return append_halves(
      mask, to, [base](__m256i lanes, std::uint32_t first) __attribute__((always_inline)) {
        return _mm256_add_epi32(lanes, _mm256_set1_epi32(static_cast<int>(base + first)));
      });
#else
  std::size_t n = 0;
  for (; mask != 0; mask &= mask - 1) to[n++] = base + static_cast<std::uint32_t>(std::countr_zero(mask));
  return n;
#endif
}

/// Writes values[lane] for every set bit, in the same way.
[[gnu::always_inline]] inline std::size_t append_chosen(Bits mask, const std::uint32_t* values,
                                                        std::uint32_t* to) noexcept {
#if defined(__AVX512F__)
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), _mm512_loadu_si512(values)));
  return static_cast<std::size_t>(std::popcount(mask));
#elif defined(__AVX2__)
  return append_halves(
      mask, to, [values](__m256i lanes, std::uint32_t first) __attribute__((always_inline)) {
        const __m256i half = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(values + first));
        return _mm256_permutevar8x32_epi32(half, lanes);
      });
#else
  std::size_t n = 0;
  for (; mask != 0; mask &= mask - 1) to[n++] = values[std::countr_zero(mask)];
  return n;
#endif
}

/// Returns a in the lanes of set bits and b in the others.
[[gnu::always_inline]] inline Float16 choose(Bits mask, const Float16& a, const Float16& b) noexcept {
  alignas(64) float of_a[width], of_b[width];
  a.store(of_a);
  b.store(of_b);
#if defined(__AVX512F__)
  _mm512_store_ps(of_b, _mm512_mask_blend_ps(static_cast<__mmask16>(mask), _mm512_load_ps(of_b), _mm512_load_ps(of_a)));
#else
  for (; mask != 0; mask &= mask - 1) of_b[std::countr_zero(mask)] = of_a[std::countr_zero(mask)];
#endif
  return Float16(of_b);
}

/// Sixteen indices below 16, prepared for look_up. The intrinsics are the zero-masked forms, because g++ 12 warns about
/// an undefined operand of the plain forms.
class HINGE_REGISTERS_ABI Index16 {
 public:
  Index16() = default;
#if defined(__AVX512F__)
  explicit Index16(const std::uint8_t* from) noexcept
      : index_(_mm512_maskz_cvtepu8_epi32(0xffff, _mm_loadu_si128(reinterpret_cast<const __m128i*>(from)))) {}
  /// Returns table[index] in every lane. The table has 16 entries.
  [[gnu::always_inline]] friend Float16 look_up(const float* table, const Index16& i) noexcept {
    alignas(64) float r[width];
    _mm512_store_ps(r, _mm512_maskz_permutexvar_ps(0xffff, i.index_, _mm512_loadu_ps(table)));
    return Float16(r);
  }

 private:
  __m512i index_{};
#elif defined(__AVX2__)
  explicit Index16(const std::uint8_t* from) noexcept {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    index_[0] = _mm256_cvtepu8_epi32(bytes);
    index_[1] = _mm256_cvtepu8_epi32(_mm_srli_si128(bytes, 8));
  }
  /// Returns table[index] in every lane. The table has 16 entries.
  [[gnu::always_inline]] friend Float16 look_up(const float* table, const Index16& i) noexcept {
    const __m256 low = _mm256_loadu_ps(table), high = _mm256_loadu_ps(table + 8);
    alignas(32) float r[width];
    for (std::size_t h = 0; h < 2; ++h) {
      const __m256 upper = _mm256_castsi256_ps(_mm256_cmpgt_epi32(i.index_[h], _mm256_set1_epi32(7)));
      _mm256_store_ps(r + 8 * h, _mm256_blendv_ps(_mm256_permutevar8x32_ps(low, i.index_[h]),
                                                  _mm256_permutevar8x32_ps(high, i.index_[h]), upper));
    }
    return Float16(r);
  }

 private:
  __m256i index_[2]{};
#else
  explicit Index16(const std::uint8_t* from) noexcept : index_(from) {}
  /// Returns table[index] in every lane. The table has 16 entries.
  [[gnu::always_inline]] friend Float16 look_up(const float* table, const Index16& i) noexcept {
    float r[width];
    for (std::size_t k = 0; k < width; ++k) r[k] = table[i.index_[k]];
    return Float16(r);
  }

 private:
  const std::uint8_t* index_ = nullptr;
#endif
};

}  // namespace hinge::detail::simd
