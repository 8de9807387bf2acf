// SPDX-License-Identifier: BSD-3-Clause
// Writes the data of the page: docs/reference/report.md.
#include "robot_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "hinge/core/id.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "hinge_tools/counted.hpp"
#include "page_mesh.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::counted;
using hinge::tool::packed;

namespace {

constexpr std::size_t most_triangles = 100000;  // of the page; more are slow to draw and to load
constexpr std::size_t fewest_triangles = 200;   // of a link, when links are made coarser
constexpr std::size_t most_rows = 1000;         // pairs of one configuration

using Triangles = std::vector<hinge::Triangle>;

/// Returns the triangles of each link of the model except the world, in the link's frame.
std::vector<Triangles> triangles_of_links(const Robot& robot) {
  std::vector<Triangles> all(robot.link_count() - 1);
  for (const LinkDescription& link : robot.description().links) {
    const std::size_t place = hinge::index(*robot.find_link(link.name)) - 1;
    for (const PlacedShape& part : link.geometry)
      for (const hinge::Triangle& t : drawn_triangles(part.shape, part.origin)) all[place].push_back(t);
  }
  return all;
}

std::vector<float> numbers_of(const hinge::Pose& pose) {
  std::vector<float> numbers;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) numbers.push_back(static_cast<float>(pose.rotation(row, column)));
    numbers.push_back(static_cast<float>(pose.translation[row]));
  }
  return numbers;
}

/// first, second: places among the links and bodies of the page.
template <class Closest>
Json row_json(std::size_t first, std::size_t second, const Closest& found, double clearance) {
  return {first,
          second,
          found.distance,
          clearance,
          found.collides() ? 1 : 0,
          point_json(found.point1),
          point_json(found.point2)};
}

Json mesh_json(const Triangles& triangles, std::size_t all) {
  const std::size_t most =
      all <= most_triangles
          ? triangles.size()
          : std::max(fewest_triangles, triangles.size() * most_triangles / std::max<std::size_t>(1, all));
  const PageMesh mesh = page_mesh(triangles, most);
  return {{"vertices", packed(mesh.vertices)}, {"triangles", packed(mesh.triangles)}};
}

}  // namespace

hinge::tool::ReportWords page_words(const Options& options, const Job& job) {
  hinge::tool::ReportWords words;
  words.title = job.robot->name().empty() ? options.urdf : job.robot->name();
  words.command = options.command_line;
  words.tool = words.command.substr(0, words.command.find(' ', words.command.find(' ') + 1));
  words.question = question_words(options, job);
  words.files = input_files(options);
  words.notes = job.notes;
  return words;
}

RobotPage::RobotPage(const Options& options, const Job& job, Worker& worker, const Mode& mode, bool is_path)
    : options_(options),
      job_(job),
      worker_(worker),
      file_(options.report),
      margin_(mode.kind == Mode::Kind::within ? mode.margin : 0.0),
      choice_(mode.kind == Mode::Kind::all || mode.kind == Mode::Kind::within,
              is_path ? hinge::tool::ReportChoice::all : hinge::tool::ReportChoice::usual),
      is_path_(is_path) {
  std::size_t held = 0, others = 0;
  for (const Body& body : job.bodies) others += body.holder ? 1U : 0U;
  for (const Body& body : job.bodies) order_.push_back(body.holder ? held++ : others++);
}

std::size_t RobotPage::place_of(BodyId body) const {
  const std::vector<BodyId> bodies = worker_.environment->bodies();  // in the order of job.bodies
  return job_.robot->link_count() - 1 +
         order_[static_cast<std::size_t>(std::ranges::find(bodies, body) - bodies.begin())];
}

void RobotPage::offer(std::uint64_t index, const Answer& answer) {
  if (!wanted()) return;
  std::size_t pairs = answer.self.pairs.size() + answer.body_pairs.size();
  if (margin_ > 0.0) {  // pairs that are only near are listed, too
    const auto collides = [](const auto& found) { return found.collides(); };
    pairs = static_cast<std::size_t>(std::ranges::count_if(answer.self.distances, collides) +
                                     std::ranges::count_if(answer.body_distances, collides));
  }
  choice_.offer(index, answer.collides, pairs);
}

