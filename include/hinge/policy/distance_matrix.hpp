// SPDX-License-Identifier: BSD-3-Clause
// DistanceMatrix: how close is too close. One clearance for all pairs, and thresholds by type.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/core/radius_sum.hpp"

namespace hinge {

/// M of BioCD eq. (1), in the model's length unit. Symmetric, finite, >= 0, and reach(i) + reach(j) >= threshold(i, j)
/// (BioCD eq. (2): reach(i) = max over j of threshold(i, j) / 2).
template <class D>
concept DistanceMatrix = std::copyable<D> && requires(const D& matrix, PrimitiveId i, PrimitiveId j) {
  { matrix.threshold(i, j) }
  noexcept->std::same_as<double>;
  { matrix.reach(i) }
  noexcept->std::same_as<double>;
};

/// Optional refinement: M is the real sum of two radii and a clearance, which no double may hold; threshold(i, j) is
/// that sum rounded. Verdicts are about the real sum where the primitive has a closer_than(p, q, RadiusSum).
template <class D>
concept AdditiveRadii = DistanceMatrix<D> && requires(const D& matrix, PrimitiveId i, PrimitiveId j) {
  { matrix.sum(i, j) }
  noexcept->std::same_as<RadiusSum>;
};

/// Optional refinement: thresholds between primitive i of this model and primitive j of another one.
template <class D>
concept CrossMatrix = DistanceMatrix<D> && requires(const D& matrix, const D& other, PrimitiveId i, PrimitiveId j) {
  { matrix.threshold(i, other, j) }
  noexcept->std::same_as<double>;
  { matrix.compatible(other) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement: thresholds depend on few types, so that engines can look them up by type.
template <class D>
concept TypedThresholdMatrix = DistanceMatrix<D> && requires(const D& matrix, PrimitiveId i, std::size_t type) {
  { matrix.type_count() }
  noexcept->std::same_as<std::size_t>;
  { matrix.type(i) }
  noexcept->std::convertible_to<std::size_t>;
  { matrix.between_types(type, type) }
  noexcept->std::same_as<double>;
};

/// Per primitive of n, 1 or 0: are its thresholds with all others 0?
template <DistanceMatrix D>
std::vector<std::uint8_t> zero_thresholds(const D& matrix, std::size_t n) {
  if constexpr (TypedThresholdMatrix<D>) {
    std::vector<std::uint8_t> zero_type(matrix.type_count(), 1), zero(n);
    for (std::size_t s = 0; s < zero_type.size(); ++s)
      for (std::size_t t = 0; t < zero_type.size(); ++t)
        if (matrix.between_types(s, t) > 0.0) zero_type[s] = 0;
    for (std::size_t i = 0; i < n; ++i) zero[i] = zero_type[matrix.type(id<PrimitiveId>(i))];
    return zero;
  }
  // A reach of 0 says nothing by itself: the other's may cover the threshold of both.
  bool all = true;
  for (std::size_t i = 0; i < n; ++i) all = all && matrix.reach(id<PrimitiveId>(i)) == 0.0;
  return std::vector<std::uint8_t>(n, all ? 1 : 0);
}

/// The same threshold for every pair.
class UniformClearance {
 public:
  /// clearance: a length >= 0, model length unit; else ModelError.
  explicit UniformClearance(double clearance) : clearance_(clearance) {
    if (!is_length(clearance) || clearance < 0.0)
      throw ModelError("clearance " + number_text(clearance) + ": expected a finite length >= 0");
  }

  double threshold(PrimitiveId, PrimitiveId) const noexcept { return clearance_; }
  double threshold(PrimitiveId, const UniformClearance& other, PrimitiveId) const noexcept {
    return std::max(clearance_, other.clearance_);
  }
  bool compatible(const UniformClearance& other) const noexcept { return clearance_ == other.clearance_; }
  /// Half of it, rounded up where half of a denormal is none.
  double reach(PrimitiveId) const noexcept { return std::max(clearance_ / 2, clearance_ - clearance_ / 2); }

 private:
  double clearance_;
};

/// A symmetric table of thresholds between types, and the type of every primitive.
class TypedThresholds {
 public:
  /// types[i] < type_count <= 65536; table is type_count x type_count, row-major, symmetric, lengths >= 0; else
  /// ModelError.
  TypedThresholds(std::vector<std::uint16_t> types, std::size_t type_count, std::vector<double> table);

  double threshold(PrimitiveId i, PrimitiveId j) const noexcept { return threshold(i, *this, j); }
  double threshold(PrimitiveId i, const TypedThresholds& other, PrimitiveId j) const noexcept {
    return data_->table[data_->types[index(i)] * data_->type_count + other.data_->types[index(j)]];
  }
  double reach(PrimitiveId i) const noexcept { return data_->reach[data_->types[index(i)]]; }

  /// Two models can be tested against each other when they use the same table.
  bool compatible(const TypedThresholds& other) const noexcept {
    return data_ == other.data_ || data_->table == other.data_->table;
  }
  std::size_t size() const noexcept { return data_->types.size(); }
  std::size_t type_count() const noexcept { return data_->type_count; }
  std::uint16_t type(PrimitiveId i) const noexcept { return data_->types[index(i)]; }
  double between_types(std::size_t s, std::size_t t) const noexcept { return data_->table[s * data_->type_count + t]; }

 private:
  struct Data {
    std::vector<std::uint16_t> types;
    std::size_t type_count;
    std::vector<double> table;
    std::vector<double> reach;  // per type
  };
  std::shared_ptr<const Data> data_;  // shared by the copies that engines and threads hold
};

inline TypedThresholds::TypedThresholds(std::vector<std::uint16_t> types, std::size_t type_count,
                                        std::vector<double> table) {
  // More types than a type can name would be of no use, and their square could pass for any number.
  constexpr std::size_t most_types = std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1;
  if (type_count > most_types)
    throw ModelError("threshold table: " + std::to_string(type_count) + " types, expected at most " +
                     std::to_string(most_types));
  if (table.size() != type_count * type_count)
    throw ModelError("threshold table: " + std::to_string(table.size()) + " entries, expected " +
                     std::to_string(type_count) + " x " + std::to_string(type_count));
  std::vector<double> reach(type_count, 0.0);
  for (std::size_t s = 0; s < type_count; ++s)
    for (std::size_t t = 0; t < type_count; ++t) {
      const double m = table[s * type_count + t];
      const double mirror = table[t * type_count + s];
      const auto entry = [&] {
        return "threshold table: entry (" + std::to_string(s) + ", " + std::to_string(t) + ") is " + number_text(m);
      };
      if (!is_length(m) || m < 0.0) throw ModelError(entry() + ", expected a finite length >= 0");
      if (m != mirror) throw ModelError(entry() + " but its mirror is " + number_text(mirror));
      reach[s] = std::max(reach[s], m / 2);
    }
  for (std::size_t i = 0; i < types.size(); ++i)
    if (types[i] >= type_count)
      throw ModelError("primitive " + std::to_string(i) + ": type " + std::to_string(types[i]) + ", expected below " +
                       std::to_string(type_count));
  data_ = std::make_shared<const Data>(Data{std::move(types), type_count, std::move(table), std::move(reach)});
}

static_assert(CrossMatrix<UniformClearance> && CrossMatrix<TypedThresholds> && TypedThresholdMatrix<TypedThresholds>);

}  // namespace hinge
