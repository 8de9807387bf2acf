// SPDX-License-Identifier: BSD-3-Clause
// Joints computed eight at a time have the bits of joints computed one at a time, for all values and call orders.
#include "hinge/detail/kinematics/joint_batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/kinematics/forward_kinematics.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge {
namespace joint_batch_test {

using test::Random;
using Bits = std::array<std::uint64_t, 12>;

/// Rotation column by column, then translation. The sign of zero counts.
Bits bits_of(const Pose& pose) {
  Bits bits;
  for (std::size_t e = 0; e < 9; ++e) bits[e] = std::bit_cast<std::uint64_t>(pose.rotation.data()[e]);
  for (std::size_t e = 0; e < 3; ++e) bits[9 + e] = std::bit_cast<std::uint64_t>(pose.translation.data()[e]);
  return bits;
}

/// Values where sine and cosine change quadrant, method or sign, and ordinary values.
double any_value(Random& random) {
  constexpr double pi = std::numbers::pi, limit = detail::cody_waite_limit;
  constexpr std::array special = {
      0.0, -0.0, pi,    -pi,    pi / 2, -pi / 2,   1e-300, std::numeric_limits<double>::denorm_min(),
      1e5, -1e5, limit, -limit, 1e22,   -0x1p1000, 1e300,  std::numeric_limits<double>::max()};
  switch (random.below(8)) {
    case 0: return special[random.below(special.size())];
    case 1: return std::nextafter(random.one_in(2) ? limit : -limit, random.one_in(2) ? 1e300 : 0.0);
    case 2: return static_cast<double>(random.below(9)) * pi / 4 * (random.one_in(2) ? 1.0 : -1.0);
    case 3: return std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.below(1500)) - 500);
    case 4: return random.uniform(-1e5, 1e5);
    default: return random.uniform(-pi, pi);
  }
}

/// Any joint value. Prismatic values are limited: sums of 200 must be finite, and only few may hide all other terms.
double any_value(const Joint& joint, Random& random) {
  const double value = any_value(random);
  if (joint.kind != JointKind::prismatic) return value;
  const double most = random.one_in(50) ? 1e300 : 1e3;
  return std::clamp(value, -most, most);
}

Vec3 any_axis(Random& random) {
  if (random.one_in(3)) {
    Vec3 axis = Vec3::Zero();
    axis[static_cast<Eigen::Index>(random.below(3))] = random.one_in(2) ? 1.0 : -1.0;
    return axis;
  }
  return random.vector(1.0);
}

Joint any_joint(Random& random) {
  Pose origin;
  if (random.one_in(2)) origin = random.pose(3.0);
  if (random.one_in(6)) origin = Pose{Mat3::Identity(), random.vector(1e4)};
  if (random.one_in(4)) return Prismatic{any_axis(random), origin, {}};
  return Revolute{any_axis(random), random.one_in(4) ? Vec3(Vec3::Zero()) : random.vector(5.0), origin, {}};
}

/// A random tree with at least `joints` DOF: chains, stars and shapes between them, with some fixed joints.
KinematicTree any_tree(std::size_t joints, Random& random) {
  KinematicTree tree;
  const std::size_t branching = 1 + random.below(4);
  while (tree.dof_count() < joints) {
    const LinkId parent = id<LinkId>(branching == 1 || !random.one_in(branching) ? tree.link_count() - 1
                                                                                 : random.below(tree.link_count()));
    if (random.one_in(6))
      tree.add_link(parent, Fixed{random.pose(2.0)});
    else
      tree.add_link(parent, any_joint(random));
  }
  return tree;
}

/// Poses of all groups, computed one joint at a time from parent to child.
std::vector<Pose> one_by_one(const RigidGroups& groups, std::span<const double> q) {
  std::vector<Pose> poses(groups.size());
  for (std::size_t g = 1; g < groups.size(); ++g) {
    const RigidGroup& group = groups[id<GroupId>(g)];
    Pose moved = motion(group.joint, q[group.dof]);
    if (!(group.joint.origin == Pose{})) moved = group.joint.origin * moved;
    poses[g] = poses[index(group.parent)] * moved;
  }
  return poses;
}