std::vector<std::uint64_t> RobotPage::chosen() const {
  std::vector<std::uint64_t> list;
  for (const auto& shown : choice_.shown()) list.push_back(shown.index);
  return list;
}

void RobotPage::add(const std::string& name, const std::vector<double>& q) {
  if (wanted()) frames_.push_back(frame_json(name, q));
}

void RobotPage::add_next(const std::string& name, const std::vector<double>& q) {
  if (!wanted()) return;
  Json frame = frame_json(name, q);
  const auto pairs = std::ranges::count_if(frame["pairs"], [](const Json& row) { return row[4] == 1; });
  choice_.offer(frames_.size(), frame["collides"], static_cast<std::size_t>(pairs));
  frames_.push_back(std::move(frame));
}

Json RobotPage::frame_json(const std::string& name, const std::vector<double>& q) {
  RobotChecker& checker = worker_.checker;
  checker.update(q);
  const std::size_t links = job_.robot->link_count() - 1;
  std::vector<float> poses;
  for (std::size_t k = 1; k <= links; ++k)
    for (const float number : numbers_of(checker.link_pose(hinge::id<hinge::LinkId>(k)))) poses.push_back(number);
  for (const Body& body : job_.bodies)
    if (body.holder)
      for (const float number : numbers_of(checker.link_pose(*job_.robot->find_link(*body.holder)) * body.pose))
        poses.push_back(number);
  std::vector<std::pair<double, Json>> rows;  // by gap
  bool collides = checker.collides();
  for (const ClosestLinks& found : checker.distances(margin_))
    rows.emplace_back(
        found.gap, row_json(hinge::index(found.link1) - 1, hinge::index(found.link2) - 1, found, options_.clearance));
  if (worker_.environment) {
    collides = collides || checker.collides(*worker_.environment);
    for (const ClosestBody& found : checker.distances(*worker_.environment, margin_)) {
      const std::size_t first = found.held ? place_of(*found.held) : hinge::index(found.link) - 1;
      rows.emplace_back(found.gap, row_json(first, place_of(found.body), found, options_.clearance));
    }
  }
  std::ranges::stable_sort(rows, {}, [](const auto& row) { return row.first; });
  Json pairs = Json::array();
  for (std::size_t k = 0; k < std::min(rows.size(), most_rows); ++k) pairs.push_back(std::move(rows[k].second));
  const std::size_t left_out = rows.size() - pairs.size();
  return {{"index", 0},
          {"name", name},
          {"collides", collides},
          {"poses", packed(poses)},
          {"values", q},
          {"pairs", std::move(pairs)},
          {"pairs_left_out", left_out}};
}

void RobotPage::set_matrix(const CollisionMatrix& matrix, const std::vector<std::string>& words) {
  if (!wanted()) return;
  const std::size_t links = job_.robot->link_count() - 1;
  std::vector<std::uint8_t> cells(links * links, 0);
  for (const MatrixEntry& entry : matrix.entries) {
    const std::size_t a = hinge::index(entry.link1) - 1, b = hinge::index(entry.link2) - 1;
    cells[a * links + b] = cells[b * links + a] = static_cast<std::uint8_t>(static_cast<std::size_t>(entry.kind) + 1);
  }
  Json all = Json::array({"not tested"});
  for (const std::string& word : words) all.push_back(word);
  matrix_ = {{"words", std::move(all)}, {"cells", packed(cells)}};
}

