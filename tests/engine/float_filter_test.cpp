// SPDX-License-Identifier: BSD-3-Clause
// The error band of engine/simd against observed errors of float coordinates, relative to the double coordinates that
// decide pairs.
// The derivation and the worst shares are in docs/explanation/float_filter.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/engine/simd/cross_model_transform.hpp"
#include "hinge/detail/engine/simd/simd_side.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/model/placement.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/pair_filter.hpp"

namespace hinge {
namespace float_filter_test {

using test::Random;
constexpr std::size_t n = detail::simd::width;
constexpr double u = 0x1p-24;

/// One model with the data of engine/simd, all primitives placed.
struct Placed {
  Placed(const Model<Point>& model, bool inside_groups, double clearance = 0.0)
      : selected(std::make_shared<const SelectedModel<Point>>(model, DofSelection::all(model.tree()))),
        placement(selected),
        side(std::make_shared<const detail::SimdParts<Point>>(
                 inside_groups ? detail::BlockLayout::by_index(*selected) : detail::BlockLayout::by_groups(*selected),
                 detail::ThresholdClasses(UniformClearance(clearance), model.size()), *selected),
             *selected, AdmitAll{}, inside_groups) {}

  void make() {
    side.begin(placement, false, {});
    for (std::size_t k = 0; k < side.layout().entries.size(); ++k) side.state().refresh(k, placement);
    for (std::uint32_t b = 0; b < side.layout().block_count(); ++b) side.state().block(b, placement);
  }
  /// Coordinates of a slot in double, which decide pairs.
  Vec3 at(std::size_t slot) {
    return side.state().exact(static_cast<std::uint32_t>(slot / n), placement)[slot % n].position;
  }
  bool rigid(std::size_t slot) const { return side.layout().blocks[slot / n].rigid; }
  std::size_t slots() const { return side.layout().primitive.size(); }

