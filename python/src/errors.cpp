// SPDX-License-Identifier: BSD-3-Clause
// Defines the exceptions of the package and translates the library's.
#include "errors.hpp"

#include <cstring>
#include <exception>

#include "hinge/core/error.hpp"

namespace hinge::python {

namespace py = pybind11;

namespace {

/// The classes, for the translator. They live until the process ends.
struct ErrorClasses {
  py::handle base, load, model, configuration;
};

ErrorClasses& classes() {
  static ErrorClasses all;
  return all;
}

}  // namespace

py::handle load_error() { return classes().load; }

py::handle add_exception(py::module_& module, const char* name, const py::tuple& bases, const char* doc) {
  PyObject* made = PyErr_NewExceptionWithDoc(name, doc, bases.ptr(), nullptr);
  if (made == nullptr) throw py::error_already_set();
  module.add_object(std::strrchr(name, '.') + 1, made);
  return py::handle(made).inc_ref();
}

void bind_errors(py::module_& module) {
  const auto error = [](PyObject* builtin) { return py::reinterpret_borrow<py::object>(builtin); };
  ErrorClasses& all = classes();
  all.base = add_exception(module, "hinge.Error", py::make_tuple(error(PyExc_Exception)),
                           "Base class of the library's exceptions.");
  all.load = add_exception(module, "hinge.LoadError", py::make_tuple(all.base),
                           "A file could not be read. The message names the file, the line and the entity.");
  all.model = add_exception(module, "hinge.ModelError", py::make_tuple(all.base, error(PyExc_ValueError)),
                            "A model, a rule, a selection or an option is invalid.");
  all.configuration =
      add_exception(module, "hinge.ConfigurationError", py::make_tuple(all.base, error(PyExc_ValueError)),
                    "A configuration, a pose or a coordinate is invalid.");
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    const ErrorClasses& known = classes();
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const LoadError& e) {
      PyErr_SetString(known.load.ptr(), e.what());
    } catch (const ModelError& e) {
      PyErr_SetString(known.model.ptr(), e.what());
    } catch (const ConfigurationError& e) {
      PyErr_SetString(known.configuration.ptr(), e.what());
    } catch (const Error& e) {
      PyErr_SetString(known.base.ptr(), e.what());
    }
  });
}

}  // namespace hinge::python
