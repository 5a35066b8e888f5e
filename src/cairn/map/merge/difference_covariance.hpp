// SPDX-License-Identifier: BSD-3-Clause
// The covariance of the differences a - T b of paired points, as a Cholesky factor.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "geometry/se3.hpp"
#include "map/merge/paired_points.hpp"

namespace cairn {

// S = Sigma_a + R Sigma_b R^T. The factor consists of 3x3 blocks if no pair is correlated with another pair.
class DifferenceCovariance {
 public:
  // Returns false if S has no Cholesky factor.
  bool factor(const PairedPoints& pairs, const Matrix3& R);

  // X <- S^-1 X; X is a vector, or a matrix of six columns.
  template <class Matrix>
  void solve(Matrix& X) const;

  // Whether pairs are correlated. If they are, only inverse() may be called, otherwise only inverse_block().
  bool full() const { return full_; }
  Eigen::MatrixXd inverse() const;
  Matrix3 inverse_block(std::size_t i) const;

 private:
  bool full_ = false;
  std::vector<Eigen::LLT<Matrix3>> blocks_;
  Eigen::LLT<Eigen::MatrixXd> dense_;
};

}  // namespace cairn
