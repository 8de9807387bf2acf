// SPDX-License-Identifier: BSD-3-Clause
// Model: a kinematic tree with primitives on its links, and ModelBuilder, which validates it. A model never changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/kinematics/kinematic_tree.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge {

template <Primitive P>
class ModelBuilder;

/// A constant model. Copies are cheap and share one description, also across threads. Spans and references are valid
/// while one copy lives.
template <Primitive P>
class Model {
 public:
  /// Returns the kinematic tree.
  const KinematicTree& tree() const noexcept { return data_->tree; }
  /// Returns the primitives in the frames of their links, size() values, in the order in which they were added.
  std::span<const P> primitives() const noexcept { return data_->primitives; }
  /// Returns the number of primitives.
  std::size_t size() const noexcept { return data_->primitives.size(); }
  /// Returns the link of every primitive, size() values.
  std::span<const LinkId> links() const noexcept { return data_->links; }
  /// Returns one label per primitive. Engines keep primitives with equal labels together in one leaf (BioCD's basic
  /// groups).
  std::span<const std::uint32_t> basic_groups() const noexcept { return data_->basic_groups; }

 private:
  friend class ModelBuilder<P>;
  struct Data {
    KinematicTree tree;
    std::vector<P> primitives;
    std::vector<LinkId> links;
    std::vector<std::uint32_t> basic_groups;
  };
  explicit Model(Data data) : data_(std::make_shared<const Data>(std::move(data))) {}
  std::shared_ptr<const Data> data_;
};

/// Collects links and primitives and validates each one. Rejected input does not change the builder. Not thread-safe.
template <Primitive P>
class ModelBuilder {
 public:
  /// Adds a link and its primitives (in the link frame) and returns its id. ModelError: as by KinematicTree::add_link
  /// and add_primitive.
  LinkId add_link(LinkId parent, Joint joint, const std::vector<P>& primitives = {}) {
    joint = data_.tree.checked(parent, std::move(joint));
    const LinkId link = id<LinkId>(data_.tree.link_count());
    for (std::size_t k = 0; k < primitives.size(); ++k) check(data_.primitives.size() + k, link, primitives[k]);
    data_.tree.add_link(parent, std::move(joint));
    for (const P& primitive : primitives) insert(link, primitive);
    return link;
  }

  /// Adds a primitive in the frame of a link (link 0 is the world) and returns its id. ModelError: unknown link, or a
  /// primitive that fails is_sound.
  PrimitiveId add_primitive(LinkId link, const P& primitive) {
    if (index(link) >= data_.tree.link_count())
      throw ModelError("primitive " + std::to_string(data_.primitives.size()) + ": link " +
                       std::to_string(index(link)) + " does not exist");
    check(data_.primitives.size(), link, primitive);
    return insert(link, primitive);
  }

  /// Adds a closure. ModelError: as by KinematicTree::add_closure.
  void add_closure(Closure closure) { data_.tree.add_closure(std::move(closure)); }

  /// labels: one arbitrary number per primitive. Without labels every primitive is its own basic group.
  void set_basic_groups(std::vector<std::uint32_t> labels) { data_.basic_groups = std::move(labels); }

  /// Returns the tree as built so far.
  const KinematicTree& tree() const noexcept { return data_.tree; }

  /// Returns the model and empties the builder. ModelError: labels were given, but not one per primitive.
  Model<P> finish() {
    if (data_.basic_groups.empty()) {
      data_.basic_groups.resize(data_.primitives.size());
      std::iota(data_.basic_groups.begin(), data_.basic_groups.end(), 0U);
    }
    if (data_.basic_groups.size() != data_.primitives.size())
      throw ModelError(std::to_string(data_.basic_groups.size()) + " basic group labels, expected one for each of " +
                       std::to_string(data_.primitives.size()) + " primitives");
    return Model<P>(std::exchange(data_, {}));
  }

 private:
  static void check(std::size_t position, LinkId link, const P& primitive) {
    if (!is_sound(primitive))
      throw ModelError("primitive " + std::to_string(position) + " on link " + std::to_string(index(link)) + ": " +
                       flaw_of(primitive));
  }
  PrimitiveId insert(LinkId link, const P& primitive) {
    data_.primitives.push_back(primitive);
    data_.links.push_back(link);
    return id<PrimitiveId>(data_.primitives.size() - 1);
  }

  typename Model<P>::Data data_;
};

}  // namespace hinge
