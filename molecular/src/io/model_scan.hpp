// SPDX-License-Identifier: BSD-3-Clause
// ModelScan: where the models of a PDB or PQR text begin and end.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/read_file.hpp"

namespace hinge::molecular {

/// ENDMDL ends a model. END does if MODEL follows, or an atom that equals the first one of the model: some programs
/// write END after each frame. Other atoms after END are of the same model, for example of a second file.
class ModelScan {
 public:
  /// The effect of a line: it begins a model, or the open model goes on after END.
  enum class Step { none, begin, resume };

  /// Takes the next line. is_model: it is a MODEL record. atom: what tells the atom of this line from others; nullopt:
  /// the line holds no atom.
  Step add(std::string_view line, bool is_model, std::optional<std::string_view> atom) {
    Step step = Step::none;
    if (ended_ && (is_model || atom)) {
      ended_ = false;
      open_ = !is_model && *atom != first_atom_;
      if (open_) step = Step::resume;
    }
    if (!open_ && (is_model || atom)) {
      open_ = true;
      first_atom_.clear();
      step = Step::begin;
    }
    if (atom && first_atom_.empty()) first_atom_ = *atom;
    if (is_endmdl(line)) open_ = ended_ = false;
    if (is_end(line)) ended_ = open_;
    return step;
  }
  /// The same for a line of a PDB file, whose columns name the atom.
  Step add_pdb(std::string_view line, bool is_model) {
    return add(line, is_model, is_atom_record(line) ? std::optional(atom_columns(line)) : std::nullopt);
  }

  /// True from the beginning of a model until its ENDMDL or END.
  bool is_inside() const noexcept { return open_ && !ended_; }

 private:
  /// Columns 13-27 of an atom record: the atom's name, alternative location, and residue.
  static std::string_view atom_columns(std::string_view line) {
    return line.size() > 12 ? line.substr(12, 15) : std::string_view();
  }

  bool open_ = false;       // a model has begun
  bool ended_ = false;      // the open model, by END, if it does not go on
  std::string first_atom_;  // of the open model
};

}  // namespace hinge::molecular
