// SPDX-License-Identifier: BSD-3-Clause
// run: the input of a case put to one engine, in every way there is.
#pragma once

#include <variant>
#include <vector>

#include "robustness/case.hpp"

namespace hinge::robustness {

// What the library refuses is an answer; any other exception passes.
std::vector<Answer> run(const TrianglePair& pair, EngineName engine);
std::vector<Answer> run(const Atoms& atoms, EngineName engine);
std::vector<Answer> run(const MeshPair& pair, EngineName engine);
std::vector<Answer> run(const Chain& chain, EngineName engine);

inline std::vector<Answer> run(const Case& one, EngineName engine) {
  return std::visit([engine](const auto& input) { return run(input, engine); }, one.input);
}

}  // namespace hinge::robustness
