// SPDX-License-Identifier: BSD-3-Clause
// Reading PDB and mmCIF files, plain or gzipped, with every repair said and every doubt refused.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A model that has other atoms than the molecule it is to be a conformation of.
struct OtherAtoms : LoadError {
  using LoadError::LoadError;
};

struct ReadOptions {
  std::optional<int> model;    ///< the model's number in the file; none: all models
  std::optional<char> altloc;  ///< none: the one of highest summed occupancy, then the first by letter
  bool hetero = false;         ///< keep ligands, ions and sugars; they are kept anyway where there is nothing else
  bool waters = false;         ///< keep waters; so are they
  bool keep_hydrogens = true;
  BondSearch bonds = BondSearch::geometry;             ///< between residues
  std::vector<std::filesystem::path> components = {};  ///< CIF files; before the structure's own and the dictionary
  std::filesystem::path dictionary = {};               ///< of monomers (ComponentLibrary); empty: none
  bool first_model = false;                            ///< read the first model alone, unless one is named
};

/// Atoms, coordinates (angstrom) and bonds. LoadError names file, line (or entity), what was found and expected: files
/// that cannot be opened, unpack to more than 64 MiB + 200 times their size, hold no atoms, have blank or non-finite
/// coordinates, broken MODEL records. Of models with different atoms the common ones are taken, and a note says so;
/// OtherAtoms: there are none.
Structure read_structure(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace hinge::molecular
