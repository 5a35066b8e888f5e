// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/transform_iterate.hpp"

#include <Eigen/Eigenvalues>

namespace cairn {

TransformIterate::TransformIterate(const TransformPrior* prior) : prior_(prior) {
  if (prior_ == nullptr) return;
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(prior_->covariance);
  G_ = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  T_ = prior_->T_a_b;
}

Matrix6 TransformIterate::chain(const Vector3& centre) const {
  if (prior_ == nullptr) return Matrix6::Identity();
  const Vector6 error = G_ * u_;
  Matrix6 to_T = Matrix6::Identity(), to_centre = Matrix6::Identity();
  to_T.bottomRightCorner<3, 3>() = SO3::left_jacobian(error.tail<3>());
  to_centre.topRightCorner<3, 3>() = -hat(centre);
  return to_centre * to_T * G_;
}

TransformIterate TransformIterate::moved(const Vector6& step, const Vector3& centre) const {
  TransformIterate next = *this;
  if (prior_ == nullptr) {
    const SO3 turn = SO3::exp(step.tail<3>());
    next.T_ = SE3(turn * T_.rotation(), T_.translation() + step.head<3>() + centre - turn * centre);
  } else {
    next.u_ += step;
    next.T_ = retract(prior_->T_a_b, G_ * next.u_);
  }
  return next;
}

}  // namespace cairn
