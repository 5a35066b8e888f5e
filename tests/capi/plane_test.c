/* SPDX-License-Identifier: BSD-3-Clause */
/* A planar vehicle's filter. What it must equal is the spatial one, whose vehicle happens to have no noise out of the
 * plane; what it alone has is tried against the truth and by hand. */
#include "support.h"

#define POINTS 10

static const double field[POINTS][3] = {{4, 1, 0},  {8, -3, 0}, {12, 2, 0}, {14, 8, 0}, {9, 12, 0},
                                        {3, 13, 0}, {-4, 9, 0}, {-5, 3, 0}, {0, 6, 0},  {6, 6, 0}};

static cairn_filter_options plane_options(int32_t vehicle, int32_t error) {
  cairn_filter_options options;
  assert_ok(cairn_filter_options_init(&options, sizeof options));
  options.vehicle = vehicle, options.error = error;
  options.max_landmarks = options.max_observations = POINTS;
  options.gate_probability = options.batch_gate_probability = 1; /* bounds by rows, of which space has more */
  options.initial_pose = pose_at(0.3, -0.2, 0, 0, 0, 0.1);
  options.initial_covariance[0] = 0.02, options.initial_covariance[7] = 0.03, options.initial_covariance[35] = 1e-3;
  options.initial_covariance[1] = options.initial_covariance[6] = 5e-3;
  options.initial_covariance[5] = options.initial_covariance[30] = 1e-3;
  return options;
}

static cairn_filter* create(const cairn_filter_options* options) {
  cairn_filter* filter = NULL;
  assert_ok(cairn_filter_create(options, &filter));
  return filter;
}

static cairn_observation seen(uint64_t id, double first, double second) {
  cairn_observation o;
  memset(&o, 0, sizeof o);
  o.id = id, o.z[0] = first, o.z[1] = second;
  return o;
}

/* --- the same vehicle in the plane and in space --- */

static bool in_plane(int i) {
  return i == 0 || i == 1 || i == 5;
}

static void compare_filters(const cairn_filter* plane, const cairn_filter* space, double tolerance) {
  cairn_pose pa, pb;
  double ca[36], cb[36], error[6];
  size_t na = 0, nb = 0, needed = 0;
  cairn_landmark la[POINTS], lb[POINTS];
  uint64_t ids[POINTS];
  double ja[(6 + 3 * POINTS) * (6 + 3 * POINTS)], jb[(6 + 3 * POINTS) * (6 + 3 * POINTS)];
  assert_ok(cairn_filter_pose(plane, &pa, ca));
  assert_ok(cairn_filter_pose(space, &pb, cb));
  assert_ok(cairn_pose_error(&pa, &pb, error));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, tolerance);
  for (int i = 0; i < 36; ++i) {
    const bool counts = in_plane(i / 6) && in_plane(i % 6);
    if (counts)
      assert_near(ca[i], cb[i], tolerance);
    else
      assert_true(ca[i] == 0);
  }
  assert_true(pa.position[2] == 0 && pa.quaternion[1] == 0 && pa.quaternion[2] == 0);
  assert_ok(cairn_map_landmarks(cairn_filter_map(plane), la, POINTS, &na));
  assert_ok(cairn_map_landmarks(cairn_filter_map(space), lb, POINTS, &nb));
  assert_int_equal(na, nb);
  for (size_t i = 0; i < na; ++i) {
    ids[i] = la[i].id;
    assert_int_equal(la[i].id, lb[i].id);
    assert_int_equal(la[i].observations, lb[i].observations);
    assert_true(la[i].position[2] == 0);
    for (int k = 0; k < 2; ++k) assert_near(la[i].position[k], lb[i].position[k], tolerance);
    for (int k = 0; k < 9; ++k) {
      if (k / 3 < 2 && k % 3 < 2)
        assert_near(la[i].covariance[k], lb[i].covariance[k], tolerance);
      else
        assert_true(la[i].covariance[k] == 0);
    }
  }
  assert_ok(cairn_filter_joint_covariance(plane, ids, na, ja, LENGTH(ja), &needed));
  assert_ok(cairn_filter_joint_covariance(space, ids, na, jb, LENGTH(jb), &needed));
  const size_t side = 6 + 3 * na;
  assert_int_equal(needed, side * side);
  for (size_t i = 0; i < side * side; ++i) {
    const size_t r = i / side, c = i % side;
    const bool row = r < 6 ? in_plane((int)r) : (r - 6) % 3 < 2, column = c < 6 ? in_plane((int)c) : (c - 6) % 3 < 2;
    if (row && column)
      assert_near(ja[i], jb[i], tolerance);
    else
      assert_true(ja[i] == 0);
  }
}

static cairn_wheels level_wheels(void) {
  cairn_wheels wheels;
  assert_ok(cairn_wheels_init(&wheels, sizeof wheels));
  wheels.vertical_sigma = wheels.roll_rate_sigma = wheels.pitch_rate_sigma = 0;
  wheels.lateral_sigma = 0.02;
  return wheels;
}

