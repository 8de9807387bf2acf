// SPDX-License-Identifier: BSD-3-Clause
// DistanceMatrix: the collision threshold of each pair. UniformClearance has one threshold for all pairs,
// TypedThresholds one per pair of types.
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

/// threshold(i, j) is M of BioCD eq. (1), in the model's length unit: symmetric, finite and >= 0. reach(i) is the
/// threshold radius of primitive i, and reach(i) + reach(j) >= threshold(i, j) (BioCD eq. (2): reach(i) = max over j of
/// threshold(i, j) / 2).
template <class D>
concept DistanceMatrix = std::copyable<D> && requires(const D& matrix, PrimitiveId i, PrimitiveId j) {
  { matrix.threshold(i, j) }
  noexcept->std::same_as<double>;
  { matrix.reach(i) }
  noexcept->std::same_as<double>;
};

/// Optional refinement: M is the real sum of two radii and a clearance. A double may not hold that sum, so threshold(i,
/// j) is the rounded sum and sum(i, j) the exact terms. Primitives with closer_than(p, q, RadiusSum) are tested against
/// the exact sum.
template <class D>
concept AdditiveRadii = DistanceMatrix<D> && requires(const D& matrix, PrimitiveId i, PrimitiveId j) {
  { matrix.sum(i, j) }
  noexcept->std::same_as<RadiusSum>;
};

/// Optional refinement: thresholds between primitive i of this model and primitive j of another model.
/// compatible(other) returns false when the two matrices cannot be combined.
template <class D>
concept CrossMatrix = DistanceMatrix<D> && requires(const D& matrix, const D& other, PrimitiveId i, PrimitiveId j) {
  { matrix.threshold(i, other, j) }
  noexcept->std::same_as<double>;
  { matrix.compatible(other) }
  noexcept->std::same_as<bool>;
};

/// Optional refinement: the threshold depends on the types of the two primitives, so engines can look it up by type.
template <class D>
concept TypedThresholdMatrix = DistanceMatrix<D> && requires(const D& matrix, PrimitiveId i, std::size_t type) {
  { matrix.type_count() }
  noexcept->std::same_as<std::size_t>;
  { matrix.type(i) }
  noexcept->std::convertible_to<std::size_t>;
  { matrix.between_types(type, type) }
  noexcept->std::same_as<double>;
};

/// Returns n values, one per primitive: 1 if its thresholds with all primitives are 0, otherwise 0.
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
  // reach(i) == 0 alone proves nothing: reach(j) may cover the whole threshold of the pair.
  bool all = true;
  for (std::size_t i = 0; i < n; ++i) all = all && matrix.reach(id<PrimitiveId>(i)) == 0.0;
  return std::vector<std::uint8_t>(n, all ? 1 : 0);
}

/// One threshold for every pair. Copies are independent.
class UniformClearance {
 public:
  /// clearance: a finite length >= 0, model length unit; otherwise ModelError.
  explicit UniformClearance(double clearance) : clearance_(clearance) {
    if (!is_length(clearance) || clearance < 0.0)
      throw ModelError("clearance " + number_text(clearance) + ": expected a finite length >= 0");
  }

  /// Returns the clearance, model length unit.
  double threshold(PrimitiveId, PrimitiveId) const noexcept { return clearance_; }
  /// Returns the larger clearance of the two models, model length unit.
  double threshold(PrimitiveId, const UniformClearance& other, PrimitiveId) const noexcept {
    return std::max(clearance_, other.clearance_);
  }
  /// Returns true when both clearances are equal.
  bool compatible(const UniformClearance& other) const noexcept { return clearance_ == other.clearance_; }
  /// Returns half the clearance. It is rounded up, because half of the smallest denormal rounds to 0.
  double reach(PrimitiveId) const noexcept { return std::max(clearance_ / 2, clearance_ - clearance_ / 2); }

 private:
  double clearance_;
};

/// A symmetric table of thresholds between types, and one type per primitive. Copies share constant data.
class TypedThresholds {
 public:
  /// types: one value below type_count per primitive. type_count: at most 65536. table: type_count x type_count lengths
  /// >= 0, row-major and symmetric, model length unit. ModelError: any of these conditions fails.
  TypedThresholds(std::vector<std::uint16_t> types, std::size_t type_count, std::vector<double> table);

  /// Returns the threshold of two primitives of one model, model length unit.
  double threshold(PrimitiveId i, PrimitiveId j) const noexcept { return threshold(i, *this, j); }
  /// Returns the threshold of primitive i and primitive j of another model, model length unit.
  double threshold(PrimitiveId i, const TypedThresholds& other, PrimitiveId j) const noexcept {
    return data_->table[data_->types[index(i)] * data_->type_count + other.data_->types[index(j)]];
  }
  /// Returns half the largest threshold of the type of i, model length unit.
  double reach(PrimitiveId i) const noexcept { return data_->reach[data_->types[index(i)]]; }

  /// Returns true when both models use equal tables. Only then can they be tested against each other.
  bool compatible(const TypedThresholds& other) const noexcept {
    return data_ == other.data_ || data_->table == other.data_->table;
  }
  /// Returns the number of primitives.
  std::size_t size() const noexcept { return data_->types.size(); }
  /// Returns the number of types.
  std::size_t type_count() const noexcept { return data_->type_count; }
  /// Returns the type of primitive i.
  std::uint16_t type(PrimitiveId i) const noexcept { return data_->types[index(i)]; }
  /// Returns the threshold between types s and t, model length unit.
  double between_types(std::size_t s, std::size_t t) const noexcept { return data_->table[s * data_->type_count + t]; }

 private:
  struct Data {
    std::vector<std::uint16_t> types;
    std::size_t type_count;
    std::vector<double> table;
    std::vector<double> reach;  // per type
  };
  std::shared_ptr<const Data> data_;  // copies in engines and threads share it
};

inline TypedThresholds::TypedThresholds(std::vector<std::uint16_t> types, std::size_t type_count,
                                        std::vector<double> table) {
  // A type has 16 bits. Without this limit the product type_count * type_count could also overflow and match
  // table.size().
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
      reach[s] = std::max({reach[s], m / 2, m - m / 2});  // half a denormal may be rounded down
    }
  for (std::size_t i = 0; i < types.size(); ++i)
    if (types[i] >= type_count)
      throw ModelError("primitive " + std::to_string(i) + ": type " + std::to_string(types[i]) + ", expected below " +
                       std::to_string(type_count));
  data_ = std::make_shared<const Data>(Data{std::move(types), type_count, std::move(table), std::move(reach)});
}

static_assert(CrossMatrix<UniformClearance> && CrossMatrix<TypedThresholds> && TypedThresholdMatrix<TypedThresholds>);

}  // namespace hinge
