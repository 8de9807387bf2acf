// SPDX-License-Identifier: BSD-3-Clause
// Hierarchies of triangles.
#include "hinge/primitive/triangle.hpp"
#include "make_queries.hpp"

namespace hinge::python {

CoreQueries make_triangles(const CoreDescription& model, const TableFilter& filter, const TypedThresholds& thresholds) {
  return make_queries<Triangle>(model, filter, thresholds, [&](std::size_t k) {
    return Triangle{vector_at(model.corners, 3 * k), vector_at(model.corners, 3 * k + 1),
                    vector_at(model.corners, 3 * k + 2)};
  });
}

}  // namespace hinge::python
