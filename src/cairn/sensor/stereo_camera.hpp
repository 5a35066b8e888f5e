// SPDX-License-Identifier: BSD-3-Clause
// A rectified stereo camera that observes pixels.
#pragma once

#include "sensor/sensor.hpp"

namespace cairn {

struct StereoCameraParameters {
  double fu = 500, fv = 500;  // focal lengths, pixels
  double cu = 320, cv = 240;  // principal point, pixels
  double baseline = 0.2;      // m
  // Left camera (z out of the lens, x right, y down) in the body frame. By default it looks along the x axis of the
  // body.
  SE3 T_body_camera{SO3::from_quaternion(0.5, -0.5, 0.5, -0.5), Vector3::Zero()};
  Vector3 sigma = Vector3::Ones();  // of u_left, u_right, v, pixels
  double near_depth = 0.1;          // m, > 0
  double min_disparity = 1;         // pixels, > 0
  // A landmark is placed only if its disparity exceeds this number of standard deviations, >= 0. At 2.5 its depth is
  // known to 40 %. The depth error of a farther landmark is far from Gaussian; it is placed when it is nearer.
  double min_disparity_sigmas = 2.5;
};

// Rectified stereo camera: z = (u_left, u_right, v) in pixels of a point (x, y, z) in the frame of the left camera,
// u_left = fu x/z + cu, u_right = fu (x - baseline)/z + cu, v = fv y/z + cv (docs/sensors.md).
class StereoCamera final : public Sensor<SE3> {
 public:
  explicit StereoCamera(const StereoCameraParameters& parameters = {});

  const Matrix3& noise() const override { return noise_; }
  bool predict(const SE3& T_map_body, const Vector3& p_map, const Vector2& mount, Prediction<SE3>& out) const override;
  bool place(const SE3& T_map_body, const Vector3& z, const Vector2& mount, Placement<SE3>& out) const override;

 private:
  StereoCameraParameters parameters_;
  Matrix3 R_body_camera_;
  Matrix3 noise_;
  double least_disparity_;  // smallest disparity that places a landmark, pixels
};

}  // namespace cairn
