// SPDX-License-Identifier: BSD-3-Clause
// Grows free conformations.
#include "hinge/molecular/free_sampler.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge::molecular {

namespace {

/// Residues at the end of a loop that are closed together. With four, one draw in ten can be closed; with six, about
/// every second one.
constexpr std::uint32_t residues_of_loop_end = 6;

/// The share of draws near the reference in the starts of a sample: it grows from 0 by `step` to `most`.
constexpr double reference_step = 0.1, most_reference = 0.8;
constexpr double reference_spread = 10.0 * std::numbers::pi / 180.0;  // rad

/// Growth goes back one residue for this many dead ends at one place, then two, and so on.
constexpr std::size_t returns_per_residue = 4;

bool is_loop_end(const Molecule& molecule, std::uint32_t residue) {
  return std::any_of(molecule.loops().begin(), molecule.loops().end(), [&](const Loop& loop) {
    return loop.first <= residue && residue <= loop.last && loop.last - residue < residues_of_loop_end;
  });
}

std::uint32_t atom_of(const Structure& s, std::uint32_t residue, std::string_view name) {
  for (std::uint32_t atom = s.residues[residue].first_atom; atom < s.residues[residue].last_atom; ++atom)
    if (s.atoms[atom].name == name) return atom;
  throw ModelError("residue of " + label(s, s.residues[residue].first_atom) + ": expected an atom " +
                   std::string(name));
}

/// Returns the loop whose end a closure closes; nothing for another closure.
std::optional<std::size_t> loop_of(const Molecule& molecule, std::size_t closure) {
  const Structure& s = molecule.structure();
  const auto [i, j] = molecule.closure_atoms()[closure];
  for (std::size_t k = 0; k < molecule.loops().size(); ++k) {
    const std::uint32_t last = molecule.loops()[k].last;
    if (s.atoms[i].residue == last && s.atoms[j].residue == last) return k;
  }
  return std::nullopt;
}

std::size_t position_of(const DofSelection& selection, DofId dof) {
  return static_cast<std::size_t>(std::lower_bound(selection.dofs().begin(), selection.dofs().end(), dof) -
                                  selection.dofs().begin());
}

}  // namespace

FreeSampler::FreeSampler(const Checker& checker, const FreeSampling& options, const std::vector<std::size_t>& closures,
                         std::span<const PlacementRange> ranges)
    : checker_(checker), options_(options), ranges_(ranges.begin(), ranges.end()) {
  const Molecule& molecule = checker.molecule();
  if (options.most_starts == 0 || options.most_draws == 0)
    throw ModelError("0 tries per sample, expected at least one");
  if (checker.dof_count() == 0) throw ModelError("no torsion is free, expected at least one");
  // Validates the ranges.
  static_cast<void>(sample_configuration(options.sampling, 0, molecule, checker.selection(), ranges));
  const bool only_loops = std::all_of(closures.begin(), closures.end(),
                                      [&](std::size_t closure) { return loop_of(molecule, closure).has_value(); });
  if (!closures.empty() && !only_loops) solver_.emplace(molecule.model().tree(), checker.selection(), closures);
  make_units(closures);
  std::vector<std::vector<std::size_t>> positions;
  for (const Unit& unit : units_) positions.push_back(unit.part ? std::vector<std::size_t>() : unit.positions);
  prior_.emplace(molecule, checker.selection(), options.prior, options.sampling.sigma, std::move(positions));
}

void FreeSampler::make_units(std::span<const std::size_t> closures) {
  const Molecule& molecule = checker_.molecule();
  const DofSelection& selection = checker_.selection();
  const RigidGroups& groups = checker_.rigid_groups();
  std::vector<bool> in_cycle(selection.size(), false);
  if (!closures.empty()) in_cycle = ClosureSolver(molecule.model().tree(), selection, closures).dofs_in_cycles();
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> places;  // position -> placed part, component
  for (std::size_t part = 0; part < molecule.placed_parts().size(); ++part)
    for (std::size_t c = 0; c < 6; ++c)
      places[position_of(selection, molecule.placed_parts()[part].dofs[c])] = {part, c};
  for (std::size_t g = 1; g < groups.size(); ++g) {
    const std::size_t position = groups[id<GroupId>(g)].dof;
    Unit unit;
    unit.groups.first = id<GroupId>(g);
    const auto placed = places.find(position);
    if (placed != places.end())
      unit.part = placed->second.first;
    else
      unit.residue = molecule.torsions()[molecule.torsion_of(selection.dofs()[position])].residue;
    unit.is_closed = in_cycle[position] && (solver_ || is_loop_end(molecule, *unit.residue));
    if (units_.empty() || units_.back().part != unit.part || units_.back().residue != unit.residue ||
        units_.back().is_closed != unit.is_closed) {
      if (!units_.empty()) units_.back().groups.end = unit.groups.first;
      if (unit.part) unit.positions.resize(6);
      units_.push_back(std::move(unit));
    }
    if (placed != places.end())
      units_.back().positions[placed->second.second] = position;
    else
      units_.back().positions.push_back(position);
  }
  if (!solver_)
    for (const std::size_t closure : closures) add_loop(molecule.loops()[*loop_of(molecule, closure)], closure);
  for (std::size_t u = 0; u < units_.size();) {
    Step step{u, {}};
    for (std::size_t k = 0; k < loop_ends_.size(); ++k)
      if (loop_ends_[k].first == u) step.loop = k;
    u = step.loop ? loop_ends_[*step.loop].end : u + 1;
    steps_.push_back(step);
  }
}

