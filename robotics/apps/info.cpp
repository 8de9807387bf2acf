// SPDX-License-Identifier: BSD-3-Clause
// robocd info: links, joints, rigid groups and tested pairs of a robot.
#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/json_text.hpp"
#include "options.hpp"
#include "report.hpp"

namespace robocd {

using namespace hinge::robotics;

namespace {

/// Properties of a link that are not in the description.
struct LinkFacts {
  std::size_t group = 0;  // index of its rigid group
  std::size_t triangles = 0;
  std::size_t degenerate = 0;
  std::size_t rounded = 0;  // points and segments with a radius: spheres and capsules
  bool closed = false;
};

std::map<hinge::LinkId, LinkFacts> find_facts(const Robot& robot) {
  const hinge::KinematicTree& tree = robot.model().tree();
  const hinge::RigidGroups groups(tree, hinge::DofSelection::all(tree));
  const auto primitives = robot.model().primitives();
  const auto radii = robot.radii();
  std::map<hinge::LinkId, std::vector<hinge::Triangle>> triangles;
  std::map<hinge::LinkId, LinkFacts> all;
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const hinge::Triangle& t = primitives[i];
    const hinge::LinkId link = robot.model().links()[i];
    const bool rounded = !radii.empty() && radii[i] > 0.0;
    const bool flat = hinge::squared_norm(hinge::cross(hinge::Vec3(t.b - t.a), hinge::Vec3(t.c - t.a))) == 0.0;
    all[link].rounded += rounded ? 1U : 0U;
    all[link].degenerate += flat && !rounded ? 1U : 0U;
    triangles[link].push_back(t);
  }
  for (std::size_t l = 1; l < robot.link_count(); ++l) {
    const auto link = hinge::id<hinge::LinkId>(l);
    LinkFacts& facts = all[link];
    facts.group = hinge::index(groups.group_of(link));
    facts.triangles = robot.triangle_count(link);
    facts.closed = facts.triangles > 0 && closed(triangles[link]);
  }
  return all;
}

const char* type_name(JointType type) {
  switch (type) {
    case JointType::fixed: return "fixed";
    case JointType::revolute: return "revolute";
    case JointType::continuous: return "continuous";
    case JointType::prismatic: break;
  }
  return "prismatic";
}

Json links_json(const Robot& robot) {
  Json list = Json::array();
  for (const auto& [link, facts] : find_facts(robot)) {
    Json row{{"name", robot.link_name(link)}, {"group", facts.group}, {"triangles", facts.triangles}};
    row["degenerate_triangles"] = facts.degenerate;
    row["rounded"] = facts.rounded;
    row["closed"] = facts.triangles > 0 ? Json(facts.closed) : Json();
    list.push_back(std::move(row));
  }
  return list;
}

bool has_limits(const JointDescription& joint) {
  return joint.type == JointType::revolute || joint.type == JointType::prismatic;
}

Json joints_json(const Robot& robot) {
  Json list = Json::array();
  for (const JointDescription& joint : robot.description().joints) {
    Json row{{"name", joint.name}, {"type", type_name(joint.type)}, {"parent", joint.parent}, {"child", joint.child}};
    row["lower"] = has_limits(joint) ? Json(joint.lower) : Json();
    row["upper"] = has_limits(joint) ? Json(joint.upper) : Json();
    row["mimic"] = Json();
    if (joint.mimic && joint.type != JointType::fixed)
      row["mimic"] = {
          {"joint", joint.mimic->joint}, {"multiplier", joint.mimic->multiplier}, {"offset", joint.mimic->offset}};
    list.push_back(std::move(row));
  }
  return list;
}

Json pairs_json(const Job& job) {
  Json list = Json::array();
  for (const auto& [a, b] : job.tested.list())
    list.push_back({{"link1", job.robot->link_name(a)}, {"link2", job.robot->link_name(b)}});
  return list;
}

Json states_json(const Job& job) {
  Json list = Json::array();
  for (const NamedConfiguration& state : job.srdf.configurations) {
    Json values = Json::object();
    for (const auto& [position, value] : state.values) values[job.robot->independent_name(position)] = value;
    list.push_back({{"state", state.full_name()}, {"values", std::move(values)}});
  }
  return list;
}

void print_links(const Robot& robot) {
  fmt::print("\n{:<36} {:>5} {:>9} {:>10} {:>7}  mesh\n", "link", "group", "triangles", "degenerate", "rounded");
  for (const auto& [link, facts] : find_facts(robot))
    fmt::print("{:<36} {:>5} {:>9} {:>10} {:>7}  {}\n", robot.link_name(link), facts.group, facts.triangles,
               facts.degenerate, facts.rounded,
               facts.triangles == 0 ? "none"
               : facts.closed       ? "closed"
                                    : "open");
}

void print_joints(const Robot& robot) {
  fmt::print("\n{:<36} {:<10} {:>12} {:>12} unit  follows\n", "movable joint", "type", "lower", "upper");
  for (const JointDescription& joint : robot.description().joints) {
    if (joint.type == JointType::fixed) continue;
    const auto limit = [&](double value) {
      return has_limits(joint) ? fmt::format("{:.6g}", value) : std::string("-");
    };
    std::string follows;
    if (joint.mimic)
      follows = fmt::format("   {:g} * {} + {:g}", joint.mimic->multiplier, joint.mimic->joint, joint.mimic->offset);
    fmt::print("{:<36} {:<10} {:>12} {:>12} {}{}\n", joint.name, type_name(joint.type), limit(joint.lower),
               limit(joint.upper), joint.type == JointType::prismatic ? (follows.empty() ? "m" : "m  ") : "rad",
               follows);
  }
}

}  // namespace

Exit run_info(const Options& options) {
  const Job job = load(options);
  print_notes(job);
  if (options.output == Output::json) {
    Json json{{"tool", "robocd"}, {"command", "info"}, {"robot", robot_json(options, job)}};
    json["links"] = links_json(*job.robot);
    json["joints"] = joints_json(*job.robot);
    json["tested_pairs"] = pairs_json(job);
    json["states"] = states_json(job);
    json["notes"] = job.notes;
    fmt::print("{}\n", hinge::tool::json_text(json, 1));
    return Exit::free;
  }
  fmt::print("{}", heading(options, job));
  print_links(*job.robot);
  print_joints(*job.robot);
  fmt::print("\n{} tested:\n", hinge::tool::counted(job.tested.size(), "pair of links", "pairs of links"));
  if (job.tested.size() > 0) fmt::print("  {:<28} link\n", "link");
  for (const auto& [a, b] : job.tested.list())
    fmt::print("  {:<28} {}\n", job.robot->link_name(a), job.robot->link_name(b));
  for (const NamedConfiguration& state : job.srdf.configurations) fmt::print("state {}\n", state.full_name());
  return Exit::free;
}

}  // namespace robocd
