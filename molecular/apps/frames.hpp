// SPDX-License-Identifier: BSD-3-Clause
// Frames: the conformations that a command goes through, of trajectories or of the molecule's own file.
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
#include "report.hpp"

namespace biocd {

/// The frames of several files, one after another, numbered through.
class Frames {
 public:
  /// Of `named`, which must outlive it as the molecule must; of the molecule's own models where it is empty, in `own`
  /// where not all of them were read. may_have_more: of atoms, which are left out. Notes go to standard error.
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

  struct Place {
    std::size_t file, frame;
  };
  Place place(std::size_t k) const {
    const auto file =
        static_cast<std::size_t>(std::upper_bound(starts_.begin(), starts_.end(), k) - starts_.begin()) - 1;
    return {file, k - starts_[file]};
  }
  const hinge::molecular::Trajectory& file(std::size_t k) const { return files_[place(k).file]; }
  std::size_t size() const { return size_; }
  /// Of the molecule's file, not of trajectories?
  bool are_models() const { return named_.empty(); }
  /// Of every frame. ModelError: frames of several sizes.
  std::size_t atom_count() const {
    for (const hinge::molecular::Trajectory& file : files_)
      if (file.atom_count() != files_.front().atom_count())
        throw hinge::ModelError(fmt::format("--out: frames of {} and of {} atoms do not go into one file",
                                            files_.front().atom_count(), file.atom_count()));
    return files_.front().atom_count();
  }
  bool is_single() const {
    return std::all_of(files_.begin(), files_.end(),
                       [](const hinge::molecular::Trajectory& file) { return file.is_single(); });
  }

  /// For the head of the output.
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
  void name(Json& row, std::size_t k) const {
    const auto [file, frame] = place(k);
    if (are_models()) {
      row["model_number"] = files_[file].number(frame);
    } else {
      row["trajectory"] = file;
      row["frame"] = files_[file].number(frame);
    }
  }
  /// Of the model, in its file.
  int number(std::size_t k) const {
    const auto [file, frame] = place(k);
    return files_[file].number(frame);
  }
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

}  // namespace biocd
