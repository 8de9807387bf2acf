// SPDX-License-Identifier: BSD-3-Clause
// SearchingPeer: the queries for peers that answer each of them with one search within a margin.
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "pair_rules.hpp"
#include "peer.hpp"

namespace hinge::bench {

/// Requirements on Search: a constructor from PeerInput; update(xyz); search(margin, answer), which passes every
/// admitted pair with d - M < margin to the answer until it needs no more; everything(), a margin that no gap
/// exceeds.
template <class Search>
class SearchingPeer {
 public:
  explicit SearchingPeer(std::shared_ptr<const PeerInput> input) : search_(std::move(input)) {}

  void update(std::span<const double> xyz) { search_.update(xyz); }
  bool any() {
    AnyPair answer;
    search_.search(0.0, answer);
    return answer.found;
  }
  std::size_t count() {
    PairCount answer;
    search_.search(0.0, answer);
    return answer.count;
  }
  void within(double margin, PairList& out) {
    out.clear();
    PairsWithin answer{out, margin};
    search_.search(margin, answer);
    detail::sort_hits(out);
  }
  double closest() {
    return last_ = grow_until_found(last_, search_.everything(), [&](double margin) {
             ClosestPair answer{margin};
             search_.search(margin, answer);
             return answer;
           });
  }

 private:
  Search search_;
  double last_ = 0.0;
};

}  // namespace hinge::bench
