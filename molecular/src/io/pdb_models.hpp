// SPDX-License-Identifier: BSD-3-Clause
// PdbModels: reads the models of a PDB file one at a time, as frames of a known molecule.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/structure.hpp"
#include "io/binary_file.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

/// Finds the offsets of all models when the file is opened; for a plain file only these stay in memory. Models are read
/// like a structure and must have the molecule's atoms, in its order unless may_have_more. A model whose atom records
/// equal those of the first one, except coordinates, is read directly: the same records are kept.
class PdbModels {
 public:
  /// The structure must outlive this object. may_have_more: models may have further atoms, which are dropped. Throws
  /// LoadError if there is no model, or if the first one is damaged or of another molecule.
  PdbModels(BinaryFile file, const Structure& structure, const ReadOptions& options, bool may_have_more);

  /// Number of models.
  std::size_t size() const noexcept { return models_.size(); }
  /// Number in the MODEL record of model k, otherwise its position from 1; see number_by_position_if_repeated().
  int number(std::size_t k) const noexcept { return models_[k].number; }

  /// Returns the positions of the structure's atoms in model k, angstrom. Throws LoadError, with line or atom, if it is
  /// damaged, and OtherAtoms if it has other atoms.
  std::vector<Vec3> frame(std::size_t k) const;

 private:
  struct Model {
    std::uint64_t begin = 0, end = 0;  ///< byte offsets
    std::size_t line = 0;              ///< number of lines before it
    int number = 0;
  };
  class Finder;
  void find_models();
  std::string text(const Model& model) const;
  MatchedAtoms parsed(const std::string& text, const Model& model) const;

  BinaryFile file_;
  const Structure& structure_;
  ReadOptions options_;
  bool may_have_more_;
  std::vector<Model> models_;
  std::string records_;              ///< identity columns of each atom record of the first model; empty: always parse
  std::vector<std::uint32_t> kept_;  ///< indices of these records for the structure's atoms
};

}  // namespace hinge::molecular
