// SPDX-License-Identifier: BSD-3-Clause
// Compares robots with FCL for every pair of links. FCL is unreliable near touching: exact arithmetic on Hinge's
// coordinates settles and prints every disagreement.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/query/link_pair_hits.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/robot_description.hpp"
#include "hinge/robotics/shape.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "oracle/fcl_robots.hpp"
#include "oracle/placement.hpp"
#include "robotics/robots.hpp"

namespace hinge {
namespace robots_test {

constexpr std::uint64_t seed = 2005;

/// In m: the largest error that rounding in FCL can explain. A larger difference is a mistake in how FCL is called.
constexpr double rounding = 1e-9;

std::span<const Triangle> of_link(const robotics::Robot& robot, std::span<const Triangle> placed, std::size_t link) {
  const std::span<const LinkId> links = robot.model().links();
  const auto [first, last] = std::equal_range(links.begin(), links.end(), id<LinkId>(link));
  return placed.subspan(static_cast<std::size_t>(first - links.begin()), static_cast<std::size_t>(last - first));
}

/// Returns the distance over all pairs of triangles: 0 if and only if the links share a point; infinity above
/// `farthest` (m).
double exact_distance(std::span<const Triangle> a, std::span<const Triangle> b, double farthest) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& s : a) {
    const Aabb around = s.bounds().inflated(farthest);
    for (const Triangle& t : b) {
      if (!overlap(around, t.bounds())) continue;
      if (closer_than(s, t, 0.0)) return 0.0;
      least = std::min(least, std::sqrt(squared_distance(s, t)));
    }
  }
  return least;
}

/// Pairs of links that only Hinge or only FCL finds in contact.
struct Disagreements {
  std::size_t hinge_only = 0, fcl_only = 0;
  double widest = 0.0;  ///< m: largest distance of such a pair by the other method, exact arithmetic or FCL
};

/// One robot in an engine of Hinge and in FCL.
template <template <class, class, class> class EngineOf>
class Compared {
 public:
  Compared(const robotics::Robot& robot, const robotics::LinkPairs& disabled)
      : robot_(robot),
        tested_(tested_pairs(robot, disabled)),
        hierarchy_(robot.model(), robotics::LinkPairFilter(robot, tested_), UniformClearance{0.0}),
        fcl_(meshes(robot), pairs(tested_)),
        links_(hierarchy_.model().model().links()),
        hits_(links_) {}

  std::size_t colliding() const noexcept { return colliding_; }
  const Disagreements& disagreements() const noexcept { return disagreements_; }

  /// Returns the links that are in contact according to Hinge.
  const oracle::Pairs& contacts(std::span<const double> independent) {
    hierarchy_.update(robot_.expand(independent));
    hits_.clear();
    hierarchy_.self_query(hits_);
    contacts_.clear();
    for (const Hit& hit : hits_.hits())
      contacts_.push_back(std::minmax(index(links_[index(hit.first)]), index(links_[index(hit.second)])));
    std::sort(contacts_.begin(), contacts_.end());
    return contacts_;
  }

  void compare(std::span<const double> independent) {
    contacts(independent);
    colliding_ += contacts_.empty() ? 0 : 1;
    EXPECT_EQ(hierarchy_.self_collides(), !contacts_.empty());
    std::vector<oracle::Placement> at;
    for (std::size_t l = 0; l < robot_.link_count(); ++l)
      at.push_back(oracle::placement(hierarchy_.link_pose(id<LinkId>(l))));
    fcl_.set_postures({&at, 1});
    for (const auto& [a, b] : tested_.list()) {
      const std::pair pair(index(a), index(b));
      const bool hinge = std::binary_search(contacts_.begin(), contacts_.end(), pair);
      const bool fcl = fcl_.collide(pair.first, pair.second);
      if (hinge != fcl) settle(pair, hinge);
    }
  }

 private:
  using H = Hierarchy<Triangle, robotics::LinkPairFilter, UniformClearance, EngineOf>;

