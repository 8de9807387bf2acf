// SPDX-License-Identifier: BSD-3-Clause
// Contestants: the engines of this project and their peers with one interface, for the same queries.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "oracle/fcl_oracle.hpp"
#include "peers/brute_simd.hpp"
#include "peers/chain_tree.hpp"
#include "peers/gemmi_neighbors.hpp"
#include "peers/grid.hpp"
#include "peers/nanoflann.hpp"
#include "scene.hpp"

namespace hinge::bench {

/// any: yes/no. counted: the number of colliding pairs. all: their sorted list. within: the same for a margin.
enum class Query : std::uint8_t { any, counted, all, within, closest };
inline constexpr Query all_queries[] = {Query::any, Query::counted, Query::all, Query::within, Query::closest};
inline constexpr const char* query_names[] = {"any", "counted", "all", "within", "closest"};
inline const char* name(Query q) { return query_names[static_cast<std::size_t>(q)]; }
inline constexpr double margin = 1.0;  // angstrom: margin of "within" queries, usual for lists of native contacts

struct Answer {
  bool collides = false;
  std::size_t count = 0;
  PairList pairs;
  double gap = std::numeric_limits<double>::infinity();

  /// Forgets the answer and keeps the memory of the list.
  void clear() noexcept {
    collides = false;
    count = 0;
    pairs.clear();
    gap = std::numeric_limits<double>::infinity();
  }
};

/// tolerance: of the gap, in angstrom; 0 for contestants that use the same formula in double.
inline bool same(const Answer& a, const Answer& b, double tolerance = 0.0) {
  return a.collides == b.collides && a.count == b.count && a.pairs == b.pairs &&
         (a.gap == b.gap || std::abs(a.gap - b.gap) <= tolerance);  // infinite gaps are equal, their difference is NaN
}

/// prepare: passes coordinates or poses, not timed. ask: update and query, timed.
struct Contestant {
  std::string name;
  std::function<void(const Conformation&)> prepare;
  std::function<void(Query, Answer&)> ask;
};

/// Counts colliding pairs.
class PairCounter {
 public:
  static constexpr bool ranks = false;
  void add(const Hit&) noexcept { ++count_; }
  double cutoff() const noexcept { return 0.0; }
  bool done() const noexcept { return false; }
  std::size_t count() const noexcept { return count_; }

 private:
  std::size_t count_ = 0;
};

template <class H>
void ask_hierarchy(H& hierarchy, Query query, Answer& answer) {
  switch (query) {
    case Query::any: answer.collides = hierarchy.self_collides(); return;
    case Query::counted: {
      PairCounter pairs;
      hierarchy.self_query(pairs);
      answer.count = pairs.count();
      return;
    }
    case Query::all: answer.pairs = hierarchy.self_collisions(); return;
    case Query::within: answer.pairs = hierarchy.self_within(margin); return;
    case Query::closest:
      if (const auto hit = hierarchy.self_closest()) answer.gap = hit->gap();
      return;
  }
}

/// A link of the rigid group with the highest index. Computing its pose computes the poses of all groups.
template <class H>
LinkId last_link(const H& hierarchy) {
  const RigidGroups& groups = *hierarchy.model().groups();
  const auto links = hierarchy.model().model().tree().link_count();
  LinkId last{};
  for (std::size_t l = 0; l < links; ++l)
    if (index(groups.group_of(id<LinkId>(l))) > index(groups.group_of(last))) last = id<LinkId>(l);
  return last;
}

/// prepare() computes poses and, unless `from_poses`, coordinates, so both are outside the timed part.
template <template <class, class, class> class EngineOf>
Contestant engine(const Scene& scene, std::string name, bool from_poses) {
  const auto h = std::make_shared<Molecular<EngineOf>>(scene.make<EngineOf>());
  const LinkId last = last_link(*h);
  return {std::move(name),
          [=](const Conformation& c) {
            h->update(c.q);
            if (from_poses)
              h->link_pose(last);
            else
              h->placed();
          },
          [=](Query query, Answer& answer) { ask_hierarchy(*h, query, answer); }};
}

/// A contestant from a peer (see peers/peer.hpp); coordinates are passed outside the timed part.
template <class Peer>
Contestant peer(const Scene& scene, std::string name) {
  const auto p = std::make_shared<Peer>(scene.input());
  const auto xyz = std::make_shared<std::vector<double>>();
  return {std::move(name), [=](const Conformation& c) { *xyz = c.xyz; },
          [=](Query query, Answer& answer) {
            p->update(*xyz);
            switch (query) {
              case Query::any: answer.collides = p->any(); return;
              case Query::counted: answer.count = p->count(); return;
              case Query::all: return p->within(0.0, answer.pairs);
              case Query::within: return p->within(margin, answer.pairs);
              case Query::closest: answer.gap = p->closest(); return;
            }
          }};
}

/// Adds distances to FCL's pairs and sorts them.
inline void list_fcl(const oracle::Pairs& found, std::span<const oracle::Position> at, const PeerInput& input,
                     PairList& out) {
  out.clear();
  for (const auto& [i, j] : found) {
    const double dx = at[i][0] - at[j][0], dy = at[i][1] - at[j][1], dz = at[i][2] - at[j][2];
    out.push_back({id<PrimitiveId>(i), id<PrimitiveId>(j), std::sqrt(dx * dx + dy * dy + dz * dz),
                   input.threshold(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j))});
  }
  detail::sort_hits(out);
}

