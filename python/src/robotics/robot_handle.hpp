// SPDX-License-Identifier: BSD-3-Clause
// RobotHandle: a robot as Python holds it, and the conversions of its parts.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/robotics/read_srdf.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/shape.hpp"
#include "made_caster.hpp"
#include "run_aside.hpp"

namespace hinge::python {

/// A robot with the contents of its SRDF. Constant, so any thread may use it.
struct RobotHandle {
  using MadeByInit = void;
  std::shared_ptr<const robotics::Robot> robot;
  robotics::Srdf srdf;                   ///< without a file: nothing disabled
  std::optional<std::string> srdf_text;  ///< contents of the SRDF file
  std::vector<std::string> notes;        ///< one sentence each

  const robotics::Robot& operator*() const noexcept { return *robot; }
  const robotics::Robot* operator->() const noexcept { return robot.get(); }
  std::size_t dof() const noexcept { return robot->independent_joints().size(); }
};

/// A shape as Python holds it.
struct ShapeHandle {
  using MadeByInit = void;
  robotics::Shape shape;
};

/// Returns true if the shape has so many parts that work on it is better interruptible.
inline bool is_large(const robotics::Shape& shape) {
  constexpr std::size_t many = 10'000;
  const auto* mesh = std::get_if<robotics::MeshShape>(&shape);
  const auto* cloud = std::get_if<robotics::PointCloudShape>(&shape);
  return (mesh != nullptr && mesh->mesh->triangles.size() > many) || (cloud != nullptr && cloud->points->size() > many);
}

/// Calls work(), which owns what it uses: by run_aside() if the shape is large.
template <class Work>
std::invoke_result_t<Work&> run_if_large(const robotics::Shape& shape, Work work) {
  return is_large(shape) ? run_aside(std::move(work)) : work();
}

/// Returns a pose from a matrix of shape (4, 4) with the last row (0, 0, 0, 1); None is the identity. It is not checked
/// for rigidity. Throws TypeError and ValueError that name the argument.
Pose as_pose(pybind11::handle value, const char* name);

/// Writes a pose as the 16 numbers of a 4 x 4 matrix in C order.
void write_matrix(const Pose& pose, double* matrix) noexcept;

/// Returns the matrix of a pose, shape (4, 4).
pybind11::array_t<double> to_matrix(const Pose& pose);

/// Returns corners of triangles, shape (n, 3, 3).
pybind11::array_t<double> to_corners(const std::vector<Triangle>& triangles);

/// Returns the link with this name. Throws ModelError that names the argument and the robot.
LinkId link_named(const robotics::Robot& robot, const std::string& link, const char* name);

/// Returns pairs of links with geometry or not, from pairs of names. Throws ModelError as link_named().
robotics::LinkPairs link_pairs_named(const robotics::Robot& robot,
                                     const std::vector<std::pair<std::string, std::string>>& pairs, const char* name);

/// Index of a link in the tables of Python, which leave out the world.
inline std::int32_t link_row(LinkId link) noexcept { return static_cast<std::int32_t>(index(link)) - 1; }

void bind_shapes(pybind11::module_& module);
void bind_robot(pybind11::module_& module);
void bind_environment(pybind11::module_& module);
void bind_robot_checker(pybind11::module_& module);

using RobotClass = pybind11::class_<RobotHandle>;
void add_robot_tables(RobotClass& robot);  ///< links, joints, states as columns
void add_matrix(pybind11::module_& module);

}  // namespace hinge::python
