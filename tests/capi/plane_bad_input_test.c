/* SPDX-License-Identifier: BSD-3-Clause */
/* Sensors, poses and attitudes that a planar vehicle cannot use are refused. */
#include "plane.h"

static void sensors_of_the_other_vehicle_kind_are_refused(void** state) {
  const cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT),
                             spatial = plane_options(CAIRN_VEHICLE_SPATIAL, CAIRN_STATE_ERROR_INVARIANT);
  cairn_filter *plane = plane_filter(&options), *space = plane_filter(&spatial);
  const cairn_stereo_head head = test_head();
  const cairn_stereo_camera camera = test_camera();
  cairn_range_bearing radar;
  cairn_cartesian points;
  int32_t sensor = -77;
  (void)state;
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar, NULL));
  assert_ok(cairn_cartesian_init(&points, sizeof points, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_add_stereo_head(plane, &head, &sensor, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_add_stereo_camera(plane, &camera, &sensor, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_add_range_bearing(space, &radar, &sensor, NULL));
  const cairn_pose tilted[] = {pose_at(0, 0, 0.1, 0, 0, 0), pose_at(0, 0, 0, 0.1, 0, 0), pose_at(0, 0, 0, 0, -0.1, 1),
                               pose_at(0, 0, 0, PI, 0, 0)};
  for (size_t i = 0; i < LENGTH(tilted); ++i) {
    radar.T_body_sensor = points.T_body_sensor = tilted[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_body_sensor",
                   cairn_filter_add_range_bearing(plane, &radar, &sensor, NULL));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_body_sensor",
                   cairn_filter_add_cartesian(plane, &points, &sensor, NULL));
  }
  assert_int_equal(sensor, -77);
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar, NULL));
  const double bad[] = {0, -1, NAN, INFINITY};
  for (size_t i = 0; i < LENGTH(bad); ++i) {
    cairn_range_bearing r = radar;
    r.range_sigma = bad[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "range_sigma", cairn_filter_add_range_bearing(plane, &r, &sensor, NULL));
    r = radar, r.bearing_sigma = bad[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "bearing_sigma",
                   cairn_filter_add_range_bearing(plane, &r, &sensor, NULL));
    r = radar, r.near_range = bad[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "near_range", cairn_filter_add_range_bearing(plane, &r, &sensor, NULL));
  }
  points.T_body_sensor = radar.T_body_sensor;
  points.sigma[2] = -1; /* does not exist in the plane */
  assert_ok(cairn_filter_add_cartesian(plane, &points, &sensor, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "sigma", cairn_filter_add_cartesian(space, &points, &sensor, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "", cairn_filter_point_head(plane, 0, 0, 0, NULL));
  cairn_filter_destroy(plane);
  cairn_filter_destroy(space);
}

static void poses_out_of_the_plane_are_refused(void** state) {
  cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT);
  const cairn_pose outside[] = {pose_at(1, 0, 1e-6, 0, 0, 0), pose_at(1, 0, 0, 1e-6, 0, 0),
                                pose_at(1, 0, 0, 0, 1e-6, 1), pose_at(1, 0, 0, PI, 0, 0),
                                pose_at(1, 0, 0, 0, PI / 2, 0)};
  const cairn_pose inside = pose_at(1, 0, 1e-10, 1e-10, 0, 3);
  cairn_filter *f = plane_filter(&options), *other = NULL;
  snapshot before = {0, NULL}, after = {0, NULL};
  double c[36], v[3] = {1, 0, 5}, w[3] = {3, -4, 0.1};
  size_t bytes = 0;
  (void)state;
  diagonal(c, 6, 1e-4);
  snapshot_take(&before, f);
  for (size_t i = 0; i < LENGTH(outside); ++i) {
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_before_after",
                   cairn_filter_predict_increment(f, &outside[i], c, NULL));
    options.initial_pose = outside[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "initial_pose", cairn_filter_create(&options, &other, NULL));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "initial_pose", cairn_filter_required_bytes(&options, &bytes, NULL));
  }
  snapshot_take(&after, f);
  assert_true(snapshot_same(&before, &after));
  assert_ok(cairn_filter_predict_increment(f, &inside, c, NULL)); /* a deviation of the size of rounding */
  cairn_pose pose;
  assert_ok(cairn_filter_pose(f, &pose, c, NULL));
  assert_true(pose.position[2] == 0 && pose.quaternion[1] == 0 && pose.quaternion[2] == 0);
  /* Only x, y and yaw of a twist are used. */
  const double v_flat[3] = {1, 0, 0}, w_flat[3] = {0, 0, 0.1};
  options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT);
  cairn_filter *a = plane_filter(&options), *b = plane_filter(&options);
  assert_ok(cairn_filter_predict_twist(a, 0.5, v, w, NULL));
  assert_ok(cairn_filter_predict_twist(b, 0.5, v_flat, w_flat, NULL));
  plane_compare(a, b, 0);
  const int32_t vehicles[] = {-1, 2, INT32_MAX};
  for (size_t i = 0; i < LENGTH(vehicles); ++i) {
    options.vehicle = vehicles[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options.vehicle", cairn_filter_create(&options, &other, NULL));
  }
  assert_null(other);
  snapshot_free(&before), snapshot_free(&after);
  cairn_filter_destroy(f), cairn_filter_destroy(a), cairn_filter_destroy(b);
}

/* An attitude whose x axis is vertical has no heading. It is refused, by status or by match, and changes nothing. */
static void an_attitude_without_a_heading_changes_nothing(void** state) {
  const cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT);
  cairn_filter* f = plane_filter(&options);
  const cairn_pose upright = pose_at(0, 0, 0, 0.3, PI / 2, 0);
  cairn_pose before, after;
  double noise[9], ca[36], cb[36];
  cairn_match m;
  (void)state;
  diagonal(noise, 3, 1e-2);
  assert_ok(cairn_filter_pose(f, &before, ca, NULL));
  const cairn_status status = cairn_filter_update_attitude(f, upright.quaternion, noise, &m, NULL);
  assert_true(status == CAIRN_ERROR_ARGUMENT || (status == CAIRN_OK && m.result == CAIRN_RESULT_REJECTED));
  assert_ok(cairn_filter_pose(f, &after, cb, NULL));
  assert_memory_equal(&before, &after, sizeof before);
  assert_memory_equal(ca, cb, sizeof ca);
  cairn_filter_destroy(f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sensors_of_the_other_vehicle_kind_are_refused),
      cmocka_unit_test(poses_out_of_the_plane_are_refused),
      cmocka_unit_test(an_attitude_without_a_heading_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
