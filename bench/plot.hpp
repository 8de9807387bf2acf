// SPDX-License-Identifier: BSD-3-Clause
// SVG plots of the benchmarks: bars and dots on a logarithmic scale, with one line per decade.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

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
      add("<line x1=\"%.1f\" x2=\"740\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>\n", left, y, y);
      label(left - 8, y + 4, number(value), "end");
    }
  }
  void bar(double x, double w, double value, const std::string& colour) {
    const double y = height_of(value);
    add("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", x, y, w,
        std::max(bottom - y, 0.5), colour.c_str());
    label(x + w / 2, y - 4, number(value, 2));
  }
  void dot(double x, double value, const std::string& colour) {
    add("<circle r=\"4\" cx=\"%.1f\" cy=\"%.1f\" fill=\"%s\"/>\n", x, height_of(value), colour.c_str());
  }
  void label(double x, double y, const std::string& text, const char* anchor = "middle") {
    add("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n", x, y, anchor, text.c_str());
  }
  void write(const std::string& file) const {
    std::ofstream(file) << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 320\" "
                           "font-family=\"sans-serif\" font-size=\"12\">\n"
                           "<rect width=\"760\" height=\"320\" fill=\"white\"/>\n"
                        << svg_ << "</svg>\n";
  }

 private:
  double height_of(double value) const {
    return bottom - (bottom - top) * (std::clamp(std::log10(value), low_, high_) - low_) / (high_ - low_);
  }
  template <class... Values>
  void add(const char* format, Values... values) {
    char text[512];
    std::snprintf(text, sizeof text, format, values...);
    svg_ += text;
  }

  double low_, high_;
  std::string svg_;
};

}  // namespace hinge::bench
