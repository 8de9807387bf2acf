// SPDX-License-Identifier: BSD-3-Clause
// Checkers of robots: rules, and which configurations collide.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "robot_checker_handle.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

namespace {

using NamedPairs = std::vector<std::pair<std::string, std::string>>;

void check_environment(const RobotHandle& robot, const EnvironmentHandle* environment, const std::string& engine,
                       bool has_base) {
  if (environment == nullptr) return;
  if (environment->bodies().engine() != engine)
    throw ModelError("environment: its engine is '" + environment->bodies().engine() + "', expected the checker's, '" +
                     engine + "'");
  if (!robot->description().floating_base.empty() && !has_base)
    throw ModelError("base: joint '" + robot->description().floating_base +
                     "' is a floating base, expected the pose of the robot among the bodies; base=numpy.eye(4) "
                     "places it at the origin of this joint");
}

std::unique_ptr<RobotCheckerHandle> make_checker(
    const RobotHandle& robot, double clearance,
    const std::vector<std::tuple<std::string, std::string, double>>& special, const NamedPairs& disable,
    const std::shared_ptr<EnvironmentHandle>& environment, const py::object& base, const std::string& engine,
    const py::object& threads) {
  LinkPairs disabled = robot.srdf.disabled;
  for (const auto& [a, b] : link_pairs_named(*robot, disable, "disable").list()) disabled.insert(a, b);
  std::vector<PairClearance> clearances;
  for (const auto& [a, b, c] : special)
    clearances.push_back({link_named(*robot, a, "pair_clearances"), link_named(*robot, b, "pair_clearances"), c});
  check_environment(robot, environment.get(), engine, !base.is_none());
  const Pose at = as_pose(base, "base");
  const bool placed = !base.is_none();
  auto made = std::make_unique<RobotCheckerHandle>();
  made->threads = as_threads(threads, 1);
  made->robot = robot;
  made->environment = environment;
  made->pool = run_aside([=, robot = robot.robot] {
    RobotChecker checker(robot, tested_pairs(*robot, disabled), LinkMargins(*robot, clearance, clearances), {engine});
    if (placed && !(at == Pose{})) checker.set_base(at);
    return std::make_shared<RobotPool>(RobotWorker{checker});
  });
  return made;
}

/// Verdicts of configurations first ... last - 1.
void find_colliding_links(RobotWorker& worker, Environment* bodies, const Configurations& q, Against against,
                          std::size_t first, std::size_t last, std::uint8_t* verdicts) {
  RobotChecker& checker = worker.checker;
  if (bodies == nullptr && q.dof > 0 && against.self) {
    try {
      const std::vector<std::uint8_t> found = checker.check_batch(q.slice(first, last));
      std::copy(found.begin(), found.end(), verdicts + first);
      return;
    } catch (const ConfigurationError&) {  // it counts from `first`: ask again
    }
  }
  for (std::size_t k = first; k < last; ++k) {
    worker.update(q, k);
    verdicts[k] = (against.self && checker.collides()) || (bodies != nullptr && checker.collides(*bodies)) ? 1 : 0;
  }
}

py::object collides(RobotCheckerHandle& self, const py::object& values, const std::string& against,
                    const py::object& threads, const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const Against what = as_against(against);
  const auto bodies_of = [&](RobotCall& call, RobotWorker& worker) {
    return what.bodies ? call.bodies(worker) : nullptr;
  };
  RobotCall call(self);
  if (q.one) {
    std::uint8_t verdict = 0;
    {
      const py::gil_scoped_release unlocked;
      RobotPool::Loan worker(call.pool());
      find_colliding_links(*worker, bodies_of(call, *worker), q, what, 0, 1, &verdict);
    }
    return py::bool_(verdict != 0);
  }
  std::vector<std::uint8_t> verdicts(q.count);
  run_slices(call.pool(), q.count, as_threads(threads, self.threads), progress,
             [&](RobotWorker& worker, std::size_t first, std::size_t last) {
               find_colliding_links(worker, bodies_of(call, worker), q, what, first, last, verdicts.data());
             });
  return to_booleans(std::move(verdicts));
}

py::object link_poses(RobotCheckerHandle& self, const py::object& values, const py::object& threads,
                      const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const std::size_t links = self.robot->link_count() - 1;
  std::vector<double> poses(q.count * links * 16);
  run_robot(self, q.count, threads, progress, [&](RobotWorker& worker, Environment*, std::size_t k) {
    worker.update(q, k);
    for (std::size_t l = 0; l < links; ++l)
      write_matrix(worker.checker.link_pose(id<LinkId>(l + 1)), poses.data() + (k * links + l) * 16);
  });
  Shape shape{static_cast<py::ssize_t>(q.count), static_cast<py::ssize_t>(links), 4, 4};
  if (q.one) shape.erase(shape.begin());
  return to_array(std::move(poses), shape);
}

void calibrate(RobotCheckerHandle& self, const py::object& values) {
  const Configurations q = as_configurations(values, "q", self.dof());
  RobotCall call(self);
  RobotWorker worker{self.checker()};
  run_slices(q.count, 1, py::none(), [&]() -> Slice {
    Environment* bodies = call.bodies(worker);
    return [&, bodies](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        worker.update(q, k);
        worker.checker.calibrate_pair_order();
        if (bodies != nullptr) worker.checker.calibrate_pair_order(*bodies);
      }
    };
  });
  self.replace(worker.checker);
}

