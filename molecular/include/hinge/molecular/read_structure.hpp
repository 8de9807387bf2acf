// SPDX-License-Identifier: BSD-3-Clause
// Reading PDB and mmCIF files, plain or gzipped: each repair adds a note, doubtful data are refused.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Thrown if a model should be a conformation of a molecule but has other atoms.
struct OtherAtoms : LoadError {
  using LoadError::LoadError;
};

/// Choices of read_structure.
struct ReadOptions {
  std::optional<int> model;  ///< model number in the file; nullopt: all models
  /// Alternative location; nullopt: the one with the highest summed occupancy, then the first letter.
  std::optional<char> altloc;
  bool hetero = false;         ///< keep ligands, ions and sugars; a file without a polymer keeps them anyway
  bool waters = false;         ///< keep waters; a file of waters alone keeps them anyway
  bool keep_hydrogens = true;  ///< false: drop hydrogen and deuterium
  BondSearch bonds = BondSearch::geometry;  ///< how bonds between residues are found
  /// CIF files of components; they take precedence over the structure's own components and the dictionary.
  std::vector<std::filesystem::path> components = {};
  std::filesystem::path dictionary = {};  ///< folder of a monomer dictionary (ComponentLibrary); empty: none
  bool first_model = false;               ///< read only the first model, unless `model` names one
  /// Trajectory keeps the places of the frames of XTC files in this folder, so that other processes need not search
  /// them again; empty: nowhere. Errors of these files are ignored.
  std::filesystem::path index_folder = {};
};

/// Returns the atoms, coordinates (angstrom) and bonds of a PDB, mmCIF or PQR (.pqr) file. If models differ, the common
/// atoms are kept, and a note says so. Throws LoadError, with the file, the line or entity, and what was found and
/// expected, if the file cannot be opened, unpacks to more than 64 MiB + 200 times its size, has no atoms, blank or
/// non-finite coordinates, or broken MODEL records. Throws OtherAtoms if the models have no atom in common.
HINGE_API Structure read_structure(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace hinge::molecular
