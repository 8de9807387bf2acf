// SPDX-License-Identifier: BSD-3-Clause
// CrossOperands: both models of a cross query, refreshed, and the boxes of the other model in this model's unit.
#pragma once

#include <cstddef>

#include "hinge/core/id.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/tree/tree_operand.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/detail/engine/simd/tree/tree_state.hpp"
#include "hinge/model/placement.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Refreshes both states on construction. `mine` is the first model, `others` the second.
template <Primitive P>
struct CrossOperands {
  CrossOperands(TreeState<P>& state, Placement<P>& placement, TreeState<P>& their_state, Placement<P>& their_placement,
                const QueryOptions& options)
      : mine{state, placement, options.clearance},
        others{their_state, their_placement, options.other_clearance},
        moved_only(options.moved_only) {
    state.refresh(placement);
    their_state.refresh(their_placement);
  }

  /// True if the query asks for this pair of tree parts: p of the first model, q of the second.
  template <class PairTest>
  bool wanted(const PairTest& pair_test, std::size_t p, std::size_t q) const noexcept {
    const TreePart &a = mine.part(p), &b = others.part(q);
    return pair_test.admits_links(a.link, b.link) &&
           (!moved_only || mine.placement.moved(id<GroupId>(a.group)) || others.placement.moved(id<GroupId>(b.group)));
  }
  /// World box of tree part q of the other model, in this model's unit and origin.
  FloatBox their_box(std::size_t q) const noexcept {
    const auto ratio = static_cast<float>(mine.state.parts().scale / others.state.parts().scale);
    FloatBox box = others.state.world_box(q, others.placement, mine.state.world_origin());
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] *= ratio;
      box.upper[k] *= ratio;
    }
    return box;
  }

  TreeOperand<P> mine, others;
  bool moved_only;
};

}  // namespace hinge::detail
