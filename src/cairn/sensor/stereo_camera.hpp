// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensor/sensor.hpp"

namespace cairn {

struct StereoCameraParameters {
  double fu = 500, fv = 500;  // focal lengths, pixels
  double cu = 320, cv = 240;  // principal point, pixels
  double baseline = 0.2;      // m
  // Left camera (z out of the lens, x right, y down) in the body; by default it looks along x.
  SE3 T_body_camera{SO3::from_quaternion(0.5, -0.5, 0.5, -0.5), Vector3::Zero()};
  Vector3 sigma = Vector3::Ones();  // of u_left, u_right, v, pixels
  double near_depth = 0.1;          // m, > 0
  double min_disparity = 1;         // pixels, > 0
  // Of the disparity's standard deviation, >= 0: at 2.5 a landmark is placed where its depth is known to 40 %. What
  // lies farther has a depth whose error is far from Gaussian, and waits until it is nearer.
  double min_disparity_sigmas = 2.5;
};

// Rectified stereo camera: z = (u_left, u_right, v) in pixels of a point (x, y, z) of the left camera's frame,
// u_left = fu x/z + cu, u_right = fu (x - baseline)/z + cu, v = fv y/z + cv.
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
  double least_disparity_;  // that places a landmark, pixels
};

}  // namespace cairn
