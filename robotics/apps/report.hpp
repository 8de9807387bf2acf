// SPDX-License-Identifier: BSD-3-Clause
// The parts that the outputs of info and check share. The JSON keys are a contract: docs/reference/robocd.md.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "options.hpp"

namespace robocd {

/// Keys keep the order they were written in.
using Json = nlohmann::ordered_json;

Json robot_json(const Options& options, const Job& job);

/// What a configuration's row shows of the question asked.
struct Columns {
  hinge::robotics::Mode mode;
  bool environment = false;
  bool contained = false;
};

/// Names of the independent joints.
Json joint_names(const hinge::robotics::Robot& robot);
/// Names of the bodies around it, in the order given.
Json body_names(const Job& job);
/// Links and bodies that are not tested against each other.
Json allowed_json(const Job& job);

/// q: the configuration.
Json answer_json(const Worker& worker, std::size_t index, const std::vector<double>& q, const Answer& answer,
                 const Columns& columns);

/// A row per pair, closest pair and containment, or one without a pair.
std::string csv_header();
std::string csv_rows(const Worker& worker, std::size_t index, const Answer& answer);

/// Indented lines, a pair each.
std::string pair_lines(const Worker& worker, const Answer& answer);

/// The pairs that an answer names, as two names: links, or link and body.
std::vector<std::pair<std::string, std::string>> named_pairs(const Worker& worker, const Answer& answer);

/// Robot and pair rule, for people.
std::string heading(const Options& options, const Job& job);

}  // namespace robocd
