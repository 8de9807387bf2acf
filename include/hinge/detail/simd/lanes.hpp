// SPDX-License-Identifier: BSD-3-Clause
// Lanes<T, N>: N numbers with lane-wise arithmetic. N does not depend on the instruction set; a value uses several
// registers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <utility>
#include <vector>

#include "hinge/detail/simd/register.hpp"

namespace hinge::detail::simd {

/// Lane-wise arithmetic without fused multiply-add: each lane has the bits of scalar code in the same order. Memory
/// need not be aligned. All functions are forced inline, because compilers otherwise emit calls that pass lanes through
/// memory.
///
/// Code for different instruction sets can be linked into one program. So types with lanes have the same layout for all
/// of them: the alignment does not depend on the registers. Functions that take or return lanes have different symbols
/// (the ABI tag), because the registers decide how lanes are passed.
template <class T, std::size_t N>
class HINGE_REGISTERS_ABI Lanes {
  static constexpr std::size_t part_size = std::min(N, register_bytes / sizeof(T));
  static constexpr std::size_t parts = N / part_size;
  static_assert(parts * part_size == N);
  using Part = Register<T, part_size>;
  using Vector = typename Part::Vector;
  template <class, std::size_t>
  friend class Lanes;

 public:
  Lanes() = default;
  [[gnu::always_inline]] Lanes(T value) noexcept {
    for (Vector& v : v_) v = Part::filled(value);
  }
  [[gnu::always_inline]] explicit Lanes(const T* from) noexcept {
    for (std::size_t p = 0; p < parts; ++p) std::memcpy(&v_[p], from + p * part_size, sizeof(Vector));
  }
  /// Builds lanes from one value per lane.
  template <class... Values>
  requires(sizeof...(Values) == N) [[gnu::always_inline]] static Lanes of(Values... values) noexcept {
    const T each[N] = {values...};
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = Part::of(each + p * part_size);
    return r;
  }
  [[gnu::always_inline]] void store(T* to) const noexcept {
    for (std::size_t p = 0; p < parts; ++p) std::memcpy(to + p * part_size, &v_[p], sizeof(Vector));
  }

  /// Stores lanes first .. last - 1. to: N numbers; the others are read, and written back as they are.
  [[gnu::always_inline]] void store_lanes(std::size_t first, std::size_t last, T* to) const noexcept {
    Lanes r(to);
    for (std::size_t p = 0; p < parts; ++p) {
      const Vector lane = Part::numbered(p * part_size), begin = Part::filled(static_cast<T>(first)),
                   end = Part::filled(static_cast<T>(last));
      r.v_[p] = ((lane >= begin) & (lane < end)) ? v_[p] : r.v_[p];
    }
    r.store(to);
  }

  /// Returns the lanes of `low`, then those of `high`, rounded. T: float. Memory in between would be slow: a processor
  /// waits if it has to load what it stored as two halves.
  [[gnu::always_inline]] static Lanes rounded(const Lanes<double, N / 2>& low,
                                              const Lanes<double, N / 2>& high) noexcept {
    static_assert(Lanes<double, N / 2>::parts == parts);
    const auto half = [&](std::size_t k) __attribute__((always_inline)) {
      return __builtin_convertvector(k < parts ? low.v_[k] : high.v_[k - parts],
                                     typename Register<T, part_size / 2>::Vector);
    };
    const auto join = [&]<std::size_t... I>(std::size_t p, std::index_sequence<I...>) __attribute__((always_inline)) {
      return __builtin_shufflevector(half(2 * p), half(2 * p + 1), I...);
    };
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = join(p, std::make_index_sequence<part_size>());
    return r;
  }

  /// Stores all lanes, rounded to float.
  [[gnu::always_inline]] void store_rounded(float* to) const noexcept {
    const auto rounded = [&](std::size_t p) __attribute__((always_inline)) {
      return __builtin_convertvector(v_[p], typename Register<float, part_size>::Vector);
    };
    const auto store_at = [to](std::size_t lane, const auto& floats) __attribute__((always_inline)) {
      std::memcpy(to + lane, &floats, sizeof floats);
    };
    if constexpr (part_size == 2) {
      // A processor waits if it has to load sixteen bytes that it stored as two halves.
      for (std::size_t p = 0; p < parts; p += 2)
        store_at(p * part_size, __builtin_shufflevector(rounded(p), rounded(p + 1), 0, 1, 2, 3));
    } else {
      for (std::size_t p = 0; p < parts; ++p) store_at(p * part_size, rounded(p));
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
  /// Returns b where a or b is NaN.
  [[gnu::always_inline]] friend Lanes min(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = Part::min(a.v_[p], b.v_[p]);
    return r;
  }
  /// Returns b where a or b is NaN.
  [[gnu::always_inline]] friend Lanes max(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = Part::max(a.v_[p], b.v_[p]);
    return r;
  }
  [[gnu::always_inline]] friend Lanes abs(const Lanes& a) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = Part::abs(a.v_[p]);
    return r;
  }

  /// Returns the square root of each lane. T: double.
  [[gnu::always_inline]] friend Lanes sqrt(const Lanes& a) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = Part::sqrt(a.v_[p]);
    return r;
  }

