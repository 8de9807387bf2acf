// SPDX-License-Identifier: BSD-3-Clause
// Draws random conformations from the counter-based random stream.
#include "hinge/molecular/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/detail/core/sincos.hpp"
#include "hinge/detail/simd/fill_random.hpp"
#include "motion/draw_turn.hpp"

namespace hinge::molecular {

namespace {

/// Returns sin^2 of half the rotation angle of Rx(a) Ry(b) Rz(c): the squared vector part of the product of the three
/// quaternions.
double squared_half_sine(double a, double b, double c) noexcept {
  const detail::SinCos x = detail::sincos(a / 2), y = detail::sincos(b / 2), z = detail::sincos(c / 2);
  const double i = x.sin * y.cos * z.cos + x.cos * y.sin * z.sin;
  const double j = x.cos * y.sin * z.cos - x.sin * y.cos * z.sin;
  const double k = x.cos * y.cos * z.sin + x.sin * y.sin * z.cos;
  return i * i + j * j + k * k;
}

}  // namespace

std::vector<double> draw_configuration(const Sampling& sampling, SampleStream& stream, std::size_t dof_count) {
  std::vector<double> q(dof_count);
  if (sampling.sigma) {
    detail::simd::fill_normal(stream, q);
    for (double& value : q) value *= *sampling.sigma;
  } else {
    detail::simd::fill_uniform(stream, q);
    for (double& value : q) value = turn_of(value);
  }
  return q;
}

std::vector<double> sample_configuration(const Sampling& sampling, std::uint64_t index, std::size_t dof_count) {
  SampleStream stream(sampling.seed, index);
  return draw_configuration(sampling, stream, dof_count);
}

// Rejection sampling: its arithmetic gives the same bits on every machine. At least one ninth of the tries is accepted.
std::array<double, 6> sample_placement(SampleStream& stream, const PlacementRange& range) {
  std::array<double, 6> q{};
  if (range.distance > 0.0) {
    double x = 0.0, y = 0.0, z = 0.0;
    do {
      x = 2.0 * stream.uniform() - 1.0;
      y = 2.0 * stream.uniform() - 1.0;
      z = 2.0 * stream.uniform() - 1.0;
    } while (x * x + y * y + z * z > 1.0);
    q[0] = range.distance * x;
    q[1] = range.distance * y;
    q[2] = range.distance * z;
  }
  if (range.turn > 0.0) {
    // The invariant measure of rotations is |cos b| da db dc. A rotation by at most a quarter turn moves no axis by
    // more than its own angle, so |a|, |b| and |c| are at most that angle: draw them from [-side, side].
    const double quarter = std::numbers::pi / 2;
    const double side = range.turn <= quarter ? range.turn : std::numbers::pi;
    const double half_sine = detail::sincos(range.turn / 2).sin;
    const bool any = range.turn >= std::numbers::pi;
    do {
      do {
        q[4] = std::min(side, quarter) * (2.0 * stream.uniform() - 1.0);
      } while (stream.uniform() > detail::sincos(q[4]).cos);
      q[3] = side * (1.0 - 2.0 * stream.uniform());
      q[5] = side * (1.0 - 2.0 * stream.uniform());
    } while (!any && squared_half_sine(q[3], q[4], q[5]) > half_sine * half_sine);
  }
  return q;
}

std::vector<double> sample_configuration(const Sampling& sampling, std::uint64_t index, const Molecule& molecule,
                                         const DofSelection& selection, std::span<const PlacementRange> ranges) {
  const auto placed = molecule.placed_parts();
  if (ranges.size() != placed.size())
    throw ModelError(std::to_string(ranges.size()) + " ranges of placements, expected one for each of " +
                     std::to_string(placed.size()) + " placed parts");
  if (placed.empty()) return sample_configuration(sampling, index, selection.size());
  std::vector<double> of_dof(molecule.model().tree().dof_count());
  std::vector<bool> places(of_dof.size(), false);
  for (const PlacedPart& part : placed)
    for (const DofId dof : part.dofs) places[hinge::index(dof)] = true;
  // One for each DOF, which is more than the torsions need.
  const std::vector<double> turns = sample_configuration(sampling, index, selection.size());
  auto turn = turns.begin();
  for (const DofId dof : selection.dofs())
    if (!places[hinge::index(dof)]) of_dof[hinge::index(dof)] = *turn++;
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const PlacementRange& range = ranges[k];
    if (!is_length(range.distance) || range.distance < 0.0 || !(range.turn >= 0.0 && range.turn <= std::numbers::pi))
      throw ModelError("placing '" + placed[k].part.name + "' within " + number_text(range.distance) +
                       " angstrom and " + number_text(range.turn) +
                       " rad: expected a finite distance >= 0 and a turn from 0 to pi");
    SampleStream own(sampling.seed, index, static_cast<std::uint32_t>(k + 1));
    const std::array<double, 6> q = sample_placement(own, range);
    for (std::size_t c = 0; c < 6; ++c) of_dof[hinge::index(placed[k].dofs[c])] = q[c];
  }
  std::vector<double> q;
  for (const DofId dof : selection.dofs()) q.push_back(of_dof[hinge::index(dof)]);
  return q;
}

}  // namespace hinge::molecular
