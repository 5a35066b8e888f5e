/* SPDX-License-Identifier: BSD-3-Clause */
/* Sensors of a planar vehicle: range and bearing, and a sensor that the caller defines. */
#include "plane.h"

/* The pose is known exactly and the observations have no noise: landmarks are placed exactly, and their covariance is
 * the stated noise. */
static void range_and_bearing_place_landmarks(void** state) {
  cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT);
  cairn_range_bearing radar;
  cairn_pose sensor_pose;
  cairn_observation o[POINTS];
  cairn_match m[POINTS];
  int32_t sensor;
  (void)state;
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  cairn_filter* f = plane_filter(&options);
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar, NULL));
  radar.T_body_sensor = pose_at(0.4, -0.3, 0, 0, 0, -2.0);
  radar.range_sigma = 0.2, radar.bearing_sigma = 0.03;
  assert_ok(cairn_filter_add_range_bearing(f, &radar, &sensor, NULL));
  assert_ok(cairn_pose_compose(&options.initial_pose, &radar.T_body_sensor, &sensor_pose, NULL));
  for (size_t l = 0; l < POINTS; ++l) {
    double range, bearing;
    plane_polar(&sensor_pose, plane_points[l], &range, &bearing);
    o[l] = sighting(l, range, bearing + (l % 2 == 0 ? 0 : 2 * PI)); /* any number of turns */
    o[l].z[2] = NAN;                                                /* not read: two values count */
    if (l == 3) o[l].covariance[0] = 0.5, o[l].covariance[1] = o[l].covariance[2] = 1e-3, o[l].covariance[3] = 1e-2;
  }
  assert_ok(cairn_filter_update(f, sensor, o, POINTS, m, NULL));
  for (size_t l = 0; l < POINTS; ++l) {
    cairn_landmark landmark;
    double range, bearing;
    assert_int_equal(m[l].result, CAIRN_RESULT_NEW);
    assert_ok(cairn_map_landmark(cairn_filter_map(f), l, &landmark, NULL));
    for (int k = 0; k < 3; ++k) assert_near(landmark.position[k], plane_points[l][k], 1e-12);
    plane_polar(&sensor_pose, plane_points[l], &range, &bearing);
    const double at = bearing + 0.1 - 2.0, c = cos(at), s = sin(at); /* bearing in the map */
    const double rr = l == 3 ? 0.5 : 0.04, rb = l == 3 ? 1e-3 : 0, bb = l == 3 ? 1e-2 : 9e-4;
    const double J[2][2] = {{c, -range * s}, {s, range * c}};
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k)
        assert_near(landmark.covariance[3 * i + k],
                    J[i][0] * J[k][0] * rr + (J[i][0] * J[k][1] + J[i][1] * J[k][0]) * rb + J[i][1] * J[k][1] * bb,
                    1e-12 + 1e-12 * range * range);
  }
  assert_ok(cairn_filter_update(f, sensor, o, POINTS, m, NULL));
  for (size_t l = 0; l < POINTS; ++l) {
    assert_int_equal(m[l].result, CAIRN_RESULT_MATCHED);
    assert_near(m[l].distance, 0, 1e-18);
  }
  /* Nothing is seen at less than near_range. */
  o[0] = sighting(77, 0.001, 0);
  assert_ok(cairn_filter_update(f, sensor, o, 1, m, NULL));
  assert_int_equal(m[0].reason, CAIRN_REASON_NO_PLACE);
  cairn_filter_destroy(f);
}

/* Range and bearing, computed by the caller: equal to the library's up to rounding. */
static int32_t caller_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                              double* jacobian_pose, double* jacobian_landmark) {
  const double dx = landmark[0] - pose->position[0], dy = landmark[1] - pose->position[1];
  const double yaw = 2 * atan2(pose->quaternion[3], pose->quaternion[0]), r2 = dx * dx + dy * dy, r = sqrt(r2);
  if (user != NULL) ++*(int*)user;
  if (landmark[2] != 0 || pose->position[2] != 0 || !(r > 0.01)) return 0;
  z[0] = r, z[1] = atan2(dy, dx) - yaw;
  const double l[6] = {dx / r, dy / r, 0, -dy / r2, dx / r2, 0};
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 3; ++k) {
      jacobian_landmark[3 * i + k] = l[3 * i + k];
      jacobian_pose[6 * i + k] = -l[3 * i + k];
      jacobian_pose[6 * i + 3 + k] = i == 1 && k == 2 ? -1 : 0;
    }
    jacobian_landmark[3 * i + 2] = 9; /* out of the plane: ignored */
    jacobian_pose[6 * i + 3] = 9;
  }
  return 1;
}

