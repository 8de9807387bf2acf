// SPDX-License-Identifier: BSD-3-Clause
// Run-time checks for custom policies: the requirements of the concepts beyond syntax. Each check returns the broken
// laws, one sentence each. An empty list means that the samples satisfy all laws.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::laws {

/// Broken laws, one English sentence each, at most 20.
using Violations = std::vector<std::string>;

/// Relative tolerance for lengths, as a fraction of the largest coordinate. It allows a few dozen roundings. A wrong
/// formula deviates by much more.
inline constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

namespace detail {

/// Limit on the number of reported violations.
inline constexpr std::size_t most_told = 20;

inline void require(bool kept, Violations& broken, const auto& sentence) {
  if (!kept && broken.size() < most_told) broken.push_back(sentence());
}

inline double magnitude(const Aabb& box) {
  double largest = 0.0;
  for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.lower[k]), std::abs(box.upper[k])});
  return largest;
}

inline std::string two(const char* what, std::size_t i, std::size_t j) {
  return std::string(what) + " " + std::to_string(i) + " and " + std::to_string(j);
}

/// The box around a primitive's hull, its radius included.
template <HasHull P>
Aabb box_of_hull(const P& p) {
  Aabb box;
  for (const Vec3& x : p.hull()) box.extend(Aabb(x));
  return box.inflated(p.hull_radius());
}

/// p and q are d apart. Two points of their hulls may be closer only if the hulls are larger than the primitives.
template <HasHull P>
void check_hulls(const P& p, const P& q, double d, double tolerance, const auto& require) {
  require(d >= separation(box_of_hull(p), box_of_hull(q)) - tolerance,
          "they are closer than their hulls, so the hulls do not contain them");
  const double radii = p.hull_radius() + q.hull_radius();
  for (const Vec3& x : p.hull())
    for (const Vec3& y : q.hull()) {
      const double gap = std::max(0.0, norm(Vec3(x - y)) - radii);
      require(hull_size<P> != 1 || d >= gap - tolerance,
              "they are closer than their hulls, so the hulls do not contain them");
      require(!FillsHull<P> || d <= gap + tolerance,
              "they are farther apart than their hulls, so they do not fill them");
    }
}

template <PairFilter F>
void check_pair(const F& filter, PrimitiveId i, PrimitiveId j, std::span<const LinkId> links, Violations& broken) {
  const bool admitted = filter.admits(i, j);
  const auto names = [&] { return two("primitives", index(i), index(j)); };
  require(filter.admits(i, j) == admitted && filter.admits(j, i) == admitted, broken, [&] {
    return names() + ": admits answers " + (admitted ? "true" : "false") +
           ", but a repeated or swapped call answers differently; expected one answer";
  });
  if constexpr (ListsExclusions<F>) {
    const std::span<const PrimitiveId> list = filter.excluded(i);
    require(!(admitted && std::find(list.begin(), list.end(), j) != list.end()), broken, [&] {
      return names() + ": excluded(" + std::to_string(index(i)) + ") lists the second, but admits answers true";
    });
  }
  if constexpr (AdmitsLinks<F>) {
    if (links.empty()) return;
    const LinkId a = links[index(i)], b = links[index(j)];
    if (a == b) return;
    require(filter.admits(a, b) == filter.admits(b, a), broken, [&] {
      return two("links", index(a), index(b)) + ": admits answers differently when the links are swapped";
    });
    require(!admitted || filter.admits(a, b), broken, [&] {
      return names() + ": admits answers true, but rejects all pairs of their " + two("links", index(a), index(b));
    });
  }
}

}  // namespace detail

