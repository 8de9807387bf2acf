// SPDX-License-Identifier: BSD-3-Clause
// The cost of exact decisions: the same queries on the same engine with exact and with plain decisions, interleaved.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "robots/make_subject.hpp"
#include "robots/robot_timing.hpp"
#include "robustness/plain_point.hpp"
#include "robustness/plain_triangle.hpp"
#include "robustness/recast.hpp"
#include "scene.hpp"

namespace hinge::bench {

using Json = nlohmann::ordered_json;

enum class Question : std::uint8_t { any, all, within, closest };
inline constexpr Question questions[] = {Question::any, Question::all, Question::within, Question::closest};
inline const char* name(Question q) {
  constexpr const char* names[] = {"yes/no", "all pairs", "pairs within", "closest"};
  return names[static_cast<std::size_t>(q)];
}

/// The answer to one question.
struct Reply {
  bool hit = false;
  double distance = 0.0;
  std::vector<std::pair<std::size_t, std::size_t>> pairs{};

  bool same_verdict(const Reply& other) const { return hit == other.hit && pairs == other.pairs; }
};

template <class H>
void ask(H& model, Question question, double margin, Reply& reply) {
  const auto take = [&](const std::vector<Hit>& hits) {
    reply.pairs.clear();
    for (const Hit& hit : hits) reply.pairs.emplace_back(index(hit.first), index(hit.second));
  };
  switch (question) {
    case Question::any: reply.hit = model.self_collides(); return;
    case Question::all: return take(model.self_collisions());
    case Question::within: return take(model.self_within(margin));
    case Question::closest: {
      const auto hit = model.self_closest();
      reply.hit = hit && hit->gap() < 0.0;
      reply.distance = hit ? hit->distance : 0.0;
      return;
    }
  }
}

/// Times and differences of exact and plain decisions.
struct Price {
  double us = 0.0;               ///< time of a query with exact decisions, median of the rounds
  double ratio = 0.0;            ///< exact time over plain time, median of the rounds
  double low = 0.0, high = 0.0;  ///< quartiles of the ratio
  std::size_t asked = 0, different = 0, distances_different = 0;
  double largest_difference = 0.0;  ///< largest difference of two distances, relative to the larger one
};

inline constexpr int price_rounds = 41;
/// Each side runs a block of the same states. A block is long enough to hide the cost of reading the clock, and short
/// enough that other load on the machine affects both sides alike.
inline constexpr double block_seconds = 5e-3;

/// exact(k, reply) and plain(k, reply) update their model to state k < count and fill the answer.
template <class Exact, class Plain>
Price measure_price(std::size_t count, const Exact& exact, const Plain& plain) {
  Price price;
  Reply ours, theirs;
  const double start = thread_seconds();
  std::size_t n = 0;
  for (; n < count && (n < 2 || thread_seconds() - start < 6 * block_seconds); ++n) {
    exact(n, ours);
    plain(n, theirs);
    ++price.asked;
    price.different += ours.same_verdict(theirs) ? 0 : 1;
    if (ours.distance == theirs.distance) continue;
    ++price.distances_different;
    price.largest_difference = std::max(
        price.largest_difference, std::abs(ours.distance - theirs.distance) / std::max(ours.distance, theirs.distance));
  }
  const double cost = (thread_seconds() - start) / static_cast<double>(2 * n);
  const int passes = std::max(1, static_cast<int>(block_seconds / (cost * static_cast<double>(n))));
  const auto timed = [&](const auto& contestant) {
    const double begin = thread_seconds();
    for (int pass = 0; pass < passes; ++pass)
      for (std::size_t k = 0; k < n; ++k) contestant(k, ours);
    return thread_seconds() - begin;
  };
  std::vector<double> ratios, times;
  for (int round = 0; round < price_rounds; ++round) {
    const bool exact_first = round % 2 == 0;
    const double first = exact_first ? timed(exact) : timed(plain);
    const double second = exact_first ? timed(plain) : timed(exact);
    const double of_exact = exact_first ? first : second, of_plain = exact_first ? second : first;
    ratios.push_back(of_exact / of_plain);
    times.push_back(of_exact / (passes * static_cast<double>(n)));
  }
  std::sort(ratios.begin(), ratios.end());
  std::sort(times.begin(), times.end());
  price.us = 1e6 * times[times.size() / 2];
  price.ratio = ratios[ratios.size() / 2];
  price.low = ratios[ratios.size() / 4];
  price.high = ratios[3 * ratios.size() / 4];
  return price;
}

inline Json json(const char* kind, const std::string& scene, const std::string& states, std::size_t size,
                 Question question, const Price& price) {
  return {{"kind", "price"},
          {"of", kind},
          {"scene", scene},
          {"primitives", size},
          {"states", states},
          {"query", name(question)},
          {"us", price.us},
          {"ratio", price.ratio},
          {"low", price.low},
          {"high", price.high},
          {"asked", price.asked},
          {"different", price.different},
          {"distances_different", price.distances_different},
          {"largest_difference", price.largest_difference}};
}

/// 1UBQ with all residues free; with the shared data also 1MBN with 10 and with all residues free.
inline std::vector<Json> price_of_molecules() {
  constexpr std::size_t conformations = 100;
  constexpr double margin = 0.5;  // angstrom
  std::vector<Setup> setups = {{"1ubq", ubiquitin(), false, 76}};
  if (const std::string file = shared_molecule("paper/1mbn.pdb"); !file.empty())
    for (const int residues : {10, 153}) setups.push_back({"1mbn", file, false, residues});
  std::vector<Json> rows;
  for (const Setup& setup : setups) {
    const Protein protein = read_protein(setup.file, setup.hydrogens);
    Scene scene(protein, setup.residues);
    const molecular::Molecule& molecule = *protein.molecule;
    const DofSelection selection =
        molecule.select(molecular::select_torsions(molecule, "count:" + std::to_string(setup.residues), true));
    Molecular<Simd> exact(recast<Point>(molecule.model()), selection, protein.filter, protein.thresholds);
    Hierarchy<PlainPoint, molecular::BondExclusions, TypedThresholds> plain(
        recast<PlainPoint>(molecule.model()), selection, protein.filter, protein.thresholds);
    for (const Sampling sampling : all_samplings) {
      std::vector<std::vector<double>> q;
      for (std::size_t k = 0; k < conformations; ++k) q.push_back(scene.configuration(sampling, k));
      for (const Question question : questions) {
        const auto asker = [&](auto& model) {
          return [&, question](std::size_t k, Reply& reply) {
            model.update(q[k]);
            ask(model, question, margin, reply);
          };
        };
        rows.push_back(json("molecules", setup.name + ", " + std::to_string(setup.residues) + " free", name(sampling),
                            scene.size(), question, measure_price(conformations, asker(exact), asker(plain))));
      }
    }
  }
  return rows;
}

/// The robots of ./run bench robots, which generates robots if the shared data is absent. Poses are given.
inline std::vector<Json> price_of_robots() {
  constexpr std::size_t postures = 100, trained = 100;
  constexpr double margin = 0.01;  // m
  std::vector<Json> rows;
  for (const SubjectKind& kind : subject_kinds) {
    const Subject subject = make_subject(kind, postures);
    const Model<Triangle>& model = subject.robot().model();
    Hierarchy exact(recast<Triangle>(model), subject.filter(), UniformClearance{0.0});
    Hierarchy plain(recast<PlainTriangle>(model), subject.filter(), UniformClearance{0.0});
    for (const std::vector<double>& q : subject.training(trained)) {
      exact.update(q);
      plain.update(q);
      exact.calibrate_pair_order();
      plain.calibrate_pair_order();
    }
    for (const Question question : questions) {
      const auto asker = [&](auto& asked) {
        return [&, question](std::size_t k, Reply& reply) {
          asked.update_poses(subject.postures()[k].groups);
          ask(asked, question, margin, reply);
        };
      };
      rows.push_back(json("meshes", subject.name(), "uniform in the joint limits", model.size(), question,
                          measure_price(postures, asker(exact), asker(plain))));
    }
  }
  return rows;
}

}  // namespace hinge::bench
