// SPDX-License-Identifier: BSD-3-Clause
// Calls of the functions of a custom sensor, and the check of its Jacobians.
#include "sensor/custom.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "geometry/angle.hpp"
#include "geometry/embedding.hpp"

namespace cairn {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Packed = Eigen::Map<const RowMajor>;  // views memory, allocates none

// Whether a callback gave an answer. A negative value aborts the whole call.
bool answered(std::int32_t result, const char* name) {
  if (result < 0)
    throw Error(ErrorCode::callback, "custom.%s returned %d, which aborts the call; nothing was changed", name, result);
  if (result > 1)
    throw Error(ErrorCode::callback, "custom.%s returned %d, and may return 1, 0 or a negative value", name, result);
  return result == 1;
}

// Outputs of a callback. A value that it does not write is NaN and is refused.
template <std::size_t n>
std::array<double, n> unset() {
  std::array<double, n> values;
  values.fill(std::numeric_limits<double>::quiet_NaN());
  return values;
}

std::array<double, 7> pack(const SE3& T) {
  const Vector3& p = T.translation();
  const Eigen::Quaterniond& q = T.rotation().quaternion();
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

}  // namespace

template <class Pose>
CustomSensor<Pose>::CustomSensor(const CustomParameters& parameters)
    : parameters_(parameters), noise_(parameters.sigma.cwiseAbs2().asDiagonal()) {}

template <class Pose>
bool CustomSensor<Pose>::predict(const Pose& T_map_body, const Point& p_map, const Mount&,
                                 Prediction<Pose>& out) const {
  const int n = rows();
  const std::array<double, 7> pose = pack(Embedding<Pose>::up(T_map_body));
  const Vector3 landmark = Embedding<Pose>::up(p_map);
  auto z = unset<3>();
  auto J_pose = unset<18>();
  auto J_landmark = unset<9>();
  if (!answered(parameters_.predict(parameters_.user, pose.data(), landmark.data(), z.data(), J_pose.data(),
                                    J_landmark.data()),
                "predict"))
    return false;
  out = Prediction<Pose>();
  std::copy_n(z.data(), n, out.z.data());
  Matrix36 by_pose = Matrix36::Zero();
  Matrix3 by_landmark = Matrix3::Zero();
  by_pose.topRows(n) = Packed(J_pose.data(), n, 6);
  by_landmark.topRows(n) = Packed(J_landmark.data(), n, 3);
  out.J_z_pose = Embedding<Pose>::by_pose(by_pose);
  out.J_z_landmark = Embedding<Pose>::by_point(by_landmark);
  return out.z.allFinite() && out.J_z_pose.allFinite() && out.J_z_landmark.allFinite();
}

template <class Pose>
bool CustomSensor<Pose>::place(const Pose& T_map_body, const Vector3& z, const Mount&, Placement<Pose>& out) const {
  if (!places()) return false;
  const int n = rows();
  const std::array<double, 7> pose = pack(Embedding<Pose>::up(T_map_body));
  auto landmark = unset<3>();
  auto J_pose = unset<18>();
  auto J_z = unset<9>();
  if (!answered(parameters_.place(parameters_.user, pose.data(), z.data(), landmark.data(), J_pose.data(), J_z.data()),
                "place"))
    return false;
  out = Placement<Pose>();
  out.landmark = Embedding<Pose>::down(Vector3(landmark.data()));
  out.J_landmark_pose = Embedding<Pose>::by_pose(Packed(J_pose.data(), 3, 6)).template topRows<Pose::kDim>();
  out.J_landmark_z.leftCols(n) = Packed(J_z.data(), 3, n).template topRows<Pose::kDim>();
  return out.landmark.allFinite() && out.J_landmark_pose.allFinite() && out.J_landmark_z.allFinite();
}

template <class Pose>
int CustomSensor<Pose>::plain_row() const {
  for (int r = 0; r < parameters_.rows; ++r)
    if ((parameters_.angle_mask >> r & 1u) == 0) return r;
  return -1;
}

template <class Pose>
Vector3 CustomSensor<Pose>::residual(const Vector3& z, const Vector3& predicted) const {
  Vector3 r = Vector3::Zero();
  for (int i = 0; i < rows(); ++i) {
    const double difference = z[i] - predicted[i];
    r[i] = (parameters_.angle_mask >> i & 1u) != 0 ? wrap_angle(difference) : difference;
  }
  return r;
}

template class CustomSensor<SE2>;
template class CustomSensor<SE3>;

namespace {

// Step of the central differences: about the cube root of the rounding unit, where they are most accurate.
constexpr double kStep = 1e-5;

// Largest difference of one column, relative to max(1, |numerical value|).
double difference(const Vector3& analytic, const Vector3& numerical) {
  return ((analytic - numerical).array().abs() / numerical.array().abs().max(1.0)).maxCoeff();
}

// Moves one coordinate up and down by one step. Returns the distance between the two values. For a large coordinate
// rounding makes it differ from two steps.
template <class Vector>
double step(const Vector& x, int i, Vector& above, Vector& below) {
  above = below = x;
  above[i] += kStep;
  below[i] -= kStep;
  return above[i] - below[i];
}

// The same for one component of the error of a pose.
double step_pose(const SE3& T, int i, SE3& above, SE3& below) {
  const Vector6 error = kStep * Vector6::Unit(i);
  above = retract(T, error);
  below = retract(T, -error);
  return i < 3 ? above.translation()[i] - below.translation()[i] : 2 * kStep;
}

}  // namespace

bool check_custom(const CustomSensor<SE3>& sensor, const SE3& T_map_body, const Vector3& p_map, double& worst) {
  const Vector2 mount = Vector2::Zero();
  Prediction<SE3> at, up, down;
  if (!sensor.predict(T_map_body, p_map, mount, at)) return false;
  double largest = 0;
  SE3 T_up, T_down;
  Vector3 x_up, x_down;
  for (int i = 0; i < 6; ++i) {
    const double width = step_pose(T_map_body, i, T_up, T_down);
    if (!sensor.predict(T_up, p_map, mount, up) || !sensor.predict(T_down, p_map, mount, down)) return false;
    largest = std::max(largest, difference(at.J_z_pose.col(i), sensor.residual(up.z, down.z) / width));
  }
  for (int i = 0; i < 3; ++i) {
    const double width = step(p_map, i, x_up, x_down);
    if (!sensor.predict(T_map_body, x_up, mount, up) || !sensor.predict(T_map_body, x_down, mount, down)) return false;
    largest = std::max(largest, difference(at.J_z_landmark.col(i), sensor.residual(up.z, down.z) / width));
  }
  worst = largest;
  if (!sensor.places()) return true;

  Placement<SE3> placed, above, below;
  if (!sensor.place(T_map_body, at.z, mount, placed)) return false;
  for (int i = 0; i < 6; ++i) {
    const double width = step_pose(T_map_body, i, T_up, T_down);
    if (!sensor.place(T_up, at.z, mount, above) || !sensor.place(T_down, at.z, mount, below)) return false;
    largest = std::max(largest, difference(placed.J_landmark_pose.col(i), (above.landmark - below.landmark) / width));
  }
  for (int i = 0; i < sensor.rows(); ++i) {
    const double width = step(at.z, i, x_up, x_down);
    if (!sensor.place(T_map_body, x_up, mount, above) || !sensor.place(T_map_body, x_down, mount, below)) return false;
    largest = std::max(largest, difference(placed.J_landmark_z.col(i), (above.landmark - below.landmark) / width));
  }
  if (sensor.rows() == 3) {
    largest = std::max(largest, difference(placed.landmark, p_map));
  } else {
    if (!sensor.predict(T_map_body, placed.landmark, mount, up)) return false;
    largest = std::max(largest, difference(sensor.residual(up.z, at.z), Vector3::Zero()));
  }
  worst = largest;
  return true;
}

}  // namespace cairn