/// Finds the units of a loop's end, and how far the rest of the loop reaches from each unit before it.
void FreeSampler::add_loop(const Loop& loop, std::size_t closure) {
  const Structure& s = checker_.molecule().structure();
  const auto at = [&](std::uint32_t residue, std::string_view name) {
    return s.models.front()[atom_of(s, residue, name)];
  };
  const auto in_loop = [&](const Unit& unit) {
    return unit.residue && loop.first <= *unit.residue && *unit.residue <= loop.last;
  };
  const auto in_end = [&](const Unit& unit) {
    return in_loop(unit) && loop.last - *unit.residue < residues_of_loop_end;
  };
  const auto first = std::find_if(units_.begin(), units_.end(), in_end);
  const auto end = std::find_if_not(first, units_.end(), in_end);
  std::vector<std::size_t> held;
  for (auto unit = units_.begin(); unit != units_.end(); ++unit) {
    if (unit < first || unit >= end || !unit->is_closed)
      held.insert(held.end(), unit->positions.begin(), unit->positions.end());
    if (!in_loop(*unit) || in_end(*unit)) continue;
    unit->atom = atom_of(s, *unit->residue + 1, "N");
    unit->end = at(loop.last, "CA");
    for (std::uint32_t r = *unit->residue + 1; r <= loop.last; ++r) {
      unit->reach += norm(Vec3(at(r, "CA") - at(r, "N")));
      if (r < loop.last) unit->reach += norm(Vec3(at(r + 1, "N") - at(r, "CA")));
    }
  }
  const std::array closures{closure};
  loop_ends_.push_back({static_cast<std::size_t>(first - units_.begin()),
                        static_cast<std::size_t>(end - units_.begin()),
                        ClosureSolver(checker_.molecule().model().tree(), checker_.selection(), closures, {}, held)});
}

void FreeSampler::draw(std::size_t unit, SampleStream& stream, std::span<double> q) const {
  const Unit& drawn = units_[unit];
  if (!drawn.part && reference_share_ > 0.0 && stream.uniform() < reference_share_) {
    for (const std::size_t k : drawn.positions) q[k] = reference_spread * stream.normal();
    return;
  }
  if (!drawn.part) return prior_->draw(unit, stream, q);
  const std::array<double, 6> values = sample_placement(stream, ranges_[*drawn.part]);
  for (std::size_t c = 0; c < 6; ++c) q[drawn.positions[c]] = values[c];
}

bool FreeSampler::place(std::size_t u, SampleStream& stream, std::span<double> q) {
  const Unit& unit = units_[u];
  for (std::uint32_t k = 0; k < (unit.is_closed ? 1 : options_.most_draws); ++k) {
    if (!unit.is_closed) draw(u, stream, q);
    if (!checker_.collides_in(q, unit.groups) &&
        (!unit.atom || norm(Vec3(checker_.position(*unit.atom) - unit.end)) <= unit.reach))
      return true;
  }
  blocked_ = unit.groups;
  return false;
}

bool FreeSampler::close_loop(LoopEnd& loop, SampleStream& stream, std::span<double> q, bool& closed) {
  for (std::uint32_t k = 0; k < options_.most_draws; ++k) {
    for (std::size_t u = loop.first; u < loop.end; ++u)
      if (units_[u].is_closed) draw(u, stream, q);
    if (!loop.solver.close(q)) continue;
    closed = true;
    bool is_free = true;
    for (std::size_t u = loop.first; is_free && u < loop.end; ++u) is_free = place(u, stream, q);
    if (is_free) return true;
  }
  return false;
}

FreeSampler::Outcome FreeSampler::grow(SampleStream& stream, std::span<double> q) {
  std::size_t furthest = 0, returns = 0;
  for (std::size_t step = 0; step < steps_.size();) {
    const Step& now = steps_[step];
    bool closed = true;
    if (now.loop ? close_loop(loop_ends_[*now.loop], stream, q, closed) : place(now.unit, stream, q)) {
      ++step;
      if (step > furthest) {
        furthest = step;
        returns = 0;
      }
      continue;
    }
    // All values of the last residue may lead to the same dead end, so later returns go back further.
    if (++returns > options_.most_returns) return closed ? Outcome::blocked : Outcome::open;
    step -= std::min(step, 1 + returns / returns_per_residue);
  }
  return Outcome::grown;
}

FreeSample FreeSampler::sample(std::uint64_t index, const std::function<bool()>& stop) {
  FreeSample result;
  SampleStream stream(options_.sampling.seed, index);
  std::vector<double> q(checker_.dof_count()), last;
  for (std::uint64_t k = 0; k < options_.most_starts; ++k) {
    if (stop && stop()) {
      result.stopped = true;
      break;
    }
    if (options_.prior == Prior::ramachandran)
      reference_share_ = std::min(most_reference, reference_step * static_cast<double>(k));
    if (solver_) {
      for (std::size_t u = 0; u < units_.size(); ++u) draw(u, stream, q);
      if (!solver_->close(q)) {
        ++result.unclosed;
        continue;
      }
    }
    const Outcome outcome = grow(stream, q);
    if (outcome == Outcome::grown) {
      result.q = std::move(q);
      return result;
    }
    ++(outcome == Outcome::open ? result.unclosed : result.dead_ends);
    if (outcome == Outcome::blocked) last = q;
  }
  if (!last.empty()) {
    checker_.collides_in(last, blocked_);
    result.blockers = checker_.collisions_in(blocked_);
  }
  return result;
}

}  // namespace hinge::molecular
