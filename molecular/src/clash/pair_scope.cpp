// SPDX-License-Identifier: BSD-3-Clause
// Classifies atoms by the parts that contain them, and finds the pairs of classes to test.
#include "hinge/molecular/pair_scope.hpp"

#include <algorithm>
#include <map>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

PairScope::PairScope(const Structure& structure, std::span<const std::pair<Part, Part>> between,
                     std::span<const Part> inside) {
  if (between.empty() && inside.empty()) return;
  // Per atom: is it in part k? Order: the two parts of each `between`, then the parts of `inside`.
  const std::size_t parts = 2 * between.size() + inside.size();
  std::vector<std::vector<bool>> held(structure.atoms.size(), std::vector<bool>(parts, false));
  const auto hold = [&](const Part& part, std::size_t position) {
    const std::vector<bool> in = atoms_in(structure, part);
    for (std::size_t atom = 0; atom < in.size(); ++atom) held[atom][position] = in[atom];
  };
  for (std::size_t k = 0; k < between.size(); ++k) {
    const auto& [a, b] = between[k];
    for (const std::uint32_t r : a.residues)
      if (std::ranges::binary_search(b.residues, r))
        throw ModelError("between '" + a.name + "' and '" + b.name + "': both parts hold " +
                         residue_label(structure, r) + ", expected two parts without common residues");
    hold(a, 2 * k);
    hold(b, 2 * k + 1);
  }
  for (std::size_t k = 0; k < inside.size(); ++k) hold(inside[k], 2 * between.size() + k);

  Data data;
  std::map<std::vector<bool>, std::uint32_t> kinds;
  for (const std::vector<bool>& in : held)
    data.kind.push_back(kinds.emplace(in, static_cast<std::uint32_t>(kinds.size())).first->second);
  data.kinds = kinds.size();
  data.asked.assign(data.kinds * data.kinds, 0);
  for (const auto& [a, s] : kinds)
    for (const auto& [b, t] : kinds) {
      bool asked = false;
      for (std::size_t k = 0; k < 2 * between.size(); k += 2) asked = asked || (a[k] && b[k + 1]) || (a[k + 1] && b[k]);
      for (std::size_t k = 2 * between.size(); k < parts; ++k) asked = asked || (a[k] && b[k]);
      data.asked[s * data.kinds + t] = asked ? 1 : 0;
    }
  data_ = std::make_shared<const Data>(std::move(data));
}

}  // namespace hinge::molecular
