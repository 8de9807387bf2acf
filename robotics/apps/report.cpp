// SPDX-License-Identifier: BSD-3-Clause
// Implements the common parts of the outputs.
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/csv_field.hpp"
#include "hinge_tools/max_pairs_option.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::counted;
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

/// One finding: two names, with distance and points if they are known.
struct Finding {
  const char* kind;
  const std::string& first;
  const std::string& second;
  const double* distance = nullptr;
  const hinge::Vec3* point1 = nullptr;
  const hinge::Vec3* point2 = nullptr;
  const std::string* holder = nullptr;  // the link that holds `first`, if that is a body
};

/// Calls visit(finding) for every finding, in the order of the JSON keys.
template <class Visit>
void for_each_finding(const Worker& worker, const Answer& answer, const Visit& visit) {
  const auto link = [&](hinge::LinkId l) -> const std::string& { return worker.checker.robot().link_name(l); };
  const auto body = [&](BodyId b) -> const std::string& { return worker.environment->name(b); };
  const auto part = [&](const auto& c) -> const std::string& { return c.held ? body(*c.held) : link(c.link); };
  const auto holder = [&](const auto& c) { return c.held ? &link(c.link) : nullptr; };
  const auto& near = answer.self.distances;  // mode within: of the same pairs
  for (const ClosestLinks& c : near)
    visit(Finding{"pair", link(c.link1), link(c.link2), &c.distance, &c.point1, &c.point2});
  if (near.empty())
    for (const LinkContact& pair : answer.self.pairs) visit(Finding{"pair", link(pair.link1), link(pair.link2)});
  if (const auto& c = answer.self.closest)
    visit(Finding{"closest", link(c->link1), link(c->link2), &c->distance, &c->point1, &c->point2});
  for (const ClosestBody& c : answer.body_distances)
    visit(Finding{"environment_pair", part(c), body(c.body), &c.distance, &c.point1, &c.point2, holder(c)});
  if (answer.body_distances.empty())
    for (const BodyContact& pair : answer.body_pairs)
      visit(Finding{"environment_pair", part(pair), body(pair.body), nullptr, nullptr, nullptr, holder(pair)});
  if (const auto& c = answer.closest_body)
    visit(Finding{"environment_closest", part(*c), body(c->body), &c->distance, &c->point1, &c->point2, holder(*c)});
  for (const LinkContainment& c : answer.contained) visit(Finding{"contained", link(c.outer), link(c.inner)});
  for (const BodyContainment& c : answer.contained_bodies)
    visit(c.body_is_outer ? Finding{"environment_contained", body(c.body), part(c)}
                          : Finding{"environment_contained", part(c), body(c.body)});
}

/// Calls visit(finding) for the findings that are printed. Closest pairs are no list, so they always are. is_table:
/// false for JSON and CSV. Returns the number of the others.
template <class Visit>
std::size_t for_each_printed(const Worker& worker, const Answer& answer, const std::optional<std::uint64_t>& max_pairs,
                             bool is_table, const Visit& visit) {
  const auto is_listed = [](const Finding& f) { return !std::string_view(f.kind).ends_with("closest"); };
  std::size_t listed = 0, k = 0;
  for_each_finding(worker, answer, [&](const Finding& f) { listed += is_listed(f) ? 1U : 0U; });
  const std::size_t printed = hinge::tool::pairs_to_print(max_pairs, is_table, listed);
  for_each_finding(worker, answer, [&](const Finding& f) {
    if (!is_listed(f) || k++ < printed) visit(f);
  });
  return listed - printed;
}

Json pair_json(const Finding& f, const char* second_key) {
  const std::string kind = f.kind;
  if (kind.ends_with("contained")) return Json{{"outer", f.first}, {"inner", f.second}};
  Json json{{second_key[0] == 'b' ? "link" : "link1", f.holder != nullptr ? *f.holder : f.first}};
  if (f.holder != nullptr) json["held"] = f.first;
  json[second_key] = f.second;
  if (f.distance == nullptr) return json;
  json["distance"] = *f.distance;
  json["point1"] = point_json(*f.point1);
  json["point2"] = point_json(*f.point2);
  return json;
}

std::string robot_text(const Options& options, const Robot& robot) {
  std::string tiers;
  for (const std::string& word : options.tiers) tiers += (tiers.empty() ? "; tiers: " : ", ") + word;
  return fmt::format("{}, {} with geometry, {} ({} degenerate){}{}", counted(robot.link_count() - 1, "link"),
                     links_with_geometry(robot), counted(robot.model().size(), "triangle"), robot.degenerate_count(),
                     tiers, incomplete(robot));
}

std::string tested_text(const Job& job) {
  return fmt::format("{} DOF, {}, {}; {} tested, {} disabled", job.robot->independent_joints().size(),
                     counted(job.robot->model().tree().dof_count(), "movable joint"),
                     counted(rigid_groups(*job.robot), "rigid group"),
                     counted(job.tested.size(), "pair of links", "pairs of links"), job.disabled.size());
}

}  // namespace

Json point_json(const hinge::Vec3& x) { return {x[0], x[1], x[2]}; }

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
              {"tiers", options.tiers},
              {"primitives", options.reference_primitives ? "reference" : "exact"},
              {"incomplete_links", robot.description().incomplete}};
}

