// SPDX-License-Identifier: BSD-3-Clause
// Strong index types, so that no link is ever taken for a primitive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace hinge {

enum class PrimitiveId : std::uint32_t {};  ///< position in Model::primitives()
enum class LinkId : std::uint32_t {};       ///< position in the kinematic tree; 0 is the world
enum class DofId : std::uint32_t {};        ///< position in the full configuration of a kinematic tree
enum class GroupId : std::uint32_t {};      ///< rigid group under one DOF selection; 0 holds the world

inline constexpr LinkId world{0};

template <class T>
concept Id = std::is_enum_v<T> &&(std::is_same_v<T, PrimitiveId> || std::is_same_v<T, LinkId> ||
                                  std::is_same_v<T, DofId> || std::is_same_v<T, GroupId>);

/// The position an id stands for.
template <Id T>
constexpr std::size_t index(T id) noexcept {
  return static_cast<std::size_t>(id);
}

/// The id of a position.
template <Id T>
constexpr T id(std::size_t position) noexcept {
  return static_cast<T>(position);
}

}  // namespace hinge
