// SPDX-License-Identifier: BSD-3-Clause
// The report of a dial: measured choices, what the scene requires and a recommendation, as text and as JSON.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/number_text.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/dial.hpp"
#include "hinge_tools/report_page.hpp"

namespace hinge::tool {

/// Something that the scene does not require.
struct DialRequirement {
  std::string text;                ///< one sentence
  std::string options;             ///< options that leave it out; empty: it is left out already, or there are none
  std::vector<std::string> items;  ///< such as pairs of links
};

/// A table of texts.
struct DialExtremes {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> notes;  ///< one sentence each
};

/// What the tool recommends.
struct DialAdvice {
  std::string text;              ///< one sentence, with the reason
  std::string options;           ///< to be pasted; empty: none are needed
  std::optional<DialRow> check;  ///< the same choice on fresh questions, see confirm()
  std::string check_population;  ///< the fresh questions, in words
};

/// All results of one run.
struct DialReport {
  std::uint64_t seed = 1;
  double seconds = 60.0;
  DialLimits limits;
  std::vector<DialResult> sections;
  std::vector<DialRequirement> requirements;
  DialAdvice advice;
  std::optional<DialExtremes> extremes;
};

namespace dial {

/// Returns the text with blanks behind it up to a width.
inline std::string left(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

/// Returns the text with blanks in front of it up to a width.
inline std::string right(const std::string& text, std::size_t width) {
  return std::string(std::max(width, text.size()) - text.size(), ' ') + text;
}

/// Returns the line without blanks at its end, and with a line end.
inline std::string line(std::string text) {
  text.erase(text.find_last_not_of(' ') + 1);
  return text + '\n';
}

/// Returns a number with two significant digits, such as "0.013"; "0" for less than 10^-12.
inline std::string two_digits(double number) {
  if (std::abs(number) < 1e-12) return "0";
  return fixed_text(number, std::clamp(1 - static_cast<int>(std::floor(std::log10(std::abs(number)))), 0, 15));
}

}  // namespace dial

/// Returns a time with a fitting unit and three digits, such as "1.23 us".
inline std::string time_text(double seconds) {
  constexpr std::array<std::pair<double, const char*>, 4> units = {
      {{1.0, "s"}, {1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}}};
  const auto* unit = std::ranges::find_if(units, [&](const auto& u) { return seconds >= u.first * 0.9995; });
  if (unit == units.end()) --unit;
  const double value = seconds / unit->first;
  return fixed_text(value, value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2) + ' ' + unit->second;
}

/// Returns a share in percent with two significant digits, such as "0.13 %".
inline std::string percent_text(double share) { return dial::two_digits(100.0 * share) + " %"; }

/// Returns a share with its interval: "0 (< 0.12 %)" or "0.40 % (0.20-0.71)"; "-" if there is none.
inline std::string rate_text(const std::optional<Estimate>& rate) {
  if (!rate) return "-";
  if (rate->value == 0.0) return "0 (< " + percent_text(rate->high) + ")";
  return percent_text(rate->value) + " (" + dial::two_digits(100.0 * rate->low) + "-" +
         dial::two_digits(100.0 * rate->high) + ")";
}

/// Returns the limits in words.
inline std::string limits_text(const DialLimits& limits) {
  return "at most " + percent_text(limits.false_accepts) + " false accepts and " + percent_text(limits.false_rejects) +
         " false rejects";
}

/// Returns options, one with its values per line, as one would paste them.
inline std::string options_text(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : " ") + line;
  return text;
}

/// Returns the table of a section.
inline std::string table_text(const DialResult& result) {
  const DialSection& section = result.section;
  const DialRow& reference = result.rows.front();
  const double all = static_cast<double>(std::max<std::uint64_t>(1, reference.colliding + reference.free));
  std::size_t width = 20;
  for (const DialRow& row : result.rows) width = std::max(width, row.name.size());
  std::string text = section.title + ": " + counted(reference.count, section.unit[0], section.unit[1]) + ", " +
                     section.population + "; " + percent_text(static_cast<double>(reference.colliding) / all) +
                     " collide\n";
  const auto add = [&](char mark, const std::string& name, const std::string& time, const std::string& speed,
                       const std::string& accepts, const std::string& rejects, const std::string& distance) {
    text += dial::line(std::string(1, mark) + ' ' + dial::left(name, width) + ' ' + dial::right(time, 8) + ' ' +
                       dial::right(speed, 7) + "  " + dial::left(accepts, 23) + ' ' + dial::left(rejects, 23) + ' ' +
                       distance);
  };
  add(' ', "", "time", "speed", "false accepts", "false rejects",
      reference.distances == 0 ? "" : "distance error, mean and largest");
  for (const DialRow& row : result.rows) {
    const bool is_reference = &row == &result.rows.front();
    const bool exact = row.sound == Sound::exact && row.false_accepts == 0 && row.false_rejects == 0;
    const bool encloses = row.sound == Sound::no_false_accept && row.false_accepts == 0;
    const std::string accepts = is_reference ? "reference"
                                : exact      ? "none, exact"
                                : encloses   ? "none, encloses"
                                             : rate_text(row.accept_rate());
    std::string distance;
    if (!is_reference && row.distances > 0)
      distance = dial::two_digits(row.mean_distance_error.value) + ", " + dial::two_digits(row.largest_distance_error) +
                 ' ' + section.length_unit;
    add(row.is_on_front ? '*' : ' ', row.name, time_text(row.seconds.value), fixed_text(row.speed.value, 2), accepts,
        is_reference || exact ? "" : rate_text(row.reject_rate()), distance);
  }
  for (const std::string& note : result.notes) text += "  " + note + '\n';
  return text;
}

/// Returns a table of extremes.
inline std::string extremes_text(const DialExtremes& extremes) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < extremes.columns.size(); ++c) {
    widths.push_back(extremes.columns[c].size());
    for (const auto& row : extremes.rows) widths[c] = std::max(widths[c], row[c].size());
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t c = 0; c < cells.size(); ++c) text += "  " + dial::left(cells[c], widths[c]);
    return dial::line(std::move(text));
  };
  std::string text = "Extremes\n" + line(extremes.columns);
  for (const auto& row : extremes.rows) text += line(row);
  for (const std::string& note : extremes.notes) text += "  " + note + '\n';
  return text;
}

