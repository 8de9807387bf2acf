// SPDX-License-Identifier: BSD-3-Clause
// The classes of hinge for models from arrays.
#include "bindings.hpp"

namespace hinge::python {

void bind_core(pybind11::module_&) {}

}  // namespace hinge::python
