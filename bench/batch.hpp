// SPDX-License-Identifier: BSD-3-Clause
// Blocks of sixteen neighbouring conformations against single queries; both times include forward kinematics.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "hinge/batch/state_batch.hpp"
#include "scene.hpp"
#include "timing.hpp"

namespace hinge::bench {

/// Blocks of sixteen conformations: 128 states along straight paths between near-free conformations, or independent
/// near-free conformations.
inline std::vector<std::vector<double>> blocks_of(Scene& scene, bool along_paths, std::size_t count) {
  constexpr std::size_t size = 16, blocks_of_path = 8;
  const std::size_t dof = scene.dof_count();
  std::vector<std::vector<double>> blocks(count);
  std::vector<double> from, to;
  for (std::size_t b = 0; b < count; ++b) {
    if (along_paths && b % blocks_of_path == 0) {
      from = scene.configuration(Sampling::near_free, b / blocks_of_path * 2);
      to = scene.configuration(Sampling::near_free, b / blocks_of_path * 2 + 1);
    }
    for (std::size_t s = 0; s < size; ++s) {
      if (!along_paths) to = scene.configuration(Sampling::near_free, b * size + s);
      const double t = static_cast<double>(b % blocks_of_path * size + s) / (blocks_of_path * size - 1);
      for (std::size_t k = 0; k < dof; ++k) blocks[b].push_back(along_paths ? from[k] + t * (to[k] - from[k]) : to[k]);
    }
  }
  return blocks;
}

/// Prints `batch any K single R` for one selection and both kinds of blocks. Returns the number of wrong verdicts.
inline std::size_t print_batch(Scene& scene, const std::string& name) {
  constexpr std::size_t count = 40;
  constexpr int rounds = 7;
  std::size_t wrong = 0;
  for (const bool along_paths : {true, false}) {
    const auto blocks = blocks_of(scene, along_paths, count);
    auto single = scene.make<Simd>();
    auto batch = scene.make_batch();
    const std::size_t dof = scene.dof_count();
    constexpr double none = std::numeric_limits<double>::infinity();
    std::vector<double> single_us(count, none), batch_us(count, none);
    std::size_t colliding = 0;
    for (int round = 0; round < rounds; ++round)
      for (std::size_t b = 0; b < count; ++b) {
        detail::simd::Bits expected = 0, answer = 0;
        single_us[b] = std::min(single_us[b], microseconds([&] {
                                  for (std::size_t s = 0; s < 16; ++s) {
                                    single.update(std::span(blocks[b]).subspan(s * dof, dof));
                                    if (single.self_collides()) expected |= detail::simd::Bits{1} << s;
                                  }
                                }));
        batch_us[b] = std::min(batch_us[b], microseconds([&] { answer = batch.collides(blocks[b]); }));
        wrong += answer != expected ? 1 : 0;
        colliding += static_cast<std::size_t>(std::popcount(expected));
      }
    double single_sum = 0.0, batch_sum = 0.0;
    for (std::size_t b = 0; b < count; ++b) {
      single_sum += single_us[b];
      batch_sum += batch_us[b];
    }
    const BatchCounts& c = batch.counts();
    const double states = 16.0 * count, asked = states * rounds;
    std::printf(
        "batch any %s%s single %.2f   # %.2f and %.2f us, %.0f %% collide, %.2f lists per block of %.0f pairs, ",
        name.c_str(), along_paths ? "" : "-samples", single_sum / batch_sum, single_sum / states, batch_sum / states,
        100.0 * static_cast<double>(colliding) / asked, static_cast<double>(c.lists) * 16.0 / asked,
        static_cast<double>(c.listed) / std::max(1.0, static_cast<double>(c.lists)));
    std::printf("%.1f %% answered one at a time\n", 100.0 * static_cast<double>(c.alone) / asked);
  }
  return wrong;
}

/// 1MBN with 1, 10, 35 and all residues free, or 1UBQ without the shared data. Returns the number of wrong verdicts.
inline std::size_t print_batches() {
  const std::string shared = shared_molecule("paper/1mbn.pdb");
  const Protein protein = read_protein(shared.empty() ? ubiquitin() : shared, false);
  std::size_t wrong = 0;
  for (const int residues : shared.empty() ? std::vector<int>{1, 10, 35, 76} : std::vector<int>{1, 10, 35, 153}) {
    Scene scene(protein, residues);
    wrong += print_batch(scene, std::string("k").append(std::to_string(residues)));
  }
  if (wrong != 0) std::printf("%zu blocks with a WRONG verdict\n", wrong);
  return wrong;
}

}  // namespace hinge::bench
