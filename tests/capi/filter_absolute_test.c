/* SPDX-License-Identifier: BSD-3-Clause */
/* Absolute position, attitude and heading, updates that the caller linearised, and both error states. */
#include "support.h"

static cairn_filter* create(const cairn_pose* start, int32_t error, uint32_t iterations) {
  cairn_filter_options options = test_options();
  cairn_filter* filter = NULL;
  options.state_error = error;
  options.iterations = iterations;
  options.iteration_tolerance = 1e-6;
  options.initial_pose = *start;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) options.initial_covariance[6 * i + j] = 4e-3 * (i == j) + 1e-3 / (1 + i + j);
  assert_ok(cairn_filter_create(&options, &filter, NULL));
  return filter;
}

static void assert_alike(const cairn_filter* a, const cairn_filter* b, double tolerance) {
  cairn_pose pa, pb;
  double error[6], ca[36], cb[36];
  assert_ok(cairn_filter_pose(a, &pa, ca, NULL));
  assert_ok(cairn_filter_pose(b, &pb, cb, NULL));
  assert_ok(cairn_pose_error(&pa, &pb, error, NULL));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, tolerance);
  for (int i = 0; i < 36; ++i) assert_near(ca[i], cb[i], tolerance);
}

static double variance(const cairn_filter* filter, int i) {
  double covariance[36];
  assert_ok(cairn_filter_pose(filter, NULL, covariance, NULL));
  return covariance[7 * i];
}

static const cairn_pose origin = {{0, 0, 0}, {1, 0, 0, 0}};

static void linear_equals_position_with_and_without_a_lever(void** state) {
  const cairn_pose start = pose_at(3, -2, 1, 0.3, 0.2, -0.9);
  const double lever[3] = {0.5, -0.3, 1.2}, covariance[9] = {0.04, 0.01, 0, 0.01, 0.09, 0, 0, 0, 0.01};
  (void)state;
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error)
    for (int with = 0; with < 2; ++with) {
      cairn_filter *a = create(&start, error, 1), *b = create(&start, error, 1);
      double z[3], h[3], residual[3] = {0.05, -0.1, 0.08}, J[18] = {0}, R[9], arm[3] = {0, 0, 0}, cross[9];
      cairn_match ma, mb;
      rotation_matrix(start.quaternion, R);
      if (with)
        for (int i = 0; i < 3; ++i) arm[i] = R[3 * i] * lever[0] + R[3 * i + 1] * lever[1] + R[3 * i + 2] * lever[2];
      cross_matrix(arm, cross);
      for (int i = 0; i < 3; ++i) {
        h[i] = start.position[i] + arm[i];
        z[i] = h[i] + residual[i];
        J[7 * i] = 1;
        for (int j = 0; j < 3; ++j) J[6 * i + 3 + j] = -cross[3 * i + j];
      }
      assert_ok(cairn_filter_update_position(a, z, covariance, with ? lever : NULL, &ma, NULL));
      assert_ok(cairn_filter_update_linear(b, residual, 3, covariance, J, NULL, 0, NULL, &mb, NULL));
      assert_alike(a, b, 1e-9);
      assert_int_equal(ma.result, CAIRN_RESULT_MATCHED);
      assert_int_equal(mb.result, CAIRN_RESULT_MATCHED);
      assert_true(ma.landmark == CAIRN_ID_NONE && mb.landmark == CAIRN_ID_NONE);
      assert_near(ma.distance, mb.distance, 1e-9);
      assert_near(ma.threshold, mb.threshold, 1e-9);
      cairn_filter_destroy(a);
      cairn_filter_destroy(b);
    }
}

