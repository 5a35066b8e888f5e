// SPDX-License-Identifier: BSD-3-Clause
// Small covariances that may be singular: a vehicle that cannot slip sideways has no noise there.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/types.hpp"

namespace cairn {

// A lower factor L with L L^T = S. A direction whose pivot is zero after scaling to unit diagonal has a column of
// zeros; `rank` gets the number of the other ones, `smallest` the smallest scaled pivot of a row that has a variance.
template <class Square>
Square semidefinite_factor(const Square& S, int* rank = nullptr, double* smallest = nullptr) {
  constexpr int n = Square::RowsAtCompileTime;
  constexpr double kZero = 1e-10;
  Eigen::Matrix<double, n, 1> scale, per_scale;
  for (int i = 0; i < n; ++i) {
    scale(i) = S(i, i) > 0.0 ? std::sqrt(S(i, i)) : 0.0;
    per_scale(i) = scale(i) > 0.0 ? 1.0 / scale(i) : 0.0;
  }
  Square L = Square::Zero();
  int count = 0;
  double least = 1.0;
  for (int c = 0; c < n; ++c) {
    if (scale(c) == 0.0) continue;
    double pivot = 1.0;
    for (int k = 0; k < c; ++k) pivot -= L(c, k) * L(c, k);
    least = std::min(least, pivot);
    if (!(pivot > kZero)) continue;
    ++count;
    L(c, c) = std::sqrt(pivot);
    const double per_pivot = 1.0 / L(c, c);
    for (int r = c + 1; r < n; ++r) {
      if (scale(r) == 0.0) continue;
      double value = S(r, c) * per_scale(r) * per_scale(c);
      for (int k = 0; k < c; ++k) value -= L(r, k) * L(c, k);
      L(r, c) = value * per_pivot;
    }
  }
  if (rank != nullptr) *rank = count;
  if (smallest != nullptr) *smallest = least;
  return scale.asDiagonal() * L;
}

// b^T S^+ b for b in the range of S = L L^T.
template <class Square, class Vector>
double semidefinite_square(const Square& L, Vector b) {
  constexpr int n = Square::RowsAtCompileTime;
  double sum = 0.0;
  for (int c = 0; c < n; ++c) {
    if (L(c, c) == 0.0) continue;
    const double y = b(c) / L(c, c);
    sum += y * y;
    for (int r = c + 1; r < n; ++r) b(r) -= L(r, c) * y;
  }
  return sum;
}

}  // namespace cairn
