// SPDX-License-Identifier: BSD-3-Clause
// Tests that callbacks see long work often, end it by an exception, and change no answer.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/read_srdf.hpp"
#include "hinge/robotics/read_urdf.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {
namespace early_end_test {

struct Enough {};

std::shared_ptr<const Robot> arm() {
  return std::make_shared<const Robot>(read_urdf(HINGE_SOURCE_DIR "/robotics/data/arm.urdf"));
}

TEST(EarlyEnd, OfPaths) {
  const auto robot = arm();
  const Srdf srdf = read_srdf(HINGE_SOURCE_DIR "/robotics/data/arm.srdf", *robot);
  PathChecker paths(RobotChecker(robot, tested_pairs(*robot), LinkMargins(*robot)));
  std::vector<double> home(6, 0.0), reach(6, 0.0);
  srdf.configurations.at(0).apply(home);
  srdf.configurations.at(1).apply(reach);
  int calls = 0;
  const RobotPathAnswer alone = paths.certify(home, reach);
  const RobotPathAnswer watched = paths.certify(home, reach, smallest_path_step, [&] { ++calls; });
  EXPECT_EQ(watched.verdict, alone.verdict);
  EXPECT_EQ(watched.counts.configurations, alone.counts.configurations);
  EXPECT_EQ(static_cast<std::uint64_t>(calls), watched.counts.segments);
  EXPECT_THROW(paths.certify(home, reach, smallest_path_step, [] { throw Enough(); }), Enough);
  calls = 0;
  const RobotPathAnswer sampled = paths.sample(home, reach, 0.1, [&] { ++calls; });
  EXPECT_EQ(static_cast<std::uint64_t>(calls), sampled.counts.configurations);
  EXPECT_THROW(paths.sample(home, reach, 0.1, [] { throw Enough(); }), Enough);
  EXPECT_EQ(paths.certify(home, reach).counts.configurations, alone.counts.configurations);
}

TEST(EarlyEnd, OfMatrices) {
  const auto robot = arm();
  const MatrixOptions options{500, 1, 300};
  std::size_t proofs = 0, boxes = 0;
  const auto watched = find_collision_matrix(
      *robot, options, [&](const MatrixProgress& at) { proofs += at.stage == MatrixProgress::Stage::proving ? 1 : 0; });
  const auto alone = find_collision_matrix(*robot, options);
  ASSERT_EQ(watched.entries.size(), alone.entries.size());
  for (std::size_t k = 0; k < alone.entries.size(); ++k) {
    EXPECT_EQ(watched.entries[k].kind, alone.entries[k].kind);
    EXPECT_EQ(watched.entries[k].cells, alone.entries[k].cells);
    boxes += alone.entries[k].cells;
  }
  EXPECT_GE(proofs, boxes / 2);  // a box is divided into two
  for (const auto stage : {MatrixProgress::Stage::sampling, MatrixProgress::Stage::proving})
    EXPECT_THROW(find_collision_matrix(*robot, options,
                                       [&](const MatrixProgress& at) {
                                         if (at.stage == stage) throw Enough();
                                       }),
                 Enough);
}

}  // namespace early_end_test
}  // namespace hinge::robotics
