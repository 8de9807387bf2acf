// SPDX-License-Identifier: BSD-3-Clause
// Tests placed parts in queries of many configurations: batches and certified paths.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hinge/batch/state_batch.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/join_structures.hpp"
#include "hinge/molecular/radii.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/path/certified_path.hpp"

namespace hinge::molecular {
namespace placed_path_test {

/// A chain and a shorter, placed chain, with some free torsions. Only pairs between the chains count.
struct Scene {
  Molecule molecule = make();
  DofSelection selection = molecule.select_placed(select_torsions(molecule, "A:2-3,B:chi", false));
  BondExclusions filter{
      molecule.structure(),
      4,
      {},
      PairScope(molecule.structure(),
                std::vector{std::pair(find_part(molecule.structure(), "A"), find_part(molecule.structure(), "B"))},
                {})};
  TypedThresholds thresholds = make_thresholds(molecule.structure()).matrix;

  static Molecule make() {
    Structure second = build_ideal_protein("GWSR", "CCCC");
    for (Vec3& x : second.models[0]) x += Vec3(4, 9, 3);
    Structure both = join_structures({build_ideal_protein("AKFDE", "CCCCC"), std::move(second)});
    const Part placed = find_part(both, "B");
    return Molecule(std::move(both), {.placed = {placed}});
  }
  std::vector<double> sample(std::uint64_t seed, std::uint64_t k, double spread) const {
    return sample_configuration({seed, 0.3 * spread}, k, molecule, selection,
                                std::vector<PlacementRange>{{8.0 * spread, std::numbers::pi * spread}});
  }
};

TEST(PlacedPart, IsAnsweredInBatchesAsAlone) {
  const Scene scene;
  Hierarchy single(scene.molecule.model(), scene.selection, scene.filter, scene.thresholds);
  StateBatch<Point, BondExclusions, TypedThresholds> batch(scene.molecule.model(), scene.selection, scene.filter,
                                                           scene.thresholds);
  std::size_t colliding = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    const auto centre = scene.sample(1, k, 1.0);
    std::vector<double> block;
    for (std::uint64_t lane = 0; lane < 16; ++lane) {
      const auto by = scene.sample(2, 16 * k + lane, 0.02);
      for (std::size_t d = 0; d < centre.size(); ++d) block.push_back(centre[d] + by[d]);
    }
    const detail::simd::Bits hits = batch.collides(block);
    std::vector<std::vector<Hit>> pairs(16);
    batch.collisions(block, [&](std::size_t lane, const Hit& hit) { pairs[lane].push_back(hit); });
    for (std::size_t lane = 0; lane < 16; ++lane) {
      single.update(std::span(block).subspan(lane * centre.size(), centre.size()));
      ASSERT_EQ((hits >> lane & 1U) != 0, single.self_collides()) << k << " " << lane;
      ASSERT_EQ(pairs[lane], single.self_collisions()) << k << " " << lane;
      colliding += pairs[lane].empty() ? 0 : 1;
    }
  }
  EXPECT_GT(batch.counts().in_lanes, batch.counts().alone);
  EXPECT_TRUE(colliding > 320 && colliding < 2880) << colliding;
}

TEST(PlacedPart, IsCertifiedOnItsWay) {
  const Scene scene;
  Hierarchy asked(scene.molecule.model(), scene.selection, scene.filter, scene.thresholds);
  CertifiedPath path(asked);
  int proved = 0, hit = 0;
  for (std::uint64_t k = 0; k < 60; ++k) {
    const auto from = scene.sample(3, 2 * k, 1.0), to = scene.sample(3, 2 * k + 1, 1.0);
    const PathAnswer answer = path.check(from, to);
    if (answer.verdict == PathVerdict::colliding) {
      asked.update(answer.configuration);
      EXPECT_TRUE(asked.self_collides()) << k;
      ++hit;
    } else if (answer.verdict == PathVerdict::free) {
      for (int step = 0; step <= 500; ++step) {
        std::vector<double> q = from;
        for (std::size_t d = 0; d < q.size(); ++d) q[d] += (to[d] - from[d]) * step / 500.0;
        asked.update(q);
        ASSERT_FALSE(asked.self_collides()) << k << " at " << step;
      }
      ++proved;
    }
  }
  EXPECT_GE(proved, 5);
  EXPECT_GE(hit, 5);
  EXPECT_GE(proved + hit, 58);
}

}  // namespace placed_path_test
}  // namespace hinge::molecular
