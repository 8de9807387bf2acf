// SPDX-License-Identifier: BSD-3-Clause
// Hierarchies of points.
#include "hinge/primitive/point.hpp"
#include "make_queries.hpp"

namespace hinge::python {

CoreQueries make_points(const CoreDescription& model, const TableFilter& filter, const TypedThresholds& thresholds) {
  return make_queries<Point>(model, filter, thresholds,
                             [&](std::size_t k) { return Point{vector_at(model.corners, k)}; });
}

}  // namespace hinge::python
