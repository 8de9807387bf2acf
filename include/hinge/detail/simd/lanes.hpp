// SPDX-License-Identifier: BSD-3-Clause
// Lanes<T, N>: N numbers with lane-wise arithmetic. N does not depend on the instruction set; a value uses several
// registers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>
#include <new>
#include <vector>

namespace hinge::detail::simd {

// With clang and AVX-512, libstdc++ 12 treats a lane mask in where() as a single bool, so blends are avoided there.
#if defined(__clang__) && defined(__AVX512F__)
inline constexpr bool has_blends = false;
#else
inline constexpr bool has_blends = true;
#endif

/// One bit per lane; lane 0 is the lowest bit.
using Bits = std::uint32_t;

/// Lane-wise arithmetic without fused multiply-add: each lane has the bits of scalar code in the same order. Memory
/// need not be aligned. All functions are forced inline, because compilers otherwise emit calls that pass lanes through
/// memory.
template <class T, std::size_t N>
class Lanes {
  using Part = std::experimental::native_simd<T>;
  static constexpr std::size_t part_size = Part::size() < N ? Part::size() : N;
  using Vector = std::experimental::simd<T, std::experimental::simd_abi::deduce_t<T, part_size>>;
  static constexpr std::size_t parts = N / part_size;
  static_assert(parts * part_size == N);

 public:
  Lanes() = default;
  [[gnu::always_inline]] Lanes(T value) noexcept {
    for (Vector& v : v_) v = value;
  }
  [[gnu::always_inline]] explicit Lanes(const T* from) noexcept {
    for (std::size_t p = 0; p < parts; ++p) v_[p].copy_from(from + p * part_size, std::experimental::element_aligned);
  }
  /// Builds lanes from one value per lane.
  template <class... Values>
  requires(sizeof...(Values) == N) [[gnu::always_inline]] static Lanes of(Values... values) noexcept {
    const T each[N] = {values...};
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = Vector([&](auto lane) { return each[p * part_size + lane]; });
    return r;
  }
  [[gnu::always_inline]] void store(T* to) const noexcept {
    for (std::size_t p = 0; p < parts; ++p) v_[p].copy_to(to + p * part_size, std::experimental::element_aligned);
  }

  /// Stores lanes first .. last - 1 only; other memory is unchanged.
  [[gnu::always_inline]] void store_lanes(std::size_t first, std::size_t last, T* to) const noexcept {
    if constexpr (has_blends) {
      for (std::size_t p = 0; p < parts; ++p) {
        const Vector lane([&](auto k) { return static_cast<T>(p * part_size + k); });
        where(lane >= static_cast<T>(first) && lane < static_cast<T>(last), v_[p])
            .copy_to(to + p * part_size, std::experimental::element_aligned);
      }
    } else {
      for (std::size_t k = first; k < last; ++k) to[k] = v_[k / part_size][k % part_size];
    }
  }

  /// Stores all lanes, rounded to float.
  [[gnu::always_inline]] void store_rounded(float* to) const noexcept {
    using Rounded = std::experimental::rebind_simd_t<float, Vector>;
    for (std::size_t p = 0; p < parts; ++p)
      std::experimental::static_simd_cast<Rounded>(v_[p]).copy_to(to + p * part_size,
                                                                  std::experimental::element_aligned);
  }

