// SPDX-License-Identifier: BSD-3-Clause
// The extension module of one instruction set. HINGE_PYTHON_MODULE is its name.
#include <pybind11/pybind11.h>

#include "bindings.hpp"
#include "errors.hpp"
#include "hinge/version.hpp"

PYBIND11_MODULE(HINGE_PYTHON_MODULE, m) {
  namespace py = pybind11;
  py::options options;
  options.disable_function_signatures();
  m.doc() = "The compiled part of hinge, for one instruction set. Import hinge, hinge.molecular or hinge.robotics.";
  m.attr("__module__") = "hinge";  // the module that classes and functions say they belong to
  m.attr("version") = hinge::version_string;
  hinge::python::bind_errors(m);
  hinge::python::bind_core(m);
  const auto add = [&m](const char* name, const char* public_name, void (*bind)(py::module_&)) {
    py::module_ part = m.def_submodule(name);
    part.attr("__module__") = public_name;
    bind(part);
  };
  add("molecular", "hinge.molecular", hinge::python::bind_molecular);
  add("robotics", "hinge.robotics", hinge::python::bind_robotics);
}
