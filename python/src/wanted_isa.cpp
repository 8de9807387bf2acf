// SPDX-License-Identifier: BSD-3-Clause
// Module _isa: which instruction set the package should use. Compiled for any CPU.
#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

#include "hinge/core/error.hpp"
#include "hinge_tools/pick_instruction_set.hpp"

PYBIND11_MODULE(_isa, m) {
  m.doc() = "Tells which instruction set this process should use.";
  m.def(
      "wanted",
      [] {
        try {
          const auto set = hinge::tool::wanted_instruction_set();
          return std::string(name(set));  // found by its argument
        } catch (const hinge::Error& error) {
          throw pybind11::import_error(error.what());
        }
      },
      "wanted()\n--\n\nReturn the set named by HINGE_ISA, or the best of this CPU.");
}
