// SPDX-License-Identifier: BSD-3-Clause
// The choice of the compilers' vector types for hinge::simd: two inner loops with them and with Highway, in turns, at
// three levels.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/simd/instruction_set.hpp"
#include "simd/kernels.hpp"

namespace {

using namespace hinge;
using namespace hinge::bench;
using Clock = std::chrono::steady_clock;

constexpr std::size_t n = detail::simd::width;
constexpr std::uint64_t seed = 1;
/// All data fit into the first-level cache: 96 blocks are 20 KiB, 48 rows are 18 KiB.
constexpr std::size_t block_count = 96, task_count = 480, row_count = 48, box_count = 10;
/// Reading the clock takes tens of nanoseconds; this many passes between two readings take at least about 20 us.
constexpr int passes = 20, repetitions = 400;

/// Random data in which about one lane in sixteen is near or touching, as in the sweep over a protein.
struct Input {
  std::vector<float> packed = std::vector<float>(block_count * 3 * n), squares = std::vector<float>(n * n);
  std::vector<std::uint8_t> classes = std::vector<std::uint8_t>(block_count * n);
  std::vector<std::uint32_t> slots, blocks;
  std::vector<detail::FloatBox> boxes;
  std::vector<detail::BoxRow> rows = std::vector<detail::BoxRow>(row_count);

  Input() {
    std::mt19937_64 random(seed);
    const auto uniform = [&](float low, float high) {
      return low + (high - low) * static_cast<float>(random() >> 40) * 0x1p-24F;
    };
    for (float& x : packed) x = uniform(-4, 4);
    for (float& s : squares) s = uniform(4, 16);
    for (std::uint8_t& c : classes) c = static_cast<std::uint8_t>(random() % n);
    for (std::size_t t = 0; t < task_count; ++t) {
      slots.push_back(static_cast<std::uint32_t>(random() % (block_count * n)));
      blocks.push_back(static_cast<std::uint32_t>(random() % block_count));
    }
    const auto random_box = [&] {
      detail::FloatBox box;
      for (std::size_t k = 0; k < 3; ++k) {
        const float middle = uniform(-16, 16), half = uniform(2, 8);
        box.lower[k] = middle - half;
        box.upper[k] = middle + half;
      }
      return box;
    };
    for (std::size_t b = 0; b < box_count; ++b) boxes.push_back(random_box());
    for (detail::BoxRow& row : rows)
      for (std::size_t lane = 0; lane < n; ++lane) row.set(lane, random_box());
  }
};

struct Answers {
  std::vector<std::uint32_t> bits = std::vector<std::uint32_t>(task_count),
                             hits = std::vector<std::uint32_t>(box_count * row_count * n + n);
  std::size_t hit_count = 0;

  void points(const Kernels& kernels, const Input& in) {
    kernels.near_points(
        {in.packed.data(), in.classes.data(), in.squares.data(), in.slots.data(), in.blocks.data(), in.slots.size()},
        bits.data());
  }
  void boxes(const Kernels& kernels, const Input& in) {
    hit_count = kernels.touching_boxes({in.boxes.data(), in.boxes.size(), in.rows.data(), in.rows.size()}, hits.data());
  }
  bool same(const Answers& other) const {
    return bits == other.bits &&
           std::equal(hits.begin(), hits.begin() + static_cast<std::ptrdiff_t>(hit_count), other.hits.begin(),
                      other.hits.begin() + static_cast<std::ptrdiff_t>(other.hit_count));
  }
};

/// Nanoseconds of one "one against sixteen" test, the minimum over all repetitions. The two libraries take turns.
template <class Pass>
void measure(const char* level, const char* what, std::size_t calls, const Kernels (&libraries)[2], const Pass& pass) {
  double best[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int r = 0; r < repetitions; ++r)
    for (std::size_t k = 0; k < 2; ++k) {
      const auto start = Clock::now();
      for (int p = 0; p < passes; ++p) pass(libraries[k]);
      const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
      best[k] = std::min(best[k], spent.count() / (passes * static_cast<double>(calls)));
    }
  std::printf("%-9s %-23s %8.2f %8.2f %8.2f   %s\n", level, what, best[0], best[1], best[1] / best[0],
              libraries[1].target);
}

/// Returns whether the answers of both libraries equal `expected`.
template <detail::simd::InstructionSet Level>
bool run(const Input& in, const Answers& expected) {
  const std::string level(detail::simd::name(Level));
  if (detail::simd::of_this_cpu() < Level) {
    std::printf("%-9s left out: this CPU does not support it\n", level.c_str());
    return true;
  }
  const Kernels libraries[2] = {hinge_kernels<Level>(), highway_kernels<Level>()};
  Answers answers;
  for (const Kernels& kernels : libraries) {
    answers.points(kernels, in);
    answers.boxes(kernels, in);
    if (!answers.same(expected)) {
      std::printf("%s: the answers of %s differ\n", level.c_str(), kernels.target);
      return false;
    }
  }
  measure(level.c_str(), "one point, 16 points", task_count, libraries,
          [&](const Kernels& k) { answers.points(k, in); });
  measure(level.c_str(), "one box, 16 boxes", box_count * row_count, libraries,
          [&](const Kernels& k) { answers.boxes(k, in); });
  return true;
}

}  // namespace

int main() {
  const Input in;
  Answers expected;
  expected.points(hinge_kernels<detail::simd::InstructionSet::baseline>(), in);
  expected.boxes(hinge_kernels<detail::simd::InstructionSet::baseline>(), in);
  std::size_t near = 0;
  for (const std::uint32_t bits : expected.bits) near += static_cast<std::size_t>(std::popcount(bits));
  std::printf(
      "seed %d; %.1f of 16 points near, %.1f of 16 boxes touch; ns per call, minimum of %d alternating repetitions\n",
      static_cast<int>(seed), static_cast<double>(near) / task_count,
      static_cast<double>(expected.hit_count) / (box_count * row_count), repetitions);
  std::printf("level     loop                      hinge  highway    ratio   Highway's static target\n");
  bool right = run<detail::simd::InstructionSet::baseline>(in, expected);
  right = run<detail::simd::InstructionSet::avx2>(in, expected) && right;
  right = run<detail::simd::InstructionSet::avx512>(in, expected) && right;
  return right ? 0 : 1;
}