/// Has no `within` list. Finds the closest pair only if nothing collides: its manager cannot rank penetrations.
inline Contestant fcl(const Scene& scene) {
  const auto input = scene.input();
  const auto manager = std::make_shared<oracle::FclSpheres>(scene.radii(), [input](std::size_t i, std::size_t j) {
    return input->admits(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
  });
  const auto positions = std::make_shared<std::vector<oracle::Position>>();
  const auto moved = std::make_shared<std::vector<std::size_t>>(scene.moved().begin(), scene.moved().end());
  return {"fcl",
          [=](const Conformation& c) {
            positions->clear();
            for (std::size_t i = 0; i < c.xyz.size(); i += 3)
              positions->push_back({c.xyz[i], c.xyz[i + 1], c.xyz[i + 2]});
          },
          [=](Query query, Answer& answer) {
            manager->update(*positions, *moved);
            if (query == Query::any) answer.collides = manager->any();
            if (query == Query::counted || query == Query::all) {
              const oracle::Pairs found = manager->all();
              answer.count = query == Query::counted ? found.size() : 0;
              if (query == Query::all) list_fcl(found, *positions, *input, answer.pairs);
            }
            if (query == Query::closest)
              answer.gap = manager->distance().value_or(std::numeric_limits<double>::infinity());
          }};
}

/// FCL adds and subtracts the centres in another order. The tolerance covers rounding of coordinates of 1000
/// angstrom.
inline double gap_tolerance(const Contestant& c) { return c.name == "fcl" ? 1e-9 : 0.0; }

/// Whether the contestant can answer the query for this sampling.
inline bool answers(const Contestant& c, Query query, Sampling sampling) {
  if (c.name != "fcl") return true;
  return query == Query::any || query == Query::counted || query == Query::all ||
         (query == Query::closest && sampling == Sampling::near_free);
}

/// engine/simd comes first: the others are compared with it.
inline std::vector<Contestant> contestants(const Scene& scene) {
  return {engine<Simd>(scene, "simd", true),
          fcl(scene),
          peer<Grid>(scene, "grid"),
          engine<Lazy>(scene, "lazy", false),
          peer<ScalarChainTreeSpheres>(scene, "chain-spheres"),
          peer<ScalarChainTreeBoxes>(scene, "chain-boxes"),
          peer<ChainTreeSpheres>(scene, "chain16-spheres"),
          peer<ChainTreeBoxes>(scene, "chain16-boxes"),
          peer<BruteSimd>(scene, "brute"),
          peer<Nanoflann>(scene, "nanoflann"),
          peer<GemmiNeighbors>(scene, "gemmi")};
}

}  // namespace hinge::bench
