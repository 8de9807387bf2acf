// SPDX-License-Identifier: BSD-3-Clause
// Counts directed edges to test closedness, and winding numbers along an exact ray to test insideness.
#include "hinge/robotics/containment.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "hinge/core/number_text.hpp"
#include "hinge/detail/exact/orient.hpp"

namespace hinge::robotics {

namespace {

/// Returns a number per vertex, three vertices per triangle. Vertices with equal coordinates have equal numbers.
std::vector<std::uint32_t> vertex_numbers(std::span<const Triangle> mesh) {
  const auto vertex = [&](std::uint32_t k) -> const Vec3& {
    const Triangle& t = mesh[k / 3];
    return k % 3 == 0 ? t.a : k % 3 == 1 ? t.b : t.c;
  };
  const auto key = [&](std::uint32_t k) {
    const Vec3& v = vertex(k);
    return std::tuple(v[0], v[1], v[2]);
  };
  std::vector<std::uint32_t> order(3 * mesh.size()), number(3 * mesh.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t k, std::uint32_t l) { return key(k) < key(l); });
  for (std::size_t n = 0; n < order.size(); ++n)
    number[order[n]] = n > 0 && key(order[n]) == key(order[n - 1]) ? number[order[n - 1]] : order[n];
  return number;
}

std::string coordinates_text(const Vec3& v) {
  std::string text = "(";
  for (int k = 0; k < 3; ++k) text += (k == 0 ? "" : ", ") + number_text(v[k]);
  return text + ")";
}

/// Returns the side of line ab, projected along z, on which p lies. p is shifted by an infinitesimal along x and a
/// smaller one along y. The result is 0 only if the projections of a and b coincide (Edelsbrunner and Muecke,
/// "Simulation of simplicity", 1990, applied to p alone). Swapping a and b negates the sign, so two triangles agree
/// about a common edge.
int pushed_side(const Vec3& a, const Vec3& b, const Vec3& p) noexcept {
  if (const int side = detail::exact::orient2d(a, b, p, 2); side != 0) return side;
  if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;
  return detail::exact::sign_of(b[0] - a[0]);
}

}  // namespace

std::string OpenEdge::text() const {
  return "edge " + coordinates_text(from) + " - " + coordinates_text(to) + " of triangle " + std::to_string(triangle);
}

std::optional<OpenEdge> open_edge(std::span<const Triangle> mesh) {
  struct Edge {
    std::uint32_t low, high, place;  // place: index of the edge, three per triangle
    bool upward;
  };
  const std::vector<std::uint32_t> number = vertex_numbers(mesh);
  std::vector<Edge> edges;
  edges.reserve(number.size());
  for (std::uint32_t k = 0; k < number.size(); ++k) {
    const std::uint32_t from = number[k], to = number[k % 3 == 2 ? k - 2 : k + 1];
    if (from != to) edges.push_back({std::min(from, to), std::max(from, to), k, from < to});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
    return std::tie(x.low, x.high, x.place) < std::tie(y.low, y.high, y.place);
  });
  std::optional<std::uint32_t> open;
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    std::ptrdiff_t balance = 0;
    for (; end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high; ++end)
      balance += edges[end].upward ? 1 : -1;
    if (balance == 0) continue;
    for (std::size_t k = first; k < end; ++k)
      if (edges[k].upward == (balance > 0) && (!open || edges[k].place < *open)) open = edges[k].place;
  }
  if (!open) return {};
  const Triangle& t = mesh[*open / 3];
  const std::array<Vec3, 3> corners{t.a, t.b, t.c};
  return OpenEdge{*open / 3, corners[*open % 3], corners[(*open + 1) % 3]};
}

std::vector<std::size_t> part_numbers(std::span<const Triangle> mesh) {
  const std::vector<std::uint32_t> number = vertex_numbers(mesh);
  // Union-find over vertices. The root is the smallest vertex index of its component.
  std::vector<std::uint32_t> root(number.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t k) {
    while (root[k] != k) k = root[k] = root[root[k]];
    return k;
  };
  const auto join = [&](std::uint32_t k, std::uint32_t l) {
    k = find(k);
    l = find(l);
    root[std::max(k, l)] = std::min(k, l);
  };
  for (std::uint32_t k = 0; k < number.size(); ++k) {
    join(k, number[k]);
    join(k, k - k % 3);
  }
  std::vector<std::size_t> first(mesh.size());
  for (std::size_t t = 0; t < mesh.size(); ++t) first[t] = find(static_cast<std::uint32_t>(3 * t)) / 3;
  return first;
}

std::vector<std::size_t> parts(std::span<const Triangle> mesh) {
  const std::vector<std::size_t> number = part_numbers(mesh);
  std::vector<std::size_t> first;
  for (std::size_t t = 0; t < number.size(); ++t)
    if (number[t] == t) first.push_back(t);
  return first;
}

Place place_of(const Vec3& point, std::span<const Triangle> closed_mesh) noexcept {
  // Adds the orientations of all triangles that the ray from the point towards +z crosses. The shift of pushed_side()
  // keeps the ray off edges and vertices. If the ray crosses a triangle whose plane contains the point, the triangle
  // contains the point; the infinitesimal shift does not change this.
  std::ptrdiff_t winding = 0;
  for (const Triangle& t : closed_mesh) {
    double low = std::min({t.a[0], t.b[0], t.c[0]}), high = std::max({t.a[0], t.b[0], t.c[0]});
    if (point[0] < low || point[0] > high) continue;
    low = std::min({t.a[1], t.b[1], t.c[1]}), high = std::max({t.a[1], t.b[1], t.c[1]});
    if (point[1] < low || point[1] > high || point[2] > std::max({t.a[2], t.b[2], t.c[2]})) continue;
    if (closer_than(t, Triangle{point, point, point}, 0.0)) return Place::on_surface;
    const int side = pushed_side(t.a, t.b, point);
    if (side == 0 || pushed_side(t.b, t.c, point) != side || pushed_side(t.c, t.a, point) != side) continue;
    if (side * detail::exact::orient3d(t.a, t.b, t.c, point) > 0) winding += side;
  }
  return winding == 0 ? Place::outside : Place::inside;
}

Containment contains(std::span<const Triangle> closed_outer, std::span<const Triangle> inner,
                     std::span<const std::size_t> inner_parts) noexcept {
  std::size_t inside = 0;
  for (const std::size_t part : inner_parts) inside += place_of(inner[part].a, closed_outer) == Place::inside ? 1U : 0U;
  if (inside == 0) return Containment::none;
  return inside == inner_parts.size() ? Containment::whole : Containment::some_parts;
}

Containment contains(std::span<const Triangle> closed_outer, std::span<const Triangle> inner) {
  return contains(closed_outer, inner, parts(inner));
}

}  // namespace hinge::robotics
