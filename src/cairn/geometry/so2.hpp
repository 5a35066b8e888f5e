// SPDX-License-Identifier: BSD-3-Clause
// Rotations in the plane, with the interface of SO3, so that one template serves both.
#pragma once

#include <cmath>

#include "geometry/stumpff.hpp"
#include "geometry/types.hpp"

namespace cairn {

// A rotation, stored as the unit vector (cos, sin). Its tangent is the angle, anticlockwise positive.
class SO2 {
 public:
  static constexpr int kDim = 2, kTurn = 1;
  using Point = Vector2;
  using Tangent = Vector1;
  using Matrix = Matrix2;
  using Jacobian = Vector1;                         // tangent by tangent
  using Turn = Eigen::Matrix<double, kDim, kTurn>;  // point by tangent

  SO2() : u_(1, 0) {}

  static SO2 from_angle(double angle) { return SO2(Vector2(std::cos(angle), std::sin(angle))); }
  // `u` must have length 1 and is stored unchanged.
  static SO2 from_unit(const Vector2& u) { return SO2(u); }
  static SO2 from_matrix(const Matrix2& R) { return SO2(R.col(0).normalized()); }
  static SO2 exp(const Vector1& theta) { return from_angle(theta[0]); }

  // In [-pi, pi].
  double angle() const { return std::atan2(u_.y(), u_.x()); }
  Vector1 log() const { return Vector1(angle()); }

  Matrix2 matrix() const {
    Matrix2 R;
    R << u_.x(), -u_.y(), u_.y(), u_.x();
    return R;
  }
  SO2 inverse() const { return SO2(Vector2(u_.x(), -u_.y())); }
  // Renormalises, so that a long product stays a rotation.
  SO2 operator*(const SO2& other) const { return SO2((*this * other.u_).normalized()); }
  Vector2 operator*(const Vector2& x) const {
    return Vector2(u_.x() * x.x() - u_.y() * x.y(), u_.y() * x.x() + u_.x() * x.y());
  }
  Vector1 adjoint() const { return Vector1(1.0); }
  Vector1 adjoint(const Vector1& theta) const { return theta; }    // adjoint() theta
  double chord() const { return (u_ - Vector2::UnitX()).norm(); }  // 2 sin(angle / 2)

  // Rotations about one axis commute.
  static Vector1 left_jacobian(const Vector1&) { return Vector1(1.0); }
  static Vector1 left_jacobian_inverse(const Vector1&) { return Vector1(1.0); }

  // d(Exp(theta) x) / dtheta at theta = 0.
  static Turn turn(const Vector2& x) { return Turn(-x.y(), x.x()); }
  // With T = turn(x): T theta, T^T f and T^T T.
  static Vector2 swing(const Vector1& theta, const Vector2& x) { return theta[0] * turn(x); }
  static Vector1 moment(const Vector2& x, const Vector2& f) { return Vector1(x.x() * f.y() - x.y() * f.x()); }
  static Vector1 inertia(const Vector2& x) { return Vector1(x.squaredNorm()); }

  // Translation of Exp([rho; theta]) is translation_jacobian(theta) rho.
  static Matrix2 translation_jacobian(const Vector1& theta) {
    const Stumpff c(theta[0] * theta[0]);
    return complex(c.c1, theta[0] * c.c2);
  }
  // For |theta| < 2 pi.
  static Matrix2 translation_jacobian_inverse(const Vector1& theta) {
    const Stumpff c(theta[0] * theta[0]);
    return complex(c.c1 / (2 * c.c2), -0.5 * theta[0]);
  }

  // Upper right block of the left Jacobian of poses.
  static Turn translation_coupling(const Vector2& rho, const Vector1& theta) {
    const Stumpff c(theta[0] * theta[0]);
    return theta[0] * c.c3 * rho - c.c2 * turn(rho);
  }

 private:
  explicit SO2(const Vector2& u) : u_(u) {}

  static Matrix2 complex(double re, double im) {
    Matrix2 A;
    A << re, -im, im, re;
    return A;
  }

  Vector2 u_;
};

}  // namespace cairn
