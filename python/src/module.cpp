// SPDX-License-Identifier: BSD-3-Clause
// The extension module of one instruction set. HINGE_PYTHON_MODULE is its name.
#include <pybind11/pybind11.h>

#include <string>

#include "bindings.hpp"
#include "errors.hpp"
#include "hinge/version.hpp"
#include "run_aside.hpp"

namespace {

namespace py = pybind11;

/// Lets the classes of a module refuse to be pickled; the classes of Python that extend them know how. Without it,
/// Python would call the base of all of pybind11's classes for protocols 0 and 1, which ends the process.
void refuse_pickling(const py::module_& module) {
  const py::cpp_function refuse(
      [](const py::object& self) {
        throw py::type_error(std::string("cannot pickle '") + Py_TYPE(self.ptr())->tp_name + "' object");
      },
      py::name("__reduce__"), py::is_method(module));
  for (const auto& [name, member] : py::reinterpret_borrow<py::dict>(module.attr("__dict__")))
    if (PyType_Check(member.ptr()) != 0 && PyExceptionClass_Check(member.ptr()) == 0)
      py::setattr(member, "__reduce__", refuse);
}

}  // namespace

PYBIND11_MODULE(HINGE_PYTHON_MODULE, m) {
  py::options options;
  options.disable_function_signatures();
  m.doc() = "The compiled part of hinge, for one instruction set. Import hinge, hinge.molecular or hinge.robotics.";
  m.attr("__module__") = "hinge";  // the module that classes and functions say they belong to
  m.attr("version") = hinge::version_string;
  hinge::python::wait_for_work_at_exit();
  hinge::python::bind_errors(m);
  hinge::python::bind_core(m);
  refuse_pickling(m);
  const auto add = [&m](const char* name, const char* public_name, void (*bind)(py::module_&)) {
    py::module_ part = m.def_submodule(name);
    part.attr("__module__") = public_name;
    bind(part);
    refuse_pickling(part);
  };
  add("molecular", "hinge.molecular", hinge::python::bind_molecular);
  add("robotics", "hinge.robotics", hinge::python::bind_robotics);
}
