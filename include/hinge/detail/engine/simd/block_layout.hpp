// SPDX-License-Identifier: BSD-3-Clause
// BlockLayout: divides the primitives of engine/simd into blocks of sixteen, and the blocks into entries of the sweep.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/engine/simd/cut_blocks.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// At most sixteen primitives. Rigid: all belong to one large group. Mixed: they belong to several small groups that
/// are neighbours in the chain.
struct Block {
  std::uint32_t first_group = 0,
                group_count = 0;  ///< its groups, in BlockLayout::groups
  simd::Bits real = 0;            ///< lanes that hold a primitive
  bool rigid = false;
};

/// The object that the sweep holds one box for: one block, or all blocks of a rigid group large enough for a tree.
struct SweepEntry {
  std::uint32_t first_block = 0, block_count = 1;
  /// Only entries before this one can be partners: entries of the same rigid group are excluded.
  std::uint32_t sweep_end = 0;
  std::uint32_t last_group = 0;  ///< forward kinematics must be complete up to this group
  std::uint32_t least_from = 0;  ///< the first of the groups of this entry and of all later ones
};

/// Computed once when the DOF are selected. Entries are ordered by the last group they need, static entries first.
/// Blocks have the order of their entries.
struct BlockLayout {
  /// A rigid group with more blocks than this is searched through a tree; other groups are searched block by block.
  static constexpr std::size_t largest_flat_group = simd::width * simd::width;

  /// Blocks by rigid group, for configurations and poses. left_out: per primitive, nonzero to leave it out of the
  /// layout; empty: the layout holds all.
  template <Primitive P>
  static BlockLayout by_groups(const SelectedModel<P>& model, std::span<const std::uint8_t> left_out = {});
  /// Blocks by index, for coordinates given from outside: no group is known to be rigid.
  template <Primitive P>
  static BlockLayout by_index(const SelectedModel<P>& model, std::span<const std::uint8_t> left_out = {});

  std::size_t block_count() const noexcept { return blocks.size(); }
  /// The sixteen primitives of a block.
  std::span<const std::uint32_t> members(std::size_t block) const noexcept {
    return std::span(primitive).subspan(block * simd::width, simd::width);
  }
  std::span<const GroupId> groups_of(const Block& block) const noexcept {
    return std::span(groups).subspan(block.first_group, block.group_count);
  }

  /// The entry that holds primitive i. Requires that the layout holds i.
  std::size_t entry_of(PrimitiveId i) const noexcept {
    const auto after = std::upper_bound(entries.begin(), entries.end(), block_of[index(i)],
                                        [](std::uint32_t b, const SweepEntry& entry) { return b < entry.first_block; });
    return static_cast<std::size_t>(after - entries.begin()) - 1;
  }

  /// One past the last entry of the rigid group whose first entry is u. For a mixed entry, u + 1.
  std::size_t group_end(std::size_t u) const noexcept {
    std::size_t end = u + 1;
    while (blocks[entries[u].first_block].rigid && end < entries.size() && blocks[entries[end].first_block].rigid &&
           entries[end].sweep_end == u)
      ++end;
    return end;
  }

  std::vector<std::uint32_t> primitive;  ///< per slot, sixteen per block; padding repeats the block's first primitive
  std::vector<Block> blocks;
  std::vector<SweepEntry> entries;
  std::vector<GroupId> groups;          ///< groups of all blocks; sorted and unique per block
  std::vector<std::uint32_t> block_of;  ///< per primitive; a number above all blocks if it was left out
  std::size_t static_entries = 0;       ///< number of leading entries that hold only primitives of group 0
  Vec3 origin = Vec3::Zero();           ///< middle of the model at the reference, world frame
  double scale = 1.0;                   ///< power of two that brings the model to a size where float squares are safe

 private:
  struct Piece {
    std::vector<std::vector<std::uint32_t>> blocks;
    std::uint32_t last_group = 0;
    bool rigid = false;
  };
  template <Primitive P>
  void assemble(const SelectedModel<P>& model, std::vector<Piece> pieces);
  void measure(const Aabb& all);
};

