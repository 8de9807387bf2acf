// SPDX-License-Identifier: BSD-3-Clause
// Target: PDB files, from reading to the answers of a checker.
#include <cstddef>
#include <cstdint>

#include "fuzz/bytes.hpp"
#include "fuzz/check_structure.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::check_structure("input.pdb", fuzz::Bytes(data, size).text());
  return 0;
}
