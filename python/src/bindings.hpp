// SPDX-License-Identifier: BSD-3-Clause
// The parts of the extension module. Each fills a module of its own and is defined in the folder of its name.
#pragma once

#include <pybind11/pybind11.h>

namespace hinge::python {

void bind_core(pybind11::module_& module);       ///< models from arrays: hinge
void bind_molecular(pybind11::module_& module);  ///< hinge.molecular
void bind_robotics(pybind11::module_& module);   ///< hinge.robotics

}  // namespace hinge::python
