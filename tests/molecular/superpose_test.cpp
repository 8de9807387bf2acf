// SPDX-License-Identifier: BSD-3-Clause
// Superpositions: known motions, points on a line or in a plane, and another algorithm.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/molecular/fit_torsions.hpp"

namespace hinge::molecular {
namespace superpose_test {

std::vector<Vec3> random_points(std::mt19937_64& random, std::size_t count, int dimensions) {
  std::normal_distribution<double> normal(0.0, 10.0);
  std::vector<Vec3> points(count, Vec3::Zero());
  for (Vec3& point : points)
    for (int k = 0; k < dimensions; ++k) point[k] = normal(random);
  return points;
}

Pose random_motion(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Vec3 axis(normal(random), normal(random), normal(random));
  return {rotation_about(axis.normalized(), 3.0 * normal(random)),
          50.0 * Vec3(normal(random), normal(random), normal(random))};
}

/// Returns the same rmsd by a singular value decomposition (Eigen's umeyama).
double reference_rmsd(const std::vector<Vec3>& moved, const std::vector<Vec3>& onto) {
  Eigen::Matrix3Xd a(3, moved.size()), b(3, onto.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    a.col(static_cast<Eigen::Index>(i)) = moved[i];
    b.col(static_cast<Eigen::Index>(i)) = onto[i];
  }
  const Eigen::Matrix4d fit = Eigen::umeyama(a, b, false);
  const Eigen::Matrix3Xd off = ((fit.topLeftCorner<3, 3>() * a).colwise() + fit.topRightCorner<3, 1>().eval()) - b;
  return std::sqrt(off.squaredNorm() / static_cast<double>(moved.size()));
}

TEST(Superpose, LeavesWhatNoMotionTakesAway) {
  const std::vector<Vec3> a{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {4, 1, 1}};
  const Pose motion{rotation_about(Vec3(1, 2, 3).normalized(), 2.0), Vec3(10, -20, 30)};
  std::vector<Vec3> b;
  for (const Vec3& x : a) b.push_back(motion * x);
  EXPECT_NEAR(superpose(a, b).rmsd, 0.0, 1e-12);
  // A mirror image is not a rigid motion.
  for (Vec3& x : b) x[0] = -x[0];
  EXPECT_GT(superpose(a, b).rmsd, 0.5);
  // Two points each: the difference in length is shared equally by both ends.
  const Superposition pairs =
      superpose(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}});
  EXPECT_NEAR(pairs.rmsd, 0.5, 1e-12);
  EXPECT_NEAR(pairs.farthest, 0.5, 1e-12);
}

TEST(Superpose, UndoesRigidMotions) {
  std::mt19937_64 random(51);
  for (const int dimensions : {1, 2, 3})
    for (const std::size_t count : {1U, 2U, 3U, 4U, 50U})
      for (int round = 0; round < 40; ++round) {
        const std::vector<Vec3> points = random_points(random, count, dimensions);
        const Pose motion = random_motion(random);
        std::vector<Vec3> onto;
        for (const Vec3& x : points) onto.push_back(motion * x);
        const Superposition found = superpose(points, onto);
        EXPECT_LT(found.rmsd, 1e-11) << dimensions << " dimensions, " << count << " points, round " << round;
        EXPECT_LT(found.farthest, 1e-11);
      }
}

TEST(Superpose, IsAsCloseAsASingularValueDecompositionMakesIt) {
  std::mt19937_64 random(52);
  for (int round = 0; round < 500; ++round) {
    const std::size_t count = 3 + static_cast<std::size_t>(round % 30);
    const std::vector<Vec3> points = random_points(random, count, 3), onto = random_points(random, count, 3);
    const double expected = reference_rmsd(points, onto);
    EXPECT_NEAR(superpose(points, onto).rmsd, expected, 1e-11 * expected) << "round " << round;
  }
}

/// The quaternion of a half turn has no real part.
TEST(Superpose, UndoesHalfTurns) {
  const std::vector<Vec3> points{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {-4, 1, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Vec3> onto = points;
    for (Vec3& x : onto)
      for (int k = 0; k < 3; ++k)
        if (k != axis) x[k] = -x[k];
    EXPECT_LT(superpose(points, onto).rmsd, 1e-14);
  }
}

}  // namespace superpose_test
}  // namespace hinge::molecular
