// SPDX-License-Identifier: BSD-3-Clause
// Strong index types: the compiler rejects a link index where a primitive index is expected.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace hinge {

/// Index into Model::primitives().
enum class PrimitiveId : std::uint32_t {};
/// Index of a link in the kinematic tree. Link 0 is the world.
enum class LinkId : std::uint32_t {};
/// Index into the full configuration of a kinematic tree.
enum class DofId : std::uint32_t {};
/// Index of a rigid group under one DOF selection. Group 0 contains the world.
enum class GroupId : std::uint32_t {};

/// The root link of every kinematic tree.
inline constexpr LinkId world{0};

/// One of the four index types above.
template <class T>
concept Id = std::is_enum_v<T> &&(std::is_same_v<T, PrimitiveId> || std::is_same_v<T, LinkId> ||
                                  std::is_same_v<T, DofId> || std::is_same_v<T, GroupId>);

/// Converts an id to a zero-based index.
template <Id T>
constexpr std::size_t index(T id) noexcept {
  return static_cast<std::size_t>(id);
}

/// Converts a zero-based index to an id. The index must fit in 32 bits.
template <Id T>
constexpr T id(std::size_t position) noexcept {
  return static_cast<T>(position);
}

}  // namespace hinge
