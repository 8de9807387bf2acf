// SPDX-License-Identifier: BSD-3-Clause
// Implements LinkMargins: checks clearances and radii, and tabulates them by triangle and pair of links.
#include "hinge/robotics/link_margins.hpp"

#include <string>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"

namespace hinge::robotics {

namespace {

/// Keeps sums of two reaches above thresholds despite rounding: three roundings on one side, two on the other.
constexpr double upward = 1.0 + 0x1p-50;

bool is_margin(double x) { return is_finite(x) && x >= 0.0; }

std::string pair_text(const Robot& robot, const PairClearance& pair) {
  const auto name = [&](LinkId link) {
    if (index(link) == 0 || index(link) >= robot.link_count())
      throw ModelError("clearance of links: the robot has no link " + std::to_string(index(link)) + ", expected 1 to " +
                       std::to_string(robot.link_count() - 1));
    return "'" + robot.link_name(link) + "'";
  };
  return "clearance of links " + name(pair.link1) + " and " + name(pair.link2);
}

}  // namespace

LinkMargins::LinkMargins(const Robot& robot, double clearance, std::span<const PairClearance> overrides) {
  Data data;
  data.model = robot.model();
  data.clearance = clearance;
  data.plain_reach = clearance / 2 * upward;
  data.link_count = robot.link_count();
  if (!is_margin(clearance))
    throw ModelError("clearance of all links is " + number_text(clearance) + ": expected a finite length >= 0");

  const std::span<const LinkId> links = robot.model().links();
  bool grown = false;
  for (std::size_t i = 0; i < robot.radii().size(); ++i) {
    const double radius = robot.radii()[i];
    if (!is_margin(radius))
      throw ModelError("link '" + robot.link_name(links[i]) + "': radius of triangle " + std::to_string(i) + " is " +
                       number_text(radius) + ", expected a finite length >= 0");
    grown = grown || radius > 0.0;
  }
  if (grown) data.radii.assign(robot.radii().begin(), robot.radii().end());

  std::vector<double> largest(data.link_count, clearance);  // by link
  if (!overrides.empty()) {
    data.table.assign(data.link_count * data.link_count, clearance);
    std::vector<bool> named(data.table.size(), false);
    for (const PairClearance& pair : overrides) {
      const std::string who = pair_text(robot, pair);
      if (!is_margin(pair.clearance))
        throw ModelError(who + " is " + number_text(pair.clearance) + ": expected a finite length >= 0");
      if (pair.link1 == pair.link2) throw ModelError(who + ": expected two different links");
      const std::size_t a = index(pair.link1), b = index(pair.link2);
      if (named[a * data.link_count + b]) throw ModelError(who + " is given twice");
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        named[from * data.link_count + to] = true;
        data.table[from * data.link_count + to] = pair.clearance;
        largest[from] = std::max(largest[from], pair.clearance);
      }
    }
  }
  data.plain = data.radii.empty() && data.table.empty();
  if (!data.plain) {
    data.reach.reserve(links.size());
    for (std::size_t i = 0; i < links.size(); ++i)
      data.reach.push_back(((data.radii.empty() ? 0.0 : data.radii[i]) + largest[index(links[i])] / 2) * upward);
  }
  data_ = std::make_shared<const Data>(std::move(data));
}

}  // namespace hinge::robotics
