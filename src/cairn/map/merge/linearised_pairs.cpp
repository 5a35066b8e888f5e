// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/linearised_pairs.hpp"

#include <cmath>
#include <cstddef>

namespace cairn {

bool LinearisedPairs::evaluate(const PairedPoints& pairs, const SE3& T, double& distance) {
  const std::size_t k = pairs.size();
  if (!covariance_.factor(pairs, T.rotation().matrix())) return false;
  Eigen::VectorXd r(row_of_point(k));
  for (std::size_t i = 0; i < k; ++i) r.segment<3>(row_of_point(i)) = pairs.a[i] - T * pairs.b[i];
  lambda_ = r;
  covariance_.solve(lambda_);
  distance = r.dot(lambda_);
  return std::isfinite(distance);
}

// The derivative is taken at the corrected points b + Sigma_b R^T lambda. There, J^T lambda is exactly half the
// gradient of the distance, although S depends on R.
void LinearisedPairs::linearise(const PairedPoints& pairs, const SE3& T) {
  const std::size_t k = pairs.size();
  const auto at = row_of_point;
  const Matrix3 R = T.rotation().matrix();
  Eigen::VectorXd turned(at(k)), correction(at(k));
  for (std::size_t i = 0; i < k; ++i) turned.segment<3>(at(i)) = R.transpose() * lambda_.segment<3>(at(i));
  if (!pairs.covariance_b.full.empty()) {
    correction.noalias() = pairs.covariance_b.matrix(k) * turned;
  } else {
    for (std::size_t i = 0; i < k; ++i)
      correction.segment<3>(at(i)) = pairs.covariance_b.blocks[i] * turned.segment<3>(at(i));
  }
  centre_.setZero();
  for (const Vector3& b : pairs.b) centre_ += R * b / static_cast<double>(k);
  J_.resize(at(k), 6);
  for (std::size_t i = 0; i < k; ++i) {
    const Vector3 arm = R * (pairs.b[i] + correction.segment<3>(at(i))) - centre_;
    J_.block<3, 3>(at(i), 0) = -Matrix3::Identity();
    J_.block<3, 3>(at(i), 3) = hat(arm);
  }
  V_ = J_;
  covariance_.solve(V_);
}

Matrix6 LinearisedPairs::to_ordinary() const {
  Matrix6 A = Matrix6::Identity();
  A.topRightCorner<3, 3>() = hat(centre_);  // dp = dq - dtheta x centre
  return A;
}

}  // namespace cairn
