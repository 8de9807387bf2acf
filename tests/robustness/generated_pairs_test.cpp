// SPDX-License-Identifier: BSD-3-Clause
// Tests atoms and triangle pairs of every family on every engine against exact rationals.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#if __has_include(<boost/multiprecision/cpp_int.hpp>)
#include "hinge/core/finite.hpp"
#include "primitive/triangle_families.hpp"
#include "primitive/triangle_oracle.hpp"
#include "robustness/atom_families.hpp"
#include "robustness/case.hpp"
#include "robustness/exact_atoms.hpp"
#include "robustness/expect_right.hpp"

namespace hinge::robustness {
namespace generated_pairs_test {

using test::AtomFamily;
using test::OracleDistance;
using test::Random;
using test::TriangleFamily;

class AtomFamilies : public testing::TestWithParam<AtomFamily> {};

TEST_P(AtomFamilies, EqualExactAnswers) {
  expect_family(31, GetParam().name, "atoms", [&](Random& random, Case& one) {
    one.input = GetParam().make(random);
    if (!GetParam().refuse) one.truth = test::exact_truth(std::get<Atoms>(one.input));
  });
}

INSTANTIATE_TEST_SUITE_P(Generated, AtomFamilies, testing::ValuesIn(test::atom_families()),
                         [](const auto& family) { return std::string(family.param.name); });

std::vector<double> nine(const Triangle& t) {
  std::vector<double> x;
  for (const Vec3* corner : {&t.a, &t.b, &t.c}) x.insert(x.end(), corner->data(), corner->data() + 3);
  return x;
}

class TriangleFamilies : public testing::TestWithParam<TriangleFamily> {};

TEST_P(TriangleFamilies, EqualExactAnswers) {
  expect_family(32, GetParam().name, "tri_tri", [&](Random& random, Case& one) {
    const auto [p, q] = GetParam().make(random);
    one.input = TrianglePair{nine(p), nine(q)};
    one.truth = Truth{};
    const OracleDistance oracle(p, q);
    for (const Triangle& t : {p, q})
      for (const Vec3& corner : {t.a, t.b, t.c}) one.truth->refuse |= !is_length(corner);
    one.truth->hit = oracle.meet();
    one.truth->pair_count = oracle.meet() ? 1 : 0;
    one.truth->distance = test::bracket_of(oracle.distance());
  });
}

INSTANTIATE_TEST_SUITE_P(Generated, TriangleFamilies, testing::ValuesIn(test::triangle_families()),
                         [](const auto& family) { return family.param.name; });

}  // namespace generated_pairs_test
}  // namespace hinge::robustness

#else
TEST(GeneratedPairs, NeedBoostMultiprecision) { GTEST_SKIP() << "boost/multiprecision was not found (libboost-dev)"; }
#endif