static void linear_equals_attitude(void** state) {
  const cairn_pose start = pose_at(3, -2, 1, 0.3, 0.2, -0.9);
  const double residual[3] = {0.02, -0.03, 0.05}, covariance[9] = {4e-3, 1e-3, 0, 1e-3, 9e-3, 0, 0, 0, 1e-3};
  /* r = Log(Z R^T) changes by -J_r(r)^-1 dtheta with J_r^-1 = I + [r]x / 2 + (1/a^2 - (1 + cos a) / (2 a sin a)) [r]x^2
   * (docs/sensors.md) */
  const double a = sqrt(0.0038), factor = 1 / (a * a) - (1 + cos(a)) / (2 * a * sin(a));
  double cross[9], square[9], J[18] = {0};
  (void)state;
  cross_matrix(residual, cross);
  multiply3(cross, cross, square);
  for (int i = 0; i < 9; ++i) J[6 * (i / 3) + 3 + i % 3] = (i % 4 == 0) + cross[i] / 2 + factor * square[i];
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
    cairn_filter *one = create(&start, error, 1), *two = create(&start, error, 1);
    cairn_pose turn = origin, measured;
    cairn_match matches[2];
    assert_ok(cairn_quaternion_exp(residual, turn.quaternion, NULL));
    assert_ok(cairn_pose_compose(&turn, &start, &measured, NULL));
    assert_ok(cairn_filter_update_attitude(one, measured.quaternion, covariance, &matches[0], NULL));
    assert_ok(cairn_filter_update_linear(two, residual, 3, covariance, J, NULL, 0, NULL, &matches[1], NULL));
    assert_near(matches[0].distance, matches[1].distance, 1e-9);
    assert_alike(one, two, 1e-9);
    cairn_filter_destroy(one);
    cairn_filter_destroy(two);
  }
}

/* The frame of a cartesian sensor, linearised by the caller: three rows for each landmark. */
static void linear_equals_a_frame_of_points(void** state) {
  (void)state;
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
    cairn_filter_options options = test_options();
    rig a, b;
    const double points[2][3] = {{6, 2, 1}, {4, -3, 2}};
    const uint64_t ids[2] = {11, 3};
    cairn_observation o[2];
    cairn_match m;
    cairn_pose pose;
    double residual[6], covariance[36] = {0}, Jp[36] = {0}, Jl[36] = {0};
    options.state_error = error, options.iterations = 1;
    rig_open(&a, &options);
    rig_open(&b, &options);
    memset(o, 0, sizeof o);
    for (int k = 0; k < 2; ++k) o[k].id = ids[k], memcpy(o[k].z, points[k], sizeof points[k]);
    for (int k = 0; k < 2; ++k) {
      rig* r = k == 0 ? &a : &b;
      assert_ok(cairn_filter_update(r->filter, r->sensors[CARTESIAN], o, 2, NULL, NULL));
      assert_ok(cairn_filter_predict_wheels(r->filter, 0.5, 2, 2.5, NULL));
    }
    assert_ok(cairn_filter_pose(a.filter, &pose, NULL, NULL));
    for (int k = 0; k < 2; ++k) {
      cairn_landmark landmark;
      double z[3], jp[18], jl[9];
      assert_ok(cairn_map_landmark(cairn_filter_map(a.filter), ids[k], &landmark, NULL));
      (void)point_predict(NULL, &pose, landmark.position, z, jp, jl);
      for (int i = 0; i < 3; ++i) {
        o[k].z[i] = z[i] + 0.03 * (i - k);
        residual[3 * k + i] = 0.03 * (i - k);
        covariance[7 * (3 * k + i)] = 0.01;
        memcpy(&Jp[6 * (3 * k + i)], &jp[6 * i], 6 * sizeof jp[0]);
        memcpy(&Jl[6 * (3 * k + i) + 3 * k], &jl[3 * i], 3 * sizeof jl[0]);
      }
    }
    assert_ok(cairn_filter_update(a.filter, a.sensors[CARTESIAN], o, 2, NULL, NULL));
    assert_ok(cairn_filter_update_linear(b.filter, residual, 6, covariance, Jp, ids, 2, Jl, &m, NULL));
    assert_int_equal(m.result, CAIRN_RESULT_MATCHED);
    assert_int_equal(m.landmark, 11);
    assert_alike(a.filter, b.filter, 1e-9);
    for (int k = 0; k < 2; ++k) {
      cairn_landmark la, lb;
      assert_ok(cairn_map_landmark(cairn_filter_map(a.filter), ids[k], &la, NULL));
      assert_ok(cairn_map_landmark(cairn_filter_map(b.filter), ids[k], &lb, NULL));
      for (int i = 0; i < 3; ++i) assert_near(la.position[i], lb.position[i], 1e-9);
      for (int i = 0; i < 9; ++i) assert_near(la.covariance[i], lb.covariance[i], 1e-9);
    }
    rig_close(&a);
    rig_close(&b);
  }
}

