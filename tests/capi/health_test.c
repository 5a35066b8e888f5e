/* SPDX-License-Identifier: BSD-3-Clause */
/* The verdict on a filter, and what each sensor's observations show. */
#include "support.h"

static cairn_health health_of(const cairn_filter* filter) {
  cairn_health health;
  memset(&health, 0xff, sizeof health);
  health.struct_size = sizeof health;
  assert_ok(cairn_filter_health(filter, &health, NULL));
  return health;
}

static cairn_sensor_health sensor_of(const cairn_filter* filter, int32_t sensor) {
  cairn_sensor_health health;
  memset(&health, 0xff, sizeof health);
  health.struct_size = sizeof health;
  assert_ok(cairn_filter_sensor_health(filter, sensor, &health, NULL));
  return health;
}

static cairn_observation point(uint64_t id, double x, double y, double z) {
  cairn_observation o;
  memset(&o, 0, sizeof o);
  o.id = id, o.z[0] = x, o.z[1] = y, o.z[2] = z;
  return o;
}

static void a_new_filter_is_good_and_knows_no_noise(void** state) {
  rig r;
  const cairn_filter_options options = test_options();
  (void)state;
  rig_open(&r, &options);
  const cairn_health health = health_of(r.filter);
  assert_int_equal(health.verdict, CAIRN_VERDICT_GOOD);
  assert_true(health.reasons == 0 && health.updates == 0 && health.widenings == 0 && health.reserved == 0);
  assert_true(health.nis_lower == 0 && health.nis_upper == 0 && health.refused_share == 0);
  assert_near(health.motion_scale, 1.0, 0.0);
  assert_true(health.motion_scale_sigma > 1.0);
  const cairn_sensor_health sensor = sensor_of(r.filter, r.sensors[HEAD]);
  assert_true(sensor.compared == 0 && sensor.refused == 0 && sensor.reserved == 0);
  assert_near(sensor.scale, 1.0, 0.0);
  assert_true(sensor.scale_sigma > 1.0);
  rig_close(&r);
}

static void observations_are_counted_by_sensor(void** state) {
  rig r;
  const cairn_filter_options options = test_options();
  (void)state;
  rig_open(&r, &options);
  cairn_observation o[2] = {point(1, 8, 2, 1), point(2, 8, -2, 1)};
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], o, 2, NULL, NULL));
  assert_int_equal(health_of(r.filter).updates, 1);
  assert_int_equal(sensor_of(r.filter, r.sensors[CARTESIAN]).compared, 0);
  o[1].z[1] = 40;
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], o, 2, NULL, NULL));
  const cairn_sensor_health seen = sensor_of(r.filter, r.sensors[CARTESIAN]);
  assert_true(seen.compared == 2 && seen.refused == 1);
  assert_true(seen.nis_lower < 1.0 && seen.nis_upper > 1.0);
  assert_int_equal(sensor_of(r.filter, r.sensors[HEAD]).compared, 0);
  assert_near(health_of(r.filter).refused_share, 0.5, 1e-12);
  assert_int_equal(health_of(r.filter).updates, 2);
  rig_close(&r);
}

static void fixes_are_counted(void** state) {
  rig r;
  const cairn_filter_options options = test_options();
  cairn_pose pose;
  double covariance[9];
  (void)state;
  rig_open(&r, &options);
  diagonal(covariance, 3, 0.01);
  assert_ok(cairn_filter_pose(r.filter, &pose, NULL, NULL));
  assert_ok(cairn_filter_update_position(r.filter, pose.position, covariance, NULL, NULL, NULL));
  assert_near(health_of(r.filter).refused_share, 0.0, 0.0);
  const double x = pose.position[0];
  for (int i = 0; i < 20; ++i) { /* no two agree, so no motion of the filter explains them */
    pose.position[0] = x + (i % 2 == 0 ? 1000.0 : -1000.0) * (i + 1);
    assert_ok(cairn_filter_update_position(r.filter, pose.position, covariance, NULL, NULL, NULL));
  }
  const cairn_health health = health_of(r.filter);
  assert_int_equal(health.updates, 21);
  assert_true(health.refused_share > 0.5);
  assert_int_equal(health.verdict, CAIRN_VERDICT_LOST);
  assert_true((health.reasons & CAIRN_DOUBT_REFUSALS) != 0);
  assert_near(health.good_share + health.doubtful_share + health.lost_share, 1.0, 1e-12);
  rig_close(&r);
}

/* Fixes that agree with each other, far off: the filter finds back (docs/update.md), and is doubtful about it. */
static void fixes_that_agree_widen_the_motion(void** state) {
  rig r;
  const cairn_filter_options options = test_options();
  cairn_pose pose;
  double covariance[9];
  int widened = 0;
  (void)state;
  rig_open(&r, &options);
  diagonal(covariance, 3, 0.01);
  assert_ok(cairn_filter_pose(r.filter, &pose, NULL, NULL));
  const double x = pose.position[0] + 1000;
  pose.position[0] = x;
  for (int i = 0; i < 20; ++i) {
    assert_ok(cairn_filter_update_position(r.filter, pose.position, covariance, NULL, NULL, NULL));
    if (widened == 0 && (health_of(r.filter).reasons & CAIRN_DOUBT_WIDENED) != 0) widened = i + 1;
  }
  assert_int_equal(widened, 3); /* one and two fixes may be wrong */
  assert_true(health_of(r.filter).refused_share < 0.5);
  assert_int_not_equal(health_of(r.filter).verdict, CAIRN_VERDICT_LOST);
  assert_ok(cairn_filter_pose(r.filter, &pose, NULL, NULL));
  assert_near(pose.position[0], x, 0.1);
  rig_close(&r);
}

