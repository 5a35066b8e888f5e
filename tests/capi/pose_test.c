/* SPDX-License-Identifier: BSD-3-Clause */
/* Poses, quaternions and Euler angles. */
#include "support.h"

static cairn_pose random_pose(generator* random) {
  cairn_pose pose;
  double square = 0;
  do {
    square = 0;
    for (int i = 0; i < 4; ++i)
      pose.quaternion[i] = random_uniform(random, -1, 1), square += pose.quaternion[i] * pose.quaternion[i];
  } while (square < 0.01 || square > 1);
  for (int i = 0; i < 4; ++i) pose.quaternion[i] /= sqrt(square);
  for (int i = 0; i < 3; ++i) pose.position[i] = random_uniform(random, -20, 20);
  return pose;
}

static void assert_same_rotation(const double a[4], const double b[4], double tolerance) {
  double ma[9], mb[9];
  rotation_matrix(a, ma);
  rotation_matrix(b, mb);
  for (int i = 0; i < 9; ++i) assert_near(ma[i], mb[i], tolerance);
}

static void assert_unit(const double q[4]) {
  assert_near(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-14);
}

static void identity_is_the_identity(void** state) {
  cairn_pose pose;
  (void)state;
  memset(&pose, 0x5a, sizeof pose);
  assert_ok(cairn_pose_identity(&pose, NULL));
  for (int i = 0; i < 3; ++i) assert_true(pose.position[i] == 0.0);
  for (int i = 0; i < 4; ++i) assert_true(pose.quaternion[i] == (i == 0 ? 1.0 : 0.0));
}

static void compose_chains_two_maps_of_points(void** state) {
  generator random = {1};
  (void)state;
  for (int n = 0; n < 200; ++n) {
    const cairn_pose ab = random_pose(&random), bc = random_pose(&random);
    cairn_pose ac;
    const double c[3] = {random_uniform(&random, -5, 5), random_uniform(&random, -5, 5),
                         random_uniform(&random, -5, 5)};
    double b[3], expected[3], a[3];
    assert_ok(cairn_pose_compose(&ab, &bc, &ac, NULL));
    assert_unit(ac.quaternion);
    to_map(&bc, c, b);
    to_map(&ab, b, expected);
    assert_ok(cairn_pose_apply(&ac, c, a, NULL));
    for (int i = 0; i < 3; ++i) assert_near(a[i], expected[i], 1e-12);
  }
}

static void inverse_undoes_and_apply_moves(void** state) {
  generator random = {2};
  (void)state;
  for (int n = 0; n < 200; ++n) {
    const cairn_pose ab = random_pose(&random);
    cairn_pose ba, both;
    const double p[3] = {1, -2, 3}, one[4] = {1, 0, 0, 0};
    double there[3], back[3];
    assert_ok(cairn_pose_inverse(&ab, &ba, NULL));
    assert_ok(cairn_pose_apply(&ab, p, there, NULL));
    to_body(&ab, there, back);
    for (int i = 0; i < 3; ++i) assert_near(back[i], p[i], 1e-12);
    assert_ok(cairn_pose_apply(&ba, there, back, NULL));
    for (int i = 0; i < 3; ++i) assert_near(back[i], p[i], 1e-12);
    assert_ok(cairn_pose_compose(&ba, &ab, &both, NULL));
    for (int i = 0; i < 3; ++i) assert_near(both.position[i], 0, 1e-12);
    assert_same_rotation(both.quaternion, one, 1e-14);
  }
}

static void a_result_may_overwrite_an_input(void** state) {
  generator random = {3};
  const cairn_pose ab = random_pose(&random), bc = random_pose(&random);
  cairn_pose apart, result;
  double point[3] = {1, 2, 3}, moved[3];
  (void)state;
  assert_ok(cairn_pose_compose(&ab, &bc, &apart, NULL));
  result = ab;
  assert_ok(cairn_pose_compose(&result, &bc, &result, NULL));
  assert_memory_equal(&result, &apart, sizeof apart);
  result = bc;
  assert_ok(cairn_pose_compose(&ab, &result, &result, NULL));
  assert_memory_equal(&result, &apart, sizeof apart);
  assert_ok(cairn_pose_compose(&ab, &ab, &apart, NULL));
  result = ab;
  assert_ok(cairn_pose_compose(&result, &result, &result, NULL));
  assert_memory_equal(&result, &apart, sizeof apart);
  assert_ok(cairn_pose_inverse(&ab, &apart, NULL));
  result = ab;
  assert_ok(cairn_pose_inverse(&result, &result, NULL));
  assert_memory_equal(&result, &apart, sizeof apart);
  assert_ok(cairn_pose_apply(&ab, point, moved, NULL));
  assert_ok(cairn_pose_apply(&ab, point, point, NULL));
  assert_memory_equal(point, moved, sizeof moved);
}

