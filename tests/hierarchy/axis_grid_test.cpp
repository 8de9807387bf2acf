// SPDX-License-Identifier: BSD-3-Clause
// The grid of joint axes finds all axes through a point and few others. With it, a star of joints gives the same
// result as a test of all axes.
#include "hinge/detail/model/axis_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <set>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"

namespace hinge {
namespace axis_grid_test {

constexpr std::uint64_t seed = 10000;
using test::Random;

/// A random point for a line. `manner`: 0 in a cube, 1 in a plane, 2 on a line, 3 at one point, 4 at very different
/// scales.
Vec3 place(Random& random, int manner, double offset) {
  Vec3 x = random.vector(1.0);
  if (manner >= 1) x[2] = 0.0;
  if (manner >= 2) x[1] = 0.0;
  if (manner == 3) x = Vec3::Zero();
  if (manner == 4) x = random.vector(1.0) * std::exp2(random.uniform(-60.0, 60.0));
  return x + Vec3(offset, -offset, offset);
}

Vec3 direction(Random& random, int manner) {
  if (random.one_in(3)) return Vec3::Unit(static_cast<int>(random.below(3)));
  if (random.one_in(4)) return Vec3(1.0, 1e-9, -1e-12).normalized();
  Vec3 d = random.vector(1.0).normalized();
  if (manner == 1) d[2] = 0.0;
  return d.normalized();
}

TEST(AxisGrid, NamesEveryLineThroughAPoint) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int manner = 0; manner < 5; ++manner)
    for (const double offset : {0.0, 1e-6, 1.0, 1e6, 1e100}) {
      std::vector<detail::AxisGrid::Line> lines;
      std::vector<Vec3> points;
      Aabb box;
      for (int k = 0; k < 300; ++k) {
        const detail::AxisGrid::Line line{place(random, manner, offset), direction(random, manner)};
        points.emplace_back(line.point + line.direction * random.uniform(-2.0, 2.0));
        box.extend(points.back());
        lines.push_back(line);
      }
      const detail::AxisGrid grid(lines, box);
      std::size_t answered = 0;
      for (std::size_t k = 0; k < lines.size(); ++k) {
        bool found = false;
        const bool inside = grid.visit_near(Aabb(points[k]), [&](std::size_t l) {
          found = found || l == k;
          return true;
        });
        ASSERT_TRUE(found || !inside) << "manner " << manner << " offset " << offset << " line " << k;
        answered += inside ? 1U : 0U;
      }
      EXPECT_EQ(answered, lines.size()) << "manner " << manner << " offset " << offset;
      EXPECT_FALSE(grid.visit_near(Aabb(Vec3::Constant(1e300)), [](std::size_t) { return true; }));
    }
  const detail::AxisGrid nothing({}, Aabb());
  EXPECT_FALSE(nothing.visit_near(Aabb(Vec3::Zero()), [](std::size_t) { return true; }));
}

TEST(AxisGrid, NamesFewOthers) {
  Random random(seed);
  for (const std::size_t n : {std::size_t{1000}, std::size_t{8000}, std::size_t{64000}}) {
    std::vector<detail::AxisGrid::Line> lines;
    Aabb box;
    for (std::size_t k = 0; k < n; ++k) {
      lines.push_back({random.vector(100.0), random.vector(1.0).normalized()});
      box.extend(lines.back().point);
    }
    const detail::AxisGrid grid(lines, box);
    std::size_t visited = 0, asked = 0;
    for (std::size_t k = 0; k < n; k += 97, ++asked)
      ASSERT_TRUE(grid.visit_near(Aabb(lines[k].point), [&](std::size_t) {
        ++visited;
        return true;
      }));
    std::cout << n << " lines: " << visited / asked << " looked at for a point\n";
    EXPECT_LT(static_cast<double>(visited), 8.0 * std::cbrt(static_cast<double>(n)) * static_cast<double>(asked));
  }
}

/// Links that rotate relative to the world, each with one primitive. Some joint axes pass through the primitives of
/// earlier links.
template <class P, class Make>
void expect_the_same_as_from_all(const Make& make, std::size_t n) {
  Random random(seed);
  ModelBuilder<P> builder;
  std::vector<Vec3> centres;
  for (std::size_t k = 0; k < n; ++k) {
    const Pose pose = random.pose(10.0);
    Vec3 axis = random.vector(1.0).normalized();
    // One axis in three passes through an earlier point.
    const bool aimed = !centres.empty() && random.one_in(3);
    if (aimed) axis = pose.inverse() * centres[random.below(centres.size())];
    const Vec3 point = axis * (random.one_in(4) ? 0.5 : 0.0) + (random.one_in(3) ? Vec3(0.1, 0.2, 0.3) : Vec3::Zero());
    builder.add_link(world, Revolute{axis, Vec3::Zero(), pose, {}}, {make(point)});
    centres.push_back(pose * point);
  }
  const Model<P> built = builder.finish();
  const SelectedModel<P> model(built, DofSelection::all(built.tree()));
  std::size_t shared = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const LinkId link = built.links()[i];
    const Joint& own = built.tree().joint(link);
    std::set<GroupId> expected;
    if (built.primitives()[i].fixed_on_axis(own.point, own.axis)) {
      expected.insert(GroupId{0});
      const P in_world = built.primitives()[i].placed(own.origin);
      for (std::size_t g = 1; g < model.groups()->size(); ++g) {
        const Joint& joint = (*model.groups())[id<GroupId>(g)].joint;
        if (id<GroupId>(g) != model.group_of(id<PrimitiveId>(i)) &&
            in_world.placed(joint.origin.inverse()).fixed_on_axis(joint.point, joint.axis))
          expected.insert(id<GroupId>(g));
      }
    }
    const auto listed = model.also_fixed_in(id<PrimitiveId>(i));
    ASSERT_EQ(std::set<GroupId>(listed.begin(), listed.end()), expected) << i;
    shared += expected.size() > 1 ? 1U : 0U;
  }
  EXPECT_GT(shared, 10U);
}

TEST(AxisGrid, LeavesAStarOfJointsItsAnswers) {
  expect_the_same_as_from_all<Point>([](const Vec3& x) { return Point{x}; }, 600);
  expect_the_same_as_from_all<Sphere>([](const Vec3& x) { return Sphere{x, 0.25}; }, 600);
}

/// A model of n links with one common axis depends on it: visits of all axes would take n^2 steps.
TEST(AxisGrid, StopsWhenTheVisitorReturnsFalse) {
  const std::vector<detail::AxisGrid::Line> lines(1000, {Vec3::Zero(), Vec3::UnitZ()});
  Aabb box(Vec3::Zero());
  box.extend(Vec3::UnitZ());
  std::size_t visited = 0;
  EXPECT_TRUE(detail::AxisGrid(lines, box).visit_near(Aabb(Vec3::Zero()), [&](std::size_t) { return ++visited < 7; }));
  EXPECT_EQ(visited, 7U);
}

}  // namespace axis_grid_test
}  // namespace hinge
