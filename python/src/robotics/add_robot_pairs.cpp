// SPDX-License-Identifier: BSD-3-Clause
// Which links and bodies collide, how far apart they are, and what is inside closed meshes.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>

#include "hinge/robotics/containment.hpp"
#include "robot_checker_handle.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

namespace {

/// A link or body inside another.
struct ContainedRow {
  std::int64_t configuration;
  std::int32_t outer, inner;
  bool whole;
  Padding<7> padding{};
};

LinkPairRow pair_row_of(std::size_t configuration, std::int32_t first, std::int32_t second, const Hit& hit) {
  return {static_cast<std::int64_t>(configuration),
          first,
          second,
          static_cast<std::uint32_t>(index(hit.first)),
          static_cast<std::uint32_t>(index(hit.second)),
          hit.distance,
          hit.threshold};
}

LinkDistanceRow body_distance_row(const RobotCheckerHandle& self, std::size_t k, const ClosestBody& found) {
  const ClosestLinks numbers{found.link,     found.link, found.triangle1, found.triangle2,
                             found.distance, found.gap,  found.point1,    found.point2};
  LinkDistanceRow row = distance_row(k, numbers);
  row.first = self.own_row(found);
  row.second = self.body_row(found.body);
  return row;
}

py::object pairs(RobotCheckerHandle& self, const py::object& values, const py::object& within,
                 const std::string& against, const py::object& threads, const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const Against what = as_against(against);
  const double margin = as_length(within, "within", "m");
  std::vector<std::vector<LinkPairRow>> rows(q.count);
  run_robot(self, q.count, threads, progress, [&](RobotWorker& worker, Environment* bodies, std::size_t k) {
    worker.update(q, k);
    if (what.self)
      for (const LinkContact& c : worker.checker.within(margin))
        rows[k].push_back(pair_row_of(k, link_row(c.link1), link_row(c.link2), c.hit));
    if (what.bodies && bodies != nullptr)
      for (const BodyContact& c : worker.checker.within(*bodies, margin))
        rows[k].push_back(pair_row_of(k, self.own_row(c), self.body_row(c.body), c.hit));
  });
  return joined_rows(rows);
}

py::object distances(RobotCheckerHandle& self, const py::object& values, const py::object& within,
                     const std::string& against, const py::object& threads, const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const Against what = as_against(against);
  const double margin = as_length(within, "within", "m");
  std::vector<std::vector<LinkDistanceRow>> rows(q.count);
  run_robot(self, q.count, threads, progress, [&](RobotWorker& worker, Environment* bodies, std::size_t k) {
    worker.update(q, k);
    if (what.self)
      for (const ClosestLinks& c : worker.checker.distances(margin)) rows[k].push_back(distance_row(k, c));
    if (what.bodies && bodies != nullptr)
      for (const ClosestBody& c : worker.checker.distances(*bodies, margin))
        rows[k].push_back(body_distance_row(self, k, c));
  });
  return joined_rows(rows);
}

py::object closest(RobotCheckerHandle& self, const py::object& values, const std::string& against,
                   const py::object& threads, const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const Against what = as_against(against);
  std::vector<std::vector<LinkDistanceRow>> rows(q.count);
  run_robot(self, q.count, threads, progress, [&](RobotWorker& worker, Environment* bodies, std::size_t k) {
    worker.update(q, k);
    std::optional<LinkDistanceRow> best;
    if (what.self)
      if (const auto found = worker.checker.closest()) best = distance_row(k, *found);
    if (what.bodies && bodies != nullptr)
      if (const auto found = worker.checker.closest(*bodies)) {
        const LinkDistanceRow row = body_distance_row(self, k, *found);
        if (!best || row.gap < best->gap) best = row;
      }
    if (best) rows[k].push_back(*best);
  });
  return joined_rows(rows);
}

py::object triangle_pairs(RobotCheckerHandle& self, const py::object& values, const py::object& threads,
                          const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const auto links = self.robot->model().links();
  std::vector<std::vector<LinkPairRow>> rows(q.count);
  run_robot(self, q.count, threads, progress, [&](RobotWorker& worker, Environment*, std::size_t k) {
    worker.update(q, k);
    for (const Hit& hit : worker.checker.triangle_pairs())
      rows[k].push_back(pair_row_of(k, link_row(links[index(hit.first)]), link_row(links[index(hit.second)]), hit));
  });
  return joined_rows(rows);
}

py::object contained(RobotCheckerHandle& self, const py::object& values, const py::object& threads,
                     const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  std::vector<std::vector<ContainedRow>> rows(q.count);
  run_robot(self, q.count, threads, progress, [&](RobotWorker& worker, Environment* bodies, std::size_t k) {
    worker.update(q, k);
    const auto row = static_cast<std::int64_t>(k);
    for (const LinkContainment& c : worker.checker.contained())
      rows[k].push_back({row, link_row(c.outer), link_row(c.inner), c.whole});
    if (bodies == nullptr) return;
    for (const BodyContainment& c : worker.checker.contained(*bodies)) {
      const std::int32_t own = self.own_row(c), body = self.body_row(c.body);
      rows[k].push_back({row, c.body_is_outer ? body : own, c.body_is_outer ? own : body, c.whole});
    }
  });
  return joined_rows(rows);
}

std::vector<std::pair<std::string, std::string>> open_links(RobotCheckerHandle& self) {
  return run_aside([robot = self.robot.robot, checker = self.checker()]() mutable {
    std::vector<std::pair<std::string, std::string>> open;
    for (const OpenLink& link : checker.not_closed()) open.emplace_back(robot->link_name(link.link), link.edge.text());
    return open;
  });
}

constexpr const char* pairs_doc =
    "pairs(self, q, *, within=0.0, against='all', threads=None, progress=None)\n--\n\n"
    "Return the pairs of links and bodies that collide, or with d < threshold + within.\n\n"
    "q, against: as in collides(). within: m, at least 0. Returns a structured array with one row per pair, first\n"
    "those of two links, by configuration: configuration (row of q), first, second (indices into names), triangle1,\n"
    "triangle2 (one pair of triangles that shows it), distance (m, of these triangles without their radii; 0: one is\n"
    "inside the other), threshold (m, radii and clearance). A held body stands for the link that holds it.";
constexpr const char* distances_doc =
    "distances(self, q, *, within, against='all', threads=None, progress=None)\n--\n\n"
    "Return the pairs of pairs() with their smallest distances and closest points.\n\n"
    "Returns a structured array: configuration, first, second, triangle1, triangle2 (as in pairs()), distance (m, of\n"
    "the surfaces; 0: they touch or overlap), gap (m, distance - clearance; below 0: too close), point1, point2\n"
    "(m, world frame, shape (3,)), normal (unit vector from point1 to point2; 0 where they touch), collides.";
constexpr const char* closest_doc =
    "closest(self, q, *, against='all', threads=None, progress=None)\n--\n\n"
    "Return the pair of the smallest gap of each configuration, as rows of distances().\n\n"
    "q, against: as in collides(). The smallest gap decides, which is the distance minus the clearance. A\n"
    "configuration without tested pairs has no row.";

}  // namespace

