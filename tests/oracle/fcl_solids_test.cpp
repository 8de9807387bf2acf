// SPDX-License-Identifier: BSD-3-Clause
// Compares boxes, spheres and cylinders as solids, also nested, with FCL's shapes. If the two differ, rational
// arithmetic decides: separating axes of two boxes, the nearest point of a box.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/shape.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "oracle/fcl_robots.hpp"
#include "oracle/placement.hpp"

namespace hinge::robotics {
namespace fcl_solids_test {

using test::Random;
using Fraction = boost::multiprecision::cpp_rational;
using Vector = std::array<Fraction, 3>;

Vector exactly(const Vec3& x) { return {Fraction(x[0]), Fraction(x[1]), Fraction(x[2])}; }
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Fraction dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns the half edges of the box in the world frame.
std::array<Vector, 3> half_edges(const BoxShape& box, const Pose& at) {
  std::array<Vector, 3> edges;
  for (int k = 0; k < 3; ++k) {
    edges[static_cast<std::size_t>(k)] = exactly(at.rotation.col(k));
    for (Fraction& x : edges[static_cast<std::size_t>(k)]) x *= Fraction(box.size[k]) / 2;
  }
  return edges;
}

/// Returns whether the boxes share a point: no face normal and no cross product of edges is a separating axis.
bool meet(const BoxShape& a, const Pose& at_a, const BoxShape& b, const Pose& at_b) {
  const auto x = half_edges(a, at_a), y = half_edges(b, at_b);
  const Vector between = minus(exactly(at_b.translation), exactly(at_a.translation));
  const auto separates = [&](const Vector& axis) {
    Fraction reach = 0;
    for (const auto* edges : {&x, &y})
      for (const Vector& edge : *edges) reach += abs(dot(axis, edge));
    return abs(dot(axis, between)) > reach;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (separates(cross(x[i], x[(i + 1) % 3])) || separates(cross(y[i], y[(i + 1) % 3]))) return false;
    for (std::size_t j = 0; j < 3; ++j)
      if (separates(cross(x[i], y[j]))) return false;
  }
  return true;
}

bool meet(const SphereShape& a, const Pose& at_a, const SphereShape& b, const Pose& at_b) {
  const Vector way = minus(exactly(at_b.translation), exactly(at_a.translation));
  const Fraction reach = Fraction(a.radius) + Fraction(b.radius);
  return dot(way, way) <= reach * reach;
}

bool meet(const BoxShape& a, const Pose& at_a, const SphereShape& b, const Pose& at_b) {
  const Vector way = minus(exactly(at_b.translation), exactly(at_a.translation));
  Fraction squared = 0;
  for (int k = 0; k < 3; ++k) {
    const Fraction place = abs(dot(exactly(at_a.rotation.col(k)), way)), half = Fraction(a.size[k]) / 2;
    if (place > half) squared += (place - half) * (place - half);
  }
  return squared <= Fraction(b.radius) * Fraction(b.radius);
}

/// Decides exactly in rationals; nothing for cylinders, which have no exact formula here.
struct Judge {
  const Pose &at_a, &at_b;
  template <class A, class B>
  std::optional<bool> operator()(const A& a, const B& b) const {
    if constexpr (requires { meet(a, at_a, b, at_b); }) return meet(a, at_a, b, at_b);
    if constexpr (requires { meet(b, at_b, a, at_a); }) return meet(b, at_b, a, at_a);
    return {};
  }
};

struct ToFcl {
  oracle::FclShape operator()(const BoxShape& b) const { return oracle::FclBox{{b.size[0], b.size[1], b.size[2]}}; }
  oracle::FclShape operator()(const SphereShape& s) const { return oracle::FclSphere{s.radius}; }
  oracle::FclShape operator()(const CylinderShape& c) const { return oracle::FclCylinder{c.radius, c.length}; }
  oracle::FclShape operator()(const CapsuleShape& c) const { return oracle::FclCapsule{c.radius, c.length}; }
  oracle::FclShape operator()(const MeshShape&) const { return oracle::FclSphere{0.0}; }
  oracle::FclShape operator()(const PointCloudShape&) const { return oracle::FclSphere{0.0}; }
};

bool collide_for_fcl(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b) {
  return oracle::collide(std::visit(ToFcl{}, a), oracle::placement(at_a), std::visit(ToFcl{}, b),
                         oracle::placement(at_b));
}

/// Returns the shape with every side moved outward by `by`, which may be negative.
Shape grown(Shape shape, double by) {
  if (auto* box = std::get_if<BoxShape>(&shape)) box->size += Vec3::Constant(2 * by);
  if (auto* sphere = std::get_if<SphereShape>(&shape)) sphere->radius += by;
  if (auto* cylinder = std::get_if<CylinderShape>(&shape))
    *cylinder = {cylinder->radius + by, cylinder->length + 2 * by};
  return shape;
}

Shape random_solid(Random& random, std::size_t kind) {
  const auto size = [&] { return random.one_in(3) ? random.uniform(0.02, 0.1) : random.uniform(0.1, 1.0); };
  if (kind == 0) return BoxShape{{size(), size(), size()}};
  if (kind == 1) return SphereShape{size() / 2};
  return CylinderShape{size() / 2, size()};
}

/// A robot with shape `a` on the root and shape `b` at a pose on a link behind two joints.
bool collide_for_hinge(const Shape& a, const Shape& b, const Pose& at_b, const std::string& engine, bool& surfaces) {
  RobotDescription pair{"pair", {{"a", {{a}}}, {"between"}, {"b", {{b}}}}, {}};
  pair.joints.push_back({"turn", JointType::continuous, "a", "between"});
  pair.joints.push_back({"slide", JointType::prismatic, "between", "b", at_b});
  const auto robot = std::make_shared<const Robot>(pair);
  RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot, 0.0), {engine});
  surfaces = !checker.triangle_pairs().empty();
  EXPECT_EQ(checker.colliding_links().empty(), !checker.collides());
  EXPECT_EQ(checker.closest()->collides(), checker.collides());
  return checker.collides();
}

