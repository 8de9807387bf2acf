// SPDX-License-Identifier: BSD-3-Clause
// Trees, rigid groups and poses against the plain product of transforms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/kinematics/forward_kinematics.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge {
namespace kinematics_test {

using test::Random;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Point any_point(Random& random, const Vec3&, const Vec3&) { return Point{random.vector(1.0)}; }

Pose link_pose(const KinematicTree& tree, const std::vector<double>& q, LinkId link) {
  Pose pose;
  for (; link != world; link = tree.parent(link)) {
    const Joint& joint = tree.joint(link);
    const double value = joint.has_dof() ? q[index(tree.dof_of(link))] : 0.0;
    pose = joint.origin * motion(joint, value) * pose;
  }
  return pose;
}

TEST(Joint, MotionIsTheIdentityAtZeroAndKeepsItsAxis) {
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    const Vec3 axis = random.vector(1.0).normalized(), point = random.vector(5.0);
    const Joint joint = Revolute{axis, point, {}, {}};
    EXPECT_EQ(motion(joint, 0.0), Pose{});
    const Pose turned = motion(joint, random.uniform(-10.0, 10.0));
    EXPECT_TRUE(is_rigid(turned));
    const Vec3 on_axis = point + axis * 3.0;
    EXPECT_NEAR((turned * on_axis - on_axis).norm(), 0.0, 1e-13);
  }
}

TEST(Joint, RotationIsRightHanded) {
  const Vec3 turned = product(rotation_about(Vec3::UnitZ(), std::acos(0.0)), Vec3(Vec3::UnitX()));
  EXPECT_NEAR((turned - Vec3::UnitY()).norm(), 0.0, 1e-15);
}

TEST(Pose, RefusesToCallScaledShearedMirroredOrNanRigid) {
  EXPECT_TRUE(is_rigid(Pose{}));
  for (const Mat3& r : {Mat3(1.001 * Mat3::Identity()), Mat3(-Mat3::Identity()), Mat3(Mat3::Zero()),
                        Mat3((Mat3() << 1, 0.01, 0, 0, 1, 0, 0, 0, 1).finished()),
                        Mat3((Mat3() << nan, 0, 0, 0, 1, 0, 0, 0, 1).finished())})
    EXPECT_FALSE(is_rigid(Pose{r, Vec3::Zero()}));
  EXPECT_FALSE(is_rigid(Pose{Mat3::Identity(), Vec3(0, nan, 0)}));
}

TEST(KinematicTree, RefusesWhatItCannotPlace) {
  KinematicTree tree;
  EXPECT_THROW(tree.add_link(id<LinkId>(5), Fixed{}), ModelError);
  EXPECT_THROW(tree.add_link(world, Revolute{Vec3::Zero(), Vec3::Zero(), {}, {}}), ModelError);
  EXPECT_THROW(tree.add_link(world, Revolute{Vec3(nan, 0, 0), Vec3::Zero(), {}, {}}), ModelError);
  EXPECT_THROW(tree.add_link(world, Revolute{Vec3::UnitX(), Vec3(0, nan, 0), {}, {}}), ModelError);
  EXPECT_THROW(tree.add_link(world, Fixed{Pose{2.0 * Mat3::Identity(), Vec3::Zero()}}), ModelError);
  const LinkId a = tree.add_link(world, Prismatic{});
  EXPECT_THROW(tree.add_closure({a, a, {}, {}, ""}), ModelError);
  EXPECT_THROW(tree.add_closure({a, id<LinkId>(9), {}, {}, ""}), ModelError);
  EXPECT_EQ(tree.link_count(), 2U);
  EXPECT_EQ(tree.dof_count(), 1U);
}

TEST(DofSelection, RefusesUnknownAndRepeatedDofs) {
  KinematicTree tree;
  tree.add_link(world, Revolute{});
  EXPECT_THROW(DofSelection(tree, {id<DofId>(1)}), ModelError);
  EXPECT_THROW(DofSelection(tree, {id<DofId>(0), id<DofId>(0)}), ModelError);
  EXPECT_EQ(DofSelection(tree, {}).size(), 0U);
}

TEST(ForwardKinematics, EqualsTheProductOfTransformsForEverySelection) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const auto model = test::random_model(random, 30, 1, false, any_point);
    const KinematicTree& tree = model.tree();
    const DofSelection selection = test::random_selection(tree, random);
    const auto groups = std::make_shared<const RigidGroups>(tree, selection);
    detail::ForwardKinematics source(groups, selection.size());
    std::vector<double> q(selection.size()), full(tree.dof_count(), 0.0);
    for (std::size_t k = 0; k < q.size(); ++k) full[index(selection.dofs()[k])] = q[k] = random.uniform(-3.0, 3.0);
    source.set_configuration(q);
    for (std::size_t l = 0; l < tree.link_count(); ++l) {
      const LinkId link = id<LinkId>(l);
      const Pose expected = link_pose(tree, full, link);
      const Pose found = source.pose(groups->group_of(link)) * groups->link_in_group(link);
      EXPECT_NEAR((expected.rotation - found.rotation).norm(), 0.0, 1e-12);
      EXPECT_NEAR((expected.translation - found.translation).norm(), 0.0, 1e-10);
    }
  }
}

