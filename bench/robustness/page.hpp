// SPDX-License-Identifier: BSD-3-Clause
// The tables of docs/explanation/robustness.md, from measured rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "markdown.hpp"

namespace hinge::bench {

using Rows = std::vector<Json>;

inline std::string scientific(double x) {
  if (x == 0.0) return "0";
  if (x >= 1e299) return "infinite";
  char text[32];
  std::snprintf(text, sizeof text, x < 0.01 || x >= 1000.0 ? "%.1e" : x < 100.0 ? "%.2g" : "%.0f", x);
  return text;
}

/// Percentage of the pairs; "0" only if the count is 0.
inline std::string share(const Json& row, const char* key) {
  const double count = row.at(key).get<double>(), pairs = row.at("pairs").get<double>();
  if (count == 0.0) return "0";
  const double percent = 100.0 * count / pairs;
  char text[32];
  std::snprintf(text, sizeof text, percent < 10.0 ? "%.2g %%" : "%.0f %%", percent);
  return text;
}

class RobustnessPage {
 public:
  explicit RobustnessPage(const Rows& rows) {
    for (const Json& row : rows) rows_[Found::text(row, "kind")].push_back(row);
  }

  std::string text(const std::string& header_lines) const {
    return "\n" + header_lines + "\n## Do two triangles share a point?\n\n" + verdicts() +
           "\n## How far apart are they?\n\n" + distances() + "\n## Atoms and balls\n\n" + balls() +
           "\n## The price\n\n" + prices() + "\n";
  }

  std::string verdicts() const {
    std::string out = header({"family", "touching", "Hinge: wrong yes / no", "Hinge's hierarchy", "plain double",
                              "FCL's kernel", "widest gap reported as a hit", "FCL's meshes"});
    for (const auto& [family, by] : families()) {
      const auto both = [&, &by = by](const char* who) {
        return share(by.at(who), "wrong_yes") + " / " + share(by.at(who), "wrong_no");
      };
      out += line({family, share(by.at("hinge"), "touching"), both("hinge"), both("hierarchy"), both("plain"),
                   both("fcl"), scientific(Found::value(by.at("fcl"), "widest_yes")), both("fcl-mesh")});
    }
    return out;
  }

  std::string distances() const {
    std::string out = header({"family", "method", "0, but apart", "widest", "> 0, but touching", "largest",
                              "largest error, ulps of the size", "relative error, if apart", "contradictions",
                              "d < m near a tie: wrong"});
    for (const auto& [family, by] : families())
      for (const auto& [who, shown] :
           {std::pair("hinge", "Hinge"), std::pair("plain", "plain"), std::pair("fcl", "FCL")}) {
        const Json& row = by.at(who);
        out += line({family, shown, share(row, "zero_apart"), scientific(Found::value(row, "widest_zero")),
                     share(row, "positive_touching"), scientific(Found::value(row, "largest_positive")),
                     scientific(Found::value(row, "ulps_of_size")), scientific(Found::value(row, "relative")),
                     share(row, "contradictions"), share(row, "threshold_wrong")});
      }
    return out;
  }

  std::string balls() const {
    std::string out = header(
        {"pairs", "d < M", "Point: wrong", "one comparison", "touching", "Sphere: wrong", "one comparison", "FCL"});
    for (const Json& row : of("balls"))
      out += line({Found::text(row, "family"), share(row, "below"), share(row, "point"), share(row, "plain_point"),
                   share(row, "touching"), share(row, "sphere"), share(row, "plain_sphere"), share(row, "fcl")});
    return out;
  }

  std::string prices() const {
    std::string out;
    for (const char* kind : {"molecules", "meshes"}) {
      double sum = 0.0, worst = 0.0;
      int count = 0;
      long long asked = 0, different = 0, distances = 0;
      for (const Json& row : of("price")) {
        if (Found::text(row, "of") != kind) continue;
        sum += std::log(Found::value(row, "ratio"));
        worst = std::max(worst, Found::value(row, "ratio"));
        ++count;
        asked += row.at("asked").get<long long>();
        different += row.at("different").get<long long>();
        distances += row.at("distances_different").get<long long>();
      }
      if (count == 0) continue;
      char text[256];
      std::snprintf(text, sizeof text,
                    "* %s: %+.1f %% (geometric mean of the %d rows below, largest %+.1f %%); of %lld answers, %lld "
                    "verdicts and %lld distances differ.\n",
                    kind, 100.0 * (std::exp(sum / count) - 1.0), count, 100.0 * (worst - 1.0), asked, different,
                    distances);
      out += text;
    }
    out += "\n" + header({"scene", "primitives", "states", "query", "exact, µs", "exact / plain", "quartiles",
                          "different verdicts", "different distances"});
    for (const Json& row : of("price"))
      out += line({Found::text(row, "scene"), std::to_string(row.at("primitives").get<long long>()),
                   Found::text(row, "states"), Found::text(row, "query"), number(Found::value(row, "us")),
                   number(Found::value(row, "ratio"), 4),
                   number(Found::value(row, "low"), 4) + " to " + number(Found::value(row, "high"), 4),
                   std::to_string(row.at("different").get<long long>()) + " of " +
                       std::to_string(row.at("asked").get<long long>()),
                   std::to_string(row.at("distances_different").get<long long>())});
    return out;
  }

 private:
  using ByWho = std::map<std::string, Json>;

  const Rows& of(const std::string& kind) const {
    static const Rows none;
    const auto found = rows_.find(kind);
    return found == rows_.end() ? none : found->second;
  }
  /// Families in the order they were run.
  std::vector<std::pair<std::string, ByWho>> families() const {
    std::vector<std::pair<std::string, ByWho>> all;
    for (const Json& row : of("family")) {
      const std::string family = Found::text(row, "family");
      if (all.empty() || all.back().first != family) all.push_back({family, {}});
      all.back().second.emplace(Found::text(row, "who"), row);
    }
    return all;
  }

  std::map<std::string, Rows> rows_;
};

}  // namespace hinge::bench
