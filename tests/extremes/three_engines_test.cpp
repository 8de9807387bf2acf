// SPDX-License-Identifier: BSD-3-Clause
// Compiles the engines for the other files of this folder, and tests that they agree on ordinary input.
#include "extremes/three_engines.hpp"

#include <gtest/gtest.h>

#include "engine/random_mechanism.hpp"

namespace hinge::test {

std::vector<AnyEngine<Point>> atoms_on_three_engines(const Model<Point>& model, const TypedThresholds& matrix) {
  return on_three_engines(model, AdmitAll{}, matrix);
}

namespace three_engines_test {

TEST(ThreeEngines, AgreeOnRandomAtoms) {
  Random random(1);
  std::vector<Vec3> points;
  for (int k = 0; k < 500; ++k) points.push_back(random.vector(5.0));
  const std::vector<AnyEngine<Point>> engines = atoms_on_three_engines(own_groups(points), one_type(500, 1.0));
  const std::vector<Hit> expected = engines.front().within(0.0, {});
  EXPECT_GT(expected.size(), 10U);
  for (const AnyEngine<Point>& engine : engines) EXPECT_EQ(engine.within(0.0, {}), expected) << engine.name;
}

}  // namespace three_engines_test
}  // namespace hinge::test
