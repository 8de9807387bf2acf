// SPDX-License-Identifier: BSD-3-Clause
// Pairs of triangles of one family: answers of Hinge, of plain double decisions and of FCL against exact rationals.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hinge/hierarchy.hpp"
#include "hinge/model/model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/primitive/triangle.hpp"
#include "oracle/placement.hpp"
#include "peers/fcl_triangles.hpp"
#include "primitive/triangle_families.hpp"
#include "primitive/triangle_oracle.hpp"
#include "robustness/plain_triangle.hpp"

namespace hinge::bench {

using Json = nlohmann::ordered_json;
using Exact = test::Float50;

inline constexpr std::uint64_t robustness_seed = 2005;

/// Relative errors of distances count only above this share of the pair's size. Below it, the rounding of the corners
/// dominates the error.
inline constexpr double apart_share = 1e-6;

/// The exact answer for one pair.
struct Judged {
  bool touch = false;
  Exact distance = 0;
  double size = 0.0;  ///< diagonal of the bounding box of both triangles
};

/// Errors of one contestant. Lengths are shares of the pair's size.
struct Tally {
  std::size_t wrong_yes = 0, wrong_no = 0, zero_apart = 0, positive_touching = 0, contradictions = 0;
  double widest_yes = 0.0, widest_zero = 0.0, largest_positive = 0.0;
  double relative = 0.0, of_size = 0.0;  ///< largest error of a distance, relative to the distance and to the size
  std::size_t threshold_wrong = 0;       ///< wrong answers to d < m, with m next to d

  void verdict(bool yes, const Judged& truth) {
    if (yes == truth.touch) return;
    ++(yes ? wrong_yes : wrong_no);
    if (yes) widest_yes = std::max(widest_yes, static_cast<double>(truth.distance / truth.size));
  }
  void distance(double d, bool yes, const Judged& truth) {
    contradictions += yes != (d == 0.0) ? 1 : 0;
    if (truth.touch) {
      if (d == 0.0) return;
      ++positive_touching;
      largest_positive = std::max(largest_positive, share(d, truth));
      of_size = std::max(of_size, share(d, truth));
      return;
    }
    if (d == 0.0) {
      ++zero_apart;
      widest_zero = std::max(widest_zero, static_cast<double>(truth.distance / truth.size));
    }
    const Exact error = std::isfinite(d) ? abs(Exact(d) - truth.distance) : Exact(infinity);
    of_size = std::max(of_size, static_cast<double>(error / truth.size));
    if (truth.distance > truth.size * apart_share)
      relative = std::max(relative, static_cast<double>(error / truth.distance));
  }

  Json json(const char* who) const {
    return {{"who", who},
            {"wrong_yes", wrong_yes},
            {"wrong_no", wrong_no},
            {"widest_yes", widest_yes},
            {"zero_apart", zero_apart},
            {"widest_zero", widest_zero},
            {"positive_touching", positive_touching},
            {"largest_positive", largest_positive},
            {"relative", finite_or(relative)},
            {"ulps_of_size", finite_or(of_size * 0x1p52)},
            {"contradictions", contradictions},
            {"threshold_wrong", threshold_wrong}};
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static double share(double d, const Judged& truth) {
    return std::isfinite(d) ? static_cast<double>(Exact(d) / truth.size) : infinity;
  }
  /// JSON has no infinity, so 1e300 replaces it.
  static double finite_or(double x) { return std::isfinite(x) ? x : 1e300; }
};

using oracle::corners;

/// Admits triangle i of one link with triangle i of the other.
struct SameNumber {
  std::size_t count;
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    return index(i) + count == index(j) || index(j) + count == index(i);
  }
};

/// Runs all contestants on one family of pairs and tallies their errors.
class FamilyRun {
 public:
  FamilyRun(const test::TriangleFamily& family, std::uint64_t number)
      : family_(family), random_(robustness_seed + number) {}

  void run(std::size_t cases) {
    for (std::size_t done = 0; done < cases; done += batch) run_batch(std::min(batch, cases - done));
  }

  std::vector<Json> rows() const {
    std::vector<Json> rows;
    const std::pair<const char*, const Tally*> all[] = {
        {"hinge", &hinge_}, {"hierarchy", &hierarchy_}, {"plain", &plain_}, {"fcl", &fcl_}, {"fcl-mesh", &fcl_mesh_}};
    for (const auto& [who, tally] : all) {
      Json row = {{"kind", "family"}, {"family", family_.name}, {"pairs", pairs_}, {"touching", touching_}};
      row.update(tally->json(who));
      rows.push_back(std::move(row));
    }
    return rows;
  }

 private:
  static constexpr std::size_t batch = 64;  ///< pairs in one Hierarchy: two links of 64 triangles each

