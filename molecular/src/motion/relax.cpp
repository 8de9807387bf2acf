// SPDX-License-Identifier: BSD-3-Clause
// Mends clashes: descent from the start, then random restarts of the residues in the way.
#include "hinge/molecular/relax.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "motion/clash_descent.hpp"

namespace hinge::molecular {

namespace {

constexpr std::array displacement_weights{1e-2, 1e-3, 1e-4, 0.0};  // mu, largest first
constexpr double unseen_move = 0.02;                               // angstrom; smaller displacements are taken back
constexpr std::size_t tries_per_restart = 32;
constexpr double restart_turn = 15.0 * std::numbers::pi / 180.0;  // rad
constexpr double restart_slide = 0.5;                             // angstrom

/// How good a conformation is.
struct Score {
  std::size_t collisions = 0;
  std::size_t near = 0;  // pairs that collide or could collide in a file
  double energy = 0.0;

  bool better_than(const Score& other) const noexcept {
    return std::tie(collisions, near, energy) < std::tie(other.collisions, other.near, other.energy);
  }
};

class Relaxer {
 public:
  Relaxer(const Checker& checker, std::span<const double> start, const RelaxOptions& options,
          const std::function<bool()>& stop)
      : checker_(checker),
        options_(options),
        start_(start.begin(), start.end()),
        descent_(checker_, start, options.closures, stop) {
    if (!options.closures.empty())
      solver_.emplace(checker.molecule().model().tree(), checker.selection(), options.closures);
  }

  Relaxation run() {
    Relaxation result;
    const Score before = score(start_);
    best_ = start_;
    score_ = before;
    if (before.collisions > 0) {
      offer(descend(start_, displacement_weights));
      restart(result);
      if (score_.near == 0 && !descent_.stopped()) return_to_start();
    }
    result.q = best_;
    result.collisions_before = before.collisions;
    result.energy_before = before.energy;
    result.collisions = score_.collisions;
    result.energy = score_.energy;
    result.stopped = descent_.stopped();
    return result;
  }

 private:
  /// Values that a restart draws together: those of a residue or of a placed part.
  struct Mover {
    bool is_part = false;
    std::size_t number = 0;

    friend bool operator==(const Mover&, const Mover&) = default;
    friend bool operator<(const Mover& a, const Mover& b) noexcept {
      return std::tie(a.is_part, a.number) < std::tie(b.is_part, b.number);
    }
  };

  Mover mover_of(std::size_t value) const {
    const Molecule& molecule = checker_.molecule();
    const DofId dof = checker_.selection().dofs()[value];
    if (const std::size_t torsion = molecule.torsion_of(dof); torsion != Molecule::no_torsion)
      return {false, molecule.torsions()[torsion].residue};
    std::size_t part = 0;
    while (std::ranges::find(molecule.placed_parts()[part].dofs, dof) == molecule.placed_parts()[part].dofs.end())
      ++part;
    return {true, part};
  }

  Score score(std::span<const double> q) {
    Score score;
    for (const Contact& pair : near_pairs(q)) {
      ++score.near;
      if (!pair.collides) continue;
      ++score.collisions;
      const double overlap = pair.hit.threshold - pair.hit.distance;
      score.energy += overlap * overlap;  // the terms of Checker::steric at softness 0, in the same order
    }
    return score;
  }
  std::vector<Contact> near_pairs(std::span<const double> q) {
    return checker_.check(q, Mode{Mode::Kind::within, file_rounding}).pairs;
  }
  bool is_closed(std::vector<double>& q) { return !solver_ || solver_->close(q); }

  /// Makes q the best conformation if it is better and its closures close.
  bool offer(std::vector<double> q) {
    if (!is_closed(q)) return false;
    const Score reached = score(q);
    if (!reached.better_than(score_)) return false;
    best_ = std::move(q);
    score_ = reached;
    return true;
  }

  /// Minimises from q for one mu after the other until the minimum is free.
  std::vector<double> descend(std::vector<double> q, std::span<const double> weights);
  void restart(Relaxation& result);
  std::vector<Mover> in_the_way();
  std::vector<double> draw(const Mover& mover, SampleStream& stream);
  void return_to_start();

