// SPDX-License-Identifier: BSD-3-Clause
// Residuals and Jacobians of absolute measurements (docs/sensors.md).
#include "sensor/absolute_fix.hpp"

#include <cmath>

#include "geometry/angle.hpp"

namespace cairn {

template <class Pose>
AbsoluteFix<Pose> AbsoluteFix<Pose>::position(const Point& position, const PointSquare& covariance,
                                              const Point& lever_arm) {
  AbsoluteFix fix;
  fix.kind_ = Kind::position;
  fix.position_ = position;
  fix.lever_arm_ = lever_arm;
  fix.covariance_.template topLeftCorner<Pose::kDim, Pose::kDim>() = covariance;
  return fix;
}

template <class Pose>
AbsoluteFix<Pose> AbsoluteFix<Pose>::attitude(const Rotation& attitude, const typename Rotation::Jacobian& covariance) {
  AbsoluteFix fix;
  fix.kind_ = Kind::attitude;
  fix.attitude_ = attitude;
  fix.covariance_.template topLeftCorner<Pose::kTurn, Pose::kTurn>() = covariance;
  return fix;
}

template <class Pose>
AbsoluteFix<Pose> AbsoluteFix<Pose>::heading(double heading, double sigma) {
  AbsoluteFix fix;
  fix.kind_ = Kind::heading;
  fix.heading_ = heading;
  fix.covariance_(0, 0) = sigma * sigma;
  return fix;
}

template <class Pose>
bool AbsoluteFix<Pose>::defined(const Pose& T_map_body) const {
  constexpr double kMinimumLevel = 1e-3;  // sine of the angle to the vertical
  const Point x = T_map_body.rotation() * Point::UnitX();
  return kind_ != Kind::heading || x.template head<2>().norm() >= kMinimumLevel;
}

// A tilt by (t_x, t_y) turns the heading of an axis a with the level part c = |(a_x, a_y)| by a_z t_x / c, and by a_z^2
// t_x t_y / c^2 in second order (docs/sensors.md). The second order is noise for the update, which is linear. Within
// three standard deviations of the vertical the heading says nothing.
template <class Pose>
std::optional<AbsoluteFix<Pose>> AbsoluteFix<Pose>::usable(const Pose& T_map_body,
                                                           const typename Pose::Square& covariance) const {
  if (!defined(T_map_body)) return std::nullopt;
  AbsoluteFix fix = *this;
  if constexpr (Pose::kDim == 3) {
    if (kind_ != Kind::heading) return fix;
    constexpr double kSigmas = 3.0;
    const Point a = T_map_body.rotation() * Point::UnitX();
    const double xx = covariance(3, 3), yy = covariance(4, 4), xy = covariance(4, 3);
    const double largest = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);  // eigenvalue of the tilt's covariance
    const double ratio = a.z() * a.z() * largest / a.template head<2>().squaredNorm();
    if (!(kSigmas * kSigmas * ratio <= 1.0)) return std::nullopt;
    fix.covariance_(0, 0) += ratio * ratio;
  }
  return fix;
}

template <class Pose>
Vector3 AbsoluteFix<Pose>::residual(const Pose& T_map_body) const {
  Vector3 out = Vector3::Zero();
  switch (kind_) {
    case Kind::position:
      out.head<Pose::kDim>() = position_ - T_map_body.translation() - T_map_body.rotation() * lever_arm_;
      return out;
    case Kind::attitude:
      out.head<Pose::kTurn>() = (attitude_ * T_map_body.rotation().inverse()).log();
      return out;
    case Kind::heading:
      break;
  }
  const Point a = T_map_body.rotation() * Point::UnitX();
  return Vector3(wrap_angle(heading_ - std::atan2(a.y(), a.x())), 0.0, 0.0);
}

template <class Pose>
typename AbsoluteFix<Pose>::ByPose AbsoluteFix<Pose>::jacobian(const Pose& T_map_body) const {
  ByPose J = ByPose::Zero();
  switch (kind_) {
    case Kind::position:  // h = p + R a
      J.template topLeftCorner<Pose::kDim, Pose::kDim>().setIdentity();
      J.template topRightCorner<Pose::kDim, Pose::kTurn>() = Rotation::turn(T_map_body.rotation() * lever_arm_);
      break;
    case Kind::attitude:  // Log(R_z (Exp(theta) R)^T) = r - J_r(r)^-1 theta, and J_r(r) = J_l(-r)
      J.template topRightCorner<Pose::kTurn, Pose::kTurn>() =
          Rotation::left_jacobian_inverse(-residual(T_map_body).template head<Pose::kTurn>());
      break;
    case Kind::heading: {  // d atan2(a_y, a_x) for da = turn(a) dtheta
      const Point a = T_map_body.rotation() * Point::UnitX();
      const Vector2 level = a.template head<2>();
      const Eigen::RowVector2d J_heading_a = Eigen::RowVector2d(-level.y(), level.x()) / level.squaredNorm();
      J.template block<1, Pose::kTurn>(0, Pose::kDim) = J_heading_a * Rotation::turn(a).template topRows<2>();
      break;
    }
  }
  return J;
}

template class AbsoluteFix<SE2>;
template class AbsoluteFix<SE3>;

}  // namespace cairn