  void run_batch(std::size_t count) {
    std::vector<test::TrianglePairSample> pairs;
    std::vector<Judged> truth;
    for (std::size_t k = 0; k < count; ++k) {
      pairs.push_back(family_.make(random_));
      truth.push_back(judge(pairs.back()));
    }
    ask_hierarchy(pairs, truth);
  }

  Judged judge(const test::TrianglePairSample& pair) {
    const auto& [p, q] = pair;
    const test::OracleDistance oracle(p, q);
    Aabb box = p.bounds();
    box.extend(q.bounds());
    Judged truth{oracle.meet(), oracle.distance(), diagonal(box)};
    ++pairs_;
    touching_ += truth.touch ? 1 : 0;
    const bool yes = closer_than(p, q, 0.0);
    const double d = std::sqrt(squared_distance(p, q));
    hinge_.verdict(yes, truth);
    hinge_.distance(d, yes, truth);
    const PlainTriangle plain_p{p}, plain_q{q};
    const bool plain_yes = closer_than(plain_p, plain_q, 0.0);
    plain_.verdict(plain_yes, truth);
    plain_.distance(std::sqrt(squared_distance(plain_p, plain_q)), plain_yes, truth);
    const FclCorners x = corners(p), y = corners(q);
    const bool fcl_yes = fcl_intersect(x, y), mesh_yes = fcl_meshes_collide(x, y);
    const double fcl_d = fcl_distance(x, y), mesh_d = fcl_meshes_distance(x, y);
    fcl_.verdict(fcl_yes, truth);
    fcl_.distance(fcl_d, fcl_yes, truth);
    fcl_mesh_.verdict(mesh_yes, truth);
    fcl_mesh_.distance(mesh_d, mesh_yes, truth);
    if (truth.touch) return truth;
    double m = static_cast<double>(truth.distance);
    const double toward = random_.one_in(2) ? 0.0 : std::numeric_limits<double>::max();
    for (std::size_t steps = random_.below(3); steps-- > 0;) m = std::nextafter(m, toward);
    const bool below = oracle.below(m);
    hinge_.threshold_wrong += closer_than(p, q, m) != below ? 1 : 0;
    plain_.threshold_wrong += closer_than(plain_p, plain_q, m) != below ? 1 : 0;
    fcl_.threshold_wrong += (fcl_d < m) != below ? 1 : 0;
    fcl_mesh_.threshold_wrong += (mesh_d < m) != below ? 1 : 0;
    return truth;
  }

  static double diagonal(const Aabb& box) {
    const Vec3 side = box.upper - box.lower;
    return std::hypot(side[0], side[1], side[2]);  // avoids the overflow of squares in the family of huge triangles
  }

  /// Tests all pairs in one query, as two links of a model at its reference.
  void ask_hierarchy(const std::vector<test::TrianglePairSample>& pairs, const std::vector<Judged>& truth) {
    ModelBuilder<Triangle> builder;
    for (const auto& pair : pairs) builder.add_primitive(world, pair.first);
    const LinkId link = builder.add_link(world, Prismatic{Vec3(1, 0, 0), {}, {}});
    for (const auto& pair : pairs) builder.add_primitive(link, pair.second);
    Hierarchy model(builder.finish(), SameNumber{pairs.size()}, UniformClearance{0.0});
    const auto placed = model.placed();
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (corners(placed[k]) != corners(pairs[k].first) ||
          corners(placed[k + pairs.size()]) != corners(pairs[k].second))
        throw std::runtime_error(family_.name + ": the reference moves a triangle");
    std::vector<bool> yes(pairs.size(), false);
    for (const Hit& hit : model.self_collisions()) yes[index(hit.first)] = true;
    bool any = false;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      hierarchy_.verdict(yes[k], truth[k]);
      any = any || yes[k];
    }
    Judged nearest = truth.front();
    for (const Judged& one : truth)
      if (one.distance < nearest.distance) nearest = one;
    const auto closest = model.self_closest();
    hierarchy_.contradictions += model.self_collides() != any ? 1 : 0;
    hierarchy_.distance(closest ? closest->distance : std::numeric_limits<double>::infinity(), any, nearest);
  }

  const test::TriangleFamily& family_;
  test::Random random_;
  std::size_t pairs_ = 0, touching_ = 0;
  Tally hinge_, hierarchy_, plain_, fcl_, fcl_mesh_;
};

/// Runs the families of the page, which end with "tiny_2_minus_300". FCL is not made for later families.
inline std::vector<Json> run_families(std::size_t cases) {
  std::vector<Json> rows;
  std::uint64_t number = 0;
  for (const test::TriangleFamily& family : test::triangle_families()) {
    FamilyRun run(family, number++);
    run.run(cases);
    for (Json& row : run.rows()) rows.push_back(std::move(row));
    if (family.name == "tiny_2_minus_300") break;
  }
  return rows;
}

}  // namespace hinge::bench