static void it_is_the_spatial_filter_without_noise_out_of_the_plane(void** state) {
  (void)state;
  for (int32_t error = CAIRN_ERROR_INVARIANT; error <= CAIRN_ERROR_STANDARD; ++error) {
    const cairn_filter_options in_the_plane = plane_options(CAIRN_VEHICLE_PLANAR, error),
                               in_space = plane_options(CAIRN_VEHICLE_SPATIAL, error);
    cairn_filter* filters[2] = {create(&in_the_plane), create(&in_space)};
    cairn_cartesian points;
    const cairn_wheels wheels = level_wheels();
    cairn_twist_noise noise;
    generator random = {5};
    cairn_pose truth = in_the_plane.initial_pose;
    int32_t sensor = -1;
    assert_ok(cairn_cartesian_init(&points, sizeof points));
    points.T_body_sensor = pose_at(0.4, -0.1, 0, 0, 0, 0.7);
    points.sigma[0] = 0.05, points.sigma[1] = 0.08;
    assert_ok(cairn_twist_noise_init(&noise, sizeof noise));
    noise.velocity_sigma[2] = noise.rate_sigma[0] = noise.rate_sigma[1] = 0;
    for (int k = 0; k < 2; ++k) {
      assert_ok(cairn_filter_add_cartesian(filters[k], &points, &sensor));
      assert_ok(cairn_filter_set_wheels(filters[k], &wheels));
      assert_ok(cairn_filter_set_twist_noise(filters[k], &noise));
    }
    for (int step = 0; step < 60; ++step) {
      const double v[3] = {0.6, 0.05, 0}, w[3] = {0, 0, 0.12};
      cairn_pose moved = pose_at(0.6, 0.05, 0, 0, 0, 0.12), sensor_pose;
      double covariance[36], z[3];
      cairn_observation o[POINTS];
      cairn_match m[2][POINTS];
      size_t count = 0;
      assert_ok(cairn_pose_compose(&truth, &moved, &truth));
      assert_ok(cairn_pose_compose(&truth, &points.T_body_sensor, &sensor_pose));
      diagonal(covariance, 6, 0);
      covariance[0] = 1e-3, covariance[7] = 2e-3, covariance[35] = 1e-4;
      covariance[5] = covariance[30] = 1e-4;
      for (size_t l = 0; l < POINTS; ++l) {
        double body[3];
        to_body(&sensor_pose, field[l], body);
        if ((l + (size_t)step) % 3 == 0) continue;
        o[count] = seen(l + 1, body[0] + random_normal(&random, 0.05), body[1] + random_normal(&random, 0.08));
        ++count;
      }
      for (int k = 0; k < 2; ++k) {
        cairn_filter* f = filters[k];
        cairn_match match;
        if (step % 3 == 0) assert_ok(cairn_filter_predict_twist(f, 1.0, v, w));
        if (step % 3 == 1) assert_ok(cairn_filter_predict_increment(f, &moved, covariance));
        if (step % 3 == 2) assert_ok(cairn_filter_predict_wheels(f, 1.0, 1.8, 2.2));
        if (k == 0) compare_filters(f, f, 0); /* motion held back: asked of in between */
        assert_ok(cairn_filter_update(f, sensor, o, count, m[k]));
        double small[9] = {0.04, 0.01, 0, 0.01, 0.05, 0, 0, 0, 0.04};
        const double lever[3] = {0.3, -0.2, 0};
        to_map(&truth, lever, z);
        z[0] += 0.1 * ((step % 5) - 2), z[1] -= 0.05 * ((step % 7) - 3);
        if (step % 4 == 1) assert_ok(cairn_filter_update_position(f, z, small, step % 8 == 1 ? lever : NULL, &match));
        diagonal(small, 3, 2e-3);
        if (step % 4 == 2) assert_ok(cairn_filter_update_attitude(f, truth.quaternion, small, &match));
        if (step % 4 == 3) {
          double roll, pitch, yaw;
          assert_ok(cairn_quaternion_to_euler(truth.quaternion, &roll, &pitch, &yaw));
          assert_ok(cairn_filter_update_heading(f, yaw + 0.02, 0.05, &match));
        }
        if (step % 4 == 0 && step > 4) {
          const uint64_t ids[2] = {3, 8};
          const double r[2] = {0.05, -0.03}, noise2[4] = {0.02, 0.005, 0.005, 0.03};
          double jp[12] = {0}, jl[12] = {0};
          jp[0] = 1, jp[1] = 0.3, jp[5] = -2, jp[6] = 0.4, jp[7] = 1, jp[11] = 0.7;
          jl[0] = -1, jl[1] = 0.2, jl[3] = 0.5, jl[6] = 0.1, jl[7] = -0.6, jl[10] = 1;
          if (k == 0) jp[2] = jp[3] = jl[2] = jl[11] = 5; /* columns that the plane does not have */
          assert_ok(cairn_filter_update_linear(f, r, 2, noise2, jp, ids, 2, jl, &match));
          assert_int_equal(match.result, CAIRN_MATCHED);
        }
      }
      for (size_t i = 0; i < count; ++i) {
        assert_int_equal(m[0][i].result, m[1][i].result);
        assert_int_equal(m[0][i].landmark, m[1][i].landmark);
      }
      compare_filters(filters[0], filters[1], 1e-9);
      if (step == 30)
        for (int k = 0; k < 2; ++k) assert_ok(cairn_filter_remove_landmark(filters[k], 4));
    }
    for (int k = 0; k < 2; ++k) {
      double pivot = 0;
      assert_ok(cairn_filter_audit(filters[k], &pivot));
      assert_true(pivot > 0);
      cairn_filter_destroy(filters[k]);
    }
  }
}