static void a_refused_call_leaves_it(void** state) {
  rig r;
  const cairn_filter_options options = test_options();
  world w;
  frame f;
  (void)state;
  world_init(&w, 4);
  rig_open(&r, &options);
  for (int i = 0; i < 30; ++i) {
    world_frame(&w, &f);
    assert_ok(rig_take(&r, &f, NULL));
  }
  const cairn_health before = health_of(r.filter);
  const cairn_sensor_health sensor = sensor_of(r.filter, r.sensors[CARTESIAN]);
  cairn_observation twice[2] = {point(1, 8, 2, 1), point(1, 8, 2, 1)};
  assert_status(cairn_filter_update(r.filter, r.sensors[CARTESIAN], twice, 2, NULL, NULL), CAIRN_ERROR_ARGUMENT);
  const cairn_health after = health_of(r.filter);
  const cairn_sensor_health sensor_after = sensor_of(r.filter, r.sensors[CARTESIAN]);
  assert_memory_equal(&before, &after, sizeof after);
  assert_memory_equal(&sensor, &sensor_after, sizeof sensor);
  assert_true(before.updates >= 30);
  rig_close(&r);
}

static void bad_arguments_are_refused(void** state) {
  rig r;
  const cairn_filter_options options = test_options();
  cairn_health health;
  cairn_sensor_health sensor;
  (void)state;
  rig_open(&r, &options);
  health.struct_size = sizeof health, sensor.struct_size = sizeof sensor;
  assert_status(cairn_filter_health(NULL, &health, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_filter_health(r.filter, NULL, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_filter_sensor_health(NULL, 0, &sensor, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_filter_sensor_health(r.filter, 0, NULL, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_filter_sensor_health(r.filter, -1, &sensor, NULL), CAIRN_ERROR_NOT_FOUND);
  assert_status(cairn_filter_sensor_health(r.filter, SENSORS, &sensor, NULL), CAIRN_ERROR_NOT_FOUND);
  health.struct_size = 4;
  assert_status(cairn_filter_health(r.filter, &health, NULL), CAIRN_ERROR_ARGUMENT);
  rig_close(&r);
  cairn_filter_options wrong = test_options();
  cairn_filter* filter = NULL;
  wrong.noise_learning = 2;
  assert_status(cairn_filter_create(&wrong, &filter, NULL), CAIRN_ERROR_ARGUMENT);
  assert_non_null(strstr(cairn_last_message(), "noise_learning"));
  assert_null(filter);
}

static void an_older_struct_is_filled_as_far_as_it_goes(void** state) {
  rig r;
  const cairn_filter_options options = test_options();
  cairn_health health;
  (void)state;
  rig_open(&r, &options);
  memset(&health, 0x55, sizeof health);
  health.struct_size = (uint32_t)offsetof(cairn_health, updates);
  assert_ok(cairn_filter_health(r.filter, &health, NULL));
  assert_int_equal(health.verdict, CAIRN_VERDICT_GOOD);
  assert_true(health.updates == UINT64_C(0x5555555555555555));
  rig_close(&r);
}

static void every_reason_has_its_words(void** state) {
  (void)state;
  for (int bit = 0; bit < 32; ++bit) {
    const char* text = cairn_doubt_text((cairn_doubts)1 << bit);
    assert_non_null(text);
    assert_int_equal(strcmp(text, "unknown") != 0, bit <= 10);
    for (int other = 0; other < bit && bit <= 10; ++other)
      assert_true(strcmp(text, cairn_doubt_text((cairn_doubts)1 << other)) != 0);
  }
  assert_string_equal(cairn_doubt_text(CAIRN_DOUBT_NIS | CAIRN_DOUBT_BIAS), "unknown");
  assert_string_equal(cairn_doubt_text(0), "unknown");
  assert_string_equal(cairn_verdict_text(CAIRN_VERDICT_GOOD), "good");
  assert_string_equal(cairn_verdict_text(CAIRN_VERDICT_DOUBTFUL), "doubtful");
  assert_string_equal(cairn_verdict_text(CAIRN_VERDICT_LOST), "lost");
  assert_string_equal(cairn_verdict_text(3), "unknown");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_new_filter_is_good_and_knows_no_noise),
      cmocka_unit_test(observations_are_counted_by_sensor),
      cmocka_unit_test(fixes_are_counted),
      cmocka_unit_test(fixes_that_agree_widen_the_motion),
      cmocka_unit_test(a_refused_call_leaves_it),
      cmocka_unit_test(bad_arguments_are_refused),
      cmocka_unit_test(an_older_struct_is_filled_as_far_as_it_goes),
      cmocka_unit_test(every_reason_has_its_words),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
