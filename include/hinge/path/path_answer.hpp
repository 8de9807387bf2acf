// SPDX-License-Identifier: BSD-3-Clause
// PathAnswer: the verdict on a straight path between two configurations, and the work it took.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hinge/policy/collector.hpp"

namespace hinge {

/// The verdict on a path.
enum class PathVerdict : std::uint8_t {
  free,       ///< sampled: no sampled state collides; certified: proved for every state of the path
  colliding,  ///< one configuration of the path collides, by the exact query
  undecided   ///< certified only: no verdict down to the smallest step
};

/// The verdict in lower case, as reports print it; a static string.
inline const char* name(PathVerdict verdict) noexcept {
  switch (verdict) {
    case PathVerdict::free: return "free";
    case PathVerdict::colliding: return "colliding";
    case PathVerdict::undecided: break;
  }
  return "undecided";
}

/// Work done by one check of a path.
struct PathCounts {
  std::uint64_t configurations = 0;  ///< states for which forward kinematics were computed
  std::uint64_t segments = 0;        ///< segments of the path that were examined
  /// pairs of primitives examined, or pairs of links that stand for many, counted once per segment
  std::uint64_t pairs_listed = 0;
  std::uint64_t pairs_proved = 0;  ///< pairs_listed that were proved apart over the whole segment
};

/// The default smallest step, as a share of the path: 2^-20, about a millionth. A pair that is undecided at this
/// length touches its threshold, or nearly so.
inline constexpr double smallest_path_step = 0x1p-20;

/// The answer for the path q(t) = q0 + t (q1 - q0), 0 <= t <= 1.
struct PathAnswer {
  PathVerdict verdict = PathVerdict::undecided;  ///< the verdict on the whole path
  /// colliding: t of the collision; undecided: t in the middle of an undecided segment
  double parameter = 0.0;
  double half_width = 0.0;  ///< undecided: half the length of that segment; otherwise 0
  /// the state at `parameter` (rad or model length unit); empty if the path is free
  std::vector<double> configuration;
  /// colliding: a pair that collides; undecided: a pair that was not proved apart, if one is known
  std::optional<Hit> hit;
  PathCounts counts;  ///< work done for this answer

  /// True if the verdict is free.
  bool is_free() const noexcept { return verdict == PathVerdict::free; }
};

}  // namespace hinge