static void quaternions_are_normalised_at_any_scale(void** state) {
  static const double scales[] = {1e-90, 1e-20, 0.5, 3, 1e20, 1e160, 1e308};
  generator random = {4};
  const cairn_pose ab = random_pose(&random), identity = {{0, 0, 0}, {1, 0, 0, 0}};
  (void)state;
  for (size_t n = 0; n < LENGTH(scales); ++n) {
    cairn_pose scaled = ab, result;
    for (int i = 0; i < 4; ++i) scaled.quaternion[i] *= scales[n];
    assert_ok(cairn_pose_compose(&scaled, &identity, &result, NULL));
    assert_unit(result.quaternion);
    assert_same_rotation(result.quaternion, ab.quaternion, 1e-14);
  }
}

static void euler_is_yaw_pitch_roll(void** state) {
  generator random = {5};
  (void)state;
  for (int n = 0; n < 300; ++n) {
    const double roll = random_uniform(&random, -PI, PI), pitch = random_uniform(&random, -1.57, 1.57),
                 yaw = random_uniform(&random, -PI, PI);
    const double rx[9] = {1, 0, 0, 0, cos(roll), -sin(roll), 0, sin(roll), cos(roll)};
    const double ry[9] = {cos(pitch), 0, sin(pitch), 0, 1, 0, -sin(pitch), 0, cos(pitch)};
    const double rz[9] = {cos(yaw), -sin(yaw), 0, sin(yaw), cos(yaw), 0, 0, 0, 1};
    double q[4], zy[9], zyx[9], m[9], r, p, y;
    assert_ok(cairn_quaternion_from_euler(roll, pitch, yaw, q, NULL));
    assert_unit(q);
    multiply3(rz, ry, zy);
    multiply3(zy, rx, zyx);
    rotation_matrix(q, m);
    for (int i = 0; i < 9; ++i) assert_near(m[i], zyx[i], 1e-14);
    assert_ok(cairn_quaternion_to_euler(q, &r, &p, &y, NULL));
    const double slack = 1e-14 / cos(pitch) / cos(pitch) + 1e-13;
    assert_near(p, pitch, slack);
    assert_near(r, roll, slack);
    assert_near(y, yaw, slack);
  }
}

static void at_gimbal_lock_roll_is_zero_and_the_rotation_stays(void** state) {
  (void)state;
  for (int sign = -1; sign <= 1; sign += 2)
    for (double yaw = -3; yaw < 3.1; yaw += 0.75) {
      double q[4], again[4], r, p, y;
      assert_ok(cairn_quaternion_from_euler(0.4, sign * PI / 2, yaw, q, NULL));
      assert_ok(cairn_quaternion_to_euler(q, &r, &p, &y, NULL));
      assert_true(r == 0.0);
      assert_near(p, sign * PI / 2, 1e-7);
      assert_true(fabs(p) <= PI / 2);
      assert_ok(cairn_quaternion_from_euler(r, p, y, again, NULL));
      assert_same_rotation(q, again, 1e-7);
    }
}

static void near_gimbal_lock_the_rotation_survives(void** state) {
  (void)state;
  for (double gap = 1e-1; gap > 1e-12; gap /= 10)
    for (int sign = -1; sign <= 1; sign += 2) {
      double q[4], again[4], r, p, y;
      assert_ok(cairn_quaternion_from_euler(0.7, sign * (PI / 2 - gap), -1.1, q, NULL));
      assert_ok(cairn_quaternion_to_euler(q, &r, &p, &y, NULL));
      assert_true(fabs(p) <= PI / 2);
      assert_ok(cairn_quaternion_from_euler(r, p, y, again, NULL));
      assert_same_rotation(q, again, 1e-7);
    }
}

