// SPDX-License-Identifier: BSD-3-Clause
// Compares hashes of the answers of two engines with stored values: they are equal to the last bit for every
// instruction set and compiler. every_answer.cpp covers more builds and engines.
#include "isa/answers.hpp"

#include <cstdint>
#include <cstdio>

#include "hinge/detail/simd/instruction_set.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/simd.hpp"
#include "isa/mechanism.hpp"
#include "isa/ties.hpp"

const unsigned char needed_instruction_set = static_cast<unsigned char>(hinge::detail::simd::compiled_for());

namespace hinge::isa {
namespace {

struct Expected {
  std::uint64_t poses, verdicts, distances;
};

int compare(const char* what, const Answers& answers, const Expected& expected) {
  int different = 0;
  const auto one = [&](const char* part, const Hash& hash, std::uint64_t wanted) {
    if (hash.value() == wanted) return;
    ++different;
    std::printf("%s, %s: 0x%016llx, expected 0x%016llx\n", what, part, static_cast<unsigned long long>(hash.value()),
                static_cast<unsigned long long>(wanted));
  };
  one("poses", answers.poses, expected.poses);
  one("verdicts", answers.verdicts, expected.verdicts);
  one("distances", answers.distances, expected.distances);
  return different;
}

template <class P>
void announce(const char* what, std::uint64_t seed, const Model<P>& model) {
  std::printf("%s: %zu primitives, %zu DOF, seed %llu\n", what, model.size(), model.tree().dof_count(),
              static_cast<unsigned long long>(seed));
}

template <class P, class F, class D>
int compare_engines(const char* what, std::uint64_t seed, const Model<P>& model, const F& filter, const D& matrix,
                    int configurations, const Expected& expected) {
  announce(what, seed, model);
  return compare("simd", answers_of<P, F, D, Simd>(seed, model, filter, matrix, configurations), expected) +
         compare("brute", answers_of<P, F, D, Brute>(seed, model, filter, matrix, configurations), expected);
}

template <class P, class F, class D>
int compare_ties(const char* what, std::uint64_t seed, Grid grid, const Model<P>& model, const F& filter,
                 const D& matrix, const Expected& expected) {
  announce(what, seed, model);
  return compare("simd", tied_answers_of<P, F, D, Simd>(seed, grid, model, filter, matrix, 8), expected) +
         compare("brute", tied_answers_of<P, F, D, Brute>(seed, grid, model, filter, matrix, 8), expected);
}

}  // namespace
}  // namespace hinge::isa

int compare_answers() {
  using namespace hinge;
  using namespace hinge::isa;
  std::printf("compiled for %s\n", detail::simd::name(detail::simd::compiled_for()).data());
  int different = 0;
  {
    Random random(11);
    const auto model = random_model<Point>(random, 70, 120, 400);
    different += compare_engines("points", 11, model, TwelfthExcluded{}, thresholds(model.size(), 9, random), 30,
                                 {0xc4a326a0b6b35d3f, 0x014581713e5efc37, 0x68f97dce475c4b6a});
  }
  {
    Random random(12);
    const auto model = random_model<Capsule>(random, 40, 40, 60);
    different += compare_engines("capsules", 12, model, AdmitAll{}, UniformClearance{0.1}, 25,
                                 {0x9364a1b1146c2549, 0xb8dbfb9597674c38, 0xa1f87b452ab498ef});
  }
  {
    Random random(13);
    const auto model = tied_model<Point>(Grid::decimal, random, 200);
    different += compare_ties("points on a decimal grid", 13, Grid::decimal, model, TwelfthExcluded{},
                              tied_thresholds(Grid::decimal, model.size(), random),
                              {0x2cae3c2f29ef1ce8, 0xd8f76d8fc2596a83, 0x55bcef9dd101354d});
  }
  {
    Random random(14);
    const auto model = tied_model<Capsule>(Grid::binary, random, 60);
    different += compare_ties("capsules on a binary grid", 14, Grid::binary, model, AdmitAll{}, UniformClearance{0.25},
                              {0x96742b4ba99a3490, 0x7f24de089d0710d7, 0x952cf143147eca9a});
  }
  return different;
}
