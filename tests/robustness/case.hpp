// SPDX-License-Identifier: BSD-3-Clause
// Case: one line of a file of robustness cases, its true answer, and the answers of an engine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/core/vec3.hpp"

namespace hinge::robustness {

// Input as it is in the file. The code that builds a model checks lengths of lists and ranges of indices.

/// Two triangles.
struct TrianglePair {
  std::vector<double> a, b;  ///< three corners each
};

/// Points with thresholds by type, groups and exclusions.
struct Atoms {
  std::int64_t count = 0;
  std::vector<double> x;                  ///< 3 per atom
  std::vector<std::int64_t> type, group;  ///< per atom; pairs inside a group are not tested
  std::int64_t type_count = 0;
  std::vector<double> thresholds;      ///< type_count x type_count, row-major
  std::vector<std::int64_t> excluded;  ///< two atoms each, not tested
};

/// A mesh of vertices and triangles.
struct Mesh {
  std::vector<double> v;        ///< 3 per vertex
  std::vector<std::int64_t> f;  ///< 3 per triangle
};

/// Two meshes and their poses in the world.
struct MeshPair {
  Mesh a, b;
  std::vector<double> place_a, place_b;  ///< 3 x 4, row-major: rotation | translation
};

/// One link of a chain with a revolute joint.
struct ChainLink {
  std::int64_t parent = -1;          ///< -1: the world
  std::vector<double> origin, axis;  ///< in the parent's frame
  double angle = 0.0;                ///< rad
  Mesh mesh;                         ///< in the link's frame
};

struct Chain {
  std::vector<ChainLink> links;
};

/// The true distance lies in [low, high].
struct Bracket {
  double low = 0.0, high = 0.0;
};

/// The true answer for one pair of links; links count from 0.
struct LinkPairTruth {
  std::size_t i = 0, j = 0;
  bool hit = false, stable = true;
  Bracket distance;
  double span = 0.0;  ///< largest coordinate difference of the two; 0 if unknown
};

/// The true answer for a case.
struct Truth {
  bool refuse = false;  ///< the input must be rejected; the other members are then unused
  bool hit = false;
  bool stable = true;  ///< false: rounding world coordinates by a few ulps can change the verdict
  std::optional<std::size_t> pair_count;
  std::optional<std::vector<std::uint32_t>> pairs;  ///< flat, sorted
  std::optional<Bracket> distance;                  ///< of the closest pair; empty: unknown, or no pair is tested
  /// Do verdict and distances hold for the library's computed world coordinates instead of the input?
  bool of_placed = false;
  std::vector<LinkPairTruth> link_pairs;
  std::optional<std::array<std::size_t, 2>> closest;  ///< indices of two links
  std::optional<Vec3> tip;
};

/// One case; `truth` is empty if the file has no answer.
struct Case {
  std::string id, kind, family;
  std::variant<TrianglePair, Atoms, MeshPair, Chain> input;
  std::optional<Truth> truth;
};

enum class EngineName : std::uint8_t { brute, lazy, simd };
inline constexpr std::array<std::pair<EngineName, const char*>, 3> engine_names{
    {{EngineName::brute, "brute"}, {EngineName::lazy, "lazy"}, {EngineName::simd, "simd"}}};

/// An engine's answer for one pair of links.
struct LinkPairAnswer {
  std::size_t i = 0, j = 0;
  bool hit = false;
  double distance = std::numeric_limits<double>::infinity();
};

/// An engine's answer for a case.
struct Answer {
  std::string way;  ///< how the case was given to the library
  bool refused = false;
  std::string message;  ///< message of the refusal
  bool hit = false;
  std::size_t pair_count = 0;
  std::vector<std::uint32_t> pairs;                           ///< flat, sorted; pairs of links for a chain
  double distance = std::numeric_limits<double>::infinity();  ///< infinite if no pair is tested
  std::vector<LinkPairAnswer> link_pairs;
  std::optional<std::array<std::size_t, 2>> closest;
  std::optional<Vec3> tip;
  std::string contradiction;  ///< inconsistent answers of the library to this case
};

}  // namespace hinge::robustness