void RobotPage::write(const char* state, const std::string& verdict) {
  if (!wanted()) return;
  const Robot& robot = *job_.robot;
  hinge::tool::ReportWords words = page_words(options_, job_);
  words.state = state;
  words.verdict = verdict + incomplete(robot);
  words.is_path = is_path_;
  words.numbers_from = is_path_ ? 1 : 0;
  words.frame_word = {"configuration", "configurations"};
  auto data = hinge::tool::report_head<Json>(words, "robot");
  choice_.describe(data, words.numbers_from);
  const auto shown = choice_.shown();
  for (std::size_t k = 0; k < frames_.size(); ++k) frames_[k]["index"] = k < shown.size() ? shown[k].place : k;

  std::vector<Triangles> links = triangles_of_links(robot), bodies;
  std::vector<std::string> notes;  // of meshes, printed when they were read first
  for (const Body& body : job_.bodies) bodies.push_back(drawn_triangles(shape_of(body, notes)));
  std::size_t all = 0;
  for (const auto* list : {&links, &bodies})
    for (const Triangles& triangles : *list) all += triangles.size();
  const hinge::KinematicTree& tree = robot.model().tree();
  const hinge::RigidGroups groups(tree, hinge::DofSelection::all(tree));
  const auto moves = [&](std::size_t link) {
    return groups.group_of(hinge::id<hinge::LinkId>(link)) != hinge::GroupId{};
  };
  Json out{{"links", Json::array()}, {"bodies", Json::array()}, {"joints", Json::array()}};
  for (std::size_t k = 0; k < links.size(); ++k) {
    Json link = mesh_json(links[k], all);
    link["name"] = robot.link_name(hinge::id<hinge::LinkId>(k + 1));
    link["moves"] = moves(k + 1) ? 1 : 0;
    out["links"].push_back(std::move(link));
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Body& of = job_.bodies[k];
    Json body = mesh_json(bodies[k], all);
    body["name"] = of.name;
    if (of.holder)
      body["moves"] = moves(hinge::index(*robot.find_link(*of.holder))) ? 1 : 0;
    else
      body["pose"] = numbers_of(of.pose);
    out[of.holder ? "links" : "bodies"].push_back(std::move(body));
  }
  for (const std::size_t joint : robot.independent_joints()) {
    const JointDescription& of = robot.description().joints[joint];
    out["joints"].push_back({{"name", of.name}, {"unit", of.type == JointType::prismatic ? "m" : "rad"}});
  }
  const bool has_matrix = !matrix_.is_null();
  out["matrix"] = std::move(matrix_);
  out["cut"] =
      all <= most_triangles
          ? Json()
          : Json(fmt::format("Meshes of {} are drawn coarser than they are; verdicts and distances are those of "
                             "the full meshes",
                             counted(all, "triangle")));
  data["frames"] = std::move(frames_);
  const std::size_t count = data["frames"].size();
  data["robot"] = std::move(out);
  hinge::tool::write_report_page(file_, hinge::tool::robot_page(), data);
  const bool below_table = options_.output == Output::table && !has_matrix;  // the matrix goes to standard output
  fmt::print(below_table ? stdout : stderr, "{}report: {} shows {}\n", below_table ? "" : "note: ", options_.report,
             counted(count, "configuration"));
}

void add_motion(RobotPage& page, const std::vector<std::vector<double>>& waypoints,
                const std::optional<MotionStop>& stop) {
  if (!page.wanted()) return;
  constexpr std::size_t most = 200;
  const std::size_t segments = waypoints.size() - 1;
  const std::size_t steps = std::max<std::size_t>(1, segments == 0 ? 1 : most / segments);
  const auto name = [&](std::size_t segment, double t) {
    return segments == 1 ? fmt::format("t = {:.4g}", t) : fmt::format("segment {}, t = {:.4g}", segment, t);
  };
  page.add_next("start", waypoints.front());
  for (std::size_t w = 0; w < segments; ++w) {
    const std::vector<double>&from = waypoints[w], &to = waypoints[w + 1];
    double before = 0.0;
    for (std::size_t s = 1; s <= steps; ++s) {
      const double t = static_cast<double>(s) / static_cast<double>(steps);
      if (stop && stop->segment == w && before < stop->parameter && stop->parameter < t)
        page.add_next(name(w, stop->parameter), stop->configuration);
      std::vector<double> q(from.size());
      for (std::size_t j = 0; j < q.size(); ++j) q[j] = s == steps ? to[j] : from[j] + t * (to[j] - from[j]);
      page.add_next(name(w, t), q);
      before = t;
    }
  }
}

}  // namespace robocd
