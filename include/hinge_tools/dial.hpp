// SPDX-License-Identifier: BSD-3-Clause
// Dial: choices that answer the same questions, and what is measured of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge_tools/statistics.hpp"

namespace hinge::tool {

/// What is known of a choice's errors without a measurement.
enum class Sound : std::uint8_t { exact, no_false_accept, unknown };

/// The answer to one question.
enum class Verdict3 : std::uint8_t { free = 0, collides = 1, undecided = 2 };

/// One way to answer the questions of a section.
struct DialChoice {
  std::string kind;     ///< such as "engine"; choices of one kind share a mark in the chart
  std::string name;     ///< such as "capsule around each link"
  std::string options;  ///< options of the tool that select it; empty: there are none
  Sound sound = Sound::unknown;
  /// Answers questions first, first + 1, ... into `verdicts`. Its time is measured.
  std::function<void(std::uint64_t first, std::span<Verdict3> verdicts)> ask;
  /// Prepares the same questions for ask(). Not timed. May be empty.
  std::function<void(std::uint64_t first, std::size_t count)> prepare{};
  /// Returns the smallest distance of question k, to be compared with the reference's. Empty: not measured.
  std::function<double(std::uint64_t k)> distance{};
};

/// Choices that answer the same questions. The first one is the reference.
struct DialSection {
  std::string title;                                         ///< such as "Configurations"
  std::array<std::string, 2> unit{"question", "questions"};  ///< what a question is about: singular, plural
  std::string population;                                    ///< how the questions are drawn, in words
  std::string length_unit;                                   ///< "m" or "angstrom"
  std::vector<DialChoice> choices;
};

/// What was measured of one choice.
struct DialRow {
  std::string kind, name, options;
  Sound sound = Sound::unknown;
  std::uint64_t count = 0;          ///< questions asked
  std::uint64_t colliding = 0;      ///< of these colliding, by the reference
  std::uint64_t free = 0;           ///< of these free, by the reference
  std::uint64_t false_accepts = 0;  ///< colliding, but called free
  std::uint64_t false_rejects = 0;  ///< free, but called colliding
  Estimate seconds;                 ///< for each question: the median of the rounds
  Estimate speed;                   ///< time of the reference divided by own time: the median of the rounds
  std::uint64_t distances = 0;      ///< distances compared
  Estimate mean_distance_error;     ///< with a 95 % interval of the normal approximation
  double largest_distance_error = 0.0;
  bool is_on_front = false;  ///< no other row of the section is faster and wrong less often

  /// Returns a share with its interval, or nothing if its denominator is 0.
  std::optional<Estimate> accept_rate() const { return rate(false_accepts, colliding); }
  std::optional<Estimate> reject_rate() const { return rate(false_rejects, free); }
  std::optional<Estimate> wrong_rate() const { return rate(false_accepts + false_rejects, colliding + free); }

 private:
  static std::optional<Estimate> rate(std::uint64_t part, std::uint64_t all) {
    return all > 0 ? std::optional(share_of(part, all)) : std::nullopt;
  }
};

/// How long to measure.
struct DialEffort {
  double seconds = 60.0;                 ///< for the whole section
  std::optional<std::uint64_t> count{};  ///< if given: the number of questions, which every choice answers
  std::uint64_t first = 0;               ///< index of the first question
  std::uint64_t most = UINT64_MAX;       ///< largest number of questions; they are fewer if the time is over
};

/// The result of one section.
struct DialResult {
  DialSection section;  ///< without functions that were dropped
  std::vector<DialRow> rows;
  std::vector<std::string> notes;  ///< choices that were too slow to be measured
};

/// The largest errors that a user accepts, as shares of the colliding and of the free questions.
struct DialLimits {
  double false_accepts = 0.0;
  double false_rejects = 0.01;
};

/// Returns true if the row keeps the limits. A limit of 0 is kept by choices that cannot make such an error and made
/// none, and any other limit if the upper end of the interval is not above it.
inline bool keeps(const DialRow& row, const DialLimits& limits) {
  if (row.sound == Sound::exact) return row.false_accepts + row.false_rejects == 0;
  const auto below = [](const std::optional<Estimate>& rate, double limit) {
    return limit > 0.0 && rate && rate->high <= limit;
  };
  const bool accepts =
      row.sound == Sound::no_false_accept ? row.false_accepts == 0 : below(row.accept_rate(), limits.false_accepts);
  return accepts && below(row.reject_rate(), limits.false_rejects);
}

/// Values of the options that both tools have.
struct DialOptions {
  double seconds = 60.0;               // of the whole run
  std::optional<std::uint64_t> count;  // number of questions; empty: as many as the time allows
  double false_accepts = 0.0;          // percent, largest that a recommendation may have
  double false_rejects = 1.0;          // the same
  bool extremes = false;               // also try extremes
  std::string apply;                   // settings file to write; empty: none

  /// Returns the largest errors as shares.
  DialLimits limits() const { return {false_accepts / 100.0, false_rejects / 100.0}; }
};

}  // namespace hinge::tool
