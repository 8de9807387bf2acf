// SPDX-License-Identifier: BSD-3-Clause
// Target: PDB and PQR files, from reading to the answers of a checker. Every text is read as both.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/bytes.hpp"
#include "fuzz/check_structure.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::Bytes(data, size).text();
  for (const char* name : {"input.pdb", "input.pqr"}) fuzz::check_structure(name, text);
  return 0;
}
