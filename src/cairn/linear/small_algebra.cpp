// SPDX-License-Identifier: BSD-3-Clause
#include "linear/small_algebra.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/compiler.hpp"
#include "linear/lanes.hpp"
#include "linear/triangle.hpp"

namespace cairn {
namespace {

// Four doubles: one AVX2 register, two of SSE2. With GCC's vectors the sums of a strip stay in registers; with a loop
// over an array they went through memory.
#if defined(CAIRN_VECTOR_TYPES)
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));
#else
using Four = Lanes<4>;
#endif
constexpr int kFours = 3;            // registers for a column of a strip
constexpr Index kRows = 4 * kFours;  // rows that the right solve handles at once
constexpr Index kPanel = 48;         // columns of a blocked Cholesky factor

#if defined(CAIRN_VECTOR_TYPES)
Four load(const double* p) {
  return *reinterpret_cast<const Four*>(p);
}
void store(double* p, Four value) {
  *reinterpret_cast<Four*>(p) = value;
}
#else
Four load(const double* p) {
  Four value;
  std::memcpy(&value, p, sizeof value);
  return value;
}
void store(double* p, const Four& value) {
  std::memcpy(p, &value, sizeof value);
}
#endif

// Columns j to j + count - 1 of one strip of W: minus the solved columns before them. `strip` is kRows x m, packed;
// `rows_of_L` is L by rows with the reciprocal of the diagonal.
template <int count>
void solve_columns(const double* rows_of_L, Index m, Index j, double* strip) {
  Four sum[count][kFours];
  for (int c = 0; c < count; ++c)
    for (int q = 0; q < kFours; ++q) sum[c][q] = load(strip + (j + c) * kRows + 4 * q);
  for (Index i = 0; i < j; ++i) {
    const double* solved = strip + i * kRows;
    const Four s0 = load(solved), s1 = load(solved + 4), s2 = load(solved + 8);
    for (int c = 0; c < count; ++c) {
      const double factor = rows_of_L[(j + c) * m + i];
      sum[c][0] -= factor * s0;
      sum[c][1] -= factor * s1;
      sum[c][2] -= factor * s2;
    }
  }
  for (int c = 0; c < count; ++c) {
    const double* row = rows_of_L + (j + c) * m + j;
    for (int q = 0; q < kFours; ++q) {
      for (int before = 0; before < c; ++before) sum[c][q] -= row[before] * sum[before][q];
      sum[c][q] *= row[c];
      store(strip + (j + c) * kRows + 4 * q, sum[c][q]);
    }
  }
}

void solve_strip(const double* rows_of_L, Index m, double* strip) {
  Index j = 0;
  for (; j + 4 <= m; j += 4) solve_columns<4>(rows_of_L, m, j, strip);
  for (; j < m; ++j) solve_columns<1>(rows_of_L, m, j, strip);
}

// The first `rows` rows of m columns. A full strip needs no call of memmove a column.
void copy_strip(const double* from, Index ld_from, double* to, Index ld_to, Index rows, Index m) {
  if (rows < kRows) {
    for (Index j = 0; j < m; ++j) std::copy_n(from + j * ld_from, rows, to + j * ld_to);
    return;
  }
  for (Index j = 0; j < m; ++j, from += ld_from, to += ld_to)
    for (int q = 0; q < kFours; ++q) store(to + 4 * q, load(from + 4 * q));
}

// Sums over the columns of a strip, for its rows that begin at `first`.
void sum_strip(const double* strip, Index m, const RowSums& sums, Index first, Index rows) {
  Four squares[kFours] = {}, products[kFours] = {};
  for (Index j = 0; j < m; ++j)
    for (int q = 0; q < kFours; ++q) {
      const Four solved = load(strip + j * kRows + 4 * q);
      squares[q] += solved * solved;
      products[q] += solved * sums.y[j];
    }
  double out[2 * kRows];
  for (int q = 0; q < kFours; ++q) {
    store(out + 4 * q, squares[q]);
    store(out + kRows + 4 * q, products[q]);
  }
  std::copy_n(out, rows, sums.squares + first);
  std::copy_n(out + kRows, rows, sums.products + first);
}

// Right-looking: kWidth columns are solved, then one pass updates all later columns by them.
bool factor_small(double* S, Index ld, Index m) {
  constexpr Index kWidth = 4;
  for (Index first = 0; first < m; first += kWidth) {
    const Index last = std::min(first + kWidth, m);
    for (Index j = first; j < last; ++j) {
      double* column = S + j * ld;
      const double pivot = column[j];
      if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
      const double inverse = 1.0 / std::sqrt(pivot);
      for (Index i = j; i < m; ++i) column[i] *= inverse;
      for (Index k = j + 1; k < last; ++k) {
        const double factor = column[k];
        double* target = S + k * ld;
        for (Index i = k; i < m; ++i) target[i] -= factor * column[i];
      }
    }
    if (last == m) break;
    const double *a = S + first * ld, *b = a + ld, *c = b + ld, *d = c + ld;
    for (Index k = last; k < m; ++k) {
      const double fa = a[k], fb = b[k], fc = c[k], fd = d[k];
      double* target = S + k * ld;
      for (Index i = k; i < m; ++i) target[i] -= fa * a[i] + fb * b[i] + (fc * c[i] + fd * d[i]);
    }
  }
  return true;
}

}  // namespace

