// SPDX-License-Identifier: BSD-3-Clause
// Rotations in space.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/stumpff.hpp"
#include "geometry/types.hpp"

namespace cairn {

// The matrix of the cross product: hat(a) b = a x b.
inline Matrix3 hat(const Vector3& a) {
  Matrix3 A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

// A rotation, stored as a unit quaternion (Hamilton). Its tangent is the rotation vector, axis times angle.
class SO3 {
 public:
  static constexpr int kDim = 3, kTurn = 3;
  using Point = Vector3;
  using Tangent = Vector3;
  using Matrix = Matrix3;
  using Jacobian = Matrix3;                         // tangent by tangent
  using Turn = Eigen::Matrix<double, kDim, kTurn>;  // point by tangent

  SO3() : q_(Eigen::Quaterniond::Identity()) {}

  // Normalises; the quaternion must be finite and not zero.
  static SO3 from_quaternion(double w, double x, double y, double z) {
    Eigen::Quaterniond q(w, x, y, z);
    q.coeffs().stableNormalize();
    return SO3(q);
  }

  static SO3 from_matrix(const Matrix3& R) { return SO3(Eigen::Quaterniond(R).normalized()); }

  static SO3 exp(const Vector3& theta) {
    const double x = theta.squaredNorm();
    // s = sin(theta / 2) / theta. Below the bound the next term of the series, theta^4 / 3840, is less than the
    // rounding of 1/2.
    const double angle = std::sqrt(x);
    const double s = x < 1e-8 ? 0.5 - x / 48 : std::sin(0.5 * angle) / angle;
    return SO3(Eigen::Quaterniond(std::cos(0.5 * angle), s * theta.x(), s * theta.y(), s * theta.z()));
  }

  // Rotation vector of length at most pi. It is computed from the quaternion, so that half turns need no special case.
  Vector3 log() const {
    const double sine = q_.vec().norm(), cosine = q_.w();
    // q and -q are the same rotation: take the one with the smaller angle.
    const double sign = cosine < 0 ? -1 : 1;
    if (sine < 1e-10) return (2 * sign) * q_.vec();
    return (2 * sign * std::atan2(sine, std::abs(cosine)) / sine) * q_.vec();
  }

  Matrix3 matrix() const { return q_.toRotationMatrix(); }
  const Eigen::Quaterniond& quaternion() const { return q_; }
  SO3 inverse() const { return SO3(q_.conjugate()); }
  // Renormalises, so that a long product stays a rotation.
  SO3 operator*(const SO3& other) const { return SO3((q_ * other.q_).normalized()); }
  Vector3 operator*(const Vector3& x) const { return q_ * x; }
  Matrix3 adjoint() const { return matrix(); }
  Vector3 adjoint(const Vector3& theta) const { return q_ * theta; }  // adjoint() theta
  double chord() const { return 2.0 * q_.vec().norm(); }              // 2 sin(angle / 2)

  // Exp(theta + d) = Exp(left_jacobian(theta) d) Exp(theta) to first order in d.
  static Matrix3 left_jacobian(const Vector3& theta) {
    const Stumpff c(theta.squaredNorm());
    const Matrix3 A = hat(theta);
    return Matrix3::Identity() + c.c2 * A + c.c3 * (A * A);
  }

  // For |theta| < 2 pi. The usual factor 1/theta^2 - (1 + cos) / (2 theta sin) is (c3 - 2 c4) / (2 c2), which has a
  // value at 0 and at pi.
  static Matrix3 left_jacobian_inverse(const Vector3& theta) {
    const Stumpff c(theta.squaredNorm());
    const Matrix3 A = hat(theta);
    return Matrix3::Identity() - 0.5 * A + ((c.c3 - 2 * c.c4) / (2 * c.c2)) * (A * A);
  }

  // d(Exp(theta) x) / dtheta at theta = 0.
  static Turn turn(const Vector3& x) { return -hat(x); }
  // With T = turn(x): T theta, T^T f and T^T T.
  static Vector3 swing(const Vector3& theta, const Vector3& x) { return theta.cross(x); }
  static Vector3 moment(const Vector3& x, const Vector3& f) { return x.cross(f); }
  static Matrix3 inertia(const Vector3& x) { return x.squaredNorm() * Matrix3::Identity() - x * x.transpose(); }

  // Translation of Exp([rho; theta]) is translation_jacobian(theta) rho.
  static Matrix3 translation_jacobian(const Vector3& theta) { return left_jacobian(theta); }
  static Matrix3 translation_jacobian_inverse(const Vector3& theta) { return left_jacobian_inverse(theta); }

  // Upper right block of the left Jacobian of poses (Barfoot, State Estimation for Robotics, eq. 7.86).
  static Turn translation_coupling(const Vector3& rho, const Vector3& theta) {
    const Stumpff c(theta.squaredNorm());
    const Matrix3 A = hat(theta), B = hat(rho), AB = A * B, BA = B * A, ABA = AB * A;
    return 0.5 * B + c.c3 * (AB + BA + ABA) + c.c4 * (A * AB + BA * A - 3 * ABA) +
           0.5 * (c.c4 - 3 * c.c5) * (ABA * A + A * ABA);
  }

 private:
  explicit SO3(const Eigen::Quaterniond& q) : q_(q) {}

  Eigen::Quaterniond q_;
};

}  // namespace cairn