/// A pose source over a random tree and selection, with its last configuration.
struct Mechanism {
  Mechanism(std::size_t joints, Random& random)
      : tree(any_tree(joints, random)),
        selection(random.one_in(2) ? DofSelection::all(tree) : test::random_selection(tree, random)),
        groups(std::make_shared<const RigidGroups>(tree, selection)),
        source(groups, selection.size()),
        q(selection.size(), 0.0) {}

  void change(std::size_t position, Random& random) {
    q[position] = any_value(tree.joint(tree.link_of(selection.dofs()[position])), random);
  }
  void change_all(Random& random) {
    for (std::size_t k = 0; k < q.size(); ++k) change(k, random);
  }
  void expect_pose(std::size_t g) {
    ASSERT_EQ(bits_of(source.pose(id<GroupId>(g))), bits_of(one_by_one(*groups, q)[g])) << "group " << g;
  }
  /// Compares all groups, first in an order with random repetitions, then first to last.
  void expect_poses(Random& random) {
    const std::vector<Pose> expected = one_by_one(*groups, q);
    std::vector<std::size_t> order;
    for (std::size_t g = 0; g < groups->size(); ++g) order.push_back(random.one_in(2) ? random.below(g + 1) : g);
    for (std::size_t g = 0; g < groups->size(); ++g) order.push_back(g);
    for (const std::size_t g : order)
      ASSERT_EQ(bits_of(source.pose(id<GroupId>(g))), bits_of(expected[g])) << "group " << g;
  }

  KinematicTree tree;
  DofSelection selection;
  std::shared_ptr<const RigidGroups> groups;
  detail::ForwardKinematics source;
  std::vector<double> q;
};

constexpr std::array<std::size_t, 14> joint_counts = {0, 1, 2, 7, 8, 9, 15, 16, 17, 31, 64, 65, 128, 200};

TEST(JointBatch, HasTheBitsOfEachJointsMotion) {
  Random random(1);
  for (int round = 0; round < 20000; ++round) {
    const std::size_t used = 1 + random.below(detail::JointBatch::size);
    std::vector<double> q(1 + random.below(20));
    for (double& value : q) value = any_value(random);
    KinematicTree tree;  // add_link normalizes the joint axes
    detail::JointBatch batch;
    std::vector<std::size_t> position;
    for (std::size_t k = 0; k < used; ++k) {
      position.push_back(random.below(q.size()));
      batch.set(k, tree.joint(tree.add_link(world, any_joint(random))), position.back());
    }
    detail::JointMotions motions;
    compute_motions(batch, q.data(), motions);
    for (std::size_t k = 0; k < used; ++k) {
      const Joint& joint = tree.joint(id<LinkId>(1 + k));
      Bits found;
      for (std::size_t e = 0; e < 12; ++e)
        found[e] = std::bit_cast<std::uint64_t>(motions[e * detail::JointBatch::size + k]);
      ASSERT_EQ(found, bits_of(motion(joint, q[position[k]]))) << "round " << round << ", value " << q[position[k]];
    }
  }
}

TEST(ForwardKinematics, HasTheBitsOfOneJointAtATime) {
  Random random(2);
  for (int round = 0; round < 30; ++round)
    for (const std::size_t joints : joint_counts) {
      SCOPED_TRACE(testing::Message() << "round " << round << ", " << joints << " joints");
      Mechanism m(joints, random);
      m.expect_poses(random);  // at the reference
      for (int step = 0; step < 3; ++step) {
        m.change_all(random);
        m.source.set_configuration(m.q);
        m.expect_poses(random);
      }
      if (HasFailure()) return;
    }
}

