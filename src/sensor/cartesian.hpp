// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensor/sensor.hpp"

namespace cairn {

struct CartesianParameters {
  SE3 T_body_sensor;
  Vector3 sigma = Vector3::Constant(0.1);  // m
};

// Any sensor that gives a point: z = (x, y, z) of the landmark in the sensor's frame, m.
class Cartesian final : public Sensor {
 public:
  explicit Cartesian(const CartesianParameters& parameters = {})
      : T_body_sensor_(parameters.T_body_sensor),
        R_body_sensor_(parameters.T_body_sensor.rotation().matrix()),
        noise_(parameters.sigma.cwiseAbs2().asDiagonal()) {}

  const Matrix3& noise() const override { return noise_; }

  bool predict(const SE3& T_map_body, const Vector3& p_map, const Vector2&, Prediction& out) const override {
    const Vector3 p_body = T_map_body.rotation().inverse() * (p_map - T_map_body.translation());
    out.z = R_body_sensor_.transpose() * (p_body - T_body_sensor_.translation());
    map_jacobians(T_map_body, p_map, R_body_sensor_.transpose(), out);
    out.J_z_mount.setZero();
    return out.z.allFinite();
  }

  bool place(const SE3& T_map_body, const Vector3& z, const Vector2&, Placement& out) const override {
    place_body_point(T_map_body, T_body_sensor_ * z, R_body_sensor_, out);
    out.J_landmark_mount.setZero();
    return out.landmark.allFinite();
  }

 private:
  SE3 T_body_sensor_;
  Matrix3 R_body_sensor_;
  Matrix3 noise_;
};

}  // namespace cairn
