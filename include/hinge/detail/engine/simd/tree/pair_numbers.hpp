// SPDX-License-Identifier: BSD-3-Clause
// PairNumbers: numbers the tested pairs of tree parts from 0.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/detail/engine/simd/tree/admitted_pairs.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// The pair (q, p), q before p, has a number if q is tested with p.
class PairNumbers {
 public:
  PairNumbers() = default;
  PairNumbers(const AdmittedPairs& tested, std::size_t parts) : rows_((parts + simd::width - 1) / simd::width) {
    for (std::size_t p = 0; p < parts; ++p)
      for (std::size_t row = 0; row < rows_; ++row) {
        first_.push_back(static_cast<std::uint32_t>(parts_.size()));
        tested_.push_back(static_cast<std::uint16_t>(tested.get(p, row)));
        for (simd::Bits bits = tested_.back(); bits != 0; bits &= bits - 1)
          parts_.push_back(
              {static_cast<std::uint32_t>(row * simd::width) + static_cast<std::uint32_t>(std::countr_zero(bits)),
               static_cast<std::uint32_t>(p)});
      }
  }

  std::size_t size() const noexcept { return parts_.size(); }
  std::size_t of(std::size_t q, std::size_t p) const noexcept {
    const std::size_t row = p * rows_ + q / simd::width;
    const simd::Bits before = (simd::Bits{1} << q % simd::width) - 1;
    return first_[row] + static_cast<std::size_t>(std::popcount(tested_[row] & before));
  }
  /// The pair {q, p} with this number.
  const std::array<std::uint32_t, 2>& parts(std::size_t number) const noexcept { return parts_[number]; }

 private:
  std::size_t rows_ = 0;
  std::vector<std::uint16_t> tested_;
  std::vector<std::uint32_t> first_;
  std::vector<std::array<std::uint32_t, 2>> parts_;
};

}  // namespace hinge::detail
