// SPDX-License-Identifier: BSD-3-Clause
// ThresholdClasses: the distance matrix reduced to at most sixteen classes of primitives, for the float filter.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/policy/distance_matrix.hpp"

namespace hinge::detail {

/// Thresholds between classes, scaled, rounded up to float. A row fits one sixteen-lane look-up.
struct ThresholdTable {
  std::array<float, simd::width * simd::width> row{};  ///< row: class of the single primitive; column: of the lane
  std::size_t rows = 0;                                ///< number of classes of single primitives
  float largest = 0.0F;

  void set(std::size_t c, std::size_t d, double threshold) noexcept {
    const float t = float_above(threshold);
    row[c * simd::width + d] = t;
    rows = std::max(rows, c + 1);
    largest = std::max(largest, t);
  }
};

/// Primitives with similar thresholds share a class. The table holds the largest threshold between the members of two
/// classes, so no pair is lost. It is exact for at most sixteen types, and for a uniform clearance.
class ThresholdClasses {
 public:
  template <DistanceMatrix D>
  ThresholdClasses(const D& matrix, std::size_t n) {
    if constexpr (TypedThresholdMatrix<D>)
      from_types(matrix, n);
    else
      from_reaches(matrix, n);
  }

  std::uint8_t class_of(std::size_t primitive) const noexcept { return class_of_[primitive]; }
  /// Thresholds between class c and every class if each class is one type, otherwise null. Model unit.
  const double* exact_row(std::size_t c) const noexcept {
    return one_type_each_ ? between_.data() + c * simd::width : nullptr;
  }
  /// Upper bound of reach(i) over the class, model unit.
  double reach(std::size_t c) const noexcept { return reach_[c]; }

  /// Table within one model: thresholds times `scale`.
  ThresholdTable table(double scale) const noexcept {
    ThresholdTable t;
    for (std::size_t c = 0; c < count_; ++c)
      for (std::size_t d = 0; d < count_; ++d) t.set(c, d, between_[c * simd::width + d] * scale);
    return t;
  }
  /// Table between this model and another model with a compatible matrix.
  ThresholdTable table(const ThresholdClasses& other, double scale) const noexcept {
    if (typed_) return table(scale);
    ThresholdTable t;
    for (std::size_t c = 0; c < count_; ++c)
      for (std::size_t d = 0; d < other.count_; ++d) t.set(c, d, (reach_[c] + other.reach_[d]) * scale);
    return t;
  }

 private:
  /// Sorts the values and cuts them into at most sixteen runs. Returns the largest value of each run.
  static std::vector<double> cut(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    std::vector<double> tops;
    const std::size_t runs = std::min(values.size(), simd::width);
    for (std::size_t r = 1; r <= runs; ++r) tops.push_back(values[values.size() * r / runs - 1]);
    return tops;
  }
  static std::uint8_t run_of(const std::vector<double>& tops, double value) {
    return static_cast<std::uint8_t>(std::lower_bound(tops.begin(), tops.end(), value) - tops.begin());
  }

  /// Classes depend on the matrix table only, so models that share the table share the classes.
  template <class D>
  void from_types(const D& matrix, std::size_t n) {
    typed_ = true;
    const std::size_t types = matrix.type_count();
    std::vector<double> reaches(types, 0.0);
    for (std::size_t s = 0; s < types; ++s)
      for (std::size_t t = 0; t < types; ++t) reaches[s] = std::max(reaches[s], matrix.between_types(s, t) / 2);
    std::vector<std::uint8_t> class_of_type(types);
    one_type_each_ = types <= simd::width;
    if (one_type_each_) {
      count_ = types;
      for (std::size_t s = 0; s < types; ++s) class_of_type[s] = static_cast<std::uint8_t>(s);
    } else {
      const std::vector<double> tops = cut(reaches);
      count_ = tops.size();
      for (std::size_t s = 0; s < types; ++s) class_of_type[s] = run_of(tops, reaches[s]);
    }
    for (std::size_t s = 0; s < types; ++s) {
      reach_[class_of_type[s]] = std::max(reach_[class_of_type[s]], reaches[s]);
      for (std::size_t t = 0; t < types; ++t) {
        double& between = between_[class_of_type[s] * simd::width + class_of_type[t]];
        between = std::max(between, matrix.between_types(s, t));
      }
    }
    for (std::size_t i = 0; i < n; ++i) class_of_.push_back(class_of_type[matrix.type(id<PrimitiveId>(i))]);
  }

  template <class D>
  void from_reaches(const D& matrix, std::size_t n) {
    std::vector<double> reaches(n);
    for (std::size_t i = 0; i < n; ++i) reaches[i] = matrix.reach(id<PrimitiveId>(i));
    const std::vector<double> tops = cut(reaches);
    count_ = tops.size();
    for (std::size_t i = 0; i < n; ++i) class_of_.push_back(run_of(tops, reaches[i]));
    std::copy(tops.begin(), tops.end(), reach_.begin());
    for (std::size_t c = 0; c < count_; ++c)
      for (std::size_t d = 0; d < count_; ++d) between_[c * simd::width + d] = reach_[c] + reach_[d];
  }

  bool typed_ = false, one_type_each_ = false;
  std::size_t count_ = 0;
  std::vector<std::uint8_t> class_of_;
  std::array<double, simd::width> reach_{};
  std::array<double, simd::width * simd::width> between_{};
};

}  // namespace hinge::detail
