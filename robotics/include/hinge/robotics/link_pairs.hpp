// SPDX-License-Identifier: BSD-3-Clause
// LinkPairs: a symmetric set of pairs of links, stored as bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"

namespace hinge::robotics {

/// A set of unordered pairs of the links 0 .. link_count - 1. A pair of a link with itself is ignored. Copies are
/// independent.
class HINGE_API LinkPairs {
 public:
  /// Makes an empty set.
  explicit LinkPairs(std::size_t link_count = 0)
      : link_count_(link_count), words_(link_count / 64 + 1), bits_(link_count * words_, 0) {}

  /// Adds a pair. Throws ModelError if a link is not below link_count().
  void insert(LinkId a, LinkId b) { set(a, b, true); }
  /// Removes a pair. Throws ModelError if a link is not below link_count().
  void erase(LinkId a, LinkId b) { set(a, b, false); }

  /// Returns true if the set has the pair. Both links must be below link_count().
  bool contains(LinkId a, LinkId b) const noexcept {
    return (bits_[index(a) * words_ + index(b) / 64] >> (index(b) % 64) & 1U) != 0;
  }
  /// Returns the number of links, the world included.
  std::size_t link_count() const noexcept { return link_count_; }
  /// Returns the number of unordered pairs.
  std::size_t size() const noexcept { return size_; }
  /// Returns every pair once, with first < second, sorted.
  std::vector<std::pair<LinkId, LinkId>> list() const {
    std::vector<std::pair<LinkId, LinkId>> pairs;
    for (std::size_t a = 0; a < link_count_; ++a)
      for (std::size_t b = a + 1; b < link_count_; ++b)
        if (contains(id<LinkId>(a), id<LinkId>(b))) pairs.emplace_back(id<LinkId>(a), id<LinkId>(b));
    return pairs;
  }

 private:
  void set(LinkId a, LinkId b, bool value) {
    for (const LinkId link : {a, b})
      if (index(link) >= link_count_)
        throw ModelError("link " + std::to_string(index(link)) + " in a pair of links, expected below " +
                         std::to_string(link_count_));
    if (a == b || contains(a, b) == value) return;
    bits_[index(a) * words_ + index(b) / 64] ^= std::uint64_t{1} << index(b) % 64;
    bits_[index(b) * words_ + index(a) / 64] ^= std::uint64_t{1} << index(a) % 64;
    size_ = value ? size_ + 1 : size_ - 1;
  }

  std::size_t link_count_;
  std::size_t words_;  // number of words per row
  std::vector<std::uint64_t> bits_;
  std::size_t size_ = 0;
};

}  // namespace hinge::robotics