template <Primitive P>
BlockLayout BlockLayout::by_groups(const SelectedModel<P>& model, std::span<const std::uint8_t> left_out) {
  BlockLayout layout;
  const Members members(model, left_out);
  const std::vector<Vec3> middles = middles_at_reference(model);
  layout.measure(members.around(middles));
  const std::vector<GroupId> order = chain_order(*model.groups());
  const auto is_large = [&](GroupId g) { return members.of(g).size() >= simd::width; };
  std::vector<Piece> pieces;
  // Small groups are joined in chain order while they are close. Across a large group they are joined only if the block
  // stays about as compact as an average set of sixteen primitives.
  ChainFiller filler(middles, members, *model.groups(), is_large);
  for (const GroupId g : order) {
    const auto primitives = members.of(g);
    if (is_large(g)) {
      Piece piece;
      piece.rigid = true;
      piece.last_group = static_cast<std::uint32_t>(index(g));
      piece.blocks = cut_spatially(primitives, middles);
      pieces.push_back(std::move(piece));
    } else {
      filler.add(g, primitives);
    }
  }
  for (std::vector<std::uint32_t>& block : filler.take()) {
    Piece piece;
    for (const std::uint32_t i : block)
      piece.last_group =
          std::max(piece.last_group, static_cast<std::uint32_t>(index(model.group_of(id<PrimitiveId>(i)))));
    piece.blocks.push_back(std::move(block));
    pieces.push_back(std::move(piece));
  }
  layout.assemble(model, std::move(pieces));
  return layout;
}

template <Primitive P>
BlockLayout BlockLayout::by_index(const SelectedModel<P>& model, std::span<const std::uint8_t> left_out) {
  BlockLayout layout;
  layout.measure(Members(model, left_out).around(middles_at_reference(model)));
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < model.size(); ++i) {
    if (!left_out.empty() && left_out[i] != 0) continue;
    if (pieces.empty() || pieces.back().blocks.front().size() == simd::width) pieces.push_back({{{}}, 0, false});
    pieces.back().blocks.front().push_back(static_cast<std::uint32_t>(i));
  }
  layout.assemble(model, std::move(pieces));
  layout.static_entries = 0;
  return layout;
}

template <Primitive P>
void BlockLayout::assemble(const SelectedModel<P>& model, std::vector<Piece> pieces) {
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.last_group < b.last_group; });
  block_of.assign(model.size(), std::numeric_limits<std::uint32_t>::max());
  for (const Piece& piece : pieces) {
    const auto first_entry = static_cast<std::uint32_t>(entries.size());
    const bool tree = piece.blocks.size() > largest_flat_group;
    for (const std::vector<std::uint32_t>& members : piece.blocks) {
      const auto b = static_cast<std::uint32_t>(blocks.size());
      if (!tree || members.data() == piece.blocks.front().data())
        entries.push_back({b, tree ? static_cast<std::uint32_t>(piece.blocks.size()) : 1U,
                           piece.rigid ? first_entry : static_cast<std::uint32_t>(entries.size()), piece.last_group,
                           0});
      Block block;
      block.rigid = piece.rigid;
      block.real = (simd::Bits{1} << members.size()) - 1;
      std::vector<GroupId> own;
      for (const std::uint32_t i : members) {
        block_of[i] = b;
        primitive.push_back(i);
        own.push_back(model.group_of(id<PrimitiveId>(i)));
      }
      for (std::size_t k = members.size(); k < simd::width; ++k) primitive.push_back(members.front());
      std::sort(own.begin(), own.end());
      own.erase(std::unique(own.begin(), own.end()), own.end());
      block.first_group = static_cast<std::uint32_t>(groups.size());
      block.group_count = static_cast<std::uint32_t>(own.size());
      groups.insert(groups.end(), own.begin(), own.end());
      blocks.push_back(block);
    }
    if (piece.last_group == 0) static_entries = entries.size();
  }
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t u = entries.size(); u-- > 0;) {
    least = std::min(least, static_cast<std::uint32_t>(index(groups_of(blocks[entries[u].first_block]).front())));
    entries[u].least_from = least;
  }
}

inline void BlockLayout::measure(const Aabb& all) {
  if (all.is_empty()) return;
  double size = 0.0;
  for (int k = 0; k < 3; ++k) {
    origin[k] = all.middle(k);
    size = std::max(size, all.length(k));
  }
  // Scale to a size of about 64: squares then have room at both ends of the float range. A model without extent keeps
  // its scale.
  int exponent = 0;
  if (size > 0.0) std::frexp(size, &exponent);
  scale = size > 0.0 ? std::ldexp(1.0, std::min(6 - exponent, 1000)) : 1.0;
}

}  // namespace hinge::detail
