// SPDX-License-Identifier: BSD-3-Clause
// The exceptions of the package, and the translation of the library's exceptions into them.
#pragma once

#include <pybind11/pybind11.h>

namespace hinge::python {

/// Adds hinge.Error and its descendants to the module and translates the library's exceptions into them. Call it before
/// classes are added.
void bind_errors(pybind11::module_& module);

/// Adds an exception class to a module. name: qualified, as "hinge.molecular.OtherAtoms". bases: one or more classes.
/// Returns a new reference that is never released: translators use it until the process ends.
pybind11::handle add_exception(pybind11::module_& module, const char* name, const pybind11::tuple& bases,
                               const char* doc);

/// hinge.LoadError, the base of modules' own exceptions about files. Valid after bind_errors().
pybind11::handle load_error();

}  // namespace hinge::python
