// SPDX-License-Identifier: BSD-3-Clause
// MissingMesh: the error for a mesh that gives no triangles, in contrast to a damaged one.
#pragma once

#include "hinge/core/error.hpp"

namespace hinge::robotics {

/// Thrown if a mesh file does not exist, has no triangles, or has a format that read_mesh() does not read.
class MissingMesh : public LoadError {
 public:
  using LoadError::LoadError;
};

}  // namespace hinge::robotics
