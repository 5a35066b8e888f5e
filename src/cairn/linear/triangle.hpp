// SPDX-License-Identifier: BSD-3-Clause
// The rank-k update of a covariance: an update of the filter spends most of its time here.
//
// It exists because Eigen's triangular product allocates memory for large matrices, and an update must not allocate.
#pragma once

#include <cstddef>

namespace cairn {

// Doubles of workspace that `update_triangle` needs for matrices of up to `n_max` rows and ranks up to `k_max`.
std::size_t update_triangle_workspace(std::ptrdiff_t n_max, std::ptrdiff_t k_max);

// One term of a sum, factor A B^T: A and B are n x k, column-major with their leading dimensions.
struct TriangleTerm {
  const double* A;
  std::ptrdiff_t lda;
  const double* B;
  std::ptrdiff_t ldb;
  std::ptrdiff_t k;
  double factor;
};

// lower(C) += the sum of the terms, in one pass over C: the columns of all terms make up the rank.
void update_triangle(double* C, std::ptrdiff_t ldc, std::ptrdiff_t n, const TriangleTerm* terms, std::ptrdiff_t count,
                     double* workspace);

// lower(C) += A B^T. C is n x n, A and B are n x k, all column-major with their leading dimensions; the caller
// ensures that A B^T is symmetric (a downdate: A = -B). Entries above the diagonal of C are neither read nor written.
// A and B may be one matrix; C overlaps neither. The workspace needs no alignment. Same inputs, same build, same bits.
void update_triangle(double* C, std::ptrdiff_t ldc, std::ptrdiff_t n, const double* A, std::ptrdiff_t lda,
                     const double* B, std::ptrdiff_t ldb, std::ptrdiff_t k, double* workspace);

}  // namespace cairn
