// SPDX-License-Identifier: BSD-3-Clause
// The classes of hinge.robotics.
#include "bindings.hpp"

namespace hinge::python {

void bind_robotics(pybind11::module_&) {}

}  // namespace hinge::python
