// SPDX-License-Identifier: BSD-3-Clause
// Model: a kinematic tree with primitives on its links, checked once by its builder and constant afterwards.
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

/// Cheap to copy: copies share one constant description, also between threads.
template <Primitive P>
class Model {
 public:
  const KinematicTree& tree() const noexcept { return data_->tree; }
  /// In the frame of their link, numbered in the order they were added.
  std::span<const P> primitives() const noexcept { return data_->primitives; }
  std::size_t size() const noexcept { return data_->primitives.size(); }
  /// The link of every primitive.
  std::span<const LinkId> links() const noexcept { return data_->links; }
  /// A label per primitive: primitives that belong closely together and stay together in one leaf (BioCD's basic
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

/// Collects links and primitives, refusing what no query could answer for. What is refused leaves it as it was.
template <Primitive P>
class ModelBuilder {
 public:
  /// Adds a link and its primitives (link frame). ModelError: see KinematicTree::add_link and add_primitive.
  LinkId add_link(LinkId parent, Joint joint, const std::vector<P>& primitives = {}) {
    joint = data_.tree.checked(parent, std::move(joint));
    const LinkId link = id<LinkId>(data_.tree.link_count());
    for (std::size_t k = 0; k < primitives.size(); ++k) check(data_.primitives.size() + k, link, primitives[k]);
    data_.tree.add_link(parent, std::move(joint));
    for (const P& primitive : primitives) insert(link, primitive);
    return link;
  }

  /// Adds a primitive to a link (the world included). ModelError: unknown link; a primitive that is not sound.
  PrimitiveId add_primitive(LinkId link, const P& primitive) {
    if (index(link) >= data_.tree.link_count())
      throw ModelError("primitive " + std::to_string(data_.primitives.size()) + ": link " +
                       std::to_string(index(link)) + " does not exist");
    check(data_.primitives.size(), link, primitive);
    return insert(link, primitive);
  }

  void add_closure(Closure closure) { data_.tree.add_closure(std::move(closure)); }

  /// One label per primitive, any numbers. Without it every primitive is a basic group of its own.
  void set_basic_groups(std::vector<std::uint32_t> labels) { data_.basic_groups = std::move(labels); }

  const KinematicTree& tree() const noexcept { return data_.tree; }

  /// ModelError: basic groups given, but not one label per primitive.
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
