// SPDX-License-Identifier: BSD-3-Clause
// Cholesky decomposition in a fixed order of operations: the same bits on every CPU, which Eigen's does not promise.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace hinge::detail {

/// The lower triangle of a symmetric matrix (size x size, row by row) is replaced by its factor L, L L^T the matrix.
/// False, and the matrix half done, when it is not positive definite (NaN included).
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
