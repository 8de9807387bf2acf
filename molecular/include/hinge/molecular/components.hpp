// SPDX-License-Identifier: BSD-3-Clause
// Chemical components: bonds of residues by name, from CIF files, with bond orders.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A bond of a component, between atom names.
struct ComponentBond {
  std::string first, second;
  BondOrder order = BondOrder::unknown;
};

/// A residue's definition (wwPDB's chem_comp, or a monomer of a refinement dictionary).
struct Component {
  std::string name;
  std::string source;  ///< the file, or the dictionary, it comes from
  std::vector<ComponentBond> bonds;
  bool given = false;  ///< by the user or the structure's own file; else found by its name in a dictionary
};

/// Components by name: those given, then those of a dictionary, a folder x/XYZ.cif of one file per monomer, each read
/// when it is first asked for.
class ComponentLibrary {
 public:
  ComponentLibrary() = default;
  /// dictionary: empty for none. LoadError: not a folder.
  explicit ComponentLibrary(std::filesystem::path dictionary);

  /// Components of a CIF file in the layout of wwPDB's dictionary or of a refinement dictionary's monomers, plain or
  /// gzipped. LoadError: cannot be read, holds no chem_comp_bond, a bond of fewer than two different atoms or of an
  /// unknown order.
  void add_file(const std::filesystem::path& path);
  /// The first component of a name counts.
  void add(Component component);

  /// Null when there is none. LoadError: the dictionary's file cannot be trusted.
  const Component* find(const std::string& name);

 private:
  std::filesystem::path dictionary_;
  std::map<std::string, std::optional<Component>, std::less<>> components_;  // nullopt: the dictionary has none
};

/// The monomer dictionary of this machine: $CLIBD_MON where that is set, else the folder of Debian's refmac-dictionary;
/// empty when there is neither.
std::filesystem::path installed_dictionary();

}  // namespace hinge::molecular
