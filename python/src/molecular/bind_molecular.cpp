// SPDX-License-Identifier: BSD-3-Clause
// The classes of hinge.molecular.
#include "bindings.hpp"
#include "errors.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "molecule_handle.hpp"

namespace hinge::python {

namespace py = pybind11;

void bind_molecular(py::module_& module) {
  static py::handle other_atoms;  // for the translator
  other_atoms = add_exception(module, "hinge.molecular.OtherAtoms",
                              py::make_tuple(py::reinterpret_borrow<py::object>(load_error())),
                              "A frame or model has other atoms than the molecule.");
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const molecular::OtherAtoms& e) {
      PyErr_SetString(other_atoms.ptr(), e.what());
    }
  });
  bind_molecule(module);
  bind_trajectory(module);
  bind_checker(module);
  bind_ensemble(module);
}

}  // namespace hinge::python
