// SPDX-License-Identifier: BSD-3-Clause
// The classes of hinge.molecular.
#include "bindings.hpp"

namespace hinge::python {

void bind_molecular(pybind11::module_&) {}

}  // namespace hinge::python
