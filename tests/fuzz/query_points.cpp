// SPDX-License-Identifier: BSD-3-Clause
// Target: every query on every engine over points; compares engines with each other and with exact arithmetic.
#include <cstddef>
#include <cstdint>

#include "fuzz/check_queries.hpp"
#include "hinge/primitive/point.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_queries<hinge::Point>(data, size);
}
