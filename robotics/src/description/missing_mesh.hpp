// SPDX-License-Identifier: BSD-3-Clause
// MissingMesh: the error of a mesh that gives no triangles, as opposed to one that is damaged.
#pragma once

#include "hinge/core/error.hpp"

namespace hinge::robotics {

/// There is no such file, or it holds no triangles, or its format is none that read_mesh() reads.
class MissingMesh : public LoadError {
 public:
  using LoadError::LoadError;
};

}  // namespace hinge::robotics
