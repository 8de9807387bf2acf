// SPDX-License-Identifier: BSD-3-Clause
// check_block: validates a block of configurations for SIMD lanes by the rules for a single configuration.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge::detail {

/// block: 1 to 16 configurations, one after the other, dof_count values each (rad or model length unit); empty if
/// dof_count is 0. Returns their number. Throws ConfigurationError if the length is wrong, a value is not finite, or a
/// slide exceeds largest_length; the message names configuration and value.
inline std::size_t check_block(std::span<const double> block, std::size_t dof_count, const RigidGroups& groups) {
  if (dof_count == 0 ? !block.empty()
                     : block.empty() || block.size() % dof_count != 0 || block.size() > simd::width * dof_count)
    throw ConfigurationError("a block of " + std::to_string(block.size()) + " values, expected 1 to " +
                             std::to_string(simd::width) + " configurations of " + std::to_string(dof_count) +
                             " values");
  const auto refuse = [&](std::size_t k, const char* expected) {
    throw ConfigurationError("configuration " + std::to_string(k / dof_count) + " of the block, value " +
                             std::to_string(k % dof_count) + " is " + number_text(block[k]) + ", expected " + expected);
  };
  const bool finite = is_finite(block);
  for (std::size_t k = 0; !finite && k < block.size(); ++k)
    if (!is_finite(block[k])) refuse(k, "a finite number");
  for (std::size_t g = 1; g < groups.size(); ++g) {
    const RigidGroup& group = groups[id<GroupId>(g)];
    if (group.joint.kind != JointKind::prismatic) continue;
    for (std::size_t k = group.dof; k < block.size(); k += dof_count)
      if (!is_length(block[k])) refuse(k, "a displacement of at most 2^1000");
  }
  return dof_count == 0 ? 1 : block.size() / dof_count;
}

/// Stores the caller's block in a member for the duration of one query.
class PresentBlock {
 public:
  PresentBlock(std::span<const double>& member, std::span<const double> block) noexcept : member_(member) {
    member_ = block;
  }
  PresentBlock(const PresentBlock&) = delete;
  PresentBlock& operator=(const PresentBlock&) = delete;
  ~PresentBlock() { member_ = {}; }

 private:
  std::span<const double>& member_;
};

}  // namespace hinge::detail
