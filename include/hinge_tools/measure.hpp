// SPDX-License-Identifier: BSD-3-Clause
// Measures choices: what each one costs and gets wrong, compared with an exact reference on the same questions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/number_text.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/dial.hpp"
#include "hinge_tools/progress_bar.hpp"
#include "hinge_tools/statistics.hpp"

namespace hinge::tool {

namespace dial {

/// Sets is_on_front of every row.
inline void find_front(std::vector<DialRow>& rows) {
  const auto wrong = [](const DialRow& row) {
    const auto rate = row.wrong_rate();
    return rate ? rate->value : 0.0;
  };
  for (DialRow& row : rows)
    row.is_on_front = std::ranges::none_of(rows, [&](const DialRow& other) {
      const bool no_worse = other.seconds.value <= row.seconds.value && wrong(other) <= wrong(row);
      return no_worse && (other.seconds.value < row.seconds.value || wrong(other) < wrong(row));
    });
}

/// One section while it is measured. Every round asks new questions, and each choice in turn answers them.
class Measurement {
 public:
  Measurement(DialSection section, const DialEffort& effort) : effort_(effort) {
    result_.section = std::move(section);
    for (const DialChoice& choice : result_.section.choices) {
      DialRow& row = result_.rows.emplace_back();
      row.kind = choice.kind;
      row.name = choice.name;
      row.options = choice.options;
      row.sound = choice.sound;
    }
  }

  DialResult run() {
    const auto start = Clock::now();
    choose_lengths();
    ProgressBar bar(bar_steps);
    std::uint64_t next = effort_.first;
    const std::uint64_t asked = std::min(effort_.most, effort_.count.value_or(UINT64_MAX));
    const std::uint64_t end = effort_.first + std::min(asked, UINT64_MAX - effort_.first);
    for (std::size_t round = 0; next < end; ++round) {
      const double spent = seconds_since(start);
      const double done = effort_.count
                              ? static_cast<double>(next - effort_.first) / static_cast<double>(*effort_.count)
                              : spent / effort_.seconds;
      bar.show(static_cast<std::uint64_t>(std::min(1.0, done) * static_cast<double>(bar_steps)));
      if (!effort_.count && round > 2 && spent >= effort_.seconds) break;
      const auto length = static_cast<std::size_t>(std::min<std::uint64_t>(lengths_[0], end - next));
      ask_all(round, next, length);
      measure_distances(next, length);
      next += length;
    }
    finish();
    return std::move(result_);
  }

 private:
  static constexpr double rounds = 40.0;                // fewer make the interval of the median wide
  static constexpr double distance_share = 0.2;         // of the time of a round
  static constexpr std::uint64_t most_distances = 200;  // if the number of questions is given
  static constexpr std::size_t longest = 65536;
  static constexpr std::uint64_t bar_steps = 1000;

  const DialChoice& choice(std::size_t c) const { return result_.section.choices[c]; }

  /// Times a choice on the first questions.
  double time(std::size_t c, std::size_t count) {
    count = static_cast<std::size_t>(std::min<std::uint64_t>(count, effort_.most));
    std::vector<Verdict3> verdicts(count);
    if (choice(c).prepare) choice(c).prepare(effort_.first, count);
    const auto start = Clock::now();
    choice(c).ask(effort_.first, verdicts);
    return seconds_since(start) / static_cast<double>(count);
  }

  /// Finds how many questions each choice can answer in a round, and drops choices that cannot answer one.
  void choose_lengths() {
    const double share = effort_.seconds / rounds * (1.0 - distance_share);
    std::vector<double> seconds;
    for (std::size_t c = 0; c < result_.rows.size();) {
      double one = time(c, 1);
      if (one < share) one = time(c, 1);  // the first answer may prepare data
      for (std::size_t count = 4; count <= 1024 && one * static_cast<double>(count) < 0.02; count *= 4)
        one = time(c, count);
      if (c > 0 && !effort_.count && one > share) {
        result_.notes.push_back(choice(c).name + ": left out, one answer takes " + fixed_text(one, 1) + " s");
        result_.section.choices.erase(result_.section.choices.begin() + static_cast<std::ptrdiff_t>(c));
        result_.rows.erase(result_.rows.begin() + static_cast<std::ptrdiff_t>(c));
        continue;
      }
      seconds.push_back(one);
      ++c;
    }
    const double each = share / static_cast<double>(seconds.size());
    const auto fits = [&](double one) {
      return static_cast<std::size_t>(std::clamp(each / std::max(one, 1e-9), 1.0, static_cast<double>(longest)));
    };
    for (const double one : seconds) lengths_.push_back(fits(one));
    for (std::size_t& length : lengths_) length = std::min(length, lengths_[0]);
    if (!effort_.count) return;
    const auto all = static_cast<std::size_t>(std::clamp(static_cast<double>(*effort_.count) / rounds, 1.0, 65536.0));
    for (std::size_t& length : lengths_) length = all;
  }

