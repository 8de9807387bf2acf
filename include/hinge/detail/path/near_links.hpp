// SPDX-License-Identifier: BSD-3-Clause
// NearLinks: collects near pairs of two links, so that links with many primitives can be proved apart as a whole.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/path/path_segments.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::detail {

/// A collector of the pairs of two links with d - M < margin. It stops after `most` + 1 pairs.
class NearLinks {
 public:
  static constexpr bool ranks = false;
  /// links: per primitive. `found` is cleared.
  NearLinks(std::span<const LinkId> links, const PathPair& pair, double margin, std::size_t most,
            std::vector<PathPair>& found) noexcept
      : links_(links),
        first_(links[index(pair.first)]),
        second_(links[index(pair.second)]),
        margin_(margin),
        most_(most),
        found_(found) {
    found_.clear();
  }
  bool wants(LinkId a, LinkId b) const noexcept {
    return (a == first_ && b == second_) || (a == second_ && b == first_);
  }
  void add(const Hit& hit) {
    if (wants(links_[index(hit.first)], links_[index(hit.second)])) found_.push_back({hit.first, hit.second});
  }
  double cutoff() const noexcept { return margin_; }
  bool done() const noexcept { return found_.size() > most_; }

 private:
  std::span<const LinkId> links_;
  LinkId first_, second_;
  double margin_;
  std::size_t most_;
  std::vector<PathPair>& found_;
};

static_assert(Collector<NearLinks> && RefusesLinks<NearLinks>);

}  // namespace hinge::detail
