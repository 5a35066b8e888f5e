// SPDX-License-Identifier: BSD-3-Clause
// Covariances of a pose's error in other axes.
#pragma once

#include "geometry/types.hpp"

namespace cairn {

// The covariance of an ordinary error (p, theta) in axes that are turned by `turn`. Reads the blocks of p, of p with
// theta, and of theta, and sets both triangles: block by block, because a covariance is turned in every frame.
template <class Pose>
void turn_axes(const typename Pose::Rotation& turn, typename Pose::Square& covariance) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn;
  const typename Pose::Rotation::Matrix R = turn.matrix();
  const typename Pose::Rotation::Jacobian A = turn.adjoint();
  const typename Pose::Rotation::Matrix P = R.lazyProduct(covariance.template topLeftCorner<kDim, kDim>());
  const typename Pose::Rotation::Turn C = R.lazyProduct(covariance.template topRightCorner<kDim, kTurn>());
  const typename Pose::Rotation::Jacobian Q = A.lazyProduct(covariance.template bottomRightCorner<kTurn, kTurn>());
  covariance.template topLeftCorner<kDim, kDim>().noalias() = P.lazyProduct(R.transpose());
  covariance.template topRightCorner<kDim, kTurn>().noalias() = C.lazyProduct(A.transpose());
  covariance.template bottomRightCorner<kTurn, kTurn>().noalias() = Q.lazyProduct(A.transpose());
  covariance.template bottomLeftCorner<kTurn, kDim>() = covariance.template topRightCorner<kDim, kTurn>().transpose();
}

}  // namespace cairn
