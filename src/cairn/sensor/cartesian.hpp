// SPDX-License-Identifier: BSD-3-Clause
// A sensor that measures points.
#pragma once

#include "sensor/sensor.hpp"

namespace cairn {

template <class Pose>
struct CartesianParameters {
  Pose T_body_sensor;
  typename Pose::Point sigma = Pose::Point::Constant(0.1);  // m
};

// Any sensor that measures points: z = (x, y, z) of the landmark in the sensor's frame, m; in the plane (x, y).
template <class Pose>
class Cartesian final : public Sensor<Pose> {
 public:
  using typename Sensor<Pose>::Point;
  using typename Sensor<Pose>::Mount;

  explicit Cartesian(const CartesianParameters<Pose>& parameters = {}) : T_body_sensor_(parameters.T_body_sensor) {
    R_body_sensor_.template leftCols<Pose::kDim>() = parameters.T_body_sensor.rotation().matrix();
    noise_.template topLeftCorner<Pose::kDim, Pose::kDim>() = parameters.sigma.cwiseAbs2().asDiagonal();
  }

  const Matrix3& noise() const override { return noise_; }

  bool predict(const Pose& T_map_body, const Point& p_map, const Mount&, Prediction<Pose>& out) const override {
    const Point p_body = T_map_body.rotation().inverse() * (p_map - T_map_body.translation());
    out.z = R_body_sensor_.transpose() * (p_body - T_body_sensor_.translation());
    map_jacobians(T_map_body, p_map, R_body_sensor_.transpose().eval(), out);
    out.J_z_mount.setZero();
    return out.z.allFinite();
  }

  bool place(const Pose& T_map_body, const Vector3& z, const Mount&, Placement<Pose>& out) const override {
    place_body_point(T_map_body, Point(T_body_sensor_ * Point(z.head<Pose::kDim>())), R_body_sensor_, out);
    out.J_landmark_mount.setZero();
    return out.landmark.allFinite();
  }

 private:
  Pose T_body_sensor_;
  typename Placement<Pose>::ByObservation R_body_sensor_ = Placement<Pose>::ByObservation::Zero();
  Matrix3 noise_ = Matrix3::Identity();
};

}  // namespace cairn
