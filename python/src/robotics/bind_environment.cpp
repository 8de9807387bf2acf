// SPDX-License-Identifier: BSD-3-Clause
// Environments: bodies that are added, removed, moved, attached and allowed to touch. Python names bodies by strings,
// this file by the numbers that the library gives them.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <tuple>
#include <utility>

#include "environment_handle.hpp"
#include "hinge/core/error.hpp"
#include "robot_handle.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

namespace {

BodyId as_body(std::uint32_t number) { return BodyId{number}; }

std::optional<std::vector<LinkId>> as_links(const Robot& robot, const std::optional<std::vector<std::string>>& names,
                                            const char* name) {
  if (!names) return {};
  std::vector<LinkId> links;
  for (const std::string& link : *names) links.push_back(link_named(robot, link, name));
  return links;
}

std::uint32_t add(EnvironmentHandle& self, const ShapeHandle& shape, const py::object& pose, const std::string& name) {
  const Pose at = as_pose(pose, "pose");
  BodyId body{};
  const auto add_to = [shape = shape.shape, at, name, tessellation = self.tessellation()](Environment& bodies) {
    return bodies.add(shape, at, name, tessellation);
  };
  self.rebuild([&](Environment& bodies) {
    if (!is_large(shape.shape)) {
      body = add_to(bodies);
      return;
    }
    std::tie(bodies, body) = run_aside([copy = bodies, add_to]() mutable {
      const BodyId added = add_to(copy);
      return std::pair(std::move(copy), added);
    });
  });
  return static_cast<std::uint32_t>(body);
}

Pose pose_of(EnvironmentHandle& self, std::uint32_t body) {
  const EnvironmentHandle::Use use(&self);
  return self.bodies().pose(as_body(body));
}

void set_pose(EnvironmentHandle& self, std::uint32_t body, const py::object& pose) {
  const Pose at = as_pose(pose, "pose");
  self.change([body, at](Environment& bodies) { bodies.set_pose(as_body(body), at); });
}

void attach(EnvironmentHandle& self, std::uint32_t body, const RobotHandle& robot, const std::string& link,
            const py::object& pose, const std::optional<std::vector<std::string>>& may_touch) {
  const Pose in_link = as_pose(pose, "pose");
  const LinkId to = link_named(*robot, link, "link");
  const auto links = as_links(*robot, may_touch, "may_touch");
  self.change([body, robot = robot.robot, to, in_link, links](Environment& bodies) {
    bodies.attach(as_body(body), robot, to, in_link, links);
  });
}

/// pose: where the body stands afterwards; nothing: where it stood before it was attached.
void detach(EnvironmentHandle& self, std::uint32_t body, const py::object& pose) {
  const Pose at = pose.is_none() ? pose_of(self, body) : as_pose(pose, "pose");
  if (!is_rigid(at)) throw ConfigurationError("pose: not a rigid placement (finite, R R^T = 1, det 1)");
  self.change([body, at](Environment& bodies) {
    bodies.detach(as_body(body));
    bodies.set_pose(as_body(body), at);  // a copy has the pose of its last query
  });
}

void allow(EnvironmentHandle& self, std::uint32_t body, const RobotHandle& robot,
           const std::vector<std::string>& names) {
  const auto links = *as_links(*robot, names, "links");
  self.change([body, robot = robot.robot, links](Environment& bodies) { bodies.allow(as_body(body), robot, links); });
}

}  // namespace

void bind_environment(py::module_& module) {
  py::class_<EnvironmentHandle, std::shared_ptr<EnvironmentHandle>>(module, "EnvironmentBase",
                                                                    "An environment; see Environment.")
      .def(py::init([](double clearance, const std::string& engine, const std::string& primitives, double tolerance) {
        Tessellation tessellation;
        if (primitives == "reference") tessellation.manner = Tessellation::Manner::inscribed;
        tessellation.tolerance = tolerance;
        return std::make_shared<EnvironmentHandle>(clearance, engine, tessellation);
      }))
      .def("_add", &add)
      .def("_remove",
           [](EnvironmentHandle& self, std::uint32_t body) {
             self.rebuild([&](Environment& bodies) { bodies.remove(as_body(body)); });
           })
      .def("_set_pose", &set_pose)
      .def("_pose", [](EnvironmentHandle& self, std::uint32_t body) { return to_matrix(pose_of(self, body)); })
      .def("_attach", &attach)
      .def("_detach", &detach)
      .def("_allow", &allow)
      .def_property_readonly(
          "clearance", [](const EnvironmentHandle& self) { return self.bodies().clearance(); },
          "Distance that bodies keep from robots and from held bodies, m.")
      .def_property_readonly(
          "engine", [](const EnvironmentHandle& self) { return self.bodies().engine(); },
          "Name of the engine: that of every checker of the environment.");
}

}  // namespace hinge::python
