// SPDX-License-Identifier: BSD-3-Clause
// Makes the choices of robocd dial.
#include "dial_choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "hinge/batch/ensemble.hpp"
#include "hinge/core/error.hpp"
#include "report.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::DialChoice;
using hinge::tool::Sound;
using hinge::tool::Verdict3;

namespace {

/// Answers yes or no for configurations, one after the other.
void answer(Worker& worker, std::span<const double> values, std::span<Verdict3> verdicts) {
  if (verdicts.empty()) return;
  const auto verdict = [](bool collides) { return collides ? Verdict3::collides : Verdict3::free; };
  const std::size_t length = values.size() / verdicts.size();
  if (!worker.environment && length > 0) {
    const std::vector<std::uint8_t> found = worker.checker.check_batch(values);
    std::ranges::transform(found, verdicts.begin(), [&](std::uint8_t v) { return verdict(v != 0); });
    return;
  }
  for (std::size_t k = 0; k < verdicts.size(); ++k) {
    worker.checker.update(values.subspan(k * length, length));
    verdicts[k] =
        verdict(worker.checker.collides() || (worker.environment && worker.checker.collides(*worker.environment)));
  }
}

double smallest_distance(Worker& worker, std::span<const double> q) {
  const Answer found = ask(worker, q, Mode{Mode::Kind::closest}, false);
  double distance = std::numeric_limits<double>::infinity();
  if (found.self.closest) distance = found.self.closest->distance;
  if (found.closest_body) distance = std::min(distance, found.closest_body->distance);
  return distance;
}

}  // namespace

void Questions::prepare(std::uint64_t first, std::size_t count) {
  if (count_ > 0 && first == first_ && count <= count_) return;
  first_ = first;
  count_ = count;
  values_.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const std::vector<double> q = all_.at(static_cast<std::size_t>(first + k) % all_.count);
    length_ = q.size();
    values_.insert(values_.end(), q.begin(), q.end());
  }
}

std::span<const double> Questions::at(std::uint64_t first, std::size_t count) const {
  return std::span(values_).subspan(static_cast<std::size_t>(first - first_) * length_, count * length_);
}

LinkShapes::LinkShapes(const Robot& robot) : tessellation_(robot.tessellation()) {
  for (const Tier tier : {Tier::mesh, Tier::hull, Tier::capsule, Tier::spheres}) {
    Tiers tiers;
    tiers.all = tier;
    try {
      descriptions_.emplace(tier, with_tiers(robot.description(), tiers));
    } catch (const hinge::ModelError& error) {  // such as a link too flat or too far away for a hull
      notes_.push_back(fmt::format("{}: left out: {}", hinge::robotics::name(tier), error.what()));
    }
  }
}

std::vector<Tier> LinkShapes::fitted() const {
  std::vector<Tier> tiers;
  for (const auto& [tier, description] : descriptions_)
    if (tier != Tier::mesh) tiers.push_back(tier);
  return tiers;
}

std::vector<Tier> LinkShapes::all(Tier tier) const { return std::vector<Tier>(size(), tier); }

std::shared_ptr<const Robot> LinkShapes::robot(const std::vector<Tier>& tiers) const {
  RobotDescription description = descriptions_.at(Tier::mesh);
  for (std::size_t l = 0; l < tiers.size(); ++l)
    description.links[l].geometry = descriptions_.at(tiers[l]).links[l].geometry;
  return std::make_shared<const Robot>(std::move(description), tessellation_);
}

std::vector<std::string> LinkShapes::words(const std::vector<Tier>& tiers) const {
  std::map<Tier, std::size_t> counts;
  for (std::size_t l = 0; l < tiers.size(); ++l)
    if (!descriptions_.at(Tier::mesh).links[l].geometry.empty()) ++counts[tiers[l]];
  if (counts.empty()) return {};
  const Tier most = std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })->first;
  std::vector<std::string> words;
  if (most != Tier::mesh) words.emplace_back(hinge::robotics::name(most));
  for (std::size_t l = 0; l < tiers.size(); ++l)
    if (tiers[l] != most && !descriptions_.at(Tier::mesh).links[l].geometry.empty())
      words.push_back(name(l) + "=" + hinge::robotics::name(tiers[l]));
  return words;
}

Worker make_worker(const Options& options, const Job& job, std::shared_ptr<const Robot> robot,
                   const std::string& engine) {
  Options other = options;
  other.engine = engine;
  Job with_robot = job;
  with_robot.robot = std::move(robot);
  return make_worker(other, with_robot);
}

