// SPDX-License-Identifier: BSD-3-Clause
// Target: every query on every engine over spheres; compares engines with each other and with exact arithmetic.
#include <cstddef>
#include <cstdint>

#include "fuzz/check_queries.hpp"
#include "hinge/primitive/sphere.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_queries<hinge::Sphere>(data, size);
}
