// SPDX-License-Identifier: BSD-3-Clause
// Makes the choices of biocd dial.
#include "dial_choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "hinge/batch/ensemble.hpp"
#include "hinge/molecular/path_checker.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::tool::DialChoice;
using hinge::tool::DialSection;
using hinge::tool::Sound;
using hinge::tool::Verdict3;

namespace {

constexpr std::uint64_t most_closing_starts = 100;  // of a conformation with closed cycles, as in `sample`

std::string what_of(const Sampling& sampling) {
  return sampling.sigma ? fmt::format("sigma {:.3g} degrees, seed {}", *sampling.sigma / degree, sampling.seed)
                        : fmt::format("uniform over the full turn, seed {}", sampling.seed);
}

/// The values of one round for a variant, one conformation after the other, without those that are missing.
struct Values {
  std::vector<double> all;
  std::vector<bool> missing;  // by question
};

}  // namespace

Conformations::Conformations(const Job& job, const Sampling& sampling) : job_(job), sampling_(sampling) {
  if (!job.kept.closures.empty())
    closed_.emplace(*job.molecule, job.checker.selection(), sampling, most_closing_starts, job.kept.closures,
                    job.ranges);
}

void Conformations::prepare(std::uint64_t first, std::size_t count) {
  if (!drawn_.empty() && first == first_ && count <= drawn_.size()) return;
  first_ = first;
  drawn_.clear();
  for (std::uint64_t k = first; k < first + count; ++k)
    drawn_.push_back(closed_
                         ? closed_->sample(k).q
                         : sample_configuration(sampling_, k, *job_.molecule, job_.checker.selection(), job_.ranges));
}

std::span<const double> Conformations::at(std::uint64_t k) const {
  return drawn_[static_cast<std::size_t>(k - first_)];
}

Variant make_variant(const Job& job, Checker checker) {
  using Key = std::pair<std::uint32_t, std::string>;
  std::map<Key, std::size_t> torsions;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> placements;  // by part and component
  const auto each = [](const Checker& of, const auto& torsion, const auto& placement) {
    const Molecule& molecule = of.molecule();
    const auto dofs = of.selection().dofs();
    for (std::size_t k = 0; k < dofs.size(); ++k) {
      const std::size_t t = molecule.torsion_of(dofs[k]);
      if (t != Molecule::no_torsion) {
        torsion(k, Key{molecule.torsions()[t].residue, molecule.torsions()[t].name});
        continue;
      }
      for (std::size_t p = 0; p < molecule.placed_parts().size(); ++p) {
        const auto& placed = molecule.placed_parts()[p].dofs;
        const auto found = std::ranges::find(placed, dofs[k]);
        if (found != placed.end()) placement(k, std::pair(p, static_cast<std::size_t>(found - placed.begin())));
      }
    }
  };
  each(
      job.checker, [&](std::size_t k, const Key& key) { torsions[key] = k; },
      [&](std::size_t k, const auto& key) { placements[key] = k; });
  std::vector<std::optional<std::size_t>> sources(checker.dof_count());
  const auto look_up = [&](const auto& map, std::size_t k, const auto& key) {
    if (const auto found = map.find(key); found != map.end()) sources[k] = found->second;
  };
  each(
      checker, [&](std::size_t k, const Key& key) { look_up(torsions, k, key); },
      [&](std::size_t k, const auto& key) { look_up(placements, k, key); });
  return {std::move(checker), std::move(sources)};
}

