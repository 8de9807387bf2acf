// SPDX-License-Identifier: BSD-3-Clause
// LinkPairHits: the colliding pairs of links, each with one colliding pair of primitives.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge {

/// Keeps one Hit per pair of links with d - M < margin. The hit is an arbitrary one of that pair of links. Reusable
/// after clear() without new allocations.
class LinkPairHits {
 public:
  static constexpr bool ranks = false;  ///< add() receives hits only
  /// links: Model::links() of the queried model; must outlive this object. margin: >= 0, model length unit.
  explicit LinkPairHits(std::span<const LinkId> links, double margin = 0.0) : LinkPairHits(links, links, margin) {
    between_ = false;
  }
  /// For queries between two models. other_links: Model::links() of the other model; must outlive this object.
  LinkPairHits(std::span<const LinkId> links, std::span<const LinkId> other_links, double margin = 0.0)
      : links_(links), other_links_(other_links), columns_(count(other_links)), margin_(margin) {
    seen_.resize(count(links) * columns_, 0);
  }

  /// Removes all hits and keeps the memory.
  void clear() noexcept {
    for (const Hit& hit : hits_) mark(hit, 0);
    hits_.clear();
  }

  /// Returns false when the pair of links already has a hit.
  bool wants(LinkId a, LinkId b) const noexcept { return seen_[place(a, b)] == 0; }

  /// Stores the hit when it is the first of its pair of links.
  void add(const Hit& hit) {
    if (!wants(links_[index(hit.first)], other_links_[index(hit.second)])) return;
    mark(hit, 1);
    hits_.push_back(hit);
  }
  /// Returns the margin.
  double cutoff() const noexcept { return margin_; }
  /// Returns false: all pairs of links are needed.
  bool done() const noexcept { return false; }

  /// Returns the hits sorted by pair of links. The span is valid until the next add() or clear().
  std::span<const Hit> hits() noexcept {
    std::sort(hits_.begin(), hits_.end(), [&](const Hit& x, const Hit& y) { return key(x) < key(y); });
    return hits_;
  }

 private:
  static std::size_t count(std::span<const LinkId> links) noexcept {
    std::size_t n = 0;
    for (const LinkId link : links) n = std::max(n, index(link) + 1);
    return n;
  }
  std::size_t place(LinkId a, LinkId b) const noexcept {
    // Pairs within one model are unordered.
    if (!between_ && b < a) std::swap(a, b);
    return index(a) * columns_ + index(b);
  }
  void mark(const Hit& hit, std::uint8_t value) noexcept {
    seen_[place(links_[index(hit.first)], other_links_[index(hit.second)])] = value;
  }
  std::tuple<std::size_t, PrimitiveId, PrimitiveId> key(const Hit& hit) const noexcept {
    return {place(links_[index(hit.first)], other_links_[index(hit.second)]), hit.first, hit.second};
  }

  std::span<const LinkId> links_, other_links_;
  std::size_t columns_ = 0;
  double margin_ = 0.0;
  bool between_ = true;
  std::vector<std::uint8_t> seen_;  // per pair of links: 1 if it has a hit
  std::vector<Hit> hits_;
};

static_assert(RefusesLinks<LinkPairHits>);

}  // namespace hinge
