// SPDX-License-Identifier: BSD-3-Clause
// Runs points with thresholds by type. Each group is a link, because pairs inside a group are not tested.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/primitive/point.hpp"
#include "robustness/ask.hpp"

namespace hinge::robustness {

/// Returns the excluded pairs of a case. Throws ModelError: an atom with itself, or an unknown atom.
inline test::ExcludedPairs exclusions_of(const Atoms& atoms) {
  const std::vector<std::int64_t>& pairs = atoms.excluded;
  std::vector<std::vector<PrimitiveId>> excluded(atoms.type.size());
  if (pairs.size() % 2 != 0) throw ModelError("excluded pairs: an odd number of atoms");
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) {
    const std::string who = "excluded pair (" + std::to_string(pairs[k]) + ", " + std::to_string(pairs[k + 1]) + "): ";
    for (const std::int64_t atom : {pairs[k], pairs[k + 1]})
      if (atom < 0 || atom >= static_cast<std::int64_t>(excluded.size()))
        throw ModelError(who + "expected atoms below " + std::to_string(excluded.size()));
    if (pairs[k] == pairs[k + 1]) throw ModelError(who + "an atom with itself");
    const auto i = static_cast<std::size_t>(pairs[k]), j = static_cast<std::size_t>(pairs[k + 1]);
    excluded[i].push_back(id<PrimitiveId>(j));
    excluded[j].push_back(id<PrimitiveId>(i));
  }
  return test::ExcludedPairs(std::move(excluded));
}

/// Finds the smallest distance over all pairs, independent of thresholds. Thresholds are >= 0, so a pair with d - M
/// above the smallest distance is not closer.
class Shortest {
 public:
  static constexpr bool ranks = true;
  void add(const Hit& hit) noexcept {
    best_ = std::min(best_, hit.distance);
    any_ = true;
  }
  double cutoff() const noexcept { return best_; }
  bool done() const noexcept { return false; }
  bool any() const noexcept { return any_; }
  double distance() const noexcept { return best_; }

 private:
  double best_ = std::numeric_limits<double>::infinity();
  bool any_ = false;
};

inline void check_lengths(const Atoms& atoms) {
  const auto check = [](std::size_t found, std::int64_t wanted, const char* what) {
    if (wanted < 0 || found != static_cast<std::size_t>(wanted))
      throw ModelError(std::string(what) + ": " + std::to_string(found) + ", expected " + std::to_string(wanted));
  };
  check(atoms.x.size(), 3 * atoms.count, "coordinates");
  check(atoms.type.size(), atoms.count, "types");
  check(atoms.group.size(), atoms.count, "groups");
}

/// Each group is on its own prismatic joint and stays at the reference, where points keep their coordinates.
inline Model<Point> model_of(const Atoms& atoms) {
  ModelBuilder<Point> builder;
  std::map<std::int64_t, LinkId> links;
  for (std::size_t i = 0; i < atoms.group.size(); ++i) {
    const auto [link, is_new] = links.try_emplace(atoms.group[i], world);
    if (is_new) link->second = builder.add_link(world, Prismatic{});
    builder.add_primitive(link->second, Point{Vec3(atoms.x[3 * i], atoms.x[3 * i + 1], atoms.x[3 * i + 2])});
  }
  return builder.finish();
}

inline TypedThresholds thresholds_of(const Atoms& atoms) {
  constexpr std::int64_t most = std::numeric_limits<std::uint16_t>::max();
  std::vector<std::uint16_t> types;
  for (const std::int64_t type : atoms.type) {
    if (type < 0 || type > most) throw ModelError("type " + std::to_string(type) + ": expected 0 to 65535");
    types.push_back(static_cast<std::uint16_t>(type));
  }
  if (atoms.type_count < 0 || atoms.type_count > most)
    throw ModelError(std::to_string(atoms.type_count) + " types: expected 0 to 65535");
  return {std::move(types), static_cast<std::size_t>(atoms.type_count), atoms.thresholds};
}

template <template <class, class, class> class EngineOf>
Answer run_atoms(const Atoms& atoms) {
  return asked("a link per group", [&] {
    check_lengths(atoms);
    const test::ExcludedPairs filter = exclusions_of(atoms);
    Hierarchy<Point, test::ExcludedPairs, TypedThresholds, EngineOf> points(model_of(atoms), filter,
                                                                            thresholds_of(atoms));
    Answer answer;
    take_hits(answer, points.self_collides(), points.self_collisions());
    Shortest shortest;
    points.self_query(shortest);
    if (shortest.any()) answer.distance = shortest.distance();
    if (points.self_closest().has_value() != shortest.any()) contradict(answer, "closest pair and distances differ");
    return answer;
  });
}

}  // namespace hinge::robustness
