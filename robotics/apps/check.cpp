// SPDX-License-Identifier: BSD-3-Clause
// robocd check: checks configurations in parallel and reports them in index order.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "configurations.hpp"
#include "hinge/batch/ensemble.hpp"
#include "hinge/core/error.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/json_text.hpp"
#include "hinge_tools/progress_bar.hpp"
#include "report.hpp"
#include "robot_page.hpp"

namespace robocd {

using namespace hinge::robotics;

namespace {

using NamedPair = std::pair<std::string, std::string>;

struct Summary {
  std::size_t checked = 0;
  std::size_t colliding = 0;
  std::map<NamedPair, std::size_t> pairs;

  /// Returns the n most frequent pairs, most frequent first.
  std::vector<std::pair<NamedPair, std::size_t>> top(std::size_t n) const {
    std::vector<std::pair<NamedPair, std::size_t>> all(pairs.begin(), pairs.end());
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    all.resize(std::min(n, all.size()));
    return all;
  }
};

constexpr std::size_t shown_pairs = 10;  // of a summary; longer lists are not read

void print_json_start(const Options& options, const Job& job, const Mode& mode) {
  Json head{{"tool", "robocd"}, {"command", "check"}, {"robot", robot_json(options, job)}, {"mode", mode.text()}};
  head["clearance"] = options.clearance;
  head["seed"] = options.count > 0 ? Json(options.seed) : Json();
  head["environment"] = body_names(job);
  head["allowed"] = allowed_json(job);
  head["notes"] = job.notes;
  head["joints"] = joint_names(*job.robot);
  std::string text = hinge::tool::json_text(head, 1);
  text.resize(text.rfind('\n'));  // the closing brace follows the summary
  fmt::print("{},\n\"configurations\": [", text);
}

/// error: message of the error that ended the run early; empty: none.
void print_json_end(const Summary& summary, const std::string& error = {}) {
  Json pairs = Json::array();
  for (const auto& [pair, count] : summary.top(shown_pairs))
    pairs.push_back({{"first", pair.first}, {"second", pair.second}, {"count", count}});
  Json end{{"checked", summary.checked}, {"colliding", summary.colliding}, {"most_frequent", pairs}};
  if (!error.empty()) end["error"] = error;
  fmt::print("\n],\n\"summary\": {}}}\n", hinge::tool::json_text(end));
}

void print_table_end(const Summary& summary, const Robot& robot, bool sampled, double seconds) {
  fmt::print("{}", hinge::tool::collide_text(summary.colliding, summary.checked, "configuration"));
  if (sampled)
    fmt::print(" ({:.2f} %), {:.0f} per second",
               100.0 * static_cast<double>(summary.colliding) / static_cast<double>(summary.checked),
               static_cast<double>(summary.checked) / seconds);
  fmt::print("{}\n", incomplete(robot));
  if (!sampled || summary.pairs.empty()) return;
  fmt::print("  {:<28} {:<28} configurations\n", "link", "link or body");
  for (const auto& [pair, count] : summary.top(shown_pairs))
    fmt::print("  {:<28} {:<28} {:14}\n", pair.first, pair.second, count);
}

}  // namespace

Exit run_check(const Options& options) {
  const Mode mode = Mode::parse(options.mode, "metres");
  Job job = load(options);
  const Configurations configurations = find_configurations(options, job);
  Worker worker = make_worker(options, job);
  const bool sampled = options.count > 0;
  if (!sampled)
    for (const std::string& note : notes_on_limits(configurations, options, *job.robot)) job.notes.push_back(note);
  for (const std::string& note : configurations.notes) job.notes.push_back(note);
  for (const std::string& note : notes_on_bodies(options, worker)) job.notes.push_back(note);
  print_notes(job);

  hinge::tool::CompleteFile file(options.out);
  if (file.wanted()) write_header(file.stream(), *job.robot);
  if (options.output == Output::json) print_json_start(options, job, mode);
  if (options.output == Output::csv) fmt::print("{}", csv_header());
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  Summary summary;
  bool headed = true;          // the next list of pairs starts with the names of its columns
  std::uint64_t left_out = 0;  // pairs that are not printed
  const Columns columns{mode, !options.environment.empty(), options.contained, options.max_pairs};
  RobotPage page(options, job, worker, mode, false);
  hinge::tool::ProgressBar bar(configurations.count);
  const auto start = std::chrono::steady_clock::now();
  const auto judge = [&](Worker& own, std::size_t k) {
    return ask(own, configurations.at(k), mode, options.contained);
  };
  const auto report = [&](std::size_t k, const Answer& answer) {
    ++summary.checked;
    summary.colliding += answer.collides ? 1 : 0;
    for (NamedPair& pair : named_pairs(worker, answer)) ++summary.pairs[std::move(pair)];
    page.offer(k, answer);
    if (options.output == Output::json)
      fmt::print("{}\n{}", k == 0 ? "" : ",",
                 hinge::tool::json_text(answer_json(worker, k, configurations.at(k), answer, columns)));
    if (options.output == Output::csv) fmt::print("{}", csv_rows(worker, k, answer, options.max_pairs, left_out));
    if (options.output == Output::table && !sampled) {
      const std::string table = pair_table(worker, answer, options.max_pairs);
      fmt::print("configuration {}: {}{}\n{}{}", k, answer.collides ? "collides" : "free", incomplete(*job.robot),
                 headed && !table.empty() ? pair_heading(mode) : "", table);
      headed = headed && table.empty();
    }
    if (file.wanted()) write_row(file.stream(), configurations.at(k));
    file.check();
    bar.show(k + 1);
  };
  // check_batch() answers yes or no only, for the robot without bodies.
  const bool in_blocks = mode.kind == Mode::Kind::any && !worker.environment && !options.contained;
  const auto judge_block = [&](Worker& own, std::size_t b) {
    std::vector<double> block;
    for (std::size_t k = b * block_size; k < std::min((b + 1) * block_size, configurations.count); ++k) {
      const std::vector<double> q = configurations.at(k);
      block.insert(block.end(), q.begin(), q.end());
    }
    try {
      return own.checker.check_batch(block);
    } catch (const hinge::ConfigurationError&) {  // it names the configuration by its place in the block: ask again
      for (std::size_t k = b * block_size; k < std::min((b + 1) * block_size, configurations.count); ++k) judge(own, k);
      throw;
    }
  };
  const auto report_block = [&](std::size_t b, const std::vector<std::uint8_t>& verdicts) {
    Answer answer;
    for (std::size_t k = 0; k < verdicts.size(); ++k) {
      answer.collides = answer.self.collides = verdicts[k] != 0;
      report(b * block_size + k, answer);
    }
  };
  try {
    hinge::Ensemble ensemble(worker, options.threads);
    if (in_blocks && !job.robot->independent_joints().empty())
      ensemble.run((configurations.count + block_size - 1) / block_size, judge_block, report_block, 16);
    else
      ensemble.run(configurations.count, judge, report);
    file.finish();
  } catch (const std::exception& error) {  // such as a full disk
    if (options.output == Output::json) print_json_end(summary, error.what());
    throw;
  }
  const std::chrono::duration<double> checking = std::chrono::steady_clock::now() - start;
  if (options.output == Output::json) print_json_end(summary);
  if (left_out > 0)
    fmt::print(stderr, "note: --max-pairs {}: {} without a row\n", options.max_pairs.value_or(0),
               hinge::tool::counted(left_out, "pair"));
  if (options.output == Output::table) print_table_end(summary, *job.robot, sampled, checking.count());
  for (const std::uint64_t k : page.chosen())
    page.add(fmt::format("configuration {}", k), configurations.at(static_cast<std::size_t>(k)));
  page.write(summary.colliding > 0 ? "collides" : "free",
             hinge::tool::collide_text(summary.colliding, summary.checked, "configuration"));
  print_incomplete(*job.robot);
  return summary.colliding > 0 ? Exit::collision : Exit::free;
}

}  // namespace robocd
