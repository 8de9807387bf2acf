// SPDX-License-Identifier: BSD-3-Clause
// A pair filter of your own: links that are close in the chain are not tested.
#include <cstdlib>
#include <hinge/hinge.hpp>
#include <vector>

class FartherThan {
 public:
  // Links i and j of a chain are tested if they are more than `steps` joints apart.
  FartherThan(const hinge::Model<hinge::Sphere>& chain, int steps)
      : link_(chain.links().begin(), chain.links().end()), steps_(steps) {}

  bool admits(hinge::PrimitiveId i, hinge::PrimitiveId j) const noexcept {
    return admits(link_[index(i)], link_[index(j)]);
  }
  // Optional: rejects all pairs of two links at once.
  bool admits(hinge::LinkId a, hinge::LinkId b) const noexcept {
    return std::abs(static_cast<int>(index(a)) - static_cast<int>(index(b))) > steps_;
  }
  // Optional: lets Hierarchy check that the filter was made for its model.
  std::size_t size() const noexcept { return link_.size(); }

 private:
  std::vector<hinge::LinkId> link_;
  int steps_;
};
static_assert(hinge::PairFilter<FartherThan> && hinge::AdmitsLinks<FartherThan>);

int main() {
  hinge::ModelBuilder<hinge::Sphere> build;
  hinge::LinkId parent = hinge::world;
  const hinge::Pose next{hinge::Mat3::Identity(), {0.1, 0, 0}};
  for (int k = 0; k < 20; ++k)
    parent = build.add_link(parent, hinge::Revolute{{0, 0, 1}, {0, 0, 0}, next, {}}, {{{0, 0, 0}, 0.06}});
  const auto model = build.finish();

  const FartherThan filter(model, 2);
  if (!hinge::laws::check_pair_filter(filter, model.size(), model.links()).empty()) return 1;
  hinge::Hierarchy chain(model, filter, hinge::UniformClearance{0.0});
  chain.update(std::vector<double>(20, 0.0));
  const bool straight = chain.self_collides();  // neighbours overlap, but they are not tested
  chain.update(std::vector<double>(20, 1.0));
  return !straight && chain.self_collides() ? 0 : 1;
}
