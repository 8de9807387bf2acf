// SPDX-License-Identifier: BSD-3-Clause
// Rows: prints the results of a run, one row per conformation, to standard output or to the file of a unit.
#pragma once

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace hinge::tool {

/// Format of standard output. npy: an array of bytes in the format of NumPy, one per conformation: 0 free, 1 collides,
/// 2 no conformation was found.
enum class Output : std::uint8_t { table, json, csv, npy };
/// The words for them, which are also the extensions of files.
inline constexpr std::array<const char*, 4> output_words = {"table", "json", "csv", "npy"};
inline const char* word_of(Output output) { return output_words[static_cast<std::size_t>(output)]; }

/// What stands in front of the rows.
struct RowsHead {
  Output output = Output::table;
  std::string text;         ///< json: an object, several lines; csv: the line of column names
  std::string json_key;     ///< json: name of the list of rows
  std::uint64_t total = 0;  ///< conformations of the run
};

/// Returns the text in front of the rows.
inline std::string opening(const RowsHead& head) {
  if (head.output == Output::json) {
    std::string text = head.text;
    text.resize(text.rfind('\n'));  // the closing brace follows the summary
    return text + ",\n\"" + head.json_key + "\": [";
  }
  if (head.output == Output::csv) return head.text;
  if (head.output == Output::table) return "";
  // NumPy's format 1.0: a magic word, the length of the dictionary, the dictionary, padded to 64 bytes.
  std::string words = "{'descr': '|u1', 'fortran_order': False, 'shape': (" + std::to_string(head.total) + ",), }";
  constexpr std::size_t fixed = 10, align = 64;
  words.resize((fixed + words.size() + 1 + align - 1) / align * align - fixed - 1, ' ');
  words += '\n';
  const std::size_t length = words.size();
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(length & 0xff) + static_cast<char>(length >> 8) +
         words;
}

/// Returns the text behind the rows. summary: a JSON object.
inline std::string closing(Output output, std::string_view summary) {
  return output == Output::json ? "\n],\n\"summary\": " + std::string(summary) + "}\n" : std::string();
}

/// Writes rows. Do not mix the three kinds of rows.
class Rows {
 public:
  /// separated: JSON rows stand in a list; otherwise each is a line.
  Rows(std::function<void(std::string_view)> write, bool separated) : write_(std::move(write)), separated_(separated) {}

  /// Writes a JSON row, one line without its end.
  void add_json(std::string_view row) {
    if (separated_) write_(std::exchange(empty_, false) ? "\n" : ",\n");
    write_(row);
    if (!separated_) write_("\n");
  }
  /// Writes CSV rows, each with its line end.
  void add_csv(std::string_view rows) { write_(rows); }
  /// Writes a byte of Output::npy.
  void add_verdict(std::uint8_t verdict) {
    const char byte = static_cast<char>(verdict);
    write_({&byte, 1});
  }

 private:
  std::function<void(std::string_view)> write_;
  bool separated_;
  bool empty_ = true;
};

/// Writes to standard output. Throws std::system_error if that fails, so that a full disk ends a run; see run_tool().
inline void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) < text.size())
    throw std::system_error(errno, std::generic_category(), "standard output");
}

/// Returns rows that go to standard output.
inline Rows printed_rows() { return {print, true}; }

}  // namespace hinge::tool
