// SPDX-License-Identifier: BSD-3-Clause
// Checks that two engines give the same answers for a robot that was read.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fuzz/require.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tested_pairs.hpp"

namespace fuzz {

/// The checker may reject values whose poses overflow.
inline void check_robot(const std::shared_ptr<const hinge::robotics::Robot>& robot,
                        const hinge::robotics::LinkPairs& disabled, const std::vector<double>& q) {
  using hinge::robotics::LinkMargins;
  using hinge::robotics::Mode;
  using hinge::robotics::RobotChecker;
  const auto tested = hinge::robotics::tested_pairs(*robot, disabled);
  RobotChecker simd(robot, tested, LinkMargins(*robot, 0.01));
  // Brute force is quadratic and slow under sanitizers, so large robots run on one engine only.
  constexpr std::size_t most = 120;
  if (robot->model().size() > most) {
    accepts([&] { simd.check(q, {Mode::Kind::all, 0.0}); });
    return;
  }
  RobotChecker brute(robot, tested, LinkMargins(*robot, 0.01), {"brute"});
  accepts([&] {
    for (const Mode& mode : {Mode{Mode::Kind::all, 0.0}, Mode{Mode::Kind::within, 0.5}, Mode{Mode::Kind::any, 0.0},
                             Mode{Mode::Kind::closest, 0.0}}) {
      const auto fast = simd.check(q, mode), slow = brute.check(q, mode);
      require(fast.collides == slow.collides, "simd and brute differ in a yes or no");
      require(fast.pairs.size() == slow.pairs.size(), "simd and brute differ in their pairs");
      for (std::size_t k = 0; k < fast.pairs.size(); ++k)
        require(fast.pairs[k].link1 == slow.pairs[k].link1 && fast.pairs[k].link2 == slow.pairs[k].link2,
                "simd and brute differ in their pairs");
      require(fast.closest.has_value() == slow.closest.has_value(), "simd and brute differ in the closest pair");
    }
    simd.contained();
  });
}

}  // namespace fuzz