/* --- sensors --- */

static void polar(const cairn_pose* sensor, const double point[3], double* range, double* bearing) {
  double body[3];
  to_body(sensor, point, body);
  *range = hypot(body[0], body[1]), *bearing = atan2(body[1], body[0]);
}

/* From a place known exactly, without noise in what is seen: landmarks where they are, with the noise that is stated.
 */
static void range_and_bearing_place_landmarks(void** state) {
  cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT);
  cairn_range_bearing radar;
  cairn_pose sensor_pose;
  cairn_observation o[POINTS];
  cairn_match m[POINTS];
  int32_t sensor;
  (void)state;
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  cairn_filter* f = create(&options);
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar));
  radar.T_body_sensor = pose_at(0.4, -0.3, 0, 0, 0, -2.0);
  radar.range_sigma = 0.2, radar.bearing_sigma = 0.03;
  assert_ok(cairn_filter_add_range_bearing(f, &radar, &sensor));
  assert_ok(cairn_pose_compose(&options.initial_pose, &radar.T_body_sensor, &sensor_pose));
  for (size_t l = 0; l < POINTS; ++l) {
    double range, bearing;
    polar(&sensor_pose, field[l], &range, &bearing);
    o[l] = seen(l, range, bearing + (l % 2 == 0 ? 0 : 2 * PI)); /* any turn of it */
    o[l].z[2] = NAN;                                            /* which nobody looks at */
    if (l == 3) o[l].covariance[0] = 0.5, o[l].covariance[1] = o[l].covariance[2] = 1e-3, o[l].covariance[3] = 1e-2;
  }
  assert_ok(cairn_filter_update(f, sensor, o, POINTS, m));
  for (size_t l = 0; l < POINTS; ++l) {
    cairn_landmark landmark;
    double range, bearing;
    assert_int_equal(m[l].result, CAIRN_NEW);
    assert_ok(cairn_map_landmark(cairn_filter_map(f), l, &landmark));
    for (int k = 0; k < 3; ++k) assert_near(landmark.position[k], field[l][k], 1e-12);
    polar(&sensor_pose, field[l], &range, &bearing);
    const double at = bearing + 0.1 - 2.0, c = cos(at), s = sin(at); /* in the map */
    const double rr = l == 3 ? 0.5 : 0.04, rb = l == 3 ? 1e-3 : 0, bb = l == 3 ? 1e-2 : 9e-4;
    const double J[2][2] = {{c, -range * s}, {s, range * c}};
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k)
        assert_near(landmark.covariance[3 * i + k],
                    J[i][0] * J[k][0] * rr + (J[i][0] * J[k][1] + J[i][1] * J[k][0]) * rb + J[i][1] * J[k][1] * bb,
                    1e-12 + 1e-12 * range * range);
  }
  assert_ok(cairn_filter_update(f, sensor, o, POINTS, m));
  for (size_t l = 0; l < POINTS; ++l) {
    assert_int_equal(m[l].result, CAIRN_MATCHED);
    assert_near(m[l].distance, 0, 1e-18);
  }
  /* Nearer than near_range there is nothing to see. */
  o[0] = seen(77, 0.001, 0);
  assert_ok(cairn_filter_update(f, sensor, o, 1, m));
  assert_int_equal(m[0].reason, CAIRN_REASON_NO_PLACE);
  cairn_filter_destroy(f);
}

/* Range and bearing by the caller: the same as by the library, but for the last digits. */
static int32_t caller_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                              double* jacobian_pose, double* jacobian_landmark) {
  const double dx = landmark[0] - pose->position[0], dy = landmark[1] - pose->position[1];
  const double yaw = 2 * atan2(pose->quaternion[3], pose->quaternion[0]), r2 = dx * dx + dy * dy, r = sqrt(r2);
  if (user != NULL) ++*(int*)user;
  if (landmark[2] != 0 || pose->position[2] != 0 || !(r > 0.01)) return 1;
  z[0] = r, z[1] = atan2(dy, dx) - yaw;
  const double l[6] = {dx / r, dy / r, 0, -dy / r2, dx / r2, 0};
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 3; ++k) {
      jacobian_landmark[3 * i + k] = l[3 * i + k];
      jacobian_pose[6 * i + k] = -l[3 * i + k];
      jacobian_pose[6 * i + 3 + k] = i == 1 && k == 2 ? -1 : 0;
    }
    jacobian_landmark[3 * i + 2] = 9; /* out of the plane: does not count */
    jacobian_pose[6 * i + 3] = 9;
  }
  return 0;
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
  return 0;
}