namespace {

std::vector<double> values_of(const std::vector<std::optional<std::size_t>>& sources, std::span<const double> q) {
  std::vector<double> values;
  values.reserve(sources.size());
  for (const auto& source : sources) values.push_back(source ? q[*source] : 0.0);
  return values;
}

/// Answers the questions from first to last - 1 of the round.
void answer(Checker& checker, const Values& values, std::size_t first, std::size_t last, bool in_blocks,
            std::span<Verdict3> verdicts) {
  constexpr std::size_t block = 16;
  const std::size_t dof = checker.dof_count();
  const auto verdict = [](bool collides) { return collides ? Verdict3::collides : Verdict3::free; };
  const auto at = [&](std::size_t k, std::size_t count) { return std::span(values.all).subspan(k * dof, count * dof); };
  const Mode any{Mode::Kind::any};
  for (std::size_t k = first; k < last;) {
    const std::size_t count = std::min(block, last - k);
    const bool complete = std::none_of(values.missing.begin() + static_cast<std::ptrdiff_t>(k),
                                       values.missing.begin() + static_cast<std::ptrdiff_t>(k + count),
                                       [](bool missing) { return missing; });
    if (in_blocks && dof > 0 && complete) {
      const std::vector<std::uint8_t> found = checker.check_batch(at(k, count));
      std::ranges::transform(found, verdicts.begin() + static_cast<std::ptrdiff_t>(k - first),
                             [&](std::uint8_t v) { return verdict(v != 0); });
      k += count;
      continue;
    }
    for (const std::size_t end = k + count; k < end; ++k)
      verdicts[k - first] = values.missing[k] ? Verdict3::undecided : verdict(checker.check(at(k, 1), any).collides);
  }
}

}  // namespace

DialChoice make_choice(std::string kind, std::string name, std::string options, Sound sound, const Variant& variant,
                       std::shared_ptr<Conformations> conformations, const Manner& manner) {
  DialChoice choice{std::move(kind), std::move(name), std::move(options), sound, {}, {}, {}};
  const auto values = std::make_shared<Values>();
  const auto checker = std::make_shared<Checker>(variant.checker);
  const std::size_t dof = variant.sources.size();
  choice.prepare = [values, conformations, dof, sources = variant.sources](std::uint64_t first, std::size_t count) {
    conformations->prepare(first, count);
    values->all.clear();
    values->missing.clear();
    for (std::uint64_t k = first; k < first + count; ++k) {
      const std::span<const double> q = conformations->at(k);
      values->missing.push_back(q.empty() && dof > 0);
      const std::vector<double> own = q.empty() ? std::vector<double>(dof, 0.0) : values_of(sources, q);
      values->all.insert(values->all.end(), own.begin(), own.end());
    }
  };
  choice.distance = [checker, conformations, sources = variant.sources](std::uint64_t k) {
    const std::span<const double> q = conformations->at(k);
    if (q.empty()) return 0.0;
    const auto closest = checker->check(values_of(sources, q), Mode{Mode::Kind::closest}).closest;
    return closest ? closest->hit.gap() : std::numeric_limits<double>::infinity();
  };
  if (manner.threads == 1) {
    choice.ask = [values, checker, in_blocks = manner.in_blocks](std::uint64_t, std::span<Verdict3> verdicts) {
      answer(*checker, *values, 0, verdicts.size(), in_blocks, verdicts);
    };
    return choice;
  }
  const auto workers = std::make_shared<hinge::Ensemble<Checker>>(*checker, manner.threads);
  choice.ask = [values, workers, in_blocks = manner.in_blocks](std::uint64_t, std::span<Verdict3> verdicts) {
    constexpr std::size_t block = 16;
    const auto judge = [&](Checker& mine, std::size_t b) {
      const std::size_t first = b * block, last = std::min(first + block, verdicts.size());
      std::vector<Verdict3> found(last - first);
      answer(mine, *values, first, last, in_blocks, found);
      return found;
    };
    workers->run((verdicts.size() + block - 1) / block, judge, [&](std::size_t b, const std::vector<Verdict3>& found) {
      std::ranges::copy(found, verdicts.begin() + static_cast<std::ptrdiff_t>(b * block));
    });
  };
  return choice;
}

std::optional<double> balanced_sigma(const Job& job, std::uint64_t seed) {
  constexpr std::uint64_t samples = 100;
  Checker checker = job.checker;
  const Mode any{Mode::Kind::any};
  if (checker.check(std::vector<double>(checker.dof_count(), 0.0), any).collides) return {};
  double low = 1e-6, high = 3.2;
  while (high / low > 1.05) {
    const double middle = std::sqrt(low * high);
    Conformations conformations(job, {seed, middle});
    conformations.prepare(0, samples);
    std::uint64_t colliding = 0, found = 0;
    for (std::uint64_t k = 0; k < samples; ++k) {
      if (conformations.at(k).empty()) continue;
      ++found;
      colliding += checker.check(conformations.at(k), any).collides ? 1U : 0U;
    }
    (2 * colliding <= found ? low : high) = middle;
  }
  return low;
}

