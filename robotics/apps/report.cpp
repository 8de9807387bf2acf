// SPDX-License-Identifier: BSD-3-Clause
// Implements the common parts of the outputs.
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge_tools/csv_field.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::csv_field;

namespace {

std::size_t links_with_geometry(const Robot& robot) {
  std::size_t count = 0;
  for (std::size_t l = 1; l < robot.link_count(); ++l)
    count += robot.triangle_count(hinge::id<hinge::LinkId>(l)) > 0 ? 1U : 0U;
  return count;
}

std::size_t rigid_groups(const Robot& robot) {
  const hinge::KinematicTree& tree = robot.model().tree();
  return hinge::RigidGroups(tree, hinge::DofSelection::all(tree)).size();
}

Json point_json(const hinge::Vec3& x) { return {x[0], x[1], x[2]}; }

/// One finding: two names, with distance and points if they are known.
struct Finding {
  const char* kind;
  const std::string& first;
  const std::string& second;
  const double* distance = nullptr;
  const hinge::Vec3* point1 = nullptr;
  const hinge::Vec3* point2 = nullptr;
};

/// Calls visit(finding) for every finding, in the order of the JSON keys.
template <class Visit>
void for_each_finding(const Worker& worker, const Answer& answer, const Visit& visit) {
  const auto link = [&](hinge::LinkId l) -> const std::string& { return worker.checker.robot().link_name(l); };
  const auto body = [&](BodyId b) -> const std::string& { return worker.environment->name(b); };
  const auto& near = answer.self.distances;  // mode within: of the same pairs
  for (const ClosestLinks& c : near)
    visit(Finding{"pair", link(c.link1), link(c.link2), &c.distance, &c.point1, &c.point2});
  if (near.empty())
    for (const LinkContact& pair : answer.self.pairs) visit(Finding{"pair", link(pair.link1), link(pair.link2)});
  if (const auto& c = answer.self.closest)
    visit(Finding{"closest", link(c->link1), link(c->link2), &c->distance, &c->point1, &c->point2});
  for (const ClosestBody& c : answer.body_distances)
    visit(Finding{"environment_pair", link(c.link), body(c.body), &c.distance, &c.point1, &c.point2});
  if (answer.body_distances.empty())
    for (const BodyContact& pair : answer.body_pairs)
      visit(Finding{"environment_pair", link(pair.link), body(pair.body)});
  if (const auto& c = answer.closest_body)
    visit(Finding{"environment_closest", link(c->link), body(c->body), &c->distance, &c->point1, &c->point2});
  for (const LinkContainment& c : answer.contained) visit(Finding{"contained", link(c.outer), link(c.inner)});
  for (const BodyContainment& c : answer.contained_bodies)
    visit(c.body_is_outer ? Finding{"environment_contained", body(c.body), link(c.link)}
                          : Finding{"environment_contained", link(c.link), body(c.body)});
}

Json pair_json(const Finding& f, const char* second_key) {
  const std::string kind = f.kind;
  if (kind.ends_with("contained")) return Json{{"outer", f.first}, {"inner", f.second}};
  Json json{{second_key[0] == 'b' ? "link" : "link1", f.first}, {second_key, f.second}};
  if (f.distance == nullptr) return json;
  json["distance"] = *f.distance;
  json["point1"] = point_json(*f.point1);
  json["point2"] = point_json(*f.point2);
  return json;
}

}  // namespace

Json robot_json(const Options& options, const Job& job) {
  const Robot& robot = *job.robot;
  return Json{{"file", options.urdf},
              {"name", robot.name()},
              {"links", robot.link_count() - 1},
              {"links_with_geometry", links_with_geometry(robot)},
              {"triangles", robot.model().size()},
              {"degenerate_triangles", robot.degenerate_count()},
              {"dof", robot.independent_joints().size()},
              {"movable_joints", robot.model().tree().dof_count()},
              {"rigid_groups", rigid_groups(robot)},
              {"disabled_pairs", job.disabled.size()},
              {"tested_pairs", job.tested.size()},
              {"primitives", options.reference_primitives ? "reference" : "exact"},
              {"incomplete_links", robot.description().incomplete}};
}

