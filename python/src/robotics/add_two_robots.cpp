// SPDX-License-Identifier: BSD-3-Clause
// A robot against another robot, each at its base.
#include <pybind11/pybind11.h>

#include "robot_checker_handle.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

namespace {

/// Configurations of two robots: as many of one as of the other, or one for all.
struct TwoRobots {
  TwoRobots(RobotCheckerHandle& self, RobotCheckerHandle& other, const py::object& q, const py::object& q_other)
      : mine(as_configurations(q, "q", self.dof())),
        theirs(as_configurations(q_other, "q_other", other.dof())),
        count(mine.one ? theirs.count : mine.count),
        pool(self.pool),
        other_pool(other.pool) {
    if (&self == &other) throw py::value_error("other: the checker itself, expected another one");
    if (!mine.one && !theirs.one && mine.count != theirs.count)
      throw py::value_error("q and q_other: " + std::to_string(mine.count) + " and " + std::to_string(theirs.count) +
                            " configurations, expected the same number, or one");
  }

  /// Calls work(checker, other, k) at the two configurations k.
  template <class Work>
  void run(unsigned threads, const py::object& progress, const Work& work) {
    run_slices(count, threads, progress, [&]() -> Slice {
      const auto first = std::make_shared<RobotPool::Loan>(*pool),
                 second = std::make_shared<RobotPool::Loan>(*other_pool);
      return [&, first, second](std::size_t from, std::size_t to) {
        for (std::size_t k = from; k < to; ++k) {
          (*first)->update(mine, mine.one ? 0 : k);
          (*second)->update(theirs, theirs.one ? 0 : k, "q_other");
          work((*first)->checker, (*second)->checker, k);
        }
      };
    });
  }

  Configurations mine, theirs;
  std::size_t count;
  std::shared_ptr<RobotPool> pool, other_pool;
};

py::object collides_with(RobotCheckerHandle& self, RobotCheckerHandle& other, const py::object& q,
                         const py::object& q_other, const py::object& threads, const py::object& progress) {
  TwoRobots two(self, other, q, q_other);
  std::vector<std::uint8_t> verdicts(two.count);
  two.run(as_threads(threads, self.threads), progress,
          [&](RobotChecker& a, RobotChecker& b, std::size_t k) { verdicts[k] = a.collides(b) ? 1 : 0; });
  if (two.mine.one && two.theirs.one) return py::bool_(verdicts[0] != 0);
  return to_booleans(std::move(verdicts));
}

py::object pairs_with(RobotCheckerHandle& self, RobotCheckerHandle& other, const py::object& q,
                      const py::object& q_other, const py::object& within, const py::object& threads,
                      const py::object& progress) {
  const double margin = as_length(within, "within", "m");
  TwoRobots two(self, other, q, q_other);
  std::vector<std::vector<LinkPairRow>> rows(two.count);
  two.run(as_threads(threads, self.threads), progress, [&](RobotChecker& a, RobotChecker& b, std::size_t k) {
    for (const LinkContact& c : a.within(b, margin))
      rows[k].push_back({static_cast<std::int64_t>(k), link_row(c.link1), link_row(c.link2),
                         static_cast<std::uint32_t>(index(c.hit.first)),
                         static_cast<std::uint32_t>(index(c.hit.second)), c.hit.distance, c.hit.threshold});
  });
  return joined_rows(rows);
}

py::object closest_with(RobotCheckerHandle& self, RobotCheckerHandle& other, const py::object& q,
                        const py::object& q_other, const py::object& threads, const py::object& progress) {
  TwoRobots two(self, other, q, q_other);
  std::vector<std::vector<LinkDistanceRow>> rows(two.count);
  two.run(as_threads(threads, self.threads), progress, [&](RobotChecker& a, RobotChecker& b, std::size_t k) {
    if (const auto found = a.closest(b)) rows[k].push_back(distance_row(k, *found));
  });
  return joined_rows(rows);
}

constexpr const char* collides_with_doc =
    "collides_with(self, other, q, q_other, *, threads=None, progress=None)\n--\n\n"
    "Tell whether this robot collides with another one, each at its base.\n\n"
    "other: its Checker, with the same engine; it may be of the same Robot. q, q_other: shape (n, dof) of each robot,\n"
    "or (dof,) for one of all. All pairs of links of the two are tested, no bodies; the larger clearance holds.\n"
    "Returns booleans of shape (n,), or one bool.";

}  // namespace

void add_two_robots(RobotCheckerClass& checker) {
  const auto threads = [] { return py::arg("threads") = py::none(); };
  const auto progress = [] { return py::arg("progress") = py::none(); };
  checker
      .def("collides_with", &collides_with, py::arg("other"), py::arg("q"), py::arg("q_other"), py::kw_only(),
           threads(), progress(), collides_with_doc)
      .def("pairs_with", &pairs_with, py::arg("other"), py::arg("q"), py::arg("q_other"), py::kw_only(),
           py::arg("within") = 0.0, threads(), progress(),
           "pairs_with(self, other, q, q_other, *, within=0.0, threads=None, progress=None)\n--\n\n"
           "Return the pairs of links of two robots that collide, or with d < threshold + within, as rows of "
           "pairs().\n\n"
           "first is a link of this robot, second one of the other. Arguments as in collides_with().")
      .def("closest_with", &closest_with, py::arg("other"), py::arg("q"), py::arg("q_other"), py::kw_only(), threads(),
           progress(),
           "closest_with(self, other, q, q_other, *, threads=None, progress=None)\n--\n\n"
           "Return the closest pair of links of two robots for each k, as rows of distances().\n\n"
           "first is a link of this robot, second one of the other. Arguments as in collides_with().");
}

}  // namespace hinge::python
