// SPDX-License-Identifier: BSD-3-Clause
// The Cholesky factor of the covariance of one observation, with a size that the compiler knows. An observation with
// fewer values has rows of the unit matrix at the end, which change nothing.
#pragma once

#include <cmath>

#include "geometry/types.hpp"

namespace cairn {

class SmallFactor {
 public:
  // Reads the lower triangle of the first `rows` rows of S = L L^T.
  SmallFactor(const Matrix3& S, std::ptrdiff_t rows) {
    const double d0 = S(0, 0);
    definite_ = d0 > 0.0;
    inverse_[0] = 1.0 / std::sqrt(d0);
    if (rows > 1) {
      l10_ = S(1, 0) * inverse_[0];
      const double d1 = S(1, 1) - l10_ * l10_;
      definite_ = definite_ && d1 > 0.0;
      inverse_[1] = 1.0 / std::sqrt(d1);
    }
    if (rows > 2) {
      l20_ = S(2, 0) * inverse_[0];
      l21_ = (S(2, 1) - l20_ * l10_) * inverse_[1];
      const double d2 = S(2, 2) - l20_ * l20_ - l21_ * l21_;
      definite_ = definite_ && d2 > 0.0;
      inverse_[2] = 1.0 / std::sqrt(d2);
    }
  }

  bool definite() const { return definite_; }

  // x <- L^-1 x for each column of a matrix of three rows.
  template <class Columns>
  void solve(Columns& X) const {
    for (int c = 0; c < Columns::ColsAtCompileTime; ++c) {
      const double x0 = X(0, c) * inverse_[0], x1 = (X(1, c) - l10_ * x0) * inverse_[1];
      X(0, c) = x0;
      X(1, c) = x1;
      X(2, c) = (X(2, c) - l20_ * x0 - l21_ * x1) * inverse_[2];
    }
  }

 private:
  bool definite_;
  double inverse_[3] = {1.0, 1.0, 1.0};  // of the diagonal of L
  double l10_ = 0.0, l20_ = 0.0, l21_ = 0.0;
};

}  // namespace cairn
