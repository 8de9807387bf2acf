// SPDX-License-Identifier: BSD-3-Clause
// Provides structures for tests: the committed 1UBQ, the shared data if present, and temporary files.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::test {

/// Returns the path of the committed 1UBQ.
inline std::filesystem::path ubiquitin() { return std::filesystem::path(HINGE_SOURCE_DIR) / "molecular/data/1ubq.pdb"; }

/// Returns the folder of shared structures, which may not exist.
inline std::filesystem::path shared_molecules() { return std::filesystem::path(HINGE_SHARED_DATA) / "molecules"; }

/// Returns the folders of committed structures.
inline std::vector<std::filesystem::path> committed_molecules() {
  const std::filesystem::path root = HINGE_SOURCE_DIR;
  return {root / "tests/molecular/data", root / "molecular/data"};
}

/// Returns the path of a structure or trajectory: the committed one, otherwise a shared one, which may not exist. name:
/// relative to the shared folder.
inline std::filesystem::path molecule_file(const std::filesystem::path& name) {
  for (const auto& folder : committed_molecules())
    for (const char* extension : {"", ".gz"}) {
      auto committed = folder / (name.filename().string() + extension);
      if (std::filesystem::exists(committed)) return committed;
    }
  return shared_molecules() / name;
}

/// Returns all committed and shared files, sorted.
inline std::vector<std::filesystem::path> molecule_files() {
  std::vector<std::filesystem::path> files;
  auto folders = committed_molecules();
  folders.push_back(shared_molecules());
  for (const auto& folder : folders)
    if (std::filesystem::exists(folder))
      for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// A temporary file with this text; the destructor removes it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text, const std::string& extension = ".pdb") {
    static int number = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("hinge-test-" + std::to_string(getpid()) + "-" + std::to_string(number++) + extension);
    std::ofstream(path_) << text;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Returns `text` gzipped, repeated `times` times as members of one gzip file.
inline std::string gzipped(const std::string& text, std::size_t times = 1) {
  const TemporaryFile file("", ".gz");
  const gzFile out = gzopen(file.path().c_str(), "wb9");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
  std::ifstream in(file.path(), std::ios::binary);
  const std::string member{std::istreambuf_iterator<char>(in), {}};
  std::string all;
  for (std::size_t k = 0; k < times; ++k) all += member;
  return all;
}

/// Returns the text of a file, compressed or not.
inline std::string gunzipped(const std::filesystem::path& path) {
  const gzFile in = gzopen(path.c_str(), "rb");
  std::string text;
  char piece[4096];
  for (int n; (n = gzread(in, piece, sizeof piece)) > 0;) text.append(piece, static_cast<std::size_t>(n));
  gzclose(in);
  return text;
}

/// Returns options that drop hydrogens.
inline molecular::ReadOptions heavy_atoms() {
  molecular::ReadOptions options;
  options.keep_hydrogens = false;
  return options;
}

/// Returns a structure of `count` carbons in one residue.
inline molecular::Structure carbons(std::size_t count) {
  molecular::Structure s;
  s.atoms.assign(count, molecular::Atom{"C", "C", 0, '\0', 0, 0, 0.0});
  s.residues.push_back(
      molecular::Residue{"UNL", 1, '\0', 0, 0, static_cast<std::uint32_t>(count), molecular::ResidueKind::other});
  s.chains.push_back({"A", 0, 1});
  return s;
}

}  // namespace hinge::test