void allow_links(RobotCheckerHandle& self, const std::string& a, const std::string& b) {
  const RobotChecker& now = self.checker();
  const LinkId first = link_named(*self.robot, a, "a"), second = link_named(*self.robot, b, "b");
  LinkPairs tested = now.tested();
  tested.erase(first, second);
  self.replace(
      run_aside([=, robot = self.robot.robot, margins = now.margins(), engine = now.engine(), base = now.base()] {
        RobotChecker next(robot, tested, margins, {engine});
        if (!(base == Pose{})) next.set_base(base);
        return next;
      }));
}

NamedPairs tested_names(const RobotCheckerHandle& self) {
  NamedPairs names;
  for (const auto& [a, b] : self.checker().tested().list())
    names.emplace_back(self.robot->link_name(a), self.robot->link_name(b));
  return names;
}

constexpr const char* collides_doc =
    "collides(self, q, *, against='all', threads=None, progress=None)\n--\n\n"
    "Tell which configurations collide.\n\n"
    "q: shape (n, dof), or (dof,) for one; rad or m, columns as Robot.joint_names. Joint limits are not checked.\n"
    "Float64 arrays in C order are not copied. against: 'all', or only 'self' (links against links) or\n"
    "'environment' (links and held bodies against bodies). Returns booleans of shape (n,), or one bool.\n"
    "Raises TypeError and ValueError for bad arrays.";

}  // namespace

void bind_robot_checker(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(LinkPairRow, configuration, first, second, triangle1, triangle2, distance, threshold);
  PYBIND11_NUMPY_DTYPE(LinkDistanceRow, configuration, first, second, triangle1, triangle2, distance, gap, point1,
                       point2, normal, collides);
  module.attr("pair_dtype") = py::dtype::of<LinkPairRow>();
  module.attr("distance_dtype") = py::dtype::of<LinkDistanceRow>();
  RobotCheckerClass checker(module, "CheckerBase", "A checker; see Checker.");
  checker.def(py::init(&make_checker))
      .def("collides", &collides, py::arg("q"), py::kw_only(), py::arg("against") = "all",
           py::arg("threads") = py::none(), py::arg("progress") = py::none(), collides_doc)
      .def("link_poses", &link_poses, py::arg("q"), py::kw_only(), py::arg("threads") = py::none(),
           py::arg("progress") = py::none(),
           "link_poses(self, q, *, threads=None, progress=None)\n--\n\n"
           "Return the world poses of the link frames: shape (n, n_links, 4, 4), or (n_links, 4, 4) for one.\n\n"
           "q: as in collides(). Links are in the order of Robot.links; translations in m.")
      .def("calibrate", &calibrate, py::arg("q"),
           "calibrate(self, q)\n--\n\n"
           "Learn from configurations which pairs of links to test first. Answers do not change, only their time.\n\n"
           "q: some hundred typical configurations, shape (n, dof).")
      .def("_allow_links", &allow_links)
      .def("_set_base",
           [](RobotCheckerHandle& self, const py::object& base) {
             RobotChecker next = self.checker();
             next.set_base(as_pose(base, "base"));
             self.replace(next);
           })
      .def("_set_environment",
           [](RobotCheckerHandle& self, const std::shared_ptr<EnvironmentHandle>& environment, bool has_base) {
             check_environment(self.robot, environment.get(), self.checker().engine(), has_base);
             self.environment = environment;
             self.replace(self.checker());  // copies of the former bodies go
           })
      .def("_base", [](const RobotCheckerHandle& self) { return to_matrix(self.checker().base()); })
      .def_property_readonly("dof", &RobotCheckerHandle::dof, "Number of values of a configuration.")
      .def_property_readonly(
          "threads", [](const RobotCheckerHandle& self) { return self.threads; },
          "Default number of threads of a call.")
      .def_property_readonly(
          "clearance", [](const RobotCheckerHandle& self) { return self.checker().margins().clearance(); },
          "Distance that links keep, m.")
      .def_property_readonly(
          "engine", [](const RobotCheckerHandle& self) { return self.checker().engine(); }, "Name of the engine.")
      .def_property_readonly("tested_pairs", &tested_names, "Pairs of link names that are tested, sorted by link.");
  add_robot_pairs(checker);
  add_clearances(checker);
  add_robot_relaxation(checker);
  add_robot_planning(checker);
  add_robot_paths(checker);
  add_two_robots(checker);
}

}  // namespace hinge::python
