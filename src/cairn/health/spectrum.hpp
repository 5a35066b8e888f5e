// SPDX-License-Identifier: BSD-3-Clause
// The eigenvalues of a small symmetric matrix, and the components of one vector along its eigenvectors.
#pragma once

#include <cmath>
#include <limits>

#include "geometry/types.hpp"

namespace cairn {

// A = V diag(values) V^T and along = V^T b. The rotations that make A diagonal are applied to b only: V itself, which
// costs most, is not formed. Householder's tridiagonal form, then implicit QL steps (EISPACK, tred2 and imtql2). The
// order of the values is arbitrary. They are NaN or wrong if A is not finite.
template <class Square>
struct Spectrum {
  static constexpr int n = Square::RowsAtCompileTime;
  using Vector = Eigen::Matrix<double, n, 1>;

  Spectrum(Square A, const Vector& b) : along(b) {
    tridiagonalise(A);
    for (int first = 0; first < n; ++first) {
      constexpr int kMostSteps = 30;  // two or three are needed
      for (int step = 0; step < kMostSteps; ++step) {
        const int last = end_of_block(first);
        if (last == first) break;
        ql_step(first, last);
      }
    }
  }

  Vector values, along;

 private:
  void tridiagonalise(Square& A) {
    for (int k = 0; k < n; ++k) {
      double squares = 0.0;
      for (int i = k + 2; i < n; ++i) squares += A(i, k) * A(i, k);
      if (squares > 0.0) reflect(A, k, squares);
      values(k) = A(k, k);
      off_(k) = k + 1 < n ? A(k + 1, k) : 0.0;
    }
  }

  // Makes column k zero below the subdiagonal, by I - v v^T / half with half = |v|^2 / 2.
  void reflect(Square& A, int k, double squares) {
    const double size = std::sqrt(A(k + 1, k) * A(k + 1, k) + squares);
    const double to = A(k + 1, k) > 0.0 ? -size : size;
    const double per_half = 1.0 / (size * (size + std::abs(A(k + 1, k))));
    double v[n] = {}, w[n] = {};
    v[k + 1] = A(k + 1, k) - to;
    for (int i = k + 2; i < n; ++i) v[i] = A(i, k);
    A(k + 1, k) = to;
    for (int j = k + 1; j < n; ++j)
      for (int i = k + 1; i < n; ++i) w[i] += A(i, j) * v[j];
    double product = 0.0, of_b = 0.0;
    for (int i = k + 1; i < n; ++i) {
      w[i] *= per_half;
      product += w[i] * v[i];
      of_b += v[i] * along(i);
    }
    for (int i = k + 1; i < n; ++i) {
      w[i] -= 0.5 * product * per_half * v[i];
      along(i) -= of_b * per_half * v[i];
    }
    for (int j = k + 1; j < n; ++j)
      for (int i = k + 1; i < n; ++i) A(i, j) -= v[i] * w[j] + w[i] * v[j];
  }

  // The last row of the block that begins at `first` and is not diagonal yet.
  int end_of_block(int first) const {
    int last = first;
    while (last + 1 < n && !(std::abs(off_(last)) <= std::numeric_limits<double>::epsilon() *
                                                         (std::abs(values(last)) + std::abs(values(last + 1)))))
      ++last;
    return last;
  }

  void ql_step(int first, int last) {
    double g = 0.5 * (values(first + 1) - values(first)) / off_(first);
    g = values(last) - values(first) + off_(first) / (g + std::copysign(std::sqrt(g * g + 1.0), g));
    double s = 1.0, c = 1.0, p = 0.0;
    for (int i = last - 1; i >= first; --i) {
      const double f = s * off_(i), b = c * off_(i), r = std::sqrt(f * f + g * g);
      off_(i + 1) = r;
      if (r == 0.0) {  // the block has come apart
        values(i + 1) -= p;
        off_(last) = 0.0;
        return;
      }
      s = f / r;
      c = g / r;
      g = values(i + 1) - p;
      const double q = (values(i) - g) * s + 2.0 * c * b;
      p = s * q;
      values(i + 1) = g + p;
      g = c * q - b;
      const double upper = along(i), lower = along(i + 1);
      along(i + 1) = s * upper + c * lower;
      along(i) = c * upper - s * lower;
    }
    values(first) -= p;
    off_(first) = g;
    off_(last) = 0.0;
  }

  Vector off_;  // beside the diagonal
};

}  // namespace cairn
