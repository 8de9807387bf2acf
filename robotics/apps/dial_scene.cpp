// SPDX-License-Identifier: BSD-3-Clause
// Finds what can be left out of a robot's scene without a change of any answer.
#include "dial_scene.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "configurations.hpp"
#include "hinge/core/id.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/robotics/collision_matrix.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/settings_file.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::counted;

namespace {

/// Returns the links from one to the world, the world left out.
std::vector<hinge::LinkId> chain_of(const hinge::KinematicTree& tree, hinge::LinkId link) {
  std::vector<hinge::LinkId> chain;
  for (; link != hinge::LinkId{0}; link = tree.parent(link)) chain.push_back(link);
  return chain;
}

/// Returns the names of the independent joints that move no tested pair of links against each other. With bodies in the
/// world every joint above a link moves it against them.
std::vector<std::string> idle_joints(const Options& options, const Job& job) {
  const Robot& robot = *job.robot;
  const hinge::KinematicTree& tree = robot.model().tree();
  std::set<hinge::DofId> used;
  const auto use = [&](const std::vector<hinge::LinkId>& links) {
    for (const hinge::LinkId link : links)
      if (tree.joint(link).has_dof()) used.insert(tree.dof_of(link));
  };
  for (const auto& [a, b] : job.tested.list()) {
    std::vector<hinge::LinkId> first = chain_of(tree, a), second = chain_of(tree, b);
    while (!first.empty() && !second.empty() && first.back() == second.back()) {
      first.pop_back();
      second.pop_back();
    }
    use(first);
    use(second);
  }
  if (!options.environment.empty())
    for (std::size_t l = 1; l < robot.link_count(); ++l)
      if (const auto link = hinge::id<hinge::LinkId>(l); robot.triangle_count(link) > 0) use(chain_of(tree, link));
  std::vector<bool> is_used(robot.independent_joints().size(), false);
  for (std::size_t d = 0; d < robot.drives().size(); ++d)
    if (used.contains(hinge::id<hinge::DofId>(d))) is_used[robot.drives()[d].independent] = true;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < is_used.size(); ++k)
    if (!is_used[k]) names.push_back(robot.independent_name(k));
  return names;
}

std::string joined(const std::vector<std::string>& words) {
  constexpr std::size_t most = 6;
  std::string text;
  for (std::size_t k = 0; k < words.size() && k < most; ++k) text += (k == 0 ? "" : ", ") + words[k];
  return words.size() > most ? fmt::format("{} and {} more", text, words.size() - most) : text;
}

}  // namespace

RobotScene study_scene(const Options& options, const Job& job) {
  const Robot& robot = *job.robot;
  check_limits(options, robot);
  RobotScene scene;
  scene.tested = job.tested;
  MatrixOptions how;
  // Little effort: it proves most of what more proves (docs/explanation/collision_matrix.md) in a part of the time.
  how.samples = 2000;
  how.cells = 2000;
  how.seed = options.seed;
  how.clearance = options.clearance;
  how.settled = job.disabled;
  scene.made_for = "--made-for " + model_digest(options, robot.description());
  std::string words = scene.made_for;
  std::vector<std::string> items;
  if (!robot.independent_joints().empty())
    for (const MatrixEntry& entry : find_collision_matrix(robot, how).entries) {
      if (entry.kind != PairKind::never || !job.tested.contains(entry.link1, entry.link2)) continue;
      const std::string &a = robot.link_name(entry.link1), &b = robot.link_name(entry.link2);
      scene.apart.emplace_back(a, b);
      scene.tested.erase(entry.link1, entry.link2);
      items.push_back(a + ", " + b);
      words += fmt::format(" --proved-apart {} {}", hinge::tool::shell_quoted(a), hinge::tool::shell_quoted(b));
    }
  const std::string of = fmt::format("{} of {}", items.size(), counted(job.tested.size(), "tested pair"));
  if (!items.empty())
    scene.requirements.push_back({of + " of links never meet: proved for all configurations within the joint limits "
                                       "(no verdict changes without them, but "
                                       "the smallest distance may)",
                                  words, items});

  const std::vector<std::string> idle = idle_joints(options, job);
  if (!idle.empty())
    scene.requirements.push_back({counted(idle.size(), "joint") + (idle.size() == 1 ? " moves" : " move") +
                                      " no tested pair of links against each other, so no answer depends on " +
                                      (idle.size() == 1 ? "it: " : "them: ") + joined(idle),
                                  "", idle});

  const hinge::KinematicTree& tree = robot.model().tree();
  const hinge::RigidGroups groups(tree, hinge::DofSelection::all(tree));
  std::vector<std::string> bare;
  std::set<hinge::GroupId> with_geometry;
  std::size_t shown = 0;
  for (std::size_t l = 1; l < robot.link_count(); ++l) {
    const auto link = hinge::id<hinge::LinkId>(l);
    if (robot.triangle_count(link) == 0) {
      bare.push_back(robot.link_name(link));
      continue;
    }
    ++shown;
    with_geometry.insert(groups.group_of(link));
  }
  if (with_geometry.size() < shown)
    scene.requirements.push_back({fmt::format("{} with geometry move as {}; pairs inside them are left out already",
                                              counted(shown, "link"), counted(with_geometry.size(), "rigid group")),
                                  "",
                                  {}});
  if (!bare.empty())
    scene.requirements.push_back({counted(bare.size(), "link") + (bare.size() == 1 ? " has" : " have") +
                                      " no geometry and cost nothing: " + joined(bare),
                                  "", bare});
  return scene;
}

}  // namespace robocd