/// Returns the whole report as text, without the heading of the model.
inline std::string report_text(const DialReport& report) {
  std::string text;
  for (const DialResult& result : report.sections) text += table_text(result) + '\n';
  text +=
      "* on the Pareto front: no other choice is faster and wrong less often. Shares are of the colliding (accepts) "
      "and "
      "of\n  the free (rejects), with 95 % intervals; speed is the time of the reference divided by the own time.\n\n";
  if (!report.requirements.empty()) text += "What the scene requires\n";
  for (const DialRequirement& r : report.requirements) text += "  " + r.text + '\n';
  if (!report.requirements.empty()) text += '\n';
  if (report.extremes) text += extremes_text(*report.extremes) + '\n';
  text += "Recommendation: " + report.advice.text + '\n';
  if (!report.advice.options.empty()) text += "  options: " + report.advice.options + '\n';
  if (const auto& check = report.advice.check)
    text += "  checked, " + report.advice.check_population + ": " + fixed_text(check->speed.value, 2) +
            " times faster, " + counted(check->false_accepts, "false accept") + " in " + number_text(check->colliding) +
            ", " + counted(check->false_rejects, "false reject") + " in " + number_text(check->free) + ": holds\n";
  return text;
}

/// Returns the data of the report: docs/reference/report.md, `dial`.
template <class Json>
Json dial_json(const DialReport& report) {
  const auto interval = [](const std::optional<Estimate>& e) { return e ? Json::array({e->low, e->high}) : Json(); };
  const auto value = [](const std::optional<Estimate>& e) { return e ? Json(e->value) : Json(); };
  constexpr std::array<const char*, 3> sound_words = {"exact", "no false accept", ""};
  const auto row_json = [&](const DialRow& row) {
    Json json{{"kind", row.kind},       {"name", row.name},
              {"options", row.options}, {"sound", sound_words[static_cast<std::size_t>(row.sound)]},
              {"count", row.count},     {"colliding", row.colliding},
              {"free", row.free}};
    json["seconds"] = row.seconds.value;
    json["seconds_interval"] = interval(row.seconds);
    json["speed"] = row.speed.value;
    json["speed_interval"] = interval(row.speed);
    json["false_accepts"] = row.false_accepts;
    json["false_accept_rate"] = value(row.accept_rate());
    json["false_accept_interval"] = interval(row.accept_rate());
    json["false_rejects"] = row.false_rejects;
    json["false_reject_rate"] = value(row.reject_rate());
    json["false_reject_interval"] = interval(row.reject_rate());
    json["wrong_rate"] = value(row.wrong_rate());
    json["wrong_interval"] = interval(row.wrong_rate());
    const bool measured = row.distances > 0;
    json["distances"] = measured ? Json(row.distances) : Json();
    json["mean_distance_error"] = measured ? Json(row.mean_distance_error.value) : Json();
    json["mean_distance_error_interval"] = measured ? interval(row.mean_distance_error) : Json();
    json["largest_distance_error"] = measured ? Json(row.largest_distance_error) : Json();
    json["front"] = row.is_on_front;
    return json;
  };
  Json json{{"seed", report.seed}, {"seconds", report.seconds}};
  json["limits"] = {{"false_accepts", report.limits.false_accepts}, {"false_rejects", report.limits.false_rejects}};
  json["sections"] = Json::array();
  for (const DialResult& result : report.sections) {
    Json rows = Json::array();
    for (const DialRow& row : result.rows) rows.push_back(row_json(row));
    Json section{{"title", result.section.title}};
    section["unit"] = {result.section.unit[0], result.section.unit[1]};
    section["population"] = result.section.population;
    section["length_unit"] = result.section.length_unit;
    section["notes"] = result.notes;
    section["rows"] = std::move(rows);
    json["sections"].push_back(std::move(section));
  }
  json["requires"] = Json::array();
  for (const DialRequirement& r : report.requirements)
    json["requires"].push_back({{"text", r.text}, {"options", r.options}, {"items", r.items}});
  json["recommendation"] = {{"text", report.advice.text}, {"options", report.advice.options}, {"check", nullptr}};
  if (const auto& check = report.advice.check) {
    Json measured = row_json(*check);
    measured["population"] = report.advice.check_population;
    measured["holds"] = true;  // a choice that fails its check is not recommended
    json["recommendation"]["check"] = std::move(measured);
  }
  json["extremes"] = nullptr;
  if (const auto& e = report.extremes)
    json["extremes"] = {{"columns", e->columns}, {"rows", e->rows}, {"notes", e->notes}};
  return json;
}

/// Writes the page of a dial, if one is wanted. words: without a verdict. Throws LoadError if it cannot be written.
template <class Json>
void write_dial_page(CompleteFile& file, ReportWords words, const DialReport& report) {
  if (!file.wanted()) return;
  words.verdict = report.advice.text;
  auto data = report_head<Json>(words, "dial");
  data["dial"] = dial_json<Json>(report);
  write_report_page(file, dial_page(), data);
}

}  // namespace hinge::tool
