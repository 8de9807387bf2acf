// SPDX-License-Identifier: BSD-3-Clause
// Runs points on every engine.
#include "robustness/run.hpp"
#include "robustness/run_atoms.hpp"

namespace hinge::robustness {

std::vector<Answer> run(const Atoms& atoms, EngineName engine) {
  return {on(engine, [&]<template <class, class, class> class EngineOf>() { return run_atoms<EngineOf>(atoms); })};
}

}  // namespace hinge::robustness
