// SPDX-License-Identifier: BSD-3-Clause
// Target: URDF files, from reading to the answers of a robot. A mesh is in the same folder.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "fuzz/bytes.hpp"
#include "fuzz/check_robot.hpp"
#include "fuzz/require.hpp"
#include "fuzz/scratch_file.hpp"
#include "hinge/robotics/read_urdf.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace robotics = hinge::robotics;
  static const fuzz::ScratchFile mesh("mesh.stl",
                                      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                      "vertex 0 1 0\nendloop\nendfacet\nendsolid\n");
  const fuzz::ScratchFile file("robot.urdf", fuzz::Bytes(data, size).text());
  fuzz::accepts([&] {
    robotics::RobotDescription description = robotics::read_urdf(file.path(), {{file.path().parent_path()}});
    const auto robot = std::make_shared<const robotics::Robot>(std::move(description));
    fuzz::require(
        robot->lower().size() == robot->upper().size() && robot->lower().size() == robot->independent_joints().size(),
        "a joint without limits");
    std::vector<double> q(robot->independent_joints().size(), 0.0);
    const robotics::LinkPairs none(robot->link_count());
    fuzz::check_robot(robot, none, q);
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = robot->lower()[k] + 0.7 * (robot->upper()[k] - robot->lower()[k]);
    fuzz::check_robot(robot, none, q);
  });
  return 0;
}
