// SPDX-License-Identifier: BSD-3-Clause
// SweptBall: bounds of a ball moved by a chain of joints, against sampled joint values.
#include "hinge/detail/kinematics/swept_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/kinematics/joint.hpp"

namespace hinge {
namespace swept_ball_test {

constexpr std::uint64_t seed = 20'250'611;

Vec3 random_vector(SampleStream& stream, double scale) {
  return {scale * (2 * stream.uniform() - 1), scale * (2 * stream.uniform() - 1), scale * (2 * stream.uniform() - 1)};
}

struct Chain {
  std::vector<detail::AxisInterval> joints;
  Vec3 start;

  Chain(SampleStream& stream, double widest) : start(random_vector(stream, 1.0)) {
    const std::size_t count = 1 + static_cast<std::size_t>(stream.uniform() * 15);
    for (std::size_t k = 0; k < count; ++k) {
      detail::AxisInterval joint;
      joint.kind = stream.uniform() < 0.25 ? JointKind::prismatic : JointKind::revolute;
      joint.axis = random_vector(stream, 1.0).normalized();
      joint.point = random_vector(stream, 1.0);
      joint.joint = k;
      joint.set_half(widest * stream.uniform());
      joints.push_back(joint);
    }
  }
  detail::SweptBall swept() const {
    detail::SweptBall ball(start);
    for (const detail::AxisInterval& joint : joints) ball.sweep(joint);
    return ball;
  }
  /// Returns x moved by one random choice of joint values, applied in joint order. End values are frequent.
  Vec3 moved(Vec3 x, SampleStream& stream) const {
    for (const detail::AxisInterval& joint : joints) {
      const double q =
          joint.half * (stream.uniform() < 0.5 ? (stream.uniform() < 0.5 ? -1.0 : 1.0) : 2 * stream.uniform() - 1);
      if (joint.kind == JointKind::prismatic) {
        x += joint.axis * q;
      } else {
        x = joint.point + product(rotation_about(joint.axis, q), Vec3(x - joint.point));
      }
    }
    return x;
  }
};

/// A convex set contains a point if its extent along every direction reaches the point; checks some directions.
void expect_inside(const detail::SweptBall& ball, const Vec3& x, double more, SampleStream& stream) {
  constexpr double rounding = 1e-12;
  for (int k = 0; k < 20; ++k) {
    const Vec3 n = k == 0 ? Vec3((x - ball.centre()).normalized()) : Vec3(random_vector(stream, 1.0).normalized());
    const double extent = ball.growth() + ball.generators_along(n) + more;
    ASSERT_LE(dot(n, Vec3(x - ball.centre())), extent + rounding);
  }
}

TEST(SweptBall, HoldsEveryPositionOfItsCentre) {
  SCOPED_TRACE(seed);
  for (std::uint64_t c = 0; c < 300; ++c) {
    SampleStream stream(seed, c);
    // Intervals from tiny to more than a full turn.
    const Chain chain(stream, c % 3 == 0 ? 0.01 : c % 3 == 1 ? 0.7 : 7.0);
    const detail::SweptBall ball = chain.swept();
    for (int k = 0; k < 200; ++k) expect_inside(ball, chain.moved(chain.start, stream), 0.0, stream);
  }
}

TEST(SweptBall, TellsHowFarWhatIsCarriedAlongCanTurn) {
  SCOPED_TRACE(seed);
  for (std::uint64_t c = 0; c < 300; ++c) {
    SampleStream stream(seed, c);
    const Chain chain(stream, c % 2 == 0 ? 0.05 : 1.0);
    const detail::SweptBall ball = chain.swept();
    const Vec3 offset = random_vector(stream, 0.5);
    for (int k = 0; k < 100; ++k) {
      SampleStream first = stream, second = stream;
      const Vec3 carried = chain.moved(chain.start + offset, first) - chain.moved(chain.start, second);
      stream = first;
      ASSERT_LE((carried - offset).norm(), ball.turned() * offset.norm() + 1e-12);
    }
  }
}

TEST(SweptBall, GrowsBySecondOrderAcrossSmallMotions) {
  detail::AxisInterval joint;
  joint.set_half(1e-3);
  detail::SweptBall ball(Vec3(1, 0, 0));
  ball.sweep(joint);
  EXPECT_NEAR(ball.generators_along(Vec3::UnitY()), 1e-3, 1e-9);
  EXPECT_LT(ball.growth() + ball.generators_along(Vec3::UnitX()), 1e-6);
}

TEST(SweptBall, OfAFullTurnLiesOnTheAxis) {
  detail::AxisInterval joint;
  joint.set_half(3.2);
  detail::SweptBall ball(Vec3(1, 0, 2));
  ball.sweep(joint);
  EXPECT_EQ(ball.centre(), Vec3(0, 0, 2));
  EXPECT_DOUBLE_EQ(ball.growth(), 1.0);
}

TEST(SweptBall, SharesAddUpToTheExtent) {
  SampleStream stream(seed, 1);
  const Chain chain(stream, 0.7);
  const detail::SweptBall ball = chain.swept();
  std::vector<double> shares(chain.joints.size(), 0.0);
  const Vec3 n = Vec3(1, 2, 3).normalized();
  ball.add_shares(n, shares);
  double sum = 0.0;
  for (const double share : shares) sum += share;
  EXPECT_NEAR(sum, ball.growth() + ball.generators_along(n), 1e-12);
}

}  // namespace swept_ball_test
}  // namespace hinge
