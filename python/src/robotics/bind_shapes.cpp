// SPDX-License-Identifier: BSD-3-Clause
// Shapes and poses from arrays.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <variant>

#include "hinge/core/error.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/read_mesh.hpp"
#include "hinge/robotics/read_points.hpp"
#include "hinge/robotics/rpy.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "robot_handle.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

Pose as_pose(py::handle value, const char* name) {
  Pose pose;
  if (value.is_none()) return pose;
  const Doubles matrix = as_doubles(value, name, std::vector<Shape>{{4, 4}}, "a homogeneous matrix");
  require_finite(matrix, name);
  const double* m = matrix.data();
  if (m[12] != 0.0 || m[13] != 0.0 || m[14] != 0.0 || m[15] != 1.0)
    throw py::value_error(std::string(name) + ": the last row is " +
                          py::repr(py::make_tuple(m[12], m[13], m[14], m[15])).cast<std::string>() +
                          ", expected (0, 0, 0, 1)");
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) pose.rotation(r, c) = m[4 * r + c];
    pose.translation[r] = m[4 * r + 3];
  }
  return pose;
}

void write_matrix(const Pose& pose, double* matrix) noexcept {
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) matrix[4 * r + c] = pose.rotation(r, c);
    matrix[4 * r + 3] = pose.translation[r];
  }
  std::fill_n(matrix + 12, 3, 0.0);
  matrix[15] = 1.0;
}

py::array_t<double> to_matrix(const Pose& pose) {
  std::vector<double> matrix(16);
  write_matrix(pose, matrix.data());
  return to_array(std::move(matrix), {4, 4});
}

py::array_t<double> to_corners(const std::vector<Triangle>& triangles) {
  std::vector<double> corners;
  for (const Triangle& t : triangles)
    for (const Vec3* p : {&t.a, &t.b, &t.c}) corners.insert(corners.end(), p->data(), p->data() + 3);
  const auto count = static_cast<py::ssize_t>(triangles.size());
  return to_array(std::move(corners), {count, 3, 3});
}

namespace {

Vec3 as_vector(py::handle value, const char* name) {
  const Doubles array = as_doubles(value, name, std::vector<Shape>{{3}}, "x, y, z");
  require_finite(array, name);
  return {array.data()[0], array.data()[1], array.data()[2]};
}

/// Returns the shape if it is valid; see tessellate().
ShapeHandle checked(robotics::Shape shape) {
  return run_if_large(shape, [shape] {
    tessellate(shape);
    return ShapeHandle{shape};
  });
}

/// vertices: shape (n, 3). faces: shape (m, 3); None: vertices has shape (m, 3, 3).
std::shared_ptr<const TriangleMesh> as_mesh(const py::object& vertices, const py::object& faces) {
  const auto mesh = std::make_shared<TriangleMesh>();
  if (faces.is_none()) {
    const Doubles corners = as_doubles(vertices, "vertices", std::vector<Shape>{{any, 3, 3}}, "(m, 3 corners, 3)");
    require_finite(corners, "vertices");
    const double* x = corners.data();
    for (py::ssize_t t = 0; t < corners.shape(0); ++t, x += 9)
      mesh->triangles.push_back({Vec3(x[0], x[1], x[2]), Vec3(x[3], x[4], x[5]), Vec3(x[6], x[7], x[8])});
    return mesh;
  }
  const Doubles points = as_doubles(vertices, "vertices", std::vector<Shape>{{any, 3}}, "(n, 3)");
  require_finite(points, "vertices");
  const py::array corners = py::array::ensure(faces);
  if (!corners || (corners.dtype().kind() != 'i' && corners.dtype().kind() != 'u' && corners.size() > 0))
    throw py::type_error("faces: expected an array of integers");
  if (corners.ndim() != 2 || corners.shape(1) != 3)
    throw py::value_error("faces: " + std::to_string(corners.ndim()) + " dimensions, expected shape (m, 3)");
  const std::vector<std::size_t> flat =
      as_indices(corners.attr("reshape")(-1), "faces", static_cast<std::size_t>(points.shape(0)));
  const auto corner = [&](std::size_t k) {
    const double* x = points.data() + 3 * flat[k];
    return Vec3(x[0], x[1], x[2]);
  };
  for (std::size_t k = 0; k + 2 < flat.size(); k += 3)
    mesh->triangles.push_back({corner(k), corner(k + 1), corner(k + 2)});
  return mesh;
}

ShapeHandle cloud_of(std::vector<Vec3> points, double radius) {
  return checked(PointCloudShape{std::make_shared<const std::vector<Vec3>>(std::move(points)), radius});
}

py::object triangles_of(const py::object& self) {
  const auto* mesh = std::get_if<MeshShape>(&self.cast<const ShapeHandle&>().shape);
  if (mesh == nullptr) throw py::type_error("triangles: not a mesh");
  const std::vector<Triangle>& triangles = mesh->mesh->triangles;
  static_assert(sizeof(Triangle) == 9 * sizeof(double));
  return view_of(triangles.front().a.data(), {static_cast<py::ssize_t>(triangles.size()), 3, 3}, self);
}

py::object points_of(const py::object& self) {
  const auto* cloud = std::get_if<PointCloudShape>(&self.cast<const ShapeHandle&>().shape);
  if (cloud == nullptr) throw py::type_error("points: not a point cloud");
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return view_of(cloud->points->front().data(), {static_cast<py::ssize_t>(cloud->points->size()), 3}, self);
}

std::optional<std::string> open_edge_of(const ShapeHandle& self) {
  return run_if_large(self.shape, [shape = self.shape] {
    const auto edge = open_edge(drawn_triangles(shape));
    return edge ? std::optional(edge->text()) : std::nullopt;
  });
}

}  // namespace

