// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/absolute_fix.hpp"

#include <cmath>

#include "geometry/angle.hpp"

namespace cairn {

AbsoluteFix AbsoluteFix::position(const Vector3& position, const Matrix3& covariance, const Vector3& lever_arm) {
  AbsoluteFix fix;
  fix.kind_ = Kind::position;
  fix.position_ = position;
  fix.lever_arm_ = lever_arm;
  fix.covariance_ = covariance;
  return fix;
}

AbsoluteFix AbsoluteFix::attitude(const SO3& attitude, const Matrix3& covariance) {
  AbsoluteFix fix;
  fix.kind_ = Kind::attitude;
  fix.attitude_ = attitude;
  fix.covariance_ = covariance;
  return fix;
}

AbsoluteFix AbsoluteFix::heading(double heading, double sigma) {
  AbsoluteFix fix;
  fix.kind_ = Kind::heading;
  fix.heading_ = heading;
  fix.covariance_(0, 0) = sigma * sigma;
  return fix;
}

bool AbsoluteFix::defined(const SE3& T_map_body) const {
  constexpr double kMinimumLevel = 0.0871557427476582;  // sin of 5 degrees
  return kind_ != Kind::heading || (T_map_body.rotation() * Vector3::UnitX()).head<2>().norm() >= kMinimumLevel;
}

Vector3 AbsoluteFix::residual(const SE3& T_map_body) const {
  switch (kind_) {
    case Kind::position:
      return position_ - T_map_body.translation() - T_map_body.rotation() * lever_arm_;
    case Kind::attitude:
      return (attitude_ * T_map_body.rotation().inverse()).log();
    case Kind::heading:
      break;
  }
  const Vector3 a = T_map_body.rotation() * Vector3::UnitX();
  return Vector3(wrap_angle(heading_ - std::atan2(a.y(), a.x())), 0.0, 0.0);
}

Matrix36 AbsoluteFix::jacobian(const SE3& T_map_body) const {
  Matrix36 J = Matrix36::Zero();
  switch (kind_) {
    case Kind::position:  // h = p + R a
      J << Matrix3::Identity(), SO3::turn(T_map_body.rotation() * lever_arm_);
      break;
    case Kind::attitude:  // Log(R_z (Exp(theta) R)^T) = r - J_r(r)^-1 theta, and J_r(r) = J_l(-r)
      J.rightCols<3>() = SO3::left_jacobian_inverse(-residual(T_map_body));
      break;
    case Kind::heading: {  // d atan2(a_y, a_x) for da = theta x a
      const Vector3 a = T_map_body.rotation() * Vector3::UnitX();
      const double level_squared = a.head<2>().squaredNorm();
      J.row(0) << 0.0, 0.0, 0.0, -a.x() * a.z() / level_squared, -a.y() * a.z() / level_squared, 1.0;
      break;
    }
  }
  return J;
}

}  // namespace cairn
