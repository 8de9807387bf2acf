// SPDX-License-Identifier: BSD-3-Clause
// find_collision_matrix: which pairs of links need testing: seen in samples, or proved never to meet within the limits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// What is known of a pair of links; the first that holds.
enum class PairKind : std::uint8_t {
  adjacent,    ///< of one rigid group, or of two groups joined by one movable joint
  always,      ///< closer than the clearance in every sample
  in_default,  ///< closer than the clearance in the default configuration
  sometimes,   ///< closer than the clearance in a sample, or in a configuration the search came by
  never,       ///< proved: nowhere within the joint limits closer than the clearance
  unseen       ///< neither seen closer than the clearance nor proved never to be
};

struct MatrixOptions {
  std::size_t samples = 100'000;  ///< random configurations, uniform within the limits
  std::uint64_t seed = 1;
  /// Boxes of joint values a proof may try, per pair; 0: no proofs. See docs/explanation/collision_matrix.md for what
  /// more of them buy.
  std::size_t cells = 20'000;
  double clearance = 0.0;  ///< m, finite, >= 0; two links that touch are too close whatever it is
  /// Pairs of which no proof is wanted, as of an SRDF file that disables them: samples are looked at all the same.
  /// Empty: none.
  LinkPairs settled{};
};

struct MatrixEntry {
  LinkId link1{};  ///< link1 < link2
  LinkId link2{};
  PairKind kind = PairKind::unseen;
  std::size_t samples = 0;  ///< configurations looked at; 0 for adjacent pairs
  std::size_t hits = 0;     ///< samples in which the links were too close
  std::size_t cells = 0;    ///< boxes of joint values the search tried
  /// m, the smallest distance between surfaces that the search computed at a configuration: the true smallest one is at
  /// most this. None where volumes around the links were enough, or nothing was searched.
  std::optional<double> smallest_gap{};
};

struct CollisionMatrix {
  std::vector<MatrixEntry> entries;  ///< every pair of links with geometry once, sorted by (link1, link2)
};

/// What is being done and how much of it is done, 0 to 1.
struct MatrixProgress {
  enum class Stage : std::uint8_t { sampling, proving } stage = Stage::sampling;
  double fraction = 0.0;
};

/// The same for the same robot and options, on every machine. The default configuration is 0 for every independent
/// joint, the middle of its limits where 0 is outside. ModelError: a clearance that is not finite or below 0; `settled`
/// made for another number of links.
CollisionMatrix find_collision_matrix(const Robot& robot, const MatrixOptions& options = {},
                                      const std::function<void(const MatrixProgress&)>& progress = {});

/// Pairs that nobody saw meet and nobody proved apart: left to be tested (the safe choice), or disabled like the rest.
enum class UnseenPairs : std::uint8_t { tested, disabled };

/// The pairs a collision check may leave out: adjacent, always, in_default, never; unseen ones only when asked.
bool is_disabled(PairKind kind, UnseenPairs unseen) noexcept;
LinkPairs disabled_pairs(const Robot& robot, const CollisionMatrix& matrix, UnseenPairs unseen = UnseenPairs::tested);

}  // namespace hinge::robotics
