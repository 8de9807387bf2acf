// SPDX-License-Identifier: BSD-3-Clause
// Finds what can be left out of a molecule's scene without a change of any answer.
#include "dial_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge_tools/counted.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::tool::counted;

namespace {

/// A ball that an atom cannot leave, about a point of the fixed group.
struct Ball {
  hinge::Vec3 centre = hinge::Vec3::Zero();
  double radius = 0.0;
};

}  // namespace

std::vector<std::uint32_t> unreachable_atoms(const Job& job) {
  const Molecule& molecule = *job.molecule;
  const Checker& checker = job.checker;
  const Structure& s = molecule.structure();
  const auto& positions = s.models.front();
  const auto& tree = molecule.model().tree();
  const auto dofs = checker.selection().dofs();
  if (!molecule.placed_parts().empty()) return {};
  // Balls by the first free torsion of the chain from the fixed group to the atom. A torsion turns about a bond, so the
  // second atom of the bond is at rest against the links on both sides.
  std::map<hinge::DofId, Ball> balls;
  std::vector<std::uint32_t> fixed;
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) {
    if (checker.group_of(i) == hinge::GroupId{0}) {
      fixed.push_back(i);
      continue;
    }
    hinge::Vec3 last = positions[i];
    double length = 0.0;
    std::optional<hinge::DofId> first;
    for (hinge::LinkId link = molecule.model().links()[i]; link != hinge::LinkId{0}; link = tree.parent(link)) {
      if (!tree.joint(link).has_dof() || !std::ranges::binary_search(dofs, tree.dof_of(link))) continue;
      first = tree.dof_of(link);
      const std::size_t torsion = molecule.torsion_of(*first);
      if (torsion == Molecule::no_torsion) return {};
      const hinge::Vec3 pivot = positions[molecule.torsions()[torsion].atoms[2]];
      length += hinge::norm(hinge::Vec3(last - pivot));
      last = pivot;
    }
    if (!first) return {};
    Ball& ball = balls[*first];
    ball.centre = last;
    ball.radius = std::max(ball.radius, length);
  }
  const Thresholds& t = checker.thresholds();
  const std::size_t types = t.type_names.size();
  std::vector<double> longest(types, 0.0);  // threshold of a type
  for (std::size_t a = 0; a < types; ++a)
    for (std::size_t b = 0; b < types; ++b) longest[a] = std::max(longest[a], t.between(a, b));
  constexpr double rounding = 1e-6;  // angstrom, far above that of the sums
  std::vector<std::uint32_t> unreachable;
  for (const std::uint32_t i : fixed) {
    const double threshold = longest[t.matrix.type(hinge::id<hinge::PrimitiveId>(i))] + rounding;
    if (std::ranges::none_of(balls, [&](const auto& entry) {
          return hinge::norm(hinge::Vec3(positions[i] - entry.second.centre)) <= entry.second.radius + threshold;
        }))
      unreachable.push_back(i);
  }
  return unreachable;
}

std::vector<hinge::tool::DialRequirement> study_scene(const Job& job) {
  const Checker& checker = job.checker;
  const std::size_t atoms = job.molecule->structure().atoms.size();
  std::map<hinge::GroupId, std::size_t> sizes;
  for (std::uint32_t i = 0; i < atoms; ++i) ++sizes[checker.group_of(i)];
  std::size_t largest = 0;
  double pairs = 0.0, inside = 0.0;
  for (const auto& [group, size] : sizes) {
    largest = std::max(largest, size);
    inside += 0.5 * static_cast<double>(size) * static_cast<double>(size - 1);
  }
  pairs = 0.5 * static_cast<double>(atoms) * static_cast<double>(atoms - 1);
  std::vector<hinge::tool::DialRequirement> requirements;
  requirements.push_back(
      {fmt::format("{} move as {}, the largest of {}: {} of all pairs are inside a group, and are left "
                   "out already",
                   counted(atoms, "atom"), counted(sizes.size(), "rigid group"), counted(largest, "atom"),
                   hinge::tool::percent_text(inside / std::max(1.0, pairs))),
       "",
       {}});
  const std::vector<std::uint32_t> unreachable = unreachable_atoms(job);
  std::vector<std::string> items;
  for (const std::uint32_t i : unreachable)
    items.push_back(fmt::format("{} {}", i, label(job.molecule->structure(), i)));
  if (!unreachable.empty())
    requirements.push_back(
        {fmt::format("{} of these never meet a moving atom: proved for all values of the free torsions",
                     counted(unreachable.size(), "atom")),
         "", items});
  return requirements;
}

}  // namespace biocd
