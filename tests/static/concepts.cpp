// SPDX-License-Identifier: BSD-3-Clause
// Checks models and non-models of every concept at compile time.
#include <array>
#include <type_traits>
#include <vector>

#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/policy/different_links.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/query/link_pair_hits.hpp"

namespace hinge::static_test {

static_assert(Primitive<Point> && Primitive<Sphere> && Primitive<Capsule> && Primitive<Triangle>);
static_assert(!Primitive<int> && !Primitive<Vec3> && !Primitive<Aabb>);
static_assert(!HasAxisInvariance<Triangle>);

struct MayThrow : Point {
  MayThrow placed(const Pose&) const { return *this; }  // not noexcept
  friend double squared_distance(const MayThrow&, const MayThrow&) noexcept { return 0.0; }
};
static_assert(!Primitive<MayThrow>);

struct SinglePrecision {
  SinglePrecision placed(const Pose&) const noexcept { return *this; }
  Aabb bounds() const noexcept { return {}; }
  friend float squared_distance(const SinglePrecision&, const SinglePrecision&) noexcept { return 0.0F; }
};
static_assert(!Primitive<SinglePrecision>);

struct NoBounds {
  NoBounds placed(const Pose&) const noexcept { return *this; }
  friend double squared_distance(const NoBounds&, const NoBounds&) noexcept { return 0.0; }
};
static_assert(!Primitive<NoBounds>);

struct NoCopy {
  NoCopy() = default;
  NoCopy(NoCopy&&) = default;
  NoCopy& operator=(NoCopy&&) = default;
  NoCopy placed(const Pose&) const noexcept { return {}; }
  Aabb bounds() const noexcept { return {}; }
  friend double squared_distance(const NoCopy&, const NoCopy&) noexcept { return 0.0; }
};
static_assert(!Primitive<NoCopy>);

/// A plain primitive. A derived class adds refinements, each slightly wrong.
struct Plain {
  Plain placed(const Pose&) const noexcept { return *this; }
  Aabb bounds() const noexcept { return {}; }
  friend double squared_distance(const Plain&, const Plain&) noexcept { return 0.0; }
};
template <class P>
concept RefinesNothing = Primitive<P> && !HasClosestPoints<P> && !HasHull<P> && !Certifiable<P> &&
                         !HasAxisInvariance<P> && !ChecksItself<P> && !IsPointLike<P>;
static_assert(!Primitive<int> && RefinesNothing<Plain> && !RefinesNothing<Point>);

struct OnePoint {
  OnePoint placed(const Pose&) const noexcept { return *this; }
  Aabb bounds() const noexcept { return {}; }
  friend double squared_distance(const OnePoint&, const OnePoint&) noexcept { return 0.0; }
  friend Vec3 closest_points(const OnePoint&, const OnePoint&) noexcept { return {}; }  // one point instead of two
  std::array<Vec3, 2> hull() const noexcept { return {}; }                              // without hull_radius
  bool fixed_on_axis(const Vec3&) const noexcept { return true; }                       // without the axis
  int is_valid() const noexcept { return 1; }                                           // not a bool
  static constexpr bool is_point_like = false;
};
static_assert(RefinesNothing<OnePoint>);
static_assert(HasClosestPoints<Point> && HasClosestPoints<Triangle> && HasHull<Sphere> && HasHull<Triangle>);
static_assert(HasAxisInvariance<Point> && ChecksItself<Sphere> && IsPointLike<Point> && !IsPointLike<Sphere>);
static_assert(Certifiable<Point> && Certifiable<Sphere> && Certifiable<Capsule> && Certifiable<Triangle>);
/// Without closest points the motion of a segment cannot be bounded along their direction, so it is not certifiable.
struct Segment : Plain {
  Segment placed(const Pose&) const noexcept { return *this; }
  std::array<Vec3, 2> hull() const noexcept { return {}; }
  double hull_radius() const noexcept { return 0.0; }
  friend double squared_distance(const Segment&, const Segment&) noexcept { return 0.0; }
};
static_assert(HasHull<Segment> && !HasClosestPoints<Segment> && !Certifiable<Segment>);
static_assert(FillsHull<Capsule> && !FillsHull<Segment> && HasSharpHull<Triangle> && !HasSharpHull<Segment>);

static_assert(PairFilter<AdmitAll> && PairFilter<DifferentLinks> && !ListsExclusions<DifferentLinks>);
/// Declares `admits` again, which hides all overloads of the base class.
template <class Stock>
struct OwnOf : Stock {
  bool admits(PrimitiveId, PrimitiveId) const noexcept { return false; }
};
static_assert(PairFilter<OwnOf<AdmitAll>> && !ListsExclusions<OwnOf<AdmitAll>> && !AdmitsLinks<OwnOf<AdmitAll>>);
static_assert(PairFilter<OwnOf<DifferentLinks>> && !AdmitsLinks<OwnOf<DifferentLinks>>);
struct TakesNumbers {
  bool admits(int, int) const noexcept { return true; }
};
struct AnswersInt {
  int admits(PrimitiveId, PrimitiveId) const noexcept { return 1; }
};
struct Mutates {
  bool admits(PrimitiveId, PrimitiveId) noexcept { return true; }
};
struct WordyFilter {
  bool admits(PrimitiveId, PrimitiveId) const noexcept { return true; }
  std::vector<int> excluded(PrimitiveId) const noexcept { return {}; }  // integers are no primitive ids
  int admits(LinkId, LinkId) const noexcept { return 1; }               // not a bool
  int size() const noexcept { return 0; }                               // not a std::size_t
  std::vector<int> links() const noexcept { return {}; }
};
static_assert(PairFilter<WordyFilter> && !ListsExclusions<WordyFilter> && !AdmitsLinks<WordyFilter>);
static_assert(!KnowsSize<WordyFilter> && !KnowsLinks<WordyFilter>);
static_assert(AdmitsLinks<DifferentLinks> && KnowsSize<DifferentLinks> && KnowsLinks<DifferentLinks>);
static_assert(!PairFilter<TakesNumbers> && !PairFilter<AnswersInt> && !PairFilter<Mutates> && !PairFilter<Point>);

static_assert(DistanceMatrix<UniformClearance> && CrossMatrix<TypedThresholds> && KnowsSize<TypedThresholds>);
struct NoReach {
  double threshold(PrimitiveId, PrimitiveId) const noexcept { return 1.0; }
};
struct OwnOnly : NoReach {
  double reach(PrimitiveId) const noexcept { return 0.5; }
};
static_assert(!DistanceMatrix<NoReach> && DistanceMatrix<OwnOnly> && !CrossMatrix<OwnOnly> && !KnowsSize<OwnOnly>);

struct RoundsSums : OwnOnly {
  double sum(PrimitiveId, PrimitiveId) const noexcept { return 1.0; }  // rounded: AdditiveRadii needs the exact sum
};
struct SumsRadii : OwnOnly {
  RadiusSum sum(PrimitiveId, PrimitiveId) const noexcept { return {}; }
};
static_assert(!AdditiveRadii<RoundsSums> && AdditiveRadii<SumsRadii>);

static_assert(Collector<AnyHit> && Collector<HitsWithin> && Collector<Closest>);
struct NeverDone {
  static constexpr bool ranks = false;
  void add(const Hit&) {}
  double cutoff() const noexcept { return 0.0; }
};
static_assert(!Collector<NeverDone>);
struct Plainest : NeverDone {
  bool done() const noexcept { return false; }
  static constexpr bool stops_at_first = false, keeps_smallest = true;  // keeps_smallest without ranks
  void add_measured(const Hit&) {}                                      // without the error
  int wants(LinkId, LinkId) const noexcept { return 1; }                // not a bool
  int smallest(LinkId, LinkId) const noexcept { return 0; }             // not a double
};
static_assert(Collector<Plainest> && !StopsAtFirst<Plainest> && !KeepsSmallest<Plainest>);
static_assert(!RefusesLinks<Plainest> && !KeepsSmallestOfLinks<Plainest> && !detail::TakesMeasured<Plainest>);
static_assert(!detail::AddsMeasured<Plainest>);
static_assert(StopsAtFirst<AnyHit> && KeepsSmallest<Closest> && RefusesLinks<LinkPairHits>);

template <class E, class P>
concept EngineFor = Engine<E, P, AdmitAll, UniformClearance>;
static_assert(EngineFor<Brute<Point, AdmitAll, UniformClearance>, Point>);
static_assert(EngineFor<Lazy<Triangle, AdmitAll, UniformClearance>, Triangle>);
static_assert(!EngineFor<Lazy<Point, AdmitAll, UniformClearance>, Sphere>);
static_assert(EngineFor<Simd<Point, AdmitAll, UniformClearance>, Point>);
static_assert(EngineFor<Simd<Triangle, AdmitAll, UniformClearance>, Triangle>);
static_assert(!EngineFor<detail::LazyTree, Point> && !Engine<Model<Point>, Point, AdmitAll, UniformClearance>);
static_assert(CrossEngine<Lazy<Point, AdmitAll, UniformClearance>, Point, AdmitAll, UniformClearance, AdmitAll>);
static_assert(!CrossEngine<Lazy<Point, AdmitAll, OwnOnly>, Point, AdmitAll, OwnOnly, AdmitAll>);
static_assert(CrossEngine<Simd<Point, AdmitAll, TypedThresholds>, Point, AdmitAll, TypedThresholds, AdmitAll>);
static_assert(!CrossEngine<Simd<Point, AdmitAll, OwnOnly>, Point, AdmitAll, OwnOnly, AdmitAll>);
/// Pair orders can be calibrated against another model with every engine.
template <class P, template <class, class, class> class EngineOf>
using On = Hierarchy<P, AdmitAll, UniformClearance, EngineOf>;
template <class P>
void calibrate(On<P, Simd>& simd, On<P, Lazy>& lazy, On<P, Brute>& brute) {
  simd.calibrate_pair_order(simd);
  lazy.calibrate_pair_order(lazy);
  brute.calibrate_pair_order(brute);
}
template void calibrate(On<Point, Simd>&, On<Point, Lazy>&, On<Point, Brute>&);
template void calibrate(On<Sphere, Simd>&, On<Sphere, Lazy>&, On<Sphere, Brute>&);
template void calibrate(On<Capsule, Simd>&, On<Capsule, Lazy>&, On<Capsule, Brute>&);
template void calibrate(On<Triangle, Simd>&, On<Triangle, Lazy>&, On<Triangle, Brute>&);

static_assert(TypedThresholdMatrix<TypedThresholds> && !TypedThresholdMatrix<UniformClearance>);
static_assert(!AdditiveRadii<TypedThresholds> && !AdditiveRadii<UniformClearance>);
static_assert(detail::TransformsBatch<Point> && detail::TransformsBatch<Capsule> && !detail::TransformsBatch<Triangle>);
static_assert(detail::ComparesTwo<Sphere> && !detail::ComparesTwo<Capsule> && !detail::ComparesTwo<Triangle>);
static_assert(detail::HasSmallHull<Capsule> && !detail::HasSmallHull<Triangle>);
static_assert(detail::MeasuresDistances<Point> && !detail::MeasuresDistances<Sphere>);
static_assert(detail::UsesStaticBvh<Triangle> && !detail::UsesStaticBvh<Capsule>);

static_assert(Id<PrimitiveId> && !Id<int> && !std::is_convertible_v<LinkId, PrimitiveId>);

}  // namespace hinge::static_test
