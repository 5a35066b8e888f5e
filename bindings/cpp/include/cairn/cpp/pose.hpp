// SPDX-License-Identifier: BSD-3-Clause
// Poses, and conversions from and to Euler angles.
#ifndef CAIRN_CPP_POSE_HPP
#define CAIRN_CPP_POSE_HPP

#include <cairn/cpp/array.hpp>

namespace cairn {

/// A pose and the covariance of its error [dp; dtheta], 6 x 6, row-major.
struct PoseEstimate {
  Pose pose;
  Square<6> covariance{};
};

struct EulerAngles {
  double roll = 0.0, pitch = 0.0, yaw = 0.0;
};

//~ cairn_pose_identity
/// Sets a pose to the identity.
///
/// Complexity: O(1).
inline Pose pose_identity() {
  Pose pose;
  detail::call([&](cairn_error* error) { return cairn_pose_identity(detail::as_c(&pose), error); });
  return pose;
}

//~ cairn_pose_compose
/// Composes two poses: `T_a_c = T_a_b * T_b_c`. Quaternions are normalised; a quaternion that is zero or not finite is
/// refused. `result` may be one of the inputs.
///
/// Throws Error: Status::kErrorArgument.
///
/// Complexity: O(1).
inline Pose operator*(const Pose& T_a_b, const Pose& T_b_c) {
  Pose result;
  detail::call([&](cairn_error* error) {
    return cairn_pose_compose(detail::as_c(&T_a_b), detail::as_c(&T_b_c), detail::as_c(&result), error);
  });
  return result;
}

//~ cairn_pose_inverse
/// Inverts a pose: `T_b_a` from `T_a_b`.
///
/// Throws Error: Status::kErrorArgument.
///
/// Complexity: O(1).
inline Pose inverse(const Pose& T_a_b) {
  Pose result;
  detail::call(
      [&](cairn_error* error) { return cairn_pose_inverse(detail::as_c(&T_a_b), detail::as_c(&result), error); });
  return result;
}

//~ cairn_pose_apply
/// Transforms a point from frame b to frame a (m).
///
/// Throws Error: Status::kErrorArgument.
///
/// Complexity: O(1).
inline std::array<double, 3> transform(const Pose& T_a_b, Vector<3> point_b) {
  std::array<double, 3> point_a{};
  detail::call([&](cairn_error* error) {
    return cairn_pose_apply(detail::as_c(&T_a_b), point_b.get("point_b"), point_a.data(), error);
  });
  return point_a;
}

//~ cairn_pose_error
/// Error of an estimate against the truth: `difference` gets `[dp; dtheta]` as Pose defines it.
///
/// Throws Error: Status::kErrorArgument.
///
/// Complexity: O(1).
inline std::array<double, 6> pose_error(const Pose& truth, const Pose& estimate) {
  std::array<double, 6> difference{};
  detail::call([&](cairn_error* error) {
    return cairn_pose_error(detail::as_c(&truth), detail::as_c(&estimate), difference.data(), error);
  });
  return difference;
}

//~ cairn_quaternion_from_euler
/// Quaternion of roll, pitch and yaw (rad): `R = Rz(yaw) Ry(pitch) Rx(roll)`.
///
/// Throws Error: Status::kErrorArgument (not finite).
///
/// Complexity: O(1).
inline std::array<double, 4> quaternion_from_euler(double roll, double pitch, double yaw) {
  std::array<double, 4> quaternion{};
  detail::call(
      [&](cairn_error* error) { return cairn_quaternion_from_euler(roll, pitch, yaw, quaternion.data(), error); });
  return quaternion;
}

//~ cairn_quaternion_to_euler
/// Roll, pitch and yaw (rad) of a quaternion; pitch lies in [-pi/2, pi/2]. At pitch = +-pi/2 roll and yaw turn about
/// the same axis; there roll is set to 0.
///
/// Throws Error: Status::kErrorArgument.
///
/// Complexity: O(1).
inline EulerAngles quaternion_to_euler(Vector<4> quaternion) {
  EulerAngles angles;
  detail::call([&](cairn_error* error) {
    return cairn_quaternion_to_euler(quaternion.get("quaternion"), &angles.roll, &angles.pitch, &angles.yaw, error);
  });
  return angles;
}

//~ cairn_quaternion_exp
/// Quaternion of a rotation vector (axis times angle, rad).
///
/// Throws Error: Status::kErrorArgument.
///
/// Complexity: O(1).
inline std::array<double, 4> quaternion_exp(Vector<3> rotation_vector) {
  std::array<double, 4> quaternion{};
  detail::call([&](cairn_error* error) {
    return cairn_quaternion_exp(rotation_vector.get("rotation_vector"), quaternion.data(), error);
  });
  return quaternion;
}

//~ cairn_quaternion_log
/// Rotation vector of a quaternion (rad). Its length is at most pi.
///
/// Throws Error: Status::kErrorArgument.
///
/// Complexity: O(1).
inline std::array<double, 3> quaternion_log(Vector<4> quaternion) {
  std::array<double, 3> rotation_vector{};
  detail::call([&](cairn_error* error) {
    return cairn_quaternion_log(quaternion.get("quaternion"), rotation_vector.data(), error);
  });
  return rotation_vector;
}

}  // namespace cairn

#endif
