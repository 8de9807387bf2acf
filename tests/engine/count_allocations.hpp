// SPDX-License-Identifier: BSD-3-Clause
// Counts calls of operator new in `allocations`. It defines that operator, so include it in one source per program.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace hinge::test {

inline std::size_t allocations = 0;

}  // namespace hinge::test

// malloc guarantees the alignment of the plain forms. Not inlined: g++ 12 would warn about a free() that it sees next
// to a call of new.
// NOLINTBEGIN(misc-definitions-in-headers): see above.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++hinge::test::allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++hinge::test::allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
// NOLINTEND(misc-definitions-in-headers)
