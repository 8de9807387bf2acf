// SPDX-License-Identifier: BSD-3-Clause
// Free conformations per second: growth residue by residue (biocd sample --collision-free) against plain samples of
// which the free ones are kept (biocd sample, filtered). One thread. Argument: seconds per contestant and set-up.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/free_sampler.hpp"
#include "hinge/molecular/kept_closures.hpp"
#include "hinge_tools/clock.hpp"
#include "looped_molecule.hpp"

namespace {

using namespace hinge::molecular;

struct Rate {
  std::uint64_t tried = 0, free = 0;
  double seconds = 0.0;

  double per_second() const { return static_cast<double>(free) / seconds; }
};

/// Calls next(k), which returns the number of free conformations of `each` new ones, until the time is over.
template <class Next>
Rate measure(double seconds, std::uint64_t each, const Next& next) {
  Rate rate;
  const auto start = hinge::tool::Clock::now();
  while (rate.seconds < seconds) {
    rate.free += next(rate.tried);
    rate.tried += each;
    rate.seconds = hinge::tool::seconds_since(start);
  }
  return rate;
}

void run(const std::filesystem::path& file, const std::string& name, const std::string& loop, const std::string& free,
         double seconds) {
  const hinge::bench::LoopedMolecule subject(file, loop, free);
  const KeptClosures plain = subject.plain(), grown = subject.grown();
  Checker checker = subject.checker(plain);
  Rate rejection;
  if (plain.closures.empty()) {
    constexpr std::uint64_t block = 256;
    rejection = measure(seconds, block, [&](std::uint64_t first) {
      std::vector<double> all;
      for (std::uint64_t k = first; k < first + block; ++k) {
        const std::vector<double> q = sample_configuration({1, {}}, k, checker.dof_count());
        all.insert(all.end(), q.begin(), q.end());
      }
      std::uint64_t found = 0;
      for (const std::uint8_t collides : checker.check_batch(all)) found += collides == 0 ? 1U : 0U;
      return found;
    });
  } else {
    ClosedSampler sampler(subject.molecule(), checker.selection(), {1, {}}, 100, plain.closures, {});
    rejection = measure(seconds, 1, [&](std::uint64_t k) {
      const ClosedSample sample = sampler.sample(k);
      return sample.found() && !checker.check(sample.q, hinge::Mode::parse("any")).collides ? 1U : 0U;
    });
  }
  const Checker other = subject.checker(grown);
  for (const Prior prior : {Prior::ramachandran, Prior::independent}) {
    FreeSampling how;
    how.prior = prior;
    FreeSampler sampler(other, how, grown.closures, {});
    std::uint64_t starts = 0;
    const Rate growth = measure(seconds, 1, [&](std::uint64_t k) {
      const FreeSample sample = sampler.sample(k);
      starts += sample.starts();
      return sample.found() ? 1U : 0U;
    });
    // Without a free plain sample, one more try might have given one: the ratio is at least this.
    const bool none = rejection.free == 0;
    const double other_rate = none ? 1.0 / rejection.seconds : rejection.per_second();
    std::printf("%-22s %-12s %10.4f %12llu %10.1f %8.1f %s%10.0f\n", name.c_str(),
                prior == Prior::ramachandran ? "ramachandran" : "uniform", rejection.per_second(),
                static_cast<unsigned long long>(rejection.tried), growth.per_second(),
                static_cast<double>(starts) / static_cast<double>(growth.tried), none ? ">" : " ",
                growth.per_second() / other_rate);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 20.0;
  const std::filesystem::path root = HINGE_SOURCE_DIR;
  std::printf("flags: %s; seed 1; %.0f s per contestant; reference collisions exempt\n", HINGE_BENCH_FLAGS, seconds);
  std::printf("%-22s %-12s %10s %12s %10s %8s %11s\n", "free", "prior", "plain /s", "plain tried", "grown /s", "starts",
              "ratio");
  const std::filesystem::path ubiquitin = root / "molecular/data/1ubq.pdb",
                              src = root / "tests/molecular/data/2src.pdb.gz";
  run(src, "2SRC A:245-255", "", "A:245-255", seconds);
  run(src, "2SRC A:405-420", "", "A:405-420", seconds);
  run(src, "2SRC loop A:405-416", "A:405-416", "", seconds);
  run(ubiquitin, "1UBQ loop A:6-17", "A:6-17", "", seconds);
  run(ubiquitin, "1UBQ loop A:7-11", "A:7-11", "", seconds);
  run(ubiquitin, "1UBQ A:70-76", "", "A:70-76", seconds);
  run(ubiquitin, "1UBQ all", "", "all", seconds);
  return 0;
}