Json joint_names(const Robot& robot) {
  Json names = Json::array();
  for (std::size_t k = 0; k < robot.independent_joints().size(); ++k) names.push_back(robot.independent_name(k));
  return names;
}

Json body_names(const Job& job) {
  Json names = Json::array();
  for (const Body& body : job.bodies) names.push_back(body.name);
  return names;
}

Json allowed_json(const Job& job) {
  Json pairs = Json::array();
  for (const auto& [link, body] : job.allowed) pairs.push_back({{"link", link}, {"body", body}});
  return pairs;
}

Json answer_json(const Worker& worker, std::size_t index, const std::vector<double>& q, const Answer& answer,
                 const Columns& columns) {
  const bool lists = columns.mode.kind == Mode::Kind::all || columns.mode.kind == Mode::Kind::within;
  const bool ranks = columns.mode.kind == Mode::Kind::closest;
  Json json{{"index", index}, {"collides", answer.collides}, {"values", q}};
  const Json nothing, empty = Json::array();
  if (lists) json["pairs"] = empty;
  if (ranks) json["closest"] = nothing;
  if (lists && columns.environment) json["environment_pairs"] = empty;
  if (ranks && columns.environment) json["environment_closest"] = nothing;
  if (columns.contained) json["contained"] = empty;
  if (columns.contained && columns.environment) json["environment_contained"] = empty;
  for_each_finding(worker, answer, [&](const Finding& f) {
    const std::string kind = f.kind;
    const Json row = pair_json(f, kind.starts_with("environment") ? "body" : "link2");
    if (kind.ends_with("closest")) {
      json[kind] = row;
    } else {
      json[kind.ends_with("pair") ? kind + "s" : kind].push_back(row);
    }
  });
  return json;
}

std::string csv_header() { return "index,collides,finding,first,second,distance,x1,y1,z1,x2,y2,z2\n"; }

std::string csv_rows(const Worker& worker, std::size_t index, const Answer& answer) {
  std::string rows;
  for_each_finding(worker, answer, [&](const Finding& f) {
    rows += fmt::format("{},{:d},{},{},{},", index, answer.collides, f.kind, csv_field(f.first), csv_field(f.second));
    if (f.distance == nullptr) {
      rows += ",,,,,,\n";
      return;
    }
    const hinge::Vec3 &a = *f.point1, &b = *f.point2;
    rows += fmt::format("{},{},{},{},{},{},{}\n", *f.distance, a[0], a[1], a[2], b[0], b[1], b[2]);
  });
  if (rows.empty()) rows = fmt::format("{},{:d},,,,,,,,,,\n", index, answer.collides);
  return rows;
}

std::string pair_lines(const Worker& worker, const Answer& answer) {
  std::string lines;
  for_each_finding(worker, answer, [&](const Finding& f) {
    const std::string kind = f.kind;
    lines += fmt::format("  {} {} {}", f.first, kind.ends_with("contained") ? "contains" : "-", f.second);
    if (f.distance != nullptr)
      lines += fmt::format("  {:.6g} m{}", *f.distance, kind.ends_with("closest") ? "  (closest)" : "");
    lines += "\n";
  });
  return lines;
}

std::vector<std::pair<std::string, std::string>> named_pairs(const Worker& worker, const Answer& answer) {
  std::vector<std::pair<std::string, std::string>> pairs;
  std::set<std::pair<std::string, std::string>> known;  // a containment is often a colliding pair too
  for_each_finding(worker, answer, [&](const Finding& f) {
    if (known.insert(std::minmax(f.first, f.second)).second) pairs.emplace_back(f.first, f.second);
  });
  return pairs;
}

std::string heading(const Options& options, const Job& job) {
  const Robot& robot = *job.robot;
  return fmt::format(
      "{}: robot '{}', {} links, {} with geometry, {} triangles ({} degenerate){}\n"
      "{} DOF, {} movable joints, {} rigid groups; {} pairs of links tested, {} disabled\n",
      options.urdf, robot.name(), robot.link_count() - 1, links_with_geometry(robot), robot.model().size(),
      robot.degenerate_count(), incomplete(robot), robot.independent_joints().size(), robot.model().tree().dof_count(),
      rigid_groups(robot), job.tested.size(), job.disabled.size());
}

}  // namespace robocd
