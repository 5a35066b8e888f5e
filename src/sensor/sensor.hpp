// SPDX-License-Identifier: BSD-3-Clause
// What the filter asks of a sensor that sees landmarks. A sensor has no state but its calibration: value and Jacobians.
#pragma once

#include "geometry/se3.hpp"
#include "geometry/types.hpp"

namespace cairn {

// A sensor's prediction of one landmark. Pose columns are those of the ordinary error [dp; dtheta] in the map's axes
// (docs/notation.md); mount columns those of the error of the mount's angles. Only the first rows() rows count.
struct Prediction {
  Vector3 z = Vector3::Zero();
  Matrix36 J_z_pose = Matrix36::Zero();
  Matrix3 J_z_landmark = Matrix3::Zero();
  Matrix32 J_z_mount = Matrix32::Zero();
};

// The landmark that one observation places, and what it depends on.
struct Placement {
  Vector3 landmark = Vector3::Zero();
  Matrix36 J_landmark_pose = Matrix36::Zero();
  Matrix3 J_landmark_z = Matrix3::Zero();
  Matrix32 J_landmark_mount = Matrix32::Zero();
};

// How the noise of the mount's angles enters.
enum class MountNoise { none, per_observation, per_frame };

class Sensor {
 public:
  virtual ~Sensor() = default;

  virtual int rows() const { return 3; }
  // Pose and landmark enter as the body point y = R^T (l - p) alone.
  virtual bool relative() const { return true; }
  // Default noise of an observation; the upper left rows() x rows() block counts.
  virtual const Matrix3& noise() const = 0;
  virtual MountNoise mount_noise_mode() const { return MountNoise::none; }
  virtual Matrix2 mount_noise() const { return Matrix2::Zero(); }

  // False where the landmark gives no observation from there: behind the lens, too near, too steep.
  // `mount` is the assumed error of the mount's angles (zero but for an iterate of a per-frame mount).
  virtual bool predict(const SE3& T_map_body, const Vector3& p_map, const Vector2& mount, Prediction& out) const = 0;

  // False where the observation places no landmark.
  virtual bool place(const SE3& T_map_body, const Vector3& z, const Vector2& mount, Placement& out) const = 0;

  // z - predicted, angles wrapped to (-pi, pi].
  virtual Vector3 residual(const Vector3& z, const Vector3& predicted) const { return z - predicted; }
};

// J_p P J_q^T for the images of two landmarks, number k and l in the joint covariance P of [pose; landmarks].
inline Matrix3 image_covariance(const Eigen::Ref<const Eigen::MatrixXd>& P, const Prediction& p, Eigen::Index k,
                                const Prediction& q, Eigen::Index l) {
  const Eigen::Index row = 6 + 3 * k, column = 6 + 3 * l;
  const Matrix36 by_pose = p.J_z_pose * P.topLeftCorner<6, 6>() + p.J_z_landmark * P.block<3, 6>(row, 0);
  const Matrix3 by_landmark = p.J_z_pose * P.block<6, 3>(0, column) + p.J_z_landmark * P.block<3, 3>(row, column);
  return by_pose * q.J_z_pose.transpose() + by_landmark * q.J_z_landmark.transpose();
}

// Chain rule for a sensor that sees the point y = R^T (l - p) of the body frame, given J_z_y at y.
inline void map_jacobians(const SE3& T_map_body, const Vector3& p_map, const Matrix3& J_z_y, Prediction& out) {
  const Matrix3 J_z_l = J_z_y * T_map_body.rotation().matrix().transpose();
  out.J_z_landmark = J_z_l;
  out.J_z_pose.leftCols<3>() = -J_z_l;
  // R = Exp(dtheta) R_hat: dy = -R^T [dtheta]x (l - p) = R^T [l - p]x dtheta
  out.J_z_pose.rightCols<3>() = J_z_l * hat(p_map - T_map_body.translation());
}

// The landmark l = p + R y of a body point y, given J_y_z.
inline void place_body_point(const SE3& T_map_body, const Vector3& y, const Matrix3& J_y_z, Placement& out) {
  const Matrix3 R = T_map_body.rotation().matrix();
  const Vector3 arm = R * y;
  out.landmark = T_map_body.translation() + arm;
  out.J_landmark_pose.leftCols<3>().setIdentity();
  out.J_landmark_pose.rightCols<3>() = -hat(arm);
  out.J_landmark_z = R * J_y_z;
}

}  // namespace cairn
