// SPDX-License-Identifier: BSD-3-Clause
// trade_precision: times and errors of decisions in float, to either side, relative to exact answers on the same
// conformations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "contestant.hpp"
#include "results.hpp"
#include "scene.hpp"
#include "timing.hpp"

namespace hinge::bench {

inline constexpr std::array precisions = {Precision::exact, Precision::never_miss, Precision::never_cry_wolf};
inline constexpr std::array precision_names = {"exact", "float, never miss", "float, never cry wolf"};

/// Times and errors of one precision over all conformations.
struct PrecisionTotals {
  std::array<double, 3> us{};                          // any, all, within: from torsion angles; mean of the best times
  std::uint64_t accepts = 0, rejects = 0;              // conformations wrongly called free, wrongly called colliding
  std::uint64_t missed = 0, added = 0, undecided = 0;  // numbers of colliding pairs
  double largest_error = 0.0;                          // largest error of a distance within the margin, angstrom
};

/// Collects hits with their distances in the order found; sorting is not timed.
class FoundHits {
 public:
  static constexpr bool ranks = false;
  FoundHits(double below, std::vector<Hit>& out) noexcept : below_(below), out_(out) { out_.clear(); }
  void add(const Hit& hit) { out_.push_back(hit); }
  double cutoff() const noexcept { return below_; }
  bool done() const noexcept { return false; }

 private:
  double below_;
  std::vector<Hit>& out_;
};

/// Number of pairs of `hits` that are not in `others`; both lists are sorted. Calls `both` with the two distances of
/// each common pair.
template <class Both>
std::uint64_t missing(const std::vector<Hit>& hits, const std::vector<Hit>& others, const Both& both) {
  std::uint64_t count = 0;
  auto other = others.begin();
  const auto pair = [](const Hit& hit) { return std::pair(hit.first, hit.second); };
  for (const Hit& hit : hits) {
    while (other != others.end() && pair(*other) < pair(hit)) ++other;
    if (other != others.end() && pair(*other) == pair(hit))
      both(hit.distance, other->distance);
    else
      ++count;
  }
  return count;
}

inline void trade_precision(Scene& scene, Sampling sampling, std::size_t count, Results& results) {
  constexpr std::size_t n = precisions.size();
  constexpr std::array asked = {Query::any, Query::all, Query::within};
  std::vector<Molecular<Simd>> h(n, scene.make<Simd>());
  std::vector<std::vector<double>> q;
  for (std::uint64_t k = 0; k < count; ++k) q.push_back(scene.configuration(sampling, k));
  std::array<PrecisionTotals, n> totals;
  std::vector<Hit> hits;
  for (std::size_t query = 0; query < asked.size(); ++query) {
    std::vector<double> best(n * count, std::numeric_limits<double>::infinity());
    for (int repetition = 0; repetition < repetitions; ++repetition)
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t turn = 0; turn < n; ++turn) {
          const std::size_t c = (turn + k) % n;
          QueryOptions options;
          options.precision = precisions[c];
          FoundHits found(asked[query] == Query::within ? margin : 0.0, hits);
          const double us = microseconds([&] {
            h[c].update(q[k]);
            if (asked[query] == Query::any)
              h[c].self_collides(options);
            else
              h[c].self_query(found, options);
          });
          best[c * count + k] = std::min(best[c * count + k], us);
        }
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t k = 0; k < count; ++k) totals[c].us[query] += best[c * count + k] / static_cast<double>(count);
  }
  std::uint64_t pairs = 0, colliding = 0;
  for (const std::vector<double>& state : q) {
    std::array<std::vector<Hit>, n> all, within;
    for (std::size_t c = 0; c < n; ++c) {
      PrecisionTotals& t = totals[c];
      QueryCounts counts;
      QueryOptions options;
      options.precision = precisions[c];
      h[c].update(state);
      within[c] = h[c].self_within(margin, options);
      options.counts = &counts;
      all[c] = h[c].self_collisions(options);
      t.undecided += counts.undecided;
      t.accepts += !h[c].self_collides(options) && !all[0].empty() ? 1 : 0;
      t.rejects += h[c].self_collides(options) && all[0].empty() ? 1 : 0;
      t.missed += missing(all[0], all[c], [](double, double) {});
      t.added += missing(all[c], all[0], [](double, double) {});
      missing(within[0], within[c], [&](double exact, double given) {
        t.largest_error = std::max(t.largest_error, std::abs(exact - given));
      });
    }
    pairs += all[0].size();
    colliding += all[0].empty() ? 0 : 1;
  }
  for (std::size_t c = 0; c < n; ++c) {
    const PrecisionTotals& t = totals[c];
    std::printf("%-10s %-22s %9.2f %9.2f %9.2f %8llu %8llu %10llu %8llu %8llu %8llu %10.2g\n", name(sampling),
                precision_names[c], t.us[0], t.us[1], t.us[2], static_cast<unsigned long long>(t.accepts),
                static_cast<unsigned long long>(t.rejects), static_cast<unsigned long long>(pairs),
                static_cast<unsigned long long>(t.missed), static_cast<unsigned long long>(t.added),
                static_cast<unsigned long long>(t.undecided), t.largest_error);
    results.add({{"kind", "precision"},
                 {"sampling", name(sampling)},
                 {"precision", precision_names[c]},
                 {"conformations", count},
                 {"colliding", colliding},
                 {"any_us", t.us[0]},
                 {"all_us", t.us[1]},
                 {"within_us", t.us[2]},
                 {"false_accepts", t.accepts},
                 {"false_rejects", t.rejects},
                 {"pairs", pairs},
                 {"missed", t.missed},
                 {"added", t.added},
                 {"undecided", t.undecided},
                 {"largest_distance_error", t.largest_error}});
  }
  std::fflush(stdout);
}

/// All torsions of a protein, with all samplings.
inline void trade_precision(const Protein& protein, const DofSelection& selection, std::size_t count,
                            Results& results) {
  std::printf("\n%zu conformations decided in float; microseconds per conformation, with forward kinematics\n", count);
  std::printf("%-10s %-22s %9s %9s %9s %8s %8s %10s %8s %8s %8s %10s\n", "", "", "any", "all", "within", "accepts",
              "rejects", "pairs", "missed", "added", "undec.", "largest A");
  Scene scene(protein, selection);
  for (const Sampling sampling : all_samplings) trade_precision(scene, sampling, count, results);
}

}  // namespace hinge::bench
