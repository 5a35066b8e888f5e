// SPDX-License-Identifier: BSD-3-Clause
// Dense algebra on column-major blocks that the caller owns. Eigen's factorisations of large matrices allocate
// temporaries; an update must not allocate.
#pragma once

#include <cstddef>

namespace cairn {

using Index = std::ptrdiff_t;

// Lower Cholesky factor of the m x m matrix in place; reads and writes only the lower triangle.
// Returns false if a pivot is not positive or not finite; the matrix is then invalid.
// `workspace` holds cholesky_workspace(m) doubles: none up to 48.
bool cholesky(double* S, Index ld, Index m, double* workspace = nullptr);
std::size_t cholesky_workspace(Index m);

// Partial Cholesky factor of the n x n matrix [A B^T; B C] in place, with A e x e: A = L L^T, B becomes B L^-T, and C
// becomes C - B A^-1 B^T. The same conditions; `workspace` holds eliminate_workspace(n) doubles.
bool eliminate(double* S, Index ld, Index n, Index e, double* workspace);
std::size_t eliminate_workspace(Index n);

// Whether a matrix, scaled to unit diagonal, is positive definite with `slack` added to that diagonal; rows without
// variance count as independent of all others. Reads the lower triangle; `L` is room for m^2 + cholesky_workspace(m).
bool positive_definite(const double* matrix, Index m, double slack, double* L);
constexpr double kDefiniteSlack = 1e-9;  // rounding may make a semidefinite matrix indefinite by this much

// x^T y, in several sums at once: the compiler may not reorder one.
double dot(const double* x, const double* y, Index n);

// x <- L^-1 x and x <- L^-T x.
void solve_lower(const double* L, Index ld, Index m, double* x);
void solve_lower_transposed(const double* L, Index ld, Index m, double* x);

// Further results of the pass over W: the sums of squares of its rows, and W y.
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

// Removes `rows` (up to 3) rows and columns from a batch whose full S^-1 (m x m) and u = S^-1 r are given; their
// entries become zero. Block inversion: with S^-1 = [A B; B^T D], the inverse of S without D's rows is A - B D^-1 B^T.
// `workspace` holds rows (rows + m) doubles.
void leave_out(double* S_inverse, Index m, Index row, Index rows, double* u, double* workspace);

}  // namespace cairn
