// SPDX-License-Identifier: BSD-3-Clause
// prepare_cif: an mmCIF document as the parser receives it. C++17: clang compiles this file in that mode.
#pragma once

#include "io/read_file.hpp"

namespace gemmi::cif {
struct Document;
}  // namespace gemmi::cif

namespace hinge::molecular {

/// Numbers atoms from 0, and keeps only the categories that are read here: gemmi would refuse a file for errors in
/// others, or expand them. Adds the columns of atom_site that gemmi needs and some programs do not write (PyMOL writes
/// no auth_seq_id). Throws std::runtime_error if there are no atoms, a column without a substitute is missing, or a
/// whole number has more digits than int holds: gemmi's would wrap around.
AtomFields prepare_cif(gemmi::cif::Document& document);

}  // namespace hinge::molecular
