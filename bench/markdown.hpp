// SPDX-License-Identifier: BSD-3-Clause
// Markdown tables from rows that the benchmarks wrote.
#pragma once

#include <cstddef>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "plot.hpp"

namespace hinge::bench {

using Json = nlohmann::ordered_json;
using Strings = std::vector<std::string>;

inline std::string line(const Strings& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text.append(" ").append(cell).append(" |");
  return text.append("\n");
}
inline std::string header(const Strings& cells) {
  std::string text = line(cells) + "|";
  for (std::size_t k = 0; k < cells.size(); ++k) text += "---|";
  return text.append("\n");
}

/// The rows of all files, by program and kind.
class Found {
 public:
  void read(const std::string& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file + ": cannot be read");
    const Json json = Json::parse(in);
    machine_ = json.at("machine");
    for (const Json& row : json.at("rows"))
      rows_[json.at("program").get<std::string>() + " " + text(row, "kind")].push_back(row);
  }
  static std::string text(const Json& row, const char* key) { return row.at(key).get<std::string>(); }
  static double value(const Json& row, const char* key) { return row.at(key).get<double>(); }
  const std::vector<Json>& rows(const std::string& program_and_kind) const {
    static const std::vector<Json> none;
    const auto found = rows_.find(program_and_kind);
    return found == rows_.end() ? none : found->second;
  }
  std::string machine() const {
    return "Machine: " + text(machine_, "processor") + ", " + std::to_string(machine_.at("cores").get<int>()) +
           " shared cores, g++ " + text(machine_, "compiler") + " `" + text(machine_, "flags") +
           "`, one thread, seed " + std::to_string(machine_.at("seed").get<int>()) + ", best of " +
           std::to_string(machine_.at("repetitions").get<int>()) + " for each conformation.\n";
  }

 private:
  Json machine_;
  std::map<std::string, std::vector<Json>> rows_;
};

/// Structure, free residues, DOF and atoms, as four table cells.
inline std::string setup_name(const Json& row) {
  const int free = row.at("free_residues").get<int>();
  return Found::text(row, "setup") + " | " + (free == 0 ? std::string("loops") : std::to_string(free)) + " | " +
         std::to_string(row.at("dof").get<int>()) + " | " + std::to_string(row.at("atoms").get<int>());
}

/// A table of unprocessed rows: the values of `keys` under `heads`.
inline std::string plain(const std::vector<Json>& rows, const Strings& heads, const Strings& keys) {
  std::string out = header(heads);
  for (const Json& row : rows) {
    Strings cells;
    if (row.contains("setup")) cells.push_back(setup_name(row));
    for (const std::string& key : keys) {
      const Json& cell = row.at(key);
      cells.push_back(cell.is_string()           ? cell.get<std::string>()
                      : cell.is_number_integer() ? std::to_string(cell.get<long long>())
                                                 : number(cell.get<double>()));
    }
    out += line(cells);
  }
  return out;
}

}  // namespace hinge::bench
