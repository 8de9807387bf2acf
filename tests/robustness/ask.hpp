// SPDX-License-Identifier: BSD-3-Clause
// Helpers for all kinds of cases: refusals as answers, queries in several modes, the choice of an engine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/policy/collector.hpp"
#include "robustness/case.hpp"

namespace hinge::robustness {

/// Returns the answer of `ask`, or a refused answer if it throws an error of the library. way: how the case is asked.
template <class Ask>
Answer asked(std::string way, const Ask& ask) {
  Answer answer;
  try {
    answer = ask();
  } catch (const Error& refusal) {
    answer.refused = true;
    answer.message = refusal.what();
  }
  answer.way = std::move(way);
  return answer;
}

/// Adds a contradiction to the answer.
inline void contradict(Answer& answer, const std::string& what) {
  answer.contradiction += (answer.contradiction.empty() ? "" : "; ") + what;
}

/// Stores the hits and checks that yes/no and the list agree. `offset` is added to the second primitive's index.
inline void take_hits(Answer& answer, bool any, const std::vector<Hit>& hits, std::size_t offset = 0) {
  answer.hit = any;
  answer.pair_count = hits.size();
  for (const Hit& hit : hits) {
    answer.pairs.push_back(static_cast<std::uint32_t>(index(hit.first)));
    answer.pairs.push_back(static_cast<std::uint32_t>(index(hit.second) + offset));
  }
  if (any == hits.empty()) contradict(answer, "yes/no and the list of hits differ");
}

/// Stores the distance. Valid for thresholds of 0: the distance must be 0 if and only if there is a hit.
inline void take_closest(Answer& answer, const std::optional<Hit>& closest) {
  if (closest) answer.distance = closest->distance;
  if (answer.hit != (answer.distance == 0.0)) contradict(answer, "distance 0 and yes/no differ");
}

/// Returns three values as a vector; throws ModelError for any other number of values.
inline Vec3 vector_of(const std::vector<double>& values, const std::string& what) {
  if (values.size() != 3) throw ModelError(what + ": " + std::to_string(values.size()) + " numbers, expected three");
  return {values[0], values[1], values[2]};
}

/// Calls run.operator()<EngineOf>() with the engine of this name.
template <class Run>
auto on(EngineName engine, const Run& run) {
  if (engine == EngineName::brute) return run.template operator()<Brute>();
  if (engine == EngineName::lazy) return run.template operator()<Lazy>();
  return run.template operator()<Simd>();
}

}  // namespace hinge::robustness
