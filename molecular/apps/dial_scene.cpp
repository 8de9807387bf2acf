// SPDX-License-Identifier: BSD-3-Clause
// Finds what can be left out of a molecule's scene without a change of any answer.
#include "dial_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge_tools/counted.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::tool::counted;

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
  const std::vector<std::uint32_t> out_of_reach = checker.out_of_reach();
  std::vector<std::string> items;
  for (const std::uint32_t i : out_of_reach)
    items.push_back(fmt::format("{} {}", i, label(job.molecule->structure(), i)));
  if (!out_of_reach.empty())
    requirements.push_back(
        {fmt::format("{} of the fixed group never meet a moving atom: proved for all values of the free torsions, "
                     "and left out already where no distance is asked for",
                     counted(out_of_reach.size(), "atom")),
         "", items});
  return requirements;
}

}  // namespace biocd
