// SPDX-License-Identifier: BSD-3-Clause
// Target: mmCIF files, from reading to the answers of a checker.
#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/bytes.hpp"
#include "fuzz/check_structure.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The reader detects the format by content: without this line most inputs would be read as PDB files.
  std::string content(fuzz::Bytes(data, size).text());
  if (!content.starts_with("data_")) content.insert(0, "data_x\n");
  fuzz::check_structure("input.cif", content);
  return 0;
}
