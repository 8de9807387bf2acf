// SPDX-License-Identifier: BSD-3-Clause
// Links, joints and named states of a robot as columns.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <map>

#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "robot_handle.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

namespace {

struct LinkTable {
  std::vector<std::string> names, parents;
  std::vector<std::int64_t> group, count, degenerate, rounded;
  std::vector<std::uint8_t> is_closed;
};

LinkTable link_table(const Robot& robot) {
  const KinematicTree& tree = robot.model().tree();
  const RigidGroups groups(tree, DofSelection::all(tree));
  const std::span<const double> radii = robot.radii();
  const std::size_t n = robot.link_count() - 1;
  LinkTable table;
  table.degenerate.assign(n, 0);
  table.rounded.assign(n, 0);
  std::vector<std::vector<Triangle>> triangles(n);
  for (std::size_t i = 0; i < robot.model().size(); ++i) {
    const Triangle& t = robot.model().primitives()[i];
    const auto row = static_cast<std::size_t>(link_row(robot.model().links()[i]));
    const bool is_rounded = !radii.empty() && radii[i] > 0.0;
    const bool is_flat = squared_norm(cross(Vec3(t.b - t.a), Vec3(t.c - t.a))) == 0.0;
    table.rounded[row] += is_rounded ? 1 : 0;
    table.degenerate[row] += is_flat && !is_rounded ? 1 : 0;
    triangles[row].push_back(t);
  }
  for (std::size_t row = 0; row < n; ++row) {
    const auto link = id<LinkId>(row + 1);
    table.names.push_back(robot.link_name(link));
    table.parents.push_back(robot.link_name(tree.parent(link)));
    table.group.push_back(static_cast<std::int64_t>(index(groups.group_of(link))));
    table.count.push_back(static_cast<std::int64_t>(robot.triangle_count(link)));
    table.is_closed.push_back(!triangles[row].empty() && closed(triangles[row]) ? 1 : 0);
  }
  return table;
}

py::dict link_columns(const RobotHandle& self) {
  LinkTable table = run_aside([robot = self.robot] { return link_table(*robot); });
  py::dict columns;
  columns["name"] = table.names;
  columns["parent"] = table.parents;
  columns["group"] = to_array(std::move(table.group));
  columns["triangles"] = to_array(std::move(table.count));
  columns["degenerate"] = to_array(std::move(table.degenerate));
  columns["rounded"] = to_array(std::move(table.rounded));
  columns["closed"] = to_booleans(std::move(table.is_closed));
  return columns;
}

const char* type_of(JointType type) {
  switch (type) {
    case JointType::fixed: return "fixed";
    case JointType::revolute: return "revolute";
    case JointType::continuous: return "continuous";
    case JointType::prismatic: break;
  }
  return "prismatic";
}

py::dict joint_columns(const RobotHandle& self) {
  const Robot& robot = *self;
  const auto& joints = robot.description().joints;
  std::vector<std::int64_t> column(joints.size(), -1);
  std::vector<double> multiplier(joints.size(), 0.0), offset(joints.size(), 0.0), lower, upper;
  for (std::size_t dof = 0; dof < robot.drives().size(); ++dof) {  // chains of mimic joints are resolved
    const Robot::Drive& drive = robot.drives()[dof];
    const std::size_t joint = robot.joint_of(id<DofId>(dof));
    column[joint] = static_cast<std::int64_t>(drive.independent);
    multiplier[joint] = drive.multiplier;
    offset[joint] = drive.offset;
  }
  std::vector<std::string> names, types, parents, children, mimics;
  for (const JointDescription& joint : joints) {
    const bool limited = joint.type == JointType::revolute || joint.type == JointType::prismatic;
    const double endless = joint.type == JointType::continuous ? std::numeric_limits<double>::infinity() : 0.0;
    names.push_back(joint.name);
    types.emplace_back(type_of(joint.type));
    parents.push_back(joint.parent);
    children.push_back(joint.child);
    lower.push_back(limited ? joint.lower : -endless);
    upper.push_back(limited ? joint.upper : endless);
    mimics.push_back(joint.mimic && joint.type != JointType::fixed ? joint.mimic->joint : "");
  }
  py::dict columns;
  columns["name"] = names;
  columns["type"] = types;
  columns["parent"] = parents;
  columns["child"] = children;
  columns["lower"] = to_array(std::move(lower));
  columns["upper"] = to_array(std::move(upper));
  columns["column"] = to_array(std::move(column));
  columns["mimic"] = mimics;
  columns["multiplier"] = to_array(std::move(multiplier));
  columns["offset"] = to_array(std::move(offset));
  return columns;
}

/// Returns the triangles of a link's shapes in the link's frame.
std::vector<Triangle> surface_of_link(const Robot& robot, const std::string& name) {
  std::vector<Triangle> triangles;
  for (const LinkDescription& link : robot.description().links)
    if (link.name == name)
      for (const PlacedShape& part : link.geometry)
        for (const Triangle& t : drawn_triangles(part.shape, part.origin)) triangles.push_back(t);
  return triangles;
}

py::array_t<double> surface(const RobotHandle& self, const std::string& link) {
  link_named(*self, link, "link");
  return to_corners(run_aside([robot = self.robot, link] { return surface_of_link(*robot, link); }));
}

}  // namespace