static void a_sensor_of_the_callers_own(void** state) {
  const cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT);
  cairn_filter* filters[2] = {create(&options), create(&options)};
  cairn_range_bearing radar;
  cairn_custom custom;
  cairn_pose truth = options.initial_pose, pa, pb;
  generator random = {8};
  double ca[36], cb[36], error[6];
  int32_t sensors[2];
  int calls = 0;
  (void)state;
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar));
  assert_ok(cairn_custom_init(&custom, sizeof custom));
  custom.rows = 2, custom.predict = caller_predict, custom.place = caller_place, custom.user = &calls;
  custom.angle_mask = 2, custom.sigma[0] = radar.range_sigma, custom.sigma[1] = radar.bearing_sigma;
  custom.relative = 1;
  assert_ok(cairn_filter_add_range_bearing(filters[0], &radar, &sensors[0]));
  assert_ok(cairn_filter_add_custom(filters[1], &custom, &sensors[1]));
  for (int step = 0; step < 40; ++step) {
    const cairn_pose moved = pose_at(0.6, 0, 0, 0, 0, 0.12);
    cairn_observation o[POINTS];
    cairn_match m[2][POINTS];
    double covariance[36];
    diagonal(covariance, 6, 1e-3);
    assert_ok(cairn_pose_compose(&truth, &moved, &truth));
    for (size_t l = 0; l < POINTS; ++l) {
      double range, bearing;
      polar(&truth, field[l], &range, &bearing);
      o[l] = seen(l, range + random_normal(&random, 0.1), bearing + random_normal(&random, 0.01));
    }
    for (int k = 0; k < 2; ++k) {
      assert_ok(cairn_filter_predict_increment(filters[k], &moved, covariance));
      assert_ok(cairn_filter_update(filters[k], sensors[k], o, POINTS, m[k]));
    }
    for (size_t l = 0; l < POINTS; ++l) assert_int_equal(m[0][l].result, m[1][l].result);
    assert_ok(cairn_filter_pose(filters[0], &pa, ca));
    assert_ok(cairn_filter_pose(filters[1], &pb, cb));
    assert_ok(cairn_pose_error(&pa, &pb, error));
    for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 1e-9);
    for (int i = 0; i < 36; ++i) assert_near(ca[i], cb[i], 1e-10);
  }
  assert_true(calls > 100);
  /* Rows of which the plane has room: 1 or 2; with one nothing can be placed. */
  int32_t number = -1;
  custom.rows = 3;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "custom.rows", cairn_filter_add_custom(filters[0], &custom, &number));
  custom.rows = 0;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "custom.rows", cairn_filter_add_custom(filters[0], &custom, &number));
  custom.rows = 1, custom.angle_mask = 0;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "custom.place", cairn_filter_add_custom(filters[0], &custom, &number));
  custom.place = NULL;
  assert_ok(cairn_filter_add_custom(filters[0], &custom, &number));
  for (int k = 0; k < 2; ++k) cairn_filter_destroy(filters[k]);
}

/* --- what does not fit --- */

static void sensors_of_the_other_kind(void** state) {
  const cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT),
                             spatial = plane_options(CAIRN_VEHICLE_SPATIAL, CAIRN_ERROR_INVARIANT);
  cairn_filter *plane = create(&options), *space = create(&spatial);
  const cairn_stereo_head head = test_head();
  const cairn_stereo_camera camera = test_camera();
  cairn_range_bearing radar;
  cairn_cartesian points;
  int32_t sensor = -77;
  (void)state;
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar));
  assert_ok(cairn_cartesian_init(&points, sizeof points));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_add_stereo_head(plane, &head, &sensor));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_add_stereo_camera(plane, &camera, &sensor));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_add_range_bearing(space, &radar, &sensor));
  const cairn_pose tilted[] = {pose_at(0, 0, 0.1, 0, 0, 0), pose_at(0, 0, 0, 0.1, 0, 0), pose_at(0, 0, 0, 0, -0.1, 1),
                               pose_at(0, 0, 0, PI, 0, 0)};
  for (size_t i = 0; i < LENGTH(tilted); ++i) {
    radar.T_body_sensor = points.T_body_sensor = tilted[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_body_sensor", cairn_filter_add_range_bearing(plane, &radar, &sensor));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_body_sensor", cairn_filter_add_cartesian(plane, &points, &sensor));
  }
  assert_int_equal(sensor, -77);
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar));
  const double bad[] = {0, -1, NAN, INFINITY};
  for (size_t i = 0; i < LENGTH(bad); ++i) {
    cairn_range_bearing r = radar;
    r.range_sigma = bad[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "range_sigma", cairn_filter_add_range_bearing(plane, &r, &sensor));
    r = radar, r.bearing_sigma = bad[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "bearing_sigma", cairn_filter_add_range_bearing(plane, &r, &sensor));
    r = radar, r.near_range = bad[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "near_range", cairn_filter_add_range_bearing(plane, &r, &sensor));
  }
  points.T_body_sensor = radar.T_body_sensor;
  points.sigma[2] = -1; /* which the plane does not have */
  assert_ok(cairn_filter_add_cartesian(plane, &points, &sensor));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "sigma", cairn_filter_add_cartesian(space, &points, &sensor));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "", cairn_filter_point_head(plane, 0, 0, 0));
  cairn_filter_destroy(plane);
  cairn_filter_destroy(space);
}

