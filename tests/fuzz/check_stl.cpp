// SPDX-License-Identifier: BSD-3-Clause
// Target: the check of STL files before assimp reads them. An accepted file has the size that it announces.
#include "mesh/check_stl.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/bytes.hpp"
#include "fuzz/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string content(fuzz::Bytes(data, size).text());
  fuzz::accepts([&] {
    const std::size_t announced = hinge::robotics::check_stl(content, "mesh.stl");
    // The shortest facet in a text file is "facet normal endfacet".
    fuzz::require(content.size() == 84 + 50 * announced || 22 * announced <= content.size(),
                  "more facets than the file has room for");
  });
  return 0;
}
