// SPDX-License-Identifier: BSD-3-Clause
// Lanes<T, N>: N numbers with lane-wise arithmetic. N does not depend on the instruction set; a value uses several
// registers.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace hinge::detail::simd {

/// One bit per lane; lane 0 is the lowest bit.
using Bits = std::uint32_t;

/// Bytes of the widest register.
#if defined(__AVX512F__)
inline constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__)
inline constexpr std::size_t register_bytes = 32;
#else
inline constexpr std::size_t register_bytes = 16;
#endif

/// One register of `size` numbers: a vector of g++ and clang, which compile its operators lane by lane for any CPU.
template <class T, std::size_t size>
struct Register {
  using Vector [[gnu::vector_size(size * sizeof(T))]] = T;
  using Compared = decltype(Vector{} < Vector{});  // a whole number per lane: -1 if true, otherwise 0

  /// Returns one bit per lane.
  [[gnu::always_inline]] static Bits bits(const Compared& lanes) noexcept {
#if defined(__AVX512DQ__) && defined(__AVX512VL__)
    if constexpr (sizeof(Vector) == 64 && sizeof(T) == 4)
      return static_cast<Bits>(__builtin_ia32_cvtd2mask512(as<int>(lanes)));
    else if constexpr (sizeof(Vector) == 64 && sizeof(T) == 8)
      return static_cast<Bits>(__builtin_ia32_cvtq2mask512(as<long long>(lanes)));
    else
#endif
#if defined(__AVX__)
        if constexpr (sizeof(Vector) == 32 && sizeof(T) == 4)
      return static_cast<Bits>(__builtin_ia32_movmskps256(as<float>(lanes)));
    else if constexpr (sizeof(Vector) == 32 && sizeof(T) == 8)
      return static_cast<Bits>(__builtin_ia32_movmskpd256(as<double>(lanes)));
    else
#endif
#if defined(__SSE2__)
        if constexpr (sizeof(Vector) == 16 && sizeof(T) == 4)
      return static_cast<Bits>(__builtin_ia32_movmskps(as<float>(lanes)));
    else if constexpr (sizeof(Vector) == 16 && sizeof(T) == 8)
      return static_cast<Bits>(__builtin_ia32_movmskpd(as<double>(lanes)));
    else
#endif
    {
      Bits r = 0;
      for (std::size_t k = 0; k < size; ++k) r |= static_cast<Bits>(lanes[k] & 1) << k;
      return r;
    }
  }

  /// Combines all lanes by `op`, halves first.
  template <class Op>
  [[gnu::always_inline]] static T fold(const Vector& v, const Op& op) noexcept {
    if constexpr (size == 2)
      return op(v[0], v[1]);
    else
      return fold_halves(v, op, std::make_index_sequence<size / 2>{});
  }

 private:
  template <class U>
  [[gnu::always_inline]] static auto as(const Compared& lanes) noexcept {
    return reinterpret_cast<typename Register<U, size>::Vector>(lanes);
  }
  template <class Op, std::size_t... k>
  [[gnu::always_inline]] static T fold_halves(const Vector& v, const Op& op, std::index_sequence<k...>) noexcept {
    using Half = Register<T, size / 2>;
    const typename Half::Vector low = __builtin_shufflevector(v, v, k...),
                                high = __builtin_shufflevector(v, v, (k + size / 2)...);
    return Half::fold(op(low, high), op);
  }
};

/// Lane-wise arithmetic without fused multiply-add: each lane has the bits of scalar code in the same order. Memory
/// need not be aligned. All functions are forced inline, because compilers otherwise emit calls that pass lanes through
/// memory.
template <class T, std::size_t N>
class Lanes {
  static constexpr std::size_t part_size = std::min(register_bytes / sizeof(T), N);
  using Part = Register<T, part_size>;
  using Vector = typename Part::Vector;
  static constexpr std::size_t parts = N / part_size;
  static_assert(parts * part_size == N);

 public:
  Lanes() = default;
  [[gnu::always_inline]] Lanes(T value) noexcept {
    for (Vector& v : v_) v = value - Vector{};
  }
  [[gnu::always_inline]] explicit Lanes(const T* from) noexcept { std::memcpy(v_, from, sizeof(v_)); }
  /// Builds lanes from one value per lane.
  template <class... Values>
  requires(sizeof...(Values) == N) [[gnu::always_inline]] static Lanes of(Values... values) noexcept {
    const T each[N] = {values...};
    return Lanes(each);
  }
  [[gnu::always_inline]] void store(T* to) const noexcept { std::memcpy(to, v_, sizeof(v_)); }

  /// Stores lanes first .. last - 1 and leaves the other values of `to` as they are. `to` holds N values.
  [[gnu::always_inline]] void store_lanes(std::size_t first, std::size_t last, T* to) const noexcept {
    T each[N], lane[N];
    for (std::size_t k = 0; k < N; ++k) lane[k] = static_cast<T>(k);
    const Lanes number(lane), begin(static_cast<T>(first)), end(static_cast<T>(last));
    choose_less(number, begin, Lanes(to), choose_less(number, end, *this, Lanes(to))).store(each);
    std::memcpy(to, each, sizeof(each));
  }

