// SPDX-License-Identifier: BSD-3-Clause
// Frames updated by accepted moves stay within the proven error of forward kinematics. Settled frames have the bits
// of forward kinematics.
#include "hinge/detail/moves/move_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/moves/move_cut.hpp"
#include "hinge/detail/moves/placing_bounds.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge {
namespace move_frames_test {

constexpr std::uint64_t seed = 2006;

TEST(MoveFrames, StayWithinTheirBound) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  test::Random random(seed);
  double worst = 0.0;
  std::size_t settled = 0;
  const int rounds = std::getenv("HINGE_TEST_ALL") != nullptr ? 300 : 30;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    const auto point = [](test::Random& from, const Vec3&, const Vec3&) { return Point{from.vector(1.0)}; };
    const auto model = test::random_model(random, 80, 3, false, point);
    const SelectedModel<Point> selected(model, test::random_selection(model.tree(), random));
    const RigidGroups& groups = *selected.groups();
    const std::size_t dofs = groups.size() - 1;
    if (dofs == 0) continue;
    const detail::PlacingBounds bounds(selected, 10.0);
    detail::MoveCut cut(groups, dofs);
    detail::MoveFrames moved(selected.groups(), cut.parts()), fresh = moved;
    std::vector<double> q(dofs, 0.0);
    moved.set(q, cut.parts());
    for (int step = 0; step < 80; ++step) {
      std::vector<DofChange> changes;
      for (std::size_t k = 1 + random.below(3); k-- > 0;) {
        const std::size_t dof = random.below(dofs);
        if (std::ranges::any_of(changes, [&](const DofChange& c) { return c.dof == dof; })) continue;
        const double turned = random.one_in(10) ? random.uniform(-1e7, 1e7) : random.uniform(-3.0, 3.0);
        changes.push_back({dof, cut.is_slide(dof) ? random.uniform(-10.0, 10.0) : turned});
      }
      std::vector<double> after = q;
      for (const DofChange& change : changes) after[change.dof] = change.value;
      fresh.set(after, cut.parts());
      cut.cut(changes);
      moved.try_values(cut.values(), cut.parts());
      for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::uint32_t place = cut.parts().place(id<GroupId>(g));
        const Pose near = moved.moved(place, cut.parts().part_of(place)).pose(), exact = fresh.frame(place).pose();
        for (const PrimitiveId i : selected.primitives_of(id<GroupId>(g))) {
          const Vec3& x = selected.primitives()[index(i)].position;
          const double off = norm(Vec3(near * x - exact * x));
          worst = std::max(worst, off / bounds.motion_error());
          ASSERT_LE(off, bounds.motion_error());
        }
        if (random.one_in(200)) {
          ASSERT_EQ(moved.tried(place, cut.parts()).column, fresh.frame(place).column);
          ++settled;
        }
      }
      if (random.one_in(3)) {
        moved.undo();
        continue;
      }
      moved.keep(cut.parts());
      q = after;
      if (!random.one_in(40)) continue;
      moved.settle(cut.parts());
      for (std::uint32_t p = 0; p < groups.size(); ++p) ASSERT_EQ(moved.frame(p).column, fresh.frame(p).column);
      ++settled;
    }
  }
  std::printf("worst error: %.2g of the bound\n", worst);
  EXPECT_GT(worst, 1e-6);  // the compared frames were not identical
  EXPECT_GT(settled, 0U);
}

}  // namespace move_frames_test
}  // namespace hinge
