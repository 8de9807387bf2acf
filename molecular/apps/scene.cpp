// SPDX-License-Identifier: BSD-3-Clause
// Handles scenes of several molecules: options, placements and their output.
#include "scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

#include "hinge/core/error.hpp"
#include "hinge/molecular/join_structures.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge_tools/csv_field.hpp"
#include "hinge_tools/number_option.hpp"

namespace biocd {

using namespace hinge::molecular;

namespace {

/// Default range of --place: 10 angstrom, the neighbourhood of a binding site, and any rotation.
constexpr PlacementRange usual_range{10.0, std::numbers::pi};

}  // namespace

Structure read_files(const Options& options) {
  std::vector<Structure> structures{read_structure(options.file, options.read)};
  ReadOptions whole = options.read;
  whole.model.reset();
  whole.hetero = true;
  for (const std::string& file : options.with) structures.push_back(read_structure(file, whole));
  return join_structures(std::move(structures));
}

std::pair<std::string, PlacementRange> read_placement(const std::string& word) {
  const std::size_t equals = word.find('=');
  PlacementRange range = usual_range;
  if (equals != std::string::npos) {
    const char *at = word.data() + equals + 1, *const end = word.data() + word.size();
    double degrees = 180.0;
    auto read = std::from_chars(at, end, range.distance);
    bool sound = read.ec == std::errc{};
    if (sound && read.ptr != end && *read.ptr == ',') {
      read = std::from_chars(read.ptr + 1, end, degrees);
      sound = read.ec == std::errc{};
    }
    if (!sound || read.ptr != end || !(range.distance >= 0.0 && range.distance <= hinge::tool::largest_length) ||
        !(degrees >= 0.0 && degrees <= 180.0))
      throw hinge::ModelError(
          "--place '" + word +
          "': expected PART=DISTANCE,DEGREES, a distance from 0 to 1e+09 angstrom and an angle from 0 to 180");
    range.turn = std::min(degrees * degree, std::numbers::pi);
  }
  return {word.substr(0, equals), range};
}

PairScope read_scope(const Options& options, const Structure& structure) {
  std::vector<std::pair<Part, Part>> between;
  for (const auto& [first, second] : options.between) {
    if (first == "rest" && second == "rest")
      throw hinge::ModelError("--between rest rest: expected at least one part, as in --between A rest");
    const Part a = find_part(structure, first == "rest" ? second : first);
    const Part b = first == "rest" || second == "rest" ? rest_of(structure, a) : find_part(structure, second);
    between.emplace_back(a, b);
  }
  std::vector<Part> inside;
  for (const std::string& words : options.inside) inside.push_back(find_part(structure, words));
  return {structure, between, inside};
}

std::size_t position_of(const Job& job, hinge::DofId dof) {
  const auto dofs = job.checker.selection().dofs();
  return static_cast<std::size_t>(std::ranges::lower_bound(dofs, dof) - dofs.begin());
}

Placements placements_of(const Job& job, std::span<const double> q) {
  Placements placements;
  for (const PlacedPart& placed : job.molecule->placed_parts()) {
    auto& values = placements.emplace_back();
    for (std::size_t k = 0; k < 6; ++k) values[k] = q[position_of(job, placed.dofs[k])];
  }
  return placements;
}

Json placed_json(const Job& job) {
  Json list = Json::array();
  const Structure& s = job.molecule->structure();
  for (std::size_t k = 0; k < job.ranges.size(); ++k) {
    const PlacedPart& placed = job.molecule->placed_parts()[k];
    const std::vector<bool> in = atoms_in(s, placed.part);
    list.push_back({{"part", placed.part.name},
                    {"atoms", std::count(in.begin(), in.end(), true)},
                    {"centre", {placed.centre[0], placed.centre[1], placed.centre[2]}},
                    {"distance", job.ranges[k].distance},
                    {"degrees", job.ranges[k].turn / degree}});
  }
  return list;
}

std::string scene_lines(const Options& options, const Job& job) {
  std::string text;
  for (std::size_t k = 0; k < options.with.size(); ++k) text += fmt::format("file {}: {}\n", k + 2, options.with[k]);
  for (std::size_t k = 0; k < job.ranges.size(); ++k) {
    const PlacedPart& placed = job.molecule->placed_parts()[k];
    text += fmt::format("placed: {}, within {} angstrom and {} degrees, about ({:.3f}, {:.3f}, {:.3f})\n",
                        placed.part.name, job.ranges[k].distance, job.ranges[k].turn / degree, placed.centre[0],
                        placed.centre[1], placed.centre[2]);
  }
  if (!options.with.empty() && job.ranges.empty()) text += "placed: nothing\n";
  for (const auto& [a, b] : options.between) text += fmt::format("pairs: between {} and {}\n", a, b);
  for (const std::string& words : options.inside) text += fmt::format("pairs: inside {}\n", words);
  return text;
}

Json placements_json(const Job& job, const Placements& placements) {
  Json list = Json::array();
  for (std::size_t k = 0; k < placements.size(); ++k) {
    const auto& q = placements[k];
    list.push_back({{"part", job.molecule->placed_parts()[k].part.name},
                    {"move", {q[0], q[1], q[2]}},
                    {"turn", {q[3] / degree, q[4] / degree, q[5] / degree}}});
  }
  return list;
}

std::string placements_header(const Job& job) {
  std::string text;
  for (const PlacedPart& placed : job.molecule->placed_parts())
    for (const char* value : {".x", ".y", ".z", ".rx", ".ry", ".rz"}) {
      text += ',';
      text += hinge::tool::csv_field(placed.part.name + value);
    }
  return text;
}

std::string with_placements(const std::string& rows, const Placements& placements) {
  if (placements.empty()) return rows;
  std::string columns;
  for (const auto& q : placements)
    columns += fmt::format(",{},{},{},{},{},{}", q[0], q[1], q[2], q[3] / degree, q[4] / degree, q[5] / degree);
  return with_columns(rows, columns);
}

}  // namespace biocd