/// Checks the laws of Primitive. The distance of each pair of samples is symmetric, >= 0, 0 from a sample to itself, at
/// least the gap of the bounds, and constant under a common pose. closer_than follows the distance and is monotone in
/// its threshold. Closest points are at that distance. Hulls move with the primitives, hold them, and are filled by
/// them if fills_hull says so. samples: a few dozen typical values, including special cases (zero size, flat,
/// touching).
template <Primitive P>
Violations check_primitive(std::span<const P> samples, std::span<const Pose> poses) {
  Violations broken;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const P& p = samples[i];
    const auto require = [&](bool kept, const char* sentence) {
      detail::require(kept, broken, [&] { return "sample " + std::to_string(i) + ": " + sentence; });
    };
    require(squared_distance(p, p) == 0.0, "its squared_distance to itself is not 0");
    const Aabb same = p.placed(Pose{}).bounds();
    require(same.contains(p.bounds()) && p.bounds().contains(same), "the identity pose changes its bounds");
    if constexpr (HasHull<P>)
      for (const Pose& pose : poses) {
        const P moved = p.placed(pose);
        const double tolerance = rounding * (detail::magnitude(p.bounds()) + detail::magnitude(moved.bounds()));
        require(moved.hull_radius() == p.hull_radius(), "a pose changes its hull_radius");
        for (std::size_t k = 0; k < hull_size<P>; ++k)
          require(norm(Vec3(pose * p.hull()[k] - moved.hull()[k])) <= tolerance, "its hull does not move with it");
      }
  }
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t j = 0; j < samples.size(); ++j) {
      const P &p = samples[i], &q = samples[j];
      const auto require = [&](bool kept, const char* sentence) {
        detail::require(kept, broken, [&] { return detail::two("samples", i, j) + ": " + sentence; });
      };
      const double d = std::sqrt(squared_distance(p, q));
      const double tolerance = rounding * (detail::magnitude(p.bounds()) + detail::magnitude(q.bounds()));
      const auto near = [](double x, double y, double within) { return std::abs(x - y) <= within; };
      require(d >= 0.0, "squared_distance is negative or not a number");
      require(near(d, std::sqrt(squared_distance(q, p)), tolerance), "squared_distance differs when they are swapped");
      require(d >= separation(p.bounds(), q.bounds()) - tolerance,
              "they are closer than their bounds, so the bounds do not contain them");
      require(closer_than(p, q, d + tolerance + 1e-3 * d), "closer_than is false for a threshold above their distance");
      require(!(d > tolerance) || !closer_than(p, q, d - std::min(d, tolerance + 1e-3 * d)),
              "closer_than is true for a threshold below their distance");
      require(closer_than(p, q, d) == closer_than(q, p, d),
              "closer_than answers an exact tie differently when they are swapped");
      for (const Pose& pose : poses) {
        const P a = p.placed(pose), b = q.placed(pose);
        const double moved = rounding * (detail::magnitude(a.bounds()) + detail::magnitude(b.bounds())) + tolerance;
        require(near(std::sqrt(squared_distance(a, b)), d, moved), "their distance changes under a common pose");
        if constexpr (HasHull<P>) detail::check_hulls(a, b, d, moved, require);
      }
      if constexpr (HasClosestPoints<P>) {
        const auto [x, y] = closest_points(p, q);
        require(near(std::sqrt(squared_norm(Vec3(x - y))), d, tolerance),
                "the distance of their closest_points differs from squared_distance");
        require(separation(Aabb(x), p.bounds()) <= tolerance && separation(Aabb(y), q.bounds()) <= tolerance,
                "their closest_points lie outside the bounds");
      }
    }
  return broken;
}

/// Checks the laws of PairFilter for `primitives` primitives. admits is symmetric and repeatable. excluded(i) is
/// sorted, has no duplicates, does not contain i, and lists only primitives that admits rejects. A pair of links is
/// rejected only when admits rejects all its pairs. links: the link of every primitive (Model::links()); may be empty
/// when the filter does not use links.
template <PairFilter F>
Violations check_pair_filter(const F& filter, std::size_t primitives, std::span<const LinkId> links = {}) {
  Violations broken;
  if constexpr (ListsExclusions<F>)
    for (std::size_t i = 0; i < primitives; ++i) {
      const std::span<const PrimitiveId> list = filter.excluded(id<PrimitiveId>(i));
      const auto require = [&](bool kept, const char* sentence) {
        detail::require(kept, broken, [&] { return "excluded(" + std::to_string(i) + ") " + sentence; });
      };
      require(std::adjacent_find(list.begin(), list.end(), [](auto a, auto b) { return !(a < b); }) == list.end(),
              "is not sorted, or lists a primitive twice");
      require(std::find(list.begin(), list.end(), id<PrimitiveId>(i)) == list.end(), "lists the primitive itself");
      require(list.empty() || index(list.back()) < primitives, "lists a primitive that does not exist");
    }
  for (std::size_t i = 0; i < primitives; ++i)
    for (std::size_t j = 0; j < primitives; ++j)
      if (i != j) detail::check_pair(filter, id<PrimitiveId>(i), id<PrimitiveId>(j), links, broken);
  return broken;
}

