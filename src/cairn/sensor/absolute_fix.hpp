// SPDX-License-Identifier: BSD-3-Clause
// Absolute measurements of the body's pose in the map: position (GNSS), attitude (star tracker), heading (compass).
#pragma once

#include <optional>

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "geometry/types.hpp"

namespace cairn {

template <class Pose>
class AbsoluteFix {
 public:
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;
  using PointSquare = Eigen::Matrix<double, Pose::kDim, Pose::kDim>;
  using ByPose = Eigen::Matrix<double, 3, Pose::kDof>;

  // z = p + R lever_arm
  static AbsoluteFix position(const Point& position, const PointSquare& covariance, const Point& lever_arm);
  // `covariance` is the covariance of dtheta in the axes of the map: true R = Exp(dtheta) measured R.
  static AbsoluteFix attitude(const Rotation& attitude, const typename Rotation::Jacobian& covariance);
  // Yaw of the body's x axis in the map.
  static AbsoluteFix heading(double heading, double sigma);

  int rows() const { return kind_ == Kind::heading ? 1 : kind_ == Kind::attitude ? Pose::kTurn : Pose::kDim; }
  // Only the upper left rows() x rows() block is used.
  const Matrix3& covariance() const { return covariance_; }
  // False if the measured value is not defined at this pose: a heading if the x axis of the body is vertical.
  bool defined(const Pose& T_map_body) const;
  // The measurement as a pose with this covariance of [dp; dtheta] may use it. A heading of a tilted body gets
  // additional noise, and there is none if the body's x axis may be vertical.
  std::optional<AbsoluteFix> usable(const Pose& T_map_body, const typename Pose::Square& covariance) const;
  // z - h and dh/d[dp; dtheta]. Only the first rows() rows are used.
  Vector3 residual(const Pose& T_map_body) const;
  ByPose jacobian(const Pose& T_map_body) const;

 private:
  enum class Kind { position, attitude, heading };

  Kind kind_ = Kind::position;
  Point position_ = Point::Zero();
  Point lever_arm_ = Point::Zero();
  Rotation attitude_;
  double heading_ = 0.0;
  Matrix3 covariance_ = Matrix3::Zero();
};

extern template class AbsoluteFix<SE2>;
extern template class AbsoluteFix<SE3>;

}  // namespace cairn
