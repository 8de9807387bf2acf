// SPDX-License-Identifier: BSD-3-Clause
// PartPlacer: adds the six joints of each placed part. The molecules of the part are attached to the last of them.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/model/model.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::molecular {

/// Builds the joints of placed parts on demand. Keeps references to the parts, which must outlive it.
class PartPlacer {
 public:
  /// Sets the centres of `placed` (angstrom, model 0). Throws ModelError if a part is empty, shares atoms with another
  /// part, or is bonded to an atom outside it.
  PartPlacer(const Structure& structure, std::span<PlacedPart> placed);

  /// Returns the link to attach this atom's molecule to: the world, or the last of the six links that place its part.
  /// The first call for a part adds these links to `model` and sets the part's `dofs`.
  LinkId base_of(std::uint32_t atom, ModelBuilder<Point>& model);

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::span<PlacedPart> placed_;
  std::vector<std::uint32_t> part_of_;  // per atom: index in placed_, or none
  std::vector<LinkId> base_;            // per part; world until the links are added
};

}  // namespace hinge::molecular
