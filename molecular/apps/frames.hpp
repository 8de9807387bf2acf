// SPDX-License-Identifier: BSD-3-Clause
// Frames: the conformations of a command, from trajectories or from the molecule's own file.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

/// The frames of several files, one file after another, numbered consecutively from 0. Threads may read frames at the
/// same time.
class Frames {
 public:
  /// Opens the files of `named`. If it is empty, takes the molecule's own models, from file `own` if not all of them
  /// were read. may_have_more: files may have further atoms, which are left out. Prints notes to standard error.
  /// `named` and `molecule` must outlive this object. Throws LoadError if a file cannot be read or does not fit the
  /// molecule.
  Frames(const std::vector<std::string>& named, const std::string& own, const hinge::molecular::Structure& molecule,
         const hinge::molecular::ReadOptions& read, bool may_have_more = false)
      : named_(named) {
    for (const std::string& path : named_) files_.emplace_back(path, molecule, read, may_have_more);
    if (named_.empty() && molecule.more_models) files_.emplace_back(own, molecule, read);
    if (files_.empty()) files_.emplace_back(molecule);
    for (const hinge::molecular::Trajectory& file : files_) {
      starts_.push_back(size_);
      size_ += file.size();
      for (const std::string& note : file.notes()) std::fprintf(stderr, "note: %s\n", note.c_str());
    }
  }

  /// Index of a file, and of a frame in this file.
  struct Place {
    std::size_t file, frame;
  };
  /// Returns the file and the frame of conformation k < size().
  Place place(std::size_t k) const {
    const auto file =
        static_cast<std::size_t>(std::upper_bound(starts_.begin(), starts_.end(), k) - starts_.begin()) - 1;
    return {file, k - starts_[file]};
  }
  /// Returns the file of conformation k; valid as long as this object.
  const hinge::molecular::Trajectory& file(std::size_t k) const { return files_[place(k).file]; }
  /// Returns the number of conformations.
  std::size_t size() const { return size_; }
  /// Returns true if the frames are models of the molecule's file, false for trajectories.
  bool are_models() const { return named_.empty(); }
  /// Returns the number of atoms per frame. Throws ModelError if frames have different sizes.
  std::size_t atom_count() const {
    for (const hinge::molecular::Trajectory& file : files_)
      if (file.atom_count() != files_.front().atom_count())
        throw hinge::ModelError(
            fmt::format("--out: the trajectories have frames of {} and {} atoms, expected one number of atoms",
                        files_.front().atom_count(), file.atom_count()));
    return files_.front().atom_count();
  }
  /// Returns true if all files store 32-bit floats.
  bool is_single() const {
    return std::all_of(files_.begin(), files_.end(),
                       [](const hinge::molecular::Trajectory& file) { return file.is_single(); });
  }

  /// Adds the files to the head of the JSON output.
  void describe(Json& head) const {
    if (are_models()) {
      head["model"]["models"] = size_;
      return;
    }
    Json list = Json::array();
    for (std::size_t f = 0; f < files_.size(); ++f)
      list.push_back({{"file", named_[f]}, {"frames", files_[f].size()}, {"atoms", files_[f].atom_count()}});
    head["trajectories"] = std::move(list);
  }
  /// Adds the number of conformation k, and of its trajectory, to a JSON row.
  void name(Json& row, std::size_t k) const {
    const auto [file, frame] = place(k);
    if (are_models()) {
      row["model_number"] = files_[file].number(frame);
    } else {
      row["trajectory"] = file;
      row["frame"] = files_[file].number(frame);
    }
  }
  /// Returns the number of the model (or frame) in its file.
  int number(std::size_t k) const {
    const auto [file, frame] = place(k);
    return files_[file].number(frame);
  }
  /// Returns a name for messages, such as "model 3" or "run.dcd frame 3".
  std::string name(std::size_t k) const {
    const auto [file, frame] = place(k);
    const int number = files_[file].number(frame);
    return are_models() ? fmt::format("model {}", number) : fmt::format("{} frame {}", named_[file], number);
  }

 private:
  const std::vector<std::string>& named_;
  std::vector<hinge::molecular::Trajectory> files_;
  std::vector<std::size_t> starts_;
  std::size_t size_ = 0;
};

/// Returns true if every model has the atoms of the first. Needed if one file is to hold all models.
inline bool have_same_atoms(const Options& options, const hinge::molecular::Structure& s) {
  const std::vector<std::string> none;
  const Frames frames(none, options.file, s, options.read);
  try {
    for (std::size_t k = 0; k < frames.size(); ++k) frames.file(k).frame(frames.place(k).frame);
  } catch (const hinge::molecular::OtherAtoms&) {
    return false;
  } catch (const hinge::LoadError&) {  // reported when this frame is checked
  }
  return true;
}

}  // namespace biocd
