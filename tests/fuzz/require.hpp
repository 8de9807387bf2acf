// SPDX-License-Identifier: BSD-3-Clause
// Assertions of targets. A failure aborts, which fuzzer and replay count as a find.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "hinge/core/error.hpp"

namespace fuzz {

/// Reports a find and aborts.
[[noreturn]] inline void find(const std::string& what) {
  std::fprintf(stderr, "find: %s\n", what.c_str());
  std::abort();
}

inline void require(bool holds, const char* what) {
  if (!holds) find(what);
}

/// Runs `f` and returns true if it throws nothing, false if it throws an exception of Hinge. Other exceptions leave the
/// target and are finds.
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
