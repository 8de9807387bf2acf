// SPDX-License-Identifier: BSD-3-Clause
// CrossOperands: both models of a cross query, refreshed, and the boxes of the other model in this model's unit.
#pragma once

#include <cstddef>

#include "hinge/core/id.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/tree/placed_trees.hpp"
#include "hinge/detail/engine/simd/tree/tree_operand.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/model/state.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Refreshes both states on construction. `mine` is the first model, `others` the second.
template <Primitive P>
struct CrossOperands {
  CrossOperands(PlacedTrees<P>& trees, State<P>& state, PlacedTrees<P>& their_trees, State<P>& their_state,
                const QueryOptions& options)
      : mine{trees, state, options.clearance},
        others{their_trees, their_state, options.other_clearance},
        moved_only(options.moved_only) {
    trees.refresh(state);
    their_trees.refresh(their_state);
  }

  /// True if the query asks for this pair of tree parts: p of the first model, q of the second.
  template <class PairTest>
  bool wanted(const PairTest& pair_test, std::size_t p, std::size_t q) const noexcept {
    const TreePart &a = mine.part(p), &b = others.part(q);
    return pair_test.admits_links(a.link, b.link) &&
           (!moved_only || mine.state.moved(id<GroupId>(a.group)) || others.state.moved(id<GroupId>(b.group)));
  }
  /// World box of tree part q of the other model, in this model's unit and origin.
  FloatBox their_box(std::size_t q) const noexcept {
    const auto ratio = static_cast<float>(mine.trees.parts().scale / others.trees.parts().scale);
    FloatBox box = others.trees.world_box(q, others.state, mine.trees.world_origin());
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