/// Checks the laws of pairs for a model of any size: all pairs of a small model; for a large model the listed pairs and
/// a sample, the same in every run. Hierarchy calls it when compiled without NDEBUG. links: the link of every
/// primitive.
template <PairFilter F>
Violations check_refinements(const F& filter, std::span<const LinkId> links) {
  constexpr std::size_t most_pairs = 4096, most_listed = 65536;
  Violations broken;
  const std::size_t n = links.size();
  if (n * (n - 1) / 2 <= most_pairs || n < 2) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        detail::check_pair(filter, id<PrimitiveId>(i), id<PrimitiveId>(j), links, broken);
    return broken;
  }
  SampleStream random(1, 0);
  for (std::size_t k = 0; k < most_pairs; ++k) {
    const std::size_t i = random.bits() % n, j = random.bits() % n;
    if (i != j) detail::check_pair(filter, id<PrimitiveId>(i), id<PrimitiveId>(j), links, broken);
  }
  if constexpr (ListsExclusions<F>) {
    std::size_t asked = 0;
    for (std::size_t i = 0; i < n && asked < most_listed; ++i)
      for (const PrimitiveId j : std::span<const PrimitiveId>(filter.excluded(id<PrimitiveId>(i)))) {
        if (++asked > most_listed) break;
        detail::check_pair(filter, id<PrimitiveId>(i), j, links, broken);
      }
  }
  return broken;
}

/// The same for a filter between two models. links, other_links: the links of their primitives. The filter may be
/// asymmetric and lists no exclusions.
template <PairFilter G>
Violations check_refinements(const G& across, std::span<const LinkId> links, std::span<const LinkId> other_links) {
  Violations broken;
  if constexpr (AdmitsLinks<G>) {
    constexpr std::size_t most_pairs = 256;
    SampleStream random(1, 0);
    for (std::size_t k = 0; k < most_pairs && !links.empty() && !other_links.empty(); ++k) {
      const std::size_t i = random.bits() % links.size(), j = random.bits() % other_links.size();
      if (!across.admits(links[i], other_links[j]))
        detail::require(!across.admits(id<PrimitiveId>(i), id<PrimitiveId>(j)), broken, [&] {
          return detail::two("primitives", i, j) +
                 " of the two models: admits answers true, but rejects all pairs of " +
                 detail::two("links", index(links[i]), index(other_links[j]));
        });
    }
  }
  return broken;
}

/// Checks the laws of DistanceMatrix for `primitives` primitives: thresholds are symmetric, finite and >= 0, and
/// reach(i) + reach(j) >= threshold(i, j).
template <DistanceMatrix D>
Violations check_distance_matrix(const D& matrix, std::size_t primitives) {
  Violations broken;
  for (std::size_t i = 0; i < primitives; ++i)
    for (std::size_t j = 0; j < primitives; ++j) {
      const auto a = id<PrimitiveId>(i), b = id<PrimitiveId>(j);
      const double m = matrix.threshold(a, b);
      const auto require = [&](bool kept, const std::string& sentence) {
        detail::require(kept, broken, [&] { return detail::two("primitives", i, j) + ": " + sentence; });
      };
      require(is_finite(m) && m >= 0.0, "the threshold is " + number_text(m) + ", expected a finite length >= 0");
      require(m == matrix.threshold(b, a), "the threshold differs when they are swapped");
      require(matrix.reach(a) + matrix.reach(b) >= m, "the sum of their reaches is below the threshold");
    }
  return broken;
}

/// Checks the laws of Collector: the cutoff never grows, and a collector that is done stays done, for any sequence of
/// hits.
template <Collector C>
Violations check_collector(C collector, std::span<const Hit> hits) {
  Violations broken;
  double cutoff = collector.cutoff();
  bool done = collector.done();
  for (std::size_t k = 0; k < hits.size(); ++k) {
    collector.add(hits[k]);
    const auto require = [&](bool kept, const char* sentence) {
      detail::require(kept, broken, [&] { return "hit " + std::to_string(k) + ": " + sentence; });
    };
    require(collector.cutoff() <= cutoff, "the cutoff grew");
    require(!done || collector.done(), "the collector was done, but is not done after another hit");
    cutoff = collector.cutoff();
    done = collector.done();
  }
  return broken;
}

}  // namespace hinge::laws