TEST(RigidGroups, AreMaximal) {
  Random random(5);
  const auto model = test::random_model(random, 30, 1, false, any_point);
  const KinematicTree& tree = model.tree();
  const DofSelection none(tree, {});
  EXPECT_EQ(RigidGroups(tree, none).size(), 1U);
  EXPECT_EQ(RigidGroups(tree, DofSelection::all(tree)).size(), 1U + tree.dof_count());
}

TEST(ForwardKinematics, KnowsWhatMovedAndWhatMovedTogether) {
  KinematicTree tree;
  const LinkId a = tree.add_link(world, Revolute{}),
               b = tree.add_link(a, Revolute{Vec3::UnitX(), Vec3(1, 0, 0), {}, {}});
  tree.add_link(b, Revolute{Vec3::UnitY(), Vec3(2, 0, 0), {}, {}});
  const DofSelection all = DofSelection::all(tree);
  detail::ForwardKinematics source(std::make_shared<const RigidGroups>(tree, all), 3);
  const double first[] = {0.1, 0.2, 0.3}, second[] = {0.1, 0.5, 0.3};
  source.set_configuration(first);
  EXPECT_TRUE(source.moved(id<GroupId>(1)));
  EXPECT_FALSE(source.moved(id<GroupId>(0)));
  source.set_configuration(second);
  EXPECT_FALSE(source.moved(id<GroupId>(1)));
  EXPECT_TRUE(source.moved(id<GroupId>(2)));
  EXPECT_TRUE(source.moved(id<GroupId>(3)));
  EXPECT_EQ(source.component(id<GroupId>(2)), source.component(id<GroupId>(3)));
  EXPECT_EQ(source.component(id<GroupId>(0)), source.component(id<GroupId>(1)));
  EXPECT_NE(source.component(id<GroupId>(1)), source.component(id<GroupId>(2)));
}

TEST(ForwardKinematics, CallsEverythingMovedOnceItWasToldToForget) {
  KinematicTree tree;
  tree.add_link(world, Revolute{});
  const DofSelection all = DofSelection::all(tree);
  detail::ForwardKinematics source(std::make_shared<const RigidGroups>(tree, all), 1);
  const std::vector<Pose> poses(2);
  source.set_poses(poses);
  source.set_poses(poses);
  EXPECT_FALSE(source.moved(id<GroupId>(1)));
  source.forget();
  source.set_poses(poses);
  EXPECT_TRUE(source.moved(id<GroupId>(1)));
  EXPECT_NE(source.component(id<GroupId>(0)), source.component(id<GroupId>(1)));
}

TEST(ForwardKinematics, RefusesBadInputAndKeepsItsState) {
  KinematicTree tree;
  tree.add_link(world, Revolute{});
  const DofSelection all = DofSelection::all(tree);
  detail::ForwardKinematics source(std::make_shared<const RigidGroups>(tree, all), 1);
  const double good[] = {0.5}, bad[] = {nan}, infinite[] = {INFINITY};
  source.set_configuration(good);
  const Pose before = source.pose(id<GroupId>(1));
  EXPECT_THROW(source.set_configuration(bad), ConfigurationError);
  EXPECT_THROW(source.set_configuration(infinite), ConfigurationError);
  EXPECT_THROW(source.set_configuration({}), ConfigurationError);
  EXPECT_THROW(source.set_poses(std::vector<Pose>(1)), ConfigurationError);
  EXPECT_THROW(source.set_poses(std::vector<Pose>(2, Pose{2 * Mat3::Identity(), Vec3::Zero()})), ConfigurationError);
  EXPECT_EQ(source.pose(id<GroupId>(1)), before);
}

TEST(ForwardKinematics, IsDoubleAndWithoutRecursionOnAHundredThousandJoints) {
  KinematicTree tree;
  LinkId parent = world;
  Pose step;
  step.translation = Vec3(1.45, 0, 0);
  const std::size_t n = 100000;
  for (std::size_t k = 0; k < n; ++k)
    parent = tree.add_link(parent, Revolute{k % 2 == 0 ? Vec3::UnitX() : Vec3::UnitZ(), Vec3::Zero(), step, {}});
  const DofSelection all = DofSelection::all(tree);
  detail::ForwardKinematics source(std::make_shared<const RigidGroups>(tree, all), n);
  // Only joints about x rotate, so the chain stays straight along x.
  std::vector<double> q(n, 0.0);
  for (std::size_t k = 0; k < n; k += 2) q[k] = 0.3;
  source.set_configuration(q);
  EXPECT_NEAR((source.pose(id<GroupId>(n)).translation - Vec3(1.45 * static_cast<double>(n), 0, 0)).norm(), 0.0,
              1e-8 * 1.45 * static_cast<double>(n));
  EXPECT_TRUE(is_rigid(source.pose(id<GroupId>(n))));
}

}  // namespace kinematics_test
}  // namespace hinge
