// SPDX-License-Identifier: BSD-3-Clause
// Runs the input of a case on one engine, in all ways of asking.
#pragma once

#include <variant>
#include <vector>

#include "robustness/case.hpp"

namespace hinge::robustness {

// An error of the library is an answer; any other exception propagates.
std::vector<Answer> run(const TrianglePair& pair, EngineName engine);
std::vector<Answer> run(const Atoms& atoms, EngineName engine);
std::vector<Answer> run(const MeshPair& pair, EngineName engine);
std::vector<Answer> run(const Chain& chain, EngineName engine);

inline std::vector<Answer> run(const Case& one, EngineName engine) {
  return std::visit([engine](const auto& input) { return run(input, engine); }, one.input);
}

}  // namespace hinge::robustness
