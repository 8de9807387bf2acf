// SPDX-License-Identifier: BSD-3-Clause
// Code for this CPU and libraries for the baseline in one program, as when a user compiles with -march=native and links
// an installed library. This file is not optimised: the compiler then emits all inline functions, and the linker uses
// them for the libraries, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hinge/hinge.hpp"
#include "hinge/molecular/molecular.hpp"
#include "hinge/robotics/robotics.hpp"
#include "isa/doubled.hpp"

namespace hinge {
namespace {

constexpr std::uint64_t seed = 41;

template <class T>
constexpr bool is_aligned_to_its_size(std::size_t size) {
  const bool has_size = sizeof(T) == size;
  return has_size && alignof(T) == size;
}

// Layouts must not depend on the instruction set: these types are members of others.
static_assert(is_aligned_to_its_size<detail::simd::Float4>(16) && is_aligned_to_its_size<detail::simd::Double4>(32));
static_assert(is_aligned_to_its_size<detail::simd::Float16>(64) && is_aligned_to_its_size<detail::simd::Double8>(64));
static_assert(is_aligned_to_its_size<detail::simd::Integer8>(64));

TEST(MixedFlags, LanesAreReturnedAsTheCallerExpects) {
  std::vector<float> numbers(detail::simd::width), here(numbers), there(numbers);
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<float>(k) + 0.5F;
  isa::doubled(numbers.data()).store(here.data());
  isa::store_doubled(numbers.data(), there.data());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    EXPECT_EQ(here[k], 2.0F * numbers[k]);
    EXPECT_EQ(there[k], 2.0F * numbers[k]);
  }
}

TEST(MixedFlags, MoleculeHasTheSameVerdictsAndCoordinates) {
  using namespace molecular;
  const auto molecule = std::make_shared<const Molecule>(build_ideal_protein("AKFDEGWSRLIVAKE", "HHHHHHCCEEEECCC"));
  std::vector<std::size_t> all(molecule->torsions().size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
  CheckOptions options;
  options.exempt_reference = true;
  Checker library(molecule, molecule->select(all), options);
  // The same types as inside the library, so that the linker chooses one copy of their functions.
  MolecularHierarchy<Simd> own(molecule->model(), molecule->select(all), library.exclusions(),
                               library.thresholds().matrix);
  StateBatch<Point, BondExclusions, TypedThresholds> blocks(molecule->model(), molecule->select(all),
                                                            library.exclusions(), library.thresholds().matrix);
  constexpr std::size_t size = decltype(blocks)::size, count = 8 * size;
  const std::size_t dof = library.dof_count();
  std::vector<double> conformations;
  std::vector<std::uint8_t> expected;
  std::size_t colliding = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::vector<double> q = sample_configuration({seed, k % 3 == 0 ? 0.3 : 0.01}, k, dof);
    conformations.insert(conformations.end(), q.begin(), q.end());
    const Verdict verdict = library.check(q, Mode::parse("all"));
    own.update(q);
    const std::vector<Hit> hits = own.self_collisions();
    ASSERT_EQ(hits.size(), verdict.pairs.size()) << k;
    for (std::size_t p = 0; p < hits.size(); ++p) EXPECT_EQ(hits[p], verdict.pairs[p].hit);
    for (std::uint32_t atom = 0; atom < molecule->model().size(); ++atom)
      ASSERT_EQ(own.placed(id<PrimitiveId>(atom)).position, library.position(atom)) << k << " " << atom;
    expected.push_back(verdict.collides ? 1 : 0);
    colliding += expected.back();
  }
  EXPECT_GT(colliding, count / 10);
  EXPECT_LT(colliding, count - count / 10);
  for (int round = 0; round < 4; ++round) EXPECT_EQ(library.check_batch(conformations), expected);
  for (std::size_t first = 0; first < count; first += size) {
    const std::uint32_t hits = blocks.collides(std::span(conformations).subspan(first * dof, size * dof));
    for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(hits >> k & 1U, expected[first + k]);
  }
}

robotics::RobotDescription arm(const robotics::Shape& shape) {
  using namespace robotics;
  RobotDescription arm{.name = "arm", .links = {}, .joints = {}};
  const Pose middle{Mat3::Identity(), {0.25, 0, 0}}, end{Mat3::Identity(), {0.5, 0, 0}};
  for (const char* name : {"base", "upper", "fore", "hand"})
    arm.links.push_back({.name = name, .geometry = {{shape, middle}}});
  for (std::size_t k = 0; k + 1 < arm.links.size(); ++k)
    arm.joints.push_back({.name = "joint" + std::to_string(k),
                          .type = JointType::revolute,
                          .parent = arm.links[k].name,
                          .child = arm.links[k + 1].name,
                          .origin = end,
                          .axis = {0, k == 1 ? 1.0 : 0.2, 1},
                          .lower = -3.1,
                          .upper = 3.1});
  return arm;
}

TEST(MixedFlags, RobotHasTheSameDistances) {
  using namespace robotics;
  const auto robot = std::make_shared<const Robot>(arm(BoxShape{{0.4, 0.1, 0.1}}));
  RobotChecker library(robot, tested_pairs(*robot), LinkMargins(*robot, 0.0));
  std::size_t apart = 0;
  for (std::uint64_t k = 0; k < 60; ++k) {
    const std::vector<double> q = molecular::sample_configuration({seed, 1.2}, k, 3);
    library.update(q);
    double closest = std::numeric_limits<double>::infinity();
    const auto triangles = robot->model().primitives();
    const auto links = robot->model().links();
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (std::size_t j = i + 1; j < triangles.size(); ++j)
        if (library.tested().contains(links[i], links[j]))
          closest = std::min(closest, distance(triangles[i].placed(library.link_pose(links[i])),
                                               triangles[j].placed(library.link_pose(links[j]))));
    EXPECT_EQ(library.collides(), closest == 0.0) << k;
    if (library.collides()) continue;
    const auto found = library.closest();
    ASSERT_TRUE(found);
    ++apart;
    EXPECT_NEAR(found->distance, closest, 1e-15);
    const auto rows = library.clearances(10.0);
    ASSERT_FALSE(rows.empty());
    // The library allocates the matrix and this file frees it.
    const ClearanceJacobian jacobian = library.jacobian(std::span(rows));
    EXPECT_EQ(jacobian.rows(), static_cast<Eigen::Index>(rows.size()));
    EXPECT_EQ(jacobian.cols(), 3);
  }
  EXPECT_GT(apart, 20U);
}

TEST(MixedFlags, SpheresHaveTheSameVerdictsInBlocks) {
  using namespace robotics;
  const auto robot = std::make_shared<const Robot>(arm(SphereShape{0.2}));
  RobotChecker library(robot, tested_pairs(*robot), LinkMargins(*robot, 0.0));
  const Model<Sphere> spheres = spheres_of(*robot);
  const DifferentLinks filter({spheres.links().begin(), spheres.links().end()});
  SphereBatch blocks(spheres, filter);
  Hierarchy own(spheres, filter, UniformClearance{0.0});
  constexpr std::size_t count = 4 * SphereBatch::size;
  std::vector<double> configurations;
  std::vector<std::uint8_t> expected, own_verdicts, of_blocks;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::vector<double> q = molecular::sample_configuration({seed, 1.5}, k, 3);
    configurations.insert(configurations.end(), q.begin(), q.end());
    library.update(q);
    expected.push_back(library.collides() ? 1 : 0);
    own.update(q);
    own_verdicts.push_back(own.self_collides() ? 1 : 0);
  }
  const auto colliding = std::count(expected.begin(), expected.end(), 1);
  EXPECT_TRUE(0 < colliding && colliding < std::ssize(expected)) << colliding;
  EXPECT_EQ(library.check_batch(configurations), expected);
  for (std::size_t first = 0; first < count; first += SphereBatch::size) {
    const std::uint32_t hits = blocks.each(std::span(configurations).subspan(3 * first, 3 * SphereBatch::size));
    for (std::size_t k = 0; k < SphereBatch::size; ++k) of_blocks.push_back(hits >> k & 1U);
  }
  EXPECT_EQ(of_blocks, own_verdicts);
}

}  // namespace
}  // namespace hinge
