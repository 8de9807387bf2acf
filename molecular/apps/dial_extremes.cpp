// SPDX-License-Identifier: BSD-3-Clause
// Implements find_extremes().
#include "dial_extremes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "extremes_peer.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/near_contact.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::Vec3;

namespace {

constexpr std::size_t most_near_pairs = 200;  // of nearly touching conformations, and of random ones
constexpr double case_seconds = 2.0;          // for each row of the table

using Configuration = std::vector<double>;
using Positions = std::vector<Vec3>;

bool collides(Checker& checker, const Configuration& q) { return checker.check(q, Mode{Mode::Kind::any}).collides; }

/// Decides in single precision: all numbers are rounded to float, and no error is bounded.
bool closer_in_float(const Vec3& a, const Vec3& b, double threshold) {
  float squared = 0.0F;
  for (int k = 0; k < 3; ++k) {
    const float d = static_cast<float>(a[k]) - static_cast<float>(b[k]);
    squared += d * d;
  }
  const auto m = static_cast<float>(threshold);
  return squared < m * m;
}

/// Returns the verdict by another decision about two atoms. Pairs further above their threshold than `margin` are free
/// without a test. Pairs of constant distance are left out.
template <class Closer>
bool collides_by(const Closer& closer, Checker& checker, const Positions& positions, double margin) {
  Mode near{Mode::Kind::within};
  near.margin = margin;
  const Verdict found = checker.check_coordinates(positions, near);
  return std::ranges::any_of(found.pairs, [&](const Contact& pair) {
    const std::size_t i = hinge::index(pair.hit.first), j = hinge::index(pair.hit.second);
    if (checker.constant(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j))) return false;
    return closer(positions[i], positions[j], pair.hit.threshold);
  });
}

/// Returns the exact verdict for coordinates, without pairs of constant distance.
bool collides_at(Checker& checker, const Positions& positions) {
  const Verdict found = checker.check_coordinates(positions, Mode{Mode::Kind::all});
  return std::ranges::any_of(found.pairs, [&](const Contact& pair) {
    return !checker.constant(static_cast<std::uint32_t>(hinge::index(pair.hit.first)),
                             static_cast<std::uint32_t>(hinge::index(pair.hit.second)));
  });
}

/// A way to rewrite coordinates.
struct Rewriting {
  std::string name;
  std::function<double(double)> of;
  double largest = 0.0;  // angstrom, of a coordinate that it makes
  bool is_file = false;  // as a file does it
};

std::vector<Rewriting> rewritings() {
  const auto decimals = [](double unit) { return [unit](double x) { return std::round(x / unit) * unit; }; };
  const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  const auto displaced = [](double by) { return [by](double x) { return x + by; }; };
  const auto displaced_single = [](double by) {
    return [by](double x) { return static_cast<double>(static_cast<float>(x + by)); };
  };
  return {{"written with 3 decimals (PDB)", decimals(1e-3), 1e3, true},
          {"written with 2 decimals (XTC)", decimals(1e-2), 1e3, true},
          {"written as floats (DCD)", single, 1e3, true},
          {"displaced by 1000 angstrom, floats", displaced_single(1e3), 2e3, false},
          {"displaced by 10^6 angstrom, floats", displaced_single(1e6), 1e6, false},
          {"displaced by 10^6 angstrom", displaced(1e6), 1e6, false},
          {"displaced by 10^9 angstrom", displaced(1e9), 1e9, false}};
}

}  // namespace

hinge::tool::DialExtremes find_extremes(const Job& job, const Sampling& sampling) {
  hinge::tool::DialExtremes table;
  table.columns = {"case", "asked", "collide", "exact", "single precision"};
  const ExtremesPeer* peer = extremes_peer();
  if (peer != nullptr) table.columns.emplace_back(peer->name);
  Checker checker = job.checker;
  Conformations conformations(job, sampling);
  std::vector<Configuration> random;
  hinge::tool::NearContacts contacts;
  const std::vector<Configuration>& near = contacts.all();
  const Configuration reference(checker.dof_count(), 0.0);
  const bool starts_free = !collides(checker, reference);
  for (std::uint64_t k = 0;
       k < 100 * most_near_pairs && (random.size() < 2 * most_near_pairs || near.size() < 2 * most_near_pairs); ++k) {
    conformations.prepare(k, 1);
    const auto drawn = conformations.at(k);
    if (drawn.empty()) continue;
    Configuration q(drawn.begin(), drawn.end());
    if (starts_free && near.size() < 2 * most_near_pairs && collides(checker, q))
      contacts.add([&](const Configuration& at) { return collides(checker, at); }, reference, q);
    if (random.size() < 2 * most_near_pairs) random.push_back(std::move(q));
  }
  const auto add = [&](const std::string& name, const std::vector<Configuration>& asked, const Rewriting* change) {
    const auto start = hinge::tool::Clock::now();
    std::size_t count = 0, hits = 0, changed = 0;
    hinge::tool::WrongVerdicts in_float, of_peer;
    const double margin = 1e-3 + (change != nullptr ? change->largest : 1e3) * 0x1p-20;
    for (; count < asked.size() && hinge::tool::seconds_since(start) < case_seconds; ++count) {
      const bool plain = collides(checker, asked[count]);
      Positions positions = checker.positions();
      if (change != nullptr)
        for (Vec3& x : positions)
          for (int k = 0; k < 3; ++k) x[k] = change->of(x[k]);
      const bool truth = change != nullptr ? collides_at(checker, positions) : plain;
      in_float.count(truth, collides_by(closer_in_float, checker, positions, margin));
      if (peer != nullptr) of_peer.count(truth, collides_by(peer->collide, checker, positions, margin));
      hits += truth ? 1U : 0U;
      changed += truth != plain ? 1U : 0U;
    }
    table.rows.push_back({name, fmt::format("{}", count), fmt::format("{}", hits),
                          changed == 0 ? "same" : fmt::format("{} changed", changed), in_float.text()});
    if (peer != nullptr) table.rows.back().push_back(of_peer.text());
  };
  add("random", random, nullptr);
  for (const Rewriting& change : rewritings())
    if (change.is_file) add("random, " + change.name, random, &change);
  if (near.empty()) {
    table.notes.emplace_back(starts_free ? "no conformation collides, so none that nearly touches was found"
                                         : "the reference collides, so no conformation that nearly touches was found");
  } else {
    for (const auto& [step, name] : hinge::tool::steps_from_contact)
      add(fmt::format("{} rad from contact", name), contacts.apart(step), nullptr);
    add("nearly touching", near, nullptr);
    for (const Rewriting& change : rewritings()) add("nearly touching, " + change.name, near, &change);
    table.notes.emplace_back(
        "nearly touching: the last free and the first colliding conformation of a bisection from the reference, with "
        "neighbouring numbers");
    table.notes.emplace_back("rad from contact: these two, each moved away from the other by so much");
  }
  table.notes.emplace_back("exact: verdicts that the change of coordinates changes");
  table.notes.emplace_back(
      "single precision: coordinates and thresholds as floats, compared with the exact verdict for the same "
      "coordinates");
  if (peer != nullptr)
    table.notes.push_back(fmt::format("{}: the same, with its spheres in double precision", peer->name));
  return table;
}

}  // namespace biocd
