// SPDX-License-Identifier: BSD-3-Clause
// Compares a Hierarchy of points or triangles with FCL at its current configuration. FCL is asked only for answers that
// it computes reliably: crossing surfaces, and distances of disjoint shapes, with no pair within `margin` of touching.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/triangle.hpp"
#include "oracle/fcl_oracle.hpp"

namespace hinge::oracle {

/// Returns a predicate for the pairs that count: admitted by the filter, and without a constant distance.
template <class P, class F>
auto counted_pairs(const SelectedModel<P>& model, const F& filter) {
  return [&model, &filter](std::size_t i, std::size_t j) {
    const auto a = id<PrimitiveId>(i), b = id<PrimitiveId>(j);
    return filter.admits(a, b) && !model.constant(a, b);
  };
}

/// Compares points with FCL spheres of radius m / 2; m is the threshold of all pairs.
class PointOracle {
 public:
  template <class F>
  PointOracle(const SelectedModel<Point>& model, const F& filter, double m)
      : m_(m), spheres_(std::vector<double>(model.size(), m / 2), counted_pairs(model, filter)) {}

  /// Returns true if the configuration was far enough from touching to be compared.
  template <class H>
  bool check(H& hierarchy, double margin) {
    std::vector<Position> positions;
    std::vector<std::size_t> all;
    for (const Point& p : hierarchy.placed()) {
      all.push_back(positions.size());
      positions.push_back({p.position[0], p.position[1], p.position[2]});
    }
    spheres_.update(positions, all);
    const auto closest = hierarchy.self_closest();
    for (const Hit& near : hierarchy.self_within(margin))
      if (std::abs(near.gap()) <= margin) return false;
    Pairs pairs;
    for (const Hit& hit : hierarchy.self_collisions()) pairs.emplace_back(index(hit.first), index(hit.second));
    oracle::Pairs found = spheres_.all();
    std::sort(found.begin(), found.end());
    EXPECT_EQ(pairs, found);
    EXPECT_EQ(hierarchy.self_collides(), spheres_.any());
    if (pairs.empty() && closest) {
      EXPECT_NEAR(closest->gap(), spheres_.distance().value_or(-1.0), 1e-9 * (1.0 + m_));
    }
    return true;
  }

 private:
  double m_;
  FclSpheres spheres_;
};

/// Compares triangles with FCL meshes, one per link. admits_links says which pairs of links count.
class TriangleOracle {
 public:
  explicit TriangleOracle(const Model<Triangle>& model) : model_(model), meshes_(split(model)) {}

  template <class H, class AdmitsLinks>
  bool check(H& hierarchy, double margin, const AdmitsLinks& admits_links) {
    const auto closest = hierarchy.self_closest();
    for (const Hit& near : hierarchy.self_within(margin))
      if (near.distance > 0.0) return false;  // too near to touching
    double nearest = std::numeric_limits<double>::infinity();
    Pairs pairs;
    for (std::size_t a = 0; a < of_link_.size(); ++a)
      for (std::size_t b = a + 1; b < of_link_.size(); ++b) {
        if (of_link_[a].empty() || of_link_[b].empty() || !admits_links(id<LinkId>(a), id<LinkId>(b))) continue;
        const Placement x = placement(hierarchy.link_pose(id<LinkId>(a))),
                        y = placement(hierarchy.link_pose(id<LinkId>(b)));
        for (const auto& [i, j] : meshes_.contacts(a, x, b, y))
          pairs.emplace_back(std::min(of_link_[a][i], of_link_[b][j]), std::max(of_link_[a][i], of_link_[b][j]));
        EXPECT_EQ(meshes_.collide(a, x, b, y), !meshes_.contacts(a, x, b, y).empty());
        nearest = std::min(nearest, meshes_.distance(a, x, b, y));
      }
    std::sort(pairs.begin(), pairs.end());
    Pairs found;
    for (const Hit& hit : hierarchy.self_collisions()) found.emplace_back(index(hit.first), index(hit.second));
    EXPECT_EQ(found, pairs);
    EXPECT_EQ(hierarchy.self_collides(), !pairs.empty());
    if (closest && pairs.empty()) {
      EXPECT_NEAR(closest->distance, nearest, 1e-9 * (1.0 + nearest));
    }
    return true;
  }

 private:
  std::vector<std::vector<std::array<double, 9>>> split(const Model<Triangle>& model) {
    std::vector<std::vector<std::array<double, 9>>> meshes(model.tree().link_count());
    of_link_.resize(meshes.size());
    for (std::size_t i = 0; i < model.size(); ++i) {
      const Triangle& t = model.primitives()[i];
      const std::size_t link = index(model.links()[i]);
      meshes[link].push_back({t.a[0], t.a[1], t.a[2], t.b[0], t.b[1], t.b[2], t.c[0], t.c[1], t.c[2]});
      of_link_[link].push_back(i);
    }
    return meshes;
  }
  static Placement placement(const Pose& pose) {
    Placement p{};
    for (std::size_t r = 0; r < 3; ++r) {
      const auto row = static_cast<Eigen::Index>(r);
      for (std::size_t c = 0; c < 3; ++c) p[3 * r + c] = pose.rotation(row, static_cast<Eigen::Index>(c));
      p[9 + r] = pose.translation[row];
    }
    return p;
  }

  Model<Triangle> model_;
  std::vector<std::vector<std::size_t>> of_link_;
  FclMeshes meshes_;
};

}  // namespace hinge::oracle