  /// Stores all lanes, rounded to float.
  [[gnu::always_inline]] void store_rounded(float* to) const noexcept {
    for (std::size_t p = 0; p < parts; ++p) {
      const auto rounded = __builtin_convertvector(v_[p], typename Register<float, part_size>::Vector);
      std::memcpy(to + p * part_size, &rounded, sizeof(rounded));
    }
  }

  [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] + b.v_[p];
    return r;
  }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] - b.v_[p];
    return r;
  }
  [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] * b.v_[p];
    return r;
  }
  [[gnu::always_inline]] friend Lanes operator/(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] / b.v_[p];
    return r;
  }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = -a.v_[p];
    return r;
  }
  /// Returns a < b ? a : b per lane.
  [[gnu::always_inline]] friend Lanes min(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] < b.v_[p] ? a.v_[p] : b.v_[p];
    return r;
  }
  /// Returns a > b ? a : b per lane.
  [[gnu::always_inline]] friend Lanes max(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] > b.v_[p] ? a.v_[p] : b.v_[p];
    return r;
  }
  [[gnu::always_inline]] friend Lanes abs(const Lanes& a) noexcept { return max(a, -a); }

  /// The result of a lane-wise comparison.
  class Mask {
   public:
    [[gnu::always_inline]] friend Mask operator&(const Mask& a, const Mask& b) noexcept {
      Mask r;
      for (std::size_t p = 0; p < parts; ++p) r.m_[p] = a.m_[p] & b.m_[p];
      return r;
    }
    [[gnu::always_inline]] friend Mask operator|(const Mask& a, const Mask& b) noexcept {
      Mask r;
      for (std::size_t p = 0; p < parts; ++p) r.m_[p] = a.m_[p] | b.m_[p];
      return r;
    }
    [[gnu::always_inline]] operator Bits() const noexcept {
      Bits r = 0;
      for (std::size_t p = 0; p < parts; ++p) r |= Part::bits(m_[p]) << (p * part_size);
      return r;
    }

   private:
    friend class Lanes;
    typename Part::Compared m_[parts];
  };

  /// Returns a < b per lane; false for NaN.
  [[gnu::always_inline]] friend Mask less(const Lanes& a, const Lanes& b) noexcept {
    Mask r;
    for (std::size_t p = 0; p < parts; ++p) set(r, p, a.v_[p] < b.v_[p]);
    return r;
  }
  /// Returns a <= b per lane; false for NaN.
  [[gnu::always_inline]] friend Mask less_equal(const Lanes& a, const Lanes& b) noexcept {
    Mask r;
    for (std::size_t p = 0; p < parts; ++p) set(r, p, a.v_[p] <= b.v_[p]);
    return r;
  }
  /// Returns a where x < y, otherwise b, per lane.
  [[gnu::always_inline]] friend Lanes choose_less(const Lanes& x, const Lanes& y, const Lanes& a,
                                                  const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = x.v_[p] < y.v_[p] ? a.v_[p] : b.v_[p];
    return r;
  }

  /// Returns the smallest lane.
  [[gnu::always_inline]] friend T smallest(const Lanes& a) noexcept {
    return a.fold([](const auto& x, const auto& y) __attribute__((always_inline)) { return x < y ? x : y; });
  }
  /// Returns the largest lane.
  [[gnu::always_inline]] friend T largest(const Lanes& a) noexcept {
    return a.fold([](const auto& x, const auto& y) __attribute__((always_inline)) { return x > y ? x : y; });
  }

 private:
  [[gnu::always_inline]] static void set(Mask& mask, std::size_t p, const typename Part::Compared& lanes) noexcept {
    mask.m_[p] = lanes;
  }
  template <class Op>
  [[gnu::always_inline]] T fold(const Op& op) const noexcept {
    Vector r = v_[0];
    for (std::size_t p = 1; p < parts; ++p) r = op(r, v_[p]);
    return Part::fold(r, op);
  }

  Vector v_[parts];
};

/// A vector with aligned storage. Register loads then never cross a cache line, which would halve their rate.
template <class T>
using AlignedVector = std::vector<T, Eigen::aligned_allocator<T>>;

/// Width of blocks, nodes and candidate groups on every instruction set. In measurements it also pays where sixteen
/// floats need four registers.
inline constexpr std::size_t width = 16;
inline constexpr Bits all_bits = (Bits{1} << width) - 1;

using Float4 = Lanes<float, 4>;
using Float16 = Lanes<float, 16>;
using Double4 = Lanes<double, 4>;
using Double8 = Lanes<double, 8>;

}  // namespace hinge::detail::simd