  [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) noexcept {
    return each(
        a, b, [](const Vector& x, const Vector& y) __attribute__((always_inline)) { return Vector(x + y); });
  }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a, const Lanes& b) noexcept {
    return each(
        a, b, [](const Vector& x, const Vector& y) __attribute__((always_inline)) { return Vector(x - y); });
  }
  [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, const Lanes& b) noexcept {
    return each(
        a, b, [](const Vector& x, const Vector& y) __attribute__((always_inline)) { return Vector(x * y); });
  }
  [[gnu::always_inline]] friend Lanes operator/(const Lanes& a, const Lanes& b) noexcept {
    return each(
        a, b, [](const Vector& x, const Vector& y) __attribute__((always_inline)) { return Vector(x / y); });
  }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a) noexcept {
    return each(
        a, a, [](const Vector& x, const Vector&) __attribute__((always_inline)) { return Vector(-x); });
  }
  [[gnu::always_inline]] friend Lanes min(const Lanes& a, const Lanes& b) noexcept {
    return each(
        a, b, [](const Vector& x, const Vector& y) __attribute__((always_inline)) {
          return Vector(std::experimental::min(x, y));
        });
  }
  [[gnu::always_inline]] friend Lanes max(const Lanes& a, const Lanes& b) noexcept {
    return each(
        a, b, [](const Vector& x, const Vector& y) __attribute__((always_inline)) {
          return Vector(std::experimental::max(x, y));
        });
  }
  [[gnu::always_inline]] friend Lanes abs(const Lanes& a) noexcept { return max(a, -a); }

  /// The result of a lane-wise comparison.
  class Mask {
   public:
    using Parts = std::array<typename Vector::mask_type, parts>;
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
      for (std::size_t p = 0; p < parts; ++p) r |= static_cast<Bits>(m_[p].__to_bitset().to_ulong()) << (p * part_size);
      return r;
    }

   private:
    Parts m_;
  };

  /// Returns a < b per lane; false for NaN.
  [[gnu::always_inline]] friend Mask less(const Lanes& a, const Lanes& b) noexcept {
    typename Mask::Parts m;
    for (std::size_t p = 0; p < parts; ++p) m[p] = a.v_[p] < b.v_[p];
    return Mask(m);
  }
  /// Returns a <= b per lane; false for NaN.
  [[gnu::always_inline]] friend Mask less_equal(const Lanes& a, const Lanes& b) noexcept {
    typename Mask::Parts m;
    for (std::size_t p = 0; p < parts; ++p) m[p] = a.v_[p] <= b.v_[p];
    return Mask(m);
  }
  /// Returns a where x < y, otherwise b, per lane.
  [[gnu::always_inline]] friend Lanes choose_less(const Lanes& x, const Lanes& y, const Lanes& a,
                                                  const Lanes& b) noexcept {
    if constexpr (has_blends) {
      Lanes r = b;
      for (std::size_t p = 0; p < parts; ++p) where(x.v_[p] < y.v_[p], r.v_[p]) = a.v_[p];
      return r;
    } else {
      std::array<T, N> of_x, of_y, of_a, of_b;
      x.store(of_x.data());
      y.store(of_y.data());
      a.store(of_a.data());
      b.store(of_b.data());
      for (std::size_t k = 0; k < N; ++k) of_b[k] = of_x[k] < of_y[k] ? of_a[k] : of_b[k];
      return Lanes(of_b.data());
    }
  }

  /// Returns the smallest lane.
  [[gnu::always_inline]] friend T smallest(const Lanes& a) noexcept {
    Vector r = a.v_[0];
    for (std::size_t p = 1; p < parts; ++p) r = std::experimental::min(r, a.v_[p]);
    return std::experimental::hmin(r);
  }
  /// Returns the largest lane.
  [[gnu::always_inline]] friend T largest(const Lanes& a) noexcept {
    Vector r = a.v_[0];
    for (std::size_t p = 1; p < parts; ++p) r = std::experimental::max(r, a.v_[p]);
    return std::experimental::hmax(r);
  }

 private:
  template <class Op>
  [[gnu::always_inline]] static Lanes each(const Lanes& a, const Lanes& b, const Op& op) noexcept {
    Lanes r;
    for (std::size_t p = 0; p < parts; ++p) r.v_[p] = op(a.v_[p], b.v_[p]);
    return r;
  }
  std::array<Vector, parts> v_;
};

/// Allocates memory at multiples of a cache line. Eigen's allocator aligns to the registers of the instruction set, so
/// code for two instruction sets could not exchange vectors.
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

}  // namespace hinge::detail::simd