  void ask_all(std::size_t round, std::uint64_t first, std::size_t length) {
    const std::size_t choices = result_.rows.size();
    std::vector<std::vector<Verdict3>> verdicts(choices);
    std::vector<double> seconds(choices);
    for (std::size_t turn = 0; turn < choices; ++turn) {
      const std::size_t c = (turn + round) % choices;
      verdicts[c].resize(std::min(length, lengths_[c]));
      if (choice(c).prepare) choice(c).prepare(first, verdicts[c].size());
      const auto start = Clock::now();
      choice(c).ask(first, verdicts[c]);
      seconds[c] = seconds_since(start) / static_cast<double>(verdicts[c].size());
    }
    for (std::size_t c = 0; c < choices; ++c) {
      DialRow& row = result_.rows[c];
      row.count += verdicts[c].size();
      for (std::size_t k = 0; k < verdicts[c].size(); ++k) {
        const Verdict3 truth = verdicts[0][k], given = verdicts[c][k];
        if (truth == Verdict3::undecided || given == Verdict3::undecided) continue;
        ++(truth == Verdict3::collides ? row.colliding : row.free);
        if (truth != given) ++(truth == Verdict3::collides ? row.false_accepts : row.false_rejects);
      }
      rounds_.resize(choices);
      rounds_[c].push_back({seconds[c], seconds[0] / seconds[c]});
    }
  }

  void measure_distances(std::uint64_t first, std::size_t length) {
    if (!choice(0).distance) return;
    const double allowed = effort_.seconds / rounds * distance_share;
    errors_.resize(result_.rows.size());
    const auto start = Clock::now();
    for (std::uint64_t k = first; k < first + length; ++k) {
      const bool enough = effort_.count ? result_.rows[0].distances >= most_distances : seconds_since(start) > allowed;
      if (enough) break;
      const double truth = choice(0).distance(k);
      ++result_.rows[0].distances;
      for (std::size_t c = 1; c < result_.rows.size(); ++c) {
        if (!choice(c).distance) continue;
        const double error = std::abs(choice(c).distance(k) - truth);
        if (!std::isfinite(error)) continue;  // without a tested pair there is no distance
        DialRow& row = result_.rows[c];
        ++row.distances;
        errors_[c].push_back(error);
        row.largest_distance_error = std::max(row.largest_distance_error, error);
      }
    }
  }

  void finish() {
    errors_.resize(result_.rows.size());
    for (std::size_t c = 0; c < result_.rows.size(); ++c) {
      DialRow& row = result_.rows[c];
      std::vector<double> seconds, speed;
      for (const auto& [second, ratio] : rounds_[c]) {
        seconds.push_back(second);
        speed.push_back(ratio);
      }
      row.seconds = median_of(std::move(seconds));
      row.speed = median_of(std::move(speed));
      if (!errors_[c].empty()) row.mean_distance_error = mean_of(errors_[c]);
    }
    find_front(result_.rows);
  }

  DialEffort effort_;
  DialResult result_;
  std::vector<std::size_t> lengths_;                            // by choice: most questions of a round
  std::vector<std::vector<std::pair<double, double>>> rounds_;  // by choice and round: seconds, speed
  std::vector<std::vector<double>> errors_;                     // by choice: of distances
};

}  // namespace dial

/// Asks the questions effort.first, effort.first + 1, ... of every choice until the time is over. Slow choices answer
/// only the first questions of each round.
inline DialResult measure(DialSection section, const DialEffort& effort) {
  return dial::Measurement(std::move(section), effort).run();
}

/// Measures a choice against a reference on fresh questions, without distances. Returns its row if it keeps the limits
/// and is faster.
inline std::optional<DialRow> confirm(DialChoice reference, DialChoice choice, const DialEffort& effort,
                                      const DialLimits& limits) {
  DialSection section;
  section.choices = {std::move(reference), std::move(choice)};
  for (DialChoice& each : section.choices) each.distance = {};
  const DialResult result = measure(std::move(section), effort);
  const DialRow& row = result.rows.back();
  if (!keeps(row, limits) || row.speed.low <= 1.0) return std::nullopt;
  return row;
}

}  // namespace hinge::tool
