// SPDX-License-Identifier: BSD-3-Clause
// Subject: a robot of the benchmark with its tested pairs of links and its postures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/detail/kinematics/forward_kinematics.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "oracle/fcl_robots.hpp"
#include "oracle/placement.hpp"
#include "robotics/robots.hpp"

namespace hinge::bench {

inline constexpr std::uint64_t robot_seed = 2005;

/// World poses at one configuration, in the forms that contestants take; computed before timing.
struct Posture {
  std::vector<Pose> groups;              ///< per rigid group
  std::vector<oracle::Placement> links;  ///< per link
};

using oracle::corners;
using oracle::placement;

class Subject {
 public:
  Subject(std::string name, robotics::Robot robot, const robotics::LinkPairs& disabled, std::size_t postures)
      : name_(std::move(name)), robot_(std::move(robot)), tested_(tested_pairs(robot_, disabled)) {
    const Model<Triangle>& model = robot_.model();
    meshes_.resize(robot_.link_count());
    for (std::size_t i = 0; i < model.size(); ++i)
      meshes_[index(model.links()[i])].push_back(corners(model.primitives()[i]));
    for (const auto& [a, b] : tested_.list()) pairs_.emplace_back(index(a), index(b));
    make_postures(postures);
  }

  const std::string& name() const noexcept { return name_; }
  const robotics::Robot& robot() const noexcept { return robot_; }
  robotics::LinkPairFilter filter() const { return {robot_, tested_}; }
  /// Per link, in the link frame; empty for a link without triangles.
  std::span<const oracle::Mesh> meshes() const noexcept { return meshes_; }
  const oracle::Pairs& pairs() const noexcept { return pairs_; }
  std::span<const Posture> postures() const noexcept { return postures_; }
  /// Configurations for calibrating the order of pairs, one value per DOF; never timed.
  std::vector<std::vector<double>> training(std::size_t count) const {
    std::vector<std::vector<double>> configurations;
    for (std::size_t k = 0; k < count; ++k) {
      SampleStream stream(robot_seed + 1, k);
      configurations.push_back(robot_.expand(test::random_configuration(robot_, stream)));
    }
    return configurations;
  }
  /// Postures at the given configurations, one value per DOF.
  std::vector<Posture> postures_at(std::span<const std::vector<double>> configurations) const {
    const KinematicTree& tree = robot_.model().tree();
    const auto groups = std::make_shared<const RigidGroups>(tree, DofSelection::all(tree));
    detail::ForwardKinematics source(groups, tree.dof_count());
    std::vector<Posture> postures;
    for (const std::vector<double>& q : configurations) {
      source.set_configuration(q);
      Posture& posture = postures.emplace_back();
      for (std::size_t g = 0; g < groups->size(); ++g) posture.groups.push_back(source.pose(id<GroupId>(g)));
      for (std::size_t l = 0; l < tree.link_count(); ++l) {
        const auto link = id<LinkId>(l);
        posture.links.push_back(placement(posture.groups[index(groups->group_of(link))] * groups->link_in_group(link)));
      }
    }
    return postures;
  }
  /// Links with triangles that are fixed to the world.
  std::span<const std::size_t> base() const noexcept { return base_; }

 private:
  void make_postures(std::size_t count) {
    std::vector<std::vector<double>> configurations;
    for (std::size_t k = 0; k < count; ++k) {
      SampleStream stream(robot_seed, k);
      configurations.push_back(robot_.expand(test::random_configuration(robot_, stream)));
    }
    postures_ = postures_at(configurations);
    const KinematicTree& tree = robot_.model().tree();
    const RigidGroups rigid(tree, DofSelection::all(tree));
    for (std::size_t l = 0; l < tree.link_count(); ++l)
      if (!meshes_[l].empty() && rigid.group_of(id<LinkId>(l)) == GroupId{}) base_.push_back(l);
  }

  std::string name_;
  robotics::Robot robot_;
  robotics::LinkPairs tested_;
  std::vector<oracle::Mesh> meshes_;
  oracle::Pairs pairs_;
  std::vector<Posture> postures_;
  std::vector<std::size_t> base_;
};

}  // namespace hinge::bench
