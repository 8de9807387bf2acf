// SPDX-License-Identifier: BSD-3-Clause
// robustness_cases DIR: runs every case of the .jsonl files in DIR on every engine, prints one line of JSON each, and
// checks the answers that the file contains.
#include <array>
#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "robustness/case.hpp"
#include "robustness/judge.hpp"
#include "robustness/read_cases.hpp"
#include "robustness/run.hpp"

namespace {

using namespace hinge::robustness;
using Json = nlohmann::ordered_json;

// Exit statuses.
constexpr int passed = 0, failed = 1, usage = 2, bad_input = 3;

std::string hexadecimal(double x) {
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), "%a", x);
  return digits.data();
}

Json line_of(const Case& one, const char* engine, const Answer& answer) {
  Json line{{"id", one.id}, {"engine", engine}, {"refused", answer.refused}};
  if (answer.refused) {
    for (const char* key : {"hit", "pair_count", "distance"}) line[key] = nullptr;
    line["message"] = answer.message;
    return line;
  }
  line["hit"] = answer.hit;
  line["pair_count"] = answer.pair_count;
  line["distance"] = hexadecimal(answer.distance);
  if (one.kind == "chain") {
    line["pairs"] = Json::array();
    for (const LinkPairAnswer& pair : answer.link_pairs)
      line["pairs"].push_back(
          {{"i", pair.i}, {"j", pair.j}, {"hit", pair.hit}, {"distance", hexadecimal(pair.distance)}});
    if (answer.closest) line["closest"] = *answer.closest;
    if (answer.tip)
      line["tip"] = {hexadecimal((*answer.tip)[0]), hexadecimal((*answer.tip)[1]), hexadecimal((*answer.tip)[2])};
  }
  if (!answer.contradiction.empty()) line["contradiction"] = answer.contradiction;
  return line;
}

int run_all(const std::vector<Case>& cases) {
  std::size_t right = 0, wrong = 0;
  for (const Case& one : cases)
    for (const auto& [engine, name] : engine_names) {
      const std::vector<Answer> answers = run(one, engine);
      std::printf("%s\n", line_of(one, name, answers[0]).dump().c_str());
      if (!one.truth) continue;
      const auto found = faults(one, answers);
      ++(found.empty() ? right : wrong);
      for (const std::string& fault : found)
        std::fprintf(stderr, "robustness_cases: %s, %s, %s\n", one.id.c_str(), name, fault.c_str());
    }
  if (right + wrong > 0) std::printf("passed %zu, failed %zu\n", right, wrong);
  return wrong == 0 ? passed : failed;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr,
                 "usage: robustness_cases DIR   (a folder of .jsonl files; exit status 1: an answer is wrong)\n");
    return usage;
  }
  try {
    const int status = run_all(read_cases(arguments[1]));
    // A full disk is reported only when flushing.
    if (std::fflush(stdout) != 0) throw hinge::LoadError("standard output: cannot be written");
    return status;
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "robustness_cases: %s\n", error.what());
    return bad_input;
  }
}
