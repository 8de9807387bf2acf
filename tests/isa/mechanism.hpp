// SPDX-License-Identifier: BSD-3-Clause
// Runs every query on random mechanisms and folds the answers into three hashes: poses, verdicts with their pairs, and
// distances. No compiler option may change the verdicts.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "hinge/hierarchy.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::isa {

/// 64-bit FNV-1a, byte by byte, lowest byte first.
class Hash {
 public:
  void add(std::uint64_t word) noexcept {
    for (int k = 0; k < 8; ++k) {
      value_ = (value_ ^ (word & 0xffU)) * 0x100000001b3ULL;
      word >>= 8;
    }
  }
  void add(double x) noexcept { add(std::bit_cast<std::uint64_t>(x)); }
  void add(const Pose& pose) noexcept {
    for (int k = 0; k < 3; ++k)
      for (int r = 0; r < 3; ++r) add(pose.rotation(r, k));
    for (int k = 0; k < 3; ++k) add(pose.translation[k]);
  }
  std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

/// Random numbers that are equal everywhere: standard distributions and the evaluation order of arguments differ
/// between compilers.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + product(high - low, static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  Vec3 vector(double size) {
    Vec3 v;
    for (int k = 0; k < 3; ++k) v[k] = uniform(-size, size);
    return v;
  }
  Pose pose(double size) {
    Pose pose;
    Vec3 axis = vector(1.0);
    const double length = std::sqrt(squared_norm(axis));
    for (int k = 0; k < 3; ++k) axis[k] /= length;
    pose.rotation = rotation_about(axis, uniform(-3.0, 3.0));
    pose.translation = vector(size);
    return pose;
  }

 private:
  /// Not inlined, so that the product is rounded before the addition even if the compiler may contract.
  [[gnu::noinline]] static double product(double a, double b) { return a * b; }

  std::mt19937_64 engine_;
};

/// A filter that excludes about a twelfth of the pairs.
struct TwelfthExcluded {
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    return (index(i) < index(j) ? 5 * index(i) + 7 * index(j) : 5 * index(j) + 7 * index(i)) % 12 != 0;
  }
};

inline Point primitive(Random& random, const Vec3& at, const Point*) { return Point{at + random.vector(2.0)}; }
inline Sphere primitive(Random& random, const Vec3& at, const Sphere*) {
  const Vec3 center = at + random.vector(2.0);
  return Sphere{center, random.uniform(0.0, 0.5)};
}
inline Triangle primitive(Random& random, const Vec3& at, const Triangle*) {
  const Vec3 a = at + random.vector(2.0);
  const Vec3 b = a + random.vector(0.8);
  return Triangle{a, b, Vec3(a + random.vector(0.8))};
}
inline Capsule primitive(Random& random, const Vec3& at, const Capsule*) {
  const Vec3 a = at + random.vector(2.0);
  const Vec3 b = a + random.vector(0.8);
  return Capsule{a, b, random.uniform(0.0, 0.3)};
}

/// A world with `on_world` primitives and a chain of links with branches. Links have one to eight primitives; one has
/// `large`.
template <class P>
Model<P> random_model(Random& random, std::size_t links, std::size_t on_world, std::size_t large) {
  ModelBuilder<P> builder;
  std::vector<LinkId> all{world};
  const P* kind = nullptr;
  for (std::size_t k = 0; k < on_world; ++k) builder.add_primitive(world, primitive(random, random.vector(7.0), kind));
  for (std::size_t l = 0; l < links; ++l) {
    const Vec3 axis = random.vector(1.0);
    const Vec3 middle = random.vector(4.0);
    Pose origin;
    if (random.below(3) == 0) origin = random.pose(2.0);
    const LinkId parent = random.below(4) == 0 ? all[random.below(all.size())] : all.back();
    const std::size_t choice = random.below(8);
    Joint joint = Revolute{axis, middle, origin, {}};
    if (choice == 0) joint = Prismatic{axis, origin, {}};
    if (choice == 1) joint = Fixed{origin};
    all.push_back(builder.add_link(parent, joint));
    const std::size_t count = l == links / 2 ? large : 1 + random.below(8);
    for (std::size_t k = 0; k < count; ++k) {
      Vec3 at = middle;
      if (count == large) at += random.vector(3.0);
      builder.add_primitive(all.back(), primitive(random, at, kind));
    }
  }
  return builder.finish();
}