void add_robot_tables(RobotClass& robot) {
  robot.def("_link_columns", &link_columns)
      .def("surface", &surface, py::arg("link"),
           "surface(self, link)\n--\n\nReturn triangles on the surface of a link's shapes, for pictures.\n\n"
           "link: a name. Returns shape (n, 3, 3), m, in the link's frame; a sphere has 320 triangles, a cylinder 32 "
           "sides.\n"
           "Raises ModelError.")
      .def("_joint_columns", &joint_columns)
      .def_property_readonly(
          "joint_names",
          [](const RobotHandle& self) {
            std::vector<std::string> names;
            for (std::size_t k = 0; k < self.dof(); ++k) names.push_back(self->independent_name(k));
            return names;
          },
          "Names of the columns of a configuration: the independent joints, in the order of the description.")
      .def_property_readonly(
          "movable_joints",
          [](const RobotHandle& self) {
            std::vector<std::string> names;
            for (std::size_t dof = 0; dof < self->drives().size(); ++dof)
              names.push_back(self->description().joints[self->joint_of(id<DofId>(dof))].name);
            return names;
          },
          "Names of all joints that move, mimic joints included, parents before children.")
      .def_property_readonly(
          "link_names",
          [](const RobotHandle& self) {
            std::vector<std::string> names;
            for (std::size_t l = 1; l < self->link_count(); ++l) names.push_back(self->link_name(id<LinkId>(l)));
            return names;
          },
          "Names of the links; the indices of links in all results refer to this list. Parents come before children.")
      .def_property_readonly(
          "lower",
          [](const RobotHandle& self) {
            return to_array(std::vector<double>(self->lower().begin(), self->lower().end()));
          },
          "Lower limits, shape (dof,), rad or m; -pi for continuous joints.")
      .def_property_readonly(
          "upper",
          [](const RobotHandle& self) {
            return to_array(std::vector<double>(self->upper().begin(), self->upper().end()));
          },
          "Upper limits, shape (dof,), rad or m; pi for continuous joints.")
      .def("_states",
           [](const RobotHandle& self) {
             std::vector<std::tuple<std::string, std::vector<std::pair<std::size_t, double>>>> states;
             for (const NamedConfiguration& state : self.srdf.configurations)
               states.emplace_back(state.full_name(), state.values);
             return states;
           })
      .def_property_readonly(
          "groups",
          [](const RobotHandle& self) {
            std::map<std::string, std::vector<std::string>> groups;
            for (const JointGroup& group : self.srdf.groups) {
              std::vector<std::string>& names = groups[group.name];
              for (const std::size_t joint : group.joints) names.push_back(self->description().joints[joint].name);
            }
            return groups;
          },
          "Groups of the SRDF: names of their movable joints by the name of the group.");
}

}  // namespace hinge::python
