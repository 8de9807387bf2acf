// SPDX-License-Identifier: BSD-3-Clause
// Compares answers with the truth: verdicts exactly, distances within their error bound.
#include "robustness/judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace hinge::robustness {
namespace {

constexpr double half_ulp = 0x1p-53, ulp = 0x1p-52;
const double root_of_3 = std::sqrt(3.0);

std::string hexadecimal(double x) {
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), "%a", x);
  return digits.data();
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double x : values) most = std::max(most, std::abs(x));
  return most;
}

/// Returns the largest |R| |v| + |t| of the mesh; the rounding error of R v + t is relative to it.
double placed_size(const Mesh& mesh, const std::vector<double>& place) {
  double most = 0.0;
  if (place.size() != 12) return most;
  for (std::size_t k = 0; k + 2 < mesh.v.size(); k += 3)
    for (std::size_t row = 0; row < 12; row += 4)
      most = std::max(most, std::abs(place[row] * mesh.v[k]) + std::abs(place[row + 1] * mesh.v[k + 1]) +
                                std::abs(place[row + 2] * mesh.v[k + 2]) + std::abs(place[row + 3]));
  return most;
}

/// Returns the length of the chain from the world to the farthest vertex of a link; no point of the link is farther.
double reach(const Chain& chain, std::size_t link) {
  const double corner = root_of_3 * largest(chain.links[link].mesh.v);
  double length = corner;
  for (auto k = static_cast<std::int64_t>(link); k >= 0; k = chain.links[static_cast<std::size_t>(k)].parent) {
    const auto& o = chain.links[static_cast<std::size_t>(k)].origin;
    length += std::hypot(o[0], o[1], o[2]);
  }
  return length;
}

/// Is the distance within 16 ulp of itself, 8 ulp of the largest coordinate difference `span`, and the rounding of
/// world coordinates? The smallest denormal is added, because 16 ulp underflow below the normal doubles.
bool within(double distance, const Bracket& truth, double span, double rounding) {
  if (std::isinf(truth.low)) return distance == truth.low;
  const double allowed = ulp * (16 * truth.high + 8 * span) + rounding + std::numeric_limits<double>::denorm_min();
  return distance >= truth.low - allowed && distance <= truth.high + allowed;
}

std::string not_within(double distance, const Bracket& truth) {
  return "distance " + hexadecimal(distance) + ", expected [" + hexadecimal(truth.low) + ", " +
         hexadecimal(truth.high) + "]";
}

struct Allowance {
  double span = 0.0, rounding = 0.0;
};

/// Triangles are not transformed, so only the distance is rounded.
Allowance allowance(const TrianglePair& pair, bool) {
  double span = 0.0;
  for (std::size_t k = 0; k < 18; ++k)
    for (std::size_t l = k % 3; l < 18; l += 3) {
      const auto at = [&](std::size_t n) { return n < 9 ? pair.a[n] : pair.b[n - 9]; };
      span = std::max(span, std::abs(at(k) - at(l)));
    }
  return {span, 0.0};
}

/// Points at the reference are not transformed either. Their coordinate differences are at most the distance.
Allowance allowance(const Atoms&, bool) { return {}; }

Allowance allowance(const MeshPair& pair, bool of_placed) {
  double span = 0.0;
  for (std::size_t row = 0; row < 3; ++row) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& [mesh, place] : {std::tie(pair.a, pair.place_a), std::tie(pair.b, pair.place_b)})
      for (std::size_t k = 0; k + 2 < mesh.v.size(); k += 3) {
        const double* r = place.data() + 4 * row;
        const double x = r[0] * mesh.v[k] + r[1] * mesh.v[k + 1] + r[2] * mesh.v[k + 2] + r[3];
        low = std::min(low, x);
        high = std::max(high, x);
      }
    span = std::max(span, high - low);
  }
  const double rounding = placed_rounding(pair.a, pair.place_a) + placed_rounding(pair.b, pair.place_b);
  return {span, of_placed ? 0.0 : rounding};
}

Allowance allowance(const Chain& chain, bool of_placed) {
  Allowance most;
  for (std::size_t k = 0; k < chain.links.size(); ++k) {
    most.span = std::max(most.span, 2 * reach(chain, k));
    most.rounding = std::max(most.rounding, of_placed ? 0.0 : 2 * link_rounding(chain, k));
  }
  return most;
}

