// SPDX-License-Identifier: BSD-3-Clause
// FCL compiled for this machine. FCL's headers declare their templates `extern`, so that they come from the library.
// This file removes that keyword and compiles them. It also renames the namespaces of FCL and Eigen, whose types
// depend on compiler flags, so that the linker never mixes symbols of this file and of the library.
#include <octomap/octomap.h>
#include <algorithm>
#include <array>
#include <bitset>
#include <cassert>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <queue>
#include <random>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <thread>
#include <unordered_map>
#include <unordered_set>
#include <vector>

// NOLINTBEGIN(bugprone-macro-parentheses): names, not expressions
#define Eigen eigen_for_fcl_native
#define fcl fcl_native
#include <ccd/ccd.h>
#include <ccd/quat.h>
#include <ccd/vec3.h>
#include <fcl/narrowphase/detail/convexity_based_algorithm/alloc.h>
#include <fcl/narrowphase/detail/convexity_based_algorithm/list.h>
#include <fcl/narrowphase/detail/convexity_based_algorithm/polytope.h>
#include <fcl/narrowphase/detail/convexity_based_algorithm/simplex.h>
#include <fcl/narrowphase/detail/convexity_based_algorithm/support.h>
#include <Eigen/Dense>
#include <Eigen/StdVector>

#include "oracle/fcl_robots.hpp"

#define extern
#include "oracle/define_fcl_robots.hpp"
#undef extern
// NOLINTEND(bugprone-macro-parentheses)

// The library alone defines functions that are not templates, so they are repeated here.
namespace fcl {

bool BVNodeBase::isLeaf() const { return first_child < 0; }
int BVNodeBase::primitiveId() const { return -(first_child + 1); }
int BVNodeBase::leftChild() const { return first_child; }
int BVNodeBase::rightChild() const { return first_child + 1; }
Triangle::Triangle() = default;
void Triangle::set(std::size_t p1, std::size_t p2, std::size_t p3) {
  vids[0] = p1;
  vids[1] = p2;
  vids[2] = p3;
}
std::size_t Triangle::operator[](int i) const { return vids[i]; }

// Mesh queries without front lists never call these functions.
namespace detail {
void updateFrontList(BVHFrontList* fronts, int, int) {
  if (fronts != nullptr) std::abort();
}
std::uint32_t morton_code(std::uint32_t, std::uint32_t, std::uint32_t) { std::abort(); }
std::uint64_t morton_code60(std::uint32_t, std::uint32_t, std::uint32_t) { std::abort(); }
template <>
double planeIntersectTolerance() {
  std::abort();
}
template <>
double halfspaceIntersectTolerance() {
  std::abort();
}
void ThrowFailedAtThisConfiguration(const std::string&, const char*, const char*, int) { std::abort(); }
}  // namespace detail

}  // namespace fcl

namespace hinge::oracle {

template class FclTrees<FclBuild::native>;
template class FclScene<FclBuild::native>;
template class FclRobot<FclBuild::native>;

}  // namespace hinge::oracle
