// SPDX-License-Identifier: BSD-3-Clause
// The torsions of samples as CSV columns and as a .npy file.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "conformation_file.hpp"
#include "hinge/molecular/write_trajectory.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/csv_field.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

/// Output file of --torsions-out: an array of samples x DOF. Does nothing if the path is empty.
class TorsionFile {
 public:
  TorsionFile(const std::string& path, std::size_t dof) : file_(path) {
    if (file_.wanted()) writer_.emplace(file_.stream(), dof);
  }
  void add(const std::vector<double>& row) {
    if (!writer_) return;
    writer_->add(row);
    file_.check();
  }
  void finish() {
    if (writer_) writer_->finish();
    file_.finish();
  }

 private:
  hinge::tool::CompleteFile file_;
  std::optional<hinge::molecular::RowWriter> writer_;
};

/// Returns the CSV columns of the selected DOF: ",NAME,NAME".
inline std::string torsion_names(const Job& job) {
  std::string names;
  for (const hinge::DofId dof : job.checker.selection().dofs())
    names += ',' + hinge::tool::csv_field(dof_label(job, dof));
  return names;
}

/// Returns the values of a row: ",VALUE,VALUE".
inline std::string torsion_columns(const std::vector<double>& torsions) {
  std::string columns;
  for (const double value : torsions) columns += fmt::format(",{}", value);
  return columns;
}

}  // namespace biocd
