// SPDX-License-Identifier: BSD-3-Clause
// Rejects output files of unknown format, or that would overwrite an input, before any work.
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "conformation_file.hpp"
#include "hinge/core/error.hpp"
#include "hinge_tools/check_output.hpp"
#include "hinge_tools/parts_option.hpp"
#include "options.hpp"
#include "path_end.hpp"
#include "view.hpp"

namespace biocd {

std::vector<std::filesystem::path> input_files(const Options& options) {
  std::vector<std::filesystem::path> files{options.file};
  for (const auto* list : {&options.with, &options.trajectories, &options.rigid_from, &options.settings})
    files.insert(files.end(), list->begin(), list->end());
  files.insert(files.end(), options.read.components.begin(), options.read.components.end());
  for (const std::string& end : {options.from, options.to})
    if (const std::string file = file_of_end(end); !file.empty()) files.emplace_back(file);
  return files;
}

namespace {

/// Returns true if `file` exists and lies in `folder`. Files of a monomer dictionary are read on demand, so they are
/// not listed as inputs.
bool is_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code error;
  if (folder.empty() || !std::filesystem::exists(file, error)) return false;
  for (std::filesystem::path up = std::filesystem::canonical(file, error); up.has_relative_path();
       up = up.parent_path())
    if (std::filesystem::equivalent(up, folder, error)) return true;
  return false;
}

}  // namespace

void check_outputs(const Options& options, bool is_folder) {
  hinge::tool::check_parts(options.parts, options.output == Output::table,
                           !options.out.empty()            ? "--out"
                           : !options.torsions_out.empty() ? "--torsions-out"
                           : options.view                  ? "--view"
                           : !options.report.empty()       ? "--report"
                           : !options.explain.empty()      ? "--explain"
                           : options.max_pairs             ? "--max-pairs"
                           : options.seconds               ? "--time"
                                                           : nullptr);
  if (!options.torsions_out.empty()) {
    if (std::filesystem::path(options.torsions_out).extension() != ".npy")
      throw hinge::ModelError("--torsions-out " + options.torsions_out + ": expected a file name with .npy");
    hinge::tool::check_output("--torsions-out", options.torsions_out, input_files(options));
    if (options.torsions_out == options.out)
      throw hinge::ModelError("--torsions-out " + options.torsions_out +
                              ": is the file of --out, expected a different file");
  }
  if (options.view)
    for (const std::filesystem::path& file : view_files(options)) {
      hinge::tool::check_output("--view", file, input_files(options));
      if (is_inside(file, options.read.dictionary))
        throw hinge::ModelError("--view: " + file.string() + " is in the monomer dictionary, expected another --out");
    }
  hinge::tool::check_report(options.report, options.out, input_files(options));
  if (is_inside(options.report, options.read.dictionary))
    throw hinge::ModelError("--report " + options.report + ": is in the monomer dictionary, expected a different file");
  hinge::tool::check_output("--apply", options.dial.apply, input_files(options));
  const std::filesystem::path out = options.out;
  if (out.empty()) return;
  if (!is_folder) {
    if (options.merged.empty()) conformation_format(options.out);
    hinge::tool::check_output("--out", out, input_files(options));
    if (is_inside(out, options.read.dictionary))
      throw hinge::ModelError("--out " + options.out + ": is in the monomer dictionary, expected a different file");
    return;
  }
  std::error_code error;
  if (std::filesystem::exists(out, error) && !std::filesystem::is_directory(out, error))
    throw hinge::ModelError("--out " + options.out + ": is a file, expected a folder");
  for (const char* name : demo_files) hinge::tool::check_output("--out", out / name, input_files(options));
}

}  // namespace biocd
