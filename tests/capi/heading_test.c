/* SPDX-License-Identifier: BSD-3-Clause */
/* Headings of a tilted body: what is refused near the vertical, and consistency of what is taken in. */
#include "points_ahead.h"

static int heading_case(double pitch, double tilt_sigma, double yaw_sigma, double sigma, generator* random,
                        double* nees) {
  cairn_filter_options o = options_of(CAIRN_VEHICLE_SPATIAL, CAIRN_STATE_ERROR_INVARIANT);
  cairn_pose error = {{0, 0, 0}, {1, 0, 0, 0}}, truth;
  double turn[3] = {0, 0, 0}, axis[9];
  cairn_match m;
  if (random != NULL) {
    for (int i = 0; i < 2; ++i) turn[i] = random_normal(random, tilt_sigma);
    turn[2] = random_normal(random, yaw_sigma);
  }
  o.initial_pose = pose_at(0, 0, 0, 0, pitch, 0.3);
  for (int i = 0; i < 3; ++i) o.initial_covariance[7 * i] = 1e-4;
  o.initial_covariance[21] = o.initial_covariance[28] = tilt_sigma * tilt_sigma;
  o.initial_covariance[35] = yaw_sigma * yaw_sigma;
  assert_ok(cairn_quaternion_exp(turn, error.quaternion, NULL));
  assert_ok(cairn_pose_compose(&error, &o.initial_pose, &truth, NULL));
  rotation_matrix(truth.quaternion, axis);
  cairn_filter* f = create(&o);
  const double noise = random != NULL ? random_normal(random, sigma) : 0;
  assert_ok(cairn_filter_update_heading(f, atan2(axis[3], axis[0]) + noise, sigma, &m, NULL));
  if (nees != NULL) {
    for (int i = 0; i < 3; ++i) truth.position[i] = random_normal(random, 1e-2);
    assert_ok(cairn_filter_pose_nees(f, &truth, nees, NULL));
  }
  cairn_filter_destroy(f);
  if (m.result == CAIRN_RESULT_REJECTED) assert_int_equal(m.reason, nees != NULL ? m.reason : CAIRN_REASON_NO_IMAGE);
  return m.result;
}

/* How near to the vertical a heading is good depends on the uncertainty of the tilt. */
static void a_heading_near_the_vertical_is_refused_by_the_tilt(void** state) {
  (void)state;
  assert_int_equal(heading_case(84 * DEGREE, 0.1, 0.05, 0.02, NULL, NULL), CAIRN_RESULT_REJECTED);
  assert_int_equal(heading_case(-84 * DEGREE, 0.1, 0.05, 0.02, NULL, NULL), CAIRN_RESULT_REJECTED);
  assert_int_equal(heading_case(84 * DEGREE, 0.036, 0.05, 0.02, NULL, NULL), CAIRN_RESULT_REJECTED);
  assert_int_equal(heading_case(84 * DEGREE, 0.034, 0.05, 0.02, NULL, NULL), CAIRN_RESULT_MATCHED);
  assert_int_equal(heading_case(88 * DEGREE, 1e-3, 0.05, 0.02, NULL, NULL), CAIRN_RESULT_MATCHED);
  assert_int_equal(heading_case(89.99 * DEGREE, 0, 0.05, 0.02, NULL, NULL), CAIRN_RESULT_REJECTED);
  assert_int_equal(heading_case(30 * DEGREE, 0.6, 0.05, 0.02, NULL, NULL), CAIRN_RESULT_REJECTED);
  assert_int_equal(heading_case(0, 1, 3, 0.02, NULL, NULL), CAIRN_RESULT_MATCHED); /* an unknown heading is no tilt */
}

/* What is taken in is consistent: NEES of the pose, six degrees of freedom. */
static void a_heading_of_a_tilted_body_is_consistent(void** state) {
  static const double cases[][4] = {{84, 0.034, 0.05, 0.02}, {84, 0.02, 0.5, 0.02}, {70, 0.12, 0.5, 0.002},
                                    {60, 0.1, 0.1, 0.1},     {45, 0.25, 0.5, 0.02}, {10, 0.05, 0.3, 0.02}};
  enum { RUNS = 1000 };
  (void)state;
  for (size_t k = 0; k < LENGTH(cases); ++k) {
    generator random = {17 + k};
    double sum = 0, nees = 0;
    for (int n = 0; n < RUNS; ++n) {
      heading_case(cases[k][0] * DEGREE, cases[k][1], cases[k][2], cases[k][3], &random, &nees);
      sum += nees;
    }
    assert_true(sum / RUNS / 6 > 0.75 && sum / RUNS / 6 < 1.1);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_heading_near_the_vertical_is_refused_by_the_tilt),
      cmocka_unit_test(a_heading_of_a_tilted_body_is_consistent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
