// SPDX-License-Identifier: BSD-3-Clause
// PartsFolder: the question of a run in units, and the folder that has the files of its units.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/version.hpp"
#include "hinge_tools/digest.hpp"
#include "hinge_tools/json_text.hpp"
#include "hinge_tools/rows.hpp"
#include "hinge_tools/temporary_file.hpp"
#include "hinge_tools/unit_file.hpp"

namespace hinge::tool {

/// Slice number `index` (from 1) of `of` slices of the units: index, index + of, index + 2 of, ...
struct Slice {
  std::uint64_t index = 1, of = 1;
};

/// Values of the options of a run in units.
struct PartsOptions {
  std::string folder;              ///< of the files; empty: one whole run
  std::uint64_t unit = 10000;      ///< conformations of a unit
  std::optional<Slice> slice;      ///< nothing: see chosen_slice()
  bool serves = false;             ///< take the numbers of units from standard input
  std::vector<std::string> words;  ///< the command line without options that change no result

  bool wanted() const { return !folder.empty(); }
};

/// Returns the arguments without the options that change no result.
inline std::vector<std::string> words_of_question(int argc, char** argv) {
  std::vector<std::string> words;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k], name = word.substr(0, word.find('='));
    if (name == "--serve" || name == "--exit-zero") continue;
    if (name == "--parts" || name == "--unit" || name == "--slice" || name == "--threads") {
      if (word == name) ++k;
      continue;
    }
    words.push_back(word);
  }
  return words;
}

/// Returns size and digest of an input file: of the whole file up to 64 MiB, otherwise of its first and last 32 MiB.
inline std::string input_digest(const std::string& path) {
  constexpr std::uint64_t half = std::uint64_t{32} << 20U;
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) return "";  // its reader reports it
  Digest digest;
  std::ifstream in(path, std::ios::binary);
  std::string buffer(1U << 20U, '\0');
  for (std::uint64_t at = 0; at < size;) {
    if (at == half && size > 2 * half) in.seekg(static_cast<std::streamoff>(at = size - half));
    in.read(buffer.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(buffer.size(), size - at)));
    if (in.gcount() == 0) throw LoadError(path + ": cannot be read");
    digest.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
    at += static_cast<std::uint64_t>(in.gcount());
  }
  return std::to_string(size) + " bytes, sha256 " + digest.text();
}

/// Returns the names and digests of input files. Empty paths are left out.
inline std::vector<std::pair<std::string, std::string>> input_digests(const std::vector<std::filesystem::path>& files) {
  std::vector<std::pair<std::string, std::string>> digests;
  for (const std::filesystem::path& file : files)
    if (!file.empty()) digests.emplace_back(file.string(), input_digest(file.string()));
  return digests;
}

/// What a folder of parts answers.
struct Question {
  std::string text;         ///< of question.json
  std::uint64_t total = 0;  ///< conformations
  std::uint64_t unit = 1;   ///< conformations of a unit; the last one may be shorter
  std::string digest{};     ///< of the text
  std::string noun{};       ///< "conformation" or "configuration"
  std::uint64_t units() const { return total / unit + (total % unit > 0 ? 1 : 0); }
  Unit at(std::uint64_t number) const {
    return {number, units(), number * unit, std::min(total, (number + 1) * unit), digest};
  }
};

/// Makes the question of a run. tool, command: names. model: what was read and how it is asked, JSON: equal in all
/// processes of the run. inputs: names and digests. Json: an ordered JSON.
template <class Json>
Question make_question(const std::string& tool, const std::string& command, const PartsOptions& options,
                       const RowsHead& head, const Json& model,
                       const std::vector<std::pair<std::string, std::string>>& inputs) {
  Json json{{"tool", tool}, {"version", version_string}, {"command", command}, {"format", word_of(head.output)}};
  json["total"] = head.total;
  json["unit"] = options.unit;
  json["words"] = options.words;
  json["inputs"] = Json::object();
  for (const auto& [name, digest] : inputs) json["inputs"][name] = digest;
  json["model"] = sha256_of_text(json_text(model));
  json["head_key"] = head.json_key;
  json["head"] = head.text;
  std::string text = json_text(json, 1) + "\n";
  std::string digest = sha256_of_text(text);
  return {std::move(text), head.total, options.unit, std::move(digest),
          head.json_key.substr(0, head.json_key.size() - 1)};
}

/// The folder of a run's units.
class PartsFolder {
 public:
  explicit PartsFolder(std::string path) : path_(std::move(path)) {}

  std::filesystem::path question_file() const { return path_ / "question.json"; }
  std::filesystem::path unit_file(std::uint64_t number) const {
    std::string digits = std::to_string(number);
    digits.insert(0, digits.size() < 9 ? 9 - digits.size() : 0, '0');
    return path_ / ("unit-" + digits + ".part");
  }

  /// Makes the folder if it is absent. Throws LoadError if that is not possible.
  void make() const {
    std::error_code error;
    if (!std::filesystem::is_directory(path_, error)) std::filesystem::create_directories(path_, error);
    if (!std::filesystem::is_directory(path_))
      throw LoadError(path_.string() + ": cannot be made: " + (error ? error.message() : "it is a file"));
  }

  /// Calls make(), and writes the question if the folder has none. Throws LoadError as make(), or if the folder is that
  /// of another question.
  void claim(const Question& question) const {
    make();
    std::error_code error;
    if (!std::filesystem::exists(question_file(), error)) {
      TemporaryFile file(question_file());
      std::ofstream out(file.path(), std::ios::binary);
      out << question.text;
      out.close();
      if (!out) throw LoadError(question_file().string() + ": cannot be written: " + std::strerror(errno));
      // A link fails if another process was first. Where links are not possible, the last one wins, and the other
      // notices it below or at its units.
      if (::link(file.path(), question_file().c_str()) != 0 && errno != EEXIST) file.replace_target();
    }
    compare(question);
  }

  /// Returns the text of question.json. Throws LoadError if it cannot be read.
  std::string read_question() const {
    std::ifstream in(question_file(), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) throw LoadError(question_file().string() + ": cannot be read, expected a folder of --parts");
    return text.str();
  }

  /// Returns the number of files that killed processes left.
  std::size_t left_over() const {
    std::size_t count = 0;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(path_, error))
      count += entry.path().extension() == ".partial" ? 1 : 0;
    return count;
  }

 private:
  void compare(const Question& question) const {
    std::istringstream there(read_question()), wanted(question.text);
    std::string has, expected;
    const auto next = [](std::istream& in, std::string& line) {
      const bool got = static_cast<bool>(std::getline(in, line));
      if (!got) line = "no more lines";
      if (line.ends_with(',')) line.pop_back();  // the last line of a list has none
      line.erase(0, std::min(line.find_first_not_of(' '), line.size()));
      return got;
    };
    for (bool more = true; more;) {
      more = next(there, has);
      more = next(wanted, expected) || more;
      if (has != expected)
        throw LoadError(question_file().string() + ": is another question: it has " + has.substr(0, 200) +
                        ", expected " + expected.substr(0, 200));
    }
  }

  std::filesystem::path path_;
};

}  // namespace hinge::tool
