// SPDX-License-Identifier: BSD-3-Clause
// A program that uses the molecular component: it includes its headers and calls its library.
#include "hinge/molecular/molecular.hpp"

int main() {
  hinge::molecular::Structure structure;
  structure.chains.push_back({"A", 0, 1});
  structure.residues.push_back({"LYS", 77, '\0', 0, 0, 1, hinge::molecular::ResidueKind::amino_acid});
  structure.atoms.push_back({"NZ", "N", 0, '\0', 1});
  const hinge::Mode mode = hinge::Mode::parse("within:0.5");
  return hinge::molecular::label(structure, 0) == "A:LYS77:NZ" && mode.text() == "within:0.5" ? 0 : 1;
}
