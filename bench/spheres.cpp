// SPDX-License-Identifier: BSD-3-Clause
// Sphere models: sixteen configurations at once against one at a time, kinematics included, on independent samples
// and on short segments. Capsule models: one at a time. Times are nanoseconds of thread time per configuration; answers
// are compared.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/batch/sphere_batch.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/detail/simd/instruction_set.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/robotics/read_srdf.hpp"
#include "hinge/robotics/read_urdf.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/sphere_model.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "robots/robot_timing.hpp"

namespace {

using namespace hinge;
using namespace hinge::robotics;

constexpr std::uint64_t seed = 16;
constexpr std::size_t blocks = 1000;  // 16 000 configurations, 0.9 MB, read once per pass
constexpr int passes = 20;            // the best pass counts

/// An arm with eight spheres per link, used if the shared data is absent.
RobotDescription generated_arm() {
  RobotDescription arm{"generated", {}, {}};
  for (int l = 0; l < 8; ++l) {
    LinkDescription link{"link" + std::to_string(l)};
    for (int k = 0; k < 8; ++k)
      link.geometry.push_back({SphereShape{0.06}, Pose{Mat3::Identity(), Vec3(0.01 * (k % 3), 0, 0.03 * k)}});
    arm.links.push_back(std::move(link));
    if (l == 0) continue;
    JointDescription joint{"joint" + std::to_string(l), JointType::revolute, "link" + std::to_string(l - 1),
                           "link" + std::to_string(l)};
    joint.origin.translation = Vec3(0, 0, 0.3);
    joint.axis = l % 2 == 0 ? Vec3::UnitY() : Vec3(0.9, 0.0, 0.4);
    joint.lower = -2.7;
    joint.upper = 2.7;
    arm.joints.push_back(std::move(joint));
  }
  return arm;
}

struct Subject {
  Robot robot;
  LinkPairFilter filter;
};

Subject subject() {
  const auto folder = std::filesystem::path(HINGE_SHARED_DATA) / "robots" / "panda";
  const auto urdf = folder / "panda_spherized.urdf";
  if (!std::filesystem::exists(urdf)) {
    Robot robot(generated_arm());
    LinkPairFilter filter(robot, tested_pairs(robot));
    return {std::move(robot), std::move(filter)};
  }
  Robot robot(read_urdf(urdf));
  LinkPairFilter filter(robot, tested_pairs(robot, read_srdf(folder / "panda.srdf", robot).disabled));
  return {std::move(robot), std::move(filter)};
}

using Configurations = std::vector<double>;

Configurations independent(const Robot& robot, std::uint64_t stream_number) {
  SampleStream stream(seed, stream_number);
  Configurations all;
  std::vector<double> q(robot.lower().size());
  for (std::size_t k = 0; k < blocks * SphereBatch::size; ++k) {
    for (std::size_t d = 0; d < q.size(); ++d)
      q[d] = robot.lower()[d] + (robot.upper()[d] - robot.lower()[d]) * stream.uniform();
    const auto full = robot.expand(q);
    all.insert(all.end(), full.begin(), full.end());
  }
  return all;
}

/// Blocks of sixteen states along a segment of at most 0.3 rad (or m) per joint.
Configurations edges(const Robot& robot) {
  SampleStream stream(seed, 2);
  Configurations all;
  std::vector<double> from(robot.lower().size()), step(from.size()), q(from.size());
  for (std::size_t k = 0; k < blocks; ++k) {
    for (std::size_t d = 0; d < q.size(); ++d) {
      from[d] = robot.lower()[d] + (robot.upper()[d] - robot.lower()[d]) * stream.uniform();
      step[d] = 0.3 * (2 * stream.uniform() - 1) / SphereBatch::size;
    }
    for (std::size_t s = 0; s < SphereBatch::size; ++s) {
      for (std::size_t d = 0; d < q.size(); ++d) q[d] = from[d] + static_cast<double>(s) * step[d];
      const auto full = robot.expand(q);
      all.insert(all.end(), full.begin(), full.end());
    }
  }
  return all;
}

/// Nanoseconds per configuration, in the best of `repetitions` passes over all blocks.
template <class Ask>
double time(std::size_t count, int repetitions, const Ask& ask) {
  double best = 1e300;
  for (int pass = 0; pass < repetitions; ++pass) {
    const double start = bench::thread_seconds();
    for (std::size_t b = 0; b < count; ++b) ask(b);
    best = std::min(best, bench::thread_seconds() - start);
  }
  return 1e9 * best / static_cast<double>(count * SphereBatch::size);
}

/// Returns the number of wrong answers.
int compare(const char* name, const Subject& robot, SphereBatch& batch, const Configurations& all) {
  constexpr std::size_t n = SphereBatch::size;
  const std::size_t dof = batch.dof_count();
  const auto block = [&](std::size_t b) { return std::span(all).subspan(b * n * dof, n * dof); };
  std::vector<std::uint8_t> any(blocks);
  std::vector<detail::simd::Bits> each(blocks);
  const double any_ns = time(blocks, passes, [&](std::size_t b) { any[b] = batch.any(block(b)) ? 1 : 0; });
  const double each_ns = time(blocks, passes, [&](std::size_t b) { each[b] = batch.each(block(b)); });

  const Model<Sphere> model = spheres_of(robot.robot);
  Hierarchy<Sphere, LinkPairFilter, UniformClearance> simd(model, robot.filter, UniformClearance{0.0});
  Hierarchy<Sphere, LinkPairFilter, UniformClearance, Brute> brute(model, robot.filter, UniformClearance{0.0});
  std::vector<detail::simd::Bits> expected(blocks), by_simd(blocks);
  const auto one_by_one = [&](auto& hierarchy, std::vector<detail::simd::Bits>& to) {
    return [&](std::size_t b) {
      to[b] = 0;
      for (std::size_t k = 0; k < n; ++k) {
        hierarchy.update(block(b).subspan(k * dof, dof));
        if (hierarchy.self_collides()) to[b] |= detail::simd::Bits{1} << k;
      }
    };
  };
  const double simd_ns = time(blocks, 3, one_by_one(simd, by_simd));
  const double brute_ns = time(blocks, 1, one_by_one(brute, expected));
  int wrong = 0;
  std::size_t valid = 0, hits = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    wrong += each[b] == expected[b] && by_simd[b] == expected[b] && (any[b] != 0) == (expected[b] != 0) ? 0 : 1;
    valid += expected[b] == 0 ? 1 : 0;
    hits += static_cast<std::size_t>(std::popcount(expected[b]));
  }
  std::printf("%-12s any %6.1f  each %6.1f  one at a time: simd %7.1f  brute %8.1f  ratio %5.1f %5.1f\n", name, any_ns,
              each_ns, simd_ns, brute_ns, simd_ns / any_ns, simd_ns / each_ns);
  std::printf("%-12s valid blocks %.4f, hits %.4f, wrong blocks %d\n", "",
              static_cast<double>(valid) / static_cast<double>(blocks),
              static_cast<double>(hits) / static_cast<double>(blocks * n), wrong);
  return wrong;
}

