// SPDX-License-Identifier: BSD-3-Clause
// A sensor that the caller defines by functions.
#pragma once

#include <cstdint>

#include "sensor/sensor.hpp"

namespace cairn {

// The functions of the caller. `pose` is seven doubles: position (m), then the quaternion w x y z. Jacobians are packed
// and row-major: rows x 6 and rows x 3 for a prediction, 3 x 6 and 3 x rows for a placement. A function returns 1
// for an answer and 0 if it has none. A negative value aborts the call of the library: an Error is thrown.
using CustomPredict = std::int32_t (*)(void* user, const double* pose, const double* landmark, double* z,
                                       double* jacobian_pose, double* jacobian_landmark);
using CustomPlace = std::int32_t (*)(void* user, const double* pose, const double* z, double* landmark,
                                     double* jacobian_pose, double* jacobian_z);

struct CustomParameters {
  int rows = 3;                     // values of an observation, 1 to 3
  CustomPredict predict = nullptr;  // required
  CustomPlace place = nullptr;      // null: the sensor places no landmarks
  void* user = nullptr;
  std::uint32_t angle_mask = 0;     // bit i: value i is an angle
  bool relative = false;            // z depends on pose and landmark only through R^T (l - p)
  Vector3 sigma = Vector3::Ones();  // of each value
};

// A sensor that the caller defines by functions. Results that are not finite are refused. The functions are spatial in
// the plane too: a planar filter uses the columns x, y and yaw of their Jacobians.
template <class Pose>
class CustomSensor final : public Sensor<Pose> {
 public:
  using typename Sensor<Pose>::Point;
  using typename Sensor<Pose>::Mount;

  explicit CustomSensor(const CustomParameters& parameters);

  int rows() const override { return parameters_.rows; }
  bool relative() const override { return parameters_.relative; }
  int plain_row() const override;
  bool may_abort() const override { return true; }
  bool places() const { return parameters_.place != nullptr; }
  const Matrix3& noise() const override { return noise_; }
  bool predict(const Pose& T_map_body, const Point& p_map, const Mount& mount, Prediction<Pose>& out) const override;
  bool place(const Pose& T_map_body, const Vector3& z, const Mount& mount, Placement<Pose>& out) const override;
  Vector3 residual(const Vector3& z, const Vector3& predicted) const override;

 private:
  CustomParameters parameters_;
  Matrix3 noise_;
};

extern template class CustomSensor<SE2>;
extern template class CustomSensor<SE3>;

// Compares the Jacobians of the sensor with central differences on the manifold at one pose and landmark. If the sensor
// places landmarks, the Jacobians of the placement are compared at the predicted observation, and placing must invert
// predicting: it must give the landmark back, or, with fewer than three values, the observation. `worst` is the largest
// difference, relative to max(1, |numerical value|). Returns false if the sensor refuses one of the points.
bool check_custom(const CustomSensor<SE3>& sensor, const SE3& T_map_body, const Vector3& p_map, double& worst);

}  // namespace cairn
