// SPDX-License-Identifier: BSD-3-Clause
// KnownPair and NearPairs: the pairs of a state that collide, or that rounding alone could make collide.
#pragma once

#include <algorithm>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/query/pair_threshold.hpp"
#include "hinge/detail/query/sort_hits.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// A pair with d - M below a tolerance.
struct KnownPair {
  Hit hit;
  bool collides = false;
};

inline bool any_collides(const std::vector<KnownPair>& known) noexcept {
  return std::any_of(known.begin(), known.end(), [](const KnownPair& pair) { return pair.collides; });
}

/// Writes the collisions among `known` into `hits`, sorted by (first, second). Returns `hits`.
inline const std::vector<Hit>& list_collisions(const std::vector<KnownPair>& known, std::vector<Hit>& hits) {
  hits.clear();
  for (const KnownPair& pair : known)
    if (pair.collides) hits.push_back(pair.hit);
  sort_hits(hits);
  return hits;
}

/// Decides a pair exactly, and stores it in `known` if d - M < tolerance. Returns true if it collides.
template <Primitive P, DistanceMatrix D>
bool judge(PrimitiveId first, PrimitiveId second, const P& p, const P& q, const D& matrix, double tolerance,
           std::vector<KnownPair>& known) {
  const auto m = threshold_of(matrix, first, second);
  if (!closer_than(p, q, m + tolerance)) return false;
  const bool collides = closer_than(p, q, m);
  known.push_back({{first, second, collides && m > 0.0 ? distance(p, q) : 0.0, m}, collides});
  return collides;
}

/// A collector of known pairs. place(i) returns the placed primitive i. It stops at the first collision unless `all`.
template <DistanceMatrix D, class Place>
class NearPairs {
 public:
  static constexpr bool ranks = false;
  NearPairs(const D& matrix, double tolerance, bool all, const Place& place, std::vector<KnownPair>& known)
      : matrix_(matrix), tolerance_(tolerance), all_(all), place_(place), known_(known) {}
  void add(const Hit& hit) {
    if (judge(hit.first, hit.second, place_(hit.first), place_(hit.second), matrix_, tolerance_, known_))
      collides_ = true;
  }
  double cutoff() const noexcept { return tolerance_; }
  bool done() const noexcept { return collides_ && !all_; }
  bool collides() const noexcept { return collides_; }

 private:
  const D& matrix_;
  double tolerance_;
  bool all_;
  const Place& place_;
  std::vector<KnownPair>& known_;
  bool collides_ = false;
};

}  // namespace hinge::detail
