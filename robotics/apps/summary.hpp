// SPDX-License-Identifier: BSD-3-Clause
// Summary: the counts over the configurations of a check.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "report.hpp"

namespace robocd {

/// Names of two links, or of a link and a body.
using NamedPair = std::pair<std::string, std::string>;

struct Summary {
  static constexpr std::size_t shown_pairs = 10;  // longer lists are not read

  std::uint64_t checked = 0;
  std::uint64_t colliding = 0;
  std::map<NamedPair, std::uint64_t> pairs;

  /// Adds an answer with the names of its pairs.
  void add(bool collides, std::vector<NamedPair> names);
  /// Returns the most frequent pairs, most frequent first.
  std::vector<std::pair<NamedPair, std::uint64_t>> top() const;
  /// error: message of the error that ended the run early; empty: none.
  Json json(const std::string& error = {}) const;
};

}  // namespace robocd
