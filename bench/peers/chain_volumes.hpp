// SPDX-License-Identifier: BSD-3-Clause
// Bounding volumes for the nodes of ChainTree: boxes, or spheres centred in a box.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "lanes.hpp"
#include "pair_rules.hpp"

namespace hinge::bench {

/// Four floats in one 128-bit register; the last one is not used.
using Quad = float __attribute__((vector_size(16)));

inline Quad larger(Quad a, Quad b) { return a > b ? a : b; }
inline Quad smaller(Quad a, Quad b) { return a < b ? a : b; }

struct BoxVolume {
  void enclose(const Columns& p, std::size_t begin, std::size_t end) {
    const auto span = [&](const std::vector<float>& column, int axis) {
      Lanes low = Lanes::load(&column[begin]), high = low;
      if (end - begin < lane_count) {  // repeats the last point, because the padding is far away
        float c[lane_count];
        for (std::size_t k = 0; k < lane_count; ++k) c[k] = column[std::min(begin + k, end - 1)];
        low = high = Lanes::load(c);
      }
      low_[axis] = low.lowest();
      high_[axis] = high.highest();
    };
    span(p.x, 0);
    span(p.y, 1);
    span(p.z, 2);
  }
  void enclose(const BoxVolume& a, const BoxVolume& b, const Columns&, std::size_t, std::size_t) { merge(a, b); }
  void merge(const BoxVolume& a, const BoxVolume& b) {
    low_ = smaller(a.low_, b.low_);
    high_ = larger(a.high_, b.high_);
  }

  bool near(const BoxVolume& other, float cutoff) const {
    Quad gap = larger(low_ - other.high_, other.low_ - high_);
    gap = larger(gap, Quad{});
    gap *= gap;
    return gap[0] + gap[1] + gap[2] <= cutoff * cutoff;
  }
  bool near(float x, float y, float z, float cutoff) const {
    const Quad point{x, y, z, 0.0f};
    Quad gap = larger(larger(low_ - point, point - high_), Quad{});
    gap *= gap;
    return gap[0] + gap[1] + gap[2] <= cutoff * cutoff;
  }
  /// The bits of sixteen points that are closer than `cutoff` to the box.
  std::uint32_t near(const Columns& p, std::size_t block, float cutoff) const {
    const auto gap = [&](const std::vector<float>& column, int axis) {
      const Lanes c = Lanes::load(&column[block]);
      return larger(larger(Lanes::all(low_[axis]) - c, c - Lanes::all(high_[axis])), Lanes::all(0.0f));
    };
    const Lanes x = gap(p.x, 0), y = gap(p.y, 1), z = gap(p.z, 2);
    return less(multiply_add(x, x, multiply_add(y, y, z * z)), Lanes::all(cutoff * cutoff * 1.000001f));
  }
  double extent() const {
    const Quad e = larger(-low_, high_);
    return std::max({e[0], e[1], e[2]});
  }
  Quad low() const { return low_; }
  Quad high() const { return high_; }

 private:
  Quad low_{}, high_{};
};

/// Radii bound the points of a node, not its child spheres. This is tighter and costs one step per sixteen points.
struct SphereVolume {
  void enclose(const Columns& p, std::size_t begin, std::size_t end) {
    box_.enclose(p, begin, end);
    fit(p, begin, end);
  }
  void enclose(const SphereVolume& a, const SphereVolume& b, const Columns& p, std::size_t begin, std::size_t end) {
    box_.merge(a.box_, b.box_);
    fit(p, begin, end);
  }

  bool near(const SphereVolume& other, float cutoff) const {
    Quad d = center_ - other.center_;
    const float reach = radius_ + other.radius_ + cutoff;
    d *= d;
    return d[0] + d[1] + d[2] <= reach * reach;
  }
  bool near(float x, float y, float z, float cutoff) const {
    Quad d = center_ - Quad{x, y, z, center_[3]};
    const float reach = radius_ + cutoff;
    d *= d;
    return d[0] + d[1] + d[2] <= reach * reach;
  }
  std::uint32_t near(const Columns& p, std::size_t block, float cutoff) const {
    const float reach = radius_ + cutoff;
    return less(squared(p, block), Lanes::all(reach * reach));
  }
  double extent() const { return box_.extent(); }

 private:
  Lanes squared(const Columns& p, std::size_t k) const {
    return squared_distance(Lanes::load(&p.x[k]), Lanes::load(&p.y[k]), Lanes::load(&p.z[k]), center_[0], center_[1],
                            center_[2]);
  }
  void fit(const Columns& p, std::size_t begin, std::size_t end) {
    center_ = 0.5f * (box_.low() + box_.high());
    Lanes most = Lanes::all(0.0f);
    std::size_t k = begin;
    for (; k + lane_count <= end; k += lane_count) most = larger(most, squared(p, k));
    float rest = 0.0f;
    if (k < end) {
      float s[lane_count];
      squared(p, k).store(s);
      rest = *std::max_element(s, s + (end - k));
    }
    // Inflated for the rounding of about ten operations in squares and sums.
    radius_ = std::sqrt(std::max(most.highest(), rest)) * 1.000002f;
  }

  BoxVolume box_;
  Quad center_{};
  float radius_ = 0.0f;
};

}  // namespace hinge::bench
