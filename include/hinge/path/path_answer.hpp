// SPDX-License-Identifier: BSD-3-Clause
// PathAnswer: what is said about a straight path between two configurations, and the work it took.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hinge/policy/collector.hpp"

namespace hinge {

enum class PathVerdict : std::uint8_t {
  free,       ///< sampled: no state that was looked at collides; certified: proved for every state of the path
  colliding,  ///< at one configuration of the path, by the ordinary query
  undecided   ///< certified only: neither, down to the smallest step
};

inline const char* name(PathVerdict verdict) noexcept {
  switch (verdict) {
    case PathVerdict::free: return "free";
    case PathVerdict::colliding: return "colliding";
    case PathVerdict::undecided: break;
  }
  return "undecided";
}

struct PathCounts {
  std::uint64_t configurations = 0;  ///< states the kinematics were computed for
  std::uint64_t segments = 0;        ///< pieces of the path that were looked at
  std::uint64_t pairs_listed = 0;    ///< pairs of primitives, or of links of many, looked at, once for every segment
  std::uint64_t pairs_proved = 0;    ///< of these, proved apart over the whole segment
};

/// As a share of the path, a millionth: pairs that no shorter step settles touch their threshold, or nearly so.
inline constexpr double smallest_path_step = 0x1p-20;

/// The path is q(t) = q0 + t (q1 - q0), 0 <= t <= 1.
struct PathAnswer {
  PathVerdict verdict = PathVerdict::undecided;
  double parameter = 0.0;             ///< colliding: t; undecided: the middle of a stretch that is not
  double half_width = 0.0;            ///< undecided: of that stretch, else 0
  std::vector<double> configuration;  ///< at t; empty when the path is free
  std::optional<Hit> hit;             ///< colliding: a pair that does; undecided: a pair nothing is proved of
  PathCounts counts;

  bool is_free() const noexcept { return verdict == PathVerdict::free; }
};

}  // namespace hinge
