// SPDX-License-Identifier: BSD-3-Clause
// Runs robocd on a small robot whose distances are known.
#pragma once

#include <array>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "robotics/robots.hpp"
#include "tool/run_tool.hpp"

namespace hinge::test {

/// Runs robocd; see run_tool.
inline Said run_robocd(const std::string& arguments, const std::string& environment = "") {
  return run_tool(HINGE_ROBOCD, arguments, environment);
}

/// Returns a binary STL of an axis-parallel cube with outward normals. half: half the edge length.
inline std::string cube_stl(const Vec3& center, double half) {
  constexpr std::array<std::array<unsigned, 3>, 12> corners = {{{0, 2, 3},
                                                                {0, 3, 1},
                                                                {4, 5, 7},
                                                                {4, 7, 6},
                                                                {0, 1, 5},
                                                                {0, 5, 4},
                                                                {2, 6, 7},
                                                                {2, 7, 3},
                                                                {0, 4, 6},
                                                                {0, 6, 2},
                                                                {1, 3, 7},
                                                                {1, 7, 5}}};
  std::string bytes(80, ' ');
  bytes += std::string("\x0c\0\0\0", 4);
  for (const auto& triangle : corners) {
    std::array<float, 12> numbers{};  // the normal is not read
    for (std::size_t v = 0; v < 3; ++v)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double sign = (triangle[v] >> axis & 1U) != 0 ? 1.0 : -1.0;
        numbers[3 + 3 * v + axis] = static_cast<float>(center[static_cast<Eigen::Index>(axis)] + sign * half);
      }
    std::array<char, 50> record{};
    std::memcpy(record.data(), numbers.data(), sizeof numbers);
    bytes.append(record.data(), record.size());
  }
  return bytes;
}

/// base: a cube with half edge 0.125 m (a mesh), fixed to the world. upper: a box of edge 0.125 m at x = 1, rotating
/// about z (shoulder, continuous). fore: the same box at x = 1.5 + elbow in the rotated frame. camera: a ball of radius
/// 0.0625 m half a metre above fore, fixed to it. mast: the same box at z = 1.25 + elbow / 2; its joint mimics the
/// elbow.
/// Tested pairs: base fore, base camera, upper mast, fore mast, camera mast. All numbers are exact in binary.
inline constexpr const char* arm_urdf = R"(<robot name="arm">
  <link name="base"><collision><geometry><mesh filename="cube.stl"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="1 0 0"/><geometry><box size="0.125 0.125 0.125"/></geometry></collision></link>
  <link name="fore"><collision><geometry><box size="0.125 0.125 0.125"/></geometry></collision></link>
  <link name="camera"><collision><geometry><sphere radius="0.0625"/></geometry></collision></link>
  <link name="mast"><collision><geometry><box size="0.125 0.125 0.125"/></geometry></collision></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="prismatic"><parent link="upper"/><child link="fore"/><origin xyz="1.5 0 0"/>
    <axis xyz="1 0 0"/><limit lower="-1.5" upper="1" effort="1" velocity="1"/></joint>
  <joint name="mount" type="fixed"><parent link="fore"/><child link="camera"/><origin xyz="0 0 0.5"/></joint>
  <joint name="follower" type="prismatic"><parent link="base"/><child link="mast"/><origin xyz="0 0 1"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
    <mimic joint="elbow" multiplier="0.5" offset="0.25"/></joint>
</robot>
)";

/// SRDF of the arm: two groups, a state of each, one disabled pair.
inline constexpr const char* arm_srdf = R"(<robot name="arm">
  <group name="all"><joint name="shoulder"/><joint name="elbow"/></group>
  <group name="slide"><joint name="elbow"/></group>
  <group_state name="turned" group="all"><joint name="shoulder" value="0.5"/><joint name="elbow" value="0.25"/></group_state>
  <group_state name="in" group="slide"><joint name="elbow" value="-1.4"/></group_state>
  <disable_collisions link1="base" link2="camera" reason="Never"/>
</robot>
)";

/// A temporary folder with the arm's files.
class ArmFolder : public TemporaryFolder {
 public:
  ArmFolder() {
    write("cube.stl", cube_stl(Vec3::Zero(), 0.125));
    write("arm.urdf", arm_urdf);
    write("arm.srdf", arm_srdf);
  }
  /// Returns the quoted path after a space.
  std::string file(const std::string& name) const { return " '" + (path() / name).string() + "'"; }
  std::string urdf() const { return file("arm.urdf"); }
};

}  // namespace hinge::test
