// SPDX-License-Identifier: BSD-3-Clause
// Parts: a run divided into units, whose results are files in a folder. Any number of processes, on any number of
// machines that share the folder, may work on it; each can be killed at any time.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/detail/simd/instruction_set.hpp"
#include "hinge/version.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/digest.hpp"
#include "hinge_tools/json_text.hpp"
#include "hinge_tools/number_option.hpp"
#include "hinge_tools/progress_bar.hpp"
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
  std::string folder;          ///< of the files; empty: one whole run
  std::uint64_t unit = 10000;  ///< conformations of a unit
  std::optional<Slice> slice;  ///< nothing: see chosen_slice()
  bool serves = false;         ///< take the numbers of units from standard input
  std::string words;           ///< the command line without options that change no result, one word a line

  bool wanted() const { return !folder.empty(); }
};

/// Reads a slice: "2/7" is the second of seven. Throws ModelError for another text, or for more than a million slices.
inline Slice parse_slice(const std::string& text) {
  constexpr std::uint64_t most = 1000000;
  Slice slice{0, 0};
  char rest = '\0';
  unsigned long long index = 0, of = 0;
  const bool digits = text.find_first_not_of("0123456789/") == std::string::npos && text.size() < 16;
  if (digits && std::sscanf(text.c_str(), "%llu/%llu%c", &index, &of, &rest) == 2) slice = {index, of};
  if (slice.index < 1 || slice.index > slice.of || slice.of > most)
    throw ModelError("--slice " + text + ": expected i/n, i from 1 to n, n at most " + std::to_string(most));
  return slice;
}

/// Returns the given slice, or that of a task of a Slurm array, or the whole. `note` receives a sentence if Slurm's is
/// taken.
inline Slice chosen_slice(const PartsOptions& options, std::string& note) {
  if (options.slice) return *options.slice;
  const auto number = [](const char* name) -> std::optional<std::uint64_t> {
    const char* text = std::getenv(name);
    if (text == nullptr || *text == '\0' || std::strspn(text, "0123456789") != std::strlen(text)) return std::nullopt;
    return std::strtoull(text, nullptr, 10);
  };
  const auto task = number("SLURM_ARRAY_TASK_ID"), least = number("SLURM_ARRAY_TASK_MIN"),
             most = number("SLURM_ARRAY_TASK_MAX");
  if (!task || !least || !most || *task < *least || *task > *most) return {};
  const Slice slice{*task - *least + 1, *most - *least + 1};
  note = "slice " + std::to_string(slice.index) + "/" + std::to_string(slice.of) + ", by SLURM_ARRAY_TASK_ID " +
         std::to_string(*task);
  return slice;
}

/// Returns the arguments without the options that change no result, one word a line.
inline std::string words_of_question(int argc, char** argv) {
  std::string words;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k], name = word.substr(0, word.find('='));
    if (name == "--serve" || name == "--exit-zero") continue;
    if (name == "--parts" || name == "--unit" || name == "--slice" || name == "--threads") {
      if (word == name) ++k;
      continue;
    }
    words += word + '\n';
  }
  return words;
}

/// Returns size and digest of an input file: of the whole file up to 64 MiB, otherwise of its first and last 32 MiB.
inline std::string input_digest(const std::string& path) {
  constexpr std::uint64_t half = std::uint64_t{32} << 20U;
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) return "";  // its reader reports it
  units::Digest digest;
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

/// Makes the question of a run. tool, command: names. inputs: names and digests. Json: an ordered JSON.
template <class Json>
Question make_question(const std::string& tool, const std::string& command, const PartsOptions& options,
                       const RowsHead& head, const std::vector<std::pair<std::string, std::string>>& inputs) {
  constexpr std::array<const char*, 4> formats = {"table", "json", "csv", "npy"};
  Json json{{"hinge_parts", 1}, {"tool", tool}, {"version", version_string}, {"command", command}};
  json["format"] = formats[static_cast<std::size_t>(head.output)];
  json["total"] = head.total;
  json["unit"] = options.unit;
  json["words"] = Json::array();
  std::istringstream words(options.words);
  for (std::string word; std::getline(words, word);) json["words"].push_back(word);
  json["inputs"] = Json::object();
  for (const auto& [name, digest] : inputs) json["inputs"][name] = digest;
  json["model"] = sha256_of_text(head.model);
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

  /// Makes the folder, and writes the question if it has none. Throws LoadError if the folder cannot be made, or is
  /// that of another question.
  void claim(const Question& question) const {
    std::error_code error;
    if (!std::filesystem::is_directory(path_, error)) std::filesystem::create_directories(path_, error);
    if (!std::filesystem::is_directory(path_))
      throw LoadError(path_.string() + ": cannot be made: " + (error ? error.message() : "it is a file"));
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

/// Computes the units of a slice that are not there yet, and prints a line about them. run(first, end, rows) ->
/// UnitCounts computes a range and writes its rows. Throws LoadError if the folder is another question's or cannot be
/// written; finished units stay.
template <class Run>
void run_units(const PartsOptions& options, const Question& question, const Run& run) {
  const PartsFolder folder(options.folder);
  folder.claim(question);
  const auto is_there = [&](std::uint64_t number) {
    const std::filesystem::path file = folder.unit_file(number);
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return false;
    try {
      const UnitReader unit(file, question.at(number));
      return true;
    } catch (const LoadError& damaged) {
      std::fprintf(stderr, "note: %s; it is computed again\n", damaged.what());
      return false;
    }
  };
  const auto compute = [&](std::uint64_t number) {
    const Unit unit = question.at(number);
    UnitWriter file(folder.unit_file(number), unit);
    Rows rows([&](std::string_view text) { file.write(text); }, false);
    const UnitCounts counts = run(unit.first, unit.end, rows);
    file.finish(counts);
    return counts;
  };
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  if (options.serves) {
    print("ready " + std::to_string(question.units()) + " " + question.digest + " " +
          std::string(detail::simd::name(detail::simd::compiled_for())) + "\n");
    std::fflush(stdout);
    for (std::string line; std::getline(std::cin, line);) {
      const auto number =
          read_number<std::uint64_t>("unit", line, {0, std::max<std::uint64_t>(question.units(), 1) - 1});
      const double before = seconds();
      const bool there = is_there(number);
      if (!there) compute(number);
      print((there ? "there " : "done ") + std::to_string(number) + " " + number_text(seconds() - before) + "\n");
      std::fflush(stdout);
    }
    return;
  }
  std::string note;
  const Slice slice = chosen_slice(options, note);
  if (!note.empty()) std::fprintf(stderr, "note: %s\n", note.c_str());
  std::uint64_t own = 0, there = 0, conformations = 0;
  ProgressBar bar(question.units() / slice.of);
  for (std::uint64_t number = slice.index - 1; number < question.units(); number += slice.of) {
    ++own;
    if (is_there(number))
      ++there;
    else
      conformations += compute(number).checked;
    bar.show(own);
  }
  const double rate = static_cast<double>(conformations) / std::max(seconds(), 1e-9);
  std::string text = options.folder + ": " + counted(own - there, "unit") + " computed";
  if (there > 0) text += ", " + std::to_string(there) + " were there";
  if (slice.of > 1) text += ", slice " + std::to_string(slice.index) + "/" + std::to_string(slice.of);
  text += ", of " + counted(question.units(), "unit");
  if (conformations > 0)
    text += "; " + counted(conformations, question.noun) + ", " + std::to_string(std::llround(rate)) + " per second";
  print(text + "\n");
}

}  // namespace hinge::tool
