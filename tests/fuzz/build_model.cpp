// SPDX-License-Identifier: BSD-3-Clause
// Target: builders, policies and updates with arbitrary input. A refusal changes nothing, and accepted input can be
// queried.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "fuzz/bytes.hpp"
#include "fuzz/numbers.hpp"
#include "fuzz/require.hpp"
#include "fuzz/scene.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"

namespace {

using hinge::Vec3;

template <class P>
class Attempt {
 public:
  explicit Attempt(fuzz::Bytes& bytes) : bytes_(bytes), numbers_(bytes) {}

  void run() {
    for (std::size_t k = bytes_.below(64); k-- > 0 && !bytes_.empty();) add_something();
    const std::optional<hinge::Model<P>> model = finish();
    if (!model) return;
    const auto selection = select(model->tree());
    const auto thresholds = make_thresholds(model->size());
    if (!selection || !thresholds) return;
    const fuzz::ExcludedPairs filter(bytes_.one_in(16) ? model->size() + 1 : model->size(), bytes_);
    std::optional<On<hinge::Brute>> brute;
    std::optional<On<hinge::Simd>> simd;
    const bool made = fuzz::accepts([&] { brute.emplace(*model, *selection, filter, *thresholds); });
    fuzz::require(made == fuzz::accepts([&] { simd.emplace(*model, *selection, filter, *thresholds); }),
                  "one engine takes what the other refuses");
    if (!made) return;
    ask(*brute, *simd);
    for (int step = 0; step < 4 && !bytes_.empty(); ++step) update(*brute, *simd);
  }

 private:
  template <template <class, class, class> class EngineOf>
  using On = hinge::Hierarchy<P, fuzz::ExcludedPairs, hinge::TypedThresholds, EngineOf>;

  /// Usually returns a valid number.
  double odd() { return bytes_.one_in(12) ? bytes_.any_double() : numbers_.number(); }
  Vec3 odd_vector() {
    const double x = odd(), y = odd(), z = odd();
    return {x, y, z};
  }
  hinge::Pose odd_pose() {
    hinge::Pose pose;
    if (bytes_.one_in(3)) pose = fuzz::make_pose(numbers_);
    if (bytes_.one_in(12)) pose.rotation *= odd();
    if (bytes_.one_in(12)) pose.translation = odd_vector();
    return pose;
  }
  P odd_primitive();
  hinge::LinkId some_link() {
    const std::size_t links = builder_.tree().link_count();
    return hinge::id<hinge::LinkId>(bytes_.byte() % (links + (bytes_.one_in(12) ? 2 : 0)));
  }
  hinge::Joint odd_joint() {
    switch (bytes_.below(4)) {
      case 0: return hinge::Fixed{odd_pose()};
      case 1: return hinge::Prismatic{odd_vector(), odd_pose(), "slide"};
      default: return hinge::Revolute{odd_vector(), odd_vector(), odd_pose(), "turn"};
    }
  }

  void add_something() {
    const hinge::KinematicTree& tree = builder_.tree();
    const std::array<std::size_t, 3> before{tree.link_count(), tree.dof_count(), tree.closures().size()};
    bool accepted = false;
    switch (bytes_.below(8)) {
      case 0:
      case 1:
      case 2: {
        const hinge::LinkId parent = some_link();
        const hinge::Joint joint = odd_joint();
        std::vector<P> primitives;
        for (std::size_t k = bytes_.below(4); k-- > 0;) primitives.push_back(odd_primitive());
        accepted = fuzz::accepts([&] { builder_.add_link(parent, joint, primitives); });
        if (accepted) expected_ += primitives.size();
        break;
      }
      case 3: {
        const hinge::Closure closure{
            some_link(), some_link(), {odd_vector(), odd_vector()}, {odd_vector(), Vec3()}, {}};
        accepted = fuzz::accepts([&] { builder_.add_closure(closure); });
        break;
      }
      default: {
        const hinge::LinkId link = some_link();
        const P primitive = odd_primitive();
        std::optional<hinge::PrimitiveId> added;
        accepted = fuzz::accepts([&] { added = builder_.add_primitive(link, primitive); });
        if (accepted)
          fuzz::require(hinge::index(*added) == expected_++, "primitives are not numbered as they were added");
      }
    }
    const std::array<std::size_t, 3> after{tree.link_count(), tree.dof_count(), tree.closures().size()};
    if (!accepted) fuzz::require(before == after, "a refusal left something behind");
  }

  std::optional<hinge::Model<P>> finish() {
    std::optional<hinge::Model<P>> model;
    if (bytes_.one_in(4)) {
      std::vector<std::uint32_t> labels(bytes_.one_in(4) ? bytes_.below(8) : expected_);
      for (std::uint32_t& label : labels) label = bytes_.byte() % 5U;
      builder_.set_basic_groups(labels);
      if (fuzz::accepts([&] { model = builder_.finish(); })) return model;
      builder_.set_basic_groups({});
    }
    fuzz::accepts([&] { model = builder_.finish(); });
    if (model) fuzz::require(model->size() == expected_, "a refusal left primitives behind");
    return model;
  }

  std::optional<hinge::DofSelection> select(const hinge::KinematicTree& tree) {
    std::optional<hinge::DofSelection> selection;
    if (!bytes_.one_in(8)) return fuzz::make_selection(tree, bytes_);
    std::vector<hinge::DofId> free;
    for (std::size_t k = bytes_.below(8); k-- > 0;) free.push_back(hinge::id<hinge::DofId>(bytes_.byte() % 8U));
    fuzz::accepts([&] { selection.emplace(tree, free); });
    return selection;
  }

