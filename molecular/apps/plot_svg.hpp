// SPDX-License-Identifier: BSD-3-Clause
// A line plot with a logarithmic vertical axis, as SVG.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace biocd {

struct Curve {
  std::string name;
  std::vector<double> values;  ///< one per label, > 0
};

struct Plot {
  std::string title;
  std::string horizontal;
  std::string vertical;
  std::vector<std::string> labels;  ///< along the horizontal axis, evenly spaced
  std::vector<Curve> curves;
};

/// The plots side by side.
std::string to_svg(const std::vector<Plot>& plots);

}  // namespace biocd
