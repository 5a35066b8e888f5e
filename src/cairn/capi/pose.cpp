// SPDX-License-Identifier: BSD-3-Clause
// The C functions of cairn/pose.h.
#include "capi/guard.hpp"
#include "geometry/euler.hpp"

using namespace cairn;
using namespace cairn::capi;

extern "C" {

cairn_status cairn_pose_identity(cairn_pose* pose, cairn_error* error) {
  return guard(error, [&] {
    check_pointer(pose, "pose");
    write_pose(SE3(), pose);
  });
}

cairn_status cairn_pose_compose(const cairn_pose* T_a_b, const cairn_pose* T_b_c, cairn_pose* result,
                                cairn_error* error) {
  return guard(error, [&] {
    const SE3 product = read_pose(T_a_b, "T_a_b") * read_pose(T_b_c, "T_b_c");
    check_pointer(result, "result");
    check_finite(product.translation().data(), 3, "T_a_b * T_b_c");
    write_pose(product, result);
  });
}

cairn_status cairn_pose_inverse(const cairn_pose* T_a_b, cairn_pose* result, cairn_error* error) {
  return guard(error, [&] {
    const SE3 inverse = read_pose(T_a_b, "T_a_b").inverse();
    check_pointer(result, "result");
    check_finite(inverse.translation().data(), 3, "inverse of T_a_b");
    write_pose(inverse, result);
  });
}

cairn_status cairn_pose_apply(const cairn_pose* T_a_b, const double point_b[3], double point_a[3], cairn_error* error) {
  return guard(error, [&] {
    const SE3 T = read_pose(T_a_b, "T_a_b");
    check_pointer(point_b, "point_b");
    check_finite(point_b, 3, "point_b");
    check_pointer(point_a, "point_a");
    const Vector3 moved = T * Vector3(point_b);
    check_finite(moved.data(), 3, "T_a_b * point_b");
    std::copy_n(moved.data(), 3, point_a);
  });
}

cairn_status cairn_quaternion_from_euler(double roll, double pitch, double yaw, double quaternion[4],
                                         cairn_error* error) {
  return guard(error, [&] {
    check_finite(roll, "roll");
    check_finite(pitch, "pitch");
    check_finite(yaw, "yaw");
    check_pointer(quaternion, "quaternion");
    write_quaternion(from_euler({roll, pitch, yaw}), quaternion);
  });
}

cairn_status cairn_quaternion_to_euler(const double quaternion[4], double* roll, double* pitch, double* yaw,
                                       cairn_error* error) {
  return guard(error, [&] {
    const Euler angles = to_euler(read_quaternion(quaternion, "quaternion"));
    check_pointer(roll, "roll");
    check_pointer(pitch, "pitch");
    check_pointer(yaw, "yaw");
    *roll = angles.roll, *pitch = angles.pitch, *yaw = angles.yaw;
  });
}

cairn_status cairn_quaternion_exp(const double rotation_vector[3], double quaternion[4], cairn_error* error) {
  return guard(error, [&] {
    check_pointer(rotation_vector, "rotation_vector");
    check_finite(rotation_vector, 3, "rotation_vector");
    check_pointer(quaternion, "quaternion");
    const SO3 rotation = SO3::exp(Vector3(rotation_vector));
    if (!rotation.quaternion().coeffs().allFinite())
      throw Error(ErrorCode::argument, "rotation_vector is too long: its square is not finite");
    write_quaternion(rotation, quaternion);
  });
}

cairn_status cairn_quaternion_log(const double quaternion[4], double rotation_vector[3], cairn_error* error) {
  return guard(error, [&] {
    const Vector3 theta = read_quaternion(quaternion, "quaternion").log();
    check_pointer(rotation_vector, "rotation_vector");
    std::copy_n(theta.data(), 3, rotation_vector);
  });
}

cairn_status cairn_pose_error(const cairn_pose* truth, const cairn_pose* estimate, double difference[6],
                              cairn_error* error) {
  return guard(error, [&] {
    const SE3 t = read_pose(truth, "truth"), e = read_pose(estimate, "estimate");
    check_pointer(difference, "difference");
    const Vector3 dp = t.translation() - e.translation();
    const Vector3 dtheta = (t.rotation() * e.rotation().inverse()).log();
    check_finite(dp.data(), 3, "truth - estimate");
    std::copy_n(dp.data(), 3, difference);
    std::copy_n(dtheta.data(), 3, difference + 3);
  });
}

}  // extern "C"
