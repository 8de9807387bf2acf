// SPDX-License-Identifier: BSD-3-Clause
// Component: bonds of a residue by atom names, with bond orders, as CIF dictionaries define them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A bond of a component, by atom names.
struct ComponentBond {
  std::string first;                     ///< name of one atom
  std::string second;                    ///< name of the other atom
  BondOrder order = BondOrder::unknown;  ///< the known part of the order
};

/// A residue's definition: wwPDB's chem_comp, or a monomer of a refinement dictionary.
struct Component {
  std::string name;                  ///< residue name
  std::string source;                ///< path of the CIF file or of the dictionary's folder
  std::vector<ComponentBond> bonds;  ///< all bonds inside the residue
  bool given = false;  ///< true: given by the user or by the structure's own file; false: found by name in a dictionary
};

/// Components by residue name: first those added, then those of a monomer dictionary, a folder of files x/XYZ.cif. A
/// dictionary's file is read at the first find() of its name. Not thread-safe: find() caches.
class HINGE_API ComponentLibrary {
 public:
  ComponentLibrary() = default;
  /// dictionary: a folder; empty: no dictionary. Throws LoadError if it is not a folder.
  explicit ComponentLibrary(std::filesystem::path dictionary);

  /// Adds the components of a CIF file, plain or gzipped, in the layout of wwPDB's dictionary or of a refinement
  /// dictionary. Throws LoadError if the file cannot be read, has no chem_comp_bond, or has a bond that does not join
  /// two different atoms or has an unknown order.
  void add_file(const std::filesystem::path& path);
  /// Adds a component and marks it as given. Ignored if the name was added before, or if find() has looked it up
  /// before.
  void add(Component component);

  /// Returns the component of this residue name, or null. The pointer is valid for the library's lifetime. Throws
  /// LoadError if the dictionary's file of that name cannot be read or parsed.
  const Component* find(const std::string& name);

 private:
  std::filesystem::path dictionary_;
  std::map<std::string, std::optional<Component>, std::less<>> components_;  // nullopt: not in the dictionary
};

/// Returns the monomer dictionary of this machine: $CLIBD_MON if it is set and not empty, otherwise the folder of
/// Debian's refmac-dictionary, or an empty path if that is not installed.
HINGE_API std::filesystem::path installed_dictionary();

}  // namespace hinge::molecular