void judge_links(const Chain& chain, const Truth& truth, const Answer& answer, std::vector<std::string>& found) {
  const Allowance any = allowance(chain, truth.of_placed);
  Bracket least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const LinkPairTruth* closest = nullptr;
  for (const LinkPairTruth& pair : truth.link_pairs) {
    least = {std::min(least.low, pair.distance.low), std::min(least.high, pair.distance.high)};
    const std::string who = "links " + std::to_string(pair.i) + " and " + std::to_string(pair.j) + ": ";
    if (answer.closest && (*answer.closest)[0] == pair.i && (*answer.closest)[1] == pair.j) closest = &pair;
    const auto same = std::find_if(answer.link_pairs.begin(), answer.link_pairs.end(),
                                   [&](const LinkPairAnswer& a) { return a.i == pair.i && a.j == pair.j; });
    if (same == answer.link_pairs.end()) {
      found.push_back(who + "not tested");
      continue;
    }
    if (pair.stable && same->hit != pair.hit)
      found.push_back(who + (pair.hit ? "free, expected a hit" : "hit, expected free"));
    const double rounding = truth.of_placed ? 0.0 : link_rounding(chain, pair.i) + link_rounding(chain, pair.j);
    const double span = pair.span > 0.0 ? pair.span : any.span;
    if (!within(same->distance, pair.distance, span, rounding))
      found.push_back(who + not_within(same->distance, pair.distance));
  }
  if (truth.link_pairs.size() != answer.link_pairs.size())
    found.push_back(std::to_string(answer.link_pairs.size()) + " pairs of links tested, expected " +
                    std::to_string(truth.link_pairs.size()));
  // Any pair is accepted whose distance is within the error bound of the smallest.
  if (truth.closest && !(closest != nullptr && within(closest->distance.low, least, any.span, any.rounding)))
    found.push_back(answer.closest ? "closest: links " + std::to_string((*answer.closest)[0]) + " and " +
                                         std::to_string((*answer.closest)[1])
                                   : "closest: none");
  if (!truth.link_pairs.empty() && !within(answer.distance, least, any.span, any.rounding))
    found.push_back(not_within(answer.distance, least));
  if (truth.tip) {
    const double off = answer.tip ? (*answer.tip - *truth.tip).norm() : std::numeric_limits<double>::infinity();
    // The tip in the file is rounded too.
    const double allowed = link_rounding(chain, chain.links.size() - 1) + root_of_3 * half_ulp * truth.tip->norm();
    if (!(off <= allowed)) found.push_back("tip off by " + hexadecimal(off) + ", at most " + hexadecimal(allowed));
  }
}

void judge(const Case& one, const Truth& truth, const Answer& answer, std::vector<std::string>& found) {
  if (truth.refuse != answer.refused) {
    found.push_back(truth.refuse ? "answered, expected a refusal" : "refused: " + answer.message);
    return;
  }
  if (truth.refuse) return;
  if (!answer.contradiction.empty()) found.push_back(answer.contradiction);
  // An unstable case touches or nearly touches, so the rounding of world vertices decides: both verdicts are right for
  // a library whose guarantee is about the rounded vertices.
  if (truth.stable) {
    if (answer.hit != truth.hit) found.emplace_back(truth.hit ? "free, expected a hit" : "hit, expected free");
    if (truth.pair_count && answer.pair_count != *truth.pair_count)
      found.push_back(std::to_string(answer.pair_count) + " pairs hit, expected " + std::to_string(*truth.pair_count));
    if (truth.pairs && answer.pairs != *truth.pairs) found.emplace_back("other pairs hit than expected");
  }
  const Chain* chain = std::get_if<Chain>(&one.input);
  if (chain != nullptr) {
    judge_links(*chain, truth, answer, found);
    return;
  }
  const Bracket none{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const Bracket expected = truth.distance.value_or(none);
  const Allowance allowed = std::visit([&](const auto& input) { return allowance(input, truth.of_placed); }, one.input);
  if (!within(answer.distance, expected, allowed.span, allowed.rounding))
    found.push_back(not_within(answer.distance, expected));
}

}  // namespace

/// A coordinate of R v + t is rounded four times, each time by half an ulp of at most placed_size. R may deviate from a
/// rotation by 1e-9, but the truth uses R as given.
double placed_rounding(const Mesh& mesh, const std::vector<double>& place) {
  return root_of_3 * 4 * half_ulp * placed_size(mesh, place);
}

/// Error per joint, in half ulps of the reach. Sines are accurate to 3, the axis to 3, and an entry of Rodrigues'
/// matrix adds 5 roundings to the errors of its factors: below 16 for the matrix as an operator. The product with the
/// parent's matrix rounds each entry 3 times, below 3 sqrt(3), and its translation 4 times. In sum below 32 per joint,
/// including the transformation of vertices.
double link_rounding(const Chain& chain, std::size_t link) {
  double joints = 1.0;
  for (std::int64_t k = chain.links[link].parent; k >= 0; k = chain.links[static_cast<std::size_t>(k)].parent) ++joints;
  return 32 * half_ulp * joints * reach(chain, link);
}

std::vector<std::string> faults(const Case& one, const std::vector<Answer>& answers) {
  std::vector<std::string> found;
  if (!one.truth) return found;
  for (const Answer& answer : answers) {
    const std::size_t before = found.size();
    judge(one, *one.truth, answer, found);
    for (std::size_t k = before; k < found.size(); ++k) found[k] = answer.way + ": " + found[k];
    if (answer.hit != answers[0].hit || answer.pairs != answers[0].pairs)
      found.push_back(answer.way + " and " + answers[0].way + " differ in what hits");
  }
  return found;
}

}  // namespace hinge::robustness
