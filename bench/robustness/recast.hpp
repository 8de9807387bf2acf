// SPDX-License-Identifier: BSD-3-Clause
// recast(): the same model with another type of primitive.
#pragma once

#include <cstddef>

#include "hinge/core/id.hpp"
#include "hinge/model/model.hpp"

namespace hinge::bench {

/// Joint axes are normalized again, so compare only models that both come from recast().
template <Primitive Q, Primitive P>
Model<Q> recast(const Model<P>& model) {
  ModelBuilder<Q> builder;
  const KinematicTree& tree = model.tree();
  for (std::size_t l = 1; l < tree.link_count(); ++l)
    builder.add_link(tree.parent(id<LinkId>(l)), tree.joint(id<LinkId>(l)));
  for (const Closure& closure : tree.closures()) builder.add_closure(closure);
  for (std::size_t i = 0; i < model.size(); ++i) builder.add_primitive(model.links()[i], Q{model.primitives()[i]});
  builder.set_basic_groups({model.basic_groups().begin(), model.basic_groups().end()});
  return builder.finish();
}

}  // namespace hinge::bench