  static std::vector<oracle::Mesh> meshes(const robotics::Robot& robot) {
    std::vector<oracle::Mesh> meshes(robot.link_count());
    for (std::size_t i = 0; i < robot.model().size(); ++i)
      meshes[index(robot.model().links()[i])].push_back(oracle::corners(robot.model().primitives()[i]));
    return meshes;
  }
  static oracle::Pairs pairs(const robotics::LinkPairs& tested) {
    oracle::Pairs pairs;
    for (const auto& [a, b] : tested.list()) pairs.emplace_back(index(a), index(b));
    return pairs;
  }

  void settle(std::pair<std::size_t, std::size_t> pair, bool hinge) {
    const auto placed = hierarchy_.placed();
    const double truth =
        exact_distance(of_link(robot_, placed, pair.first), of_link(robot_, placed, pair.second), 1e-3);
    const double fcl_distance = fcl_.distance(pair.first, pair.second);
    std::printf("  %s and %s: hinge %s, FCL %s; exact distance %.3g m, FCL's %.3g m\n",
                robot_.link_name(id<LinkId>(pair.first)).c_str(), robot_.link_name(id<LinkId>(pair.second)).c_str(),
                hinge ? "yes" : "no", hinge ? "no" : "yes", truth, fcl_distance);
    EXPECT_EQ(hinge, truth == 0.0) << "exact arithmetic disagrees with Hinge";
    (hinge ? disagreements_.hinge_only : disagreements_.fcl_only) += 1;
    disagreements_.widest = std::max(disagreements_.widest, hinge ? fcl_distance : truth);
  }

  const robotics::Robot& robot_;
  robotics::LinkPairs tested_;
  H hierarchy_;
  oracle::FclRobot<oracle::FclBuild::debian> fcl_;
  std::span<const LinkId> links_;
  LinkPairHits hits_;
  oracle::Pairs contacts_;
  std::size_t colliding_ = 0;
  Disagreements disagreements_;
};

/// A chain of five links with every shape, including a mesh that is not convex.
robotics::Robot made_in_code() {
  using namespace robotics;
  TriangleMesh fan;  // blades about the z axis, not closed
  for (int k = 0; k < 12; ++k) {
    const double angle = 0.6 * k;
    fan.triangles.push_back(
        {Vec3(0, 0, 0.02 * k), Vec3(0.2 * std::cos(angle), 0.2 * std::sin(angle), 0.1), Vec3(0, 0.03, 0.25)});
  }
  const std::vector<Shape> shapes = {BoxShape{Vec3(0.2, 0.1, 0.3)}, SphereShape{0.12}, CylinderShape{0.08, 0.3},
                                     MeshShape{std::make_shared<const TriangleMesh>(fan)},
                                     BoxShape{Vec3(0.1, 0.3, 0.1)}};
  RobotDescription description;
  description.name = "made-in-code";
  for (std::size_t k = 0; k < 2 * shapes.size(); ++k) {
    LinkDescription link;
    link.name = "link" + std::to_string(k);
    link.geometry.push_back({shapes[k % shapes.size()]});
    description.links.push_back(std::move(link));
    if (k == 0) continue;
    JointDescription joint;
    joint.name = "joint" + std::to_string(k);
    joint.type = JointType::revolute;
    joint.parent = "link" + std::to_string(k - 1);
    joint.child = "link" + std::to_string(k);
    joint.origin.translation = Vec3(0.05, 0.02, 0.3);
    joint.axis = k % 2 == 0 ? Vec3(1, 0, 0.2) : Vec3(0, 1, 0.3);
    joint.lower = -2.5;
    joint.upper = 2.5;
    description.joints.push_back(std::move(joint));
  }
  return Robot(std::move(description), {Tessellation::Manner::inscribed});
}

bool tries_all() { return std::getenv("HINGE_TEST_ALL") != nullptr; }

template <template <class, class, class> class EngineOf>
void compare_at_random(const char* engine, const robotics::Robot& robot, const robotics::LinkPairs& disabled,
                       std::uint64_t configurations) {
  Compared<EngineOf> compared(robot, disabled);
  for (std::uint64_t k = 0; k < configurations; ++k) {
    SCOPED_TRACE(k);
    SampleStream stream(seed, k);
    compared.compare(test::random_configuration(robot, stream));
    if (testing::Test::HasFailure()) return;
  }
  std::printf(
      "%s, %s, seed %d: %d configurations, %zu in collision; in contact for Hinge alone %zu, for FCL alone %zu\n",
      robot.name().c_str(), engine, static_cast<int>(seed), static_cast<int>(configurations), compared.colliding(),
      compared.disagreements().hinge_only, compared.disagreements().fcl_only);
  EXPECT_LE(compared.disagreements().widest, rounding);
  EXPECT_GT(compared.colliding(), 0U);
  EXPECT_LT(compared.colliding(), configurations);
}

