/* SPDX-License-Identifier: BSD-3-Clause */
/* Difficult arithmetic: maps far from their origin, precise sensors after an uncertain start, long runs, and a custom
 * sensor that changes its behaviour. */
#include "support.h"

static double pivot_of(cairn_filter* f) {
  double pivot = NAN;
  assert_ok(cairn_filter_audit(f, &pivot, NULL));
  return pivot;
}

/* The same world in a map with a distant origin (UTM: 400 km and 5000 km). The filter must behave the same. */
static void the_position_of_the_origin_does_not_matter(void** state) {
  static const double offsets[][3] = {{10, -20, 3}, {1e3, 1e3, -50}, {4e5, 5e6, 300}};
  (void)state;
  for (size_t k = 0; k < LENGTH(offsets); ++k)
    for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
      cairn_filter_options options = test_options();
      rig near, far;
      world w;
      frame f;
      double a[36], b[36];
      cairn_pose pa, pb;
      options.state_error = error;
      options.initial_covariance[35] = 0.04; /* the heading is almost unknown */
      rig_open(&near, &options);
      for (int i = 0; i < 3; ++i) options.initial_pose.position[i] += offsets[k][i];
      rig_open(&far, &options);
      world_init(&w, 44);
      for (int n = 0; n < 300; ++n) {
        cairn_match ma[WORLD_LANDMARKS], mb[WORLD_LANDMARKS];
        world_frame(&w, &f);
        assert_ok(rig_take(&near, &f, ma));
        for (int i = 0; i < 3; ++i) f.position[i] += offsets[k][i];
        assert_ok(rig_take(&far, &f, mb));
        for (size_t i = 0; i < f.count; ++i) assert_int_equal(ma[i].result, mb[i].result);
      }
      assert_ok(cairn_filter_pose(near.filter, &pa, a, NULL));
      assert_ok(cairn_filter_pose(far.filter, &pb, b, NULL));
      for (int i = 0; i < 3; ++i) assert_near(pb.position[i] - offsets[k][i], pa.position[i], 1e-6);
      for (int i = 0; i < 6; ++i) assert_near(b[7 * i], a[7 * i], 1e-3 * a[7 * i]);
      for (uint64_t id = 1; id <= WORLD_LANDMARKS; ++id) {
        cairn_landmark la, lb;
        assert_ok(cairn_map_landmark(cairn_filter_map(near.filter), id, &la, NULL));
        assert_ok(cairn_map_landmark(cairn_filter_map(far.filter), id, &lb, NULL));
        for (int i = 0; i < 3; ++i) {
          assert_near(lb.position[i] - offsets[k][i], la.position[i], 1e-6);
          assert_near(lb.covariance[4 * i], la.covariance[4 * i], 1e-3 * la.covariance[4 * i]);
        }
      }
      assert_true(pivot_of(far.filter) > 0);
      rig_close(&near);
      rig_close(&far);
    }
}

/* The start is uncertain by a hundred metres; one fix reduces that to a millimetre. */
static void a_precise_fix_ends_an_uncertain_start(void** state) {
  (void)state;
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
    cairn_filter_options options = test_options();
    const double position[3] = {37, -52, 8};
    double covariance[36], noise[9];
    cairn_pose pose;
    cairn_match m;
    rig r;
    options.state_error = error;
    for (int i = 0; i < 3; ++i) options.initial_covariance[7 * i] = 1e4;
    rig_open(&r, &options);
    diagonal(noise, 3, 1e-6);
    for (int n = 1; n <= 2; ++n) {
      assert_ok(cairn_filter_update_position(r.filter, position, noise, NULL, &m, NULL));
      assert_int_equal(m.result, CAIRN_RESULT_MATCHED);
    }
    assert_ok(cairn_filter_pose(r.filter, &pose, covariance, NULL));
    for (int i = 0; i < 3; ++i) {
      assert_near(pose.position[i], position[i], 1e-5);
      assert_near(covariance[7 * i], 0.5e-6, 0.5e-8);
    }
    assert_true(pivot_of(r.filter) > 0);
    rig_close(&r);
  }
}

