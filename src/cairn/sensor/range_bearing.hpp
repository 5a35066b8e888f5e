// SPDX-License-Identifier: BSD-3-Clause
// Range and bearing in the plane, and extended observations through a teammate.
#pragma once

#include "sensor/sensor.hpp"

namespace cairn {

struct RangeBearingParameters {
  SE2 T_body_sensor;
  double range_sigma = 0.1;     // m
  double bearing_sigma = 0.01;  // rad
  double near_range = 0.01;     // m, > 0: a nearer point has no usable bearing
};

// Radar, lidar or sonar in the plane: z = (range, bearing) of the landmark in the sensor's frame, left positive.
class RangeBearing final : public Sensor<SE2> {
 public:
  explicit RangeBearing(const RangeBearingParameters& parameters = {});

  const Matrix3& noise() const override { return noise_; }
  bool predict(const SE2& T_map_body, const Vector2& p_map, const Vector3& mount, Prediction<SE2>& out) const override;
  bool place(const SE2& T_map_body, const Vector3& z, const Vector3& mount, Placement<SE2>& out) const override;
  Vector3 residual(const Vector3& z, const Vector3& predicted) const override;

 private:
  RangeBearingParameters parameters_;
  Matrix3 noise_;
};

// A mutual sighting: two vehicles measured each other at the same time (cooperative paper, section 2.2).
struct MutualSighting {
  double range = 0.0;    // r_0: from this vehicle to the teammate, m
  double bearing = 0.0;  // theta_0: of the teammate as this vehicle sees it, rad
  double back = 0.0;     // theta_0': of this vehicle as the teammate sees it, rad
  Matrix3 covariance = Matrix3::Zero();
};

// Pose of the teammate in this vehicle's body frame: position r_0 u(theta_0), orientation delta = theta_0 - theta_0' +
// pi. `error` is added to the values of the sighting; it is zero except while an update iterates.
SE2 teammate_in_body(const MutualSighting& sighting, const Vector3& error = Vector3::Zero());
// Jacobian of the teammate's [dp; dtheta] in this vehicle's body axes by (r_0, theta_0, theta_0').
Matrix3 teammate_jacobian(const MutualSighting& sighting, const Vector3& error = Vector3::Zero());

// Extended observation: the radar of a teammate observes landmarks for this vehicle; the mutual sighting connects
// both (cooperative paper, section 2.2; docs/team.md). The teammate is the mount of the sensor, and all observations of
// the frame share the errors of the sighting. With `shared` = false every observation has its own independent errors,
// which corresponds to the diagonal R^e of the paper.
class ExtendedObservation final : public Sensor<SE2> {
 public:
  ExtendedObservation(const RangeBearingParameters& radar, const MutualSighting& sighting, bool shared);

  void set(const MutualSighting& sighting) { sighting_ = sighting; }
  const Matrix3& noise() const override { return noise_; }
  MountNoise mount_noise_mode() const override { return shared_ ? MountNoise::per_frame : MountNoise::per_observation; }
  MountSquare<SE2> mount_noise() const override { return sighting_.covariance; }
  bool predict(const SE2& T_map_body, const Vector2& p_map, const Vector3& mount, Prediction<SE2>& out) const override;
  bool place(const SE2& T_map_body, const Vector3& z, const Vector3& mount, Placement<SE2>& out) const override;
  Vector3 residual(const Vector3& z, const Vector3& predicted) const override;
  bool bears_witness() const override { return shared_; }  // without the correlation the noise is understated

 private:
  RangeBearingParameters radar_;
  MutualSighting sighting_;
  bool shared_;
  Matrix3 noise_;
};

}  // namespace cairn
