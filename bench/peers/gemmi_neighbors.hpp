// SPDX-License-Identifier: BSD-3-Clause
// GemmiNeighbors: gemmi's NeighborSearch on a model that is built once and then moved. Only the .cpp includes gemmi.
#pragma once

#include <memory>
#include <span>

#include "peer.hpp"

namespace hinge::bench {

class GemmiNeighbors {
 public:
  explicit GemmiNeighbors(std::shared_ptr<const PeerInput> input);
  GemmiNeighbors(GemmiNeighbors&&) noexcept;
  GemmiNeighbors& operator=(GemmiNeighbors&&) noexcept;
  ~GemmiNeighbors();

  void update(std::span<const double> xyz);
  bool any();
  std::size_t count();
  void within(double margin, PairList& out);
  double closest();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hinge::bench
