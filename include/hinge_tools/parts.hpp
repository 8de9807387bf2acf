// SPDX-License-Identifier: BSD-3-Clause
// Parts: a run divided into units, whose results are files in a folder. Any number of processes, on any number of
// machines that share the folder, may work on it; each can be killed at any time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/detail/simd/instruction_set.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/number_option.hpp"
#include "hinge_tools/parts_folder.hpp"
#include "hinge_tools/progress_bar.hpp"
#include "hinge_tools/rows.hpp"
#include "hinge_tools/this_program.hpp"
#include "hinge_tools/unit_file.hpp"

namespace hinge::tool {

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

/// The units of a question, and how they are computed: run(first, end, rows) -> UnitCounts computes a range and writes
/// its rows. Refers to run.
template <class Run>
class Units {
 public:
  /// Throws LoadError if the folder is another question's or cannot be written.
  Units(const std::string& folder, Question question, const Run& run)
      : folder_(folder), question_(std::move(question)), run_(run) {
    folder_.claim(question_);
  }

  const Question& question() const { return question_; }

  /// Returns the number of conformations that were computed; nothing if the unit was there. Throws LoadError if its
  /// file cannot be written.
  std::optional<std::uint64_t> compute(std::uint64_t number) const {
    if (is_there(number)) return std::nullopt;
    const Unit unit = question_.at(number);
    UnitWriter file(folder_.unit_file(number), unit);
    Rows rows([&](std::string_view text) { file.write(text); }, false);
    const UnitCounts counts = run_(unit.first, unit.end, rows);
    file.finish(counts);
    return counts.checked;
  }

 private:
  bool is_there(std::uint64_t number) const {
    const std::filesystem::path file = folder_.unit_file(number);
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return false;
    try {
      const UnitReader unit(file, question_.at(number));
      return true;
    } catch (const LoadError& damaged) {
      std::fprintf(stderr, "note: %s; it is computed again\n", damaged.what());
      return false;
    }
  }

  PartsFolder folder_;
  Question question_;
  const Run& run_;
};

/// Computes the units whose numbers arrive on standard input, and answers each with a line.
template <class Run>
void serve_units(const Units<Run>& units) {
  const Question& question = units.question();
  print("ready " + std::to_string(question.units()) + " " + question.digest + " " +
        std::string(detail::simd::name(instruction_set)) + "\n");
  std::fflush(stdout);
  for (std::string line; std::getline(std::cin, line);) {
    const auto number = read_number<std::uint64_t>("unit", line, {0, std::max<std::uint64_t>(question.units(), 1) - 1});
    const auto start = Clock::now();
    const bool computed = units.compute(number).has_value();
    print((computed ? "done " : "there ") + std::to_string(number) + " " + number_text(seconds_since(start)) + "\n");
    std::fflush(stdout);
  }
}

/// Computes the units of a slice that are not there yet, and prints a line about them.
template <class Run>
void compute_slice(const Units<Run>& units, const PartsOptions& options) {
  const Question& question = units.question();
  std::string note;
  const Slice slice = chosen_slice(options, note);
  if (!note.empty()) std::fprintf(stderr, "note: %s\n", note.c_str());
  const auto start = Clock::now();
  std::uint64_t own = 0, there = 0, conformations = 0;
  ProgressBar bar(question.units() / slice.of);
  for (std::uint64_t number = slice.index - 1; number < question.units(); number += slice.of) {
    const auto computed = units.compute(number);
    there += computed ? 0 : 1;
    conformations += computed.value_or(0);
    bar.show(++own);
  }
  const double rate = static_cast<double>(conformations) / std::max(seconds_since(start), 1e-9);
  std::string text = options.folder + ": " + counted(own - there, "unit") + " computed";
  if (there > 0) text += ", " + std::to_string(there) + " were there";
  if (slice.of > 1) text += ", slice " + std::to_string(slice.index) + "/" + std::to_string(slice.of);
  text += ", of " + counted(question.units(), "unit");
  if (conformations > 0)
    text += "; " + counted(conformations, question.noun) + ", " + std::to_string(std::llround(rate)) + " per second";
  print(text + "\n");
}

/// Computes the units that the options ask for and that are not there yet. run: see Units. Throws LoadError as Units;
/// finished units stay.
template <class Run>
void run_units(const PartsOptions& options, const Question& question, const Run& run) {
  const Units<Run> units(options.folder, question, run);
  if (options.serves)
    serve_units(units);
  else
    compute_slice(units, options);
}

}  // namespace hinge::tool
