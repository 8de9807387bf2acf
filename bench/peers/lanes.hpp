// SPDX-License-Identifier: BSD-3-Clause
// Sixteen float lanes with the few operations that inner loops of the peers need: one 512-bit register, two 256-bit
// registers, or a plain loop.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#if defined(__AVX512F__) || (defined(__AVX2__) && defined(__FMA__))
#include <immintrin.h>
#endif

namespace hinge::bench {

inline constexpr std::size_t lane_count = 16;

#if defined(__AVX512F__)

// Intrinsics with a zeroing mask of all lanes generate the same instructions as the plain ones, but g++ 12 warns
// about an undefined operand of the plain ones.
inline constexpr __mmask16 every_lane = 0xffff;

/// Sixteen indices into a table of sixteen floats; only the low four bits of a tag are used.
struct Tags {
  __m512i v;
  static Tags load(const std::uint32_t* p) { return {_mm512_loadu_si512(p)}; }
};

struct Lanes {
  __m512 v;
  static Lanes load(const float* p) { return {_mm512_loadu_ps(p)}; }
  static Lanes all(float x) { return {_mm512_set1_ps(x)}; }
  static Lanes lookup(const float* table, Tags tags) {
    return {_mm512_maskz_permutexvar_ps(every_lane, tags.v, _mm512_loadu_ps(table))};
  }
  void store(float* p) const { _mm512_storeu_ps(p, v); }
  friend Lanes operator-(Lanes a, Lanes b) { return {_mm512_sub_ps(a.v, b.v)}; }
  friend Lanes operator*(Lanes a, Lanes b) { return {_mm512_mul_ps(a.v, b.v)}; }
  /// a * b + c, with one or two roundings.
  friend Lanes multiply_add(Lanes a, Lanes b, Lanes c) { return {_mm512_fmadd_ps(a.v, b.v, c.v)}; }
  friend Lanes larger(Lanes a, Lanes b) { return {_mm512_maskz_max_ps(every_lane, a.v, b.v)}; }
  friend Lanes smaller(Lanes a, Lanes b) { return {_mm512_maskz_min_ps(every_lane, a.v, b.v)}; }
  /// Bit k: a < b in lane k.
  friend std::uint32_t less(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ); }
  float lowest() const {
    return reduce([](Lanes a, Lanes b) { return smaller(a, b); });
  }
  float highest() const {
    return reduce([](Lanes a, Lanes b) { return larger(a, b); });
  }

