// SPDX-License-Identifier: BSD-3-Clause
// Implements find_extremes().
#include "dial_extremes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "extremes_peer.hpp"
#include "float_triangle.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/random_configuration.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tiers.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/near_contact.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::WrongVerdicts;

RobotDescription scaled(RobotDescription robot, double scale) {
  std::map<std::string, bool> slides;
  for (const JointDescription& joint : robot.joints) slides[joint.name] = joint.type == JointType::prismatic;
  for (LinkDescription& link : robot.links)
    for (PlacedShape& placed : link.geometry) {
      placed.origin.translation *= scale;
      if (auto* box = std::get_if<BoxShape>(&placed.shape)) box->size *= scale;
      if (auto* sphere = std::get_if<SphereShape>(&placed.shape)) sphere->radius *= scale;
      if (auto* cylinder = std::get_if<CylinderShape>(&placed.shape)) {
        cylinder->radius *= scale;
        cylinder->length *= scale;
      }
      if (auto* capsule = std::get_if<CapsuleShape>(&placed.shape)) {
        capsule->radius *= scale;
        capsule->length *= scale;
      }
      if (auto* mesh = std::get_if<MeshShape>(&placed.shape)) mesh->scale *= scale;
      if (auto* cloud = std::get_if<PointCloudShape>(&placed.shape)) {
        auto points = *cloud->points;
        for (hinge::Vec3& point : points) point *= scale;
        *cloud = {std::make_shared<const std::vector<hinge::Vec3>>(std::move(points)), cloud->radius * scale};
      }
    }
  for (JointDescription& joint : robot.joints) {
    joint.origin.translation *= scale;
    const bool slide = joint.type == JointType::prismatic;
    if (slide) {
      joint.lower *= scale;
      joint.upper *= scale;
    }
    if (!joint.mimic) continue;
    if (slide) joint.mimic->offset *= scale;
    if (slide && !slides[joint.mimic->joint]) joint.mimic->multiplier *= scale;
    if (!slide && slides[joint.mimic->joint]) joint.mimic->multiplier /= scale;
  }
  return robot;
}

namespace {

constexpr std::array<Tier, 3> tried_tiers = {Tier::hull, Tier::capsule, Tier::spheres};
constexpr std::size_t most_near_pairs = 200;  // of nearly touching configurations, and of random ones
constexpr double case_seconds = 2.0;          // for each row of the table
constexpr double search_seconds = 5.0;        // for configurations that nearly touch

using Configuration = std::vector<double>;

/// The robot at one scale, exact and with tiers.
struct Copy {
  double scale = 1.0;
  RobotChecker exact;
  std::vector<std::optional<RobotChecker>> tiered;  // empty: the shapes cannot be fitted at this scale
  std::function<bool(RobotChecker&)> peer{};        // empty: there is none, or it has no such shapes
};

Copy make_copy(const Options& options, const Job& job, double scale) {
  Tessellation tessellation = job.robot->tessellation();
  tessellation.tolerance *= scale;
  const RobotDescription description = scaled(job.robot->description(), scale);
  const auto checker = [&](RobotDescription of) {
    const auto robot = std::make_shared<const Robot>(std::move(of), tessellation);
    return RobotChecker(robot, job.tested, LinkMargins(*robot, options.clearance * scale));
  };
  Copy copy{scale, checker(description), {}};
  if (const ExtremesPeer* peer = extremes_peer()) copy.peer = peer->make(copy.exact);
  for (const Tier tier : tried_tiers) {
    Tiers all;
    all.all = tier;
    all.tolerance *= scale;
    try {
      copy.tiered.emplace_back(checker(with_tiers(description, all)));
    } catch (const hinge::ModelError&) {
      copy.tiered.emplace_back();
    }
  }
  return copy;
}

/// Returns the values at another scale: those of prismatic joints are lengths.
Configuration at_scale(const Robot& robot, Configuration q, double scale) {
  for (std::size_t j = 0; j < q.size(); ++j)
    if (robot.description().joints[robot.independent_joints()[j]].type == JointType::prismatic) q[j] *= scale;
  return q;
}

bool collides(RobotChecker& checker, const Configuration& q) {
  checker.update(q);
  return checker.collides();
}

/// The triangles of a link in the world, in single precision.
struct FloatLink {
  std::vector<FloatTriangle> triangles;
  std::vector<double> radii;  // m, by triangle
  FloatBox box;
};

FloatLink place(RobotChecker& checker, hinge::LinkId link) {
  FloatLink placed;
  const auto& model = checker.robot().model();
  const hinge::Pose pose = checker.link_pose(link);
  for (std::size_t i = 0; i < model.size(); ++i) {
    if (model.links()[i] != link) continue;
    const hinge::Triangle t = model.primitives()[i].placed(pose);
    placed.triangles.push_back({to_float(t.a), to_float(t.b), to_float(t.c)});
    placed.radii.push_back(checker.margins().radius(hinge::id<hinge::PrimitiveId>(i)));
    placed.box.add(box_of(placed.triangles.back()));
  }
  return placed;
}

/// Returns the triangles that are no further from the box than `reach`.
std::vector<std::size_t> near_box(const FloatLink& link, const FloatBox& box, float reach) {
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < link.triangles.size(); ++i)
    if (!box_of(link.triangles[i]).apart(box, reach)) near.push_back(i);
  return near;
}