std::size_t cholesky_workspace(Index m) {
  return m <= kPanel ? 0 : eliminate_workspace(m);
}

bool cholesky(double* S, Index ld, Index m, double* workspace) {
  return eliminate(S, ld, m, m, workspace);
}

std::size_t eliminate_workspace(Index n) {
  return std::max(solve_workspace(kPanel), update_triangle_workspace(n, kPanel));
}

bool eliminate(double* S, Index ld, Index n, Index e, double* workspace) {
  for (Index j = 0; j < e; j += kPanel) {
    const Index width = std::min(kPanel, e - j), below = n - j - width;
    double* diagonal = S + j * ld + j;
    if (!factor_small(diagonal, ld, width)) return false;
    if (below == 0) break;
    double* panel = diagonal + width;
    solve_right_transposed(diagonal, ld, width, panel, ld, below, workspace);
    const TriangleTerm downdate{panel, ld, panel, ld, width, -1.0};
    update_triangle(S + (j + width) * (ld + 1), ld, below, &downdate, 1, workspace);
  }
  return true;
}

bool positive_definite(const double* matrix, Index m, double slack, double* L) {
  for (Index c = 0; c < m; ++c)
    for (Index r = c; r < m; ++r) {
      const double scale = std::sqrt(matrix[c * m + c]) * std::sqrt(matrix[r * m + r]);
      L[c * m + r] = scale > 0.0 ? matrix[c * m + r] / scale : 0.0;
      if (r == c) L[c * m + r] = 1.0 + slack;
    }
  return cholesky(L, m, m, L + m * m);
}

double dot(const double* x, const double* y, Index n) {
  Four even{}, odd{};
  Index i = 0;
  for (; i + 8 <= n; i += 8) {
    even += load(x + i) * load(y + i);
    odd += load(x + i + 4) * load(y + i + 4);
  }
  double sum = 0.0;
  for (Index k = i; k < n; ++k) sum += x[k] * y[k];
  const Four all = even + odd;
  return sum + ((all[0] + all[1]) + (all[2] + all[3]));
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
    x[j] = (x[j] - dot(column + j + 1, x + j + 1, m - j - 1)) / column[j];
  }
}

std::size_t solve_workspace(Index m) {
  return static_cast<std::size_t>(m * m + kRows * m);
}

void solve_right_transposed(const double* L, Index ld, Index m, double* W, Index ldw, Index n, double* workspace,
                            const RowSums* sums) {
  double* rows_of_L = workspace;
  double* strip = workspace + m * m;
  for (Index j = 0; j < m; ++j) {
    for (Index i = 0; i < j; ++i) rows_of_L[j * m + i] = L[i * ld + j];
    rows_of_L[j * m + j] = 1.0 / L[j * ld + j];
  }
  for (Index first = 0; first < n; first += kRows) {
    const Index rows = std::min(kRows, n - first);
    copy_strip(W + first, ldw, strip, kRows, rows, m);
    if (rows < kRows)
      for (Index j = 0; j < m; ++j) std::fill(strip + j * kRows + rows, strip + (j + 1) * kRows, 0.0);
    solve_strip(rows_of_L, m, strip);
    copy_strip(strip, kRows, W + first, ldw, rows, m);
    if (sums != nullptr) sum_strip(strip, m, *sums, first, rows);
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

void leave_out(double* S_inverse, Index m, Index row, Index rows, double* u, double* workspace) {
  double* D = workspace;
  double* B = workspace + rows * rows;  // m x rows, then B L^-T
  for (Index c = 0; c < rows; ++c) {
    for (Index r = 0; r < rows; ++r) D[c * rows + r] = S_inverse[(row + c) * m + row + r];
    std::copy_n(S_inverse + (row + c) * m, m, B + c * m);
  }
  double part[3] = {};
  for (Index r = 0; r < rows; ++r) part[r] = u[row + r];
  if (!cholesky(D, rows, rows)) return;
  solve_lower(D, rows, rows, part);
  for (Index c = 0; c < rows; ++c) {
    for (Index k = 0; k < c; ++k)
      for (Index i = 0; i < m; ++i) B[c * m + i] -= D[k * rows + c] * B[k * m + i];
    for (Index i = 0; i < m; ++i) B[c * m + i] /= D[c * rows + c];
  }
  for (Index c = 0; c < rows; ++c) {
    for (Index i = 0; i < m; ++i) u[i] -= B[c * m + i] * part[c];
    for (Index j = 0; j < m; ++j)
      for (Index i = 0; i < m; ++i) S_inverse[j * m + i] -= B[c * m + i] * B[c * m + j];
  }
}

}  // namespace cairn
