// SPDX-License-Identifier: BSD-3-Clause
// robocd matrix: which pairs of links need no test, as an SRDF file that says why.
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "hinge/robotics/write_srdf.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/progress_bar.hpp"
#include "options.hpp"

namespace robocd {

using namespace hinge::robotics;

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
  constexpr std::uint64_t steps = 1000;  // of the bar
  std::optional<hinge::tool::ProgressBar> bar;
  std::optional<MatrixProgress::Stage> stage;
  return find_collision_matrix(robot, options, [&](const MatrixProgress& progress) {
    if (stage != progress.stage) bar.emplace(steps);
    stage = progress.stage;
    bar->show(static_cast<std::uint64_t>(progress.fraction * static_cast<double>(steps)));
  });
}

}  // namespace

Exit run_matrix(const Options& options) {
  std::vector<std::string> notes;
  const auto robot = load_robot(options, notes);
  for (const std::string& note : notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  hinge::tool::CompleteFile file(options.out);
  MatrixOptions wanted = options.matrix;
  wanted.clearance = options.clearance;
  const CollisionMatrix matrix = find(*robot, wanted);
  const UnseenPairs unseen = options.disable_unseen ? UnseenPairs::disabled : UnseenPairs::tested;

  std::ostringstream srdf;
  write_srdf(*robot, matrix, srdf, unseen);
  if (file.wanted()) {
    file.stream() << srdf.str();
    file.finish();
  } else {
    fmt::print("{}", srdf.str());
  }

  std::map<PairKind, std::size_t> counts;
  std::size_t disabled = 0;
  for (const MatrixEntry& entry : matrix.entries) {
    ++counts[entry.kind];
    disabled += is_disabled(entry.kind, unseen) ? 1U : 0U;
  }
  for (const auto& [kind, count] : counts) std::fprintf(stderr, "%6zu pairs %s\n", count, name(kind));
  std::fprintf(stderr, "%zu of %zu pairs disabled\n", disabled, matrix.entries.size());
  print_incomplete(*robot);
  return Exit::free;
}

}  // namespace robocd
