// SPDX-License-Identifier: BSD-3-Clause
// Results that a benchmark prints and writes: the machine, rows as JSON, geometric means.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "contestant.hpp"
#include "goals.hpp"
#include "hinge/core/number_text.hpp"
#include "scene.hpp"
#include "timing.hpp"

#ifndef HINGE_BENCH_FLAGS
#define HINGE_BENCH_FLAGS "unknown"
#endif

namespace hinge::bench {

using Json = nlohmann::ordered_json;

/// All rows that one program measured, in order.
class Results {
 public:
  explicit Results(const std::string& program) {
    json_["program"] = program;
    json_["machine"] = {{"processor", processor()},
                        {"cores", std::thread::hardware_concurrency()},
                        {"compiler", __VERSION__},
                        {"flags", HINGE_BENCH_FLAGS},
                        {"seed", seed},
                        {"repetitions", repetitions}};
    const Json& m = json_["machine"];
    std::printf("machine: %s; compiler: %s; flags: %s; seed %llu; one thread, best of %d per conformation\n",
                m["processor"].get<std::string>().c_str(), __VERSION__, HINGE_BENCH_FLAGS,
                static_cast<unsigned long long>(seed), repetitions);
    json_["rows"] = Json::array();
  }
  void add(Json row) { json_["rows"].push_back(std::move(row)); }
  /// Prints the row with its value, and compares it with its goal.
  void print(const std::string& row, double value, int digits = 2) {
    std::printf("%s %.*f\n", row.c_str(), digits, value);
    goals_.check(row, value);
  }
  /// Prints and adds the rows that miss their goals.
  void print_missed() {
    goals_.print();
    for (const auto& [row, value, goal] : goals_.missed())
      add({{"kind", "below"},
           {"row", row},
           {"value", value},
           {"goal", (goal->at_most ? "at most " : "at least ") + number_text(goal->value)}});
  }
  /// Writes nothing if `file` is empty. Throws std::runtime_error if the file cannot be written.
  void write(const std::string& file) const {
    if (file.empty()) return;
    std::ofstream out(file);
    out << json_.dump(1) << '\n';
    if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
  }

 private:
  static std::string processor() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
      if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
  }
  Json json_;
  Goals goals_;
};

inline Json describe(const Setup& setup, const Scene& scene) {
  return {
      {"setup", setup.name}, {"free_residues", setup.residues}, {"dof", scene.dof_count()}, {"atoms", scene.size()}};
}

/// Geometric mean of positive numbers, added one at a time.
class GeometricMean {
 public:
  void add(double x) {
    log_sum_ += std::log(x);
    ++count_;
  }
  double value() const { return std::exp(log_sum_ / count_); }
  int count() const { return count_; }

 private:
  double log_sum_ = 0.0;
  int count_ = 0;
};

/// chain: ChainTree as published. chain16: leaves of sixteen compared in SIMD lanes, a design of this project.
inline constexpr const char* peer_names[] = {"fcl", "grid", "lazy", "chain", "chain16", "brute", "nanoflann", "gemmi"};

/// Ratios of peer time to engine/simd time, by query, sampling and peer; one value per set-up.
class Ratios {
 public:
  /// For each set-up, only the better of the chain trees NAME-spheres and NAME-boxes counts.
  void add(Query query, Sampling sampling, const Cell& cell) {
    std::map<std::string, double> best;
    for (const Series& s : cell.series) {
      if (s.name == "simd") continue;
      const std::string peer = s.name.substr(0, s.name.find('-'));
      const auto [entry, first] = best.emplace(peer, s.ratio());
      if (!first) entry->second = std::min(entry->second, s.ratio());
    }
    for (const auto& [peer, ratio] : best) means_[{query, sampling, peer}].add(ratio);
  }
  void print(Results& results) const {
    for (const Query query : all_queries)
      for (const Sampling sampling : all_samplings)
        for (const char* who : peer_names) {
          const auto found = means_.find({query, sampling, who});
          if (found == means_.end()) continue;
          results.print(std::string("ratio ") + name(query) + ' ' + name(sampling) + ' ' + who, found->second.value());
          results.add({{"kind", "ratio"},
                       {"query", name(query)},
                       {"sampling", name(sampling)},
                       {"peer", who},
                       {"ratio", found->second.value()},
                       {"setups", found->second.count()}});
        }
  }

 private:
  std::map<std::tuple<Query, Sampling, std::string>, GeometricMean> means_;
};

inline void add_cell(Results& results, const Json& setup, Query query, Sampling sampling, const Cell& cell) {
  for (const Series& s : cell.series) {
    Json row = {{"kind", "time"}};
    row.update(setup);
    row.update({{"query", name(query)},
                {"sampling", name(sampling)},
                {"peer", s.name},
                {"us", s.us},
                {"simd_us", s.simd_us},
                {"pairs", cell.pairs},
                {"conformations", s.conformations},
                {"colliding", static_cast<double>(cell.colliding) / cell.conformations}});
    results.add(std::move(row));
  }
}

/// Command-line arguments: an optional number, and --json FILE.
struct Arguments {
  double number = 0.0;
  std::string json;

  /// Exits the program on other arguments.
  static Arguments parse(int argc, char** argv, double number, const char* meaning) {
    Arguments arguments{number, {}};
    for (int k = 1; k < argc; ++k) {
      char* end = nullptr;
      if (std::string_view(argv[k]) == "--json" && k + 1 < argc) {
        arguments.json = argv[++k];
      } else if (arguments.number = std::strtod(argv[k], &end);
                 end == argv[k] || *end != '\0' || !(arguments.number > 0)) {
        std::fprintf(stderr, "usage: %s [%s, default %g] [--json FILE]\n", argv[0], meaning, number);
        std::exit(2);
      }
    }
    return arguments;
  }
};

}  // namespace hinge::bench