static void an_absolute_value_corrects_and_reduces_the_covariance(void** state) {
  (void)state;
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
    cairn_filter* f = create(&origin, error, 3);
    double before[6], covariance[9], q[4];
    const double position[3] = {0.1, -0.05, 0.02}, tilt[3] = {0.05, 0, 0};
    cairn_pose pose;
    cairn_match m;
    for (int i = 0; i < 6; ++i) before[i] = variance(f, i);
    diagonal(covariance, 3, 1e-4);
    assert_ok(cairn_filter_update_position(f, position, covariance, NULL, &m, NULL));
    assert_int_equal(m.result, CAIRN_RESULT_MATCHED);
    assert_near(m.threshold, 16.26623619623813, 1e-6);
    assert_ok(cairn_filter_pose(f, &pose, NULL, NULL));
    for (int i = 0; i < 3; ++i) {
      assert_true(variance(f, i) < 1e-4 && variance(f, i) < before[i]);
      assert_near(pose.position[i], position[i], 0.01);
    }
    cairn_filter_destroy(f);
    f = create(&origin, error, 3);
    assert_ok(cairn_quaternion_exp(tilt, q, NULL));
    for (int i = 0; i < 4; ++i) q[i] *= -2; /* the sign and the length of a quaternion do not matter */
    assert_ok(cairn_filter_update_attitude(f, q, covariance, &m, NULL));
    assert_int_equal(m.result, CAIRN_RESULT_MATCHED);
    assert_ok(cairn_filter_pose(f, &pose, NULL, NULL));
    for (int i = 3; i < 6; ++i) assert_true(variance(f, i) < 1e-4 && variance(f, i) < before[i]);
    assert_near(2 * pose.quaternion[1] / pose.quaternion[0], 0.05, 0.003);
    cairn_filter_destroy(f);
    f = create(&origin, error, 3);
    assert_ok(cairn_filter_update_heading(f, 0.05, 0.01, &m, NULL));
    assert_int_equal(m.result, CAIRN_RESULT_MATCHED);
    assert_near(m.threshold, 10.82756617, 1e-5);
    assert_near(m.distance, 0.05 * 0.05 / (before[5] + 1e-4), 1e-9);
    assert_ok(cairn_filter_pose(f, &pose, NULL, NULL));
    assert_true(variance(f, 5) < 1e-4 + 1e-12 && variance(f, 5) < before[5]);
    assert_near(2 * pose.quaternion[3] / pose.quaternion[0], 0.05 * before[5] / (before[5] + 1e-4), 1e-4);
    cairn_filter_destroy(f);
  }
}

