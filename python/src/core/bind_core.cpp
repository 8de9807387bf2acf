// SPDX-License-Identifier: BSD-3-Clause
// The classes of hinge for models from arrays.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "core_checker.hpp"
#include "hinge/core/error.hpp"
#include "run_aside.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;

namespace {

Doubles rows_of(const py::dict& from, const char* name, py::ssize_t columns, const char* meaning) {
  const std::vector<Shape> shapes{{any, columns}};
  Doubles rows = as_doubles(from[name], name, shapes, meaning);
  require_finite(rows, name);
  return rows;
}

std::vector<Joint> as_joints(const py::dict& from, std::size_t links) {
  const auto kinds = from["joints"].cast<std::vector<std::string>>();
  const auto names = from["names"].cast<std::vector<std::string>>();
  const Doubles axes = rows_of(from, "axes", 3, "x, y, z per link"),
                points = rows_of(from, "points", 3, "x, y, z per link");
  const Doubles origins = rows_of(from, "origins", 12, "three rows of a 4 x 4 matrix per link");
  std::vector<Joint> joints;
  for (std::size_t k = 0; k < links; ++k) {
    const double *axis = axes.data() + 3 * k, *point = points.data() + 3 * k, *m = origins.data() + 12 * k;
    Pose origin;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) origin.rotation(r, c) = m[4 * r + c];
      origin.translation[r] = m[4 * r + 3];
    }
    const Vec3 direction(axis[0], axis[1], axis[2]), at(point[0], point[1], point[2]);
    if (kinds[k] == "revolute")
      joints.emplace_back(Revolute{direction, at, origin, names[k]});
    else if (kinds[k] == "prismatic")
      joints.emplace_back(Prismatic{direction, origin, names[k]});
    else
      joints.emplace_back(Fixed{origin});
  }
  return joints;
}

TableFilter as_filter(const py::dict& from) {
  const auto groups = from["groups"].cast<std::vector<std::uint32_t>>();
  const auto admitted = py::array_t<bool, py::array::c_style | py::array::forcecast>::ensure(from["admitted"]);
  const auto count = static_cast<std::size_t>(admitted.shape(0));
  return {groups, count, std::vector<std::uint8_t>(admitted.data(), admitted.data() + admitted.size()),
          from["exclude"].cast<std::vector<std::pair<std::uint32_t, std::uint32_t>>>()};
}

std::unique_ptr<CoreChecker> make_checker(const py::dict& from) {
  CoreDescription model;
  for (const std::uint32_t parent : from["parents"].cast<std::vector<std::uint32_t>>())
    model.parents.push_back(id<LinkId>(parent));
  model.joints = as_joints(from, model.parents.size());
  for (const std::uint32_t link : from["links"].cast<std::vector<std::uint32_t>>())
    model.link_of.push_back(id<LinkId>(link));
  const Doubles corners = as_doubles(from["corners"], "corners"), radii = as_doubles(from["radii"], "radii");
  model.corners.assign(corners.data(), corners.data() + corners.size());
  model.radii.assign(radii.data(), radii.data() + radii.size());
  for (const std::uint32_t dof : from["free"].cast<std::vector<std::uint32_t>>()) model.free.push_back(id<DofId>(dof));
  model.engine = from["engine"].cast<std::string>();
  const Doubles table = as_doubles(from["thresholds"], "threshold");
  const auto types = from["types"].cast<std::vector<std::uint16_t>>();
  const auto kind = from["kind"].cast<std::string>();
  const TypedThresholds thresholds(types, static_cast<std::size_t>(table.shape(0)),
                                   std::vector<double>(table.data(), table.data() + table.size()));
  const TableFilter filter = as_filter(from);
  const auto groups = from["groups"].cast<std::vector<std::uint32_t>>();
  const unsigned threads = as_threads(from["threads"], 1);
  return run_aside([=] {
    const CoreQueries queries = kind == "point"     ? make_points(model, filter, thresholds)
                                : kind == "sphere"  ? make_spheres(model, filter, thresholds)
                                : kind == "capsule" ? make_capsules(model, filter, thresholds)
                                                    : make_triangles(model, filter, thresholds);
    return std::make_unique<CoreChecker>(queries, groups, threads);
  });
}

py::object collides(CoreChecker& self, const py::object& values, const py::object& threads,
                    const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof);
  if (q.one) {
    as_threads(threads, self.threads);
    bool hit = false;
    {
      const py::gil_scoped_release unlocked;
      WorkerPool<CoreQueries>::Loan worker(self.pool);
      worker->update(q[0]);
      hit = worker->collides();
    }
    return py::bool_(hit);
  }
  std::vector<std::uint8_t> verdicts(q.count);
  run_slices(self.pool, q.count, as_threads(threads, self.threads), progress,
             [&](CoreQueries& worker, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) {
                 worker.update(q[k]);
                 verdicts[k] = worker.collides() ? 1 : 0;
               }
             });
  return to_booleans(std::move(verdicts));
}

