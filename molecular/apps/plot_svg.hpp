// SPDX-License-Identifier: BSD-3-Clause
// Draws line plots with a logarithmic vertical axis as SVG.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace biocd {

/// A named curve of a plot.
struct Curve {
  std::string name;
  std::vector<double> values;  ///< one per label, > 0
};

/// A plot with its title, axis titles and curves. Needs at least one label.
struct Plot {
  std::string title;
  std::string horizontal;
  std::string vertical;
  std::vector<std::string> labels;  ///< labels of the horizontal axis, evenly spaced
  std::vector<Curve> curves;
};

/// Returns an SVG document with the plots side by side.
std::string to_svg(const std::vector<Plot>& plots);

}  // namespace biocd
