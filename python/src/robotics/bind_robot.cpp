// SPDX-License-Identifier: BSD-3-Clause
// Robots: from URDF and SRDF, from code, with tiers; random configurations.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "hinge/core/error.hpp"
#include "hinge/robotics/random_configuration.hpp"
#include "hinge/robotics/read_urdf.hpp"
#include "hinge/robotics/solid_meshes.hpp"
#include "hinge/robotics/sphere_model.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "hinge/robotics/tiers.hpp"
#include "robot_handle.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

LinkId link_named(const Robot& robot, const std::string& link, const char* name) {
  const auto found = robot.find_link(link);
  if (!found)
    throw ModelError(std::string(name) + ": robot '" + robot.name() + "' has no link '" + link + "', see Robot.links");
  return *found;
}

LinkPairs link_pairs_named(const Robot& robot, const std::vector<std::pair<std::string, std::string>>& pairs,
                           const char* name) {
  LinkPairs found(robot.link_count());
  for (const auto& [a, b] : pairs) found.insert(link_named(robot, a, name), link_named(robot, b, name));
  return found;
}

namespace {

Tessellation as_tessellation(const std::string& primitives, double tolerance) {
  Tessellation tessellation;
  if (primitives == "reference") tessellation.manner = Tessellation::Manner::inscribed;
  tessellation.tolerance = tolerance;
  return tessellation;
}

/// A file, or its text with a path that stands for it in messages.
struct Source {
  std::optional<std::string> text;
  std::filesystem::path path;
};

Source as_source(const py::tuple& given) {
  return {given[0].cast<std::optional<std::string>>(), std::filesystem::path(given[1].cast<std::string>())};
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::unique_ptr<RobotHandle> read_sources(const Source& urdf, const std::optional<Source>& srdf,
                                          const UrdfOptions& options, const Tessellation& tessellation, bool solid,
                                          bool note_unknown) {
  RobotDescription description = urdf.text ? parse_urdf(*urdf.text, urdf.path, options) : read_urdf(urdf.path, options);
  auto made = std::make_unique<RobotHandle>();
  made->notes = description.notes;
  if (solid)
    for (std::string& note : fill_closed_meshes(description)) made->notes.push_back(std::move(note));
  try {
    made->robot = std::make_shared<const Robot>(std::move(description), tessellation);
  } catch (const ModelError& error) {  // the fault is in the file, not in the arguments
    throw LoadError(urdf.path.string() + ": " + error.what());
  }
  made->srdf.disabled = made->srdf.enabled = LinkPairs(made->robot->link_count());
  if (srdf) {
    const UnknownLinks unknown = note_unknown ? UnknownLinks::noted : UnknownLinks::refused;
    made->srdf = srdf->text ? parse_srdf(*srdf->text, srdf->path, *made->robot, unknown)
                            : read_srdf(srdf->path, *made->robot, unknown);
    made->srdf_text = srdf->text ? *srdf->text : bytes_of(srdf->path);
    made->notes.insert(made->notes.end(), made->srdf.notes.begin(), made->srdf.notes.end());
  }
  return made;
}

std::unique_ptr<RobotHandle> read_robot(const py::tuple& urdf, const py::object& srdf,
                                        const std::vector<std::string>& packages, bool skip_missing,
                                        const std::string& primitives, double tolerance, bool solid,
                                        bool note_unknown) {
  const Source source = as_source(urdf);
  const std::optional<Source> pairs = srdf.is_none() ? std::nullopt : std::optional(as_source(srdf));
  UrdfOptions options;
  options.package_folders.assign(packages.begin(), packages.end());
  for (std::filesystem::path& folder : ros_package_path()) options.package_folders.push_back(std::move(folder));
  options.skip_missing_meshes = skip_missing;
  const Tessellation tessellation = as_tessellation(primitives, tolerance);
  return run_aside([=] { return read_sources(source, pairs, options, tessellation, solid, note_unknown); });
}

JointType as_joint_type(const std::string& type) {
  if (type == "fixed") return JointType::fixed;
  if (type == "revolute") return JointType::revolute;
  return type == "continuous" ? JointType::continuous : JointType::prismatic;
}

/// links: (name, [(shape, pose), ...]). joints: (name, type, parent, child, origin, axis, lower, upper, mimic).
std::unique_ptr<RobotHandle> make_robot(const std::string& name, const py::list& links, const py::list& joints,
                                        const std::string& primitives, double tolerance, bool solid) {
  RobotDescription description;
  description.name = name;
  for (const py::handle item : links) {
    const auto link = item.cast<py::tuple>();
    LinkDescription& made = description.links.emplace_back();
    made.name = link[0].cast<std::string>();
    for (const py::handle placed : link[1]) {
      const auto pair = placed.cast<py::tuple>();
      made.geometry.push_back({pair[0].cast<const ShapeHandle&>().shape, as_pose(pair[1], "pose of a shape")});
    }
  }
  for (const py::handle item : joints) {
    const auto joint = item.cast<py::tuple>();
    JointDescription& made = description.joints.emplace_back();
    made.name = joint[0].cast<std::string>();
    made.type = as_joint_type(joint[1].cast<std::string>());
    made.parent = joint[2].cast<std::string>();
    made.child = joint[3].cast<std::string>();
    made.origin = as_pose(joint[4], "origin");
    const Doubles axis = as_doubles(joint[5], "axis", std::vector<Shape>{{3}}, "x, y, z");
    made.axis = {axis.data()[0], axis.data()[1], axis.data()[2]};
    made.lower = joint[6].cast<double>();
    made.upper = joint[7].cast<double>();
    if (!joint[8].is_none()) {
      const auto [followed, multiplier, offset] = joint[8].cast<std::tuple<std::string, double, double>>();
      made.mimic = Mimic{followed, multiplier, offset};
    }
  }
  const Tessellation tessellation = as_tessellation(primitives, tolerance);
  return run_aside([description = std::move(description), tessellation, solid]() mutable {
    auto made = std::make_unique<RobotHandle>();
    if (solid) made->notes = fill_closed_meshes(description);
    made->robot = std::make_shared<const Robot>(std::move(description), tessellation);
    made->srdf.disabled = made->srdf.enabled = LinkPairs(made->robot->link_count());
    return made;
  });
}

std::unique_ptr<RobotHandle> tiered(const RobotHandle& self, const std::string& all,
                                    const std::map<std::string, std::string>& links, std::size_t most_spheres,
                                    double tolerance) {
  Tiers tiers{tier_named(all), {}, most_spheres, tolerance};
  for (const auto& [link, tier] : links) tiers.links[link] = tier_named(tier);
  return run_aside([robot = self, tiers] {
    auto made = std::make_unique<RobotHandle>(robot);  // links keep their order, so the SRDF still fits
    made->robot = std::make_shared<const Robot>(with_tiers(robot->description(), tiers), robot->tessellation());
    return made;
  });
}

py::array_t<double> sample(const RobotHandle& self, std::size_t n, std::uint64_t seed, std::uint64_t first,
                           const py::object& progress) {
  constexpr double largest = 1e15;  // as for values on the command line
  for (std::size_t j = 0; j < self.dof(); ++j)
    if (!(std::abs(self->lower()[j]) <= largest && std::abs(self->upper()[j]) <= largest))
      throw ModelError("sample: joint '" + self->independent_name(j) +
                       "' has limits too large for samples, expected at most 1e15");
  std::vector<double> q(n * self.dof());
  run_slices(n, 1, progress, [&]() -> Slice {
    return [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k)
        random_configuration(*self, seed, first + k, std::span(q).subspan(k * self.dof(), self.dof()));
    };
  });
  return to_array(std::move(q), {static_cast<py::ssize_t>(n), static_cast<py::ssize_t>(self.dof())});
}

py::object expand(const RobotHandle& self, const py::object& values) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const std::size_t columns = self->model().tree().dof_count();
  std::vector<double> full(q.count * columns);
  for (std::size_t k = 0; k < q.count; ++k) self->expand(q[k], std::span(full).subspan(k * columns, columns));
  Shape shape{static_cast<py::ssize_t>(q.count), static_cast<py::ssize_t>(columns)};
  if (q.one) shape.erase(shape.begin());
  return to_array(std::move(full), shape);
}