static int32_t caller_place(void* user, const cairn_pose* pose, const double* z, double landmark[3],
                            double* jacobian_pose, double* jacobian_z) {
  const double at = 2 * atan2(pose->quaternion[3], pose->quaternion[0]) + z[1], x = z[0] * cos(at), y = z[0] * sin(at);
  (void)user;
  landmark[0] = pose->position[0] + x, landmark[1] = pose->position[1] + y, landmark[2] = 0;
  for (int i = 0; i < 18; ++i) jacobian_pose[i] = i % 7 == 0 ? 1 : 0;
  jacobian_pose[5] = -y, jacobian_pose[11] = x;
  jacobian_z[0] = cos(at), jacobian_z[1] = -y;
  jacobian_z[2] = sin(at), jacobian_z[3] = x;
  jacobian_z[4] = jacobian_z[5] = 0;
  return 1;
}

static void a_custom_sensor_equals_the_built_in_one(void** state) {
  const cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT);
  cairn_filter* filters[2] = {plane_filter(&options), plane_filter(&options)};
  cairn_range_bearing radar;
  own_sensor custom = {{0}, NULL, NULL, NULL};
  cairn_pose truth = options.initial_pose, pa, pb;
  generator random = {8};
  double ca[36], cb[36], error[6];
  int32_t sensors[2];
  int calls = 0;
  (void)state;
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar, NULL));
  assert_ok(cairn_custom_init(&custom.model, sizeof custom.model, NULL));
  custom.model.rows = 2, custom.predict = caller_predict, custom.place = caller_place, custom.user = &calls;
  custom.model.angle_mask = 2, custom.model.sigma[0] = radar.range_sigma, custom.model.sigma[1] = radar.bearing_sigma;
  custom.model.relative = 1;
  assert_ok(cairn_filter_add_range_bearing(filters[0], &radar, &sensors[0], NULL));
  assert_ok(add_own(filters[1], &custom, &sensors[1]));
  for (int step = 0; step < 40; ++step) {
    const cairn_pose moved = pose_at(0.6, 0, 0, 0, 0, 0.12);
    cairn_observation o[POINTS];
    cairn_match m[2][POINTS];
    double covariance[36];
    diagonal(covariance, 6, 1e-3);
    assert_ok(cairn_pose_compose(&truth, &moved, &truth, NULL));
    for (size_t l = 0; l < POINTS; ++l) {
      double range, bearing;
      plane_polar(&truth, plane_points[l], &range, &bearing);
      o[l] = sighting(l, range + random_normal(&random, 0.1), bearing + random_normal(&random, 0.01));
    }
    for (int k = 0; k < 2; ++k) {
      assert_ok(cairn_filter_predict_increment(filters[k], &moved, covariance, NULL));
      assert_ok(cairn_filter_update(filters[k], sensors[k], o, POINTS, m[k], NULL));
    }
    for (size_t l = 0; l < POINTS; ++l) assert_int_equal(m[0][l].result, m[1][l].result);
    assert_ok(cairn_filter_pose(filters[0], &pa, ca, NULL));
    assert_ok(cairn_filter_pose(filters[1], &pb, cb, NULL));
    assert_ok(cairn_pose_error(&pa, &pb, error, NULL));
    for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 1e-9);
    for (int i = 0; i < 36; ++i) assert_near(ca[i], cb[i], 1e-10);
  }
  assert_true(calls > 100);
  /* In the plane a sensor has 1 or 2 rows. With 1 row it cannot place landmarks. */
  int32_t number = -1;
  custom.model.rows = 3;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "custom.rows", add_own(filters[0], &custom, &number));
  custom.model.rows = 0;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "custom.rows", add_own(filters[0], &custom, &number));
  custom.model.rows = 1, custom.model.angle_mask = 0;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "place", add_own(filters[0], &custom, &number));
  custom.place = NULL;
  assert_ok(add_own(filters[0], &custom, &number));
  for (int k = 0; k < 2; ++k) cairn_filter_destroy(filters[k]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(range_and_bearing_place_landmarks),
      cmocka_unit_test(a_custom_sensor_equals_the_built_in_one),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