/// The lazy engine is slow on meshes, so it gets fewer configurations.
void compare_both(const robotics::Robot& robot, const robotics::LinkPairs& disabled, std::uint64_t configurations,
                  std::uint64_t lazy_configurations) {
  compare_at_random<Simd>("simd", robot, disabled, configurations);
  compare_at_random<Lazy>("lazy", robot, disabled, lazy_configurations);
}

TEST(FclRobots, AgreeOnARobotMadeInCode) {
  const robotics::Robot robot = made_in_code();
  compare_both(robot, robotics::LinkPairs(robot.link_count()), tries_all() ? 10'000 : 200, tries_all() ? 1'000 : 50);
}

TEST(FclRobots, AgreeOnPanda) {
  if (!std::filesystem::exists(test::shared_folder("panda"))) GTEST_SKIP() << "no shared data";
  const auto [robot, disabled] = test::load_shared("panda");
  compare_both(robot, disabled, tries_all() ? 10'000 : 50, tries_all() ? 1'000 : 50);
}

TEST(FclRobots, AgreeOnTalos) {
  if (!std::filesystem::exists(test::shared_folder("talos"))) GTEST_SKIP() << "no shared data";
  const auto [robot, disabled] = test::load_shared("talos");
  compare_both(robot, disabled, tries_all() ? 10'000 : 10, tries_all() ? 200 : 10);
}

/// Bisects between a free and a colliding configuration until no double is between them. FCL rounds poses differently,
/// so its answer may differ there; Hinge must be right on its own coordinates.
void settle_at_contact(const robotics::Robot& robot, const robotics::LinkPairs& disabled, std::uint64_t paths) {
  Compared<Simd> compared(robot, disabled);
  std::uint64_t bisected = 0;
  for (std::uint64_t k = 0; bisected < paths && k < 100 * paths; ++k) {
    SCOPED_TRACE(k);
    SampleStream stream(seed + 1, k);
    const std::vector<double> from = test::random_configuration(robot, stream);
    const std::vector<double> to = test::random_configuration(robot, stream);
    const auto at = [&](double t) {
      std::vector<double> q;
      for (std::size_t i = 0; i < from.size(); ++i) q.push_back(from[i] + t * (to[i] - from[i]));
      return q;
    };
    const bool hits_first = !compared.contacts(at(0.0)).empty();
    if (hits_first == !compared.contacts(at(1.0)).empty()) continue;
    double low = 0.0, high = 1.0;
    for (double middle = 0.5; low < middle && middle < high; middle = low + (high - low) / 2)
      (!compared.contacts(at(middle)).empty() == hits_first ? low : high) = middle;
    compared.compare(at(low));
    compared.compare(at(high));
    ++bisected;
    if (testing::Test::HasFailure()) return;
  }
  const Disagreements& found = compared.disagreements();
  std::printf(
      "%s, seed %d: %d contacts bisected; in contact for Hinge alone %zu, for FCL alone %zu, at most %.2g m apart\n",
      robot.name().c_str(), static_cast<int>(seed + 1), static_cast<int>(bisected), found.hinge_only, found.fcl_only,
      found.widest);
  EXPECT_EQ(bisected, paths);
  EXPECT_LE(found.widest, rounding);
}

TEST(FclRobots, AreSettledExactlyAtContactsOfARobotMadeInCode) {
  const robotics::Robot robot = made_in_code();
  settle_at_contact(robot, robotics::LinkPairs(robot.link_count()), tries_all() ? 1'000 : 30);
}

TEST(FclRobots, AreSettledExactlyAtContactsOfPanda) {
  if (!std::filesystem::exists(test::shared_folder("panda"))) GTEST_SKIP() << "no shared data";
  const auto [robot, disabled] = test::load_shared("panda");
  settle_at_contact(robot, disabled, tries_all() ? 1'000 : 10);
}

}  // namespace robots_test
}  // namespace hinge
