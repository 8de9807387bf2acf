// SPDX-License-Identifier: BSD-3-Clause
// Straight paths, certified and sampled at steps of 0.1, 1 and 5 degrees: times, missed collisions, and whether a
// query contradicts an answer; and the set-ups of proteins.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/path/certified_path.hpp"
#include "hinge/path/check_sampled.hpp"
#include "results.hpp"
#include "scene.hpp"
#include "timing.hpp"

namespace hinge::bench {

inline constexpr double degree = std::numbers::pi / 180.0;
inline constexpr int looked_at = 1000;  // states tested on every path that was called free

struct Path {
  std::vector<double> from, to;
};

/// CPU time of this thread in microseconds, because other programs share the machine.
inline double thread_microseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

enum PathMethod : std::size_t { certified, sampled_tenth, sampled_one, sampled_five, path_methods };
inline constexpr std::array<const char*, path_methods> path_method_names = {"certified", "sampled-0.1deg",
                                                                            "sampled-1deg", "sampled-5deg"};
inline constexpr std::array<double, path_methods> path_steps = {0.0, 0.1, 1.0, 5.0};

/// Verdicts and times of a set of paths.
struct PathRow {
  int free = 0, colliding = 0, undecided = 0, wrong = 0;
  std::array<double, path_methods> free_us{}, colliding_us{};  // sums over paths
  std::array<int, path_methods> missed{};                      // colliding paths that were called free
  double segments = 0.0, listed = 0.0;                         // sums over free paths
};

template <class H>
bool collides_at(H& h, const Path& path, double t) {
  std::vector<double> q(path.from.size());
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = path.from[k] + t * (path.to[k] - path.from[k]);
  h.update(q);
  return h.self_collides();
}

/// All methods take turns on every path; the best of three times counts.
template <class H>
PathRow measure_paths(const H& hierarchy, const std::vector<Path>& paths) {
  H h = hierarchy;
  CertifiedPath certify(hierarchy);
  PathRow row;
  for (const Path& path : paths) {
    std::array<double, path_methods> best;
    best.fill(std::numeric_limits<double>::infinity());
    std::array<PathAnswer, path_methods> answers;
    for (int repetition = 0; repetition < repetitions; ++repetition)
      for (std::size_t m = 0; m < path_methods; ++m) {
        const double start = thread_microseconds();
        answers[m] = m == certified ? certify.check(path.from, path.to)
                                    : check_sampled(h, path.from, path.to, path_steps[m] * degree);
        best[m] = std::min(best[m], thread_microseconds() - start);
      }
    const PathAnswer& answer = answers[certified];
    const bool is_free = answer.verdict == PathVerdict::free;
    row.free += is_free;
    row.colliding += answer.verdict == PathVerdict::colliding;
    row.undecided += answer.verdict == PathVerdict::undecided;
    if (is_free) {
      row.segments += static_cast<double>(answer.counts.segments);
      row.listed += static_cast<double>(answer.counts.pairs_listed);
      bool wrong = false;
      for (int k = 0; k <= looked_at && !wrong; ++k) wrong = collides_at(h, path, static_cast<double>(k) / looked_at);
      for (const PathAnswer& sampled : answers) wrong = wrong || sampled.verdict == PathVerdict::colliding;
      row.wrong += wrong;
    }
    if (answer.verdict == PathVerdict::colliding) {
      h.update(answer.configuration);
      row.wrong += !h.self_collides();
    }
    for (std::size_t m = 0; m < path_methods; ++m) {
      if (is_free) row.free_us[m] += best[m];
      if (answer.verdict != PathVerdict::colliding) continue;
      row.colliding_us[m] += best[m];
      row.missed[m] += answers[m].verdict == PathVerdict::free;
    }
  }
  return row;
}

/// Prints sampling time over certification time, for free paths.
inline void print_path_ratios(Results& results, const std::string& set, const PathRow& row) {
  for (const PathMethod m : {sampled_tenth, sampled_one})
    if (row.free > 0)
      results.print("path any " + set + ' ' + path_method_names[m], row.free_us[m] / row.free_us[certified]);
}

inline void add_paths(Results& results, const std::string& set, std::size_t dof, const PathRow& row) {
  Json json = {{"kind", "path"},
               {"set", set},
               {"dof", dof},
               {"free", row.free},
               {"colliding", row.colliding},
               {"undecided", row.undecided},
               {"wrong", row.wrong}};
  for (std::size_t m = 0; m < path_methods; ++m) {
    const std::string name = path_method_names[m];
    json[name + "_free_us"] = row.free > 0 ? Json(row.free_us[m] / row.free) : Json();
    json[name + "_missed"] = row.missed[m];
  }
  json["segments"] = row.free > 0 ? Json(row.segments / row.free) : Json();
  results.add(std::move(json));
}

/// The paths of one set-up.
struct ProteinPaths {
  const char* name;
  std::string free;
  double amplitude;  // degrees
};

/// The set-ups of docs/explanation/certified_paths.md. Without the shared data, 1UBQ replaces 1MBN and a line says
/// so.
inline std::pair<Protein, std::vector<ProteinPaths>> protein_paths() {
  std::string file = shared_molecule("paper/1mbn.pdb"), tail = "A:142-153";
  if (file.empty()) {
    std::printf("the shared paper/1mbn.pdb is missing: 1UBQ is used instead\n");
    file = ubiquitin();
    tail = "A:65-76";
  }
  return {read_protein(file, false),
          {{"tail-5deg", tail, 5.0},
           {"tail-20deg", tail, 20.0},
           {"k10-5deg", "count:10", 5.0},
           {"k10-20deg", "count:10", 20.0},
           {"k35-5deg", "count:35", 5.0},
           {"k35-20deg", "count:35", 20.0},
           {"k153-1deg", "count:153", 1.0}}};
}

/// Paths between states of a random walk. The walk starts at the native structure; a move sets one torsion within
/// +-amplitude (rad) and is kept if the state is free. There are ten moves per torsion between two states.
template <class H>
std::vector<Path> walk_paths(H& h, double amplitude, int count) {
  SampleStream random(seed, 1);
  std::vector<double> q(h.dof_count(), 0.0);
  const auto next_state = [&] {
    for (std::size_t move = 0; move < 10 * q.size(); ++move) {
      const auto k = static_cast<std::size_t>(random.uniform() * static_cast<double>(q.size()));
      const double before = q[k];
      q[k] = amplitude * (2.0 * random.uniform() - 1.0);
      h.update(q);
      if (h.self_collides()) q[k] = before;
    }
    return q;
  };
  std::vector<Path> paths;
  for (int k = 0; k < count; ++k) {
    Path path{next_state(), {}};
    path.to = next_state();
    paths.push_back(std::move(path));
  }
  return paths;
}

inline PathRow measure_paths(const Scene& scene, const ProteinPaths& set, int count) {
  auto h = scene.make<Simd>();
  return measure_paths(h, walk_paths(h, set.amplitude * degree, count));
}

}  // namespace hinge::bench
