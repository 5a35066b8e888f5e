// SPDX-License-Identifier: BSD-3-Clause
// Range and bearing, and extended observations (docs/sensors.md, docs/team.md).
#include "sensor/range_bearing.hpp"

#include <cmath>

#include "geometry/angle.hpp"

namespace cairn {
namespace {

using ByPoint = Prediction<SE2>::ByLandmark;
using ByObservation = Placement<SE2>::ByObservation;

// Unit vector u(bearing).
Vector2 direction(double bearing) {
  return Vector2(std::cos(bearing), std::sin(bearing));
}

// Range and bearing of a point in the sensor's frame, and their Jacobian. Returns false if the point is too near.
bool to_polar(const Vector2& y, double near_range, Vector3& z, ByPoint& J_z_y) {
  const double range = y.norm();
  if (!(range >= near_range && std::isfinite(range))) return false;  // also refuses NaN
  z << range, std::atan2(y.y(), y.x()), 0.0;
  const Vector2 u = y / range;
  J_z_y << u.transpose(), SO2::turn(u).transpose() / range, Eigen::RowVector2d::Zero();
  return true;
}

// The point in the sensor's frame that gives z, and its Jacobian. Returns false if the point is too near.
bool from_polar(const Vector3& z, double near_range, Vector2& y, ByObservation& J_y_z) {
  if (!z.head<2>().allFinite() || z[0] < near_range) return false;
  const Vector2 u = direction(z[1]);
  y = z[0] * u;
  J_y_z << u, SO2::turn(y), Vector2::Zero();
  return true;
}

Vector3 polar_residual(const Vector3& z, const Vector3& predicted) {
  return Vector3(z[0] - predicted[0], wrap_angle(z[1] - predicted[1]), 0.0);
}

Matrix3 polar_noise(const RangeBearingParameters& parameters) {
  return Vector3(parameters.range_sigma, parameters.bearing_sigma, 1.0).cwiseAbs2().asDiagonal();
}

// Jacobian of a point, fixed to the teammate at `arm` (in this vehicle's body axes), by the errors of the sighting: B_j
// of the extended observation (docs/team.md).
Eigen::Matrix<double, 2, 3> point_by_sighting(const MutualSighting& sighting, const Vector3& error,
                                              const Vector2& arm) {
  const Matrix3 J = teammate_jacobian(sighting, error);
  return J.topRows<2>() + SO2::turn(arm) * J.row(2);
}

}  // namespace

SE2 teammate_in_body(const MutualSighting& sighting, const Vector3& error) {
  const double bearing = sighting.bearing + error[1], back = sighting.back + error[2];
  return SE2(SO2::from_angle(bearing - back + kPi), (sighting.range + error[0]) * direction(bearing));
}

Matrix3 teammate_jacobian(const MutualSighting& sighting, const Vector3& error) {
  const Vector2 u = direction(sighting.bearing + error[1]);
  Matrix3 J;
  J << u, (sighting.range + error[0]) * SO2::turn(u), Vector2::Zero(), 0.0, 1.0, -1.0;
  return J;
}

RangeBearing::RangeBearing(const RangeBearingParameters& parameters)
    : parameters_(parameters), noise_(polar_noise(parameters)) {}

bool RangeBearing::predict(const SE2& T_map_body, const Vector2& p_map, const Vector3&, Prediction<SE2>& out) const {
  const Vector2 y = parameters_.T_body_sensor.inverse() * (T_map_body.inverse() * p_map);
  ByPoint J_z_y;
  if (!to_polar(y, parameters_.near_range, out.z, J_z_y)) return false;
  const ByPoint J_z_body = J_z_y * parameters_.T_body_sensor.rotation().matrix().transpose();
  map_jacobians(T_map_body, p_map, J_z_body, out);
  out.J_z_mount.setZero();
  return true;
}

bool RangeBearing::place(const SE2& T_map_body, const Vector3& z, const Vector3&, Placement<SE2>& out) const {
  Vector2 y;
  ByObservation J_y_z;
  if (!from_polar(z, parameters_.near_range, y, J_y_z)) return false;
  const ByObservation J_body_z = parameters_.T_body_sensor.rotation().matrix() * J_y_z;
  place_body_point(T_map_body, Vector2(parameters_.T_body_sensor * y), J_body_z, out);
  out.J_landmark_mount.setZero();
  return out.landmark.allFinite();
}

Vector3 RangeBearing::residual(const Vector3& z, const Vector3& predicted) const {
  return polar_residual(z, predicted);
}

ExtendedObservation::ExtendedObservation(const RangeBearingParameters& radar, const MutualSighting& sighting,
                                         bool shared)
    : radar_(radar), sighting_(sighting), shared_(shared), noise_(polar_noise(radar)) {}

bool ExtendedObservation::predict(const SE2& T_map_body, const Vector2& p_map, const Vector3& mount,
                                  Prediction<SE2>& out) const {
  const SE2 T_body_teammate = teammate_in_body(sighting_, mount);
  const Matrix2 R_teammate_body = T_body_teammate.rotation().inverse().matrix();
  const Vector2 y = T_body_teammate.inverse() * (T_map_body.inverse() * p_map);
  ByPoint J_z_y;
  if (!to_polar(y, radar_.near_range, out.z, J_z_y)) return false;
  map_jacobians(T_map_body, p_map, (J_z_y * R_teammate_body).eval(), out);
  // y = R(delta)^T (y_body - p_teammate) is the landmark in the teammate's frame. It moves against a point that is
  // fixed to the teammate.
  out.J_z_mount = -J_z_y * R_teammate_body * point_by_sighting(sighting_, mount, T_body_teammate.rotation() * y);
  return true;
}

bool ExtendedObservation::place(const SE2& T_map_body, const Vector3& z, const Vector3& mount,
                                Placement<SE2>& out) const {
  Vector2 y;
  ByObservation J_y_z;
  if (!from_polar(z, radar_.near_range, y, J_y_z)) return false;
  const SE2 T_body_teammate = teammate_in_body(sighting_, mount);
  const ByObservation J_body_z = T_body_teammate.rotation().matrix() * J_y_z;
  place_body_point(T_map_body, Vector2(T_body_teammate * y), J_body_z, out);
  out.J_landmark_mount =
      T_map_body.rotation().matrix() * point_by_sighting(sighting_, mount, T_body_teammate.rotation() * y);
  return out.landmark.allFinite();
}

Vector3 ExtendedObservation::residual(const Vector3& z, const Vector3& predicted) const {
  return polar_residual(z, predicted);
}

}  // namespace cairn