static void exp_is_rodrigues_and_log_its_inverse(void** state) {
  static const double angles[] = {0, 1e-300, 1e-160, 1e-12, 1e-8,      1e-4,      0.1,
                                  1, 2,      3,      3.14,  PI - 1e-6, PI - 1e-9, PI - 1e-12};
  generator random = {6};
  (void)state;
  for (size_t n = 0; n < LENGTH(angles); ++n)
    for (int k = 0; k < 20; ++k) {
      const double a = angles[n];
      double axis[3], v[3], q[4], back[3], m[9], K[9], K2[9], length = 0;
      for (int i = 0; i < 3; ++i) axis[i] = random_uniform(&random, -1, 1), length += axis[i] * axis[i];
      for (int i = 0; i < 3; ++i) axis[i] /= sqrt(length), v[i] = axis[i] * a;
      assert_ok(cairn_quaternion_exp(v, q, NULL));
      assert_unit(q);
      rotation_matrix(q, m);
      cross_matrix(axis, K);
      multiply3(K, K, K2);
      for (int i = 0; i < 9; ++i) assert_near(m[i], (i % 4 == 0) + sin(a) * K[i] + (1 - cos(a)) * K2[i], 1e-14);
      assert_ok(cairn_quaternion_log(q, back, NULL));
      for (int i = 0; i < 3; ++i) assert_near(back[i], v[i], 1e-15 + 4e-15 * a);
      for (int i = 0; i < 4; ++i) q[i] = -q[i]; /* the same rotation */
      assert_ok(cairn_quaternion_log(q, back, NULL));
      for (int i = 0; i < 3; ++i) assert_near(back[i], v[i], 1e-15 + 4e-15 * a);
    }
}

static void log_is_never_longer_than_pi(void** state) {
  const double half_turn[4] = {0, 0, 1, 0}, turn_and_more[3] = {0, 0, 3.5};
  double v[3], q[4];
  (void)state;
  assert_ok(cairn_quaternion_log(half_turn, v, NULL));
  assert_near(fabs(v[1]), PI, 1e-15);
  assert_true(v[0] == 0.0 && v[2] == 0.0);
  assert_ok(cairn_quaternion_exp(turn_and_more, q, NULL));
  assert_ok(cairn_quaternion_log(q, v, NULL));
  assert_near(v[2], 3.5 - 2 * PI, 1e-14);
}

static void the_error_takes_the_estimate_to_the_truth(void** state) {
  generator random = {7};
  (void)state;
  for (int n = 0; n < 100; ++n) {
    const cairn_pose estimate = random_pose(&random);
    cairn_pose turn = {{0, 0, 0}, {1, 0, 0, 0}}, level = estimate, truth;
    double expected[6], error[6];
    for (int i = 0; i < 6; ++i) expected[i] = random_uniform(&random, -1, 1);
    assert_ok(cairn_quaternion_exp(expected + 3, turn.quaternion, NULL));
    memset(level.position, 0, sizeof level.position);
    assert_ok(cairn_pose_compose(&turn, &level, &truth, NULL)); /* R_true = Exp(dtheta) R */
    for (int i = 0; i < 3; ++i) truth.position[i] = estimate.position[i] + expected[i];
    assert_ok(cairn_pose_error(&truth, &estimate, error, NULL));
    for (int i = 0; i < 6; ++i) assert_near(error[i], expected[i], 1e-13);
  }
}

