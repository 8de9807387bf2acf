// SPDX-License-Identifier: BSD-3-Clause
// What a robot's scene requires: pairs of links that never meet, joints that change no answer, links that never part.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hinge/robotics/link_pairs.hpp"
#include "hinge_tools/dial_report.hpp"
#include "options.hpp"

namespace robocd {

struct RobotScene {
  std::vector<hinge::tool::DialRequirement> requirements;
  std::vector<std::pair<std::string, std::string>> apart;  // tested pairs that are proved apart within the joint limits
  std::string made_for;                                    // the option --made-for of these proofs
  hinge::robotics::LinkPairs tested;                       // the tested pairs without these
};

/// Studies the model itself; no result depends on samples. Throws LoadError if limits are too large to sample.
RobotScene study_scene(const Options& options, const Job& job);

}  // namespace robocd
