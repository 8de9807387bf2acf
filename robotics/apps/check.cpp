// SPDX-License-Identifier: BSD-3-Clause
// robocd check: checks configurations in parallel and reports them in index order.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "configurations.hpp"
#include "hinge/batch/ensemble.hpp"
#include "hinge/core/error.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/json_text.hpp"
#include "hinge_tools/parts.hpp"
#include "hinge_tools/progress_bar.hpp"
#include "report.hpp"
#include "robot_page.hpp"
#include "summary.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::Rows;

namespace {

Json head_json(const Options& options, const Job& job, const Mode& mode) {
  Json head{{"tool", "robocd"}, {"command", "check"}, {"robot", robot_json(options, job)}, {"mode", mode.text()}};
  head["clearance"] = options.clearance;
  head["seed"] = options.count > 0 ? Json(options.seed) : Json();
  add_surroundings(head, job);
  head["joints"] = joint_names(*job.robot);
  return head;
}

/// Returns what the folder of --parts answers. model: the head of JSON output.
hinge::tool::Question question_of(const Options& options, const Job& job, const hinge::tool::RowsHead& head,
                                  const Json& model) {
  auto inputs = hinge::tool::input_digests(input_files(options));
  inputs.insert(inputs.begin(), {"robot with meshes", model_digest(options, job.robot->description())});
  return hinge::tool::make_question("robocd", "check", options.parts, head, model, inputs);
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
  for (const auto& [pair, count] : summary.top()) fmt::print("  {:<28} {:<28} {:14}\n", pair.first, pair.second, count);
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
  const bool is_json = options.output == Output::json;
  const Json head = head_json(options, job, mode);
  hinge::tool::RowsHead rows_head{options.output, "", "configurations", configurations.count};
  if (is_json) rows_head.text = hinge::tool::json_text(head, 1);
  if (options.output == Output::csv) rows_head.text = csv_header();
  if (!options.parts.wanted()) hinge::tool::print(opening(rows_head));
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  bool headed = true;          // the next list of pairs starts with the names of its columns
  std::uint64_t left_out = 0;  // pairs that are not printed
  const Columns columns{mode, !options.environment.empty(), options.contained, options.max_pairs};
  RobotPage page(options, job, worker, mode, false);
  hinge::Ensemble ensemble(worker, options.threads);
  const auto start = hinge::tool::Clock::now();
  const auto judge = [&](Worker& own, std::size_t k) {
    return ask(own, configurations.at(k), mode, options.contained);
  };
  const auto report = [&](std::size_t k, const Answer& answer, Rows& rows, Summary& summary) {
    summary.add(answer.collides, named_pairs(worker, answer));
    page.offer(k, answer);
    if (is_json) rows.add_json(hinge::tool::json_text(answer_json(worker, k, configurations.at(k), answer, columns)));
    if (options.output == Output::csv) rows.add_csv(csv_rows(worker, k, answer, options.max_pairs, left_out));
    if (options.output == Output::npy) rows.add_verdict(answer.collides ? 1 : 0);
    if (options.output == Output::table && !sampled) {
      const std::string table = pair_table(worker, answer, options.max_pairs);
      fmt::print("configuration {}: {}{}\n{}{}", k, answer.collides ? "collides" : "free", incomplete(*job.robot),
                 headed && !table.empty() ? pair_heading(mode) : "", table);
      headed = headed && table.empty();
    }
    if (file.wanted()) write_row(file.stream(), configurations.at(k));
    file.check();
  };
  // check_batch() answers yes or no only, for the robot without bodies.
  const bool in_blocks = mode.kind == Mode::Kind::any && !worker.environment && !options.contained;
  const auto judge_block = [&](Worker& own, std::size_t first, std::size_t end) {
    std::vector<double> block;
    for (std::size_t k = first; k < end; ++k) {
      const std::vector<double> q = configurations.at(k);
      block.insert(block.end(), q.begin(), q.end());
    }
    try {
      return own.checker.check_batch(block);
    } catch (const hinge::ConfigurationError&) {  // it names the configuration by its place in the block: ask again
      for (std::size_t k = first; k < end; ++k) judge(own, k);
      throw;
    }
  };
  const auto run = [&](std::uint64_t from, std::uint64_t to, Rows& rows, Summary& summary) {
    const auto first = static_cast<std::size_t>(from), count = static_cast<std::size_t>(to - from);
    std::optional<hinge::tool::ProgressBar> bar;
    if (!options.parts.wanted()) bar.emplace(count);
    const auto take = [&](std::size_t n, const Answer& answer) {
      report(first + n, answer, rows, summary);
      if (bar) bar->show(n + 1);
    };
    if (!in_blocks || job.robot->independent_joints().empty())
      return ensemble.run(
          count, [&](Worker& own, std::size_t n) { return judge(own, first + n); }, take);
    ensemble.run((count + block_size - 1) / block_size,
                 [&](Worker& own, std::size_t b) {
                   return judge_block(own, first + b * block_size, first + std::min((b + 1) * block_size, count));
                 },
                 [&](std::size_t b, const std::vector<std::uint8_t>& verdicts) {
                   Answer answer;
                   for (std::size_t k = 0; k < verdicts.size(); ++k) {
                     answer.collides = answer.self.collides = verdicts[k] != 0;
                     take(b * block_size + k, answer);
                   }
                 },
                 16);
  };
  if (options.parts.wanted()) {
    run_units(options.parts, question_of(options, job, rows_head, head),
              [&](std::uint64_t from, std::uint64_t to, Rows& rows) {
                Summary unit;
                run(from, to, rows, unit);
                return hinge::tool::UnitCounts{unit.checked, unit.colliding, 0,
                                               is_json ? hinge::tool::json_text(unit.json()) : "{}"};
              });
    print_incomplete(*job.robot);
    return Exit::free;
  }
  Summary summary;
  Rows rows = hinge::tool::printed_rows();
  const auto end = [&](const std::string& error) {
    if (is_json) hinge::tool::print(closing(options.output, hinge::tool::json_text(summary.json(error))));
  };
  try {
    run(0, configurations.count, rows, summary);
    file.finish();
  } catch (const std::exception& error) {  // such as a full disk
    end(error.what());
    throw;
  }
  const double checking = hinge::tool::seconds_since(start);
  end("");
  if (left_out > 0)
    fmt::print(stderr, "note: --max-pairs {}: {} without a row\n", options.max_pairs.value_or(0),
               hinge::tool::counted(left_out, "pair"));
  if (options.output == Output::table) print_table_end(summary, *job.robot, sampled, checking);
  for (const std::uint64_t k : page.chosen())
    page.add(fmt::format("configuration {}", k), configurations.at(static_cast<std::size_t>(k)));
  page.write(summary.colliding > 0 ? "collides" : "free",
             hinge::tool::collide_text(summary.colliding, summary.checked, "configuration"));
  print_incomplete(*job.robot);
  return summary.colliding > 0 ? Exit::collision : Exit::free;
}

}  // namespace robocd
