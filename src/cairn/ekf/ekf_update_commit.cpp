// SPDX-License-Identifier: BSD-3-Clause
// A commit that needs more digits than P - W W^T has (docs/update.md, "Numbers of very different size").
#include "ekf/ekf_update.hpp"

namespace cairn {

// An update of a pose without points, whose prior is so much wider than the noise that P - W W^T would be rounding
// error. Joseph's form P' = A P A^T + K R K^T with A = I - K H is a sum of positive terms, about the new position as
// origin: about an origin far away, the arm of the attitude would hide the small variance of the position.
template <class Pose>
bool EkfUpdate<Pose>::commit_pose_alone() {
  using Square = typename Pose::Square;
  using Rows = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, kDof>>;
  const Index m = batch().rows(), ld = state_.ld_;
  Square P;
  for (Index c = 0; c < kDof; ++c) std::copy_n(workspace_.columns + c * ld, kDof, P.col(c).data());
  const Tangent error = Eigen::Map<const Tangent>(workspace_.error_state);
  Pose moved = state_.pose_;
  state_.model_.retract(error, moved);
  const Point by = state_.model_.invariant() ? moved.translation() : Point(Point::Zero());
  Square to_new = Square::Identity();  // xi_p about the new origin is xi_p + G(by) xi_R
  if (state_.model_.invariant()) to_new.template topRightCorner<kDim, kTurn>() = state_.model_.arm(by);
  Rows H(workspace_.HP, m, kDof), K(workspace_.scratch, m, kDof), RK(workspace_.columns, m, kDof);
  for (Index c = 0; c < kDof; ++c) {
    const Tangent unit = Tangent::Unit(c);
    H.col(c).setZero();
    batch().add_product(1.0, unit.data(), H.col(c).data());
    for (Index j = 0; j < m; ++j) K(j, c) = workspace_.W[j * ld + c];
    solve_lower_transposed(workspace_.S, m, m, K.col(c).data());
    RK.col(c).setZero();
    batch().add_noise_product(K.col(c).data(), RK.col(c).data());
  }
  const Square KRK = K.transpose().lazyProduct(RK);
  const Square A = to_new * (Square::Identity() - Square(K.transpose().lazyProduct(H)));
  const Square next = A * P * A.transpose() + to_new * KRK * to_new.transpose();
  if (!next.allFinite() || !moved.translation().allFinite() || !(next.diagonal().minCoeff() >= 0.0)) return false;

  for (Index c = 0; c < kDof; ++c)
    for (Index r = c; r < kDof; ++r) state_.P_(r, c) = 0.5 * (next(r, c) + next(c, r));
  state_.motion_.clear();
  state_.pose_ = Pose(moved.rotation(), moved.translation() - by);
  state_.origin_ += by;
  stage_ = Stage::committed;
  return true;
}

template bool EkfUpdate<SE2>::commit_pose_alone();
template bool EkfUpdate<SE3>::commit_pose_alone();

}  // namespace cairn
