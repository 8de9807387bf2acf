// SPDX-License-Identifier: BSD-3-Clause
// DifferentLinks: the pair filter of solid bodies, where a link is never tested with itself.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/policy/pair_filter.hpp"

namespace hinge {

/// Admits pairs whose primitives belong to different links, except pairs of links switched off by the caller.
class DifferentLinks {
 public:
  /// link_of[i] is the link of primitive i (Model::links()); ignored holds link pairs that are not tested, such as
  /// parent and child whose meshes meet in the joint. ModelError: a pair of a link with itself; a link beyond
  /// most_links, whose pairs would fill the memory.
  explicit DifferentLinks(std::vector<LinkId> link_of, std::vector<std::pair<LinkId, LinkId>> ignored = {});

  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    return admits(data_->link_of[hinge::index(i)], data_->link_of[hinge::index(j)]);
  }
  /// Links that have primitives.
  bool admits(LinkId a, LinkId b) const noexcept {
    return data_->admitted[hinge::index(a) * data_->links + hinge::index(b)];
  }
  std::size_t size() const noexcept { return data_->link_of.size(); }
  /// The link of every primitive.
  std::span<const LinkId> links() const noexcept { return data_->link_of; }

  static constexpr std::size_t most_links = std::size_t{1} << 17;  ///< their pairs fill 2 GiB, a bit each

 private:
  struct Data {
    std::vector<LinkId> link_of;
    std::size_t links = 0;
    std::vector<bool> admitted;  // links x links, row-major
  };
  std::shared_ptr<const Data> data_;  // shared by the copies that engines and threads hold
};

inline DifferentLinks::DifferentLinks(std::vector<LinkId> link_of, std::vector<std::pair<LinkId, LinkId>> ignored) {
  Data data{std::move(link_of), 1, {}};
  for (const LinkId link : data.link_of) data.links = std::max(data.links, hinge::index(link) + 1);
  if (data.links > most_links)
    throw ModelError("primitives on link " + std::to_string(data.links - 1) + ": expected links below " +
                     std::to_string(most_links));
  data.admitted.assign(data.links * data.links, true);
  for (std::size_t k = 0; k < data.links; ++k) data.admitted[k * data.links + k] = false;
  for (const auto& [a, b] : ignored) {
    if (a == b)
      throw ModelError("ignored pair: link " + std::to_string(hinge::index(a)) +
                       " with itself, expected two different links");
    if (hinge::index(a) >= data.links || hinge::index(b) >= data.links) continue;  // a link without primitives
    data.admitted[hinge::index(a) * data.links + hinge::index(b)] = false;
    data.admitted[hinge::index(b) * data.links + hinge::index(a)] = false;
  }
  data_ = std::make_shared<const Data>(std::move(data));
}

static_assert(AdmitsLinks<DifferentLinks> && KnowsLinks<DifferentLinks>);

}  // namespace hinge