static void an_absolute_outlier_is_gated(void** state) {
  bench* b = *state;
  cairn_match m;
  cairn_pose pose;
  double covariance[9], far[3], q[4], residual[1] = {100}, one[1] = {1}, J[6] = {1, 0, 0, 0, 0, 0};
  double angle[3] = {0, 0, 3};
  diagonal(covariance, 3, 1e-4);
  for (int call = 0; call < 4; ++call) {
    cairn_pose after;
    double ca[36], cb[36];
    assert_ok(cairn_filter_pose(b->main.filter, &pose, ca, NULL));
    for (int i = 0; i < 3; ++i) far[i] = pose.position[i] + 50;
    cairn_pose turn = origin, turned;
    double roll, pitch, yaw;
    assert_ok(cairn_quaternion_to_euler(pose.quaternion, &roll, &pitch, &yaw, NULL));
    assert_ok(cairn_quaternion_exp(angle, turn.quaternion, NULL));
    assert_ok(cairn_pose_compose(&turn, &pose, &turned, NULL));
    memcpy(q, turned.quaternion, sizeof q);
    if (call == 0) assert_ok(cairn_filter_update_position(b->main.filter, far, covariance, NULL, &m, NULL));
    if (call == 1) assert_ok(cairn_filter_update_attitude(b->main.filter, q, covariance, &m, NULL));
    if (call == 2) assert_ok(cairn_filter_update_heading(b->main.filter, yaw + 2, 1e-3, &m, NULL));
    if (call == 3) assert_ok(cairn_filter_update_linear(b->main.filter, residual, 1, one, J, NULL, 0, NULL, &m, NULL));
    assert_int_equal(m.result, CAIRN_RESULT_REJECTED);
    assert_true(m.reason == CAIRN_REASON_GATE || m.reason == CAIRN_REASON_BATCH_GATE);
    assert_true(m.distance > m.threshold && m.threshold > 0);
    const cairn_update_report report = last_update(b->main.filter);
    assert_true(report.rejected == 1 && report.matched == 0 && report.rows == 0);
    assert_ok(cairn_filter_pose(b->main.filter, &after, cb, NULL));
    assert_memory_equal(&pose, &after, sizeof pose);
    assert_memory_equal(ca, cb, sizeof ca);
    bench_continue(b, 3); /* a refused value changes only the report */
  }
}

static void heading_wraps(void** state) {
  static const double sides[][2] = {
      {3.13, -3.13}, {-3.13, 3.13}, {3.13, 3.15318530717958623}, {0.01, 6.29}, {-0.02, -12.58}};
  (void)state;
  for (size_t n = 0; n < LENGTH(sides); ++n) {
    const cairn_pose start = pose_at(0, 0, 0, 0, 0, sides[n][0]);
    cairn_filter* f = create(&start, CAIRN_STATE_ERROR_INVARIANT, 3);
    cairn_match m;
    cairn_pose pose;
    const double yaw_variance = variance(f, 5);
    double r, p, y;
    assert_ok(cairn_filter_update_heading(f, sides[n][1], 1e-3, &m, NULL));
    assert_int_equal(m.result, CAIRN_RESULT_MATCHED);
    const double gap = remainder(sides[n][1] - sides[n][0], 2 * PI);
    assert_near(m.distance, gap * gap / (yaw_variance + 1e-6), 1e-9);
    assert_ok(cairn_filter_pose(f, &pose, NULL, NULL));
    assert_ok(cairn_quaternion_to_euler(pose.quaternion, &r, &p, &y, NULL));
    assert_near(remainder(y - sides[n][1], 2 * PI), 0, 1e-4);
    cairn_filter_destroy(f);
  }
}

static void heading_is_refused_near_the_vertical(void** state) {
  static const struct {
    double pitch;
    bool refused;
  } cases[] = {{90, true},    {-90, true}, {88, true},   {-86, true}, {79.5, true},
               {-79.5, true}, {77, false}, {-77, false}, {30, false}}; /* a tilt of 0.065 rad */
  (void)state;
  for (size_t n = 0; n < LENGTH(cases); ++n) {
    const cairn_pose start = pose_at(1, 2, 3, 0, cases[n].pitch * DEGREE, 0.3);
    cairn_filter* f = create(&start, CAIRN_STATE_ERROR_INVARIANT, 3);
    cairn_match m;
    cairn_pose a, b;
    assert_ok(cairn_filter_pose(f, &a, NULL, NULL));
    assert_ok(cairn_filter_update_heading(f, 0.3, 0.05, &m, NULL));
    assert_ok(cairn_filter_pose(f, &b, NULL, NULL));
    assert_int_equal(m.result, cases[n].refused ? CAIRN_RESULT_REJECTED : CAIRN_RESULT_MATCHED);
    assert_int_equal(m.reason, cases[n].refused ? CAIRN_REASON_NO_IMAGE : CAIRN_REASON_NONE);
    assert_true(m.landmark == CAIRN_ID_NONE);
    if (cases[n].refused) assert_memory_equal(&a, &b, sizeof a);
    cairn_filter_destroy(f);
  }
}

