// SPDX-License-Identifier: BSD-3-Clause
// Compares engine/simd and engine/lazy with brute force on any molecule: verdicts, pairs and distances, in every mode.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"

namespace hinge::test {

/// Tests `count` conformations over the full range and `count` near the reference; 10 * count if HINGE_TEST_ALL is set.
/// spec: the free torsions.
inline void expect_engines_agree(const std::shared_ptr<const molecular::Molecule>& molecule, const std::string& spec,
                                 int count) {
  using molecular::Checker;
  using molecular::Mode;
  constexpr std::uint64_t seed = 7;
  if (std::getenv("HINGE_TEST_ALL") != nullptr) count *= 10;
  const auto selection = molecule->select(molecular::select_torsions(*molecule, spec, false));
  molecular::CheckOptions rules;
  rules.exempt_reference = true;  // reference collisions would decide near the reference
  Checker simd(molecule, selection, rules);
  rules.engine = "lazy";
  Checker lazy(molecule, selection, rules);
  rules.engine = "brute";
  Checker brute(molecule, selection, rules);
  int colliding[2] = {0, 0};
  const molecular::Sampling samplings[2] = {{seed, {}}, {seed, std::numbers::pi / 180 * 0.1}};
  for (int s = 0; s < 2; ++s)
    for (int k = 0; k < count; ++k) {
      const auto q = sample_configuration(samplings[s], static_cast<std::uint64_t>(k), brute.dof_count());
      for (const char* text : {"any", "all", "within:0.3", "closest"}) {
        const Mode mode = Mode::parse(text);
        const auto expected = brute.check(q, mode);
        for (Checker* fast : {&simd, &lazy}) {
          const auto found = fast->check(q, mode);
          ASSERT_EQ(found.collides, expected.collides) << text << " sample " << k;
          ASSERT_EQ(found.pairs, expected.pairs) << text << " sample " << k;
          ASSERT_EQ(found.closest.has_value(), expected.closest.has_value()) << text << " sample " << k;
          if (found.closest) {
            ASSERT_EQ(found.closest->hit.gap(), expected.closest->hit.gap()) << text << " sample " << k;
          }
        }
        if (mode.kind == Mode::Kind::any) colliding[s] += expected.collides ? 1 : 0;
      }
    }
  std::printf("%s, %s: seed %d, %zu DOF, %d of %d random and %d of %d near-native conformations collide\n",
              molecule->structure().name.c_str(), spec.c_str(), static_cast<int>(seed), brute.dof_count(), colliding[0],
              count, colliding[1], count);
}

}  // namespace hinge::test
