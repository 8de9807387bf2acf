// SPDX-License-Identifier: BSD-3-Clause
// Runs two triangles in two ways: as links of one model, and as two models.
#pragma once

#include <string>
#include <vector>

#include "hinge/hierarchy.hpp"
#include "hinge/policy/different_links.hpp"
#include "hinge/primitive/triangle.hpp"
#include "robustness/ask.hpp"

namespace hinge::robustness {

template <template <class, class, class> class EngineOf>
using Triangles = Hierarchy<Triangle, DifferentLinks, UniformClearance, EngineOf>;

/// A hierarchy of triangles that tests pairs of different links with a threshold of 0.
template <template <class, class, class> class EngineOf>
Triangles<EngineOf> triangles_of(ModelBuilder<Triangle>& builder, std::vector<std::pair<LinkId, LinkId>> ignored = {}) {
  const Model<Triangle> model = builder.finish();
  const DifferentLinks filter({model.links().begin(), model.links().end()}, std::move(ignored));
  return {model, filter, UniformClearance(0.0)};
}

template <class H>
Answer self_answer(H& model) {
  Answer answer;
  take_hits(answer, model.self_collides(), model.self_collisions());
  take_closest(answer, model.self_closest());
  return answer;
}

/// The primitives of the other model are numbered after those of this model.
template <class H>
Answer mutual_answer(H& model, H& other) {
  Answer answer;
  take_hits(answer, model.collides(other), model.collisions(other), model.model().size());
  take_closest(answer, model.closest(other));
  return answer;
}

inline Triangle triangle_of(const std::vector<double>& x, const char* who) {
  if (x.size() != 9)
    throw ModelError("triangle " + std::string(who) + ": " + std::to_string(x.size()) + " numbers, expected nine");
  return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}};
}

template <template <class, class, class> class EngineOf>
std::vector<Answer> run_tri(const TrianglePair& pair) {
  return {asked("two links",
                [&] {
                  ModelBuilder<Triangle> builder;
                  builder.add_link(world, Prismatic{}, {triangle_of(pair.a, "a")});
                  builder.add_link(world, Prismatic{}, {triangle_of(pair.b, "b")});
                  auto both = triangles_of<EngineOf>(builder);
                  return self_answer(both);
                }),
          asked("two models", [&] {
            ModelBuilder<Triangle> builder;
            builder.add_primitive(world, triangle_of(pair.a, "a"));
            auto a = triangles_of<EngineOf>(builder);
            builder.add_primitive(world, triangle_of(pair.b, "b"));
            auto b = triangles_of<EngineOf>(builder);
            return mutual_answer(a, b);
          })};
}

}  // namespace hinge::robustness
