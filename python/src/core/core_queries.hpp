// SPDX-License-Identifier: BSD-3-Clause
// CoreQueries: the questions of a hierarchy of any primitive and engine, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <typeinfo>
#include <vector>

#include "cross_table.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "table_filter.hpp"

namespace hinge::python {

/// A model and its rules, before a kind of primitive and an engine are chosen.
struct CoreDescription {
  std::vector<LinkId> parents;  ///< of links 1, 2, ...
  std::vector<Joint> joints;    ///< of the same links
  std::vector<LinkId> link_of;  ///< per primitive
  std::vector<double> corners;  ///< per primitive, in its link's frame: 3 numbers (points, spheres), 6 or 9
  std::vector<double> radii;    ///< per primitive; empty for points and triangles
  std::vector<DofId> free;      ///< selected degrees of freedom
  std::string engine;           ///< "simd", "lazy" or "brute"
};

/// Checks a path: from, to, smallest step or resolution, between.
using CheckPath =
    std::function<PathAnswer(std::span<const double>, std::span<const double>, double, const std::function<void()>&)>;

/// Proves paths as CertifiedPath does. A copy has a state of its own.
struct PathProver {
  CheckPath check;
  std::function<PathProver()> clone;

  PathProver() = default;
  PathProver(const PathProver& other) : PathProver(other.clone()) {}
  PathProver(PathProver&&) = default;
  PathProver& operator=(const PathProver&) = delete;
  PathProver& operator=(PathProver&&) = default;
  ~PathProver() = default;
};

/// A hierarchy. A copy has a state of its own. Functions throw as Hierarchy does.
struct CoreQueries {
  std::function<void(std::span<const double>)> update;
  std::function<bool()> collides;
  std::function<std::vector<Hit>(double margin)> within;
  std::function<std::optional<Hit>()> closest;
  std::function<Pose(LinkId)> link_pose;
  std::function<std::vector<Hit>()> constant_contacts;
  CheckPath sample_path;  ///< moves the state
  std::function<PathProver()> make_prover;
  // Against another hierarchy of the same kind of primitives and engine, which `kind` tells.
  std::function<bool(const CoreQueries&, const CrossTable&)> collides_with;
  std::function<std::vector<Hit>(const CoreQueries&, const CrossTable&, double margin)> within_of;
  std::function<std::optional<Hit>(const CoreQueries&, const CrossTable&)> closest_of;
  std::shared_ptr<void> hierarchy;
  const std::type_info* kind = nullptr;
  std::size_t dof = 0, links = 0;
  std::function<CoreQueries()> clone;

  CoreQueries() = default;
  CoreQueries(const CoreQueries& other) : CoreQueries(other.clone()) {}
  CoreQueries(CoreQueries&&) = default;
  CoreQueries& operator=(const CoreQueries&) = delete;
  CoreQueries& operator=(CoreQueries&&) = default;
  ~CoreQueries() = default;
};

// One source each, because each compiles three engines. Throw ModelError for an invalid model or an unknown engine.
CoreQueries make_points(const CoreDescription& model, const TableFilter& filter, const TypedThresholds& thresholds);
CoreQueries make_spheres(const CoreDescription& model, const TableFilter& filter, const TypedThresholds& thresholds);
CoreQueries make_capsules(const CoreDescription& model, const TableFilter& filter, const TypedThresholds& thresholds);
CoreQueries make_triangles(const CoreDescription& model, const TableFilter& filter, const TypedThresholds& thresholds);

}  // namespace hinge::python