/// Capsules of an arm whose neighbouring links are not tested.
struct NotNeighbours {
  std::vector<LinkId> links;
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    const std::size_t a = index(links[index(i)]), b = index(links[index(j)]);
    return std::max(a, b) - std::min(a, b) > 1;
  }
};

/// Nine links of 0.3 m with `per_link` capsules each. Returns the number of wrong answers.
int time_capsules(std::size_t per_link) {
  constexpr std::size_t links = 9, states = 2000;
  ModelBuilder<Capsule> build;
  LinkId parent = world;
  for (std::size_t l = 0; l < links; ++l) {
    std::vector<Capsule> capsules;
    for (std::size_t k = 0; k < per_link; ++k) {
      const auto from = 0.3 * static_cast<double>(k) / static_cast<double>(per_link),
                 to = 0.3 * static_cast<double>(k + 1) / static_cast<double>(per_link);
      capsules.push_back({Vec3(0, 0, from), Vec3(0.01, 0, to), 0.05});
    }
    Pose origin;
    if (l > 0) origin.translation = Vec3(0, 0, 0.33);
    parent = build.add_link(parent, Revolute{l % 2 == 0 ? Vec3::UnitY() : Vec3::UnitX(), Vec3::Zero(), origin, {}},
                            std::move(capsules));
  }
  const Model<Capsule> model = build.finish();
  const NotNeighbours filter{{model.links().begin(), model.links().end()}};
  Hierarchy<Capsule, NotNeighbours, UniformClearance> simd(model, filter, UniformClearance{0.0});
  Hierarchy<Capsule, NotNeighbours, UniformClearance, Brute> brute(model, filter, UniformClearance{0.0});
  SampleStream stream(seed, 4);
  std::vector<double> all(states * links);
  for (double& value : all) value = 2.4 * (2 * stream.uniform() - 1);
  std::vector<std::uint8_t> verdicts[2] = {std::vector<std::uint8_t>(states), std::vector<std::uint8_t>(states)};
  const auto one_by_one = [&](auto& hierarchy, std::vector<std::uint8_t>& to) {
    return [&](std::size_t b) {
      for (std::size_t k = b * SphereBatch::size; k < (b + 1) * SphereBatch::size; ++k) {
        hierarchy.update(std::span(all).subspan(k * links, links));
        to[k] = hierarchy.self_collides() ? 1 : 0;
      }
    };
  };
  const double simd_ns = time(states / SphereBatch::size, passes, one_by_one(simd, verdicts[0]));
  const double brute_ns = time(states / SphereBatch::size, 3, one_by_one(brute, verdicts[1]));
  const auto hits = std::count(verdicts[1].begin(), verdicts[1].end(), 1);
  std::printf("%zu capsules, %.1f %% of %zu states collide; one at a time: simd %.1f  brute %.1f\n", model.size(),
              100.0 * static_cast<double>(hits) / states, states, simd_ns, brute_ns);
  return verdicts[0] == verdicts[1] ? 0 : 1;
}

}  // namespace

int main() {
  const Subject robot = subject();
  SphereBatch batch(spheres_of(robot.robot), robot.filter);
  std::printf("%s: %zu spheres, %zu DOF, %zu pairs of links, %zu pairs of spheres; %s; ns per configuration\n",
              robot.robot.name().c_str(), spheres_of(robot.robot).size(), batch.dof_count(),
              robot.filter.tested().size(), batch.pair_count(),
              std::string(detail::simd::name(detail::simd::compiled_for())).c_str());
  batch.learn(independent(robot.robot, 1));
  int wrong = compare("independent", robot, batch, independent(robot.robot, 3));
  wrong += compare("edges", robot, batch, edges(robot.robot));
  std::printf("decided in double: %llu pairs\n", static_cast<unsigned long long>(batch.decided_count()));
  for (const std::size_t per_link : {1U, 3U, 7U}) wrong += time_capsules(per_link);
  return wrong == 0 ? 0 : 1;
}
