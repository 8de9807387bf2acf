// SPDX-License-Identifier: BSD-3-Clause
// PartPlacer: gives placed parts the six joints that their molecules hang on.
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

class PartPlacer {
 public:
  /// Finds the centres. ModelError: see Molecule.
  PartPlacer(const Structure& structure, std::span<PlacedPart> placed);

  /// The link that what this atom is bonded to hangs on: the world, or the last of the six that place its part, which
  /// are added when first asked for.
  LinkId base_of(std::uint32_t atom, ModelBuilder<Point>& model);

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::span<PlacedPart> placed_;
  std::vector<std::uint32_t> part_of_;  // by atom: position in placed_, or none
  std::vector<LinkId> base_;            // by part; the world until it is there
};

}  // namespace hinge::molecular
