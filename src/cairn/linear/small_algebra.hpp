// SPDX-License-Identifier: BSD-3-Clause
// Dense algebra on column-major blocks that the caller owns. Eigen's own factorisations take temporaries beyond a size;
// an update may take none.
#pragma once

#include <cstddef>

namespace cairn {

using Index = std::ptrdiff_t;

// Lower Cholesky factor of the m x m matrix in place; reads and writes the lower triangle only.
// False, with the matrix spoilt, where a pivot is not positive or not finite.
// `workspace` holds cholesky_workspace(m) doubles: none up to 48.
bool cholesky(double* S, Index ld, Index m, double* workspace = nullptr);
std::size_t cholesky_workspace(Index m);

// Whether a matrix, scaled to unit diagonal, is positive definite with `slack` added to that diagonal; rows without
// variance count as independent of all others. Reads the lower triangle; `L` is room for m^2 + cholesky_workspace(m).
bool positive_definite(const double* matrix, Index m, double slack, double* L);
constexpr double kDefiniteSlack = 1e-9;  // by which rounding may make a semidefinite matrix miss

// x^T y, in several sums at once: the compiler may not reorder one.
double dot(const double* x, const double* y, Index n);

// x <- L^-1 x and x <- L^-T x.
void solve_lower(const double* L, Index ld, Index m, double* x);
void solve_lower_transposed(const double* L, Index ld, Index m, double* x);

// What the pass over W gives besides: the sums of squares of its rows, and W y.
struct RowSums {
  const double* y;
  double* squares;
  double* products;
};

// W <- W L^-T for the n x m matrix W. `workspace` holds solve_workspace(m) doubles.
void solve_right_transposed(const double* L, Index ld, Index m, double* W, Index ldw, Index n, double* workspace,
                            const RowSums* sums = nullptr);
std::size_t solve_workspace(Index m);

// Full symmetric inverse (both triangles) of L L^T into `inverse`, m x m.
void inverse_from_cholesky(const double* L, Index ld, Index m, double* inverse, Index ld_inverse);

// Takes `rows` (up to 3) rows and columns out of a batch whose full S^-1 (m x m) and u = S^-1 r are given; what belongs
// to them is zero then. Block inversion: with S^-1 = [A B; B^T D], the inverse of S without D's rows is A - B D^-1 B^T.
// `workspace` holds rows (rows + m) doubles.
void leave_out(double* S_inverse, Index m, Index row, Index rows, double* u, double* workspace);

}  // namespace cairn
