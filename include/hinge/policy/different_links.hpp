// SPDX-License-Identifier: BSD-3-Clause
// DifferentLinks: the pair filter of solid links. It never tests a link with itself.
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

/// Admits pairs of primitives on different links, except the ignored pairs of links. Copies share constant data, so
/// they are cheap and safe to use in several threads.
class DifferentLinks {
 public:
  /// link_of: one link per primitive (Model::links()). ignored: pairs of links that are not tested, such as a parent
  /// and a child whose meshes overlap at the joint. ModelError: an ignored pair names the same link twice, or a link
  /// index is >= most_links, where the table would exhaust memory.
  explicit DifferentLinks(std::vector<LinkId> link_of, std::vector<std::pair<LinkId, LinkId>> ignored = {});

  /// Returns true when the links of i and j form an admitted pair.
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    return admits(data_->link_of[hinge::index(i)], data_->link_of[hinge::index(j)]);
  }
  /// Returns true when the pair of links is tested. Both links must have an index at most that of the last link with
  /// primitives.
  bool admits(LinkId a, LinkId b) const noexcept {
    return data_->admitted[hinge::index(a) * data_->links + hinge::index(b)];
  }
  /// Returns the number of primitives.
  std::size_t size() const noexcept { return data_->link_of.size(); }
  /// Returns the link of every primitive, size() values, valid while the filter or a copy lives.
  std::span<const LinkId> links() const noexcept { return data_->link_of; }

  static constexpr std::size_t most_links = std::size_t{1}
                                            << 17;  ///< the table of pairs takes 2 GiB at this limit, one bit per pair

 private:
  struct Data {
    std::vector<LinkId> link_of;
    std::size_t links = 0;
    std::vector<bool> admitted;  // links x links, row-major
  };
  std::shared_ptr<const Data> data_;  // copies in engines and threads share it
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
    if (hinge::index(a) >= data.links || hinge::index(b) >= data.links)
      continue;  // no primitive on this link or a later link
    data.admitted[hinge::index(a) * data.links + hinge::index(b)] = false;
    data.admitted[hinge::index(b) * data.links + hinge::index(a)] = false;
  }
  data_ = std::make_shared<const Data>(std::move(data));
}

static_assert(AdmitsLinks<DifferentLinks> && KnowsLinks<DifferentLinks>);

}  // namespace hinge
