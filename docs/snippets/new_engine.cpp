// SPDX-License-Identifier: BSD-3-Clause
// An engine of your own: it sorts boxes along x and tests pairs that overlap there (sweep and prune).
#include <algorithm>
#include <hinge/hinge.hpp>
#include <vector>

template <class P, class F, class D>
struct SweepX {
  SweepX(const hinge::SelectedModel<P>& model, const F&, const D&) : boxes_(model.size()) {
    for (std::size_t i = 0; i < model.size(); ++i) order_.push_back(hinge::id<hinge::PrimitiveId>(i));
  }

  // The rules hold the state, the filter, the matrix and the options of one query.
  template <hinge::Collector C>
  void self_query(const hinge::SelfRules<P, F, D>& rules, C& collector) {
    const std::span<const P> placed = rules.state.place_all();
    for (std::size_t i = 0; i < placed.size(); ++i) boxes_[i] = box(rules, hinge::id<hinge::PrimitiveId>(i), placed[i]);
    const auto x = [&](hinge::PrimitiveId i) { return boxes_[index(i)].lower[0]; };
    std::sort(order_.begin(), order_.end(), [&](auto a, auto b) { return x(a) < x(b); });
    for (std::size_t k = 0; k < order_.size(); ++k)
      for (std::size_t l = k + 1; l < order_.size(); ++l) {
        // Two boxes that are more than the cutoff apart hold no pair of interest. The cutoff may shrink.
        if (x(order_[l]) - boxes_[index(order_[k])].upper[0] > collector.cutoff()) break;
        const auto [i, j] = std::minmax(order_[k], order_[l]);
        rules.test(collector, i, j, placed[index(i)], placed[index(j)]);
        if (collector.done()) return;
      }
  }

 private:
  // reach(i) + reach(j) >= threshold(i, j), so boxes inflated by it meet if the pair is closer than its threshold.
  static hinge::Aabb box(const hinge::SelfRules<P, F, D>& rules, hinge::PrimitiveId i, const P& p) {
    return p.bounds().inflated(rules.matrix.reach(i) + rules.clearance(i));
  }

  std::vector<hinge::PrimitiveId> order_;  // sorted by the previous query
  std::vector<hinge::Aabb> boxes_;
};

int main() {
  hinge::ModelBuilder<hinge::Sphere> build;  // a chain of thirty balls
  hinge::LinkId parent = hinge::world;
  const hinge::Pose next{hinge::Mat3::Identity(), {0.1, 0, 0}};
  for (int k = 0; k < 30; ++k)
    parent = build.add_link(parent, hinge::Revolute{{0, 0, 1}, {0, 0, 0}, next, {}}, {{{0, 0, 0}, 0.04}});
  using All = hinge::AdmitAll;
  using Clearance = hinge::UniformClearance;
  hinge::Hierarchy<hinge::Sphere, All, Clearance, SweepX> mine(build.finish(), {}, Clearance{0.01});
  hinge::Hierarchy<hinge::Sphere, All, Clearance, hinge::Brute> brute(mine.model().model(), {}, Clearance{0.01});
  std::size_t found = 0;
  for (int step = 0; step < 60; ++step) {  // the chain rolls up
    mine.update(std::vector<double>(30, 0.01 * step));
    brute.update(std::vector<double>(30, 0.01 * step));
    const std::vector<hinge::Hit> hits = mine.self_within(0.02);
    if (hits.size() != brute.self_within(0.02).size() || mine.self_closest()->gap() != brute.self_closest()->gap())
      return 1;
    found += hits.size();
  }
  return found > 0 ? 0 : 1;
}
