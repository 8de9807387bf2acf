// SPDX-License-Identifier: BSD-3-Clause
// Measures the stack of exact answers. It is compiled alone and as users compile it, because frames depend on what a
// compiler inlines.
#include <gtest/gtest.h>

#include <cstddef>
#include <iostream>
#include <vector>

#include "extremes/stack_used.hpp"
#include "extremes/three_engines.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge {
namespace stack_test {

/// Two triangles, each on its own prismatic joint.
std::vector<test::AnyEngine<Triangle>> engines(const Triangle& a, const Triangle& b) {
  ModelBuilder<Triangle> builder;
  for (const Triangle& triangle : {a, b})
    builder.add_link(world, Prismatic{Vec3::UnitX(), {}, {}}, std::vector<Triangle>{triangle});
  return test::on_three_engines(builder.finish(), AdmitAll{}, UniformClearance(0.0));
}

/// For these sizes doubles cannot decide, so the exact code runs, which has the largest stack frames.
TEST(Solids, DecidedInWholeNumbersTakeABoundedStack) {
  const double size = 0x1p-300, far = 0x1p300;
  const Triangle p{{0, 0, 0}, {4 * size, 0, 0}, {0, 4 * size, far}}, through{{size, size, -far}, {size, size, far}, {}};
  const Triangle apart{{9 * size, 9 * size, 7 * size}, {9 * size, -far, 8 * size}, {far, size, 9 * size}};
  const Capsule c{p.a, p.c, size}, d{apart.a, apart.b, size};
  double sum = 0.0;
  const std::size_t used = test::stack_used([&] {
    for (const Triangle& q : {apart, through}) {
      for (test::AnyEngine<Triangle>& engine : engines(p, q)) sum += engine.closest({}).value().distance;
      const auto [x, y] = closest_points(p, q);
      sum += distance(p, q) + squared_distance(p, q) + (closer_than(p, q, size) ? 1.0 : 0.0) + x[0] + y[0];
    }
    const auto [x, y] = closest_points(c, d);
    sum += squared_distance(c, d) + (closer_than(c, d, size) ? 1.0 : 0.0) + x[0] + y[0];
    sum += squared_distance(Sphere{p.a, size}, Sphere{p.b, size}) + x[1] + y[1];
  });
  std::cout << "whole numbers: " << used << " bytes of stack\n";
  EXPECT_TRUE(is_finite(sum));
  if (!test::stack_is_padded) {
    EXPECT_LT(used, test::stack_limit);
  }
}

}  // namespace stack_test
}  // namespace hinge
