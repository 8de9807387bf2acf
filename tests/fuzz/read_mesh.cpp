// SPDX-License-Identifier: BSD-3-Clause
// Target: mesh files. The first byte selects the format (s: STL, o: OBJ, p: PLY, otherwise DAE), the rest is the file.
#include <cstddef>
#include <cstdint>

#include "fuzz/bytes.hpp"
#include "fuzz/require.hpp"
#include "fuzz/scratch_file.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/robotics/read_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const char* name = "mesh.dae";
  switch (bytes.byte()) {
    case 's': name = "mesh.stl"; break;
    case 'o': name = "mesh.obj"; break;
    case 'p': name = "mesh.ply"; break;
    default: break;
  }
  const fuzz::ScratchFile file(name, bytes.text());
  fuzz::accepts([&] {
    const hinge::robotics::TriangleMesh mesh = hinge::robotics::read_mesh(file.path());
    fuzz::require(!mesh.triangles.empty(), "a mesh without triangles");
    for (const hinge::Triangle& t : mesh.triangles)
      fuzz::require(hinge::is_finite(t.a) && hinge::is_finite(t.b) && hinge::is_finite(t.c),
                    "a vertex that is not finite");
  });
  return 0;
}
