// SPDX-License-Identifier: BSD-3-Clause
// LinkPairHits: which pairs of links collide, each with one pair of primitives that shows it.
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

/// One Hit per pair of links with d - M < margin; which of the pair's hits it is may be any of them. Can be asked again
/// after clear(), without allocating.
class LinkPairHits {
 public:
  static constexpr bool ranks = false;
  /// links: Model::links() of the model asked; of both models in queries between two. They must outlive this.
  explicit LinkPairHits(std::span<const LinkId> links, double margin = 0.0) : LinkPairHits(links, links, margin) {
    between_ = false;
  }
  LinkPairHits(std::span<const LinkId> links, std::span<const LinkId> other_links, double margin = 0.0)
      : links_(links), other_links_(other_links), columns_(count(other_links)), margin_(margin) {
    seen_.resize(count(links) * columns_, 0);
  }

  void clear() noexcept {
    for (const Hit& hit : hits_) mark(hit, 0);
    hits_.clear();
  }

  /// Pairs of these two links need no more be offered.
  bool wants(LinkId a, LinkId b) const noexcept { return seen_[place(a, b)] == 0; }

  void add(const Hit& hit) {
    if (!wants(links_[index(hit.first)], other_links_[index(hit.second)])) return;
    mark(hit, 1);
    hits_.push_back(hit);
  }
  double cutoff() const noexcept { return margin_; }
  bool done() const noexcept { return false; }

  /// Sorted by the links of (first, second).
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
    // Within one model a pair has no order.
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
  std::vector<std::uint8_t> seen_;  // by pair of links
  std::vector<Hit> hits_;
};

static_assert(RefusesLinks<LinkPairHits>);

}  // namespace hinge
