// SPDX-License-Identifier: BSD-3-Clause
// Runs meshes on the links of a chain with revolute joints. Parent and child are not tested.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "robustness/run_mesh.hpp"

namespace hinge::robustness {

/// Finds the smallest distance of every tested pair of links.
class LinkDistances {
 public:
  static constexpr bool ranks = true;

  /// links[k]: link of primitive k, with 0 the world. tested: pairs of links of the case, which count from 0.
  LinkDistances(std::span<const LinkId> links, std::size_t count, std::vector<LinkPairAnswer> tested)
      : links_(links), pairs_(std::move(tested)), place_(count * count, 0), count_(count) {
    for (std::size_t k = 0; k < pairs_.size(); ++k) place_[pairs_[k].i * count + pairs_[k].j] = k;
  }
  void add(const Hit& hit) noexcept {
    const std::size_t a = index(links_[index(hit.first)]) - 1, b = index(links_[index(hit.second)]) - 1;
    LinkPairAnswer& pair = pairs_[place_[std::min(a, b) * count_ + std::max(a, b)]];
    if (hit.distance >= pair.distance) return;
    pair.distance = hit.distance;
    largest_ = 0.0;
    for (const LinkPairAnswer& other : pairs_) largest_ = std::max(largest_, other.distance);
  }
  double cutoff() const noexcept { return largest_; }
  bool done() const noexcept { return false; }
  std::vector<LinkPairAnswer> take() { return std::move(pairs_); }

 private:
  std::span<const LinkId> links_;
  std::vector<LinkPairAnswer> pairs_;
  std::vector<std::size_t> place_;
  std::size_t count_ = 0;
  double largest_ = std::numeric_limits<double>::infinity();
};

/// Adds the links of a case in order: link k of the case is link k + 1 of the model. Throws ModelError if the tree
/// rejects a link or a parent is not an earlier link.
inline void add_links(ModelBuilder<Triangle>& builder, const Chain& chain) {
  for (std::size_t k = 0; k < chain.links.size(); ++k) {
    const ChainLink& link = chain.links[k];
    const std::string who = "link " + std::to_string(k);
    if (link.parent < -1) throw ModelError(who + ": parent " + std::to_string(link.parent) + " does not exist");
    Revolute joint;
    joint.axis = vector_of(link.axis, who + ", axis");
    joint.origin.translation = vector_of(link.origin, who + ", origin");
    builder.add_link(id<LinkId>(static_cast<std::size_t>(link.parent + 1)), joint, triangles_in(link.mesh));
  }
}

/// Returns a hierarchy of the chain at its angles.
template <template <class, class, class> class EngineOf>
Triangles<EngineOf> hierarchy_of(const Chain& chain) {
  ModelBuilder<Triangle> builder;
  add_links(builder, chain);
  std::vector<std::pair<LinkId, LinkId>> ignored;
  for (std::size_t k = 1; k < builder.tree().link_count(); ++k)
    ignored.emplace_back(builder.tree().parent(id<LinkId>(k)), id<LinkId>(k));
  auto links = triangles_of<EngineOf>(builder, std::move(ignored));
  std::vector<double> q;
  for (const ChainLink& link : chain.links) q.push_back(link.angle);
  links.update(q);
  return links;
}

template <template <class, class, class> class EngineOf>
Answer run_chain(const Chain& chain) {
  return asked("angles", [&] {
    auto links = hierarchy_of<EngineOf>(chain);
    Answer answer = self_answer(links);
    const Model<Triangle>& model = links.model().model();
    const std::size_t count = chain.links.size();
    std::vector<LinkPairAnswer> tested;
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t i = 0; i < j; ++i)
        if (chain.links[j].parent != static_cast<std::int64_t>(i)) tested.push_back({i, j});
    LinkDistances distances(model.links(), count, std::move(tested));
    links.self_query(distances);
    answer.link_pairs = distances.take();
    const auto link_of = [&](PrimitiveId i) { return static_cast<std::uint32_t>(index(model.links()[index(i)]) - 1); };
    for (const Hit& hit : links.self_collisions())
      for (LinkPairAnswer& pair : answer.link_pairs)
        pair.hit |= pair.i == link_of(hit.first) && pair.j == link_of(hit.second);
    // From here on, pairs are pairs of links.
    answer.pairs.clear();
    answer.pair_count = 0;
    for (const LinkPairAnswer& pair : answer.link_pairs) {
      if (pair.hit != (pair.distance == 0.0)) contradict(answer, "distance 0 and yes/no of a pair of links differ");
      if (!pair.hit) continue;
      ++answer.pair_count;
      answer.pairs.push_back(static_cast<std::uint32_t>(pair.i));
      answer.pairs.push_back(static_cast<std::uint32_t>(pair.j));
    }
    if (const auto closest = links.self_closest()) answer.closest = {link_of(closest->first), link_of(closest->second)};
    if (count > 0) answer.tip = links.link_pose(id<LinkId>(count)).translation;
    return answer;
  });
}

}  // namespace hinge::robustness
