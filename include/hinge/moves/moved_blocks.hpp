// SPDX-License-Identifier: BSD-3-Clause
// MovedBlocks: which blocks of sixteen a move takes along, those of each part together, those cut by a joint apart.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/engine/wide/block_layout.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/moves/moving_parts.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/simd/lanes.hpp"

namespace hinge {

class MovedBlocks {
 public:
  template <Primitive P>
  MovedBlocks(const BlockLayout& layout, const SelectedModel<P>& model, const MovingParts& parts)
      : first_(layout.block_count()), last_(layout.block_count()), seen_(layout.block_count(), 0) {
    for (const std::uint32_t i : layout.primitive)
      lane_place_.push_back(parts.place(model.group_of(id<PrimitiveId>(i))));
    for (std::uint32_t b = 0; b < layout.block_count(); ++b) {
      const auto lanes = std::span(lane_place_).subspan(b * simd::width, simd::width);
      first_[b] = *std::min_element(lanes.begin(), lanes.end());
      last_[b] = *std::max_element(lanes.begin(), lanes.end());
      order_.push_back(b);
    }
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return first_[a] != first_[b] ? first_[a] < first_[b] : a < b; });
    // Blocks nearly follow each other along the tree: those before the first that reaches a place are not looked at.
    reaching_.assign(parts.size(), 0);
    std::uint32_t k = 0;
    for (std::uint32_t p = 0; p < parts.size(); ++p) {
      while (k < order_.size() && last_[order_[k]] < p) ++k;
      reaching_[p] = k;
    }
  }

  /// Finds what the parts of a cut take along.
  void find(const MovingParts& parts);

  std::size_t count() const noexcept { return whole_.size() + cut_.size(); }
  std::uint32_t part_count() const noexcept { return static_cast<std::uint32_t>(start_.size()) - 1; }
  /// Blocks that lie in one part.
  std::span<const std::uint32_t> of_part(std::uint32_t part) const noexcept {
    return std::span(whole_).subspan(start_[part], start_[part + 1] - start_[part]);
  }
  std::span<const std::uint32_t> whole() const noexcept { return whole_; }
  /// Blocks that lie in several, and the parts of their lanes.
  std::span<const std::uint32_t> cut() const noexcept { return cut_; }
  std::span<const std::uint32_t> lane_parts(std::size_t k) const noexcept {
    return std::span(lane_part_).subspan(k * simd::width, simd::width);
  }

 private:
  struct Found {
    std::uint32_t block, part;
  };

  std::vector<std::uint32_t> lane_place_;    // per slot
  std::vector<std::uint32_t> first_, last_;  // per block: its places
  std::vector<std::uint32_t> order_;         // blocks by their first place
  std::vector<std::uint32_t> reaching_;      // per place: the first in order_ whose last place is not before it
  std::vector<std::uint64_t> seen_;          // per block: the last call of find() that met it
  std::uint64_t call_ = 0;
  std::vector<Found> found_;
  std::vector<std::uint32_t> whole_, cut_, lane_part_;
  std::vector<std::uint32_t> start_{0, 0};  // per part, in whole_
};

inline void MovedBlocks::find(const MovingParts& parts) {
  ++call_;
  found_.clear();
  cut_.clear();
  lane_part_.clear();
  start_.assign(parts.parts().size() + 1, 0);
  const std::span<const MovingParts::Stretch> stretches = parts.stretches();
  for (std::size_t t = 0; t < stretches.size(); ++t) {
    const MovingParts::Stretch& s = stretches[t];
    for (std::size_t k = reaching_[s.begin]; k < order_.size() && first_[order_[k]] < s.end; ++k) {
      const std::uint32_t b = order_[k];
      if (last_[b] < s.begin || seen_[b] == call_) continue;
      seen_[b] = call_;
      std::uint32_t part = s.part;
      if (first_[b] < s.begin || last_[b] >= s.end) {
        // Places of lanes mostly ascend, and none is in an earlier stretch, which would have met the block.
        const std::size_t at = lane_part_.size();
        std::size_t in = t;
        bool same = true;
        std::uint32_t before = 0;
        for (std::size_t lane = 0; lane < simd::width; ++lane) {
          const std::uint32_t place = lane_place_[b * simd::width + lane];
          if (place < before) in = t;
          before = place;
          while (in + 1 < stretches.size() && stretches[in].end <= place) ++in;
          const bool inside = stretches[in].begin <= place && place < stretches[in].end;
          lane_part_.push_back(inside ? stretches[in].part : 0);
          same = same && lane_part_.back() == lane_part_[at];
        }
        part = lane_part_[at];
        if (!same) {
          cut_.push_back(b);
          continue;
        }
        lane_part_.resize(at);
        if (part == 0) continue;
      }
      found_.push_back({b, part});
      ++start_[part + 1];
    }
  }
  for (std::size_t part = 1; part < start_.size(); ++part) start_[part] += start_[part - 1];
  whole_.resize(found_.size());
  for (const Found& f : found_) whole_[start_[f.part]++] = f.block;
  for (std::size_t part = start_.size() - 1; part > 0; --part) start_[part] = start_[part - 1];
  start_[0] = 0;
}

}  // namespace hinge