/* With a known pose and perfect values both error states give the same result, because no correction has moved their
 * axes apart. */
static void both_errors_agree_at_the_start(void** state) {
  world w;
  frame f;
  rig r[2];
  double covariance[2][36], small[9];
  cairn_filter_options options = test_options();
  (void)state;
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  for (int motion = 0; motion < MOTIONS; ++motion) {
    world_init(&w, 3);
    w.noise = 0;
    world_frame(&w, &f);
    f.motion = motion;
    for (int k = 0; k < 2; ++k) {
      options.state_error = k == 0 ? CAIRN_STATE_ERROR_INVARIANT : CAIRN_STATE_ERROR_STANDARD;
      rig_open(&r[k], &options);
      assert_ok(rig_take(&r[k], &f, NULL));
      diagonal(small, 3, 1e-5);
      cairn_pose pose;
      assert_ok(cairn_filter_pose(r[k].filter, &pose, NULL, NULL));
      assert_ok(cairn_filter_update_position(r[k].filter, pose.position, small, NULL, NULL, NULL));
      assert_ok(cairn_filter_pose(r[k].filter, NULL, covariance[k], NULL));
    }
    assert_alike(r[0].filter, r[1].filter, 1e-9);
    for (int i = 0; i < 6; ++i) assert_true(covariance[0][7 * i] > 1e-9); /* the covariance is not zero */
    for (int i = 0; i < 36; ++i) assert_near(covariance[0][i], covariance[1][i], 1e-12);
    for (int k = 0; k < 2; ++k) rig_close(&r[k]);
  }
}

/* Both filters drive through the whole world and stay near the truth. They are different filters. */
static void both_errors_follow_the_truth(void** state) {
  cairn_pose estimates[2];
  (void)state;
  for (int k = 0; k < 2; ++k) {
    world w;
    frame f;
    rig r;
    double error[6], nees, pivot;
    cairn_filter_options options = test_options();
    options.state_error = k == 0 ? CAIRN_STATE_ERROR_INVARIANT : CAIRN_STATE_ERROR_STANDARD;
    world_init(&w, 8);
    rig_open(&r, &options);
    for (int n = 0; n < 120; ++n) {
      world_frame(&w, &f);
      assert_ok(rig_take(&r, &f, NULL));
    }
    assert_ok(cairn_filter_pose(r.filter, &estimates[k], NULL, NULL));
    assert_ok(cairn_pose_error(&w.truth, &estimates[k], error, NULL));
    for (int i = 0; i < 3; ++i) assert_near(error[i], 0, 0.5);
    for (int i = 3; i < 6; ++i) assert_near(error[i], 0, 0.05);
    assert_ok(cairn_filter_pose_nees(r.filter, &w.truth, &nees, NULL));
    assert_true(nees > 0 && nees < 40);
    assert_ok(cairn_filter_audit(r.filter, &pivot, NULL));
    assert_true(pivot > 0);
    rig_close(&r);
  }
  assert_memory_not_equal(&estimates[0], &estimates[1], sizeof estimates[0]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(linear_equals_position_with_and_without_a_lever),
      cmocka_unit_test(linear_equals_attitude),
      cmocka_unit_test(linear_equals_a_frame_of_points),
      cmocka_unit_test(an_absolute_value_corrects_and_reduces_the_covariance),
      cmocka_unit_test_setup_teardown(an_absolute_outlier_is_gated, bench_setup, bench_teardown),
      cmocka_unit_test(heading_wraps),
      cmocka_unit_test(heading_is_refused_near_the_vertical),
      cmocka_unit_test(both_errors_agree_at_the_start),
      cmocka_unit_test(both_errors_follow_the_truth),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
