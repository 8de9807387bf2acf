// SPDX-License-Identifier: BSD-3-Clause
// FallbackBvh: the double-precision BVH of engine/simd, used when the float filter stops pruning.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/core/function_ref.hpp"
#include "hinge/detail/engine/lazy_tree.hpp"
#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/engine/traversal.hpp"
#include "hinge/detail/query/pair_threshold.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/model/state.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Two levels as in BioCD, over single primitives: a tree over the primitives of each rigid group, split on demand, and
/// a tree over the groups. Each search makes new boxes.
class FallbackBvh {
 public:
  /// Largest d - M of interest. It may shrink during the search.
  using Cutoff = FunctionRef<double()>;
  /// Returns false to stop.
  using Visit = FunctionRef<bool(PrimitiveId, PrimitiveId)>;

  /// Makes boxes of the present coordinates of all primitives in the layout. clearance: extra clearance per rigid
  /// group.
  template <Primitive P, DistanceMatrix D>
  [[gnu::noinline]] void place(const BlockLayout& layout, State<P>& state, const D& matrix,
                               std::span<const double> clearance);

  /// Visits every pair of primitives of different groups with a possible d - M <= cutoff. If groups deform, visits
  /// pairs within groups too.
  void within(Cutoff cutoff, Visit visit, QueryCounts& counts) {
    if (deform_ && !bodies_.empty())
      bodies(*this, 0, 0, cutoff, visit, counts);
    else
      across(*this, cutoff, visit, counts);
  }
  /// The same for pairs of a primitive here and a primitive of `other`.
  void across(FallbackBvh& other, Cutoff cutoff, Visit visit, QueryCounts& counts);

 private:
  /// One low-level tree: the primitives of a rigid group, or all primitives if groups deform.
  struct Body {
    std::uint32_t first, count;  // in primitives_
    double extra;                // largest extra clearance in it
  };

  PrimitiveId primitive(std::uint32_t body, std::uint32_t item) const noexcept {
    return primitives_[bodies_[body].first + item];
  }
  bool bodies(FallbackBvh& other, std::uint32_t a, std::uint32_t b, Cutoff cutoff, Visit visit, QueryCounts& counts);

  std::vector<PrimitiveId> primitives_;  // by body
  std::vector<Body> bodies_;
  std::vector<LazyTree> trees_;  // per body
  LazyTree upper_;
  bool deform_ = false;
  std::vector<Aabb> boxes_;  // scratch
  NodePairs stack_;          // scratch
};

template <Primitive P, DistanceMatrix D>
void FallbackBvh::place(const BlockLayout& layout, State<P>& state, const D& matrix,
                        std::span<const double> clearance) {
  const SelectedModel<P>& model = state.model();
  deform_ = state.groups_may_deform();
  const std::size_t groups = model.groups()->size();
  for (std::size_t g = 0; g < groups; ++g) state.place(id<GroupId>(g));
  const auto body_of = [&](PrimitiveId i) { return deform_ ? 0 : index(model.group_of(i)); };
  primitives_.clear();
  for (std::size_t slot = 0; slot < layout.primitive.size(); ++slot)
    if ((layout.blocks[slot / simd::width].real >> slot % simd::width & 1U) != 0)
      primitives_.push_back(id<PrimitiveId>(layout.primitive[slot]));
  std::sort(primitives_.begin(), primitives_.end(),
            [&](PrimitiveId i, PrimitiveId j) { return std::pair(body_of(i), i) < std::pair(body_of(j), j); });
  bodies_.clear();
  std::vector<Aabb> roots;
  for (std::uint32_t first = 0; first < primitives_.size();) {
    Body body{first, 0, 0.0};
    boxes_.clear();
    for (; first < primitives_.size() && body_of(primitives_[first]) == body_of(primitives_[body.first]); ++first) {
      const PrimitiveId i = primitives_[first];
      boxes_.push_back(state.placed()[index(i)].bounds().inflated(matrix.reach(i)));
      body.extra = std::max(body.extra, clearance_of(clearance, model.group_of(i)));
    }
    body.count = first - body.first;
    if (trees_.size() == bodies_.size()) trees_.emplace_back();
    LazyTree& tree = trees_[bodies_.size()];
    tree.reset(boxes_);
    const Aabb& root = tree.node(0).box;
    roots.push_back(body.extra > 0.0 ? root.inflated(body.extra) : root);
    bodies_.push_back(body);
  }
  if (!roots.empty()) upper_.reset(roots);
}

inline bool FallbackBvh::bodies(FallbackBvh& other, std::uint32_t a, std::uint32_t b, Cutoff cutoff, Visit visit,
                                QueryCounts& counts) {
  const double extra = bodies_[a].extra + other.bodies_[b].extra;
  return traverse(
      trees_[a], other.trees_[b], stack_, counts, [&] { return cutoff() + extra; },
      [&](std::uint32_t m, std::uint32_t n) {
        ++counts.pairs_tested;
        return visit(primitive(a, m), other.primitive(b, n));
      });
}

inline void FallbackBvh::across(FallbackBvh& other, Cutoff cutoff, Visit visit, QueryCounts& counts) {
  if (bodies_.empty() || other.bodies_.empty()) return;
  traverse(upper_, other.upper_, stack_, counts, cutoff,
           [&](std::uint32_t a, std::uint32_t b) { return bodies(other, a, b, cutoff, visit, counts); });
}

}  // namespace hinge::detail