struct Count {
  std::size_t asked = 0, together = 0, inside = 0, differ = 0;
};

/// Compares one pair of solids at one pose. Cylinders are enclosed to 1 mm: a pair is skipped if FCL's answer changes
/// within this distance.
void compare(const Shape& a, const Shape& b, const Pose& at_b, const std::string& engine, Count& count) {
  constexpr double enclosed = 2.5e-3;
  const std::optional<bool> exact = std::visit(Judge{Pose{}, at_b}, a, b);
  const bool fcl = collide_for_fcl(a, {}, b, at_b);
  if (!exact && collide_for_fcl(grown(a, enclosed), {}, b, at_b) != fcl) return;
  bool surfaces = false;
  const bool hinge = collide_for_hinge(a, b, at_b, engine, surfaces);
  ++count.asked;
  count.together += hinge ? 1U : 0U;
  count.inside += hinge && !surfaces ? 1U : 0U;
  count.differ += hinge != fcl ? 1U : 0U;
  ASSERT_EQ(hinge, exact.value_or(fcl)) << "FCL says " << fcl;
}

bool exhaustive() { return std::getenv("HINGE_TEST_ALL") != nullptr; }
constexpr std::array<const char*, 3> engines{"simd", "lazy", "brute"};

void print(const char* what, std::uint64_t seed, const Count& count) {
  std::cout << what << ", seed " << seed << ": " << count.asked << " pairs of solids, " << count.together
            << " share a point, " << count.inside << " of those one inside the other; FCL differs in " << count.differ
            << "\n";
}

TEST(FclSolids, AgreeAtRandomPoses) {
  constexpr std::uint64_t seed = 8489;
  const std::size_t pairs = exhaustive() ? 90000 : 1800;
  Random random(seed);
  Count count;
  for (std::size_t k = 0; k < pairs; ++k) {
    SCOPED_TRACE(k);
    const Shape a = random_solid(random, k % 3), b = random_solid(random, k / 3 % 3);
    const Pose at_b = random.pose(random.one_in(2) ? 0.1 : 0.7);
    compare(a, b, at_b, engines[k / 9 % 3], count);
    if (testing::Test::HasFatalFailure()) break;
  }
  print("random", seed, count);
  EXPECT_GT(count.asked, pairs * 9 / 10);
  EXPECT_GT(count.inside, pairs / 20);
  EXPECT_GT(count.asked - count.together, pairs / 20);
  EXPECT_EQ(count.differ, 0U);
}

TEST(FclSolids, AgreeWhereOneIsInsideTheOther) {
  constexpr std::uint64_t seed = 8490;
  const std::size_t pairs = exhaustive() ? 27000 : 450;
  Random random(seed);
  Count count;
  for (std::size_t k = 0; k < pairs; ++k) {
    SCOPED_TRACE(k);
    const double size = std::exp2(random.uniform(-6.0, 2.0));
    const auto solid = [&](std::size_t kind, double s) -> Shape {
      if (kind == 0) return BoxShape{{s, s, s}};
      if (kind == 1) return SphereShape{s / 2};
      return CylinderShape{s / 2, s};
    };
    const Shape outer = solid(k % 3, size), inner = solid(k / 3 % 3, size / 8);
    const Pose pose = random.pose(size / 4);
    // Both shapes take a turn on the root.
    compare(outer, inner, pose, engines[k / 9 % 3], count);
    compare(inner, outer, pose, engines[k / 9 % 3], count);
    if (testing::Test::HasFatalFailure()) break;
  }
  print("inside", seed, count);
  EXPECT_GT(count.inside, pairs);
  EXPECT_EQ(count.differ, 0U);
}

/// Boxes and spheres that touch or miss by 1e-3 to 1e-12 of their size. FCL has its own tolerances there, so rationals
/// decide.
TEST(FclSolids, AreDecidedByFractionsWhereTheyBarelyTouch) {
  constexpr std::uint64_t seed = 8491;
  const std::size_t pairs = exhaustive() ? 20000 : 500;
  Random random(seed);
  Count count;
  for (std::size_t k = 0; k < pairs; ++k) {
    SCOPED_TRACE(k);
    const Shape a = random_solid(random, k % 2), b = random_solid(random, k / 2 % 2);
    Pose at_b = random.pose(1.0);
    const Vec3 way = random.vector(1.0).normalized();
    const auto apart = [&](double distance) {
      at_b.translation = way * distance;
      return !*std::visit(Judge{Pose{}, at_b}, a, b);
    };
    double low = 0.0, high = 4.0;
    const double until = std::exp2(random.uniform(-40.0, -10.0));
    while (high - low > until) (apart((low + high) / 2) ? high : low) = (low + high) / 2;
    for (const double distance : {low, high}) {
      apart(distance);
      compare(a, b, at_b, engines[k / 4 % 3], count);
    }
    if (testing::Test::HasFatalFailure()) break;
  }
  print("barely touching", seed, count);
  EXPECT_EQ(count.asked, 2 * pairs);
  EXPECT_GT(count.together, pairs / 2);
}

}  // namespace fcl_solids_test
}  // namespace hinge::robotics
