// SPDX-License-Identifier: BSD-3-Clause
// allocations: how often the test program has called operator new. Defines that operator, so for one source a program.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace hinge::test {

inline std::size_t allocations = 0;

}  // namespace hinge::test

// malloc aligns as much as the plain forms promise. Not inlined: g++ 12 would take a free() that it sees beside a call
// of new for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++hinge::test::allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
