// SPDX-License-Identifier: BSD-3-Clause
// PdbModels: the models of a PDB file one at a time, as frames of a molecule that is known.
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

/// Where models begin is looked up when the file is opened; of a plain file no more than that stays in memory. Models
/// are read like any structure, and must hold the molecule's atoms, in its order unless they may have more. Those whose
/// records are the first one's but for coordinates take the short way: what is kept of one is kept of all.
class PdbModels {
 public:
  /// The structure must outlive this. LoadError: no model, MODEL numbers that
  /// repeat, or a first model that is damaged or another molecule.
  /// may_have_more: models may have other atoms beside the structure's, which are left out.
  PdbModels(BinaryFile file, const Structure& structure, const ReadOptions& options, bool may_have_more);

  std::size_t size() const noexcept { return models_.size(); }
  /// As its MODEL record says, else its position from 1.
  int number(std::size_t k) const noexcept { return models_[k].number; }

  /// Positions of the structure's atoms, angstrom. LoadError names line, or atom. OtherAtoms: the model has others.
  std::vector<Vec3> frame(std::size_t k) const;

 private:
  struct Model {
    std::uint64_t begin = 0, end = 0;  ///< bytes
    std::size_t line = 0;              ///< lines before it
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
  std::string records_;              ///< what is the same in each atom record of models like the first one
  std::vector<std::uint32_t> kept_;  ///< which of these records the structure's atoms are
};

}  // namespace hinge::molecular
