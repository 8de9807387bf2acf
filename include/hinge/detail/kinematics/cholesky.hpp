// SPDX-License-Identifier: BSD-3-Clause
// Cholesky decomposition in a fixed order of operations. Unlike Eigen's, it has the same bits on every CPU.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace hinge::detail {

/// Replaces the lower triangle of a symmetric matrix (size x size, row-major) by its factor L, where L L^T is the
/// matrix. Returns false when the matrix is not positive definite or contains NaN; it is then partly overwritten.
inline bool factor_cholesky(std::vector<double>& matrix, std::size_t size) noexcept {
  for (std::size_t a = 0; a < size; ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      double sum = matrix[a * size + b];
      for (std::size_t k = 0; k < b; ++k) sum -= matrix[a * size + k] * matrix[b * size + k];
      if (a == b && !(sum > 0.0)) return false;
      matrix[a * size + b] = a == b ? std::sqrt(sum) : sum / matrix[b * size + b];
    }
  return true;
}

}  // namespace hinge::detail
