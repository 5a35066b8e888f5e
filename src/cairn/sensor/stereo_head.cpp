// SPDX-License-Identifier: BSD-3-Clause
// Kinematics and Jacobians of the stereo head (docs/stereo_head.md).
#include "sensor/stereo_head.hpp"

#include <cmath>

#include "geometry/angle.hpp"

namespace cairn {

StereoHead::StereoHead(const StereoHeadParameters& parameters)
    : parameters_(parameters),
      axes_(axes_at(0, 0)),
      noise_(Vector3(parameters.range_sigma, parameters.azimuth_sigma, parameters.elevation_sigma)
                 .cwiseAbs2()
                 .asDiagonal()) {}

StereoHead::Axes StereoHead::axes_at(double pan, double stick) const {
  const double cp = std::cos(pan), sp = std::sin(pan), cs = std::cos(stick), ss = std::sin(stick);
  Axes axes;
  axes.R_body_platform << cp, -sp, 0, sp, cp, 0, 0, 0, 1;
  axes.R_platform_stick << cs, 0, ss, 0, 1, 0, -ss, 0, cs;
  axes.R_body_camera = axes.R_body_platform * axes.R_platform_stick * parameters_.R_stick_camera.matrix();
  return axes;
}

void StereoHead::point(double pan, double stick) {
  pan_ = pan;
  stick_ = stick;
  axes_ = axes_at(pan, stick);
}

MountNoise StereoHead::mount_noise_mode() const {
  if (parameters_.pan_sigma == 0 && parameters_.stick_sigma == 0) return MountNoise::none;
  return parameters_.encoder_per_frame ? MountNoise::per_frame : MountNoise::per_observation;
}

Matrix2 StereoHead::mount_noise() const {
  return Vector2(parameters_.pan_sigma, parameters_.stick_sigma).cwiseAbs2().asDiagonal();
}

bool StereoHead::predict(const SE3& T_map_body, const Vector3& p_map, const Vector2& mount,
                         Prediction<SE3>& out) const {
  const Axes axes = mount.isZero(0) ? axes_ : axes_at(pan_ + mount[0], stick_ + mount[1]);
  const Vector3 m_b = T_map_body.rotation().inverse() * (p_map - T_map_body.translation());
  // (Mars paper, eq. 4), solved for m_c, one joint at a time
  const Vector3 m_platform = axes.R_body_platform.transpose() * (m_b - parameters_.platform);
  const Vector3 m_stick = axes.R_platform_stick.transpose() * m_platform;
  const SO3 R_camera_stick = parameters_.R_stick_camera.inverse();
  const Vector3 m_c = R_camera_stick * (m_stick - parameters_.stick);

  // These comparisons also refuse NaN.
  const double range = m_c.norm();
  if (!(range >= parameters_.near_range && std::isfinite(range))) return false;
  const double horizontal = m_c.head<2>().norm();
  const double elevation = std::atan2(m_c.z(), horizontal);
  if (!(std::abs(elevation) <= parameters_.max_elevation)) return false;
  out.z << range, std::atan2(m_c.y(), m_c.x()), elevation;

  // The limits above keep range and horizontal away from zero.
  const double ca = m_c.x() / horizontal, sa = m_c.y() / horizontal, ce = horizontal / range, se = m_c.z() / range;
  Matrix3 J_z_c;
  J_z_c.row(0) << ce * ca, ce * sa, se;
  J_z_c.row(1) << -sa / horizontal, ca / horizontal, 0;
  J_z_c.row(2) << -se * ca / range, -se * sa / range, ce / range;
  map_jacobians(T_map_body, p_map, J_z_c * axes.R_body_camera.transpose(), out);

  // The derivative of Rz(pan)^T is -e_z x (.), that of Ry(stick)^T is -e_y x (.).
  const Vector3 by_pan = axes.R_platform_stick.transpose() * Vector3(m_platform.y(), -m_platform.x(), 0);
  const Vector3 by_stick(-m_stick.z(), 0, m_stick.x());
  out.J_z_mount.col(0) = J_z_c * (R_camera_stick * by_pan);
  out.J_z_mount.col(1) = J_z_c * (R_camera_stick * by_stick);
  return true;
}

bool StereoHead::place(const SE3& T_map_body, const Vector3& z, const Vector2& mount, Placement<SE3>& out) const {
  if (!z.allFinite() || z[0] < parameters_.near_range || std::abs(z[2]) > parameters_.max_elevation) return false;
  const Axes axes = mount.isZero(0) ? axes_ : axes_at(pan_ + mount[0], stick_ + mount[1]);
  const double range = z[0], ca = std::cos(z[1]), sa = std::sin(z[1]), ce = std::cos(z[2]), se = std::sin(z[2]);
  Matrix3 J_c_z;
  J_c_z.col(0) << ce * ca, ce * sa, se;
  J_c_z.col(1) << -range * ce * sa, range * ce * ca, 0;
  J_c_z.col(2) << -range * se * ca, -range * se * sa, range * ce;

  // (Mars paper, eq. 4)
  const Vector3 m_c = range * J_c_z.col(0);
  const Vector3 m_platform = axes.R_platform_stick * (parameters_.stick + parameters_.R_stick_camera * m_c);
  const Vector3 m_b = parameters_.platform + axes.R_body_platform * m_platform;
  place_body_point(T_map_body, m_b, axes.R_body_camera * J_c_z, out);

  Matrix32 J_platform_mount;  // e_z x (.), e_y x (.)
  J_platform_mount.col(0) << -m_platform.y(), m_platform.x(), 0;
  J_platform_mount.col(1) << m_platform.z(), 0, -m_platform.x();
  out.J_landmark_mount = T_map_body.rotation().matrix() * (axes.R_body_platform * J_platform_mount);
  return out.landmark.allFinite();
}

Vector3 StereoHead::residual(const Vector3& z, const Vector3& predicted) const {
  return Vector3(z[0] - predicted[0], wrap_angle(z[1] - predicted[1]), wrap_angle(z[2] - predicted[2]));
}

}  // namespace cairn
