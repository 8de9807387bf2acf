// SPDX-License-Identifier: BSD-3-Clause
// RobotContestant: Hinge and FCL with one interface, for the same queries on the same postures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/pose.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/query/link_pair_hits.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "oracle/fcl_robots.hpp"
#include "robots/scenery.hpp"
#include "robots/subject.hpp"

namespace hinge::bench {

enum class RobotQuery : std::uint8_t { any, all, distance, environment };
inline constexpr RobotQuery robot_queries[] = {RobotQuery::any, RobotQuery::all, RobotQuery::distance,
                                               RobotQuery::environment};
inline constexpr const char* robot_query_names[] = {"robot-any", "robot-all", "robot-distance", "robot-environment"};
inline const char* name(RobotQuery q) { return robot_query_names[static_cast<std::size_t>(q)]; }

/// The answer to one query; a query sets only its own field.
struct RobotAnswer {
  bool hit = false;
  double distance = std::numeric_limits<double>::infinity();  ///< m
  oracle::Pairs pairs;                                        ///< pairs of links, first < second
};

/// ask: from poses to the answer, all timed.
struct RobotContestant {
  std::string name;
  std::function<void(std::size_t posture, RobotQuery, RobotAnswer&)> ask;
};

using TimedHierarchy = Hierarchy<Triangle, robotics::LinkPairFilter, UniformClearance>;

/// The robot and the scene, with a reused list of pairs.
class HingeRobot {
 public:
  HingeRobot(const Subject& subject, std::shared_ptr<TimedHierarchy> scene)
      : postures_(subject.postures()),
        robot_(subject.robot().model(), subject.filter(), UniformClearance{0.0}),
        links_(robot_.model().model().links()),
        pairs_(links_),
        scene_(std::move(scene)) {
    for (const std::vector<double>& q : subject.training(training_configurations)) {
      robot_.update(q);
      robot_.calibrate_pair_order();
    }
  }

  /// Calibrates the order of links against the scene at its present pose, with the training configurations.
  void learn_scene(const Subject& subject) {
    for (const std::vector<double>& q : subject.training(training_configurations)) {
      robot_.update(q);
      robot_.calibrate_pair_order(*scene_);
    }
  }

  void ask(std::size_t posture, RobotQuery query, RobotAnswer& answer) {
    robot_.update_poses(postures_[posture].groups);
    switch (query) {
      case RobotQuery::any: answer.hit = robot_.self_collides(); return;
      case RobotQuery::all:
        pairs_.clear();
        robot_.self_query(pairs_);
        answer.pairs.clear();
        for (const Hit& hit : pairs_.hits())
          answer.pairs.push_back(std::minmax(index(links_[index(hit.first)]), index(links_[index(hit.second)])));
        return;
      case RobotQuery::distance:
        if (const auto hit = robot_.self_closest()) answer.distance = hit->distance;
        return;
      case RobotQuery::environment: answer.hit = robot_.collides(*scene_); return;
    }
  }

  /// In world coordinates, at the last posture queried.
  TimedHierarchy& robot() noexcept { return robot_; }
  TimedHierarchy& scene() noexcept { return *scene_; }

 private:
  static constexpr std::size_t training_configurations = 200;

  std::span<const Posture> postures_;
  TimedHierarchy robot_;
  std::span<const LinkId> links_;
  LinkPairHits pairs_;
  std::shared_ptr<TimedHierarchy> scene_;
};

/// The robot and its scene in one build of FCL.
template <oracle::FclBuild build>
struct FclPeer {
  std::shared_ptr<oracle::FclRobot<build>> robot;
  std::shared_ptr<oracle::FclScene<build>> scene;

  FclPeer(const Subject& subject, std::shared_ptr<oracle::FclScene<build>> around)
      : robot(std::make_shared<oracle::FclRobot<build>>(subject.meshes(), subject.pairs())), scene(std::move(around)) {
    std::vector<std::vector<oracle::Placement>> postures;
    for (const Posture& posture : subject.postures()) postures.push_back(posture.links);
    robot->set_postures(postures);
  }

  RobotContestant contestant(std::string name, oracle::FclManner manner) const {
    return {std::move(name), [peer = *this, manner](std::size_t posture, RobotQuery query, RobotAnswer& answer) {
              peer.robot->take(posture);
              switch (query) {
                case RobotQuery::any: answer.hit = peer.robot->any(manner); return;
                case RobotQuery::all: return peer.robot->all(manner, answer.pairs);
                case RobotQuery::distance: answer.distance = peer.robot->distance(manner); return;
                case RobotQuery::environment: answer.hit = peer.robot->hits(*peer.scene, manner); return;
              }
            }};
  }
};

}  // namespace hinge::bench
