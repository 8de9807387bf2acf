// SPDX-License-Identifier: BSD-3-Clause
// Relaxation: side chains of known structures are turned by 60 to 120 degrees until they clash, and relaxed (biocd
// relax), with all side chains free and with all torsions free. Says how many become free, how far atoms move and how
// long it takes; then the time of an energy with its gradient beside that of a list of colliding pairs. One thread.
// Argument: number of conformations per row.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/kept_closures.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/relax.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge_tools/clock.hpp"
#include "molecular/side_chains.hpp"

namespace {

using namespace hinge::molecular;
using hinge::tool::Clock;
using hinge::tool::seconds_since;

std::vector<hinge::Vec3> positions_at(Checker& checker, const std::vector<double>& q) {
  checker.check(q, Mode{});
  return checker.positions();
}

/// Root of the mean squared displacement, angstrom.
struct Displacement {
  double moved = 0.0;  ///< of the atoms that moved by more than 0.0005
  double free = 0.0;   ///< of all atoms that the free torsions can move
};

Displacement displacement(const Checker& checker, const std::vector<hinge::Vec3>& from,
                          const std::vector<hinge::Vec3>& to) {
  double sum = 0.0, moved = 0.0, free = 0.0;
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    const double square = hinge::squared_norm(hinge::Vec3(to[i] - from[i]));
    sum += square;
    if (square > 2.5e-7) moved += 1.0;
    if (checker.group_of(i) != hinge::GroupId{0}) free += 1.0;
  }
  return {std::sqrt(sum / std::max(moved, 1.0)), std::sqrt(sum / std::max(free, 1.0))};
}

/// Returns the median of the values and how many are less than 0.5 angstrom.
std::pair<double, std::size_t> spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto little = std::ranges::count_if(values, [](double v) { return v < 0.5; });
  return {values[values.size() / 2], static_cast<std::size_t>(little)};
}

/// Returns nanoseconds per call of ask(q), the least of five rounds.
template <class Ask>
double nanoseconds(const std::vector<std::vector<double>>& configurations, const Ask& ask) {
  double least = HUGE_VAL;
  for (int round = 0; round < 5; ++round) {
    const Clock::time_point start = Clock::now();
    for (const std::vector<double>& q : configurations) ask(q);
    least = std::min(least, seconds_since(start) * 1e9 / static_cast<double>(configurations.size()));
  }
  return least;
}

/// Shares of conformations, in percent: mended with a displacement below 0.5 angstrom.
struct Shares {
  double moved = 0.0, free = 0.0;  ///< as in Displacement
};

Shares run(const std::filesystem::path& file, const std::string& name, const std::string& free_torsions,
           std::size_t turned, std::size_t count) {
  const auto molecule = std::make_shared<const Molecule>(read_structure(file));
  const KeptClosures kept =
      find_kept_closures(*molecule, select_torsions(*molecule, free_torsions, false), Closures::all);
  Checker checker(molecule, molecule->select(kept.torsions), {});
  const std::vector<std::size_t> chis = hinge::test::side_chains(checker);
  const std::vector<double> reference(checker.dof_count(), 0.0);
  const std::size_t goal = checker.check(reference, Mode{Mode::Kind::all}).pairs.size();
  RelaxOptions how;
  how.closures = kept.closures;
  std::size_t made = 0, restarted = 0;
  double before = 0.0, total = 0.0, longest = 0.0;
  std::vector<double> of_moved, of_free;
  std::vector<std::vector<double>> starts;
  for (std::uint64_t k = 0; made < count; ++k) {
    hinge::SampleStream stream(1, k);
    std::vector<double> q = reference;
    for (std::size_t t = 0; t < turned; ++t) {
      const std::size_t at = chis[static_cast<std::size_t>(stream.uniform() * static_cast<double>(chis.size()))];
      q[at] += (stream.uniform() < 0.5 ? -1.0 : 1.0) * (60.0 + 60.0 * stream.uniform()) * std::numbers::pi / 180.0;
    }
    const std::size_t collisions = checker.check(q, Mode{Mode::Kind::all}).pairs.size();
    if (collisions <= goal) continue;
    ++made;
    before += static_cast<double>(collisions);
    const Clock::time_point start = Clock::now();
    const Relaxation relaxed = relax(checker, q, how);
    const double seconds = seconds_since(start);
    total += seconds;
    longest = std::max(longest, seconds);
    restarted += relaxed.restarts > 0 ? 1U : 0U;
    starts.push_back(q);
    if (relaxed.collisions > goal) continue;
    const Displacement d = displacement(checker, positions_at(checker, q), positions_at(checker, relaxed.q));
    of_moved.push_back(d.moved);
    of_free.push_back(d.free);
  }
  const auto [moved, little_moved] = spread(of_moved);
  const auto [free, little_free] = spread(of_free);
  const double pairs = nanoseconds(starts, [&](const auto& q) { checker.check(q, Mode{Mode::Kind::all}); });
  const double steric = nanoseconds(starts, [&](const auto& q) { checker.steric(q, 0.02); });
  const auto share = [&](std::size_t part) { return 100.0 * static_cast<double>(part) / static_cast<double>(count); };
  std::printf("%-5s %-5s %5zu %5zu %7zu %8.1f %9.1f %9.1f %8.2f %9.1f %8.2f %9.1f %9.1f %8.1f %9.1f %9.1f\n",
              free_torsions.c_str(), name.c_str(), molecule->structure().atoms.size(), checker.dof_count(), turned,
              before / static_cast<double>(count), share(of_moved.size()), share(restarted), moved, share(little_moved),
              free, share(little_free), 1e3 * total / static_cast<double>(count), 1e3 * longest, pairs * 1e-3,
              steric * 1e-3);
  std::fflush(stdout);
  return {share(little_moved), share(little_free)};
}

}  // namespace

int main(int argc, char** argv) {
  const auto count = static_cast<std::size_t>(argc > 1 ? std::atoi(argv[1]) : 200);
  const std::filesystem::path root = HINGE_SOURCE_DIR, data = root / "tests/molecular/data";
  const std::vector<std::pair<std::string, std::filesystem::path>> structures = {
      {"1UBQ", root / "molecular/data/1ubq.pdb"},
      {"1CRN", data / "1crn.pdb.gz"},
      {"1L2Y", data / "1l2y.pdb.gz"},
      {"5PTI", data / "5pti.pdb.gz"},
      {"2SRC", data / "2src.pdb.gz"},
      {"4HHB", data / "4hhb.pdb.gz"}};
  std::printf("flags: %s; seed 1; %zu conformations per row\n", HINGE_BENCH_FLAGS, count);
  std::printf("%-5s %-5s %5s %5s %7s %8s %9s %9s %8s %9s %8s %9s %9s %8s %9s %9s\n", "free", "", "atoms", "DOF",
              "turned", "clashes", "mended %", "restart %", "moved A", "<0.5 A %", "free A", "<0.5 A %", "mean ms",
              "max ms", "pairs us", "steric us");
  for (const std::string free_torsions : {"chi", "all"})
    for (const std::size_t turned : {1U, 5U}) {
      Shares mean;
      for (const auto& [name, file] : structures) {
        const Shares shares = run(file, name, free_torsions, turned, count);
        mean.moved += shares.moved / static_cast<double>(structures.size());
        mean.free += shares.free / static_cast<double>(structures.size());
      }
      std::printf("%-5s %-5s %11s %7zu %46.1f %18.1f\n", free_torsions.c_str(), "mean", "", turned, mean.moved,
                  mean.free);
    }
  return 0;
}
