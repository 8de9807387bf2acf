// SPDX-License-Identifier: BSD-3-Clause
// A query of your own: the three closest pairs, each with its distance minus its threshold.
#include <algorithm>
#include <hinge/hinge.hpp>
#include <limits>
#include <vector>

class ThreeClosest {
 public:
  // true: engines pass every pair with d - M <= cutoff(). false: only pairs with d < M + cutoff().
  static constexpr bool ranks = true;

  void add(const hinge::Hit& hit) {
    hits_.push_back(hit);
    std::sort(hits_.begin(), hits_.end(), [](const auto& a, const auto& b) { return a.gap() < b.gap(); });
    if (hits_.size() > 3) hits_.pop_back();
  }
  // The largest d - M that still matters. It may only shrink.
  double cutoff() const noexcept {
    return hits_.size() < 3 ? std::numeric_limits<double>::infinity() : hits_.back().gap();
  }
  // true: the query ends.
  bool done() const noexcept { return false; }

  const std::vector<hinge::Hit>& hits() const noexcept { return hits_; }

 private:
  std::vector<hinge::Hit> hits_;
};
static_assert(hinge::Collector<ThreeClosest>);

int main() {
  hinge::ModelBuilder<hinge::Point> build;
  hinge::LinkId parent = hinge::world;
  const hinge::Pose next{hinge::Mat3::Identity(), {1.5, 0, 0}};
  for (int k = 0; k < 12; ++k)
    parent = build.add_link(parent, hinge::Revolute{{0, 0, 1}, {0, 0, 0}, next, {}}, {{{0, 0, 0}}});
  hinge::Hierarchy chain(build.finish(), hinge::AdmitAll{}, hinge::UniformClearance{1.0});
  chain.update(std::vector<double>(12, 0.6));  // rad: the chain is rolled up

  ThreeClosest three;
  chain.self_query(three);
  const auto closest = chain.self_closest();
  return three.hits().size() == 3 && three.hits().front().gap() == closest->gap() ? 0 : 1;
}
