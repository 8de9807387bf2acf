// SPDX-License-Identifier: BSD-3-Clause
// Implements read_points line by line.
#include "hinge/robotics/read_points.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "description/parse_numbers.hpp"
#include "description/read_file.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"

namespace hinge::robotics {

std::vector<Vec3> read_points(const std::filesystem::path& path) {
  std::string text = read_file(path);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::vector<Vec3> points;
  std::size_t number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    std::string_view line = next_line(rest);
    ++number;
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const auto numbers = parse_numbers(line);
    const bool is_point = numbers && numbers->size() >= 3;
    const Vec3 point = is_point ? Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]) : Vec3::Zero();
    if (!is_point || !is_length(point))
      throw LoadError(path.string() + ":" + std::to_string(number) + ": '" + std::string(line.substr(0, 60)) +
                      "', expected x y z, finite numbers of at most 2^1000");
    points.push_back(point);
  }
  if (points.empty()) throw LoadError(path.string() + ": has no points, expected x y z in each line");
  return points;
}

}  // namespace hinge::robotics
