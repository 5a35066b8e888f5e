// SPDX-License-Identifier: BSD-3-Clause
// A stereo head on a pan and tilt mount.
#pragma once

#include "sensor/sensor.hpp"

namespace cairn {

struct StereoHeadParameters {
  Vector3 platform = Vector3::Zero();           // d: pan axis in the body frame, m
  Vector3 stick = Vector3::Zero();              // s: camera on the stick, in the frame of the turned platform, m
  SO3 R_stick_camera;                           // q: camera axes (x out of the lens, y left, z up) in the stick's frame
  double range_sigma = 1.0;                     // m
  double azimuth_sigma = 0.052359877559829887;  // rad, 3 degrees (Mars paper, Table 1)
  double elevation_sigma = 0.052359877559829887;  // rad, 3 degrees
  double pan_sigma = 0;                           // encoder noise, rad
  double stick_sigma = 0;                         // encoder noise, rad
  bool encoder_per_frame = false;                 // all observations of a frame share one encoder error
  double near_range = 0.1;                        // m, > 0
  double max_elevation = 1.4835298641951802;      // rad, below pi/2: 85 degrees
};

// Stereo head on a pan and tilt mount (Mars paper, Figures 2 and 3, eq. 4) that observes range, azimuth and elevation:
//   m_b = d + Rz(pan) Ry(stick) (s + R_stick_camera m_c).
// The true mount angles are the encoder readings plus the mount error (pan, stick).
class StereoHead final : public Sensor<SE3> {
 public:
  explicit StereoHead(const StereoHeadParameters& parameters = {});

  // Sets the encoder readings, rad.
  void point(double pan, double stick);
  double pan() const { return pan_; }
  double stick() const { return stick_; }

  const Matrix3& noise() const override { return noise_; }
  MountNoise mount_noise_mode() const override;
  Matrix2 mount_noise() const override;
  bool predict(const SE3& T_map_body, const Vector3& p_map, const Vector2& mount, Prediction<SE3>& out) const override;
  bool place(const SE3& T_map_body, const Vector3& z, const Vector2& mount, Placement<SE3>& out) const override;
  Vector3 residual(const Vector3& z, const Vector3& predicted) const override;

 private:
  // Rotations of the mount at one pair of angles.
  struct Axes {
    Matrix3 R_body_platform, R_platform_stick, R_body_camera;
  };
  Axes axes_at(double pan, double stick) const;

  StereoHeadParameters parameters_;
  double pan_ = 0, stick_ = 0;
  Axes axes_;  // at the encoder readings, so that an update needs no trigonometry of the mount
  Matrix3 noise_;
};

}  // namespace cairn