void bind_shapes(py::module_& module) {
  py::class_<ShapeHandle>(module, "ShapeData", "The compiled part of a shape; see Shape.")
      .def_static("box", [](const py::object& size) { return checked(BoxShape{as_vector(size, "size")}); })
      .def_static("sphere", [](double radius) { return checked(SphereShape{radius}); })
      .def_static("cylinder",
                  [](double radius, double length) {
                    return checked(CylinderShape{radius, length});
                  })
      .def_static("capsule",
                  [](double radius, double length) {
                    return checked(CapsuleShape{radius, length});
                  })
      .def_static("mesh",
                  [](const py::object& vertices, const py::object& faces, const py::object& scale, bool solid) {
                    return checked(MeshShape{as_mesh(vertices, faces), as_vector(scale, "scale"), {}, solid});
                  })
      .def_static("read_mesh",
                  [](const std::string& path, const py::object& scale, bool solid) {
                    const Vec3 factors = as_vector(scale, "scale");
                    const auto [mesh, notes] = run_aside([path] {
                      std::vector<std::string> skipped;
                      auto read = std::make_shared<const TriangleMesh>(read_mesh(path, &skipped));
                      return std::pair(std::move(read), std::move(skipped));
                    });
                    return py::make_tuple(checked(MeshShape{mesh, factors, path, solid}), notes);
                  })
      .def_static("point_cloud",
                  [](const py::object& value, double radius) {
                    const Doubles points = as_doubles(value, "points", std::vector<Shape>{{any, 3}}, "(n, 3)");
                    require_finite(points, "points");
                    std::vector<Vec3> all;
                    for (const double* x = points.data(); x != points.data() + points.size(); x += 3)
                      all.emplace_back(x[0], x[1], x[2]);
                    return cloud_of(std::move(all), radius);
                  })
      .def_static("read_points",
                  [](const std::string& path, double radius) {
                    return cloud_of(run_aside([path] { return read_points(path); }), radius);
                  })
      .def_property_readonly("triangles", &triangles_of)
      .def_property_readonly("points", &points_of)
      .def_property_readonly(
          "surface",
          [](const ShapeHandle& self) {
            return to_corners(run_if_large(self.shape, [shape = self.shape] { return drawn_triangles(shape); }));
          })
      .def_property_readonly("open_edge", &open_edge_of);
  module.def("compose",
             [](const py::object& a, const py::object& b) { return to_matrix(as_pose(a, "a") * as_pose(b, "b")); });
  module.def("matrix_of_rpy", [](const py::object& xyz, const py::object& rpy) {
    return to_matrix({rotation_of_rpy(as_vector(rpy, "rpy")), as_vector(xyz, "xyz")});
  });
}

}  // namespace hinge::python