/// Returns the decision in single precision about the surfaces. Pairs of links further apart than `margin` are free
/// without a test, because no rounding bridges it.
bool collides_in_float(RobotChecker& checker, double margin) {
  std::map<hinge::LinkId, FloatLink> links;
  const auto placed = [&](hinge::LinkId link) -> const FloatLink& {
    const auto found = links.find(link);
    return found != links.end() ? found->second : links.emplace(link, place(checker, link)).first->second;
  };
  for (const ClosestLinks& pair : checker.distances(margin)) {
    const FloatLink &a = placed(pair.link1), &b = placed(pair.link2);
    const double clearance = checker.margins().clearance(pair.link1, pair.link2);
    const double radii = std::ranges::max(a.radii) + std::ranges::max(b.radii);
    const auto reach = static_cast<float>(radii + clearance + 2.0 * margin);
    const std::vector<std::size_t> others = near_box(b, a.box, reach);
    for (const std::size_t i : near_box(a, b.box, reach))
      for (const std::size_t j : others)
        if (closer_in_float(a.triangles[i], b.triangles[j], static_cast<float>(a.radii[i] + b.radii[j] + clearance)))
          return true;
  }
  return false;
}

}  // namespace

hinge::tool::DialExtremes find_extremes(const Options& options, const Job& job) {
  hinge::tool::DialExtremes table;
  table.columns = {"case", "asked", "collide", "exact", "hull", "capsule", "spheres", "single precision"};
  const ExtremesPeer* peer = extremes_peer();
  if (peer != nullptr) table.columns.emplace_back(peer->name);
  Copy plain = make_copy(options, job, 1.0);
  const Robot& robot = *job.robot;
  std::vector<Configuration> random, free, colliding;
  hinge::tool::NearContacts contacts;
  const std::vector<Configuration>& near = contacts.all();
  const auto search = hinge::tool::Clock::now();
  const auto wanted = [&] { return random.size() < 2 * most_near_pairs || near.size() < 2 * most_near_pairs; };
  for (std::uint64_t k = 0; wanted() && hinge::tool::seconds_since(search) < search_seconds; ++k) {
    Configuration q(robot.independent_joints().size());
    random_configuration(robot, options.seed, k, q);
    (collides(plain.exact, q) ? colliding : free).push_back(q);
    if (random.size() < 2 * most_near_pairs) random.push_back(std::move(q));
    const std::size_t made = near.size() / 2;
    if (made < most_near_pairs && made < std::min(free.size(), colliding.size()))
      contacts.add([&](const Configuration& at) { return collides(plain.exact, at); }, free[made], colliding[made]);
  }
  if (near.empty())
    table.notes.emplace_back(colliding.empty()
                                 ? "no random configuration collides, so none that nearly touches was found"
                                 : "every random configuration collides, so none that nearly touches was found");
  std::vector<bool> verdicts;  // of `near`, at scale 1 without displacement
  for (const Configuration& q : near) verdicts.push_back(collides(plain.exact, q));

  const auto add = [&](const std::string& name, Copy& copy, const std::vector<Configuration>& asked, bool compares,
                       double displaced) {
    const hinge::tool::Clock::time_point start = hinge::tool::Clock::now();
    std::array<WrongVerdicts, 3> of_tier;
    WrongVerdicts of_float, of_peer;
    std::size_t count = 0, hits = 0, changed = 0;
    hinge::Pose base;
    base.translation = hinge::Vec3(displaced, displaced, displaced);
    if (displaced != 0.0) {
      copy.exact.set_base(base);
      for (auto& checker : copy.tiered)
        if (checker) checker->set_base(base);
    }
    const double margin = (displaced + 4.0 * copy.scale) * 0x1p-20;
    for (; count < asked.size() && hinge::tool::seconds_since(start) < case_seconds; ++count) {
      const Configuration q = at_scale(robot, asked[count], copy.scale);
      const bool truth = collides(copy.exact, q);
      hits += truth ? 1U : 0U;
      changed += compares && truth != verdicts[count] ? 1U : 0U;
      for (std::size_t t = 0; t < tried_tiers.size(); ++t)
        if (copy.tiered[t]) of_tier[t].count(truth, collides(*copy.tiered[t], q));
      const bool surfaces = !copy.exact.triangle_pairs().empty();
      of_float.count(surfaces, collides_in_float(copy.exact, margin));
      if (copy.peer) of_peer.count(surfaces, copy.peer(copy.exact));
    }
    const std::string exact = !compares ? "" : changed == 0 ? "same" : fmt::format("{} changed", changed);
    std::vector<std::string> row{name, fmt::format("{}", count), fmt::format("{}", hits), exact};
    for (std::size_t t = 0; t < tried_tiers.size(); ++t)
      row.push_back(copy.tiered[t] ? of_tier[t].text() : "cannot be fitted");
    row.push_back(of_float.text());
    if (peer != nullptr) row.push_back(copy.peer ? of_peer.text() : "no such shapes");
    table.rows.push_back(std::move(row));
  };
  add("random", plain, random, false, 0.0);
  if (near.empty()) return table;
  for (const auto& [step, name] : hinge::tool::steps_from_contact)
    add(fmt::format("{} rad or m from contact", name), plain, contacts.apart(step), false, 0.0);
  add("nearly touching", plain, near, true, 0.0);
  for (const int power : {-20, -10, 10, 20}) {
    Copy copy = make_copy(options, job, std::ldexp(1.0, power));
    add(fmt::format("nearly touching, scaled by 2^{}", power), copy, near, true, 0.0);
  }
  for (const auto& [displaced, name] : {std::pair{1.0, "1 m"}, {1e3, "1 km"}, {1e6, "1000 km"}})
    add(fmt::format("nearly touching, displaced by {}", name), plain, near, true, displaced);
  table.notes.emplace_back(
      "nearly touching: a free and a colliding configuration, with no number between their places on a straight line");
  table.notes.emplace_back("rad or m from contact: these two, each moved away from the other by so much");
  table.notes.emplace_back("exact: verdicts that differ from those without scale and displacement");
  table.notes.emplace_back("missed, false: compared with the exact verdict of the same case");
  table.notes.emplace_back(
      "single precision: triangles in the world as floats, decisions without error bounds, about surfaces only");
  if (peer != nullptr)
    table.notes.push_back(
        fmt::format("{}: meshes, spheres and capsules in double precision, surfaces only", peer->name));
  if (!job.bodies.empty()) table.notes.emplace_back("bodies of --env are left out");
  return table;
}

}  // namespace robocd
