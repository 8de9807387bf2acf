// SPDX-License-Identifier: BSD-3-Clause
// Without NDEBUG, a hierarchy rejects a filter whose lists or link tests contradict admits().
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/policy/different_links.hpp"
#include "hinge/primitive/point.hpp"

#ifdef NDEBUG
#error "this file is about debug builds"
#endif

namespace hinge {
namespace {

Model<Point> four_links() {
  ModelBuilder<Point> builder;
  for (int k = 0; k < 4; ++k) builder.add_link(world, Revolute{}, {Point{{1.0 * k, 0, 0}}, Point{{1.0 * k, 1, 0}}});
  return builder.finish();
}

template <class F>
auto on(const F& filter) {
  return Hierarchy<Point, F, UniformClearance, Brute>(four_links(), filter, UniformClearance{0.1});
}

template <class Act>
std::string refusal(const Act& act) {
  try {
    act();
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

struct Listed {
  PrimitiveId fifth{5};
  bool refuses = false;  // excludes the pair that it lists
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    return !refuses || index(i) + index(j) != 7 || (index(i) != 2 && index(j) != 2);
  }
  std::span<const PrimitiveId> excluded(PrimitiveId i) const noexcept {
    return index(i) == 2 ? std::span(&fifth, 1) : std::span<const PrimitiveId>();
  }
};

struct Linked : DifferentLinks {
  using DifferentLinks::admits;
  using DifferentLinks::DifferentLinks;
  bool admits(PrimitiveId, PrimitiveId) const noexcept { return true; }
};

TEST(DebugBuild, RefusesAFilterThatAdmitsWhatItLists) {
  const std::string message = refusal([] { on(Listed{}); });
  EXPECT_NE(message.find("primitives 2 and 5"), std::string::npos) << message;
  EXPECT_EQ(refusal([] { on(Listed{.refuses = true}); }), "");
}

TEST(DebugBuild, RefusesAFilterThatAdmitsPairsOfRefusedLinks) {
  const Model<Point> model = four_links();
  const std::vector<LinkId> links(model.links().begin(), model.links().end());
  const Linked filter(links, {{LinkId{2}, LinkId{3}}});
  std::string message = refusal([&] { on(filter); });
  EXPECT_NE(message.find("links 2 and 3"), std::string::npos) << message;
  auto mine = on(AdmitAll{}), theirs = on(AdmitAll{});
  message = refusal([&] { mine.collides(theirs, filter); });
  EXPECT_NE(message.find("of the two models"), std::string::npos) << message;
  EXPECT_EQ(refusal([&] { on(DifferentLinks(links, {{LinkId{2}, LinkId{3}}})); }), "");
}

}  // namespace
}  // namespace hinge
