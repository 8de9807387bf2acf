// SPDX-License-Identifier: BSD-3-Clause
// Decisions and distances of Hinge, of plain double arithmetic and of FCL against exact arithmetic, on families of
// difficult pairs; and the cost of exact decisions on molecules and robots. Prints Markdown; --page writes it into
// docs/explanation/robustness.md, between the page's markers.
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include "robustness/against_fcl.hpp"
#include "robustness/balls.hpp"
#include "robustness/page.hpp"
#include "robustness/price.hpp"

namespace {

using namespace hinge::bench;

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

void put_between_markers(const std::string& file, const std::string& text) {
  const std::string begin = "<!-- begin measured -->\n", end = "<!-- end measured -->";
  std::ifstream in(file);
  std::string page{std::istreambuf_iterator<char>(in), {}};
  const auto from = page.find(begin), to = page.find(end);
  if (from == std::string::npos || to == std::string::npos)
    throw std::runtime_error(file + ": cannot be read, or does not have the markers " + begin + " ... " + end);
  std::ofstream out(file);
  out << page.replace(from + begin.size(), to - from - begin.size(), text);
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

int run(std::size_t cases, const std::string& file, const std::string& json) {
  const std::string compiler = __VERSION__, number_of = std::to_string(cases);
  std::fprintf(stderr, "%zu pairs of each family\n", cases);
  Rows rows = run_families(cases);
  for (const Rows& more : {run_balls(cases), price_of_molecules(), price_of_robots()})
    rows.insert(rows.end(), more.begin(), more.end());
  const std::string head =
      "Machine: " + processor() + ", " + std::to_string(std::thread::hardware_concurrency()) +
      " shared cores, compiler " + compiler + " `" HINGE_BENCH_FLAGS "`; FCL compiled for plain x86-64. Seed " +
      std::to_string(robustness_seed) + " for families, " + std::to_string(seed) + " for molecules and robots; " +
      number_of + " pairs of each family. Command:\n\n    ./run bench robustness -- " + number_of +
      " --page docs/explanation/robustness.md\n";
  const std::string text = RobustnessPage(rows).text(head);
  std::printf("%s", text.c_str());
  if (!file.empty()) put_between_markers(file, text);
  if (!json.empty()) {
    std::ofstream out(json);
    out << Json{{"program", "robustness"},
                {"machine",
                 {{"processor", processor()}, {"compiler", compiler}, {"flags", HINGE_BENCH_FLAGS}, {"seed", seed}}},
                {"rows", rows}}
               .dump(1)
        << '\n';
    if (!out.flush()) throw std::runtime_error(json + ": cannot be written");
  }
  int wrong = 0;
  for (const Json& row : rows) {
    if (row.at("kind") == "balls") wrong += row.at("point").get<int>() + row.at("sphere").get<int>();
    if (row.at("kind") != "family" || (row.at("who") != "hinge" && row.at("who") != "hierarchy")) continue;
    for (const char* key : {"wrong_yes", "wrong_no", "zero_apart", "positive_touching", "contradictions"})
      wrong += row.at(key).get<int>();
    wrong += row.at("threshold_wrong").get<int>();
  }
  if (wrong > 0) std::fprintf(stderr, "%d answers of Hinge are wrong\n", wrong);
  return wrong == 0 ? 0 : 1;
}

}  // namespace

/// Returns 1 if an answer of Hinge is wrong or a file cannot be written.
int main(int argc, char** argv) {
  std::size_t cases = 20'000;
  std::string file, json;
  for (int k = 1; k < argc; ++k) {
    const std::string_view word = argv[k];
    char* end = nullptr;
    if (word == "--page" && k + 1 < argc) {
      file = argv[++k];
    } else if (word == "--json" && k + 1 < argc) {
      json = argv[++k];
    } else if (cases = std::strtoul(argv[k], &end, 10); end == argv[k] || *end != '\0' || cases == 0) {
      std::fprintf(stderr, "usage: %s [PAIRS of each family, default 20000] [--page FILE] [--json FILE]\n", argv[0]);
      return 2;
    }
  }
  try {
    return run(cases, file, json);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_robustness: %s\n", error.what());
    return 1;
  }
}