namespace {

using Ends = std::array<std::vector<double>, 2>;

/// Returns the ends of path k: the first free one of twenty conformations, and a further one.
Ends path_ends(Checker& checker, Conformations& conformations, std::uint64_t k) {
  constexpr std::uint64_t most_draws = 20;
  Ends ends;
  const auto draw = [&](std::uint64_t n) {
    conformations.prepare((most_draws + 1) * k + n, 1);
    const auto q = conformations.at((most_draws + 1) * k + n);
    return std::vector<double>(q.begin(), q.end());
  };
  for (std::uint64_t n = 0; n < most_draws; ++n) {
    ends[0] = draw(n);
    if (!checker.check(ends[0], Mode{Mode::Kind::any}).collides) break;
  }
  ends[1] = draw(most_draws);
  return ends;
}

/// Returns the largest change of a DOF on a typical path, in degrees.
double typical_turn(Checker checker, Conformations& conformations) {
  constexpr std::uint64_t looked_at = 15;
  std::vector<double> turns;
  for (std::uint64_t k = 0; k < looked_at; ++k) {
    const Ends ends = path_ends(checker, conformations, k);
    double most = 0.0;
    for (std::size_t j = 0; j < ends[0].size(); ++j) most = std::max(most, std::abs(ends[1][j] - ends[0][j]));
    turns.push_back(most / degree);
  }
  return hinge::tool::median_of(std::move(turns)).value;
}

}  // namespace

DialSection path_section(const Job& job, const Sampling& sampling) {
  DialSection section;
  section.title = "Paths";
  section.unit = {"path", "paths"};
  section.population = "straight between a free conformation and another one, " + what_of(sampling);
  const auto conformations = std::make_shared<Conformations>(job, sampling);
  const auto checker = std::make_shared<Checker>(job.checker);
  const auto paths = std::make_shared<PathChecker>(job.checker);
  const auto ends = std::make_shared<std::map<std::uint64_t, Ends>>();
  const auto prepare = [conformations, checker, ends](std::uint64_t first, std::size_t count) {
    ends->erase(ends->begin(), ends->lower_bound(first));
    for (std::uint64_t k = first; k < first + count; ++k)
      if (!ends->contains(k)) ends->emplace(k, path_ends(*checker, *conformations, k));
  };
  const auto add = [&](std::string kind, std::string name, std::string options, Sound sound, auto check) {
    DialChoice choice{std::move(kind), std::move(name), std::move(options), sound, {}, {}, {}};
    choice.prepare = prepare;
    choice.ask = [ends, paths, check](std::uint64_t first, std::span<Verdict3> verdicts) {
      for (std::size_t k = 0; k < verdicts.size(); ++k) {
        const Ends& path = ends->at(first + k);
        switch (check(*paths, path)) {
          case hinge::PathVerdict::free: verdicts[k] = Verdict3::free; break;
          case hinge::PathVerdict::colliding: verdicts[k] = Verdict3::collides; break;
          case hinge::PathVerdict::undecided: verdicts[k] = Verdict3::undecided; break;
        }
      }
    };
    section.choices.push_back(std::move(choice));
  };
  add("proof", "every state, by proof", "", Sound::exact,
      [](PathChecker& checked, const Ends& path) { return checked.certify(path[0], path[1]).verdict; });
  constexpr std::size_t most_steps = 5;
  const double turn = typical_turn(job.checker, *conformations);
  for (const double step : {20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001}) {
    if (step > turn || section.choices.size() > most_steps) continue;
    add("samples", fmt::format("samples every {} {}", step, step == 1.0 ? "degree" : "degrees"),
        fmt::format("--sampled {}", step), Sound::unknown, [step](PathChecker& checked, const Ends& path) {
          return checked.sample(path[0], path[1], step * degree).verdict;
        });
  }
  return section;
}

}  // namespace biocd