  std::shared_ptr<const SelectedModel<Point>> selected;
  Placement<Point> placement;
  detail::SimdSide<Point> side;
};

/// Largest share of the band that an error used, by the kind of blocks of the two points.
struct Worst {
  double mixed = 0, rigid = 0, boxes = 0, trees = 0;
  void take(double& worst, double share) {
    if (!(share <= worst)) worst = share;
  }
  void print(const char* what) const {
    std::printf("%-44s mixed %.3f rigid %.3f boxes %.3f trees %.3f\n", what, mixed, rigid, boxes, trees);
    for (const double share : {mixed, rigid, boxes, trees}) EXPECT_LT(share, 1.0) << what;
  }
};

/// For a threshold equal to the distance: the error of the float distance as a share of the band.
void check_pairs(Placed& m, Random& random, std::size_t count, Worst& worst) {
  if (m.slots() < 2) return;
  const double scale = m.side.layout().scale;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = random.below(m.slots());
    const std::size_t b = random.below(m.slots()) / n;
    float squared[n];
    detail::Batch<Point>::One(m.side.state().packed(static_cast<std::uint32_t>(i / n)) + i % n)
        .squared_distances(m.side.state().packed(static_cast<std::uint32_t>(b)))
        .store(squared);
    const Vec3 x = m.at(i);
    for (std::size_t lane = 0; lane < n; ++lane) {
      const double d = std::sqrt(squared_norm(Vec3(x - m.at(b * n + lane)))) * scale;
      const double share = std::abs(static_cast<double>(std::sqrt(squared[lane])) - d) / m.side.state().band(d);
      worst.take(m.rigid(i) && m.rigid(b * n) ? worst.rigid : worst.mixed, share);
    }
  }
}

/// How far points are outside their float boxes. Each of two boxes may use half of the band.
void check_boxes(Placed& m, Worst& worst) {
  const detail::BlockLayout& layout = m.side.layout();
  const double half_band = m.side.state().band(0.0) / 2;
  const auto outside = [&](const detail::FloatBox& box, std::uint32_t block) {
    double out = 0.0;
    for (std::size_t lane = 0; lane < n; ++lane)
      for (int k = 0; k < 3; ++k) {
        const double x = (m.at(block * n + lane)[k] - m.side.state().origin()[k]) * layout.scale;
        const auto axis = static_cast<std::size_t>(k);
        out = std::max({out, x - static_cast<double>(box.upper[axis]), static_cast<double>(box.lower[axis]) - x});
      }
    return out / half_band;
  };
  for (std::size_t w = 0; w < layout.entries.size(); ++w) {
    const detail::SweepEntry& unit = layout.entries[w];
    for (std::uint32_t b = unit.first_block; b < unit.first_block + unit.block_count; ++b) {
      worst.take(worst.boxes, outside(m.side.state().entries().get(w), b));
      if (unit.block_count == 1) continue;
      const std::uint32_t child = b - unit.first_block;
      const auto& levels = m.side.parts().rigid.tree[w].levels;
      std::uint32_t place = child;
      for (const detail::BlockTree::Level& level : levels) {
        const detail::BoxRow& row =
            m.side.state().tree_row(w, level.first_row + place / static_cast<std::uint32_t>(n), m.placement);
        worst.take(worst.trees, outside(row.get(place % n), b));
        place /= static_cast<std::uint32_t>(n);
      }
    }
  }
}

Model<Point> model_of(std::size_t links, std::size_t per_link, double size, const Vec3& offset, Random& random) {
  ModelBuilder<Point> builder;
  for (std::size_t l = 0; l < links; ++l) {
    std::vector<Point> points;
    for (std::size_t k = 0; k < per_link; ++k) points.push_back({Vec3(random.vector(size) + offset)});
    builder.add_link(world, Revolute{{0, 0, 1}, offset, {}, {}}, points);
  }
  return builder.finish();
}

/// A random rotation; in half of the cases nearly one with the largest sums of absolute entries.
Mat3 rotation(Random& random) {
  Mat3 r = random.pose(1.0).rotation;
  if (random.one_in(2)) {
    const Vec3 axis = Vec3(Vec3(1, 1, 1) + random.vector(1e-3)).normalized();
    r = rotation_about(axis, std::numbers::pi);  // entries of magnitude 1/3 and 2/3
  }
  return r;
}

/// Random poses: each rigid group rotates about `offset` and moves by up to `travel`.
std::vector<Pose> turned(std::size_t groups, const Vec3& offset, double travel, Random& random) {
  std::vector<Pose> poses(groups);
  for (std::size_t g = 1; g < poses.size(); ++g) {
    poses[g].rotation = rotation(random);
    poses[g].translation = Vec3(offset - poses[g].rotation * offset + random.vector(travel));
  }
  return poses;
}
void turn(Placed& m, const Vec3& offset, double travel, Random& random) {
  m.placement.update_poses(turned(m.selected->groups()->size(), offset, travel, random));
  m.make();
}

TEST(FloatFilter, BandCoversTurnedGroups) {
  Random random(1);
  for (const double far : {0.0, 1e3, 1e6, 1e9, 1e12})
    for (const double travel : {0.0, 1.0, 100.0, 1e6}) {
      Worst worst;
      for (int repetition = 0; repetition < 12; ++repetition) {
        const Vec3 offset = random.vector(far);
        const std::size_t per_link = repetition % 4 == 0   ? 5
                                     : repetition % 4 == 1 ? 16
                                     : repetition % 4 == 2 ? 100
                                     : repetition == 3     ? 4200  // large enough for a tree
                                                           : 600;
        Placed m(model_of(repetition == 3       ? 1
                          : repetition % 4 == 3 ? 3
                                                : 12,
                          per_link, repetition % 2 == 0 ? 1.0 : 30.0, offset, random),
                 false);
        for (int k = 0; k < 6; ++k) {
          turn(m, offset, travel, random);
          check_pairs(m, random, 400, worst);
          check_boxes(m, worst);
        }
      }
      char what[80];
      std::snprintf(what, sizeof what, "turned, %g from the origin, travel %g", far, travel);
      worst.print(what);
    }
}

TEST(FloatFilter, BandCoversConfigurations) {
  Random random(2);
  Worst worst;
  for (int repetition = 0; repetition < 60; ++repetition) {
    const auto model = test::random_model(random, 12, repetition % 3 == 0 ? 60 : 6, false,
                                          [](Random& r, const Vec3&, const Vec3&) { return Point{r.vector(2.0)}; });
    Placed m(model, false);
    std::vector<double> q(m.selected->selection().size());
    for (int k = 0; k < 5; ++k) {
      for (double& value : q) value = random.uniform(-4, 4);
      m.placement.update(q);
      m.make();
      check_pairs(m, random, 200, worst);
      check_boxes(m, worst);
    }
  }
  worst.print("random mechanisms");
}

/// Coordinates from update_placed(). Each is half a float ulp from a float, and rounding pushes all of them outward.
TEST(FloatFilter, BandCoversAlignedRoundings) {
  Random random(3);
  Worst worst;
  for (int repetition = 0; repetition < 200; ++repetition) {
    Placed m(model_of(4, 8, 1.0, Vec3::Zero(), random), true);
    const double scale = m.side.layout().scale, size = std::ldexp(1.0, static_cast<int>(random.below(12))) / scale;
    std::vector<Point> points(m.selected->size());
    for (std::size_t i = 1; i < points.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const double sign = i % 2 == 0 ? 1.0 : -1.0, ulp = size * 0x1p-24;
        const double x = size - ulp * (std::floor(random.uniform(1, 1000)) + 0.499999);
        points[i].position[k] = sign * x;
      }
    m.placement.update_placed(points);
    m.make();
    check_pairs(m, random, 200, worst);
    check_boxes(m, worst);
  }
  worst.print("aligned roundings");
}

/// Two models with different origins and scales; the band is computed as in Simd.
TEST(FloatFilter, BandCoversTwoModels) {
  Random random(4);
  for (const double far : {0.0, 10.0, 1e3, 1e6}) {
    double worst = 0.0;
    for (int repetition = 0; repetition < 40; ++repetition) {
      const Vec3 offset = random.vector(far), away = Vec3(offset + random.vector(10));
      Placed a(model_of(3, repetition % 2 == 0 ? 5 : 40, random.uniform(0.1, 20), offset, random), false),
          b(model_of(3, repetition % 3 == 0 ? 5 : 40, random.uniform(0.1, 20), away, random), false);
      turn(a, offset, 1.0, random);
      turn(b, away, 1.0, random);
      const detail::CrossModelTransform<Point> into(a.side, b.side);
      const double scale = b.side.layout().scale, ratio = static_cast<double>(into.scale);
      for (int k = 0; k < 500; ++k) {
        const std::size_t i = random.below(a.slots()), block = random.below(b.slots()) / n;
        float squared[n];
        into(a.side.state().packed(static_cast<std::uint32_t>(i / n)) + i % n)
            .squared_distances(b.side.state().packed(static_cast<std::uint32_t>(block)))
            .store(squared);
        for (std::size_t lane = 0; lane < n; ++lane) {
          const double d = std::sqrt(squared_norm(Vec3(a.at(i) - b.at(block * n + lane)))) * scale;
          double largest = d;
          for (const float s : into.shift) largest += 2 * std::abs(static_cast<double>(s));
          const double band = b.side.state().band(largest) + 2 * ratio * a.side.state().band(0.0);
          worst = std::max(worst, std::abs(static_cast<double>(std::sqrt(squared[lane])) - d) / band);
        }
      }
    }
    std::printf("two models, %g from the origin: %.3f\n", far, worst);
    EXPECT_LT(worst, 1.0);
  }
}

/// Float rounding of (threshold + margin)^2, of squared distances and of square roots, in units of u.
TEST(FloatFilter, ArithmeticTakesLessThanItsShare) {
  Random random(5);
  double thresholds = 0.0, extras = 0.0, distances = 0.0, roots = 0.0;
  for (int k = 0; k < 2'000'000; ++k) {
    const double t = std::exp(random.uniform(-8, 8)), m = t * std::exp(random.uniform(-20, 2));
    const float row = detail::float_above(t), margin = detail::float_above(m),
                more = detail::float_above(t * random.uniform(0, 1));
    const float near = row + margin, square = near * near;
    const double whole = static_cast<double>(row) + static_cast<double>(margin);
    thresholds = std::max(thresholds, (whole - std::sqrt(static_cast<double>(square))) / (u * whole));
    const float wider = near + more, wide_square = wider * wider;
    const double all = whole + static_cast<double>(more);
    extras = std::max(extras, (all - std::sqrt(static_cast<double>(wide_square))) / (u * all));
    float a[3], b[3], sum = 0.0F;
    double exact = 0.0;
    for (int c = 0; c < 3; ++c) {
      a[c] = static_cast<float>(random.uniform(-4, 4));
      b[c] = static_cast<float>(random.uniform(-4, 4));
      const float d = a[c] - b[c];
      sum += d * d;
      const double e = static_cast<double>(a[c]) - static_cast<double>(b[c]);
      exact += e * e;
    }
    distances = std::max(distances, std::abs(std::sqrt(static_cast<double>(sum) / exact) - 1) / u);
    roots = std::max(roots, std::abs(static_cast<double>(std::sqrt(sum)) / std::sqrt(exact) - 1) / u);
  }
  std::printf(
      "in u: threshold %.3f (counted 1.5), with extra %.3f (2.5), distance %.3f (2.5), its root in float %.3f (3.5); "
      "of 8\n",
      thresholds, extras, distances, roots);
  EXPECT_LT(thresholds, 1.5);
  EXPECT_LT(extras, 2.5);
  EXPECT_LT(distances, 2.5);
  EXPECT_LT(roots, 3.5);
}

/// Queries in float against exact distances: a wrong decision and an undecided pair each need a small gap.
TEST(FloatFilter, BandCoversMeasuredDistances) {
  Random random(6);
  for (const double far : {0.0, 1e3, 1e6, 1e9}) {
    double worst = 0.0;
    std::uint64_t undecided = 0;
    for (int repetition = 0; repetition < 40; ++repetition) {
      const Vec3 offset = random.vector(far);
      const auto model = model_of(6, repetition % 2 == 0 ? 5 : 40, 4.0, offset, random);
      Hierarchy<Point, AdmitAll, UniformClearance> probe(model, AdmitAll{}, UniformClearance(0.0));
      const std::vector<Pose> poses = turned(probe.model().groups()->size(), offset, 4.0, random);
      probe.update_poses(poses);
      const std::vector<Point> at(probe.placed().begin(), probe.placed().end());
      // The threshold plus the margin equals the distance of one pair.
      const double clearance = distance(at.front(), at.back()) * random.uniform(0.2, 1.0);
      const double margin = std::max(0.0, distance(at.front(), at.back()) - clearance), t = clearance + margin;
      Placed m(model, false, clearance);
      m.placement.update_poses(poses);
      m.make();
      const double scale = m.side.layout().scale, band = m.side.state().band(t * scale) / scale;
      Hierarchy<Point, AdmitAll, UniformClearance> h(model, AdmitAll{}, UniformClearance(clearance));
      h.update_poses(poses);
      QueryCounts counts;
      QueryOptions options;
      options.counts = &counts;
      for (const Precision side : {Precision::never_miss, Precision::never_cry_wolf}) {
        options.precision = side;
        std::vector<std::vector<char>> found(at.size(), std::vector<char>(at.size(), 0));
        for (const Hit& hit : h.self_within(margin, options)) {
          const std::size_t i = index(hit.first), j = index(hit.second);
          worst = std::max(worst, std::abs(hit.distance - distance(at[i], at[j])) / band);
          found[i][j] = 1;
        }
        for (std::size_t i = 0; i < at.size(); ++i)
          for (std::size_t j = i + 1; j < at.size(); ++j) {
            if (model.links()[i] == model.links()[j]) continue;
            // Twice the band: a measured distance has an error of one band, and pairs within another band are left
            // undecided.
            const double gap = distance(at[i], at[j]) - t;
            ASSERT_FALSE(gap > 2 * band && found[i][j] == 1) << gap / band;
            ASSERT_FALSE(gap < -2 * band && found[i][j] == 0) << gap / band;
          }
      }
      undecided += counts.undecided;
    }
    std::printf("measured, %g from the origin: %.3f of the band, %d undecided\n", far, worst,
                static_cast<int>(undecided));
    EXPECT_LT(worst, 1.0);
    EXPECT_GE(undecided, 80U);  // the pair at its threshold, for both float precisions
  }
}

}  // namespace float_filter_test
}  // namespace hinge