/// Hashes: verdicts are indices and yes or no; poses and distances are rounded numbers.
struct Answers {
  Hash poses, verdicts, distances;

  void add_verdict(bool yes) { verdicts.add(static_cast<std::uint64_t>(yes)); }
  void add_pairs(const std::vector<Hit>& hits) {
    verdicts.add(static_cast<std::uint64_t>(hits.size()));
    for (const Hit& hit : hits) {
      verdicts.add(static_cast<std::uint64_t>(index(hit.first)) << 32 | index(hit.second));
      distances.add(hit.distance);
      distances.add(hit.threshold);
    }
  }
  /// Adds the gap, but not the pair, because several pairs may be equally close.
  void add_closest(const std::optional<Hit>& hit) { distances.add(hit ? hit->gap() : 1e300); }
};

template <class H>
void ask(H& model, H& other, const QueryOptions& options, const QueryOptions& across, Answers& answers) {
  const auto tree_size = model.model().model().tree().link_count();
  for (std::size_t l = 0; l < tree_size; ++l) answers.poses.add(model.link_pose(id<LinkId>(l)));
  answers.add_verdict(model.self_collides(options));
  answers.add_pairs(model.self_collisions(options));
  answers.add_pairs(model.self_within(0.4, options));
  answers.add_closest(model.self_closest(options));
  answers.add_verdict(model.collides(other, TwelfthExcluded{}, across));
  answers.add_pairs(model.collisions(other, TwelfthExcluded{}, across));
  answers.add_pairs(other.within(model, 0.3));
  answers.add_closest(model.closest(other, TwelfthExcluded{}, across));
}

/// Runs all updates and all queries of a hierarchy.
template <class P, class F, class D, template <class, class, class> class EngineOf>
Answers answers_of(std::uint64_t seed, const Model<P>& model, const F& filter, const D& matrix, int configurations) {
  Random random(seed);
  Answers answers;
  std::vector<DofId> free;
  for (std::size_t k = 0; k < model.tree().dof_count(); ++k)
    if (k % 7 != 3) free.push_back(id<DofId>(k));
  Hierarchy<P, F, D, EngineOf> h(model, DofSelection(model.tree(), std::move(free)), filter, matrix);
  auto other = h;
  std::vector<double> q(h.dof_count(), 0.0), clearance(h.model().groups()->size());
  for (int step = 0; step < configurations; ++step) {
    QueryOptions options, across;
    const double range = step % 9 == 8 ? 0x1p22 : step % 2 == 0 ? 3.2 : 0.2;
    if (step % 3 == 2) {  // small moves
      for (int k = 0; k < 3; ++k) q[random.below(q.size())] = random.uniform(-range, range);
      options.moved_only = across.moved_only = true;
    } else {
      for (double& value : q) value = random.uniform(-range, range);
    }
    if (step % 4 == 1) {
      for (double& value : clearance) value = random.uniform(0.0, 0.4);
      options.clearance = clearance;
      across.other_clearance = clearance;
    }
    h.update(q);
    ask(h, other, options, across, answers);
    if (step % 5 == 4) other.update(q);
    if (step % 6 == 5) {
      std::vector<Pose> poses(h.model().groups()->size());
      for (std::size_t g = 1; g < poses.size(); ++g) poses[g] = random.pose(4.0);
      h.update_poses(poses);
      ask(h, other, options, across, answers);
    }
    if (step % 7 == 6) {
      const std::vector<P> placed(h.placed().begin(), h.placed().end());
      other.update_placed(placed);
      answers.add_pairs(other.self_collisions());
      answers.add_closest(other.self_closest());
    }
  }
  return answers;
}

/// Returns random thresholds of up to 0.8, some of them 0.
inline TypedThresholds thresholds(std::size_t n, std::size_t types, Random& random) {
  std::vector<std::uint16_t> type(n);
  for (auto& t : type) t = static_cast<std::uint16_t>(random.below(types));
  std::vector<double> table(types * types);
  for (std::size_t s = 0; s < types; ++s)
    for (std::size_t t = 0; t <= s; ++t)
      table[s * types + t] = table[t * types + s] = random.below(6) == 0 ? 0.0 : random.uniform(0.0, 0.8);
  return {std::move(type), types, std::move(table)};
}

}  // namespace hinge::isa
