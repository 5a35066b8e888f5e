// SPDX-License-Identifier: BSD-3-Clause
#include "ekf/small_algebra.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr Index kRows = 16;  // rows that the right solve takes at once: four AVX2 registers, four independent chains

// One strip of W: column j minus the solved columns before it. `strip` is kRows x m, packed; `rows_of_L` is L by rows
// with the reciprocal of the diagonal.
void solve_strip(const double* rows_of_L, Index m, double* strip) {
  for (Index j = 0; j < m; ++j) {
    const double* row = rows_of_L + j * m;
    double sum[kRows];
    for (Index r = 0; r < kRows; ++r) sum[r] = strip[j * kRows + r];
    for (Index i = 0; i < j; ++i) {
      const double factor = row[i];
      const double* solved = strip + i * kRows;
      for (Index r = 0; r < kRows; ++r) sum[r] -= factor * solved[r];
    }
    for (Index r = 0; r < kRows; ++r) strip[j * kRows + r] = sum[r] * row[j];
  }
}

}  // namespace

bool cholesky(double* S, Index ld, Index m) {
  for (Index j = 0; j < m; ++j) {
    double* column = S + j * ld;
    const double pivot = column[j];
    if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
    const double inverse = 1.0 / std::sqrt(pivot);
    for (Index i = j; i < m; ++i) column[i] *= inverse;
    for (Index k = j + 1; k < m; ++k) {
      const double factor = column[k];
      double* target = S + k * ld;
      for (Index i = k; i < m; ++i) target[i] -= factor * column[i];
    }
  }
  return true;
}

void solve_lower(const double* L, Index ld, Index m, double* x) {
  for (Index j = 0; j < m; ++j) {
    const double* column = L + j * ld;
    const double value = x[j] /= column[j];
    for (Index i = j + 1; i < m; ++i) x[i] -= value * column[i];
  }
}

void solve_lower_transposed(const double* L, Index ld, Index m, double* x) {
  for (Index j = m - 1; j >= 0; --j) {
    const double* column = L + j * ld;
    double sum = x[j];
    for (Index i = j + 1; i < m; ++i) sum -= column[i] * x[i];
    x[j] = sum / column[j];
  }
}

std::size_t solve_workspace(Index m) { return static_cast<std::size_t>(m * m + kRows * m); }

void solve_right_transposed(const double* L, Index ld, Index m, double* W, Index ldw, Index n, double* workspace) {
  double* rows_of_L = workspace;
  double* strip = workspace + m * m;
  for (Index j = 0; j < m; ++j) {
    for (Index i = 0; i < j; ++i) rows_of_L[j * m + i] = L[i * ld + j];
    rows_of_L[j * m + j] = 1.0 / L[j * ld + j];
  }
  for (Index first = 0; first < n; first += kRows) {
    const Index rows = std::min(kRows, n - first);
    for (Index j = 0; j < m; ++j) {
      for (Index r = 0; r < rows; ++r) strip[j * kRows + r] = W[j * ldw + first + r];
      for (Index r = rows; r < kRows; ++r) strip[j * kRows + r] = 0.0;
    }
    solve_strip(rows_of_L, m, strip);
    for (Index j = 0; j < m; ++j)
      for (Index r = 0; r < rows; ++r) W[j * ldw + first + r] = strip[j * kRows + r];
  }
}

void inverse_from_cholesky(const double* L, Index ld, Index m, double* inverse, Index ld_inverse) {
  for (Index j = 0; j < m; ++j) {
    double* column = inverse + j * ld_inverse;
    std::fill(column, column + m, 0.0);
    column[j] = 1.0;
    solve_lower(L, ld, m, column);
    solve_lower_transposed(L, ld, m, column);
  }
}

}  // namespace cairn
