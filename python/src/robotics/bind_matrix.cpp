// SPDX-License-Identifier: BSD-3-Clause
// Collision matrices: the pairs of links that need no test, with reasons.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <limits>
#include <sstream>

#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/write_srdf.hpp"
#include "robot_handle.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

namespace {

/// One pair of links.
struct MatrixRow {
  std::int32_t first, second;
  std::int8_t kind;  ///< PairKind
  std::int64_t samples, hits, cells;
  double smallest_gap;  ///< m; infinity: not computed
};

/// A matrix with the robot it is of.
struct MatrixHandle {
  using MadeByInit = void;
  RobotHandle robot;
  CollisionMatrix matrix;
};

/// Reports progress about ten times a second, in thousandths of each of the two stages.
class StageProgress {
 public:
  explicit StageProgress(const py::object& progress) : progress_(progress) { check_progress(progress); }
  /// Called without the interpreter's lock.
  void tell(const MatrixProgress& at) {
    const auto now = std::chrono::steady_clock::now();
    if (progress_.is_none() || now < next_) return;
    next_ = now + std::chrono::milliseconds(100);
    const auto done = static_cast<std::size_t>(at.fraction * static_cast<double>(steps));
    const py::gil_scoped_acquire lock;
    report_progress(progress_, at.stage == MatrixProgress::Stage::sampling ? done : steps + done, 2 * steps);
  }
  void end() const { report_progress(progress_, 2 * steps, 2 * steps); }

 private:
  static constexpr std::size_t steps = 1000;
  const py::object& progress_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
};

std::unique_ptr<MatrixHandle> find_matrix(const RobotHandle& robot, std::size_t samples, std::uint64_t seed,
                                          std::size_t cells, double clearance,
                                          const std::vector<std::pair<std::string, std::string>>& settled,
                                          const py::object& progress) {
  MatrixOptions options{samples, seed, cells, clearance, robot.srdf.disabled};
  for (const auto& [a, b] : link_pairs_named(*robot, settled, "settled").list()) options.settled.insert(a, b);
  auto made = std::make_unique<MatrixHandle>();
  made->robot = robot;
  StageProgress told(progress);
  run_slices(1, 1, py::none(), [&]() -> Slice {
    return [&](std::size_t, std::size_t) {
      made->matrix = find_collision_matrix(*robot, options, [&](const MatrixProgress& at) {
        poll();
        told.tell(at);
      });
    };
  });
  told.end();
  return made;
}

py::array_t<MatrixRow> matrix_rows(const MatrixHandle& self) {
  std::vector<MatrixRow> rows;
  for (const MatrixEntry& entry : self.matrix.entries)
    rows.push_back({link_row(entry.link1), link_row(entry.link2), static_cast<std::int8_t>(entry.kind),
                    static_cast<std::int64_t>(entry.samples), static_cast<std::int64_t>(entry.hits),
                    static_cast<std::int64_t>(entry.cells),
                    entry.smallest_gap.value_or(std::numeric_limits<double>::infinity())});
  return to_array(std::move(rows));
}

UnseenPairs as_unseen(bool disabled) { return disabled ? UnseenPairs::disabled : UnseenPairs::tested; }

std::string matrix_text(const MatrixHandle& self, bool disable_unseen) {
  std::ostringstream out;
  if (self.robot.srdf_text)
    merge_srdf_text(*self.robot.srdf_text, self.robot.srdf, *self.robot, self.matrix, out, as_unseen(disable_unseen));
  else
    write_srdf(*self.robot, self.matrix, out, as_unseen(disable_unseen));
  return out.str();
}

std::vector<std::pair<std::string, std::string>> disabled_names(const MatrixHandle& self, bool disable_unseen) {
  std::vector<std::pair<std::string, std::string>> names;
  LinkPairs pairs = disabled_pairs(*self.robot, self.matrix, as_unseen(disable_unseen));
  for (const auto& [a, b] : self.robot.srdf.disabled.list()) pairs.insert(a, b);
  for (const auto& [a, b] : self.robot.srdf.enabled.list()) pairs.erase(a, b);
  for (const auto& [a, b] : pairs.list()) names.emplace_back(self.robot->link_name(a), self.robot->link_name(b));
  return names;
}

}  // namespace

void add_matrix(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(MatrixRow, first, second, kind, samples, hits, cells, smallest_gap);
  py::class_<MatrixHandle>(module, "MatrixBase", "A collision matrix; see CollisionMatrix.")
      .def(py::init(&find_matrix))
      .def("_rows", &matrix_rows)
      .def("_srdf", &matrix_text)
      .def("_disabled", &disabled_names);
}

}  // namespace hinge::python
