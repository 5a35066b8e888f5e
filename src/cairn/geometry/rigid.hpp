// SPDX-License-Identifier: BSD-3-Clause
// Poses in the plane and in space: one template over the rotation group.
#pragma once

#include "geometry/types.hpp"

namespace cairn {

// A pose T_a_b takes points from frame b to frame a: p_a = R p_b + t. Tangents of the group are [rho; theta],
// translation first. The ordinary error [dp; dtheta] of a pose is not such a tangent xi: dp = xi_p + turn(t) xi_R and
// dtheta = xi_R to first order (docs/notation.md).
template <class RotationGroup>
class Rigid {
 public:
  using Rotation = RotationGroup;
  static constexpr int kDim = Rotation::kDim, kTurn = Rotation::kTurn, kDof = kDim + kTurn;
  using Point = typename Rotation::Point;
  using Tangent = Eigen::Matrix<double, kDof, 1>;
  using Square = Eigen::Matrix<double, kDof, kDof>;

  Rigid() : t_(Point::Zero()) {}
  Rigid(const Rotation& rotation, const Point& translation) : R_(rotation), t_(translation) {}

  const Rotation& rotation() const { return R_; }
  const Point& translation() const { return t_; }

  static Rigid exp(const Tangent& tau) {
    const typename Rotation::Tangent theta = tau.template tail<kTurn>();
    return Rigid(Rotation::exp(theta), Rotation::translation_jacobian(theta) * tau.template head<kDim>());
  }

  Tangent log() const {
    const typename Rotation::Tangent theta = R_.log();
    Tangent tau;
    tau << Rotation::translation_jacobian_inverse(theta) * t_, theta;
    return tau;
  }

  Rigid inverse() const {
    const Rotation R_inverse = R_.inverse();
    return Rigid(R_inverse, -(R_inverse * t_));
  }
  Rigid operator*(const Rigid& other) const { return Rigid(R_ * other.R_, t_ + R_ * other.t_); }
  Point operator*(const Point& x) const { return t_ + R_ * x; }

  // T Exp(tau) = Exp(adjoint() tau) T.
  Square adjoint() const { return blocks(R_.matrix(), -Rotation::turn(t_) * R_.adjoint(), R_.adjoint()); }

  // Turns an ordinary error [dp; dtheta] from the axes before R to those after it: R for dp, adjoint of R for dtheta.
  static Square turn_axes(const Rotation& R) { return blocks(R.matrix(), Rotation::Turn::Zero(), R.adjoint()); }

  // Exp(tau + d) = Exp(left_jacobian(tau) d) Exp(tau) to first order in d.
  static Square left_jacobian(const Tangent& tau) {
    const typename Rotation::Tangent theta = tau.template tail<kTurn>();
    return blocks(Rotation::translation_jacobian(theta),
                  Rotation::translation_coupling(tau.template head<kDim>(), theta), Rotation::left_jacobian(theta));
  }

  // For |theta| < 2 pi.
  static Square left_jacobian_inverse(const Tangent& tau) {
    const typename Rotation::Tangent theta = tau.template tail<kTurn>();
    const typename Rotation::Matrix V_inverse = Rotation::translation_jacobian_inverse(theta);
    const typename Rotation::Jacobian J_inverse = Rotation::left_jacobian_inverse(theta);
    return blocks(V_inverse, -V_inverse * Rotation::translation_coupling(tau.template head<kDim>(), theta) * J_inverse,
                  J_inverse);
  }

 private:
  static Square blocks(const typename Rotation::Matrix& point, const typename Rotation::Turn& coupling,
                       const typename Rotation::Jacobian& turn) {
    Square A;
    A.template topLeftCorner<kDim, kDim>() = point;
    A.template topRightCorner<kDim, kTurn>() = coupling;
    A.template bottomLeftCorner<kTurn, kDim>().setZero();
    A.template bottomRightCorner<kTurn, kTurn>() = turn;
    return A;
  }

  Rotation R_;
  Point t_;
};

// The pose whose ordinary error [dp; dtheta] against `pose` is `error`: p + dp, Exp(dtheta) R (docs/notation.md).
template <class Rotation>
Rigid<Rotation> retract(const Rigid<Rotation>& pose, const typename Rigid<Rotation>::Tangent& error) {
  using Pose = Rigid<Rotation>;
  const typename Rotation::Tangent dtheta = error.template tail<Pose::kTurn>();
  return Pose(Rotation::exp(dtheta) * pose.rotation(), pose.translation() + error.template head<Pose::kDim>());
}

// The ordinary error of `estimate`: retract(estimate, pose_error(truth, estimate)) is `truth`.
template <class Rotation>
typename Rigid<Rotation>::Tangent pose_error(const Rigid<Rotation>& truth, const Rigid<Rotation>& estimate) {
  typename Rigid<Rotation>::Tangent error;
  error << truth.translation() - estimate.translation(), (truth.rotation() * estimate.rotation().inverse()).log();
  return error;
}

// Derivative of pose_error(truth, estimate) by the ordinary error of `truth`.
template <class Rotation>
typename Rigid<Rotation>::Square pose_error_jacobian(const Rigid<Rotation>& truth, const Rigid<Rotation>& estimate) {
  using Pose = Rigid<Rotation>;
  typename Pose::Square J = Pose::Square::Identity();
  J.template bottomRightCorner<Pose::kTurn, Pose::kTurn>() =
      Rotation::left_jacobian_inverse((truth.rotation() * estimate.rotation().inverse()).log());
  return J;
}

// The ordinary error of a product T_a T_b is by_a e_a + by_b e_b: e_p = e_pa + turn(R_a p_b) e_Ra + R_a e_pb and
// e_R = e_Ra + R_a e_Rb.
template <class Rotation>
struct ProductJacobians {
  using Pose = Rigid<Rotation>;
  ProductJacobians(const Pose& T_a, const Pose& T_b) {
    by_a.template topRightCorner<Pose::kDim, Pose::kTurn>() = Rotation::turn(T_a.rotation() * T_b.translation());
    by_b = Pose::turn_axes(T_a.rotation());
  }
  // Covariance of the product's error if the errors of the two factors are independent.
  typename Pose::Square covariance(const typename Pose::Square& P_a, const typename Pose::Square& P_b) const {
    const typename Pose::Square own = by_b * P_b * by_b.transpose();
    const typename Pose::Square lower = by_a * P_a * by_a.transpose() + own;
    return lower.template selfadjointView<Eigen::Lower>();
  }
  typename Pose::Square by_a = Pose::Square::Identity(), by_b;
};

}  // namespace cairn