void add_robot_pairs(RobotCheckerClass& checker) {
  PYBIND11_NUMPY_DTYPE(ContainedRow, configuration, outer, inner, whole);
  const auto threads = [] { return py::arg("threads") = py::none(); };
  const auto progress = [] { return py::arg("progress") = py::none(); };
  const auto against = [] { return py::arg("against") = "all"; };
  checker
      .def("pairs", &pairs, py::arg("q"), py::kw_only(), py::arg("within") = 0.0, against(), threads(), progress(),
           pairs_doc)
      .def("distances", &distances, py::arg("q"), py::kw_only(), py::arg("within"), against(), threads(), progress(),
           distances_doc)
      .def("closest", &closest, py::arg("q"), py::kw_only(), against(), threads(), progress(), closest_doc)
      .def("triangle_pairs", &triangle_pairs, py::arg("q"), py::kw_only(), threads(), progress(),
           "triangle_pairs(self, q, *, threads=None, progress=None)\n--\n\n"
           "Return every pair of triangles of two links that collides, as rows of pairs().\n\n"
           "A link inside a solid that does not touch its surface has none. q: as in collides().")
      .def("contained", &contained, py::arg("q"), py::kw_only(), threads(), progress(),
           "contained(self, q, *, threads=None, progress=None)\n--\n\n"
           "Return which links and bodies lie inside a closed mesh without touching it.\n\n"
           "Only tested pairs, whether the mesh is solid or not. q: as in collides(). Returns a structured array:\n"
           "configuration, outer, inner (indices into names), whole (False: some connected components).")
      .def_property_readonly("open_links", &open_links,
                             "Links whose meshes are open, so nothing is inside them: (name, text about an edge).");
}

}  // namespace hinge::python
