// SPDX-License-Identifier: BSD-3-Clause
// What tells where the body is in the map, or how it is turned there: GNSS, a star tracker, a compass.
#pragma once

#include "geometry/se3.hpp"
#include "geometry/types.hpp"

namespace cairn {

class AbsoluteFix {
 public:
  // z = p + R lever_arm
  static AbsoluteFix position(const Vector3& position, const Matrix3& covariance, const Vector3& lever_arm);
  // `covariance` is that of dtheta in the map's axes: true R = Exp(dtheta) measured R.
  static AbsoluteFix attitude(const SO3& attitude, const Matrix3& covariance);
  // Yaw of the body's x axis in the map.
  static AbsoluteFix heading(double heading, double sigma);

  int rows() const { return kind_ == Kind::heading ? 1 : 3; }
  // Upper left rows() x rows() block.
  const Matrix3& covariance() const { return covariance_; }
  // False where the pose has no such value: a heading where the x axis stands within 5 degrees of the vertical.
  bool defined(const SE3& T_map_body) const;
  // z - h and dh/[dp; dtheta]; the first rows() rows count.
  Vector3 residual(const SE3& T_map_body) const;
  Matrix36 jacobian(const SE3& T_map_body) const;

 private:
  enum class Kind { position, attitude, heading };

  Kind kind_ = Kind::position;
  Vector3 position_ = Vector3::Zero();
  Vector3 lever_arm_ = Vector3::Zero();
  SO3 attitude_;
  double heading_ = 0.0;
  Matrix3 covariance_ = Matrix3::Zero();
};

}  // namespace cairn
