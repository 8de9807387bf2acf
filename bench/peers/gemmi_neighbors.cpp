// SPDX-License-Identifier: BSD-3-Clause
// GemmiNeighbors: one model of the moving and one of the fixed points; positions change in place, marks are
// repopulated.
#include "gemmi_neighbors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gemmi/model.hpp>
#include <gemmi/neighbor.hpp>
#include <gemmi/unitcell.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "pair_rules.hpp"

namespace hinge::bench {

namespace {

/// Points for gemmi to search: atoms of one residue, so that the index of an atom is the index of its point.
class Marked {
 public:
  void assign(std::vector<std::uint32_t> members) {
    members_ = std::move(members);
    gemmi::Residue residue;
    residue.atoms.resize(members_.size());
    gemmi::Chain chain("A");
    chain.residues.push_back(std::move(residue));
    model_.chains.push_back(std::move(chain));
  }

  void move(const double* xyz) {
    fresh_ = false;
    auto& atoms = model_.chains[0].residues[0].atoms;
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{far, far, far}, high{-far, -far, -far};
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const double* p = xyz + 3 * std::size_t{members_[k]};
      atoms[k].pos = gemmi::Position(p[0], p[1], p[2]);
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], p[a]);
        high[a] = std::max(high[a], p[a]);
      }
    }
    for (std::size_t a = 0; a < 3; ++a) size_[a] = members_.empty() ? 0.0 : high[a] - low[a];
  }

  /// Marks every atom, in cells at least `radius` wide.
  void populate(double radius) {
    const double volume = (size_[0] + 3 * radius) * (size_[1] + 3 * radius) * (size_[2] + 3 * radius);
    // Open chains leave most cells empty, and each cell is a vector: limits the number of cells.
    radius = std::max(radius, std::cbrt(volume / (4.0 * static_cast<double>(members_.size()) + 1000.0)));
    if (fresh_ && radius <= search_.radius_specified) return;
    if (fits(radius))
      for (auto& marks : search_.grid.data) marks.clear();  // keeps the allocated memory
    else
      search_ = gemmi::NeighborSearch(model_, gemmi::UnitCell(), radius);
    search_.populate();
    fresh_ = true;
  }

  template <class Visit>
  void for_each(const double* at, double radius, const Visit& visit) {
    search_.for_each(gemmi::Position(at[0], at[1], at[2]), '\0', static_cast<float>(radius),
                     [&](const gemmi::NeighborSearch::Mark& mark, float) {
                       const auto k = static_cast<std::uint32_t>(mark.atom_idx);
                       visit(k, members_[k]);
                     });
  }

  const std::vector<std::uint32_t>& members() const { return members_; }
  double extent() const { return std::max({size_[0], size_[1], size_[2]}); }

 private:
  /// The grid repeats periodically. The last grid can be reused if its cell holds the points plus a gap of the radius
  /// and is not much larger than a new cell.
  bool fits(double radius) const {
    const auto& cell = search_.grid.unit_cell;
    if (search_.model == nullptr || radius > search_.radius_specified || search_.radius_specified > 1.5 * radius)
      return false;
    const std::array<double, 3> edges{cell.a, cell.b, cell.c};
    double growth = 1.0;
    for (std::size_t a = 0; a < 3; ++a) {
      if (edges[a] < size_[a] + 1.5 * radius) return false;
      growth *= edges[a] / (size_[a] + 3.0 * radius);
    }
    return growth < 2.0;
  }

  std::vector<std::uint32_t> members_;
  gemmi::Model model_{"1"};
  gemmi::NeighborSearch search_;
  std::array<double, 3> size_{};
  bool fresh_ = false;
};

}  // namespace

struct GemmiNeighbors::Impl {
  explicit Impl(std::shared_ptr<const PeerInput> in) : input(std::move(in)), reach(input->type_count, 0.0) {
    std::vector<std::uint32_t> still, others;
    for (std::uint32_t i = 0; i < input->n; ++i) (input->group[i] == 0 ? still : others).push_back(i);
    fixed.assign(std::move(still));
    moving.assign(std::move(others));
    for (std::size_t t = 0; t < reach.size(); ++t)
      for (std::size_t u = 0; u < reach.size(); ++u) reach[t] = std::max(reach[t], input->table[t * reach.size() + u]);
    for (const double r : reach) highest = std::max(highest, r);
  }

  template <class Answer>
  void search(Answer& answer) {
    for (Marked* partners : {&moving, &fixed}) {
      if (partners->members().empty() || moving.members().empty()) continue;
      // Marks are floats: allow for eight roundings of a coordinate in the cell, whose edge has this upper bound.
      const double highest_radius = std::max(highest + answer.margin, 0.0);
      const double band = 8.0 * 0x1p-24 * (partners->extent() + 5.0 * (highest_radius + partners->extent())) + 1e-9;
      partners->populate(highest_radius + band);
      bool stop = false;
      for (std::uint32_t k = 0; k < moving.members().size() && !stop; ++k) {
        const std::uint32_t i = moving.members()[k];
        const double radius = std::max(reach[input->type[i]] + answer.margin, 0.0) + band;
        const std::uint32_t after = partners == &moving ? k + 1 : 0;
        partners->for_each(xyz.data() + 3 * std::size_t{i}, radius, [&](std::uint32_t other, std::uint32_t j) {
          if (stop || other < after) return;
          const double squared = squared_distance(xyz.data(), i, j), threshold = input->threshold(i, j);
          if (worth_looking_up(squared, threshold, answer.margin) && input->admits(i, j))
            stop = answer.add(i, j, squared, threshold);
        });
      }
      if (stop) return;
    }
  }

  std::shared_ptr<const PeerInput> input;
  std::vector<double> reach;  // largest threshold M of a type
  double highest = 0.0;
  Marked moving, fixed;
  bool fixed_taken = false;
  std::span<const double> xyz;
  double last = 0.0;
};

GemmiNeighbors::GemmiNeighbors(std::shared_ptr<const PeerInput> input)
    : impl_(std::make_unique<Impl>(std::move(input))) {}
GemmiNeighbors::GemmiNeighbors(GemmiNeighbors&&) noexcept = default;
GemmiNeighbors& GemmiNeighbors::operator=(GemmiNeighbors&&) noexcept = default;
GemmiNeighbors::~GemmiNeighbors() = default;

void GemmiNeighbors::update(std::span<const double> xyz) {
  impl_->xyz = xyz;
  impl_->moving.move(xyz.data());
  if (!impl_->fixed_taken) impl_->fixed.move(xyz.data());
  impl_->fixed_taken = true;
}

bool GemmiNeighbors::any() {
  AnyPair answer;
  impl_->search(answer);
  return answer.found;
}

std::size_t GemmiNeighbors::count() {
  PairCount answer;
  impl_->search(answer);
  return answer.count;
}

void GemmiNeighbors::within(double margin, PairList& out) {
  out.clear();
  PairsWithin answer{out, margin};
  impl_->search(answer);
  detail::sort_hits(out);
}

double GemmiNeighbors::closest() {
  const auto& xyz = impl_->xyz;
  double largest = 0.0;
  for (const double c : xyz) largest = std::max(largest, std::abs(c));
  return impl_->last = grow_until_found(impl_->last, 4.0 * largest + 1.0, [&](double margin) {
           ClosestPair answer{margin};
           impl_->search(answer);
           return answer;
         });
}

}  // namespace hinge::bench