static void poses_out_of_the_plane(void** state) {
  cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT);
  const cairn_pose outside[] = {pose_at(1, 0, 1e-6, 0, 0, 0), pose_at(1, 0, 0, 1e-6, 0, 0),
                                pose_at(1, 0, 0, 0, 1e-6, 1), pose_at(1, 0, 0, PI, 0, 0),
                                pose_at(1, 0, 0, 0, PI / 2, 0)};
  const cairn_pose inside = pose_at(1, 0, 1e-10, 1e-10, 0, 3);
  cairn_filter *f = create(&options), *other = NULL;
  snapshot before = {0, NULL}, after = {0, NULL};
  double c[36], v[3] = {1, 0, 5}, w[3] = {3, -4, 0.1};
  size_t bytes = 0;
  (void)state;
  diagonal(c, 6, 1e-4);
  snapshot_take(&before, f);
  for (size_t i = 0; i < LENGTH(outside); ++i) {
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_filter_predict_increment(f, &outside[i], c));
    options.initial_pose = outside[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "initial_pose", cairn_filter_create(&options, &other));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "initial_pose", cairn_filter_required_bytes(&options, &bytes));
  }
  snapshot_take(&after, f);
  assert_true(snapshot_same(&before, &after));
  assert_ok(cairn_filter_predict_increment(f, &inside, c)); /* what conversions leave */
  cairn_pose pose;
  assert_ok(cairn_filter_pose(f, &pose, c));
  assert_true(pose.position[2] == 0 && pose.quaternion[1] == 0 && pose.quaternion[2] == 0);
  /* Of a twist x, y and yaw count. */
  const double v_flat[3] = {1, 0, 0}, w_flat[3] = {0, 0, 0.1};
  options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT);
  cairn_filter *a = create(&options), *b = create(&options);
  assert_ok(cairn_filter_predict_twist(a, 0.5, v, w));
  assert_ok(cairn_filter_predict_twist(b, 0.5, v_flat, w_flat));
  compare_filters(a, b, 0);
  const int32_t vehicles[] = {-1, 2, INT32_MAX};
  for (size_t i = 0; i < LENGTH(vehicles); ++i) {
    options.vehicle = vehicles[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options.vehicle", cairn_filter_create(&options, &other));
  }
  assert_null(other);
  snapshot_free(&before), snapshot_free(&after);
  cairn_filter_destroy(f), cairn_filter_destroy(a), cairn_filter_destroy(b);
}

/* An attitude whose x axis stands upright has no heading: it is refused, one way or the other, and teaches nothing. */
static void an_attitude_without_a_heading(void** state) {
  const cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT);
  cairn_filter* f = create(&options);
  const cairn_pose upright = pose_at(0, 0, 0, 0.3, PI / 2, 0);
  cairn_pose before, after;
  double noise[9], ca[36], cb[36];
  cairn_match m;
  (void)state;
  diagonal(noise, 3, 1e-2);
  assert_ok(cairn_filter_pose(f, &before, ca));
  const cairn_status status = cairn_filter_update_attitude(f, upright.quaternion, noise, &m);
  assert_true(status == CAIRN_ERROR_ARGUMENT || (status == CAIRN_OK && m.result == CAIRN_REJECTED));
  assert_ok(cairn_filter_pose(f, &after, cb));
  assert_memory_equal(&before, &after, sizeof before);
  assert_memory_equal(ca, cb, sizeof ca);
  cairn_filter_destroy(f);
}

/* --- motion by hand --- */

static void wheels_drive_an_arc(void** state) {
  const cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT);
  cairn_filter* f = create(&options);
  cairn_wheels wheels;
  cairn_pose pose;
  double error[6];
  (void)state;
  assert_ok(cairn_wheels_init(&wheels, sizeof wheels));
  wheels.radius = 0.25, wheels.track = 0.8;
  assert_ok(cairn_filter_set_wheels(f, &wheels));
  assert_ok(cairn_filter_predict_wheels(f, 2.0, 3.0, 4.0));
  const double v = 0.25 * 3.5, rate = 0.25 / 0.8 * 1.0, turn = 2 * rate, r = v / rate, yaw = 0.1;
  const cairn_pose expected =
      pose_at(0.3 + r * (sin(yaw + turn) - sin(yaw)), -0.2 - r * (cos(yaw + turn) - cos(yaw)), 0, 0, 0, yaw + turn);
  assert_ok(cairn_filter_pose(f, &pose, NULL));
  assert_ok(cairn_pose_error(&pose, &expected, error));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 1e-12);
  cairn_filter_destroy(f);
}

