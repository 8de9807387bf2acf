// SPDX-License-Identifier: BSD-3-Clause
// Compares Hinge with FCL on a thousand configurations per model, away from touching.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/policy/different_links.hpp"
#include "oracle/cross_check.hpp"

namespace hinge {
namespace oracle_test {

using test::Random;

/// A bipyramid with six sides, stretched along x.
std::vector<Triangle> spindle(Random& random) {
  const double l = random.uniform(0.3, 0.6), w = random.uniform(0.05, 0.15);
  const Vec3 tip(l, 0, 0), tail(-0.1, 0, 0);
  std::vector<Triangle> triangles;
  const int sides = 6;
  for (int k = 0; k < sides; ++k) {
    const auto corner = [&](int n) {
      const double angle = 2 * std::numbers::pi * n / sides;
      return Vec3(0.4 * l, w * std::cos(angle), w * std::sin(angle));
    };
    triangles.push_back({tip, corner(k), corner(k + 1)});
    triangles.push_back({tail, corner(k + 1), corner(k)});
  }
  return triangles;
}

TEST(FclOracle, AgreesOnMeshRobots) {
  std::size_t compared = 0, colliding = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    ModelBuilder<Triangle> build;
    const std::size_t links = seed == 0 ? 2 : 5;  // the first robot has two links
    LinkId parent = world;
    std::vector<std::pair<LinkId, LinkId>> neighbours;
    for (std::size_t k = 0; k < links; ++k) {
      Pose origin;
      origin.translation = Vec3(k == 0 ? 0.0 : 0.35, 0, 0);
      const LinkId link =
          build.add_link(parent, Revolute{random.vector(1.0), Vec3::Zero(), origin, {}}, spindle(random));
      if (k > 0 && links > 2) neighbours.emplace_back(parent, link);
      parent = link;
    }
    const auto model = build.finish();
    const DifferentLinks filter({model.links().begin(), model.links().end()}, neighbours);
    const auto admits = [&](LinkId a, LinkId b) {
      for (const auto& [p, q] : neighbours)
        if ((p == a && q == b) || (p == b && q == a)) return false;
      return true;
    };
    Hierarchy lazy(model, filter, UniformClearance{0.0});
    Hierarchy<Triangle, DifferentLinks, UniformClearance, Brute> brute(model, filter, UniformClearance{0.0});
    oracle::TriangleOracle oracle(model);
    std::vector<double> q(lazy.dof_count());
    for (int step = 0; step < 100; ++step) {
      for (double& value : q) value = random.uniform(-3.0, 3.0);
      lazy.update(q);
      brute.update(q);
      compared += oracle.check(lazy, 1e-6, admits) ? 1 : 0;
      oracle.check(brute, 1e-6, admits);
      colliding += lazy.self_collides() ? 1 : 0;
      if (HasFailure()) return;
    }
  }
  std::printf("compared %zu configurations, %zu colliding\n", compared, colliding);
  EXPECT_GE(compared, 950U);
  EXPECT_GE(colliding, 50U);
}

TEST(FclOracle, AgreesOnPointModels) {
  std::size_t compared = 0, colliding = 0;
  const auto make = [](Random& random, const Vec3&, const Vec3&) { return Point{random.vector(3.5)}; };
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto model = test::random_model(random, 20, 4, true, make);
    const test::ExcludedPairs filter(model.size(), random, 6);
    const double m = random.uniform(0.2, 0.8);
    Hierarchy lazy(model, filter, UniformClearance{m});
    oracle::PointOracle oracle(lazy.model(), filter, m);
    std::vector<double> q(lazy.dof_count());
    for (int step = 0; step < 50; ++step) {
      for (double& value : q) value = random.uniform(-3.0, 3.0);
      lazy.update(q);
      compared += oracle.check(lazy, 1e-9) ? 1 : 0;
      colliding += lazy.self_collides() ? 1 : 0;
      if (HasFailure()) return;
    }
  }
  std::printf("compared %zu configurations, %zu colliding\n", compared, colliding);
  EXPECT_GE(compared, 990U);
  EXPECT_GE(colliding, 100U);
}

TEST(FclOracle, AgreesOnAProteinOfOneType) {
  const molecular::Molecule protein(
      molecular::read_structure(std::string(HINGE_SOURCE_DIR) + "/molecular/data/1ubq.pdb"));
  const molecular::BondExclusions filter(protein.structure(), 4);
  const double m = 2.5;
  const auto selection = protein.select(molecular::select_torsions(protein, "count:5", false));
  Hierarchy lazy(protein.model(), selection, filter, UniformClearance{m});
  Hierarchy<Point, molecular::BondExclusions, UniformClearance, Brute> brute(protein.model(), selection, filter,
                                                                             UniformClearance{m});
  oracle::PointOracle oracle(lazy.model(), filter, m);
  std::size_t compared = 0, colliding = 0;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const auto q = molecular::sample_configuration({1, k % 2 == 0 ? 0.02 : 1.0}, k, lazy.dof_count());
    lazy.update(q);
    brute.update(q);
    compared += oracle.check(lazy, 1e-9) ? 1 : 0;
    if (k % 10 == 0) oracle.check(brute, 1e-9);
    colliding += lazy.self_collides() ? 1 : 0;
    if (HasFailure()) return;
  }
  std::printf("seed 1: compared %zu configurations, %zu colliding\n", compared, colliding);
  EXPECT_GE(compared, 990U);
  EXPECT_GE(colliding, 400U);
  EXPECT_LT(colliding, 1000U);
}

}  // namespace oracle_test
}  // namespace hinge