 private:
  template <class Op>
  float reduce(Op op) const {
    Lanes r = op(*this, {_mm512_maskz_shuffle_f32x4(every_lane, v, v, 0b01'00'11'10)});
    r = op(r, {_mm512_maskz_shuffle_f32x4(every_lane, r.v, r.v, 0b10'11'00'01)});
    r = op(r, {_mm512_maskz_permute_ps(every_lane, r.v, 0b01'00'11'10)});
    r = op(r, {_mm512_maskz_permute_ps(every_lane, r.v, 0b10'11'00'01)});
    return r.v[0];
  }
};

#elif defined(__AVX2__) && defined(__FMA__)

struct Tags {
  __m256i v[2];
  static Tags load(const std::uint32_t* p) {
    return {{_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)),
             _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p + 8))}};
  }
};

struct Lanes {
  __m256 v[2];
  static Lanes load(const float* p) { return {{_mm256_loadu_ps(p), _mm256_loadu_ps(p + 8)}}; }
  static Lanes all(float x) { return {{_mm256_set1_ps(x), _mm256_set1_ps(x)}}; }
  static Lanes lookup(const float* table, Tags tags) {
    const __m256 low = _mm256_loadu_ps(table), high = _mm256_loadu_ps(table + 8);
    const auto half = [&](__m256i t) {
      return _mm256_blendv_ps(_mm256_permutevar8x32_ps(low, t), _mm256_permutevar8x32_ps(high, t),
                              _mm256_castsi256_ps(_mm256_slli_epi32(t, 28)));  // bit 3 selects the upper half
    };
    return {{half(tags.v[0]), half(tags.v[1])}};
  }
  void store(float* p) const {
    _mm256_storeu_ps(p, v[0]);
    _mm256_storeu_ps(p + 8, v[1]);
  }
  friend Lanes operator-(Lanes a, Lanes b) { return {{_mm256_sub_ps(a.v[0], b.v[0]), _mm256_sub_ps(a.v[1], b.v[1])}}; }
  friend Lanes operator*(Lanes a, Lanes b) { return {{_mm256_mul_ps(a.v[0], b.v[0]), _mm256_mul_ps(a.v[1], b.v[1])}}; }
  friend Lanes multiply_add(Lanes a, Lanes b, Lanes c) {
    return {{_mm256_fmadd_ps(a.v[0], b.v[0], c.v[0]), _mm256_fmadd_ps(a.v[1], b.v[1], c.v[1])}};
  }
  friend Lanes larger(Lanes a, Lanes b) { return {{_mm256_max_ps(a.v[0], b.v[0]), _mm256_max_ps(a.v[1], b.v[1])}}; }
  friend Lanes smaller(Lanes a, Lanes b) { return {{_mm256_min_ps(a.v[0], b.v[0]), _mm256_min_ps(a.v[1], b.v[1])}}; }
  friend std::uint32_t less(Lanes a, Lanes b) {
    const int low = _mm256_movemask_ps(_mm256_cmp_ps(a.v[0], b.v[0], _CMP_LT_OQ));
    const int high = _mm256_movemask_ps(_mm256_cmp_ps(a.v[1], b.v[1], _CMP_LT_OQ));
    return static_cast<std::uint32_t>(low | high << 8);
  }
  float lowest() const {
    return reduce(_mm256_min_ps(v[0], v[1]), [](__m128 a, __m128 b) { return _mm_min_ps(a, b); });
  }
  float highest() const {
    return reduce(_mm256_max_ps(v[0], v[1]), [](__m128 a, __m128 b) { return _mm_max_ps(a, b); });
  }

 private:
  template <class Op>
  static float reduce(__m256 x, Op op) {
    __m128 r = op(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1));
    r = op(r, _mm_movehl_ps(r, r));
    return _mm_cvtss_f32(op(r, _mm_shuffle_ps(r, r, 1)));
  }
};

#else

struct Tags {
  std::uint32_t v[lane_count];
  static Tags load(const std::uint32_t* p) {
    Tags r;
    std::copy(p, p + lane_count, r.v);
    return r;
  }
};

struct Lanes {
  float v[lane_count];
  static Lanes load(const float* p) {
    return make([&](std::size_t k) { return p[k]; });
  }
  static Lanes all(float x) {
    return make([&](std::size_t) { return x; });
  }
  static Lanes lookup(const float* table, const Tags& tags) {
    return make([&](std::size_t k) { return table[tags.v[k] & 15u]; });
  }
  void store(float* p) const { std::copy(v, v + lane_count, p); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return make([&](std::size_t k) { return a.v[k] - b.v[k]; });
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return make([&](std::size_t k) { return a.v[k] * b.v[k]; });
  }
  friend Lanes multiply_add(const Lanes& a, const Lanes& b, const Lanes& c) {
    return make([&](std::size_t k) { return a.v[k] * b.v[k] + c.v[k]; });
  }
  friend Lanes larger(const Lanes& a, const Lanes& b) {
    return make([&](std::size_t k) { return a.v[k] > b.v[k] ? a.v[k] : b.v[k]; });
  }
  friend Lanes smaller(const Lanes& a, const Lanes& b) {
    return make([&](std::size_t k) { return a.v[k] < b.v[k] ? a.v[k] : b.v[k]; });
  }
  friend std::uint32_t less(const Lanes& a, const Lanes& b) {
    std::uint32_t mask = 0;
    for (std::size_t k = 0; k < lane_count; ++k) mask |= static_cast<std::uint32_t>(a.v[k] < b.v[k]) << k;
    return mask;
  }
  float lowest() const { return *std::min_element(v, v + lane_count); }
  float highest() const { return *std::max_element(v, v + lane_count); }

 private:
  template <class At>
  static Lanes make(At at) {
    Lanes r;
    for (std::size_t k = 0; k < lane_count; ++k) r.v[k] = at(k);
    return r;
  }
};

#endif

/// Squared distances of one point to sixteen points.
inline Lanes squared_distance(Lanes x, Lanes y, Lanes z, float px, float py, float pz) {
  const Lanes dx = x - Lanes::all(px), dy = y - Lanes::all(py), dz = z - Lanes::all(pz);
  return multiply_add(dx, dx, multiply_add(dy, dy, dz * dz));
}

/// A mask of lanes 0 .. count - 1, with count clamped to 0 .. 16.
inline std::uint32_t first_lanes(std::ptrdiff_t count) {
  return count >= 16 ? 0xffffu : count <= 0 ? 0u : (1u << count) - 1u;
}

}  // namespace hinge::bench
