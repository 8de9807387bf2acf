// SPDX-License-Identifier: BSD-3-Clause
// SVG plots of the benchmarks: bars and dots on a logarithmic scale, with one line per decade.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "hinge_tools/svg.hpp"

namespace hinge::bench {

/// Text of x with `digits` significant digits; large numbers without decimals.
inline std::string number(double x, int digits = 3) {
  char text[32];
  const int whole = x == 0.0 ? 1 : static_cast<int>(std::floor(std::log10(std::abs(x)))) + 1;
  std::snprintf(text, sizeof text, "%.*f", std::clamp(digits - whole, 0, 6), x);
  return text;
}

class Plot {
 public:
  static constexpr double width = 760, left = 60, bottom = 270, top = 30;  // px

  Plot(const std::string& title, double low, double high) : low_(std::log10(low)), high_(std::log10(high)) {
    label(left, 18, title, "start");
    for (double decade = std::ceil(low_); decade <= high_ + 1e-9; ++decade) {
      const double value = std::pow(10, decade), y = height_of(value);
      svg_.line({left, y}, {740, y}, "#ddd");
      label(left - 8, y + 4, number(value), "end");
    }
  }
  void bar(double x, double w, double value, const std::string& colour) {
    const double y = height_of(value);
    svg_.rectangle(x, y, w, std::max(bottom - y, 0.5), colour);
    label(x + w / 2, y - 4, number(value, 2));
  }
  void dot(double x, double value, const std::string& colour) { svg_.circle({x, height_of(value)}, 4, colour); }
  void label(double x, double y, const std::string& text, const char* anchor = "middle") {
    svg_.text({x, y}, text, anchor);
  }
  void write(const std::string& file) const { std::ofstream(file) << svg_.document(); }

 private:
  double height_of(double value) const {
    return bottom - (bottom - top) * (std::clamp(std::log10(value), low_, high_) - low_) / (high_ - low_);
  }

  double low_, high_;
  tool::Svg svg_{width, 320};
};

}  // namespace hinge::bench
