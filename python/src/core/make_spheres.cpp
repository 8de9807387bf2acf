// SPDX-License-Identifier: BSD-3-Clause
// Hierarchies of spheres.
#include "hinge/primitive/sphere.hpp"
#include "make_queries.hpp"

namespace hinge::python {

CoreQueries make_spheres(const CoreDescription& model, const TableFilter& filter, const TypedThresholds& thresholds) {
  return make_queries<Sphere>(model, filter, thresholds, [&](std::size_t k) {
    return Sphere{vector_at(model.corners, k), model.radii[k]};
  });
}

}  // namespace hinge::python