Json joint_names(const Robot& robot) {
  Json names = Json::array();
  for (std::size_t k = 0; k < robot.independent_joints().size(); ++k) names.push_back(robot.independent_name(k));
  return names;
}

void add_surroundings(Json& json, const Job& job) {
  Json names = Json::array(), allowed = Json::array(), attached = Json::array();
  for (const auto& [link, body] : job.allowed) allowed.push_back({{"link", link}, {"body", body}});
  for (const Body& body : job.bodies) {
    names.push_back(body.name);
    if (body.holder) attached.push_back({{"link", *body.holder}, {"body", body.name}});
  }
  json["environment"] = std::move(names);
  json["allowed"] = std::move(allowed);
  json["attached"] = std::move(attached);
  json["notes"] = job.notes;
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
  const std::size_t left_out = for_each_printed(worker, answer, columns.max_pairs, false, [&](const Finding& f) {
    const std::string kind = f.kind;
    const Json row = pair_json(f, kind.starts_with("environment") ? "body" : "link2");
    if (kind.ends_with("closest")) {
      json[kind] = row;
    } else {
      json[kind.ends_with("pair") ? kind + "s" : kind].push_back(row);
    }
  });
  if (columns.max_pairs && lists) json["pairs_left_out"] = left_out;
  return json;
}

std::string csv_header() { return "index,collides,finding,first,second,distance,x1,y1,z1,x2,y2,z2\n"; }

std::string csv_rows(const Worker& worker, std::size_t index, const Answer& answer,
                     const std::optional<std::uint64_t>& max_pairs, std::uint64_t& left_out) {
  std::string rows;
  left_out += for_each_printed(worker, answer, max_pairs, false, [&](const Finding& f) {
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

std::string pair_heading(const Mode& mode) {
  const bool measures = mode.kind == Mode::Kind::within || mode.kind == Mode::Kind::closest;
  if (measures) return fmt::format("  {:<28} {:<28} distance (m)\n", "link", "link or body");
  return fmt::format("  {:<28} link or body\n", "link");
}

std::string pair_table(const Worker& worker, const Answer& answer, const std::optional<std::uint64_t>& max_pairs) {
  std::string lines;
  const std::size_t left_out = for_each_printed(worker, answer, max_pairs, true, [&](const Finding& f) {
    const std::string_view kind = f.kind;
    std::string line = fmt::format("  {:<28} {:<28}", f.first, f.second);
    if (f.distance != nullptr) line += fmt::format(" {:12.6g}", *f.distance);
    if (kind.ends_with("closest")) line += "  (closest)";
    if (kind.ends_with("contained")) line += "  (the first contains the second)";
    lines += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  });
  return lines + hinge::tool::left_out_text(left_out);
}

std::vector<std::pair<std::string, std::string>> named_pairs(const Json& row) {
  std::vector<std::pair<std::string, std::string>> pairs;
  std::set<std::pair<std::string, std::string>> known;
  const auto add = [&](const Json& finding) {
    // A held body follows the link that holds it.
    const auto at = finding.contains("held") ? finding.find("held") : finding.begin();
    const std::string first = at.value(), second = std::next(at).value();
    if (known.insert(std::minmax(first, second)).second) pairs.emplace_back(first, second);
  };
  for (const char* key :
       {"pairs", "closest", "environment_pairs", "environment_closest", "contained", "environment_contained"}) {
    const auto found = row.find(key);
    if (found == row.end() || found->is_null()) continue;
    if (found->is_object())
      add(*found);
    else
      for (const Json& finding : *found) add(finding);
  }
  return pairs;
}

std::vector<std::pair<std::string, std::string>> named_pairs(const Worker& worker, const Answer& answer) {
  std::vector<std::pair<std::string, std::string>> pairs;
  std::set<std::pair<std::string, std::string>> known;  // a containment is often a colliding pair too
  for_each_finding(worker, answer, [&](const Finding& f) {
    if (known.insert(std::minmax(f.first, f.second)).second) pairs.emplace_back(f.first, f.second);
  });
  return pairs;
}

std::vector<std::pair<std::string, std::string>> question_words(const Options& options, const Job& job) {
  const Robot& robot = *job.robot;
  std::vector<std::pair<std::string, std::string>> words{{"Robot", robot_text(options, robot)},
                                                         {"Tested", tested_text(job)}};
  words.emplace_back("Links collide if", options.clearance > 0.0
                                             ? fmt::format("they touch or are closer than {} m", options.clearance)
                                             : std::string("they touch"));
  if (options.contained) words.emplace_back("Closed meshes", "are solid");
  std::string bodies;
  for (const Body& body : job.bodies) bodies += (bodies.empty() ? "" : "; ") + body.name;
  if (!bodies.empty()) words.emplace_back("Bodies", bodies);
  for (const Body& body : job.bodies)
    if (body.holder) words.emplace_back("Held", body.name + " by " + *body.holder);
  for (const auto& [link, body] : job.allowed) words.emplace_back("May touch", link + " and " + body);
  return words;
}

std::string heading(const Options& options, const Job& job) {
  return fmt::format("{}: robot '{}', {}\n{}\n", options.urdf, job.robot->name(), robot_text(options, *job.robot),
                     tested_text(job));
}

}  // namespace robocd
