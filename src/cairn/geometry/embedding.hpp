// SPDX-License-Identifier: BSD-3-Clause
// The plane z = 0 in space, with rotations about z only. The C interface is spatial; planar filters compute in the
// plane.
#pragma once

#include <cmath>

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"

namespace cairn {

// up() goes from the plane to space and is exact. down() goes from space to the plane and drops the other components.
// The error of a pose is [dp; dtheta] in both. A spatial pose needs no conversion.
template <class Pose>
struct Embedding;

template <>
struct Embedding<SE3> {
  static const SE3& up(const SE3& T) { return T; }
  static const Vector3& up(const Vector3& p) { return p; }
  static const Matrix3& up(const Matrix3& C) { return C; }
  static const Matrix6& up(const Matrix6& C) { return C; }
  static const SE3& down(const SE3& T) { return T; }
  static const Vector3& down(const Vector3& p) { return p; }
  static const Vector6& down(const Vector6& error) { return error; }
  static const Matrix3& down(const Matrix3& C) { return C; }
  static const Matrix6& down(const Matrix6& C) { return C; }
  static constexpr int axis(int error) { return error; }  // index in the spatial [dp; dtheta] of a component of Pose's
  // Columns of a spatial Jacobian that Pose has: by the error of a pose, by a point.
  static const Matrix36& by_pose(const Matrix36& J) { return J; }
  static const Matrix3& by_point(const Matrix3& J) { return J; }
};

template <>
struct Embedding<SE2> {
  static constexpr int kAxes[3] = {0, 1, 5};  // x, y and yaw in the spatial [dp; dtheta]
  static constexpr int axis(int error) { return kAxes[error]; }

  static SE3 up(const SE2& T) {
    const double half = 0.5 * T.rotation().angle();
    return SE3(SO3::from_quaternion(std::cos(half), 0.0, 0.0, std::sin(half)), up(T.translation()));
  }
  static Vector3 up(const Vector2& p) { return Vector3(p.x(), p.y(), 0.0); }
  static Matrix3 up(const Matrix2& C) {
    Matrix3 out = Matrix3::Zero();
    out.topLeftCorner<2, 2>() = C;
    return out;
  }
  static Matrix6 up(const Matrix3& C) {
    Matrix6 out = Matrix6::Zero();
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) out(kAxes[r], kAxes[c]) = C(r, c);
    return out;
  }
  static SE2 down(const SE3& T) {
    const Vector3 x = T.rotation() * Vector3::UnitX();
    return SE2(SO2::from_angle(std::atan2(x.y(), x.x())), down(T.translation()));
  }
  static Vector2 down(const Vector3& p) { return p.head<2>(); }
  static Vector3 down(const Vector6& error) { return Vector3(error[0], error[1], error[5]); }
  static Matrix2 down(const Matrix3& C) { return C.topLeftCorner<2, 2>(); }
  static Matrix3 down(const Matrix6& C) {
    Matrix3 out;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) out(r, c) = C(kAxes[r], kAxes[c]);
    return out;
  }
  static Matrix3 by_pose(const Matrix36& J) {
    Matrix3 out;
    for (int c = 0; c < 3; ++c) out.col(c) = J.col(kAxes[c]);
    return out;
  }
  static Matrix32 by_point(const Matrix3& J) { return J.leftCols<2>(); }
};

}  // namespace cairn
