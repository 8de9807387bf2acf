// SPDX-License-Identifier: BSD-3-Clause
// Random models of points with given rigid group sizes, to test block boundaries.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/model/model.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::test {

/// How the primitives of a model are distributed over its rigid groups.
enum class GroupSizes : std::uint8_t {
  ones,
  fifteens,
  sixteens,
  seventeens,
  static_giant,   ///< nearly all on the world, a few single-point links after it
  two_giants,     ///< two moving groups of about half the model each, a few other links between and after them
  static_moving,  ///< half on the world, half on the last link
  mixed           ///< 0 to 40 primitives per link
};
inline constexpr std::array all_group_sizes = {
    GroupSizes::ones,         GroupSizes::fifteens,   GroupSizes::sixteens,      GroupSizes::seventeens,
    GroupSizes::static_giant, GroupSizes::two_giants, GroupSizes::static_moving, GroupSizes::mixed};

/// Number of primitives per link, world first; the sum is n.
inline std::vector<std::size_t> share_out(std::size_t n, GroupSizes sizes, Random& random) {
  std::vector<std::size_t> links{0};
  const auto in_steps_of = [&](std::size_t step) {
    for (std::size_t left = n; left > 0; left -= std::min(step, left)) links.push_back(std::min(step, left));
  };
  const std::size_t few = std::min<std::size_t>(n / 3, 12);
  switch (sizes) {
    case GroupSizes::ones: in_steps_of(1); break;
    case GroupSizes::fifteens: in_steps_of(15); break;
    case GroupSizes::sixteens: in_steps_of(16); break;
    case GroupSizes::seventeens: in_steps_of(17); break;
    case GroupSizes::static_giant:
      links[0] = n - few;
      links.insert(links.end(), few, 1);
      break;
    case GroupSizes::two_giants:
      links.push_back((n - few) / 2);
      links.insert(links.end(), few / 2, 1);
      links.push_back(n - few - (n - few) / 2);
      links.insert(links.end(), few - few / 2, 1);
      break;
    case GroupSizes::static_moving:
      links[0] = n / 2;
      links.push_back(0);
      links.push_back(n - n / 2);
      break;
    case GroupSizes::mixed:
      for (std::size_t left = n; left > 0;) {
        const std::size_t size = std::min(left, random.below(random.one_in(3) ? 41 : 8));
        links.push_back(size);
        left -= size;
      }
      break;
  }
  return links;
}

/// A random tree of links with the given numbers of points per link and one DOF per joint. The reference has about
/// one point per eight cubic units. Some points coincide, and some lie on joint axes.
inline Model<Point> sized_model(const std::vector<std::size_t>& per_link, Random& random) {
  ModelBuilder<Point> builder;
  std::size_t n = 0;
  for (const std::size_t size : per_link) n += size;
  const double space = std::cbrt(static_cast<double>(n)) + 0.5;
  std::vector<LinkId> links{world};
  for (std::size_t l = 0; l < per_link.size(); ++l) {
    const Vec3 axis = random.vector(1.0).normalized(), middle = random.vector(space);
    if (l > 0) {
      Pose origin;
      if (random.one_in(3)) origin = random.pose(1.0);
      const LinkId parent = random.one_in(3) ? links[random.below(links.size())] : links.back();
      Joint joint = Revolute{axis, middle, origin, {}};
      if (random.one_in(8)) joint = Prismatic{axis, origin, {}};
      links.push_back(builder.add_link(parent, joint));
    }
    const double size = std::cbrt(static_cast<double>(per_link[l])) + 0.5;
    Vec3 last = middle;
    for (std::size_t k = 0; k < per_link[l]; ++k) {
      if (!random.one_in(30)) last = middle + random.vector(size);
      if (random.one_in(20)) last = middle + axis * random.uniform(-size, size);
      builder.add_primitive(links.back(), Point{last});
    }
  }
  return builder.finish();
}

/// Thresholds from `table` (count x count) with a random type for each of n primitives.
inline TypedThresholds dealt_thresholds(std::size_t n, std::size_t count, const std::vector<double>& table,
                                        Random& random) {
  std::vector<std::uint16_t> type(n);
  for (auto& t : type) t = static_cast<std::uint16_t>(random.below(count));
  return {std::move(type), count, table};
}

/// A symmetric count x count table of thresholds; an entry is 0 with probability zeros / 10.
inline std::vector<double> random_table(std::size_t count, std::size_t zeros, Random& random) {
  std::vector<double> table(count * count);
  for (std::size_t s = 0; s < count; ++s)
    for (std::size_t t = 0; t <= s; ++t)
      table[s * count + t] = table[t * count + s] = random.below(10) < zeros ? 0.0 : random.uniform(0.0, 1.6);
  return table;
}

}  // namespace hinge::test
