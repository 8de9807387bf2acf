// SPDX-License-Identifier: BSD-3-Clause
// Tests mesh pairs and chains of every family on every engine. Rationals decide verdicts and distances on the library's
// world coordinates; these coordinates are compared with poses in 50 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#if __has_include(<boost/multiprecision/cpp_int.hpp>)
#include "robustness/case.hpp"
#include "robustness/chain_families.hpp"
#include "robustness/exact_triangles.hpp"
#include "robustness/expect_right.hpp"
#include "robustness/mesh_families.hpp"
#include "robustness/run_chain.hpp"
#include "robustness/run_mesh.hpp"

namespace hinge::robustness {
namespace generated_bodies_test {

using test::ChainFamily;
using test::Float50;
using test::MeshFamily;
using test::Random;

using WideVector = std::array<Float50, 3>;

/// A pose in 50 digits: columns of the rotation, then the translation.
struct WidePose {
  std::array<WideVector, 4> column;

  static WidePose of(const Pose& pose) {
    WidePose wide;
    for (int k = 0; k < 3; ++k)
      for (int row = 0; row < 3; ++row)
        wide.column[static_cast<std::size_t>(k)][static_cast<std::size_t>(row)] = pose.rotation(row, k);
    for (int row = 0; row < 3; ++row) wide.column[3][static_cast<std::size_t>(row)] = pose.translation[row];
    return wide;
  }
  WideVector turned(const WideVector& v) const {
    WideVector to;
    for (std::size_t row = 0; row < 3; ++row)
      to[row] = column[0][row] * v[0] + column[1][row] * v[1] + column[2][row] * v[2];
    return to;
  }
  WideVector placed(const WideVector& v) const {
    WideVector to = turned(v);
    for (std::size_t row = 0; row < 3; ++row) to[row] += column[3][row];
    return to;
  }
  /// Returns the product of this pose and b.
  WidePose then(const WidePose& b) const {
    return {{turned(b.column[0]), turned(b.column[1]), turned(b.column[2]), placed(b.column[3])}};
  }
};

/// Returns the pose of a link in its parent: translation to the origin, then rotation about the axis (Rodrigues).
WidePose motion(const ChainLink& link) {
  const WideVector axis{link.axis[0], link.axis[1], link.axis[2]};
  const Float50 length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  const Float50 c = cos(Float50(link.angle)), s = sin(Float50(link.angle));
  WidePose pose;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t row = 0; row < 3; ++row) pose.column[k][row] = (1 - c) * axis[row] * axis[k] / (length * length);
  for (std::size_t k = 0; k < 3; ++k) {
    pose.column[k][k] += c;
    pose.column[k][(k + 1) % 3] += s * axis[(k + 2) % 3] / length;
    pose.column[k][(k + 2) % 3] -= s * axis[(k + 1) % 3] / length;
    pose.column[3][k] = link.origin[k];
  }
  return pose;
}

/// Returns the largest distance between placed corners and their positions in 50 digits.
double largest_error(std::span<const Triangle> placed, const std::vector<Triangle>& local, const WidePose& pose) {
  Float50 worst = 0;
  for (std::size_t k = 0; k < local.size(); ++k)
    for (const auto corner : {&Triangle::a, &Triangle::b, &Triangle::c}) {
      const Vec3 &v = local[k].*corner, &found = placed[k].*corner;
      const WideVector wanted = pose.placed({v[0], v[1], v[2]});
      Float50 squared = 0;
      for (std::size_t row = 0; row < 3; ++row) {
        const Float50 off = wanted[row] - found[static_cast<int>(row)];
        squared += off * off;
      }
      worst = std::max(worst, squared);
    }
  return static_cast<double>(sqrt(worst));
}

/// Returns the true answer for the library's world coordinates. Sets `worst` to the largest share of the error bound
/// that these coordinates use.
Truth truth_of(const MeshPair& pair, double& worst) {
  ModelBuilder<Triangle> builder;
  const auto a = triangles_in(pair.a), b = triangles_in(pair.b);
  const Pose at_a = pose_of(pair.place_a, "a"), at_b = pose_of(pair.place_b, "b");
  builder.add_link(world, Prismatic{}, a);
  builder.add_link(world, Prismatic{}, b);
  auto both = triangles_of<Brute>(builder);
  both.update_poses(std::array{Pose{}, at_a, at_b});
  const auto placed_a = both.placed().first(a.size()), placed_b = both.placed().subspan(a.size());
  for (const double share : {largest_error(placed_a, a, WidePose::of(at_a)) / placed_rounding(pair.a, pair.place_a),
                             largest_error(placed_b, b, WidePose::of(at_b)) / placed_rounding(pair.b, pair.place_b)})
    worst = std::max(worst, share);  // NaN for an empty mesh; max() ignores it
  test::ExactMeshes exact = test::exact_meshes(placed_a, placed_b);
  for (std::size_t p = 1; p < exact.pairs.size(); p += 2) exact.pairs[p] += static_cast<std::uint32_t>(a.size());
  Truth truth;
  truth.of_placed = true;
  truth.hit = !exact.pairs.empty();
  truth.pair_count = exact.pairs.size() / 2;
  truth.pairs = std::move(exact.pairs);
  truth.distance = exact.distance;
  return truth;
}

class MeshFamilies : public testing::TestWithParam<MeshFamily> {};

TEST_P(MeshFamilies, EqualExactAnswers) {
  double worst = 0.0;
  const auto make = [&](Random& random, Case& one) {
    one.input = GetParam().make(random);
    if (!GetParam().refuse) one.truth = truth_of(std::get<MeshPair>(one.input), worst);
    EXPECT_LE(worst, 1.0) << "vertices misplaced";
  };
  expect_family(33, GetParam().name, "mesh_pair", make,
                [&] { return "; vertices misplaced by up to " + std::to_string(worst) + " of the bound"; });
}

INSTANTIATE_TEST_SUITE_P(Generated, MeshFamilies, testing::ValuesIn(test::mesh_families()),
                         [](const auto& family) { return std::string(family.param.name); });

/// The same for the links of a chain.
Truth truth_of(const Chain& chain, double& worst) {
  auto links = hierarchy_of<Brute>(chain);
  const auto placed = links.placed();
  std::vector<WidePose> poses;
  std::vector<std::span<const Triangle>> meshes;
  std::size_t start = 0;
  for (std::size_t k = 0; k < chain.links.size(); ++k) {
    const ChainLink& link = chain.links[k];
    const WidePose own = motion(link);
    poses.push_back(link.parent < 0 ? own : poses[static_cast<std::size_t>(link.parent)].then(own));
    const auto local = triangles_in(link.mesh);
    meshes.push_back(placed.subspan(start, local.size()));
    start += local.size();
    worst = std::max(worst, largest_error(meshes.back(), local, poses.back()) / link_rounding(chain, k));
  }
  Truth truth;
  truth.of_placed = true;
  truth.pair_count = 0;
  const auto& tip = poses.back().column[3];
  truth.tip = Vec3(static_cast<double>(tip[0]), static_cast<double>(tip[1]), static_cast<double>(tip[2]));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (std::size_t j = i + 1; j < meshes.size(); ++j) {
      if (chain.links[j].parent == static_cast<std::int64_t>(i)) continue;
      const auto exact = test::exact_meshes(meshes[i], meshes[j]);
      const bool hit = !exact.pairs.empty();
      truth.link_pairs.push_back({i, j, hit, true, exact.distance, exact.span});
      truth.hit |= hit;
      *truth.pair_count += hit ? 1 : 0;
      if (exact.distance.high < least) truth.closest = {i, j};
      least = std::min(least, exact.distance.high);
    }
  return truth;
}

class ChainFamilies : public testing::TestWithParam<ChainFamily> {};

TEST_P(ChainFamilies, EqualExactAnswers) {
  double worst = 0.0;
  const auto make = [&](Random& random, Case& one) {
    one.input = GetParam().make(random);
    if (!GetParam().refuse) one.truth = truth_of(std::get<Chain>(one.input), worst);
    // An eighth is above the largest share ever observed; the bound itself allows more.
    EXPECT_LE(worst, 0.125) << "links misplaced";
  };
  expect_family(34, GetParam().name, "chain", make,
                [&] { return "; links misplaced by up to " + std::to_string(worst) + " of the bound"; });
}

INSTANTIATE_TEST_SUITE_P(Generated, ChainFamilies, testing::ValuesIn(test::chain_families()),
                         [](const auto& family) { return std::string(family.param.name); });

}  // namespace generated_bodies_test
}  // namespace hinge::robustness

#else
TEST(GeneratedBodies, NeedBoostMultiprecision) { GTEST_SKIP() << "boost/multiprecision was not found (libboost-dev)"; }
#endif
