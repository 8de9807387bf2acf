// SPDX-License-Identifier: BSD-3-Clause
// expect_right: a case whose truth is known, on every engine.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <variant>
#include <vector>

#include "robustness/case.hpp"
#include "robustness/judge.hpp"
#include "robustness/run.hpp"

namespace hinge::robustness {

/// Cases per family.
inline std::size_t case_count() { return std::getenv("HINGE_TEST_ALL") != nullptr ? 100'000 : 1'000; }

inline Truth to_refuse() {
  Truth truth;
  truth.refuse = true;
  return truth;
}

inline std::string text(const std::vector<double>& values) {
  std::string line;
  for (const double x : values) {
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), " %a", x);
    line += digits.data();
  }
  return line;
}

/// The numbers of small cases, so that a failure can be reproduced without its seed.
inline std::string text(const Case& one) {
  std::string line = one.family;
  const auto* pair = std::get_if<TrianglePair>(&one.input);
  if (pair != nullptr) line.append(": a").append(text(pair->a)).append(", b").append(text(pair->b));
  const auto* atoms = std::get_if<Atoms>(&one.input);
  if (atoms != nullptr && atoms->count <= 4)
    line.append(": x").append(text(atoms->x)).append(", M").append(text(atoms->thresholds));
  return line;
}

inline testing::AssertionResult expect_right(const Case& one) {
  auto result = testing::AssertionSuccess();
  for (const auto& [engine, name] : engine_names)
    for (const std::string& fault : faults(one, run(one, engine)))
      (result = testing::AssertionFailure() << result.message()) << name << ", " << fault << '\n';
  if (!result) result << text(one) << '\n';
  return result;
}

}  // namespace hinge::robustness
