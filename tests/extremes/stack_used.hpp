// SPDX-License-Identifier: BSD-3-Clause
// Measures how much stack an action uses, on a thread whose stack is filled with a pattern.
#pragma once

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace hinge::test {

/// Returns bytes, including about 3 KiB that the C library uses.
inline std::size_t stack_used(std::function<void()> action) {
  constexpr std::size_t words = std::size_t{1} << 17;  // 1 MiB, so that excessive use can be measured
  constexpr std::uint64_t paint = 0x5ca1ab1e'0ddba11dULL;
  constexpr std::size_t page = 4096 / sizeof(std::uint64_t);
  std::vector<std::uint64_t> memory(words + page, paint);
  void* start = memory.data();
  std::size_t space = memory.size() * sizeof(std::uint64_t);
  const auto* const stack = static_cast<std::uint64_t*>(std::align(4096, words * sizeof(std::uint64_t), start, space));
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstack(&attributes, start, words * sizeof(std::uint64_t));
  pthread_t thread{};
  const auto run = [](void* what) -> void* {
    (*static_cast<std::function<void()>*>(what))();
    return nullptr;
  };
  EXPECT_EQ(pthread_create(&thread, &attributes, run, &action), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  const auto* const touched = std::find_if(stack, stack + words, [](std::uint64_t word) { return word != paint; });
  return static_cast<std::size_t>(stack + words - touched) * sizeof(std::uint64_t);
}

/// Limit for building and for every query, for any input, bytes.
inline constexpr std::size_t stack_limit = 65536;

/// Are stack frames much larger than in a release build, so that measuring is useless?
inline constexpr bool stack_is_padded =
#if defined(__SANITIZE_ADDRESS__) || !defined(__OPTIMIZE__)
    true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
    true;
#else
    false;
#endif
#else
    false;
#endif

}  // namespace hinge::test
