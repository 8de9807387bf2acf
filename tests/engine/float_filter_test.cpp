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
#include <set>
#include <utility>
#include <vector>

#include "engine/model_in_blocks.hpp"
#include "engine/random_mechanism.hpp"
#include "hinge/detail/engine/simd/cross_model_transform.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/sphere.hpp"

namespace hinge {
namespace float_filter_test {

using test::Random;
constexpr std::size_t n = detail::simd::width;
constexpr double u = 0x1p-24;

using Placed = test::ModelInBlocks<Point>;

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
    detail::Batch<Point>::One(m.floats(i)).squared_distances(m.floats(b * n)).store(squared);
    const Vec3 x = m.primitive(i).position;
    for (std::size_t lane = 0; lane < n; ++lane) {
      const double d = std::sqrt(squared_norm(Vec3(x - m.primitive(b * n + lane).position))) * scale;
      const double share = std::abs(static_cast<double>(std::sqrt(squared[lane])) - d) / m.side.blocks().band(d);
      worst.take(m.rigid(i) && m.rigid(b * n) ? worst.rigid : worst.mixed, share);
    }
  }
}

/// How far points are outside their float boxes. Each of two boxes may use half of the band.
void check_boxes(Placed& m, Worst& worst) {
  const detail::BlockLayout& layout = m.side.layout();
  const double half_band = m.side.blocks().band(0.0) / 2;
  const auto outside = [&](const detail::FloatBox& box, std::uint32_t block) {
    double out = 0.0;
    for (std::size_t lane = 0; lane < n; ++lane)
      for (int k = 0; k < 3; ++k) {
        const double x = (m.primitive(block * n + lane).position[k] - m.side.blocks().origin()[k]) * layout.scale;
        const auto axis = static_cast<std::size_t>(k);
        out = std::max({out, x - static_cast<double>(box.upper[axis]), static_cast<double>(box.lower[axis]) - x});
      }
    return out / half_band;
  };
  for (std::size_t w = 0; w < layout.entries.size(); ++w) {
    const detail::SweepEntry& unit = layout.entries[w];
    for (std::uint32_t b = unit.first_block; b < unit.first_block + unit.block_count; ++b) {
      worst.take(worst.boxes, outside(m.side.blocks().entries().get(w), b));
      if (unit.block_count == 1) continue;
      const std::uint32_t child = b - unit.first_block;
      const auto& levels = m.side.parts().rigid.tree[w].levels;
      std::uint32_t place = child;
      for (const detail::BlockTree::Level& level : levels) {
        const detail::BoxRow& row =
            m.side.blocks().tree_row(w, level.first_row + place / static_cast<std::uint32_t>(n), m.state);
        worst.take(worst.trees, outside(row.get(place % n), b));
        place /= static_cast<std::uint32_t>(n);
      }
    }
  }
}

Model<Point> model_of(std::size_t links, std::size_t per_link, double size, const Vec3& offset, Random& random) {
  return test::separate_links<Point>(links, per_link, offset, random,
                                     [&](Random& r, const Vec3& at) { return Point{r.vector(size) + at}; });
}

void turn(Placed& m, const Vec3& offset, double travel, Random& random) {
  m.state.update_poses(test::turned(m.selected->groups()->size(), offset, travel, random));
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
      m.state.update(q);
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
    m.state.update_placed(points);
    m.make();
    check_pairs(m, random, 200, worst);
    check_boxes(m, worst);
  }
  worst.print("aligned roundings");
}

/// For balls and capsules: the float bound of a distance may exceed the distance by at most the band.
template <class P, class Make>
void check_bounds(const char* what, const Make& make) {
  Random random(7);
  double worst = 0.0;
  std::size_t pairs = 0, loose = 0;
  for (const double far : {0.0, 1e3, 1e6, 1e9})
    for (int repetition = 0; repetition < 60; ++repetition) {
      const Vec3 offset = random.vector(far);
      const std::size_t per_link = repetition % 3 == 0 ? 5 : repetition % 3 == 1 ? 16 : 100;
      test::ModelInBlocks<P> m(test::separate_links<P>(6, per_link, offset, random, make), false);
      m.state.update_poses(test::turned(m.selected->groups()->size(), offset, 4.0, random));
      m.make();
      const double scale = m.side.layout().scale;
      using Batch = detail::Batch<P>;
      for (int k = 0; k < 200; ++k) {
        const std::size_t i = random.below(m.slots()), first = random.below(m.slots()) / n * n;
        const typename Batch::One one(m.floats(i));
        alignas(64) float squared[n];
        one.squared_distances(m.floats(first)).store(squared);
        for (std::size_t lane = 0; lane < n; ++lane) {
          if (i == first + lane) continue;
          const double d = distance(m.primitive(i), m.primitive(first + lane)) * scale;
          const auto limit = [&](double x) {
            const float f = detail::float_above(x);
            return detail::simd::Float16(Batch::squared_limits ? f * f : f);
          };
          const double band = m.side.blocks().band(d);
          // A pair at exactly its threshold is never ruled out.
          EXPECT_NE(one.near(m.floats(first), limit(d + band)) >> lane & 1U, 0U) << what;
          const double bound = std::sqrt(static_cast<double>(squared[lane])) -
                               static_cast<double>(m.floats(i)[Batch::coordinates]) -
                               static_cast<double>(m.floats(first + lane)[Batch::coordinates]);
          if (!std::isnan(bound)) worst = std::max(worst, (bound - d) / band);
          // Pairs that are well apart are ruled out: a filter that rules out nothing would be useless.
          if (d < 1.0) continue;
          ++pairs;
          loose += (one.near(m.floats(first), limit(0.99 * d)) >> lane & 1U) != 0 ? 1 : 0;
        }
      }
    }
  std::printf("%s: %.3f of the band, %zu of %zu bounds more than 1 %% too small\n", what, worst, loose, pairs);
  EXPECT_LT(worst, 1.0) << what;
  EXPECT_LT(100 * loose, pairs) << what;
}