  // The operators below are for lanes of 64-bit integers.
  [[gnu::always_inline]] friend Lanes operator^(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] ^ b.v_[p];
    return r;
  }
  [[gnu::always_inline]] friend Lanes operator&(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] & b.v_[p];
    return r;
  }
  [[gnu::always_inline]] friend Lanes operator|(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] | b.v_[p];
    return r;
  }
  [[gnu::always_inline]] friend Lanes operator<<(const Lanes& a, int bits) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] << bits;
    return r;
  }
  [[gnu::always_inline]] friend Lanes operator>>(const Lanes& a, int bits) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = a.v_[p] >> bits;
    return r;
  }
  /// Returns the products of the lower halves of the lanes.
  [[gnu::always_inline]] friend Lanes product_of_low(const Lanes& a, const Lanes& b) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = Part::product_of_low(a.v_[p], b.v_[p]);
    return r;
  }
  /// Returns lanes of another type with the same bits. sizeof(U) == sizeof(T).
  template <class U>
  [[gnu::always_inline]] Lanes<U, N> bits_as() const noexcept {
    return std::bit_cast<Lanes<U, N>>(*this);
  }

  /// The result of a lane-wise comparison.
  class HINGE_REGISTERS_ABI Mask {
   public:
    using Parts = std::array<decltype(Part::less(Vector{}, Vector{})), parts>;
    [[gnu::always_inline]] explicit Mask(const Parts& m) noexcept : m_(m) {}
    [[gnu::always_inline]] friend Mask operator&(const Mask& a, const Mask& b) noexcept {
      Parts m;
      for (std::size_t p = 0; p < parts; ++p) m[p] = a.m_[p] & b.m_[p];
      return Mask(m);
    }
    [[gnu::always_inline]] friend Mask operator|(const Mask& a, const Mask& b) noexcept {
      Parts m;
      for (std::size_t p = 0; p < parts; ++p) m[p] = a.m_[p] | b.m_[p];
      return Mask(m);
    }
    [[gnu::always_inline]] operator Bits() const noexcept {
      Bits r = 0;
      for (std::size_t p = 0; p < parts; ++p) r |= Part::bits(m_[p]) << (p * part_size);
      return r;
    }

   private:
    Parts m_;
  };

  /// Returns a < b per lane; false for NaN.
  [[gnu::always_inline]] friend Mask less(const Lanes& a, const Lanes& b) noexcept {
    typename Mask::Parts m;
    for (std::size_t p = 0; p < parts; ++p) m[p] = Part::less(a.v_[p], b.v_[p]);
    return Mask(m);
  }
  /// Returns a <= b per lane; false for NaN.
  [[gnu::always_inline]] friend Mask less_equal(const Lanes& a, const Lanes& b) noexcept {
    typename Mask::Parts m;
    for (std::size_t p = 0; p < parts; ++p) m[p] = Part::less_equal(a.v_[p], b.v_[p]);
    return Mask(m);
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
    Vector r = a.v_[0];
    for (std::size_t p = 1; p < parts; ++p) r = Part::min(r, a.v_[p]);
    return Part::smallest(r);
  }
  /// Returns the largest lane.
  [[gnu::always_inline]] friend T largest(const Lanes& a) noexcept {
    Vector r = a.v_[0];
    for (std::size_t p = 1; p < parts; ++p) r = Part::max(r, a.v_[p]);
    return Part::largest(r);
  }

 private:
  alignas(std::min<std::size_t>(N * sizeof(T), 64)) std::array<Vector, parts> v_;
};

/// Allocates memory at multiples of a cache line. Eigen's allocator aligns to the registers of the instruction set, so
/// code for different instruction sets could not exchange vectors.
template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t line{64};
  static_assert(alignof(T) <= 64);

  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U>&) noexcept {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* at, std::size_t) noexcept { ::operator delete(at, line); }
  friend bool operator==(const LineAllocator&, const LineAllocator&) noexcept { return true; }
};

/// A vector with aligned storage. Register loads then never cross a cache line, which would halve their rate.
template <class T>
using AlignedVector = std::vector<T, LineAllocator<T>>;

/// Width of blocks, nodes and candidate groups on every instruction set. In measurements it also pays where sixteen
/// floats need four registers.
inline constexpr std::size_t width = 16;
inline constexpr Bits all_bits = (Bits{1} << width) - 1;

using Float4 = Lanes<float, 4>;
using Float16 = Lanes<float, 16>;
using Double4 = Lanes<double, 4>;
using Double8 = Lanes<double, 8>;
using Integer8 = Lanes<std::uint64_t, 8>;

}  // namespace hinge::detail::simd
