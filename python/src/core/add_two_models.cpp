// SPDX-License-Identifier: BSD-3-Clause
// A model from arrays against another one, both in the same world frame.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "core_checker.hpp"
#include "hinge/core/error.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;

namespace {

/// The pairs of a call between two models, and their configurations: as many of one as of the other, or one for all.
struct TwoModels {
  /// across: None, or (admitted, excluded pairs) with the shapes already checked.
  TwoModels(CoreChecker& self, CoreChecker& other, const py::object& q, const py::object& q_other,
            const py::tuple& across)
      : pool(self.pool),
        other_pool(other.pool),
        mine(as_configurations(q, "q", self.dof)),
        theirs(as_configurations(q_other, "q_other", other.dof)),
        count(mine.one ? theirs.count : mine.count),
        table(table_of(self, other, across)) {
    if (pool.prototype().kind != other_pool.prototype().kind)
      throw py::value_error("other: another kind of primitives or another engine, expected those of this checker");
    if (!mine.one && !theirs.one && mine.count != theirs.count)
      throw py::value_error("q and q_other: " + std::to_string(mine.count) + " and " + std::to_string(theirs.count) +
                            " configurations, expected the same number, or one");
  }

  /// Calls work(queries, other queries, k) at the two configurations k.
  template <class Work>
  void run(unsigned threads, const py::object& progress, const Work& work) {
    using Loan = WorkerPool<CoreQueries>::Loan;
    run_slices(count, threads, progress, [&]() -> Slice {
      const auto first = std::make_shared<Loan>(pool), second = std::make_shared<Loan>(other_pool);
      return [&, first, second](std::size_t from, std::size_t to) {
        for (std::size_t k = from; k < to; ++k) {
          (*first)->update(mine[mine.one ? 0 : k]);
          (*second)->update(theirs[theirs.one ? 0 : k]);
          work(**first, **second, k);
        }
      };
    });
  }

  static CrossTable table_of(const CoreChecker& self, const CoreChecker& other, const py::tuple& across) {
    CrossTable::Data data;
    if (!across[0].is_none()) {
      const auto admitted = py::array_t<bool, py::array::c_style | py::array::forcecast>::ensure(across[0]);
      data.group = self.group_of;
      data.other_group = other.group_of;
      data.columns = static_cast<std::size_t>(admitted.shape(1));
      data.admitted.assign(admitted.data(), admitted.data() + admitted.size());
      const auto check = [](const std::vector<std::uint32_t>& groups, py::ssize_t end) {
        for (const std::uint32_t group : groups)
          if (static_cast<py::ssize_t>(group) >= end)
            throw py::value_error("admitted: group " + std::to_string(group) +
                                  " has no row or column, expected shape "
                                  "(groups of this checker, groups of the other)");
      };
      check(data.group, admitted.shape(0));
      check(data.other_group, admitted.shape(1));
    }
    data.excluded = across[1].cast<std::vector<std::pair<std::uint32_t, std::uint32_t>>>();
    return CrossTable(std::move(data));
  }

  WorkerPool<CoreQueries>&pool, &other_pool;
  Configurations mine, theirs;
  std::size_t count;
  CrossTable table;
};

py::object collides_with(CoreChecker& self, CoreChecker& other, const py::object& q, const py::object& q_other,
                         const py::tuple& across, const py::object& threads, const py::object& progress) {
  TwoModels two(self, other, q, q_other, across);
  std::vector<std::uint8_t> verdicts(two.count);
  two.run(as_threads(threads, self.threads), progress, [&](const CoreQueries& a, const CoreQueries& b, std::size_t k) {
    verdicts[k] = a.collides_with(b, two.table) ? 1 : 0;
  });
  if (two.mine.one && two.theirs.one) return py::bool_(verdicts[0] != 0);
  return to_booleans(std::move(verdicts));
}

/// within: None asks for the closest pair.
py::object pairs_with(CoreChecker& self, CoreChecker& other, const py::object& q, const py::object& q_other,
                      const py::tuple& across, const py::object& within, const py::object& threads,
                      const py::object& progress) {
  const bool closest = within.is_none();
  const double margin = closest ? 0.0 : as_margin(within);
  TwoModels two(self, other, q, q_other, across);
  std::vector<std::vector<CorePairRow>> rows(two.count);
  two.run(as_threads(threads, self.threads), progress, [&](const CoreQueries& a, const CoreQueries& b, std::size_t k) {
    if (!closest) {
      for (const Hit& hit : a.within_of(b, two.table, margin)) rows[k].push_back(row_of(k, hit));
    } else if (const std::optional<Hit> hit = a.closest_of(b, two.table)) {
      rows[k].push_back(row_of(k, *hit));
    }
  });
  return to_array(joined(rows));
}

}  // namespace

void add_two_models(CoreCheckerClass& checker) {
  checker.def("_collides_with", &collides_with).def("_pairs_with", &pairs_with);
}

}  // namespace hinge::python
