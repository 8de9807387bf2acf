// SPDX-License-Identifier: BSD-3-Clause
// Makes the choices of robocd dial about motions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dial_choices.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/random_configuration.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::DialChoice;
using hinge::tool::DialSection;
using hinge::tool::Sound;
using hinge::tool::Verdict3;

namespace {

/// Straight motions from a free configuration towards a random one. Each depends only on the seed and its number.
class Motions {
 public:
  Motions(const Worker& worker, std::uint64_t first) : worker_(worker), seed_(first) {}

  /// Finds the shortest of a few lengths at which enough motions collide. paths: checks motions.
  void choose_length(PathChecker& paths) {
    constexpr std::uint64_t tried = 50, enough = 10;
    for (longest_ = 0.25; is_cut(); longest_ *= 2.0) {
      std::uint64_t colliding = 0;
      for (std::uint64_t k = 0; k < tried; ++k) {
        const auto [from, to] = at(k);
        colliding += paths.certify(from, to).verdict == hinge::PathVerdict::colliding ? 1U : 0U;
      }
      if (colliding >= enough) return;
    }
  }
  /// False: motions end at the random configuration.
  bool is_cut() const { return longest_ < 7.0; }
  /// The largest change of a joint, rad or m.
  double longest() const { return longest_; }

  /// Returns the two ends of motion k.
  std::pair<std::vector<double>, std::vector<double>> at(std::uint64_t k) {
    constexpr std::uint64_t most_draws = 20;
    const Robot& robot = worker_.checker.robot();
    const std::size_t length = robot.independent_joints().size();
    std::vector<double> from(length), to(length);
    for (std::uint64_t draw = 0; draw < most_draws; ++draw) {
      random_configuration(robot, seed_, (most_draws + 1) * k + draw, from);
      if (!ask(worker_, from, Mode{Mode::Kind::any}, false).collides) break;
    }
    random_configuration(robot, seed_, (most_draws + 1) * k + most_draws, to);
    double farthest = 0.0;
    for (std::size_t j = 0; j < length; ++j) farthest = std::max(farthest, std::abs(to[j] - from[j]));
    const double part = is_cut() && farthest > longest_ ? longest_ / farthest : 1.0;
    for (std::size_t j = 0; j < length; ++j) to[j] = from[j] + part * (to[j] - from[j]);
    return {std::move(from), std::move(to)};
  }

 private:
  Worker worker_;
  std::uint64_t seed_;
  double longest_ = 0.25;
};

}  // namespace

DialSection path_section(const Options& options, const Worker& worker) {
  DialSection section;
  section.title = "Motions";
  section.unit = {"motion", "motions"};
  const auto motions = std::make_shared<Motions>(worker, options.seed);
  using Ends = std::pair<std::vector<double>, std::vector<double>>;
  const auto ends = std::make_shared<std::map<std::uint64_t, Ends>>();
  const auto checker = std::make_shared<PathChecker>(path_checker(worker));
  motions->choose_length(*checker);
  section.population = fmt::format(
      "straight from a free configuration towards a random one{}, seed {}",
      motions->is_cut() ? fmt::format(", at most {} rad or m for a joint", motions->longest()) : "", options.seed);
  const auto prepare = [motions, ends](std::uint64_t first, std::size_t count) {
    ends->erase(ends->begin(), ends->lower_bound(first));
    for (std::uint64_t k = first; k < first + count; ++k)
      if (!ends->contains(k)) ends->emplace(k, motions->at(k));
  };
  const auto add = [&](std::string name, std::string words, Sound sound, auto check) {
    DialChoice choice{
        sound == Sound::exact ? "proof" : "samples", std::move(name), std::move(words), sound, {}, {}, {}};
    choice.prepare = prepare;
    choice.ask = [ends, checker, check](std::uint64_t first, std::span<Verdict3> verdicts) {
      for (std::size_t k = 0; k < verdicts.size(); ++k) {
        const auto& [from, to] = ends->at(first + k);
        switch (check(*checker, from, to)) {
          case hinge::PathVerdict::free: verdicts[k] = Verdict3::free; break;
          case hinge::PathVerdict::colliding: verdicts[k] = Verdict3::collides; break;
          case hinge::PathVerdict::undecided: verdicts[k] = Verdict3::undecided; break;
        }
      }
    };
    section.choices.push_back(std::move(choice));
  };
  add("every state, by proof", "", Sound::exact,
      [](PathChecker& paths, const std::vector<double>& from, const std::vector<double>& to) {
        return paths.certify(from, to).verdict;
      });
  for (const double step : {0.2, 0.1, 0.05, 0.02, 0.01, 0.001})
    add(fmt::format("samples every {} rad or m", step), fmt::format("--sampled {}", step), Sound::unknown,
        [step](PathChecker& paths, const std::vector<double>& from, const std::vector<double>& to) {
          return paths.sample(from, to, step).verdict;
        });
  return section;
}

}  // namespace robocd