static void every_null_is_refused_by_name(void** state) {
  const cairn_pose pose = {{0, 0, 0}, {1, 0, 0, 0}};
  const double v[3] = {0, 0, 0}, q[4] = {1, 0, 0, 0};
  cairn_pose out;
  double a, b, c, v3[3], q4[4], e[6];
  (void)state;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "pose", cairn_pose_identity(NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_a_b", cairn_pose_compose(NULL, &pose, &out, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_b_c", cairn_pose_compose(&pose, NULL, &out, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "result", cairn_pose_compose(&pose, &pose, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_a_b", cairn_pose_inverse(NULL, &out, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "result", cairn_pose_inverse(&pose, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_a_b", cairn_pose_apply(NULL, v, v3, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "point_b", cairn_pose_apply(&pose, NULL, v3, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "point_a", cairn_pose_apply(&pose, v, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "quaternion", cairn_quaternion_from_euler(0, 0, 0, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "quaternion", cairn_quaternion_to_euler(NULL, &a, &b, &c, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "roll", cairn_quaternion_to_euler(q, NULL, &b, &c, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "pitch", cairn_quaternion_to_euler(q, &a, NULL, &c, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "yaw", cairn_quaternion_to_euler(q, &a, &b, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rotation_vector", cairn_quaternion_exp(NULL, q4, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "quaternion", cairn_quaternion_exp(v, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "quaternion", cairn_quaternion_log(NULL, v3, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rotation_vector", cairn_quaternion_log(q, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "truth", cairn_pose_error(NULL, &pose, e, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "estimate", cairn_pose_error(&pose, NULL, e, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "difference", cairn_pose_error(&pose, &pose, NULL, NULL));
}

/* `bad` replaces `good` in every function that takes a pose. Nothing may be written. */
static void refuse_pose(const cairn_pose* good, const cairn_pose* bad) {
  cairn_pose out, kept;
  double v[3] = {7, 7, 7}, e[6] = {7, 7, 7, 7, 7, 7};
  const double p[3] = {0, 0, 0};
  memset(&out, 0x5a, sizeof out);
  kept = out;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_a_b", cairn_pose_compose(bad, good, &out, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_b_c", cairn_pose_compose(good, bad, &out, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_a_b", cairn_pose_inverse(bad, &out, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_a_b", cairn_pose_apply(bad, p, v, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "truth", cairn_pose_error(bad, good, e, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "estimate", cairn_pose_error(good, bad, e, NULL));
  assert_memory_equal(&out, &kept, sizeof out);
  for (int i = 0; i < 3; ++i) assert_true(v[i] == 7);
  for (int i = 0; i < 6; ++i) assert_true(e[i] == 7);
}

static void values_that_are_not_finite_and_zero_quaternions_are_refused(void** state) {
  const cairn_pose good = {{1, 2, 3}, {1, 0, 0, 0}};
  double q[4], v[3], r, p, y;
  (void)state;
  for (size_t n = 0; n < LENGTH(not_finite); ++n) {
    for (int i = 0; i < 3; ++i) {
      cairn_pose bad = good;
      double vector[3] = {0.1, 0.2, 0.3};
      bad.position[i] = vector[i] = not_finite[n];
      refuse_pose(&good, &bad);
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "point_b", cairn_pose_apply(&good, vector, v, NULL));
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rotation_vector", cairn_quaternion_exp(vector, q, NULL));
    }
    for (int i = 0; i < 4; ++i) {
      cairn_pose bad = good;
      bad.quaternion[i] = not_finite[n];
      refuse_pose(&good, &bad);
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "quaternion",
                     cairn_quaternion_to_euler(bad.quaternion, &r, &p, &y, NULL));
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "quaternion", cairn_quaternion_log(bad.quaternion, v, NULL));
    }
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "roll", cairn_quaternion_from_euler(not_finite[n], 0, 0, q, NULL));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "pitch", cairn_quaternion_from_euler(0, not_finite[n], 0, q, NULL));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "yaw", cairn_quaternion_from_euler(0, 0, not_finite[n], q, NULL));
  }
  cairn_pose zero = good;
  memset(zero.quaternion, 0, sizeof zero.quaternion);
  refuse_pose(&good, &zero);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "quaternion",
                 cairn_quaternion_to_euler(zero.quaternion, &r, &p, &y, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "quaternion", cairn_quaternion_log(zero.quaternion, v, NULL));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(identity_is_the_identity),
      cmocka_unit_test(compose_chains_two_maps_of_points),
      cmocka_unit_test(inverse_undoes_and_apply_moves),
      cmocka_unit_test(a_result_may_overwrite_an_input),
      cmocka_unit_test(quaternions_are_normalised_at_any_scale),
      cmocka_unit_test(euler_is_yaw_pitch_roll),
      cmocka_unit_test(at_gimbal_lock_roll_is_zero_and_the_rotation_stays),
      cmocka_unit_test(near_gimbal_lock_the_rotation_survives),
      cmocka_unit_test(exp_is_rodrigues_and_log_its_inverse),
      cmocka_unit_test(log_is_never_longer_than_pi),
      cmocka_unit_test(the_error_takes_the_estimate_to_the_truth),
      cmocka_unit_test(every_null_is_refused_by_name),
      cmocka_unit_test(values_that_are_not_finite_and_zero_quaternions_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