TEST(ForwardKinematics, HasTheseBitsWhateverChangedAndWasAskedBefore) {
  Random random(3);
  for (int round = 0; round < 10; ++round)
    for (const std::size_t joints : joint_counts) {
      SCOPED_TRACE(testing::Message() << "round " << round << ", " << joints << " joints");
      Mechanism m(joints, random);
      for (int step = 0; step < 40; ++step) {
        const std::size_t n = m.q.size();
        // Numbers of changed values: none, one, around the limit up to which frames are reused, and all.
        const std::size_t few = n / detail::few_changes_divisor;
        const std::array<std::size_t, 6> counts = {0, 1, few, few + 1, n / 20 + 1, n};
        for (std::size_t changes = counts[random.below(counts.size())]; changes > 0 && n > 0; --changes)
          m.change(random.below(n), random);
        if (n > 0 && random.one_in(8)) m.q[random.below(n)] = random.one_in(2) ? 0.0 : -0.0;
        if (random.one_in(6)) m.source.forget();
        if (random.one_in(8)) {
          std::vector<Pose> poses(m.groups->size());
          for (std::size_t g = 1; g < poses.size(); ++g) poses[g] = random.pose(3.0);
          m.source.set_poses(poses);
          for (std::size_t g = 0; g < poses.size(); ++g)
            ASSERT_EQ(bits_of(m.source.pose(id<GroupId>(g))), bits_of(poses[g]));
        }
        m.source.set_configuration(m.q);
        // Sometimes nothing is queried, or only one group.
        const std::size_t asked = random.below(3);
        if (asked == 1) m.expect_pose(random.below(m.groups->size()));
        if (asked == 2) m.expect_poses(random);
        if (HasFailure()) return;
      }
      m.expect_poses(random);
      if (HasFailure()) return;
    }
}

/// A group counts as moved if the bits of its values differ, and every group counts as moved after forget().
TEST(ForwardKinematics, KnowsWhatMovedFromTheValues) {
  Random random(4);
  for (int round = 0; round < 10; ++round)
    for (const std::size_t joints : joint_counts) {
      SCOPED_TRACE(testing::Message() << "round " << round << ", " << joints << " joints");
      Mechanism m(joints, random);
      std::vector<double> before;
      for (int step = 0; step < 20; ++step) {
        bool all = step == 0;
        if (step > 0)
          for (std::size_t changes = random.below(m.q.size() + 1); changes > 0; changes -= 1 + changes / 3)
            m.change(random.below(m.q.size()), random);
        if (random.one_in(5)) {
          m.source.forget();
          all = true;
        }
        m.source.set_configuration(m.q);
        if (random.one_in(2)) m.expect_pose(random.below(m.groups->size()));
        std::vector<std::size_t> component(m.groups->size(), 0);
        std::vector<bool> moved(m.groups->size(), false);
        for (std::size_t g = 1; g < m.groups->size(); ++g) {
          const RigidGroup& group = (*m.groups)[id<GroupId>(g)];
          const bool changed =
              all || std::bit_cast<std::uint64_t>(m.q[group.dof]) != std::bit_cast<std::uint64_t>(before[group.dof]);
          component[g] = changed ? g : component[index(group.parent)];
          moved[g] = changed || moved[index(group.parent)];
        }
        for (std::size_t g = 0; g < m.groups->size(); ++g) {
          ASSERT_EQ(m.source.moved(id<GroupId>(g)), moved[g]) << "group " << g << ", step " << step;
          const std::size_t h = random.below(m.groups->size());
          ASSERT_EQ(m.source.component(id<GroupId>(g)) == m.source.component(id<GroupId>(h)),
                    component[g] == component[h])
              << "groups " << g << " and " << h << ", step " << step;
        }
        before = m.q;
      }
    }
}

TEST(ForwardKinematics, KeepsItsBitsWhenAConfigurationIsRefused) {
  Random random(5);
  Mechanism m(40, random);
  m.change_all(random);
  m.source.set_configuration(m.q);
  m.expect_pose(20 % m.groups->size());
  std::vector<double> bad(m.q.size(), 0.25);
  bad.back() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(m.source.set_configuration(bad), ConfigurationError);
  m.expect_poses(random);
}

}  // namespace joint_batch_test
}  // namespace hinge
