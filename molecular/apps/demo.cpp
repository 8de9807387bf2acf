// SPDX-License-Identifier: BSD-3-Clause
// biocd demo: samples, times, verifies and plots conformations of one protein.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hinge/batch/ensemble.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/counted.hpp"
#include "options.hpp"
#include "plot_svg.hpp"
#include "tail_picture.hpp"
#include "view.hpp"

namespace biocd {

namespace {

using namespace hinge::molecular;
using hinge::tool::CompleteFile;

constexpr std::uint64_t verified = 100;  // conformations per selection that brute force verifies

struct NamedSampling {
  const char* name;
  const char* title;
  Sampling sampling;
};

/// The conformation with the most clashes, its clashes, and its coordinates in angstrom.
struct Worst {
  std::vector<hinge::Hit> pairs;
  std::vector<hinge::Vec3> positions;
};

/// Compares both engines on the first `count` conformations in all modes. Returns the number of different answers.
int differences(Checker& simd, Checker& brute, const Sampling& sampling, std::uint64_t count) {
  int different = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto q = sample_configuration(sampling, k, simd.dof_count());
    for (const char* text : {"any", "all", "within:1", "closest"}) {
      const Mode mode = Mode::parse(text);
      const Verdict a = simd.check(q, mode), b = brute.check(q, mode);
      if (a.collides != b.collides || a.pairs != b.pairs || a.closest != b.closest) ++different;
    }
  }
  return different;
}

/// Writes the structure and both scripts. Returns the name of the structure.
std::string write_worst(const Structure& s, const Worst& worst, const std::filesystem::path& folder) {
  std::string file = write_shown_structure(s, worst.positions, folder / "worst");
  for (const Viewer viewer : {Viewer::chimerax, Viewer::pymol})
    write_viewer_script(viewer, s, worst.pairs, folder / "worst", {file});
  return file;
}

}  // namespace

Exit run_demo(const Options& options) {
  const auto molecule = std::make_shared<const Molecule>(read_structure(options.file, options.read));
  const Structure& s = molecule->structure();
  const std::filesystem::path folder(options.out);
  std::filesystem::create_directories(folder);
  CompleteFile plot((folder / "speed.svg").string());
  const auto residues = static_cast<std::size_t>(std::count_if(
      s.residues.begin(), s.residues.end(), [](const Residue& r) { return r.kind == ResidueKind::amino_acid; }));
  std::set<std::size_t> counts;
  for (const std::size_t k : {std::size_t{1}, std::size_t{5}, std::size_t{10}, std::size_t{35}, residues})
    counts.insert(std::min(k, residues));
  const NamedSampling samplings[] = {
      {"full", "torsions over the full range", {options.seed, {}}},
      {"0.5 deg", "torsions 0.5 degrees (sigma) about native", {options.seed, std::numbers::pi / 360}}};
  const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  CheckOptions rules = options.check;
  rules.exempt_reference = true;
  rules.thresholds.rho = 0.8;

  fmt::print(
      "{}: {} atoms, {} residues; {} conformations per row, seed {}, {} threads, d < {} * (bondi radii), pairs\n"
      "that collide in the file itself do not count\n\n{:>8} {:>5} {:<8}",
      s.name, s.atoms.size(), residues, options.count, options.seed, threads, *rules.thresholds.rho, "residues", "dof",
      "sampling");
  const char* modes[] = {"any", "all", "within:1", "closest"};
  for (const char* mode : modes) fmt::print(" {:>12}/s", mode);
  fmt::print("  colliding\n");

  std::vector<Plot> plots;
  for (const NamedSampling& n : samplings) {
    plots.push_back({n.title, "free residues", "conformations per second", {}, {}});
    for (const char* mode : modes) plots.back().curves.push_back({mode, {}});
  }
  Worst worst;
  int different = 0;
  for (const std::size_t count : counts) {
    const std::string spec = fmt::format("count:{}", count);
    const auto selection = molecule->select(select_torsions(*molecule, spec, options.omega));
    Checker simd(molecule, selection, rules);
    rules.engine = "brute";
    Checker brute(molecule, selection, rules);
    rules.engine = "simd";
    for (std::size_t n = 0; n < plots.size(); ++n) {
      plots[n].labels.push_back(std::to_string(count));
      fmt::print("{:>8} {:>5} {:<8}", count, simd.dof_count(), samplings[n].name);
      std::uint64_t colliding = 0;
      for (std::size_t m = 0; m < plots[n].curves.size(); ++m) {
        hinge::Ensemble workers(simd, threads);
        const auto start = hinge::tool::Clock::now();
        const Mode mode = Mode::parse(modes[m]);
        const Sampling& sampling = samplings[n].sampling;
        colliding = 0;
        std::optional<std::size_t> most_clashes_at;
        workers.run(
            static_cast<std::size_t>(options.count),
            [&](Checker& checker, std::size_t k) {
              return checker.check(sample_configuration(sampling, k, checker.dof_count()), mode);
            },
            [&](std::size_t k, const Verdict& verdict) {
              colliding += verdict.collides ? 1 : 0;
              // Only conformations near the native one: their picture is readable.
              if (m != 1 || n != 1 || verdict.pairs.size() <= worst.pairs.size()) return;
              most_clashes_at = k;
              worst.pairs.clear();
              for (const Contact& pair : verdict.pairs) worst.pairs.push_back(pair.hit);
            });
        const double seconds = hinge::tool::seconds_since(start);
        const double rate = static_cast<double>(options.count) / seconds;
        plots[n].curves[m].values.push_back(rate);
        if (most_clashes_at) {
          simd.check(sample_configuration(sampling, *most_clashes_at, simd.dof_count()), mode);
          worst.positions = simd.positions();
        }
        fmt::print(" {:>14.0f}", rate);
        std::fflush(stdout);
      }
      fmt::print("  {:8.2f} %\n", 100.0 * static_cast<double>(colliding) / static_cast<double>(options.count));
      different += differences(simd, brute, samplings[n].sampling, std::min(verified, options.count));
    }
  }
  fmt::print("\nbrute force on {} conformations of each row, all four modes: {} differences\n",
             std::min(verified, options.count), different);

  plot.stream() << to_svg(plots);
  plot.finish();
  fmt::print("written: {}", (folder / "speed.svg").string());
  if (const std::string picture = draw_tail(molecule, rules, options.seed, 40); !picture.empty()) {
    CompleteFile tail((folder / "tail.svg").string());
    tail.stream() << picture;
    tail.finish();
    fmt::print(", tail.svg");
  }
  if (!worst.pairs.empty()) {
    const std::string file = write_worst(s, worst, folder);
    fmt::print(", {} with {}, worst.cxc (ChimeraX), worst.pml (PyMOL)", file,
               hinge::tool::counted(worst.pairs.size(), "clash", "clashes"));
  }
  fmt::print("\n");
  return different == 0 ? Exit::free : Exit::bad_input;
}

}  // namespace biocd
