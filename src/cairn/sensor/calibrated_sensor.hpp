// SPDX-License-Identifier: BSD-3-Clause
// A sensor whose mount and values have systematic errors (docs/systematic_errors.md, eq. 10 and 11). It wraps any
// sensor.
//
// The mount's error E = (Exp(phi), m) turns and shifts the sensor against the body: the sensor works as if the body
// were at T E. Values come out too large by their offset.
#pragma once

#include "sensor/sensor.hpp"

namespace cairn {

// The numbers [m; phi; offset of each value].
template <class Pose>
constexpr int kCalibrationErrors = Pose::kDof + kMostRows;
template <class Pose>
using Calibration = Eigen::Matrix<double, kCalibrationErrors<Pose>, 1>;

template <class Pose>
class CalibratedSensor final : public Sensor<Pose> {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using typename Sensor<Pose>::Point;
  using typename Sensor<Pose>::Mount;
  using ByCalibration = Eigen::Matrix<double, kMostRows, kCalibrationErrors<Pose>>;
  using PointByCalibration = Eigen::Matrix<double, kDim, kCalibrationErrors<Pose>>;

  CalibratedSensor(const Sensor<Pose>& sensor, const Calibration<Pose>& errors) : sensor_(sensor) { set(errors); }
  void set(const Calibration<Pose>& errors) {
    turn_ = errors.template segment<kTurn>(kDim);
    mount_ = Pose(Pose::Rotation::exp(turn_), Point(errors.template head<kDim>()));
    offset_ = errors.template tail<kMostRows>();
  }

  // Jacobian of a prediction or a placement of this sensor, which it made at this pose, by the numbers of the error.
  ByCalibration by_calibration(const Pose& T_map_body, const Prediction<Pose>& prediction) const {
    ByCalibration J;
    J.template leftCols<kDof>() = prediction.J_z_pose * by_mount(T_map_body);
    J.template rightCols<kMostRows>().setIdentity();
    return J;
  }
  PointByCalibration by_calibration(const Pose& T_map_body, const Placement<Pose>& placement) const {
    PointByCalibration J;
    J.template leftCols<kDof>() = placement.J_landmark_pose * by_mount(T_map_body);
    J.template rightCols<kMostRows>() = -placement.J_landmark_z;
    return J;
  }

  int rows() const override { return sensor_.rows(); }
  bool relative() const override { return sensor_.relative(); }
  int plain_row() const override { return sensor_.plain_row(); }
  const Matrix3& noise() const override { return sensor_.noise(); }
  MountNoise mount_noise_mode() const override { return sensor_.mount_noise_mode(); }
  MountSquare<Pose> mount_noise() const override { return sensor_.mount_noise(); }
  bool predict(const Pose& T_map_body, const Point& p_map, const Mount& mount, Prediction<Pose>& out) const override {
    if (!sensor_.predict(T_map_body * mount_, p_map, mount, out)) return false;
    out.z += offset_;
    out.J_z_pose = (out.J_z_pose * ProductJacobians(T_map_body, mount_).by_a).eval();
    return true;
  }
  bool place(const Pose& T_map_body, const Vector3& z, const Mount& mount, Placement<Pose>& out) const override {
    if (!sensor_.place(T_map_body * mount_, z - offset_, mount, out)) return false;
    out.J_landmark_pose = (out.J_landmark_pose * ProductJacobians(T_map_body, mount_).by_a).eval();
    return true;
  }
  Vector3 residual(const Vector3& z, const Vector3& predicted) const override { return sensor_.residual(z, predicted); }
  bool bears_witness() const override { return sensor_.bears_witness(); }

 private:
  // From the error of T to that of the numbers [m; phi]: the error of T E is by_a e_T + by_b e_E, and that of E is
  // [dm; J_l(phi) dphi].
  typename Pose::Square by_mount(const Pose& T_map_body) const {
    const ProductJacobians J(T_map_body, mount_);
    typename Pose::Square back = J.by_a, of_numbers = Pose::Square::Identity();  // back: by_a^-1
    back.template topRightCorner<kDim, kTurn>() *= -1.0;
    of_numbers.template bottomRightCorner<kTurn, kTurn>() = Pose::Rotation::left_jacobian(turn_);
    return back * J.by_b * of_numbers;
  }

  const Sensor<Pose>& sensor_;
  typename Pose::Rotation::Tangent turn_;
  Pose mount_;
  Vector3 offset_;
};

}  // namespace cairn