  std::optional<hinge::TypedThresholds> make_thresholds(std::size_t n) {
    if (!bytes_.one_in(4)) return fuzz::ThresholdTable(numbers_).of(n, bytes_);
    std::optional<hinge::TypedThresholds> thresholds;
    const std::size_t types = bytes_.below(3);
    std::vector<double> table(types * types + (bytes_.one_in(8) ? 1 : 0));
    const double same = odd();
    for (double& m : table) m = bytes_.one_in(8) ? odd() : same;
    std::vector<std::uint16_t> type(bytes_.one_in(8) ? n + 1 : n);
    for (std::uint16_t& t : type) t = static_cast<std::uint16_t>(bytes_.one_in(8) ? 2 : 0);
    fuzz::accepts([&] { thresholds.emplace(type, types, table); });
    return thresholds;
  }

  struct Picture {
    std::vector<P> placed;
    std::vector<hinge::Hit> hits;
  };
  static bool same(const P& a, const P& b) {
    return a.bounds().lower == b.bounds().lower && a.bounds().upper == b.bounds().upper;
  }
  template <class H>
  static Picture picture(H& hierarchy) {
    const auto placed = hierarchy.placed();
    return {{placed.begin(), placed.end()}, hierarchy.self_collisions()};
  }

  void update(On<hinge::Brute>& brute, On<hinge::Simd>& simd) {
    const Picture before = picture(simd);
    const std::uint8_t kind = bytes_.byte() % 4;
    const std::size_t off = bytes_.one_in(16) ? 1 : 0;
    const std::size_t groups = brute.model().groups()->size();
    std::vector<double> q(brute.dof_count() + off);
    std::vector<hinge::Pose> poses(groups + off);
    std::vector<P> placed(brute.model().size() + off);
    if (kind == 0) {
      for (std::size_t g = bytes_.one_in(16) ? 0 : 1; g < poses.size(); ++g) poses[g] = odd_pose();
    } else if (kind == 1) {
      for (P& p : placed) p = odd_primitive();
    } else {
      for (double& value : q) value = odd();
    }
    const auto apply = [&](auto& hierarchy) {
      return fuzz::accepts([&] {
        if (kind == 0) return hierarchy.update_poses(poses);
        if (kind == 1) return hierarchy.update_placed(placed);
        hierarchy.update(q);
      });
    };
    const bool accepted = apply(simd);
    fuzz::require(apply(brute) == accepted, "one engine takes what the other refuses");
    if (accepted) return ask(brute, simd);
    const Picture after = picture(simd);
    fuzz::require(
        std::equal(before.placed.begin(), before.placed.end(), after.placed.begin(), same) && before.hits == after.hits,
        "a refused update changed the state");
  }

  void ask(On<hinge::Brute>& brute, On<hinge::Simd>& simd) {
    for (const P& p : simd.placed())
      fuzz::require(hinge::is_finite(p.bounds().lower) && hinge::is_finite(p.bounds().upper),
                    "a placed primitive is not finite");
    std::vector<double> clearance;
    if (bytes_.one_in(4)) {
      clearance.resize(brute.model().groups()->size() + (bytes_.one_in(8) ? 1 : 0));
      for (double& c : clearance) c = odd();
    }
    hinge::QueryOptions options;
    options.clearance = clearance;
    options.moved_only = bytes_.one_in(4);
    const double margin = odd();
    fuzz::accepts([&] {
      const auto hits = simd.self_within(margin, options), expected = brute.self_within(margin, options);
      fuzz::require(std::equal(hits.begin(), hits.end(), expected.begin(), expected.end(),
                               [](const hinge::Hit& a, const hinge::Hit& b) {
                                 return a.first == b.first && a.second == b.second && a.threshold == b.threshold;
                               }),
                    "simd and brute differ in their pairs");
      for (const hinge::Hit& hit : hits) fuzz::require(hit.distance >= 0.0, "a distance that is no number");
    });
    fuzz::accepts([&] {
      fuzz::require(simd.self_collides(options) == !brute.self_collisions(options).empty(),
                    "simd and brute differ in a yes or no");
      fuzz::require(simd.self_closest(options).has_value() == brute.self_closest(options).has_value(),
                    "simd and brute differ in whether there is a closest pair");
    });
    fuzz::require(simd.constant_contacts().size() == brute.constant_contacts().size(),
                  "simd and brute differ in constant contacts");
  }

  fuzz::Bytes& bytes_;
  fuzz::Numbers numbers_;
  hinge::ModelBuilder<P> builder_;
  std::size_t expected_ = 0;  // primitives in the builder
};

template <>
hinge::Sphere Attempt<hinge::Sphere>::odd_primitive() {
  const Vec3 centre = odd_vector();
  return {centre, bytes_.one_in(8) ? odd() : numbers_.positive()};
}
template <>
hinge::Triangle Attempt<hinge::Triangle>::odd_primitive() {
  const Vec3 a = odd_vector(), b = odd_vector();
  return {a, b, odd_vector()};
}
template <>
hinge::Point Attempt<hinge::Point>::odd_primitive() {
  return {odd_vector()};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  switch (bytes.below(3)) {
    case 0: Attempt<hinge::Point>(bytes).run(); break;
    case 1: Attempt<hinge::Sphere>(bytes).run(); break;
    default: Attempt<hinge::Triangle>(bytes).run();
  }
  return 0;
}
