// SPDX-License-Identifier: BSD-3-Clause
// Projection, triangulation and Jacobians of a rectified stereo camera (docs/sensors.md).
#include "sensor/stereo_camera.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

StereoCamera::StereoCamera(const StereoCameraParameters& parameters)
    : parameters_(parameters),
      R_body_camera_(parameters.T_body_camera.rotation().matrix()),
      noise_(parameters.sigma.cwiseAbs2().asDiagonal()),
      least_disparity_(
          std::max(parameters.min_disparity, parameters.min_disparity_sigmas * parameters.sigma.head<2>().norm())) {}

bool StereoCamera::predict(const SE3& T_map_body, const Vector3& p_map, const Vector2&, Prediction<SE3>& out) const {
  const StereoCameraParameters& c = parameters_;
  const Vector3 p_body = T_map_body.rotation().inverse() * (p_map - T_map_body.translation());
  const Vector3 p_camera = R_body_camera_.transpose() * (p_body - c.T_body_camera.translation());
  const double x = p_camera.x(), y = p_camera.y(), depth = p_camera.z();
  if (!(depth >= c.near_depth)) return false;  // also refuses NaN
  const double ku = c.fu / depth, kv = c.fv / depth;
  out.z << ku * x + c.cu, ku * (x - c.baseline) + c.cu, kv * y + c.cv;

  Matrix3 J_z_camera;
  J_z_camera.row(0) << ku, 0, -ku * x / depth;
  J_z_camera.row(1) << ku, 0, -ku * (x - c.baseline) / depth;
  J_z_camera.row(2) << 0, kv, -kv * y / depth;
  map_jacobians(T_map_body, p_map, J_z_camera * R_body_camera_.transpose(), out);
  out.J_z_mount.setZero();
  return out.z.allFinite() && out.J_z_pose.allFinite();  // a far point far off the axis can overflow
}

bool StereoCamera::place(const SE3& T_map_body, const Vector3& z, const Vector2&, Placement<SE3>& out) const {
  const StereoCameraParameters& c = parameters_;
  const double disparity = z[0] - z[1];
  if (!z.allFinite() || disparity < least_disparity_) return false;
  const double depth = c.fu * c.baseline / disparity;
  if (depth < c.near_depth) return false;  // a landmark at this depth would have no image
  const Vector3 p_camera((z[0] - c.cu) * depth / c.fu, (z[2] - c.cv) * depth / c.fv, depth);

  // The point is proportional to the depth, and the depth to 1 / disparity.
  Matrix3 J_camera_z;
  J_camera_z.col(0) = -p_camera / disparity;
  J_camera_z.col(1) = p_camera / disparity;
  J_camera_z.col(2).setZero();
  J_camera_z(0, 0) += depth / c.fu;
  J_camera_z(1, 2) = depth / c.fv;
  place_body_point(T_map_body, c.T_body_camera * p_camera, R_body_camera_ * J_camera_z, out);
  out.J_landmark_mount.setZero();
  return out.landmark.allFinite();
}

}  // namespace cairn
