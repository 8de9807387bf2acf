// SPDX-License-Identifier: BSD-3-Clause
// require: what a target asserts. A failure aborts, which fuzzer and replay alike count as a find.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "hinge/core/error.hpp"

namespace fuzz {

[[noreturn]] inline void find(const std::string& what) {
  std::fprintf(stderr, "find: %s\n", what.c_str());
  std::abort();
}

inline void require(bool holds, const char* what) {
  if (!holds) find(what);
}

/// Runs `f`, which may refuse its input with one of Hinge's own exceptions; any other leaves the target and is a find.
/// True when nothing was thrown.
template <class F>
bool accepts(const F& f) {
  try {
    f();
    return true;
  } catch (const hinge::LoadError& error) {
    require(error.what()[0] != '\0', "a refusal without a word");
  } catch (const hinge::ModelError& error) {
    require(error.what()[0] != '\0', "a refusal without a word");
  } catch (const hinge::ConfigurationError& error) {
    require(error.what()[0] != '\0', "a refusal without a word");
  }
  return false;
}

}  // namespace fuzz
