// SPDX-License-Identifier: BSD-3-Clause
// Files of finished units: a line with range and question, the rows, and a line with counts and a digest.
#pragma once

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/digest.hpp"

namespace hinge::tool {

/// A range of conformations of a question.
struct Unit {
  std::uint64_t number = 0;  ///< from 0
  std::uint64_t of = 0;      ///< units of the question
  std::uint64_t first = 0;   ///< first conformation
  std::uint64_t end = 0;     ///< behind the last conformation
  std::string question;      ///< digest of the question
};

/// Counts of a unit, and its summary.
struct UnitCounts {
  std::uint64_t checked = 0, colliding = 0, missing = 0;
  std::string summary = "{}";  ///< a JSON object in one line
};

namespace units {

inline std::string first_line(const Unit& unit) {
  return "# hinge unit " + std::to_string(unit.number) + " of " + std::to_string(unit.of) + ": conformations " +
         std::to_string(unit.first) + " to " + std::to_string(unit.end - 1) + ", question " + unit.question + "\n";
}

/// The start of the last line. The digest of everything in front of it follows.
inline std::string last_line(const UnitCounts& counts) {
  return "\n# complete: checked " + std::to_string(counts.checked) + ", colliding " + std::to_string(counts.colliding) +
         ", missing " + std::to_string(counts.missing) + ", summary " + counts.summary + ", sha256 ";
}

}  // namespace units

/// Writes the file of a unit, completely or not at all.
class UnitWriter {
 public:
  /// Throws LoadError if the file cannot be written.
  UnitWriter(const std::filesystem::path& path, const Unit& unit) : file_(path.string()) {
    write(units::first_line(unit));
  }
  void write(std::string_view text) {
    digest_.add(text);
    file_.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
    file_.check();
  }
  void finish(const UnitCounts& counts) {
    write(units::last_line(counts));
    file_.stream() << digest_.text() << '\n';
    file_.finish();
  }

 private:
  CompleteFile file_;
  Digest digest_;
};

/// Reads the file of a unit.
class UnitReader {
 public:
  /// Reads the last line, and checks the first line and the digest. Throws LoadError that says what is wrong: the file
  /// is damaged, or of another question or range.
  UnitReader(std::filesystem::path path, const Unit& unit) : path_(std::move(path)) {
    std::ifstream in(path_, std::ios::binary);
    if (!in) throw LoadError(path_.string() + ": cannot be read: " + std::strerror(errno));
    std::string first;
    std::getline(in, first);
    if (first + '\n' != units::first_line(unit)) {
      const std::size_t at = first.find(", question ");
      if (first.starts_with("# hinge unit ") && at != std::string::npos && first.substr(at + 11) != unit.question)
        throw LoadError(path_.string() + ": is a unit of another question");
      refuse("its first line is not that of unit " + std::to_string(unit.number));
    }
    begin_ = first.size() + 1;
    const std::string last = read_last_line(in);
    end_ = size_ - last.size() - 1;
    const std::size_t at = last.rfind(' ') + 1;
    Digest digest;
    for_bytes(0, size_ - (last.size() - at), [&](std::string_view text) { digest.add(text); });
    if (digest.text() + '\n' != last.substr(at)) refuse("its digest differs");
    read_counts(last);
  }

  const UnitCounts& counts() const { return counts_; }
  /// Calls use(text) for the bytes of the rows, piece by piece.
  template <class Use>
  void for_rows(const Use& use) const {
    for_bytes(begin_, end_, use);
  }
  /// Calls use(line) for each row, without its end.
  template <class Use>
  void for_lines(const Use& use) const {
    std::string rest;
    for_rows([&](std::string_view text) {
      for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
        rest += text.substr(0, end);
        use(rest);
        rest.clear();
        text.remove_prefix(end + 1);
      }
      rest += text;
    });
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw LoadError(path_.string() + ": is damaged: " + what); }

  std::string read_last_line(std::ifstream& in) {
    in.clear();
    in.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(in.tellg());
    std::string tail;
    for (std::uint64_t length = 4096;; length *= 2) {
      length = std::min(length, size_ - begin_);
      tail.resize(length);
      in.seekg(static_cast<std::streamoff>(size_ - length));
      in.read(tail.data(), static_cast<std::streamsize>(length));
      const std::size_t at = tail.rfind("\n# complete: ");
      if (at != std::string::npos && tail.ends_with('\n')) return tail.substr(at + 1);
      if (length == size_ - begin_) refuse("it has no last line, so it is cut short");
    }
  }

  void read_counts(const std::string& last) {
    unsigned long long checked = 0, colliding = 0, missing = 0;
    if (std::sscanf(last.c_str(), "# complete: checked %llu, colliding %llu, missing %llu,", &checked, &colliding,
                    &missing) != 3)
      refuse("its counts cannot be read");
    const std::size_t from = last.find(", summary ") + 10, to = last.rfind(", sha256 ");
    counts_ = {checked, colliding, missing, last.substr(from, to - from)};
  }

  template <class Use>
  void for_bytes(std::uint64_t from, std::uint64_t to, const Use& use) const {
    std::ifstream in(path_, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(from));
    std::array<char, 1 << 16> buffer{};
    while (from < to) {
      in.read(buffer.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(buffer.size(), to - from)));
      const auto got = static_cast<std::uint64_t>(in.gcount());
      if (got == 0) refuse("it cannot be read to its end");
      use(std::string_view(buffer.data(), got));
      from += got;
    }
  }

  std::filesystem::path path_;
  std::uint64_t size_ = 0, begin_ = 0, end_ = 0;  // bytes: of the file, of its rows
  UnitCounts counts_;
};

}  // namespace hinge::tool