DialChoice make_choice(std::string kind, std::string name, std::string options, Sound sound, Worker worker,
                       std::shared_ptr<Questions> questions, unsigned threads) {
  DialChoice choice{std::move(kind), std::move(name), std::move(options), sound, {}, {}, {}};
  choice.prepare = [questions](std::uint64_t first, std::size_t count) { questions->prepare(first, count); };
  const auto own = std::make_shared<Worker>(std::move(worker));
  choice.distance = [own, questions](std::uint64_t k) { return smallest_distance(*own, questions->at(k)); };
  if (threads == 1) {
    choice.ask = [own, questions](std::uint64_t first, std::span<Verdict3> verdicts) {
      for (std::size_t k = 0; k < verdicts.size(); k += block_size) {
        const std::size_t count = std::min(block_size, verdicts.size() - k);
        answer(*own, questions->at(first + k, count), verdicts.subspan(k, count));
      }
    };
    return choice;
  }
  const auto workers = std::make_shared<hinge::Ensemble<Worker>>(*own, threads);
  choice.ask = [workers, questions](std::uint64_t first, std::span<Verdict3> verdicts) {
    const auto judge = [&](Worker& mine, std::size_t b) {
      std::vector<Verdict3> block(std::min(block_size, verdicts.size() - b * block_size));
      answer(mine, questions->at(first + b * block_size, block.size()), block);
      return block;
    };
    workers->run((verdicts.size() + block_size - 1) / block_size, judge,
                 [&](std::size_t b, const std::vector<Verdict3>& block) {
                   std::ranges::copy(block, verdicts.begin() + static_cast<std::ptrdiff_t>(b * block_size));
                 },
                 16);
  };
  return choice;
}

DialChoice make_cascade(std::string name, Worker enclosing, Worker exact, std::shared_ptr<Questions> questions) {
  DialChoice choice{"exact behind tiers", std::move(name), "", Sound::exact, {}, {}, {}};
  choice.prepare = [questions](std::uint64_t first, std::size_t count) { questions->prepare(first, count); };
  choice.ask = [first_worker = std::make_shared<Worker>(std::move(enclosing)),
                second_worker = std::make_shared<Worker>(std::move(exact)),
                questions](std::uint64_t first, std::span<Verdict3> verdicts) {
    answer(*first_worker, questions->at(first, verdicts.size()), verdicts);
    for (std::size_t k = 0; k < verdicts.size(); ++k)
      if (verdicts[k] == Verdict3::collides) answer(*second_worker, questions->at(first + k), verdicts.subspan(k, 1));
  };
  return choice;
}

std::vector<std::uint64_t> free_questions(Worker& exact, Questions& questions, std::size_t count) {
  questions.prepare(0, count);
  std::vector<Verdict3> verdicts(count);
  answer(exact, questions.at(0, count), verdicts);
  std::vector<std::uint64_t> free;
  for (std::size_t k = 0; k < count; ++k)
    if (verdicts[k] == Verdict3::free) free.push_back(k);
  return free;
}

std::vector<Tier> find_mixture(const Options& options, const Job& job, const LinkShapes& shapes, Tier cheap,
                               const Questions& questions, const std::vector<std::uint64_t>& free, double share) {
  const auto allowed = static_cast<std::size_t>(share * static_cast<double>(free.size()));
  std::vector<Tier> tiers = shapes.all(cheap);
  std::vector<std::uint64_t> wrong = free;  // more exact shapes call no further question colliding
  for (std::size_t step = 0; step < shapes.size(); ++step) {
    Worker worker = make_worker(options, job, shapes.robot(tiers));
    std::map<std::string, std::size_t> blamed;
    std::vector<std::uint64_t> still;
    for (const std::uint64_t k : wrong) {
      const Answer found = ask(worker, questions.at(k), Mode{Mode::Kind::all}, false);
      if (!found.collides) continue;
      still.push_back(k);
      for (const auto& [first, second] : named_pairs(worker, found)) {
        ++blamed[first];
        ++blamed[second];
      }
    }
    if (still.size() <= allowed) return tiers;
    wrong = std::move(still);
    std::optional<std::size_t> worst;
    for (std::size_t l = 0; l < shapes.size(); ++l)
      if (tiers[l] != Tier::mesh && blamed[shapes.name(l)] > (worst ? blamed[shapes.name(*worst)] : 0)) worst = l;
    if (!worst) return {};
    tiers[*worst] = Tier::mesh;
  }
  return {};
}

}  // namespace robocd
