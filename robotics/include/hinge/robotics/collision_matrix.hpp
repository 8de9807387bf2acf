// SPDX-License-Identifier: BSD-3-Clause
// find_collision_matrix: finds the pairs of links that need testing, by sampling and by proofs over the joint limits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/id.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// What is known about a pair of links. If several kinds apply, the first one in this list is reported.
enum class PairKind : std::uint8_t {
  adjacent,    ///< both in one rigid group, or in two groups that one movable joint connects
  always,      ///< too close in every sample
  in_default,  ///< too close in the default configuration
  sometimes,   ///< too close in a sample, or in a configuration that the search evaluated
  never,       ///< proved: nowhere within the joint limits too close
  unseen       ///< never found too close, but not proved either
};

/// Options of find_collision_matrix().
struct MatrixOptions {
  std::size_t samples = 100'000;  ///< number of random configurations, uniform within the limits
  std::uint64_t seed = 1;         ///< seed of the random configurations
  /// Largest number of boxes of joint values that the proof may try per pair; 0 disables proofs. The benefit of more
  /// boxes is measured in docs/explanation/collision_matrix.md.
  std::size_t cells = 20'000;
  double clearance = 0.0;  ///< m, finite, >= 0; links closer than this are too close, and links that touch always are
  /// Pairs that need no proof, for example because an SRDF file disables them. They are still sampled. Empty: none.
  LinkPairs settled{};
};

/// The result for one pair of links.
struct MatrixEntry {
  LinkId link1{};                    ///< always less than link2
  LinkId link2{};                    ///< the other link
  PairKind kind = PairKind::unseen;  ///< the class of the pair
  std::size_t samples = 0;           ///< number of samples tested; 0 for adjacent pairs
  std::size_t hits = 0;              ///< number of samples in which the links were too close
  std::size_t cells = 0;             ///< number of boxes of joint values that the search tried
  /// Smallest distance (m) between the two surfaces that the search computed at a configuration. It is an upper bound
  /// on the true smallest distance. Empty if the search computed no distance: bounding volumes were sufficient, or the
  /// pair was not searched.
  std::optional<double> smallest_gap{};
};

/// The result of find_collision_matrix().
struct CollisionMatrix {
  std::vector<MatrixEntry> entries;  ///< every pair of links with geometry, once, sorted by (link1, link2)
};

/// Progress of find_collision_matrix().
struct MatrixProgress {
  /// First configurations are sampled, then pairs without hits are proved.
  enum class Stage : std::uint8_t { sampling, proving } stage = Stage::sampling;  ///< the present stage
  double fraction = 0.0;  ///< completed fraction of the stage, 0 to 1
};

/// Classifies every pair of links with geometry. The result depends only on the robot and the options, not on the
/// machine. In the default configuration each independent joint is 0, or in the middle of its limits if 0 is outside
/// them. Calls `progress`, if it is not empty, on the calling thread, for every 64 samples and every box of a proof; it
/// may throw to end the search. Throws ModelError if the clearance is negative or not finite, or if `settled` was made
/// for another number of links.
HINGE_API CollisionMatrix find_collision_matrix(const Robot& robot, const MatrixOptions& options = {},
                                                const std::function<void(const MatrixProgress&)>& progress = {});

/// Returns the configuration that PairKind::in_default is about: 0, or the middle of the limits of a joint that cannot
/// be at 0. One value per independent joint, rad or m.
HINGE_API std::vector<double> default_configuration(const Robot& robot);

/// The treatment of unseen pairs: still tested (the safe choice), or disabled like the others.
enum class UnseenPairs : std::uint8_t { tested, disabled };

/// Returns true if a collision check may skip pairs of this kind: adjacent, always, in_default, never, and unseen if
/// `unseen` is UnseenPairs::disabled.
HINGE_API bool is_disabled(PairKind kind, UnseenPairs unseen) noexcept;
/// Returns the pairs of `matrix` for which is_disabled() is true. Throws ModelError if a pair names a link that the
/// robot does not have.
HINGE_API LinkPairs disabled_pairs(const Robot& robot, const CollisionMatrix& matrix,
                                   UnseenPairs unseen = UnseenPairs::tested);

}  // namespace hinge::robotics
