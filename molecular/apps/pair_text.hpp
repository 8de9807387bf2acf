// SPDX-License-Identifier: BSD-3-Clause
// PairText: the list of pairs of a verdict as JSON text. Outputs may have millions of pairs.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hinge_tools/json_writer.hpp"
#include "report.hpp"

namespace biocd {

/// Writes pairs with the bytes of pair_json(). Any number of threads may use one.
class PairText {
 public:
  /// The job must outlive this object.
  explicit PairText(const Job& job);

  /// Returns the JSON array of the pairs.
  std::string list(std::span<const hinge::molecular::Contact> pairs) const;

 private:
  void append(hinge::tool::JsonWriter& text, const hinge::molecular::Contact& pair) const;

  const Job& job_;
  bool has_classes_, has_relative_distance_;
  std::vector<std::string> labels_;  // of each atom, quoted
};

}  // namespace biocd
