/* SPDX-License-Identifier: BSD-3-Clause */
/* Callbacks of a custom sensor that abort the call. */
#include "points_ahead.h"

/* A custom sensor whose callback aborts at its n-th call. */
typedef struct aborting {
  int calls, abort_at;
  int32_t with;
} aborting;

static int32_t aborting_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                                double* jacobian_pose, double* jacobian_landmark) {
  aborting* a = user;
  if (++a->calls == a->abort_at) return a->with;
  return point_predict(NULL, pose, landmark, z, jacobian_pose, jacobian_landmark);
}

static int32_t aborting_place(void* user, const cairn_pose* pose, const double* z, double landmark[3],
                              double* jacobian_pose, double* jacobian_z) {
  aborting* a = user;
  if (++a->calls == a->abort_at) return a->with;
  return point_place(NULL, pose, z, landmark, jacobian_pose, jacobian_z);
}

/* Whichever call of a callback aborts, predictions, places or the view after the frame: the filter is as before. */
static void a_negative_callback_aborts_the_whole_frame(void** state) {
  (void)state;
  for (int association = 0; association < 3; ++association)
    for (int at = 1;; ++at) {
      cairn_filter_options o = options_of(CAIRN_VEHICLE_SPATIAL, CAIRN_STATE_ERROR_INVARIANT);
      aborting a = {0, 0, at % 2 == 0 ? -1 : INT32_MIN};
      own_sensor custom = test_point();
      const double lower[3] = {0, -50, -50}, upper[3] = {50, 50, 50};
      cairn_observation shot[NEAR];
      cairn_match m[NEAR], kept[NEAR];
      snapshot before = {0, NULL}, after = {0, NULL};
      int32_t sensor = -1;
      o.missed_frames = 1, o.association = association;
      for (int i = 0; i < 6; ++i) o.initial_covariance[7 * i] = 1e-4;
      cairn_filter* f = create(&o);
      custom.predict = aborting_predict, custom.place = aborting_place, custom.user = &a;
      assert_ok(add_own(f, &custom, &sensor));
      assert_ok(cairn_filter_set_view(f, sensor, lower, upper, NULL));
      for (uint64_t i = 0; i < NEAR; ++i) shot[i] = seen(CAIRN_VEHICLE_SPATIAL, 3 * i, 0);
      assert_ok(cairn_filter_update(f, sensor, shot, 6, m, NULL));
      step(f);
      for (int i = 0; i < NEAR; ++i) shot[i].z[0] -= 0.1;
      snapshot_take(&before, f);
      a.calls = 0, a.abort_at = at;
      memset(m, 0xa5, sizeof m);
      memcpy(kept, m, sizeof m);
      /* one known landmark is missed, two are new */
      const cairn_status status = cairn_filter_update(f, sensor, shot + 1, NEAR - 1, m, NULL);
      const bool done = a.calls < at;
      snapshot_take(&after, f);
      if (done) {
        assert_ok(status);
        assert_int_equal(m[5].result, CAIRN_RESULT_NEW);
        assert_int_equal(last_update(f).removed, 1);
      } else {
        assert_int_equal(status, CAIRN_ERROR_CALLBACK);
        assert_non_null(strstr(cairn_last_message(), "custom.p"));
        assert_true(snapshot_same(&before, &after));
        assert_memory_equal(m, kept, sizeof m);
        a.abort_at = 0; /* the same frame, given again, is taken in as if nothing had happened */
        assert_ok(cairn_filter_update(f, sensor, shot + 1, NEAR - 1, m, NULL));
        assert_int_equal(m[0].result, CAIRN_RESULT_MATCHED);
        assert_int_equal(last_update(f).placed, 2);
      }
      snapshot_free(&before);
      snapshot_free(&after);
      cairn_filter_destroy(f);
      if (!done) continue;
      assert_true(at > 15); /* predictions, places twice, the view */
      break;
    }
}

static void a_check_of_a_sensor_that_aborts_fails(void** state) {
  aborting a = {0, 1, -5};
  own_sensor custom = test_point();
  const cairn_pose pose = pose_at(0, 0, 0, 0, 0, 0);
  const double landmark[3] = {3, 1, 0};
  double worst = 0;
  (void)state;
  custom.predict = aborting_predict, custom.place = aborting_place, custom.user = &a;
  assert_refused(NULL, CAIRN_ERROR_CALLBACK, "custom.predict returned -5", check_own(&custom, &pose, landmark, &worst));
}

/* A custom sensor of the whole world agrees with the built-in one although it asks for places before the commit. */
static void a_custom_sensor_places_like_a_built_in_one(void** state) {
  (void)state;
  cairn_filter_options o = options_of(CAIRN_VEHICLE_SPATIAL, CAIRN_STATE_ERROR_INVARIANT);
  diagonal(o.initial_covariance, 6, 1e-2);
  cairn_pose pose[2];
  cairn_landmark landmark[2];
  for (int own = 0; own < 2; ++own) {
    cairn_filter* f = create(&o);
    int32_t sensor = add_sensor(f, CAIRN_VEHICLE_SPATIAL);
    own_sensor custom = test_point();
    for (int i = 0; i < 3; ++i) custom.model.sigma[i] = 0.1;
    if (own == 1) assert_ok(add_own(f, &custom, &sensor));
    for (int n = 0; n < 6; ++n) {
      cairn_observation shot[3];
      for (uint64_t i = 0; i < 3; ++i) shot[i] = seen(CAIRN_VEHICLE_SPATIAL, (uint64_t)n + i, 0.1 * n + 0.05);
      step(f);
      assert_ok(cairn_filter_update(f, sensor, shot, 3, NULL, NULL));
    }
    assert_ok(cairn_filter_pose(f, &pose[own], NULL, NULL));
    assert_ok(cairn_map_landmark(cairn_filter_map(f), 7, &landmark[own], NULL));
    cairn_filter_destroy(f);
  }
  for (int i = 0; i < 3; ++i) assert_near(pose[0].position[i], pose[1].position[i], 1e-9);
  for (int i = 0; i < 3; ++i) assert_near(landmark[0].position[i], landmark[1].position[i], 1e-9);
  for (int i = 0; i < 9; ++i) assert_near(landmark[0].covariance[i], landmark[1].covariance[i], 1e-9);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_negative_callback_aborts_the_whole_frame),
      cmocka_unit_test(a_check_of_a_sensor_that_aborts_fails),
      cmocka_unit_test(a_custom_sensor_places_like_a_built_in_one),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
