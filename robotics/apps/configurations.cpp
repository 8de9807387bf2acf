// SPDX-License-Identifier: BSD-3-Clause
// Makes configurations: random, from a CSV file, named by the SRDF, or all zero.
#include "configurations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <ostream>
#include <string>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/robotics/random_configuration.hpp"
#include "hinge_tools/csv_field.hpp"
#include "read_configurations.hpp"

namespace robocd {

using namespace hinge::robotics;

namespace {

/// Returns configuration k, uniform within the limits.
std::vector<double> sample(const Robot& robot, std::uint64_t seed, std::uint64_t k) {
  std::vector<double> q(robot.lower().size());
  random_configuration(robot, seed, k, q);
  return q;
}

}  // namespace

void check_limits(const Options& options, const Robot& robot) {
  for (const auto limits : {robot.lower(), robot.upper()})
    if (const auto far = find_too_far(robot, limits))
      throw hinge::LoadError(options.urdf + ": a joint limit is too large for sampling: " + far->what);
}

std::vector<double> join_states(const char* option, const std::vector<std::string>& states, const Options& options,
                                const Job& job) {
  std::vector<double> q(job.robot->independent_joints().size(), 0.0);
  for (const std::string& wanted : states) {
    std::string known;
    bool found = false;
    for (const NamedConfiguration& state : job.srdf.configurations) {
      const std::string name = state.full_name();
      known += (known.empty() ? "" : ", ") + name;
      if (name != wanted) continue;
      state.apply(q);
      found = true;
    }
    if (!found)
      throw hinge::ModelError(std::string(option) + " '" + wanted + "': " +
                              (options.srdf.empty() ? "expected --srdf, which defines the states"
                               : known.empty()      ? options.srdf + " defines no states"
                                                    : "expected one of " + known));
    if (const auto far = find_too_far(*job.robot, q))
      throw hinge::ModelError(std::string(option) + " '" + wanted + "': " + far->what);
  }
  return q;
}

Configurations find_configurations(const Options& options, const Job& job) {
  if (options.count > 0) {
    check_limits(options, *job.robot);
    return {options.count, [robot = job.robot, seed = options.seed](std::size_t k) { return sample(*robot, seed, k); }};
  }
  if (!options.csv_in.empty()) {
    std::vector<std::string> notes;
    auto rows = std::make_shared<const std::vector<std::vector<double>>>(
        read_configurations(options.csv_in, *job.robot, notes));
    return {rows->size(), [rows](std::size_t k) { return (*rows)[k]; }, std::move(notes)};
  }
  return {1, [q = join_states("--state", options.states, options, job)](std::size_t) { return q; }};
}

std::vector<std::string> notes_on_limits(const Configurations& configurations, const Options& options,
                                         const Robot& robot) {
  std::size_t outside = 0;
  std::string first;
  for (std::size_t k = 0; k < configurations.count; ++k) {
    const std::vector<double> q = configurations.at(k);
    bool inside = true;
    for (std::size_t j = 0; j < q.size(); ++j) {
      const bool continuous = robot.description().joints[robot.independent_joints()[j]].type == JointType::continuous;
      if (continuous || (q[j] >= robot.lower()[j] && q[j] <= robot.upper()[j])) continue;
      inside = false;
      if (first.empty())
        first = fmt::format("configuration {} has {} for joint '{}', limits {} and {}", k, q[j],
                            robot.independent_name(j), robot.lower()[j], robot.upper()[j]);
    }
    outside += inside ? 0 : 1;
  }
  if (outside == 0) return {};
  if (!options.proved_apart.empty())
    throw hinge::LoadError("--proved-apart leaves out pairs that are apart within the joint limits only: " + first);
  return {fmt::format("{} of {} configurations are outside the joint limits: {}", outside, configurations.count,
                      outside > 1 ? "first, " + first : first)};
}

void write_header(std::ostream& out, const hinge::robotics::Robot& robot) {
  for (std::size_t j = 0; j < robot.independent_joints().size(); ++j)
    out << (j == 0 ? "" : ",") << hinge::tool::csv_field(robot.independent_name(j));
  out << '\n';
}

void write_row(std::ostream& out, const std::vector<double>& q) {
  for (std::size_t j = 0; j < q.size(); ++j) out << (j == 0 ? "" : ",") << fmt::format("{}", q[j]);
  out << '\n';
}

}  // namespace robocd
