// SPDX-License-Identifier: BSD-3-Clause
// Common parts of the outputs of the commands. The JSON keys are a contract: docs/reference/robocd.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "options.hpp"

namespace robocd {

/// Keys keep the order in which they are written.
using Json = nlohmann::ordered_json;

/// Returns the coordinates of a point as an array.
Json point_json(const hinge::Vec3& x);

/// Returns the JSON object that describes the robot.
Json robot_json(const Options& options, const Job& job);

/// The fields that the question gives to a configuration's row.
struct Columns {
  hinge::robotics::Mode mode;
  bool environment = false;
  bool contained = false;
  std::optional<std::uint64_t> max_pairs{};  // if given, the row says how many pairs it leaves out
};

/// Returns the names of the independent joints.
Json joint_names(const hinge::robotics::Robot& robot);
/// Adds what is around the robot and the notes: `environment`, `allowed`, `attached`, `notes`.
void add_surroundings(Json& json, const Job& job);

/// Returns the JSON row of one configuration. q: its values, rad or m.
Json answer_json(const Worker& worker, std::size_t index, const std::vector<double>& q, const Answer& answer,
                 const Columns& columns);

/// CSV: one row per pair, closest pair and containment, or one row without a pair.
std::string csv_header();
/// max_pairs: further pairs have no row. left_out: their number is added.
std::string csv_rows(const Worker& worker, std::size_t index, const Answer& answer,
                     const std::optional<std::uint64_t>& max_pairs, std::uint64_t& left_out);

/// Returns the names and units of the columns of pair_table(), with a line end. The modes within and closest have
/// distances.
std::string pair_heading(const hinge::robotics::Mode& mode);
/// Returns one line per pair, at most those of --max-pairs, and a line about the others.
std::string pair_table(const Worker& worker, const Answer& answer, const std::optional<std::uint64_t>& max_pairs);

/// Returns the pairs of an answer by name: two links, or link and body, each pair once.
std::vector<std::pair<std::string, std::string>> named_pairs(const Worker& worker, const Answer& answer);
/// Returns the same from a row of answer_json().
std::vector<std::pair<std::string, std::string>> named_pairs(const Json& row);

/// Returns the question in words, as names and values: the robot, what is tested, the bodies.
std::vector<std::pair<std::string, std::string>> question_words(const Options& options, const Job& job);

/// Returns lines of text about the robot and its tested pairs.
std::string heading(const Options& options, const Job& job);

}  // namespace robocd
