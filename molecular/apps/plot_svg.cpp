// SPDX-License-Identifier: BSD-3-Clause
// Draws the axes, the curves and their names.
#include "plot_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hinge_tools/svg.hpp"

namespace biocd {

using hinge::tool::Svg;

namespace {

constexpr double width = 520, height = 380;
constexpr struct { double left = 86, right = 110, top = 44, bottom = 56; } margin;
constexpr std::array<const char*, 6> colours{"#1b6ca8", "#c8553d", "#3a7d44", "#7d5ba6", "#b8860b", "#444444"};

void draw(Svg& svg, const Plot& plot, double shift) {
  double low = 1e300, high = 0.0;
  for (const Curve& curve : plot.curves)
    for (const double value : curve.values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  const double from = std::floor(std::log10(low)), to = std::max(std::ceil(std::log10(high)), from + 1);
  const double inner_width = width - margin.left - margin.right, inner_height = height - margin.top - margin.bottom;
  const auto x = [&](std::size_t k) {
    const double steps = std::max<double>(1.0, static_cast<double>(plot.labels.size()) - 1);
    return shift + margin.left + inner_width * static_cast<double>(k) / steps;
  };
  const auto y = [&](double value) { return margin.top + inner_height * (to - std::log10(value)) / (to - from); };

  svg.text({shift + margin.left, 24}, plot.title, "start", "font-weight=\"bold\"");
  for (double decade = from; decade <= to; ++decade) {
    const double at = y(std::pow(10.0, decade));
    svg.line({shift + margin.left, at}, {shift + margin.left + inner_width, at}, "#ddd");
    svg.text({shift + margin.left - 8, at + 4}, fmt::format("{:.0f}", std::pow(10.0, decade)), "end");
  }
  for (std::size_t k = 0; k < plot.labels.size(); ++k)
    svg.text({x(k), height - margin.bottom + 20}, plot.labels[k], "middle");
  svg.text({shift + margin.left + inner_width / 2, height - 14}, plot.horizontal, "middle");
  const double middle = margin.top + inner_height / 2;
  svg.text({shift + 14, middle}, plot.vertical, "middle",
           fmt::format("transform=\"rotate(-90 {:.1f} {:.1f})\"", shift + 14, middle));

  // Labels next to the ends of the curves, at least 15 pixels apart.
  std::vector<std::pair<double, std::size_t>> ends;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) ends.emplace_back(y(plot.curves[c].values.back()), c);
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 1; k < ends.size(); ++k) ends[k].first = std::max(ends[k].first, ends[k - 1].first + 15);
  for (const auto& [at, c] : ends) {
    const char* colour = colours[c % colours.size()];
    std::vector<Svg::Point> points;
    for (std::size_t k = 0; k < plot.curves[c].values.size(); ++k) {
      points.push_back({x(k), y(plot.curves[c].values[k])});
      svg.circle(points.back(), 3, colour);
    }
    svg.polyline(points, colour, 2);
    svg.text({shift + width - margin.right + 10, at + 4}, plot.curves[c].name, "start",
             fmt::format("fill=\"{}\"", colour));
  }
}

}  // namespace

std::string to_svg(const std::vector<Plot>& plots) {
  Svg svg(width * static_cast<double>(plots.size()), height);
  for (std::size_t k = 0; k < plots.size(); ++k) draw(svg, plots[k], width * static_cast<double>(k));
  return svg.document();
}

}  // namespace biocd
