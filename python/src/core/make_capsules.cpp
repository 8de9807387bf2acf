// SPDX-License-Identifier: BSD-3-Clause
// Hierarchies of capsules.
#include "hinge/primitive/capsule.hpp"
#include "make_queries.hpp"

namespace hinge::python {

CoreQueries make_capsules(const CoreDescription& model, const TableFilter& filter, const TypedThresholds& thresholds) {
  return make_queries<Capsule>(model, filter, thresholds, [&](std::size_t k) {
    return Capsule{vector_at(model.corners, 2 * k), vector_at(model.corners, 2 * k + 1), model.radii[k]};
  });
}

}  // namespace hinge::python