  Checker checker_;
  RelaxOptions options_;
  std::vector<double> start_;
  ClashDescent descent_;
  std::optional<ClosureSolver> solver_;
  std::vector<double> best_;
  Score score_;
};

std::vector<double> Relaxer::descend(std::vector<double> q, std::span<const double> weights) {
  for (const double mu : weights) {
    descent_.minimise(q, mu);
    std::vector<double> reached = q;
    if (descent_.stopped() || (is_closed(reached) && near_pairs(reached).empty())) return reached;
  }
  return q;
}

/// Returns the residues and parts whose values move an atom of a colliding pair, the last joint before it.
std::vector<Relaxer::Mover> Relaxer::in_the_way() {
  const RigidGroups& groups = checker_.rigid_groups();
  std::set<Mover> movers;
  for (const Contact& contact : near_pairs(best_))
    for (const PrimitiveId atom : {contact.hit.first, contact.hit.second}) {
      const GroupId group = checker_.group_of(static_cast<std::uint32_t>(index(atom)));
      if (group != GroupId{0}) movers.insert(mover_of(groups[group].dof));
    }
  return {movers.begin(), movers.end()};
}

/// Returns the best conformation with the values of `mover` drawn again.
std::vector<double> Relaxer::draw(const Mover& mover, SampleStream& stream) {
  std::vector<std::size_t> values;
  for (std::size_t k = 0; k < start_.size(); ++k)
    if (mover_of(k) == mover) values.push_back(k);
  std::vector<double> least = best_;
  double least_energy = HUGE_VAL;
  for (std::size_t attempt = 0; attempt < tries_per_restart; ++attempt) {
    std::vector<double> q = best_;
    for (std::size_t place = 0; place < values.size(); ++place) {
      const std::size_t k = values[place];
      if (mover.is_part && place < 3)
        q[k] += restart_slide * stream.normal();
      else if (!mover.is_part && descent_.moved_atoms()[k].in_one_residue)
        q[k] = start_[k] + std::numbers::pi * (2.0 * stream.uniform() - 1.0);
      else
        q[k] += restart_turn * stream.normal();
    }
    const double energy = checker_.steric(q, ClashDescent::softness).energy;
    if (energy >= least_energy) continue;
    least_energy = energy;
    least = std::move(q);
  }
  return least;
}

void Relaxer::restart(Relaxation& result) {
  // The largest mu would drive a restart back to the start.
  const auto weights = std::span(displacement_weights).subspan(1);
  std::vector<Mover> movers = in_the_way();
  for (std::size_t turn = 0; score_.near > 0 && !descent_.stopped() && result.restarts < options_.most_restarts;
       ++turn) {
    SampleStream stream(options_.seed, result.restarts++);
    if (offer(descend(draw(movers[turn % movers.size()], stream), weights))) movers = in_the_way();
  }
}

/// Takes back what is not needed: displacements that nobody sees, then whole residues, then a little of everything.
void Relaxer::return_to_start() {
  const auto try_instead = [&](std::vector<double> q) {
    if (!is_closed(q)) return;
    const Score reached = score(q);
    if (reached.near > 0) return;
    best_ = std::move(q);
    score_ = reached;
  };
  std::vector<double> q = best_;
  for (std::size_t k = 0; k < q.size(); ++k)
    if (std::abs(q[k] - start_[k]) * descent_.moved_atoms()[k].lever <
        unseen_move * descent_.moved_atoms()[k].root_count)
      q[k] = start_[k];
  try_instead(std::move(q));
  std::set<Mover> moved;
  for (std::size_t k = 0; k < start_.size(); ++k)
    if (best_[k] != start_[k]) moved.insert(mover_of(k));
  for (const Mover& mover : moved) {
    q = best_;
    for (std::size_t k = 0; k < q.size(); ++k)
      if (mover_of(k) == mover) q[k] = start_[k];
    try_instead(std::move(q));
  }
  for (const double weight : displacement_weights) {
    if (weight == 0.0) break;
    try_instead(descend(best_, {&weight, 1}));
  }
}

}  // namespace

Relaxation relax(const Checker& checker, std::span<const double> q, const RelaxOptions& options,
                 const std::function<bool()>& stop) {
  if (checker.dof_count() == 0) throw ModelError("no torsion is free, expected at least one");
  return Relaxer(checker, q, options, stop).run();
}

}  // namespace hinge::molecular
