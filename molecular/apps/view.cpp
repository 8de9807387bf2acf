// SPDX-License-Identifier: BSD-3-Clause
// Writes viewer scripts and the structures that they open.
#include "view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/counted.hpp"

namespace biocd {

using namespace hinge::molecular;

namespace {

/// Largest number of pairs that a script marks: more lines cannot be told apart, and viewers draw them slowly.
constexpr std::size_t most_shown = 100;

const char* script_extension(Viewer viewer) { return viewer == Viewer::pymol ? ".pml" : ".cxc"; }

/// Returns the path with another extension: "a.b" and ".pdb" give "a.b.pdb".
std::filesystem::path with_extension(const std::filesystem::path& stem, const char* extension) {
  return stem.string() + extension;
}

/// Returns the name of --out, or of FILE in the working directory, without extension and with "_clashes".
std::filesystem::path view_stem(const Options& options) {
  std::filesystem::path path = options.out;
  if (path.empty()) path = std::filesystem::path(options.file).filename();
  if (path.extension() == ".gz") path = path.replace_extension();
  return path.replace_extension().string() + "_clashes";
}

bool fits_pdb(const Structure& structure) {
  try {
    check_fits_pdb(structure);
    return true;
  } catch (const hinge::ModelError&) {
    return false;
  }
}

}  // namespace

std::vector<std::filesystem::path> view_files(const Options& options) {
  if (!options.view) return {};
  std::vector<std::filesystem::path> files;
  for (const char* extension : {script_extension(*options.view), ".pdb", ".cif"})
    files.push_back(with_extension(view_stem(options), extension));
  return files;
}

void ViewChoice::offer(std::size_t k, const Verdict& verdict) {
  auto clashes = static_cast<std::size_t>(
      std::count_if(verdict.pairs.begin(), verdict.pairs.end(), [](const Contact& pair) { return pair.collides; }));
  clashes = std::max<std::size_t>(clashes, verdict.collides ? 1 : 0);  // modes without a list
  if (best_ && clashes <= clashes_) return;
  best_ = k;
  clashes_ = clashes;
}

std::string write_shown_structure(const Structure& structure, std::span<const hinge::Vec3> positions,
                                  const std::filesystem::path& stem) {
  const bool is_pdb = fits_pdb(structure);
  const std::filesystem::path path = with_extension(stem, is_pdb ? ".pdb" : ".cif");
  hinge::tool::CompleteFile file(path.string());
  if (is_pdb) {
    write_pdb_head(file.stream(), structure);
    write_pdb_model(file.stream(), structure, positions, 1);
    write_pdb_tail(file.stream(), structure);
  } else {
    write_cif_head(file.stream(), structure);
    write_cif_model(file.stream(), structure, positions, 1, 1);
    file.stream() << "#\n";
  }
  file.finish();
  return path.filename().string();
}

void write_viewer_script(Viewer viewer, const Structure& structure, std::span<const hinge::Hit> pairs,
                         const std::filesystem::path& stem, const ViewedFiles& files) {
  hinge::tool::CompleteFile file(with_extension(stem, script_extension(viewer)).string());
  if (viewer == Viewer::pymol)
    write_pymol_script(file.stream(), structure, pairs, files);
  else
    write_chimerax_script(file.stream(), structure, pairs, files);
  file.finish();
}

void write_view(const Options& options, const Job& job, const Shown& shown, bool with_out) {
  const Structure& s = job.molecule->structure();
  const std::filesystem::path stem = view_stem(options);
  std::vector<hinge::Hit> pairs;
  for (const Contact& pair : shown.pairs) pairs.push_back(pair.hit);
  std::ranges::stable_sort(pairs, {}, [](const hinge::Hit& hit) { return hit.distance - hit.threshold; });
  pairs.resize(std::min(pairs.size(), most_shown));
  ViewedFiles files{write_shown_structure(s, shown.positions, stem)};
  if (with_out && !options.out.empty()) files.ensemble = std::filesystem::path(options.out).filename().string();
  write_viewer_script(*options.view, s, pairs, stem, files);

  std::string text =
      fmt::format("view: {} shows {} with {}", with_extension(stem, script_extension(*options.view)).string(),
                  shown.name, hinge::tool::counted(shown.pairs.size(), "pair"));
  if (shown.pairs.size() > pairs.size()) text += fmt::format(", the {} deepest marked", pairs.size());
  if (!options.out.empty() &&
      (files.ensemble.empty() || (files.ensemble.ends_with(".npy") && *options.view == Viewer::chimerax)))
    text += fmt::format("; {} is not opened", options.out);
  fmt::print(options.output == Output::table ? stdout : stderr, "{}{}\n",
             options.output == Output::table ? "" : "note: ", text);
}

}  // namespace biocd