/* Nothing turns and all is linear: two filters of one dimension each, by hand. */
static void the_linear_case_is_kalmans(void** state) {
  cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT);
  double P[2] = {0.5, 0.8}, x[2] = {3, -2}, c[36], noise[9];
  generator random = {12};
  (void)state;
  options.initial_pose = pose_at(x[0], x[1], 0, 0, 0, 0);
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  options.initial_covariance[0] = P[0], options.initial_covariance[7] = P[1];
  cairn_filter* f = create(&options);
  for (int step = 0; step < 50; ++step) {
    const double d[2] = {random_normal(&random, 1), random_normal(&random, 1)};
    const double q[2] = {0.1, 0.02 * (1 + step % 3)}, r[2] = {0.3, 0.5};
    const cairn_pose moved = pose_at(d[0], d[1], 0, 0, 0, 0);
    const double z[3] = {x[0] + d[0] + random_normal(&random, 0.5), x[1] + d[1] + random_normal(&random, 0.5), 99};
    cairn_pose pose;
    diagonal(c, 6, 0);
    c[0] = q[0], c[7] = q[1];
    c[14] = 7, c[21] = 8; /* of z and roll: do not count */
    assert_ok(cairn_filter_predict_increment(f, &moved, c));
    diagonal(noise, 3, 0);
    noise[0] = r[0], noise[4] = r[1], noise[8] = 1;
    assert_ok(cairn_filter_update_position(f, z, noise, NULL, NULL));
    for (int i = 0; i < 2; ++i) {
      const double before = P[i] + q[i], gain = before / (before + r[i]);
      x[i] += d[i];
      x[i] += gain * (z[i] - x[i]);
      P[i] = (1 - gain) * before;
    }
    assert_ok(cairn_filter_pose(f, &pose, c));
    for (int i = 0; i < 2; ++i) {
      assert_near(pose.position[i], x[i], 1e-12);
      assert_near(c[7 * i], P[i], 1e-14);
    }
    assert_true(c[1] == 0 && c[35] == 0);
  }
  cairn_filter_destroy(f);
}

/* --- consistency --- */

static cairn_range_bearing fine_radar(void) {
  cairn_range_bearing radar;
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar));
  radar.range_sigma = 0.1, radar.bearing_sigma = 0.01;
  return radar;
}

/* 50 runs: the sum of NEES is chi-square with 150 degrees of freedom where the filter says the truth. 99.9 % of it lies
 * within 150 [0.66, 1.43]. Each look by itself; and all of them together must not lean to either side. */
static void its_covariance_is_honest(void** state) {
  enum { RUNS = 50, LOOKS = 6, STEPS = 10 };
  double sums[LOOKS] = {0}, all = 0;
  (void)state;
  for (int run = 0; run < RUNS; ++run) {
    cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT);
    const cairn_range_bearing radar = fine_radar();
    generator random = {UINT64_C(900) + (uint64_t)run};
    cairn_pose truth;
    int32_t sensor;
    memset(options.initial_covariance, 0, sizeof options.initial_covariance);
    options.initial_covariance[0] = options.initial_covariance[7] = 0.04, options.initial_covariance[35] = 4e-4;
    options.initial_pose = pose_at(0, 0, 0, 0, 0, 0);
    truth = pose_at(random_normal(&random, 0.2), random_normal(&random, 0.2), 0, 0, 0, random_normal(&random, 0.02));
    cairn_filter* f = create(&options);
    assert_ok(cairn_filter_add_range_bearing(f, &radar, &sensor));
    for (int step = 1; step <= LOOKS * STEPS; ++step) {
      const double d[3] = {0.5, 0, 0.1}, sigma[3] = {0.05, 0.02, 0.01};
      const cairn_pose told = pose_at(d[0], d[1], 0, 0, 0, d[2]);
      const cairn_pose moved = pose_at(d[0] + random_normal(&random, sigma[0]), d[1] + random_normal(&random, sigma[1]),
                                       0, 0, 0, d[2] + random_normal(&random, sigma[2]));
      cairn_observation o[POINTS];
      double c[36], nees = 0;
      size_t count = 0;
      assert_ok(cairn_pose_compose(&truth, &moved, &truth));
      diagonal(c, 6, 0);
      c[0] = sigma[0] * sigma[0], c[7] = sigma[1] * sigma[1], c[35] = sigma[2] * sigma[2];
      assert_ok(cairn_filter_predict_increment(f, &told, c));
      for (size_t l = 0; l < POINTS; ++l) {
        double range, bearing;
        polar(&truth, field[l], &range, &bearing);
        if (range > 9 || range < 1) continue;
        o[count++] = seen(l, range + random_normal(&random, 0.1), bearing + random_normal(&random, 0.01));
      }
      assert_ok(cairn_filter_update(f, sensor, o, count, NULL));
      if (step % STEPS != 0) continue;
      assert_ok(cairn_filter_pose_nees(f, &truth, &nees));
      sums[step / STEPS - 1] += nees;
      all += nees;
    }
    cairn_filter_destroy(f);
  }
  for (int look = 0; look < LOOKS; ++look) {
    assert_true(sums[look] / (3 * RUNS) > 0.66);
    assert_true(sums[look] / (3 * RUNS) < 1.43);
  }
  assert_true(all / (3 * RUNS * LOOKS) > 0.8 && all / (3 * RUNS * LOOKS) < 1.25);
}

/* --- observations without names --- */

