// SPDX-License-Identifier: BSD-3-Clause
// The classes of hinge.robotics.
#include "bindings.hpp"
#include "robot_handle.hpp"

namespace hinge::python {

void bind_robotics(pybind11::module_& module) {
  bind_shapes(module);
  bind_robot(module);
  bind_environment(module);
  bind_robot_checker(module);
  add_matrix(module);
}

}  // namespace hinge::python