static void a_long_run_stays_positive_definite_and_near_the_truth(void** state) {
  (void)state;
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
    cairn_filter_options options = test_options();
    cairn_pose pose;
    double off[6];
    world w;
    frame f;
    rig r;
    options.state_error = error;
    rig_open(&r, &options);
    world_init(&w, 45);
    for (int n = 0; n < 3000; ++n) {
      world_frame(&w, &f);
      assert_ok(rig_take(&r, &f, NULL));
      if (n % 100 == 0) assert_true(pivot_of(r.filter) > 0);
    }
    assert_ok(cairn_filter_pose(r.filter, &pose, NULL, NULL));
    assert_ok(cairn_pose_error(&w.truth, &pose, off, NULL));
    for (int i = 0; i < 3; ++i) assert_near(off[i], 0, 0.3);
    rig_close(&r);
  }
}

/* A sensor that refuses a landmark at its n-th call, or gives a Jacobian that is not a number, and worked before. */
typedef struct mood {
  int calls, turn_at;
  bool refuse;
} mood;

static int32_t moody_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                             double* jacobian_pose, double* jacobian_landmark) {
  mood* m = user;
  (void)point_predict(NULL, pose, landmark, z, jacobian_pose, jacobian_landmark);
  if (++m->calls != m->turn_at) return 1;
  if (!m->refuse) jacobian_pose[3] = NAN;
  return !m->refuse;
}

static void a_sensor_that_changes_its_behaviour_harms_nothing(void** state) {
  enum { POINTS = 5 };
  (void)state;
  for (int refuse = 0; refuse < 2; ++refuse)
    for (int turn_at = 1;; ++turn_at) {
      cairn_filter_options options = test_options();
      mood m = {0, 0, refuse != 0};
      own_sensor custom = test_point();
      cairn_observation o[POINTS];
      cairn_match matches[POINTS];
      const cairn_pose stay = {{0, 0, 0}, {1, 0, 0, 0}};
      double noise[36], before[36], after[36];
      int32_t sensor;
      rig r;
      options.initial_pose = stay, options.max_sensors = SENSORS + 1, options.iteration_tolerance = 1e-6;
      rig_open(&r, &options);
      custom.predict = moody_predict, custom.user = &m;
      assert_ok(add_own(r.filter, &custom, &sensor));
      memset(o, 0, sizeof o);
      for (int i = 0; i < POINTS; ++i)
        o[i].id = (uint64_t)i, o[i].z[0] = 5 + i, o[i].z[1] = i * i - 4, o[i].z[2] = i % 3;
      assert_ok(cairn_filter_update(r.filter, sensor, o, POINTS, NULL, NULL));
      diagonal(noise, 6, 1e-2);
      assert_ok(cairn_filter_predict_increment(r.filter, &stay, noise, NULL));
      assert_ok(cairn_filter_pose(r.filter, NULL, before, NULL));
      for (int i = 0; i < POINTS; ++i) o[i].z[0] += 0.05 * (i - 2);
      m.calls = 0, m.turn_at = turn_at;
      const cairn_status status = cairn_filter_update(r.filter, sensor, o, POINTS, matches, NULL);
      const bool done = m.calls < turn_at;
      assert_ok(cairn_filter_pose(r.filter, NULL, after, NULL));
      assert_true(pivot_of(r.filter) > 0);
      if (status == CAIRN_OK) { /* a match that says it updated did update */
        uint32_t matched = 0;
        const cairn_update_report report = last_update(r.filter);
        for (int i = 0; i < POINTS; ++i) matched += matches[i].result == CAIRN_RESULT_MATCHED;
        assert_int_equal(report.matched, matched);
        assert_int_equal(report.rows, 3 * matched);
        assert_true(matched >= POINTS - 1);
        for (int i = 0; i < 6; ++i) assert_true(after[7 * i] < before[7 * i]);
      } else {
        assert_int_equal(status, CAIRN_ERROR_NUMERICAL);
        assert_memory_equal(before, after, sizeof before);
      }
      rig_close(&r);
      if (done) break;
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_position_of_the_origin_does_not_matter),
      cmocka_unit_test(a_precise_fix_ends_an_uncertain_start),
      cmocka_unit_test(a_long_run_stays_positive_definite_and_near_the_truth),
      cmocka_unit_test(a_sensor_that_changes_its_behaviour_harms_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