static void names_are_not_asked_for(void** state) {
  static const int32_t ways[] = {CAIRN_ASSOCIATION_NEAREST, CAIRN_ASSOCIATION_JOINT};
  (void)state;
  for (size_t k = 0; k < LENGTH(ways); ++k) {
    cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT);
    const cairn_range_bearing radar = fine_radar();
    generator random = {31};
    cairn_pose truth, pa, pb;
    double ca[36], cb[36];
    uint64_t name_of[POINTS] = {0};
    size_t matched = 0;
    int32_t sensor;
    options.gate_probability = 0.999, options.batch_gate_probability = 0.9999;
    options.initial_covariance[1] = options.initial_covariance[6] = 0;
    options.initial_covariance[5] = options.initial_covariance[30] = 0;
    options.initial_covariance[0] = options.initial_covariance[7] = 1e-4, options.initial_covariance[35] = 1e-6;
    truth = options.initial_pose;
    cairn_filter* known = create(&options);
    options.association = ways[k];
    cairn_filter* unknown = create(&options);
    assert_ok(cairn_filter_add_range_bearing(known, &radar, &sensor));
    assert_ok(cairn_filter_add_range_bearing(unknown, &radar, &sensor));
    for (int step = 0; step < 60; ++step) {
      const cairn_pose moved = pose_at(0.5, 0, 0, 0, 0, 0.1);
      cairn_observation o[POINTS];
      cairn_match told[POINTS], found[POINTS];
      double c[36];
      size_t count = 0;
      assert_ok(cairn_pose_compose(&truth, &moved, &truth));
      diagonal(c, 6, 1e-4);
      c[35] = 1e-5;
      for (size_t l = 0; l < POINTS; ++l) {
        double range, bearing;
        polar(&truth, field[l], &range, &bearing);
        if (range > 9 || range < 1) continue;
        o[count++] = seen(l + 1, range + random_normal(&random, 0.03), bearing + random_normal(&random, 0.003));
      }
      assert_ok(cairn_filter_predict_increment(known, &moved, c));
      assert_ok(cairn_filter_predict_increment(unknown, &moved, c));
      assert_ok(cairn_filter_update(known, sensor, o, count, told));
      for (size_t i = 0; i < count; ++i) o[i].id = step % 2 == 0 ? CAIRN_ID_NONE : 5;
      assert_ok(cairn_filter_update(unknown, sensor, o, count, found));
      for (size_t i = 0; i < count; ++i) {
        assert_int_equal(found[i].result, told[i].result);
        if (found[i].result == CAIRN_NEW) name_of[found[i].landmark] = told[i].landmark;
        if (found[i].result != CAIRN_MATCHED) continue;
        assert_int_equal(name_of[found[i].landmark], told[i].landmark);
        ++matched;
      }
    }
    assert_true(matched > 150);
    assert_ok(cairn_filter_pose(known, &pa, ca));
    assert_ok(cairn_filter_pose(unknown, &pb, cb));
    assert_memory_equal(&pa, &pb, sizeof pa); /* the very same updates */
    assert_memory_equal(ca, cb, sizeof ca);
    cairn_filter_destroy(known);
    cairn_filter_destroy(unknown);
  }
}

/* Stands at the origin, knows it, and has seen `count` points; then it is pushed along x, by `sigma`. */
static cairn_filter* open_pushed(int32_t way, uint32_t nodes, const cairn_observation* points, size_t count,
                                 double sigma) {
  cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_ERROR_INVARIANT);
  const cairn_pose stay = pose_at(0, 0, 0, 0, 0, 0);
  cairn_cartesian cartesian;
  double covariance[36];
  int32_t sensor;
  options.association = way, options.association_nodes = nodes;
  options.gate_probability = 0.99, options.batch_gate_probability = 0.9999;
  options.initial_pose = stay;
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  cairn_filter* f = create(&options);
  assert_ok(cairn_cartesian_init(&cartesian, sizeof cartesian));
  assert_ok(cairn_filter_add_cartesian(f, &cartesian, &sensor));
  assert_ok(cairn_filter_update(f, sensor, points, count, NULL));
  diagonal(covariance, 6, 1e-8);
  covariance[0] = sigma * sigma;
  assert_ok(cairn_filter_predict_increment(f, &stay, covariance));
  return f;
}

static void what_cannot_be_true_together_is_paired_once(void** state) {
  const cairn_observation points[] = {seen(0, 0, -50), seen(0, 100, 50)};
  const cairn_observation looked[] = {seen(0, 2.5, -50), seen(0, 97.5, 50)};
  cairn_match m[2];
  (void)state;
  cairn_filter* f = open_pushed(CAIRN_ASSOCIATION_JOINT, 2000, points, 2, 1.0);
  assert_ok(cairn_filter_update(f, 0, looked, 2, m));
  const int paired = m[0].result == CAIRN_MATCHED ? 0 : 1;
  assert_int_equal(m[paired].result, CAIRN_MATCHED);
  assert_int_equal(m[paired].landmark, paired);
  assert_int_equal(m[1 - paired].result, CAIRN_REJECTED);
  assert_int_equal(m[1 - paired].reason, CAIRN_REASON_AMBIGUOUS);
  assert_int_equal(m[1 - paired].landmark, 1 - paired);
  assert_true(m[1 - paired].distance < m[1 - paired].threshold);
  assert_near(m[1 - paired].threshold, 9.21034037197618, 1e-9); /* two degrees of freedom */
  assert_true(last_update(f).association_nodes >= 2 && last_update(f).association_exhausted == 0);
  cairn_filter_destroy(f);
  f = open_pushed(CAIRN_ASSOCIATION_NEAREST, 2000, points, 2, 1.0);
  assert_ok(cairn_filter_update(f, 0, looked, 2, m));
  assert_true((m[0].reason == CAIRN_REASON_BATCH_GATE) != (m[1].reason == CAIRN_REASON_BATCH_GATE));
  assert_int_equal(last_update(f).association_nodes, 0);
  cairn_filter_destroy(f);
}

