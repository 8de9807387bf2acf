// SPDX-License-Identifier: BSD-3-Clause
// Writes plots as plain SVG, without a library.
#include "plot_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace biocd {

namespace {

constexpr double width = 520, height = 380, left = 78, right = 110, top = 44, bottom = 56;
constexpr std::array<const char*, 6> colours{"#1b6ca8", "#c8553d", "#3a7d44", "#7d5ba6", "#b8860b", "#444444"};

std::string text(double x, double y, const std::string& words, const std::string& more) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, more, words);
}

std::string one_plot(const Plot& plot, double shift) {
  double low = 1e300, high = 0.0;
  for (const Curve& curve : plot.curves)
    for (const double value : curve.values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  const double from = std::floor(std::log10(low)), to = std::max(std::ceil(std::log10(high)), from + 1);
  const double inner_width = width - left - right, inner_height = height - top - bottom;
  const auto x = [&](std::size_t k) {
    const double steps = std::max<double>(1.0, static_cast<double>(plot.labels.size()) - 1);
    return shift + left + inner_width * static_cast<double>(k) / steps;
  };
  const auto y = [&](double value) { return top + inner_height * (to - std::log10(value)) / (to - from); };

  std::string svg = text(shift + left, 24, plot.title, "font-weight=\"bold\"");
  for (double decade = from; decade <= to; ++decade) {
    const double at = y(std::pow(10.0, decade));
    svg += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>\n",
                       shift + left, at, shift + left + inner_width, at);
    svg += text(shift + left - 8, at + 4, fmt::format("10<tspan dy=\"-5\" font-size=\"9\">{:.0f}</tspan>", decade),
                "text-anchor=\"end\"");
  }
  for (std::size_t k = 0; k < plot.labels.size(); ++k)
    svg += text(x(k), height - bottom + 20, plot.labels[k], "text-anchor=\"middle\"");
  svg += text(shift + left + inner_width / 2, height - 14, plot.horizontal, "text-anchor=\"middle\"");
  const double middle = top + inner_height / 2;
  svg += text(shift + 20, middle, plot.vertical,
              fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 {:.1f} {:.1f})\"", shift + 20, middle));

  // Labels next to the ends of the curves, at least 15 pixels apart.
  std::vector<std::pair<double, std::size_t>> ends;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) ends.emplace_back(y(plot.curves[c].values.back()), c);
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 1; k < ends.size(); ++k) ends[k].first = std::max(ends[k].first, ends[k - 1].first + 15);
  for (const auto& [at, c] : ends) {
    const char* colour = colours[c % colours.size()];
    std::string points;
    for (std::size_t k = 0; k < plot.curves[c].values.size(); ++k) {
      const double px = x(k), py = y(plot.curves[c].values[k]);
      points += fmt::format("{:.1f},{:.1f} ", px, py);
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", px, py, colour);
    }
    svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", points, colour);
    svg += text(shift + width - right + 10, at + 4, plot.curves[c].name, fmt::format("fill=\"{}\"", colour));
  }
  return svg;
}

}  // namespace

std::string to_svg(const std::vector<Plot>& plots) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width * static_cast<double>(plots.size()), height);
  for (std::size_t k = 0; k < plots.size(); ++k) svg += one_plot(plots[k], width * static_cast<double>(k));
  return svg + "</svg>\n";
}

}  // namespace biocd
