// SPDX-License-Identifier: BSD-3-Clause
// robocd matrix: writes the pairs of links that need no test, with reasons, as an SRDF file.
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "answer.hpp"
#include "configurations.hpp"
#include "hinge/robotics/write_srdf.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/progress_bar.hpp"
#include "options.hpp"
#include "robot_page.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::noun_of;

namespace {

const char* name(PairKind kind) {
  switch (kind) {
    case PairKind::adjacent: return "adjacent";
    case PairKind::always: return "always in collision";
    case PairKind::in_default: return "in collision in the default configuration";
    case PairKind::sometimes: return "sometimes in collision";
    case PairKind::never: return "never in collision, proved";
    case PairKind::unseen: break;
  }
  return "not seen in collision, not proved";
}

CollisionMatrix find(const Robot& robot, const MatrixOptions& options) {
  constexpr std::uint64_t steps = 1000;  // of the progress bar
  std::optional<hinge::tool::ProgressBar> bar;
  std::optional<MatrixProgress::Stage> stage;
  return find_collision_matrix(robot, options, [&](const MatrixProgress& progress) {
    if (stage != progress.stage) bar.emplace(steps);
    stage = progress.stage;
    bar->show(static_cast<std::uint64_t>(progress.fraction * static_cast<double>(steps)));
  });
}

/// Writes the page of --report: the matrix, and the robot in the default configuration.
void write_page(RobotPage& page, const Robot& robot, const CollisionMatrix& matrix, const std::string& verdict) {
  page.add_next("default configuration", default_configuration(robot));
  std::vector<std::string> words;
  for (const PairKind kind : {PairKind::adjacent, PairKind::always, PairKind::in_default, PairKind::sometimes,
                              PairKind::never, PairKind::unseen})
    words.emplace_back(name(kind));
  page.set_matrix(matrix, words);
  page.write("", verdict);
}

}  // namespace

Exit run_matrix(const Options& options) {
  Job job = load(options);
  const auto& robot = job.robot;
  print_notes(job);
  check_limits(options, *robot);
  hinge::tool::CompleteFile file(options.out);
  std::optional<Worker> worker;
  std::optional<RobotPage> page;
  if (!options.report.empty()) {
    worker.emplace(make_worker(options, job));
    page.emplace(options, job, *worker, Mode{Mode::Kind::all}, false);
  }
  MatrixOptions wanted = options.matrix;
  wanted.clearance = options.clearance;
  wanted.settled = job.disabled;
  const CollisionMatrix matrix = find(*robot, wanted);
  const UnseenPairs unseen = options.disable_unseen ? UnseenPairs::disabled : UnseenPairs::tested;

  std::ostringstream srdf;
  if (options.srdf.empty())
    write_srdf(*robot, matrix, srdf, unseen);
  else
    merge_srdf(options.srdf, job.srdf, *robot, matrix, srdf, unseen);
  if (file.wanted()) {
    file.stream() << srdf.str();
    file.finish();
  } else {
    fmt::print("{}", srdf.str());
  }

  std::map<PairKind, std::size_t> counts;
  std::size_t disabled = 0, kept = 0, met = 0;
  for (const MatrixEntry& entry : matrix.entries) {
    const bool by_file = job.disabled.contains(entry.link1, entry.link2);
    kept += by_file ? 1U : 0U;
    met += by_file && entry.kind == PairKind::sometimes ? 1U : 0U;
    if (by_file) continue;
    ++counts[entry.kind];
    disabled += is_disabled(entry.kind, unseen) && !job.srdf.enabled.contains(entry.link1, entry.link2) ? 1U : 0U;
  }
  if (!options.srdf.empty())
    std::fprintf(stderr, "%6zu %s disabled by %s\n", kept, noun_of(kept, "pair").c_str(), options.srdf.c_str());
  for (const auto& [kind, count] : counts)
    std::fprintf(stderr, "%6zu %s %s\n", count, noun_of(count, "pair").c_str(), name(kind));
  const std::string result =
      fmt::format("{} of {} disabled", kept + disabled, hinge::tool::counted(matrix.entries.size(), "pair"));
  std::fprintf(stderr, "%s\n", result.c_str());
  if (met > 0)
    std::fprintf(stderr,
                 "note: pairs that %s disables, but that collide in some configurations: %zu; comments in the output "
                 "name them\n",
                 options.srdf.c_str(), met);
  if (page) write_page(*page, *robot, matrix, result);
  print_incomplete(*robot);
  return Exit::free;
}

}  // namespace robocd
