// SPDX-License-Identifier: BSD-3-Clause
// Target: triangulation of polygons, planar or not, with repeated vertices and extreme coordinates.
#include "mesh/cut_polygon.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fuzz/bytes.hpp"
#include "fuzz/numbers.hpp"
#include "fuzz/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const bool flat = bytes.bit();
  std::vector<hinge::Vec3> polygon(1 + bytes.below(48));
  fuzz::Numbers numbers(bytes);
  for (hinge::Vec3& vertex : polygon) {
    vertex = numbers.vector();
    if (flat) vertex[2] = 0.0;
  }
  const std::vector<hinge::Triangle> triangles = hinge::robotics::cut_polygon(polygon);
  fuzz::require(triangles.size() == std::max<std::size_t>(polygon.size(), 3) - 2, "not n - 2 triangles");
  for (const hinge::Triangle& t : triangles)
    for (const hinge::Vec3* corner : {&t.a, &t.b, &t.c})
      fuzz::require(std::find(polygon.begin(), polygon.end(), *corner) != polygon.end(),
                    "a corner that is no vertex of the polygon");
  return 0;
}