TEST(FloatFilter, BandCoversBalls) {
  check_bounds<Sphere>("balls", [](Random& r, const Vec3& at) {
    return Sphere{r.vector(4.0) + at, std::exp(r.uniform(-8, 1))};
  });
}

TEST(FloatFilter, BandCoversCapsules) {
  check_bounds<Capsule>("capsules", [](Random& r, const Vec3& at) {
    const Vec3 a = r.vector(4.0) + at;
    return Capsule{a, r.one_in(8) ? a : Vec3(a + r.vector(std::exp(r.uniform(-6, 2)))), std::exp(r.uniform(-8, 1))};
  });
}

/// Segments that are nearly parallel, cross, or share a point have no certain direction to measure in.
TEST(FloatFilter, BandCoversCapsulesInLine) {
  check_bounds<Capsule>("capsules along one line", [](Random& r, const Vec3& at) {
    const Vec3 along(1, 1, 0), off = r.one_in(2) ? Vec3(r.vector(1e-5)) : Vec3(0, 0, r.uniform(-1, 1));
    const Vec3 a = along * r.uniform(-4, 4) + off + at;
    return Capsule{a, a + along * r.uniform(-1, 1) + (r.one_in(2) ? Vec3(r.vector(1e-6)) : Vec3(0, 0, 0)),
                   r.one_in(2) ? 0.0 : 1e-3};
  });
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
        into(a.floats(i)).squared_distances(b.floats(block * n)).store(squared);
        for (std::size_t lane = 0; lane < n; ++lane) {
          const double d =
              std::sqrt(squared_norm(Vec3(a.primitive(i).position - b.primitive(block * n + lane).position))) * scale;
          double largest = d;
          for (const float s : into.shift) largest += 2 * std::abs(static_cast<double>(s));
          const double band = b.side.blocks().band(largest) + 2 * ratio * a.side.blocks().band(0.0);
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

/// Takes every pair that may lie within the cutoff.
struct Measured {
  static constexpr bool ranks = false;
  double margin;
  std::vector<Hit> hits{};
  std::vector<double> errors{};
  int exact = 0;

  void add(const Hit&) { ++exact; }
  void add_measured(const Hit& hit, double error) {
    hits.push_back(hit);
    errors.push_back(error);
  }
  double cutoff() const noexcept { return margin; }
  bool done() const noexcept { return false; }
};

TEST(FloatFilter, BandCoversMeasuredDistances) {
  Random random(6);
  for (const double far : {0.0, 1e3, 1e6, 1e9}) {
    double worst = 0.0;
    std::size_t extra = 0;
    for (int repetition = 0; repetition < 40; ++repetition) {
      const Vec3 offset = random.vector(far);
      const auto model = model_of(6, repetition % 2 == 0 ? 5 : 40, 4.0, offset, random);
      Hierarchy<Point, AdmitAll, UniformClearance> probe(model, AdmitAll{}, UniformClearance(0.0));
      const std::vector<Pose> poses = test::turned(probe.model().groups()->size(), offset, 4.0, random);
      probe.update_poses(poses);
      const std::vector<Point> at(probe.placed().begin(), probe.placed().end());
      // The threshold plus the margin equals the distance of one pair.
      const double clearance = distance(at.front(), at.back()) * random.uniform(0.2, 1.0);
      const double margin = std::max(0.0, distance(at.front(), at.back()) - clearance), t = clearance + margin;
      Hierarchy<Point, AdmitAll, UniformClearance> h(model, AdmitAll{}, UniformClearance(clearance));
      h.update_poses(poses);
      Measured measured{margin};
      h.self_query(measured);
      ASSERT_EQ(measured.exact, 0);
      std::set<std::pair<PrimitiveId, PrimitiveId>> found;
      for (std::size_t k = 0; k < measured.hits.size(); ++k) {
        const Hit& hit = measured.hits[k];
        const double d = distance(at[index(hit.first)], at[index(hit.second)]);
        worst = std::max(worst, std::abs(hit.distance - d) / measured.errors[k]);
        ASSERT_LT(hit.distance - measured.errors[k], t);
        ASSERT_TRUE(found.emplace(hit.first, hit.second).second);
      }
      const std::vector<Hit> exact = h.self_within(margin);
      for (const Hit& hit : exact) ASSERT_TRUE(found.contains({hit.first, hit.second}));
      extra += found.size() - exact.size();
    }
    std::printf("measured, %g from the origin: %.3f of the band, %zu pairs beyond the exact ones\n", far, worst, extra);
    EXPECT_LT(worst, 1.0);
    EXPECT_GE(extra, 10U);  // the pair at its threshold
  }
}

}  // namespace float_filter_test
}  // namespace hinge