static void new_landmarks_keep_their_distance(void** state) {
  /* one axis at noise 0.1, twice: squared distance d^2 / 0.02; bounds of 0.99 and 0.9999 at 9.21 and 18.42 */
  const struct {
    double offset;
    int32_t result, reason;
  } looks[] = {{0.42, CAIRN_MATCHED, CAIRN_REASON_NONE},
               {0.44, CAIRN_REJECTED, CAIRN_REASON_GATE},
               {0.60, CAIRN_REJECTED, CAIRN_REASON_GATE},
               {0.62, CAIRN_NEW, CAIRN_REASON_NONE}};
  (void)state;
  for (size_t k = 0; k < LENGTH(looks); ++k) {
    const cairn_observation point = seen(0, 10, 0), looked = seen(0, 10, looks[k].offset);
    cairn_match m;
    cairn_filter* f = open_pushed(CAIRN_ASSOCIATION_JOINT, 2000, &point, 1, 1e-4);
    assert_ok(cairn_filter_update(f, 0, &looked, 1, &m));
    assert_int_equal(m.result, looks[k].result);
    assert_int_equal(m.reason, looks[k].reason);
    assert_int_equal(m.landmark, m.result == CAIRN_NEW ? 1 : 0);
    cairn_filter_destroy(f);
  }
}

static void one_that_could_be_another_waits_for_more(void** state) {
  const cairn_observation points[] = {seen(0, 10, 0), seen(0, 12, 0.3), seen(0, 13, -0.3)};
  (void)state;
  for (size_t count = 1; count <= 3; ++count) {
    cairn_observation looked[3];
    cairn_match m[3];
    cairn_filter* f = open_pushed(CAIRN_ASSOCIATION_JOINT, 2000, points, 3, 1.0);
    for (size_t i = 0; i < count; ++i) looked[i] = points[i], looked[i].z[0] += 0.8;
    assert_ok(cairn_filter_update(f, 0, looked, count, m));
    for (size_t i = 0; i < count; ++i) {
      assert_int_equal(m[i].result, count == 3 ? CAIRN_MATCHED : CAIRN_REJECTED);
      assert_int_equal(m[i].reason, count == 3 ? CAIRN_REASON_NONE : CAIRN_REASON_AMBIGUOUS);
      if (count == 3) assert_int_equal(m[i].landmark, i);
    }
    cairn_filter_destroy(f);
  }
}

static void a_bound_of_tests_is_kept_and_told(void** state) {
  cairn_observation points[POINTS];
  cairn_match m[POINTS];
  (void)state;
  for (int i = 0; i < POINTS; ++i) points[i] = seen(0, 10 + 0.9 * (i % 4), 0.9 * (i / 4));
  cairn_filter* f = open_pushed(CAIRN_ASSOCIATION_JOINT, 1, points, POINTS, 2.0);
  for (int i = 0; i < POINTS; ++i) points[i].z[0] += i % 3 == 0 ? 1.3 : i % 3 == 1 ? 0.4 : -0.7; /* no push */
  assert_ok(cairn_filter_update(f, 0, points, POINTS, m));
  const cairn_update_report report = last_update(f);
  assert_int_equal(report.association_exhausted, 1);
  assert_true(report.association_nodes >= 1 && report.association_nodes <= 8 * POINTS);
  assert_int_equal(report.matched + report.placed + report.rejected, POINTS);
  cairn_filter_destroy(f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_is_the_spatial_filter_without_noise_out_of_the_plane),
      cmocka_unit_test(range_and_bearing_place_landmarks),
      cmocka_unit_test(a_sensor_of_the_callers_own),
      cmocka_unit_test(sensors_of_the_other_kind),
      cmocka_unit_test(poses_out_of_the_plane),
      cmocka_unit_test(an_attitude_without_a_heading),
      cmocka_unit_test(wheels_drive_an_arc),
      cmocka_unit_test(the_linear_case_is_kalmans),
      cmocka_unit_test(its_covariance_is_honest),
      cmocka_unit_test(names_are_not_asked_for),
      cmocka_unit_test(what_cannot_be_true_together_is_paired_once),
      cmocka_unit_test(new_landmarks_keep_their_distance),
      cmocka_unit_test(one_that_could_be_another_waits_for_more),
      cmocka_unit_test(a_bound_of_tests_is_kept_and_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
