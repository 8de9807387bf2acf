// SPDX-License-Identifier: BSD-3-Clause
// Prints one line per hash of the answers of every primitive and engine, for random scenes, ties and threads.
// build_all.sh compiles this in many ways and compares the lines; this program compares only engines and threads.
// HINGE_ONE_THREAD leaves the threads out, for systems without TBB.
#ifndef HINGE_ONE_THREAD
#include <tbb/global_control.h>

#include "hinge/batch/ensemble.hpp"
#endif

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "hinge/detail/core/elementary.hpp"
#include "hinge/detail/simd/fill_random.hpp"
#include "hinge/detail/simd/instruction_set.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "isa/answers.hpp"
#include "isa/mechanism.hpp"
#include "isa/ties.hpp"

const unsigned char needed_instruction_set = static_cast<unsigned char>(hinge::detail::simd::compiled_for());

namespace hinge::isa {
namespace {

int differences = 0;

void print(const char* what, const char* part, std::uint64_t hash) {
  std::printf("%s|%s|%016llx\n", what, part, static_cast<unsigned long long>(hash));
}

void print(const char* what, const Answers& simd, const Answers& brute, const Answers& lazy) {
  const auto one = [&](const char* part, const Hash& a, const Hash& b, const Hash& c) {
    print(what, part, a.value());
    if (a.value() == b.value() && a.value() == c.value()) return;
    ++differences;
    std::printf("%s: the %s of simd, brute and lazy differ: %016llx %016llx %016llx\n", what, part,
                static_cast<unsigned long long>(a.value()), static_cast<unsigned long long>(b.value()),
                static_cast<unsigned long long>(c.value()));
  };
  one("verdicts", simd.verdicts, brute.verdicts, lazy.verdicts);
  one("poses", simd.poses, brute.poses, lazy.poses);
  one("distances", simd.distances, brute.distances, lazy.distances);
}

template <class P, class F, class D>
void random_scene(const char* what, std::uint64_t seed, const Model<P>& model, const F& filter, const D& matrix) {
  constexpr int steps = 9;
  print(what, answers_of<P, F, D, Simd>(seed, model, filter, matrix, steps),
        answers_of<P, F, D, Brute>(seed, model, filter, matrix, steps),
        answers_of<P, F, D, Lazy>(seed, model, filter, matrix, steps));
}

template <class P, class F, class D>
void ties(const char* what, std::uint64_t seed, Grid grid, const Model<P>& model, const F& filter, const D& matrix) {
  constexpr int steps = 5;
  print(what, tied_answers_of<P, F, D, Simd>(seed, grid, model, filter, matrix, steps),
        tied_answers_of<P, F, D, Brute>(seed, grid, model, filter, matrix, steps),
        tied_answers_of<P, F, D, Lazy>(seed, grid, model, filter, matrix, steps));
}

#ifdef HINGE_ONE_THREAD
template <class... Arguments>
void threads(const Arguments&...) {}
#else
/// Prints hashes of verdicts and pairs of one model, and compares one, two and eight threads.
template <class P, class F, class D>
void threads(const char* what, std::uint64_t seed, Grid grid, const Model<P>& model, const F& filter, const D& matrix) {
  constexpr std::size_t count = 40;
  // Allows more threads than the machine may have.
  const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
  using H = Hierarchy<P, F, D>;
  const H hierarchy(model, filter, matrix);
  std::uint64_t first = 0;
  for (const unsigned n : {1U, 2U, 8U}) {
    Answers answers;
    Ensemble<H>(hierarchy, n)
        .run(
            count,
            [&](H& own, std::size_t k) {
              Random random(seed + k);
              std::vector<double> q(own.dof_count());
              for (double& value : q) value = grid_value(grid, random, 9);
              own.update(q);
              return own.self_collisions();
            },
            [&](std::size_t, const std::vector<Hit>& hits) { answers.add_pairs(hits); });
    if (n == 1) {
      first = answers.verdicts.value();
      print(what, "verdicts", first);
      print(what, "distances", answers.distances.value());
    }
    if (answers.verdicts.value() == first) continue;
    ++differences;
    std::printf("%s: %u threads answer otherwise than one\n", what, n);
  }
}
#endif

/// Prints hashes of the elementary functions that coordinates, torsions and samples are computed with.
void elementary_functions(std::uint64_t seed) {
  Random random(seed);
  Hash angles, logarithms, numbers;
  for (int k = 0; k < 100000; ++k) {
    const double y = random.uniform(-1.0, 1.0), x = random.uniform(-1.0, 1.0);
    angles.add(detail::atan2(y, x));
    logarithms.add(detail::log(random.uniform(0x1p-53, 1.0)));
  }
  print("atan2", "distances", angles.value());
  print("log", "distances", logarithms.value());
  SampleStream stream(seed, 7);
  std::vector<double> drawn(100000);
  detail::simd::fill_normal(stream, drawn);
  for (const double x : drawn) numbers.add(x);
  detail::simd::fill_uniform(stream, drawn);
  for (const double x : drawn) numbers.add(x);
  print("random numbers", "distances", numbers.value());
}

template <class P>
void solids(const char* what, const char* on_binary, const char* on_decimal, std::uint64_t seed) {
  Random random(seed);
  random_scene(what, seed, random_model<P>(random, 12, 10, 40), AdmitAll{}, UniformClearance{0.1});
  ties(on_binary, seed, Grid::binary, tied_model<P>(Grid::binary, random, 25), AdmitAll{}, UniformClearance{0.0});
  ties(on_decimal, seed, Grid::decimal, tied_model<P>(Grid::decimal, random, 25), AdmitAll{}, UniformClearance{0.25});
}

}  // namespace
}  // namespace hinge::isa

int compare_answers() {
  using namespace hinge;
  using namespace hinge::isa;
  {
    constexpr std::uint64_t seed = 21;
    Random random(seed);
    const auto model = random_model<Point>(random, 20, 30, 60);
    random_scene("points", seed, model, TwelfthExcluded{}, thresholds(model.size(), 9, random));
    for (const Grid grid : {Grid::binary, Grid::decimal}) {
      const auto tied = tied_model<Point>(grid, random, 50);
      const auto matrix = tied_thresholds(grid, tied.size(), random);
      ties(grid == Grid::binary ? "points, binary ties" : "points, decimal ties", seed, grid, tied, TwelfthExcluded{},
           matrix);
      if (grid == Grid::decimal)
        threads("points, decimal ties, 1, 2 and 8 threads", seed, grid, tied, TwelfthExcluded{}, matrix);
    }
  }
  solids<Sphere>("spheres", "spheres, binary ties", "spheres, decimal ties", 22);
  solids<Capsule>("capsules", "capsules, binary ties", "capsules, decimal ties", 23);
  solids<Triangle>("triangles", "triangles, binary ties", "triangles, decimal ties", 24);
  {
    constexpr std::uint64_t seed = 25;
    Random random(seed);
    const auto model = touching_model(random, 100);
    ties("triangles, corner on face", seed, Grid::binary, model, AdmitAll{}, UniformClearance{0.0});
    threads("triangles, corner on face, 1, 2 and 8 threads", seed, Grid::binary, model, AdmitAll{},
            UniformClearance{0.0});
  }
  elementary_functions(26);
  return differences;
}
