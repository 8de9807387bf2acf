// SPDX-License-Identifier: BSD-3-Clause
// counted: numbers with their nouns, singular or plural.
#pragma once

#include <cstdint>
#include <string>

#include "hinge/core/number_text.hpp"

namespace hinge::tool {

/// Returns the noun for n things: "pair" for 1, otherwise "pairs". plural: for nouns that take more than an s.
inline std::string noun_of(std::uint64_t n, const std::string& noun, const std::string& plural = {}) {
  if (n == 1) return noun;
  return plural.empty() ? noun + "s" : plural;
}

/// Returns the number with its noun, such as "1 pair" or "2 pairs".
inline std::string counted(std::uint64_t n, const std::string& noun, const std::string& plural = {}) {
  return number_text(n) + ' ' + noun_of(n, noun, plural);
}

/// Returns a sentence about a part of all things: "1 of 3 models collides", "2 of 3 models collide".
inline std::string collide_text(std::uint64_t part, std::uint64_t all, const std::string& noun) {
  return number_text(part) + " of " + counted(all, noun) + (part == 1 || all == 1 ? " collides" : " collide");
}

}  // namespace hinge::tool
