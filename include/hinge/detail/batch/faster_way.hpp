// SPDX-License-Identifier: BSD-3-Clause
// FasterWay: chooses between two ways to compute the same answers, by the times that they took recently.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

namespace hinge::detail {

/// The work comes in pieces of similar size, and most pieces use the faster way. The other way is tried again after 4,
/// 8, 16 ... pieces, at most 4096, so the trials cost little even if that way is much slower. A trial is two pieces
/// long, and its result is the shorter of the two times: the first piece may compute data that later pieces reuse.
class FasterWay {
 public:
  /// Returns the way for the next piece, 0 or 1.
  std::size_t next() const noexcept { return trying_ > 0 ? 1 - best_ : best_; }

  /// seconds: the time of the piece, done in the way of next().
  void took(double seconds) noexcept {
    if (trying_ == 0) {
      best_seconds_ = seconds;
      if (--left_ == 0) {
        trying_ = trial;
        tried_seconds_ = std::numeric_limits<double>::infinity();
      }
      return;
    }
    tried_seconds_ = std::min(tried_seconds_, seconds);
    if (--trying_ > 0) return;
    if (tried_seconds_ < best_seconds_) {
      best_ = 1 - best_;
      best_seconds_ = tried_seconds_;
      pause_ = shortest_pause;
    } else {
      pause_ = std::min(2 * pause_, longest_pause);
    }
    left_ = pause_;
  }

 private:
  static constexpr std::size_t trial = 2, shortest_pause = 4, longest_pause = 4096;

  std::size_t best_ = 0;
  double best_seconds_ = 0.0;   // of the last piece in the better way
  double tried_seconds_ = 0.0;  // of the faster piece of the present trial
  std::size_t trying_ = 0;      // pieces left of a trial of the other way
  std::size_t left_ = 1;        // pieces until the next trial
  std::size_t pause_ = shortest_pause;
};

}  // namespace hinge::detail
