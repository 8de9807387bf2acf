// SPDX-License-Identifier: BSD-3-Clause
// Runs triangles, meshes and chains of meshes on every engine.
#include "robustness/run.hpp"
#include "robustness/run_chain.hpp"
#include "robustness/run_mesh.hpp"
#include "robustness/run_tri.hpp"

namespace hinge::robustness {

std::vector<Answer> run(const TrianglePair& pair, EngineName engine) {
  return on(engine, [&]<template <class, class, class> class EngineOf>() { return run_tri<EngineOf>(pair); });
}

std::vector<Answer> run(const MeshPair& pair, EngineName engine) {
  return on(engine, [&]<template <class, class, class> class EngineOf>() { return run_mesh<EngineOf>(pair); });
}

std::vector<Answer> run(const Chain& chain, EngineName engine) {
  return {on(engine, [&]<template <class, class, class> class EngineOf>() { return run_chain<EngineOf>(chain); })};
}

}  // namespace hinge::robustness
