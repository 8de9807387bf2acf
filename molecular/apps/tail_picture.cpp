// SPDX-License-Identifier: BSD-3-Clause
// Draws the backbone, samples of the last residues, and clashes.
#include "tail_picture.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <numbers>
#include <set>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge_tools/picture.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::tool::Colour;
using hinge::tool::Picture;

namespace {

constexpr std::size_t tail_residues = 7;
constexpr Colour body_colour{175, 185, 200}, free_colour{70, 150, 90}, hit_colour{215, 60, 50},
    faint_hit{235, 165, 155};

/// The alpha carbons of the first chain of amino acids that has more than tail_residues; empty: there is none.
std::vector<std::uint32_t> alpha_carbons(const Structure& s) {
  for (std::size_t c = 0; c < s.chains.size(); ++c) {
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0; i < s.atoms.size(); ++i) {
      const Residue& residue = s.residues[s.atoms[i].residue];
      if (residue.chain == c && residue.kind == ResidueKind::amino_acid && s.atoms[i].name == "CA")
        found.push_back(static_cast<std::uint32_t>(i));
    }
    if (found.size() > tail_residues) return found;
  }
  return {};
}

void draw_trace(Picture& picture, std::span<const hinge::Vec3> positions, std::span<const std::uint32_t> trace,
                double thickness, const Colour& colour) {
  for (std::size_t k = 1; k < trace.size(); ++k)
    picture.rod(positions[trace[k - 1]], positions[trace[k]], thickness, colour);
}

}  // namespace

std::string draw_tail(const std::shared_ptr<const Molecule>& molecule, const CheckOptions& rules, std::uint64_t seed,
                      std::uint64_t count) {
  const Structure& s = molecule->structure();
  const std::vector<std::uint32_t> trace = alpha_carbons(s);
  if (trace.empty()) return {};
  const auto tail = std::span(trace).last(tail_residues);
  const std::uint32_t first = s.atoms[tail.front()].residue, last = s.atoms[tail.back()].residue;
  std::vector<std::size_t> torsions = select_torsions(*molecule, "all", false);
  std::erase_if(torsions, [&](std::size_t k) {
    const std::uint32_t residue = molecule->torsions()[k].residue;
    return residue < first || residue > last;
  });
  Checker checker(molecule, molecule->select(torsions), rules);

  const std::vector<hinge::Vec3>& native = s.models.front();
  hinge::Vec3 middle = hinge::Vec3::Zero(), end = hinge::Vec3::Zero();
  for (const std::uint32_t i : trace) middle += native[i] / static_cast<double>(trace.size());
  for (const std::uint32_t i : tail) end += native[i] / static_cast<double>(tail.size());
  const hinge::Vec3 side = (end - middle).normalized();
  Picture picture(side.unitOrthogonal(), side.cross(side.unitOrthogonal()));
  draw_trace(picture, native, std::span(trace).first(trace.size() - tail_residues + 1), 1.1, body_colour);

  std::uint64_t free = 0;
  bool clashes_drawn = false;
  const Sampling sampling{seed, 5 * std::numbers::pi / 180};
  for (std::uint64_t k = 0; k < count; ++k) {
    const Verdict verdict = checker.check(sample_configuration(sampling, k, checker.dof_count()), Mode::parse("all"));
    const std::vector<hinge::Vec3> positions = checker.positions();
    free += verdict.collides ? 0 : 1;
    const bool marked = verdict.collides && !clashes_drawn;
    draw_trace(picture, positions, tail, marked ? 0.9 : 0.35,
               !verdict.collides ? free_colour
               : marked          ? hit_colour
                                 : faint_hit);
    if (!marked) continue;
    clashes_drawn = true;
    std::set<std::uint32_t> residues;  // drawn with their side chains
    for (const Contact& pair : verdict.pairs)
      for (const hinge::PrimitiveId i : {pair.hit.first, pair.hit.second})
        residues.insert(s.atoms[hinge::index(i)].residue);
    for (const Bond& bond : s.bonds)
      if (residues.contains(s.atoms[bond.first].residue) && residues.contains(s.atoms[bond.second].residue))
        picture.rod(positions[bond.first], positions[bond.second], 0.3, {90, 90, 90});
    for (const Contact& pair : verdict.pairs) {
      const hinge::Vec3 &a = positions[hinge::index(pair.hit.first)], &b = positions[hinge::index(pair.hit.second)];
      picture.ball(a, 0.6, hit_colour);
      picture.ball(b, 0.6, hit_colour);
      picture.rod(a, b, 0.3, {60, 0, 0});
    }
  }
  hinge::tool::Svg svg(520, 420);
  svg.text({12, 24},
           fmt::format("{}, last {} residues: {} of {} samples free (green)", s.name, tail_residues, free, count),
           "start", "font-weight=\"bold\"");
  picture.draw(svg, 20, 40, 480, 360);
  return svg.document();
}

}  // namespace biocd
