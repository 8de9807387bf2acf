// SPDX-License-Identifier: BSD-3-Clause
// Writes benchmark results (JSON files) into docs/explanation/benchmarks.md, between the markers <!-- begin NAME -->
// and <!-- end NAME -->, and as plots into docs/images.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "markdown.hpp"
#include "plot.hpp"

namespace {

using namespace hinge::bench;
const Strings peers = {"fcl", "grid", "lazy", "chain", "chain16", "brute", "nanoflann", "gemmi"};

std::string ratios(const Found& found) {
  std::map<std::string, std::map<std::string, double>> table;
  Strings order;
  for (const Json& row : found.rows("summary ratio")) {
    const std::string key = Found::text(row, "query") + ", " + Found::text(row, "sampling");
    if (!table.contains(key)) order.push_back(key);
    table[key][Found::text(row, "peer")] = Found::value(row, "ratio");
  }
  Strings head = {"query, sampling"};
  head.insert(head.end(), peers.begin(), peers.end());
  std::string out = header(head);
  for (const std::string& key : order) {
    Strings cells = {key};
    for (const std::string& who : peers) cells.push_back(table[key].contains(who) ? number(table[key][who]) : "-");
    out += line(cells);
  }
  for (const Json& row : found.rows("summary mean"))
    out +=
        "\nWith everything included, yes/no near-free at " + std::to_string(row.at("floor_dof").get<int>()) +
        " DOF takes " + number(Found::value(row, "floor")) +
        " times as long as forward kinematics and coordinates. From random torsions, with forward kinematics on both "
        "sides, FCL takes " +
        number(Found::value(row, "torsions_fcl")) + " times as long.\n";
  for (const Json& row : found.rows("summary checked"))
    out += "Answers compared with brute force before timing: " + std::to_string(row.at("conformations").get<int>()) +
           " conformations in five modes, " +
           std::to_string(row.at("differences").get<int>() + row.at("timed_differences").get<int>()) +
           " differences.\n";
  return out;
}

/// One table for each sampling and query that the page shows; the benchmark itself prints all of them.
std::string times(const Found& found, bool loops) {
  const std::vector<std::pair<std::string, std::string>> shown =
      loops ? std::vector<std::pair<std::string, std::string>>{{"near-free", "any"}, {"random", "all"}}
            : std::vector<std::pair<std::string, std::string>>{{"near-free", "any"},
                                                               {"random", "any"},
                                                               {"random", "all"},
                                                               {"near-free", "within"},
                                                               {"near-free", "closest"}};
  const Strings columns = {"simd",        "fcl",           "grid",  "lazy",      "chain-spheres",
                           "chain-boxes", "chain16-boxes", "brute", "nanoflann", "gemmi"};
  std::string out;
  for (const auto& [sampling, query] : shown) {
    std::map<std::string, std::map<std::string, double>> table;
    Strings order;
    for (const Json& row : found.rows("paper time")) {
      if (Found::text(row, "sampling") != sampling || Found::text(row, "query") != query) continue;
      if ((row.at("free_residues") == 0) != loops) continue;
      const std::string key = setup_name(row);
      if (!table.contains(key)) order.push_back(key);
      table[key][Found::text(row, "peer")] = Found::value(row, "us");
    }
    Strings head = {"structure", "free residues", "DOF", "atoms"};
    head.insert(head.end(), columns.begin(), columns.end());
    out += "\n**" + query + ", " + sampling + "**\n\n" + header(head);
    for (const std::string& key : order) {
      Strings cells = {key};
      for (const std::string& who : columns) cells.push_back(table[key].contains(who) ? number(table[key][who]) : "-");
      out += line(cells);
    }
  }
  return out;
}

std::string trade(const Found& found) {
  std::string out;
  std::string title;
  for (const Json& row : found.rows("trade trade")) {
    if (Found::text(row, "title") != title) {
      title = Found::text(row, "title");
      out += "\n";
      out += header(
          {title, "yes/no µs", "closest µs", "false accepts %", "false rejects %", "gap error Å, mean", "largest"});
    }
    Strings cells = {Found::text(row, "variant")};
    for (const char* key : {"any_us", "closest_us", "false_accepts", "false_rejects"})
      cells.push_back(number(Found::value(row, key)));
    for (const char* key : {"mean_gap_error", "largest_gap_error"}) {
      char text[32];
      std::snprintf(text, sizeof text, "%.1g", Found::value(row, key));
      cells.push_back(text);
    }
    out += line(cells);
  }
  return out;
}

const Strings colours = {"#1b6ca8", "#c8553d", "#3a7d44"};

void plot_ratios(const Found& found, const std::string& folder) {
  const Strings queries = {"any", "all", "closest"};
  Plot plot("near-free: time over engine/simd's (blue any, red all, green closest)", 0.1, 1000);
  for (const Json& row : found.rows("summary ratio")) {
    const auto q = std::find(queries.begin(), queries.end(), Found::text(row, "query")) - queries.begin();
    const auto p = std::find(peers.begin(), peers.end(), Found::text(row, "peer")) - peers.begin();
    if (Found::text(row, "sampling") != "near-free" || q == 3) continue;
    const double slot = (Plot::width - Plot::left - 20) / static_cast<double>(peers.size());
    const double x = Plot::left + slot * static_cast<double>(p) + 6;
    plot.bar(x + static_cast<double>(q) * 28, 26, Found::value(row, "ratio"), colours[static_cast<std::size_t>(q)]);
    plot.label(x + 41, Plot::bottom + 20, Found::text(row, "peer"));
  }
  plot.write(folder + "/ratios.svg");
}

void plot_growth(const Found& found, const std::string& folder) {
  Plot plot("near-free, one residue in 16 free: ns per atom (blue any, red all, green grid any) against atoms", 1,
            1000);
  const auto x = [](double atoms) {
    return Plot::left + (Plot::width - Plot::left - 40) * (std::log10(atoms) - 3) / 3.2;
  };
  for (const double atoms : {1e3, 1e4, 1e5, 1e6}) plot.label(x(atoms), Plot::bottom + 20, number(atoms));
  for (const Json& row : found.rows("summary growth")) {
    plot.dot(x(Found::value(row, "atoms")), Found::value(row, "any_ns"), colours[0]);
    plot.dot(x(Found::value(row, "atoms")), Found::value(row, "all_ns"), colours[1]);
    plot.dot(x(Found::value(row, "atoms")), Found::value(row, "grid_any_ns"), colours[2]);
  }
  plot.write(folder + "/growth.svg");
}

void replace(std::string& page, const std::string& name, const std::string& by) {
  const std::string begin = "<!-- begin " + name + " -->\n", end = "<!-- end " + name + " -->";
  const auto from = page.find(begin), to = page.find(end);
  if (from == std::string::npos || to == std::string::npos) throw std::runtime_error("the page has no marker " + name);
  page.replace(from + begin.size(), to - from - begin.size(), by);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::printf("bench_report FILE.json...: nothing to report (the other benchmarks write such files with --json)\n");
    return 0;
  }
  try {
    Found found;
    for (int k = 1; k < argc; ++k) found.read(argv[k]);
    const std::string docs = std::string(HINGE_SOURCE_DIR) + "/docs", file = docs + "/explanation/benchmarks.md";
    std::ifstream in(file);
    std::string page{std::istreambuf_iterator<char>(in), {}};
    const Strings setup = {"structure", "free residues", "DOF", "atoms"};
    const auto with = [&](Strings more) {
      Strings heads = setup;
      heads.insert(heads.end(), more.begin(), more.end());
      return heads;
    };
    const std::map<std::string, std::pair<std::string, std::function<std::string()>>> sections = {
        {"machine", {"summary mean", [&] { return found.machine(); }}},
        {"ratios", {"summary ratio", [&] { return ratios(found); }}},
        {"below",
         {"summary below",
          [&] {
            return plain(found.rows("summary below"), {"row", "value", "goal"}, {"row", "value", "goal"});
          }}},
        {"times", {"paper time", [&] { return times(found, false); }}},
        {"loops", {"paper time", [&] { return times(found, true); }}},
        {"selection",
         {"paper selection",
          [&] {
            return plain(found.rows("paper selection"), with({"simd µs", "lazy µs"}), {"simd_us", "lazy_us"});
          }}},
        {"caches",
         {"paper caches",
          [&] {
            return plain(found.rows("paper caches"), with({"query", "method", "warm µs", "cold µs"}),
                         {"query", "peer", "warm_us", "cold_us"});
          }}},
        {"threads",
         {"summary threads",
          [&] {
            return plain(found.rows("summary threads"), with({"sampling", "one thread", "two"}),
                         {"sampling", "one", "two"});
          }}},
        {"tail",
         {"paper tail",
          [&] {
            return plain(found.rows("paper tail"), {"atoms", "sampling", "method", "µs"},
                         {"atoms", "sampling", "peer", "us"});
          }}},
        {"growth",
         {"summary growth",
          [&] {
            return plain(found.rows("summary growth"),
                         {"structure", "atoms", "DOF", "yes/no", "all pairs", "grid yes/no", "grid all", "bytes/atom"},
                         {"structure", "atoms", "dof", "any_ns", "all_ns", "grid_any_ns", "grid_all_ns", "bytes"});
          }}},
        {"check",
         {"check check",
          [&] {
            return plain(found.rows("check check"), with({"answers", "differences"}), {"answers", "differences"});
          }}},
        {"trade", {"trade trade", [&] { return trade(found); }}}};
    for (const auto& [name, section] : sections)
      if (!found.rows(section.first).empty()) replace(page, name, section.second());
    std::ofstream(file) << page;
    if (!found.rows("summary ratio").empty()) plot_ratios(found, docs + "/images");
    if (!found.rows("summary growth").empty()) plot_growth(found, docs + "/images");
    std::printf("written: %s\n", file.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_report: %s\n", error.what());
    return 1;
  }
  return 0;
}