/// within: nullopt asks for the closest pair.
py::object list_pairs(CoreChecker& self, const py::object& values, std::optional<double> within,
                      const py::object& threads, const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof);
  std::vector<std::vector<CorePairRow>> rows(q.count);
  run_slices(self.pool, q.count, as_threads(threads, self.threads), progress,
             [&](CoreQueries& worker, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) {
                 worker.update(q[k]);
                 if (within) {
                   for (const Hit& hit : worker.within(*within)) rows[k].push_back(row_of(k, hit));
                 } else if (const std::optional<Hit> hit = worker.closest()) {
                   rows[k].push_back(row_of(k, *hit));
                 }
               }
             });
  return to_array(joined(rows));
}

py::array_t<double> link_poses(CoreChecker& self, const py::object& values, const py::object& threads,
                               const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof);
  const std::size_t links = self.pool.prototype().links;
  std::vector<double> poses(q.count * links * 16, 0.0);
  run_slices(self.pool, q.count, as_threads(threads, self.threads), progress,
             [&](CoreQueries& worker, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) {
                 worker.update(q[k]);
                 for (std::size_t link = 0; link < links; ++link) {
                   const Pose pose = worker.link_pose(id<LinkId>(link));
                   double* const m = poses.data() + 16 * (k * links + link);
                   for (int r = 0; r < 3; ++r) {
                     for (int c = 0; c < 3; ++c) m[4 * r + c] = pose.rotation(r, c);
                     m[4 * r + 3] = pose.translation[r];
                   }
                   m[15] = 1.0;
                 }
               }
             });
  Shape shape{static_cast<py::ssize_t>(q.count), static_cast<py::ssize_t>(links), 4, 4};
  if (q.one) shape.erase(shape.begin());
  return to_array(std::move(poses), shape);
}

}  // namespace

double as_margin(const py::object& within) {
  const double margin = as_number(within, "within");
  if (!(margin >= 0.0 && margin <= 1e300))
    throw py::value_error("within: " + py::repr(py::float_(margin)).cast<std::string>() +
                          ", expected a finite length, at least 0");
  return margin;
}

void bind_core(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(CorePairRow, configuration, i, j, distance, threshold);
  const auto options = [](auto&& bind) { bind(py::arg("threads") = py::none(), py::arg("progress") = py::none()); };
  CoreCheckerClass checker(module, "CheckerBase", "A checker; see Checker.");
  options([&](const py::arg_v& threads, const py::arg_v& progress) {
    checker.def(py::init(&make_checker))
        .def("collides", &collides, py::arg("q"), py::kw_only(), threads, progress,
             "collides(self, q, *, threads=None, progress=None)\n--\n\n"
             "Tell which configurations collide.\n\n"
             "q: shape (n, dof), or (dof,) for one; rad, or the model's length for prismatic joints. Float64 arrays in "
             "C\n"
             "order are not copied. Returns booleans of shape (n,), or one bool. Pairs whose distance cannot change\n"
             "are left out (constant_contacts). Raises TypeError and ValueError.")
        .def(
            "pairs",
            [](CoreChecker& self, const py::object& q, const py::object& within, const py::object& n,
               const py::object& bar) { return list_pairs(self, q, as_margin(within), n, bar); },
            py::arg("q"), py::kw_only(), py::arg("within") = 0.0, threads, progress,
            "pairs(self, q, *, within=0.0, threads=None, progress=None)\n--\n\n"
            "Return the pairs of primitives that collide, or with d < threshold + within.\n\n"
            "q: as in collides(). within: a length, at least 0. Returns a structured array with one row per pair, "
            "sorted\n"
            "by configuration, i and j: configuration (row of q), i, j (primitives), distance, threshold.")
        .def(
            "closest",
            [](CoreChecker& self, const py::object& q, const py::object& n, const py::object& bar) {
              return list_pairs(self, q, std::nullopt, n, bar);
            },
            py::arg("q"), py::kw_only(), threads, progress,
            "closest(self, q, *, threads=None, progress=None)\n--\n\n"
            "Return the pair of least distance - threshold of each configuration, as rows of pairs().\n\n"
            "q: as in collides(). "
            "A configuration without tested pairs has no row.")
        .def("link_poses", &link_poses, py::arg("q"), py::kw_only(), threads, progress,
             "link_poses(self, q, *, threads=None, progress=None)\n--\n\n"
             "Return the world poses of all links, the world included.\n\n"
             "q: as in collides(). Returns shape (n, links, 4, 4), or (links, 4, 4) for one configuration.");
  });
  add_core_paths(checker);
  add_two_models(checker);
  checker
      .def_property_readonly(
          "dof", [](const CoreChecker& self) { return self.dof; }, "Number of values of a configuration.")
      .def_property_readonly(
          "threads", [](const CoreChecker& self) { return self.threads; }, "Default number of threads of a call.")
      .def_property_readonly(
          "constant_contacts",
          [](const CoreChecker& self) {
            std::vector<CorePairRow> rows;
            for (const Hit& hit : self.pool.prototype().constant_contacts()) rows.push_back(row_of(0, hit));
            return to_array(std::move(rows));
          },
          "Pairs that collide at the reference and whose distance cannot change, as rows of pairs().");
}

}  // namespace hinge::python