/// Links, centres (n, 3) and radii of a robot made of spheres.
py::tuple spheres(const RobotHandle& self) {
  const Model<Sphere> model = spheres_of(*self);
  std::vector<std::int32_t> links;
  std::vector<double> centers, radii;
  for (std::size_t k = 0; k < model.size(); ++k) {
    const Sphere& sphere = model.primitives()[k];
    links.push_back(link_row(model.links()[k]));
    centers.insert(centers.end(), sphere.center.data(), sphere.center.data() + 3);
    radii.push_back(sphere.radius);
  }
  const auto n = static_cast<py::ssize_t>(radii.size());
  return py::make_tuple(to_array(std::move(links)), to_array(std::move(centers), {n, 3}), to_array(std::move(radii)));
}

}  // namespace

void bind_robot(py::module_& module) {
  RobotClass robot(module, "RobotBase", "A robot; see Robot.");
  robot.def(py::init(&read_robot)).def(py::init(&make_robot)).def(py::init(&tiered));
  robot.def("_sample", &sample)
      .def("expand", &expand, py::arg("q"),
           "expand(self, q)\n--\n\n"
           "Return the values of all movable joints, mimic joints included: shape (n, len(movable_joints)), or one "
           "row.\n\n"
           "q: shape (n, dof) or (dof,), rad or m. Columns are in the order of movable_joints.")
      .def("_spheres", &spheres)
      .def_property_readonly(
          "has_only_spheres", [](const RobotHandle& self) { return has_only_spheres(*self); },
          "True if every collision shape is a sphere.")
      .def_property_readonly(
          "name", [](const RobotHandle& self) { return self->name(); }, "Name of the robot.")
      .def_property_readonly(
          "dof", &RobotHandle::dof,
          "Number of values of a configuration: independent joints, which move and mimic no other joint.")
      .def_property_readonly(
          "notes", [](const RobotHandle& self) { return self.notes; },
          "What the readers of the files skipped or interpreted, one sentence each.")
      .def_property_readonly(
          "floating_base", [](const RobotHandle& self) { return self->description().floating_base; },
          "Name of the floating or planar joint that is treated as fixed; '' if there is none.")
      .def_property_readonly(
          "incomplete_links", [](const RobotHandle& self) { return self->description().incomplete; },
          "Names of links that lack some geometry, because a mesh is missing.")
      .def_property_readonly(
          "disabled_pairs",
          [](const RobotHandle& self) {
            std::vector<std::pair<std::string, std::string>> names;
            for (const auto& [a, b] : self.srdf.disabled.list())
              names.emplace_back(self->link_name(a), self->link_name(b));
            return names;
          },
          "Pairs of link names that the SRDF disables.");
  add_robot_tables(robot);
}

}  // namespace hinge::python
