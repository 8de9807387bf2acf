// SPDX-License-Identifier: BSD-3-Clause
// Random chains and trees of small meshes by family, and invalid chains.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "robustness/case.hpp"
#include "robustness/family.hpp"

namespace hinge::test {

using robustness::Chain;
using robustness::ChainLink;

using ChainFamily = Family<Chain>;

inline std::vector<double> three(double x, double y, double z) { return {x, y, z}; }

/// Returns a tetrahedron along x from `from` to `to`.
inline robustness::Mesh spike(double from, double to, double width) {
  return {{from, -width, -width, from, width, -width, from, 0.0, width, to, 0.0, 0.0},
          {0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3}};
}

/// Returns a link with its frame at x = 1 of its parent's frame; a first link is at the world's origin.
inline ChainLink link_of(std::int64_t parent, std::vector<double> axis, double angle, robustness::Mesh mesh) {
  return {parent, three(parent < 0 ? 0.0 : 1.0, 0.0, 0.0), std::move(axis), angle, std::move(mesh)};
}

/// Returns an integer axis; its length is rarely a double.
inline std::vector<double> any_axis(Random& r) {
  const auto one = [&] { return static_cast<double>(r.below(7)) - 3.0; };
  const double x = one(), y = one();
  return three(x, y, 4.0);
}

inline Chain random_arm(Random& r) {
  Chain chain;
  for (std::size_t k = 0, n = 3 + r.below(4); k < n; ++k)
    chain.links.push_back(link_of(static_cast<std::int64_t>(k) - 1, any_axis(r), r.uniform(-2.5, 2.5),
                                  spike(0.125, 0.875, r.uniform(0.05, 0.4))));
  return chain;
}

/// Returns a chain with one angle that is very large, very small, or a rounded full or half turn.
inline Chain angle_extremes(Random& r) {
  constexpr double pi = std::numbers::pi;
  constexpr std::array<double, 10> angles{1e6, -1e6, pi, -pi, 1e-12, 2 * pi, 0.0, 1e22, 0x1p-1074, -1e-300};
  Chain chain;
  const double bend = r.uniform(-1.5, 1.5);
  for (std::int64_t k = 0; k < 5; ++k)
    chain.links.push_back(link_of(k - 1, three(0, 0, 1), bend, spike(0.125, 0.875, 0.05)));
  chain.links[r.below(5)].angle = angles[r.below(angles.size())];
  if (r.one_in(2)) chain.links[2].axis = any_axis(r);
  return chain;
}

/// Returns a polygon whose last link reaches the first: with a gap, touching up to rounding, or overlapping.
inline Chain ring_closure(Random& r) {
  Chain chain;
  const auto corners = static_cast<std::int64_t>(3 + r.below(6));
  const double turn = 2 * std::numbers::pi / static_cast<double>(corners);
  const double off = r.one_in(3) ? 0.0 : r.uniform(-1.0, 1.0) * std::pow(10.0, r.uniform(-15.0, -2.0));
  for (std::int64_t k = 0; k < corners; ++k)
    chain.links.push_back(
        link_of(k - 1, three(0, 0, 1), k == 0 ? 0.0 : turn + off, spike(0.0, 1.0, r.uniform(0.05, 0.2))));
  return chain;
}

/// Returns a chain of flat links that rotate about x, y and z in turn.
inline Chain long_chain(Random& r) {
  Chain chain;
  const auto n = static_cast<std::int64_t>(12 + r.below(13));
  for (std::int64_t k = 0; k < n; ++k)
    chain.links.push_back(link_of(k - 1, three(k % 3 == 0, k % 3 == 1, k % 3 == 2), r.uniform(-1.5, 1.5),
                                  {{-0.375, 0.0, 0.0, 0.375, 0.0, 0.0, 0.0, r.uniform(0.25, 1.5), 0.0}, {0, 1, 2}}));
  return chain;
}

/// Returns a tree in which every link has up to two children.
inline Chain branched_tree(Random& r) {
  Chain chain;
  const auto n = static_cast<std::int64_t>(4 + r.below(4));
  for (std::int64_t k = 0; k < n; ++k) {
    chain.links.push_back(link_of(k == 0 ? -1 : (k - 1) / 2, three(1, static_cast<double>(k % 3), 2),
                                  r.uniform(-2.0, 2.0), spike(-0.45, 0.45, 0.2)));
    chain.links.back().origin[1] = k % 2 == 0 ? -0.4 : 0.4;
  }
  return chain;
}

inline Chain chains_to_refuse(Random& r) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  Chain chain = random_arm(r);
  const std::size_t at = r.below(chain.links.size());
  ChainLink& link = chain.links[at];
  switch (r.below(7)) {
    case 0: link.angle = r.one_in(2) ? nan : infinity; break;
    case 1: link.axis = three(0, 0, 0); break;
    case 2: link.axis[r.below(3)] = r.one_in(2) ? nan : infinity; break;
    case 3: link.origin[r.below(3)] = r.one_in(2) ? nan : -infinity; break;
    case 4: link.parent = static_cast<std::int64_t>(at + r.below(3)); break;
    case 5: link.mesh.v[r.below(12)] = nan; break;
    default: link.mesh.f[r.below(12)] = r.one_in(2) ? 4 : -1; break;
  }
  return chain;
}

inline const std::vector<ChainFamily>& chain_families() {
  static const std::vector<ChainFamily> all{{"random_arm", random_arm},       {"angle_extremes", angle_extremes},
                                            {"ring_closure", ring_closure},   {"long_chain", long_chain},
                                            {"branched_tree", branched_tree}, {"must_refuse", chains_to_refuse, true}};
  return all;
}

}  // namespace hinge::test
