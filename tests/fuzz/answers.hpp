// SPDX-License-Identifier: BSD-3-Clause
// Answers: compares the answers of several engines to one query; the first engine is the reference.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/require.hpp"
#include "hinge/core/id.hpp"
#include "hinge/policy/collector.hpp"

namespace fuzz {

inline std::string text(double x) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.17g (%a)", x, x);
  return buffer.data();
}

inline std::string text(const hinge::Hit& hit) {
  return "(" + std::to_string(hinge::index(hit.first)) + ", " + std::to_string(hinge::index(hit.second)) +
         ") distance " + text(hit.distance) + " threshold " + text(hit.threshold);
}

/// Engines may test (p, q) or (q, p), so distances agree up to rounding relative to the coordinates. An overflow may
/// happen in one order only.
inline bool agree(double a, double b, double size) {
  return a == b || !(size < 0x1p480) || std::abs(a - b) <= 128 * 0x1p-53 * size;
}

/// Compares one kind of query, within a model or between two models.
class Answers {
 public:
  Answers(double size, const char* what) : size_(size), what_(what) {}

  void lists(const std::vector<hinge::Hit>& hits, const char* engine) {
    if (!list_) {
      list_ = hits;
      return;
    }
    for (std::size_t k = 0; k < std::min(hits.size(), list_->size()); ++k) {
      const hinge::Hit &a = (*list_)[k], &b = hits[k];
      if (a.first != b.first || a.second != b.second || a.threshold != b.threshold ||
          !agree(a.distance, b.distance, size_))
        find(std::string(what_) + ": brute " + text(a) + ", " + engine + " " + text(b));
    }
    if (hits.size() > list_->size())
      find(std::string(what_) + ": only " + engine + " has " + text(hits[list_->size()]));
    if (hits.size() < list_->size())
      find(std::string(what_) + ": " + engine + " misses " + text((*list_)[hits.size()]));
  }
  void closest(const std::optional<hinge::Hit>& hit, const char* engine) {
    if (!asked_) {
      asked_ = true;
      closest_ = hit;
      return;
    }
    if (hit.has_value() != closest_.has_value())
      find(std::string(what_) + ": " + engine + (hit ? " has a closest pair" : " has no closest pair"));
    if (hit && !agree(hit->gap(), closest_->gap(), size_))
      find(std::string(what_) + ": closest by brute " + text(*closest_) + ", by " + engine + " " + text(*hit));
  }
  void collides(bool answer, const char* engine) const {
    if (answer != !list_->empty())
      find(std::string(what_) + ": " + engine + (answer ? " says yes to no pair" : " overlooks all pairs"));
  }
  const std::vector<hinge::Hit>& list() const { return *list_; }

 private:
  double size_;
  const char* what_;
  std::optional<std::vector<hinge::Hit>> list_;
  bool asked_ = false;
  std::optional<hinge::Hit> closest_;
};

}  // namespace fuzz
