// SPDX-License-Identifier: BSD-3-Clause
// The distance between paired points at one transform, and its linearisation.
#pragma once

#include <Eigen/Core>

#include "geometry/se3.hpp"
#include "map/merge/difference_covariance.hpp"
#include "map/merge/paired_points.hpp"

namespace cairn {

// The weighted differences a - T b at one transform, with their derivative by [dq; dtheta]: dq moves the centre of the
// points. A derivative by the ordinary error [dp; dtheta] is ill-conditioned: far from the origin, dp and dtheta have
// nearly the same effect.
class LinearisedPairs {
 public:
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 6>;

  // Computes the differences at T. `distance` is their squared Mahalanobis distance. Returns false if their covariance
  // has no Cholesky factor, or if the distance is not finite.
  bool evaluate(const PairedPoints& pairs, const SE3& T, double& distance);
  // Computes the derivative at T, where evaluate() came last.
  void linearise(const PairedPoints& pairs, const SE3& T);

  const DifferenceCovariance& covariance() const { return covariance_; }  // S
  const Eigen::VectorXd& lambda() const { return lambda_; }               // S^-1 (a - T b)
  const Columns& J() const { return J_; }
  const Columns& V() const { return V_; }  // S^-1 J
  const Vector3& centre() const { return centre_; }
  // The derivative of [dp; dtheta] by [dq; dtheta].
  Matrix6 to_ordinary() const;

 private:
  DifferenceCovariance covariance_;
  Eigen::VectorXd lambda_;
  Columns J_, V_;
  Vector3 centre_;  // mean of R b
};

}  // namespace cairn
