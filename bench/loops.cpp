// SPDX-License-Identifier: BSD-3-Clause
// Loops of 1UBQ, closed from random starts by the solver and by cyclic coordinate descent on the same tree, to the
// tolerance of that paper and to 1e-6 angstrom. Prints the share of closed starts and the time of a start.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/read_structure.hpp"

namespace {

using namespace hinge;
using namespace hinge::molecular;

/// CPU time of this thread in microseconds, because other programs share the machine.
double thread_microseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// A. Canutescu and R. Dunbrack, "Cyclic coordinate descent", Protein Science 12, 2003: sets one torsion at a time to
/// the value that moves the end closest to its target. For one loop: a chain of joints and the closure at its end.
class CoordinateDescent {
 public:
  CoordinateDescent(const KinematicTree& tree, const DofSelection& selection) : groups_(tree, selection) {
    const Closure& closure = tree.closures()[0];
    std::size_t g = index(groups_.group_of(closure.first));
    for (; g != 0; g = index(groups_[id<GroupId>(g)].parent)) chain_.insert(chain_.begin(), g);
    for (std::size_t k = 0; k < 2; ++k) {
      end_[k] = groups_.link_in_group(closure.first) * closure.in_first[k];
      target_[k] = closure.in_second[k];
    }
  }

  bool close(std::vector<double>& q, double tolerance, int most_sweeps) {
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      std::vector<Pose> before;  // pose of each joint without its own motion
      Pose pose;
      for (const std::size_t g : chain_) {
        const RigidGroup& group = groups_[id<GroupId>(g)];
        before.push_back(pose * group.joint.origin);
        pose = before.back() * motion(group.joint, q[group.dof]);
      }
      std::array<Vec3, 2> x{pose * end_[0], pose * end_[1]};
      if (std::max(norm(Vec3(x[0] - target_[0])), norm(Vec3(x[1] - target_[1]))) <= tolerance) return true;
      for (std::size_t k = chain_.size(); k-- > 0;) {
        const RigidGroup& group = groups_[id<GroupId>(chain_[k])];
        const Vec3 axis = product(before[k].rotation, group.joint.axis), point = before[k] * group.joint.point;
        double along = 0.0, across = 0.0;
        for (std::size_t e = 0; e < 2; ++e) {
          const Vec3 r = x[e] - point, f = target_[e] - point, out = r - axis * dot(axis, r);
          along += dot(f, out);
          across += dot(f, cross(axis, out));
        }
        const double turn = std::atan2(across, along);
        q[group.dof] += turn;
        const Mat3 rotation = rotation_about(axis, turn);
        for (Vec3& e : x) e = point + product(rotation, Vec3(e - point));
      }
    }
    return false;
  }

 private:
  RigidGroups groups_;
  std::vector<std::size_t> chain_;
  std::array<Vec3, 2> end_{}, target_{};
};

struct Row {
  std::uint64_t closed = 0;
  double us = 0.0;
};

template <class Close>
Row measure(std::size_t dofs, std::uint64_t starts, const Close& close) {
  Row row;
  for (std::uint64_t k = 0; k < starts; ++k) {
    std::vector<double> q = sample_configuration({1, {}}, k, dofs);
    const double start = thread_microseconds();
    row.closed += close(q) ? 1U : 0U;
    row.us += thread_microseconds() - start;
  }
  return row;
}

void print(const Row& row, std::uint64_t starts) {
  const auto n = static_cast<double>(starts), closed = static_cast<double>(row.closed);
  std::printf(" %5.1f %% %8.1f us %7.0f/s |", 100.0 * closed / n, row.us / n,
              row.us > 0.0 ? 1e6 * closed / row.us : 0.0);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t starts = argc > 1 ? static_cast<std::uint64_t>(std::atoll(argv[1])) : 500;
  const Structure s = read_structure(std::string(HINGE_SOURCE_DIR) + "/molecular/data/1ubq.pdb");
  std::printf(
      "flags: %s; %llu uniform starts per loop, seed 1; columns: closed, time per start, closed loops per second\n",
      HINGE_BENCH_FLAGS, static_cast<unsigned long long>(starts));
  std::printf(
      "residues DOF |     solver to 1e-9 A           |     descent to 0.08 A          |     descent to 1e-6 A\n");
  for (const char* word : {"A:60-62", "A:8-11", "A:7-11", "A:44-50", "A:44-53", "A:40-54", "A:44-63"}) {
    MoleculeOptions options;
    options.loops = find_loops(s, word);
    const Molecule m(s, options);
    const DofSelection selection = m.select(select_loop_torsions(m, "none", false));
    ClosureSolver solver(m.model().tree(), selection);
    CoordinateDescent descent(m.model().tree(), selection);
    std::printf("%8u %3zu |", options.loops[0].last - options.loops[0].first + 1, selection.size());
    print(measure(selection.size(), starts, [&](std::vector<double>& q) { return solver.close(q); }), starts);
    for (const double tolerance : {0.08, 1e-6})
      print(
          measure(selection.size(), starts, [&](std::vector<double>& q) { return descent.close(q, tolerance, 5000); }),
          starts);
    std::printf("\n");
  }
  return 0;
}
