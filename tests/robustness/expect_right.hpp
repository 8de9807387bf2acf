// SPDX-License-Identifier: BSD-3-Clause
// Checks cases with known answers on every engine.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <variant>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "robustness/case.hpp"
#include "robustness/judge.hpp"
#include "robustness/run.hpp"

namespace hinge::robustness {

/// Returns the number of cases per family.
inline std::size_t case_count() { return std::getenv("HINGE_TEST_ALL") != nullptr ? 100'000 : 1'000; }

/// Returns the truth of an invalid input.
inline Truth to_refuse() {
  Truth truth;
  truth.refuse = true;
  return truth;
}

/// Returns the values as hexadecimal doubles.
inline std::string text(const std::vector<double>& values) {
  std::string line;
  for (const double x : values) {
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), " %a", x);
    line += digits.data();
  }
  return line;
}

/// Returns the numbers of a small case, to reproduce a failure without its seed.
inline std::string text(const Case& one) {
  std::string line = one.family;
  const auto* pair = std::get_if<TrianglePair>(&one.input);
  if (pair != nullptr) line.append(": a").append(text(pair->a)).append(", b").append(text(pair->b));
  const auto* atoms = std::get_if<Atoms>(&one.input);
  if (atoms != nullptr && atoms->count <= 4)
    line.append(": x").append(text(atoms->x)).append(", M").append(text(atoms->thresholds));
  return line;
}

/// Runs a case on every engine and returns a failure that lists all errors.
inline testing::AssertionResult expect_right(const Case& one) {
  auto result = testing::AssertionSuccess();
  for (const auto& [engine, name] : engine_names)
    for (const std::string& fault : faults(one, run(one, engine)))
      (result = testing::AssertionFailure() << result.message()) << name << ", " << fault << '\n';
  if (!result) result << text(one) << '\n';
  return result;
}

/// Generates the cases of a family and expects right answers from all engines. make(random, case) sets input and truth.
/// Stops at the first failure; prints `also()` after the counts.
template <class Make, class Also>
void expect_family(std::uint64_t seed, const std::string& name, const char* kind, const Make& make, const Also& also) {
  test::Random random(seed);
  std::size_t hits = 0;
  for (std::size_t k = 0; k < case_count() && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(k));
    Case one{name, kind, name, {}, to_refuse()};
    make(random, one);
    hits += one.truth->hit ? 1 : 0;
    EXPECT_TRUE(expect_right(one));
  }
  std::cout << case_count() << " cases, seed " << seed << ", " << hits << " collide" << also() << '\n';
}
template <class Make>
void expect_family(std::uint64_t seed, const std::string& name, const char* kind, const Make& make) {
  expect_family(seed, name, kind, make, [] { return ""; });
}

}  // namespace hinge::robustness
