/* SPDX-License-Identifier: BSD-3-Clause */
/* Sensors: defaults, the position and covariance of the landmarks that they place, and custom sensors. */
#include "support.h"

static void head_defaults(void** state) {
  cairn_stereo_head h;
  (void)state;
  memset(&h, 0x5a, sizeof h);
  assert_ok(cairn_stereo_head_init(&h, sizeof h, NULL));
  assert_int_equal(h.struct_size, sizeof h);
  assert_int_equal(h.encoder_mode, CAIRN_ENCODER_PER_OBSERVATION);
  for (int i = 0; i < 3; ++i) assert_true(h.platform[i] == 0 && h.stick[i] == 0);
  for (int i = 0; i < 4; ++i) assert_true(h.camera_quaternion[i] == (i == 0));
  assert_near(h.range_sigma, 1, 0);
  assert_near(h.azimuth_sigma, 3 * DEGREE, 1e-15);
  assert_near(h.elevation_sigma, 3 * DEGREE, 1e-15);
  assert_true(h.pan_sigma == 0 && h.stick_sigma == 0);
  assert_near(h.near_range, 0.1, 0);
  assert_near(h.max_elevation, 85 * DEGREE, 1e-15);
}

static void camera_defaults(void** state) {
  cairn_stereo_camera c;
  const double forward[3] = {0, 0, 1}, right[3] = {1, 0, 0};
  double p[3];
  (void)state;
  memset(&c, 0x5a, sizeof c);
  assert_ok(cairn_stereo_camera_init(&c, sizeof c, NULL));
  assert_int_equal(c.struct_size, sizeof c);
  assert_int_equal(c.reserved, 0);
  assert_true(c.fu == 500 && c.fv == 500 && c.cu == 320 && c.cv == 240 && c.baseline == 0.2);
  assert_true(c.sigma[0] == 1 && c.sigma[1] == 1 && c.sigma[2] == 1);
  assert_true(c.near_depth == 0.1 && c.min_disparity == 1 && c.min_disparity_sigmas == 2.5);
  to_map(&c.T_body_camera, forward, p); /* the optical axis is x of the body, right in the image is -y */
  assert_near(p[0], 1, 1e-15);
  to_map(&c.T_body_camera, right, p);
  assert_near(p[1], -1, 1e-15);
}

static void cartesian_and_custom_defaults(void** state) {
  cairn_cartesian c;
  cairn_custom u;
  (void)state;
  memset(&c, 0x5a, sizeof c);
  memset(&u, 0x5a, sizeof u);
  assert_ok(cairn_cartesian_init(&c, sizeof c, NULL));
  assert_ok(cairn_custom_init(&u, sizeof u, NULL));
  assert_int_equal(c.struct_size, sizeof c);
  assert_int_equal(u.struct_size, sizeof u);
  assert_true(c.reserved == 0 && u.relative == 0 && u.angle_mask == 0 && u.rows == 3);
  for (int i = 0; i < 3; ++i) {
    assert_true(c.T_body_sensor.position[i] == 0 && c.T_body_sensor.quaternion[i + 1] == 0);
    assert_true(c.sigma[i] == 0.1 && u.sigma[i] == 1);
  }
  assert_true(c.T_body_sensor.quaternion[0] == 1);
}

/* A rig whose pose is known, and the world at the same pose. */
static void open_known(rig* r, world* w) {
  cairn_filter_options options = test_options();
  world_init(w, 77);
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  options.initial_pose = w->truth = pose_at(1, -2, 0.5, 0.2, -0.1, 0.7);
  rig_open(r, &options);
}

static void sensors_are_numbered_from_zero(void** state) {
  rig r;
  world w;
  (void)state;
  open_known(&r, &w);
  for (int i = 0; i < SENSORS; ++i) assert_int_equal(r.sensors[i], i);
  rig_close(&r);
}

static const double points[2][3] = {{9, 3, 1.5}, {6, 6.5, -1.2}}; /* in front of every sensor of the known rig */

static void see(const world* w, int sensor, const double mount[2], const double point[3], double z[3]) {
  assert_true(world_see(w, sensor, mount[0], mount[1], point, z));
}

static void every_sensor_places_where_it_looks(void** state) {
  static const int sensors[] = {HEAD, CAMERA, CARTESIAN, POINT};
  const double mount[2] = {0.25, -0.15};
  (void)state;
  for (size_t s = 0; s < LENGTH(sensors); ++s)
    for (size_t n = 0; n < LENGTH(points); ++n) {
      rig r;
      world w;
      cairn_observation o;
      cairn_match match;
      cairn_landmark landmark;
      memset(&o, 0, sizeof o);
      open_known(&r, &w);
      o.id = 42;
      see(&w, sensors[s], mount, points[n], o.z);
      assert_ok(cairn_filter_point_head(r.filter, r.sensors[HEAD], mount[0], mount[1], NULL));
      assert_ok(cairn_filter_update(r.filter, r.sensors[sensors[s]], &o, 1, &match, NULL));
      assert_int_equal(match.result, CAIRN_RESULT_NEW);
      assert_int_equal(match.reason, CAIRN_REASON_NONE);
      assert_int_equal(match.landmark, 42);
      assert_ok(cairn_map_landmark(cairn_filter_map(r.filter), 42, &landmark, NULL));
      for (int i = 0; i < 3; ++i) assert_near(landmark.position[i], points[n][i], 1e-9);
      assert_int_equal(landmark.observations, 1);
      rig_close(&r);
    }
}

/* dz/dlandmark and dz/d(pan, stick) by central differences of the model in the tests. */
static void differences(const world* w, int sensor, const double mount[2], const double point[3], double H[9],
                        double M[6]) {
  for (int j = 0; j < 5; ++j) {
    const double h = 1e-5;
    double p[3], a[2], above[3], below[3];
    memcpy(p, point, sizeof p), memcpy(a, mount, sizeof a);
    *(j < 3 ? &p[j] : &a[j - 3]) += h;
    see(w, sensor, a, p, above);
    *(j < 3 ? &p[j] : &a[j - 3]) -= 2 * h;
    see(w, sensor, a, p, below);
    for (int i = 0; i < 3; ++i) *(j < 3 ? &H[3 * i + j] : &M[2 * i + j - 3]) = (above[i] - below[i]) / (2 * h);
  }
}

/* For a placed landmark, H C H^T is the noise of the observation, including the encoders. The covariance between two
 * landmarks of one frame comes from the encoders only. */
static void expect_placed(int sensor, cairn_stereo_head head, bool shared) {
  const double mount[2] = {0.25, -0.15};
  double sigma[3] = {head.range_sigma, head.azimuth_sigma, head.elevation_sigma};
  const uint64_t ids[2] = {0, 7};
  double H[2][9], M[2][6], joint[36];
  cairn_filter_options options = test_options();
  cairn_filter* filter = NULL;
  cairn_observation o[2];
  size_t needed;
  int32_t added;
  world w;
  world_init(&w, 77);
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  options.initial_pose = w.truth = pose_at(1, -2, 0.5, 0.2, -0.1, 0.7);
  assert_ok(cairn_filter_create(&options, &filter, NULL));
  if (sensor == HEAD) {
    assert_ok(cairn_filter_add_stereo_head(filter, &head, &added, NULL));
    assert_ok(cairn_filter_point_head(filter, added, mount[0], mount[1], NULL));
  } else {
    cairn_stereo_camera camera = test_camera();
    memcpy(camera.sigma, sigma, sizeof sigma);
    assert_ok(cairn_filter_add_stereo_camera(filter, &camera, &added, NULL));
  }
  memset(o, 0, sizeof o);
  for (int k = 0; k < 2; ++k) {
    o[k].id = ids[k];
    see(&w, sensor, mount, points[k], o[k].z);
    differences(&w, sensor, mount, points[k], H[k], M[k]);
  }
  assert_ok(cairn_filter_update(filter, added, o, 2, NULL, NULL));
  assert_ok(cairn_map_joint_covariance(cairn_filter_map(filter), ids, 2, joint, 36, &needed, NULL));
  const double mounts[2] = {head.pan_sigma * head.pan_sigma, head.stick_sigma * head.stick_sigma};
  for (int a = 0; a < 2; ++a)
    for (int c = 0; c < 2; ++c)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          double actual = 0, expected = a == c && i == j ? sigma[i] * sigma[i] : 0;
          for (int k = 0; k < 9; ++k)
            actual += H[a][3 * i + k / 3] * joint[6 * (3 * a + k / 3) + 3 * c + k % 3] * H[c][3 * j + k % 3];
          if (a == c || shared)
            for (int k = 0; k < 2; ++k) expected += M[a][2 * i + k] * mounts[k] * M[c][2 * j + k];
          assert_near(actual, expected, 1e-6 * sigma[i] * sigma[j]);
        }
  cairn_filter_destroy(filter);
}

static void placed_covariance_is_that_of_the_noise(void** state) {
  cairn_stereo_head head = test_head();
  (void)state;
  expect_placed(CAMERA, (cairn_stereo_head){.range_sigma = 0.7, .azimuth_sigma = 0.9, .elevation_sigma = 1.1}, false);
  head.encoder_mode = CAIRN_ENCODER_PER_OBSERVATION;
  expect_placed(HEAD, head, false);
  head.pan_sigma = 0.03, head.stick_sigma = 0.02;
  expect_placed(HEAD, head, false);
  head.encoder_mode = CAIRN_ENCODER_PER_FRAME;
  expect_placed(HEAD, head, true);
}

/* The same frames through the built-in sensor and through an equal custom sensor. */
static void expect_equal_to_the_built_in_one(uint32_t relative) {
  cairn_filter_options options = test_options();
  own_sensor custom = test_point();
  cairn_pose pa, pb;
  double error[6], ca[36], cb[36];
  rig a, b;
  world w;
  options.max_sensors = SENSORS + 1;
  world_init(&w, 5);
  if (!relative) options.iterations = 1; /* a custom sensor may need one linearisation more */
  rig_open(&a, &options);
  rig_open(&b, &options);
  custom.model.relative = relative;
  assert_ok(add_own(b.filter, &custom, &b.sensors[CARTESIAN])); /* replaces the built-in sensor */
  for (int n = 0; n < 30; ++n) {
    frame f;
    cairn_match ma[WORLD_LANDMARKS], mb[WORLD_LANDMARKS];
    world_frame(&w, &f);
    if (f.sensor == POINT) f.sensor = CARTESIAN;
    assert_ok(rig_take(&a, &f, ma));
    assert_ok(rig_take(&b, &f, mb));
    for (size_t i = 0; i < f.count; ++i) {
      assert_int_equal(ma[i].result, mb[i].result);
      assert_near(ma[i].distance, mb[i].distance, 1e-6);
    }
  }
  assert_ok(cairn_filter_pose(a.filter, &pa, ca, NULL));
  assert_ok(cairn_filter_pose(b.filter, &pb, cb, NULL));
  assert_ok(cairn_pose_error(&pa, &pb, error, NULL));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 1e-9);
  for (int i = 0; i < 36; ++i) assert_near(ca[i], cb[i], 1e-9);
  for (uint64_t id = 1; id <= WORLD_LANDMARKS; ++id) {
    cairn_landmark la, lb;
    assert_ok(cairn_map_landmark(cairn_filter_map(a.filter), id, &la, NULL));
    assert_ok(cairn_map_landmark(cairn_filter_map(b.filter), id, &lb, NULL));
    for (int i = 0; i < 3; ++i) assert_near(la.position[i], lb.position[i], 1e-9);
    for (int i = 0; i < 9; ++i) assert_near(la.covariance[i], lb.covariance[i], 1e-9);
    assert_int_equal(la.observations, lb.observations);
  }
  rig_close(&a);
  rig_close(&b);
}

static void a_custom_sensor_equals_the_built_in_one(void** state) {
  (void)state;
  expect_equal_to_the_built_in_one(0);
  expect_equal_to_the_built_in_one(1);
}

/* `user` selects the wrong entry and its Jacobian. */
typedef struct spoil {
  int matrix; /* 0: predict/pose, 1: predict/landmark, 2: place/pose, 3: place/z, 4: the placed position */
  int entry;
} spoil;

static int32_t spoilt_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                              double* jacobian_pose, double* jacobian_landmark) {
  const spoil* s = user;
  (void)point_predict(NULL, pose, landmark, z, jacobian_pose, jacobian_landmark);
  if (s->matrix == 0) jacobian_pose[s->entry] += 0.1;
  if (s->matrix == 1) jacobian_landmark[s->entry] += 0.1;
  return 1;
}

static int32_t spoilt_place(void* user, const cairn_pose* pose, const double* z, double landmark[3],
                            double* jacobian_pose, double* jacobian_z) {
  const spoil* s = user;
  (void)point_place(NULL, pose, z, landmark, jacobian_pose, jacobian_z);
  if (s->matrix == 2) jacobian_pose[s->entry] += 0.1;
  if (s->matrix == 3) jacobian_z[s->entry] += 0.1;
  if (s->matrix == 4) landmark[s->entry] += 0.1;
  return 1;
}

static void check_accepts_right_jacobians(void** state) {
  const own_sensor sensors[] = {test_point(), test_range()};
  generator random = {9};
  (void)state;
  for (size_t s = 0; s < LENGTH(sensors); ++s)
    for (int n = 0; n < 20; ++n) {
      const cairn_pose pose = pose_at(random_uniform(&random, -5, 5), 1, 2, random_uniform(&random, -3, 3), 0.4,
                                      random_uniform(&random, -3, 3));
      const double landmark[3] = {random_uniform(&random, 6, 12), random_uniform(&random, -9, 9), 3};
      double worst = NAN;
      assert_ok(check_own(&sensors[s], &pose, landmark, &worst));
      assert_true(worst >= 0 && worst < 1e-5);
    }
}

static void check_exposes_every_wrong_entry(void** state) {
  static const int entries[] = {18, 9, 18, 9, 3};
  const cairn_pose pose = pose_at(1, 2, 3, 0.3, -0.4, 1.2);
  const double landmark[3] = {6, 5, 4};
  (void)state;
  for (int matrix = 0; matrix < 5; ++matrix)
    for (int entry = 0; entry < entries[matrix]; ++entry) {
      spoil s = {matrix, entry};
      own_sensor custom = test_point();
      double worst = 0;
      custom.predict = spoilt_predict, custom.place = spoilt_place, custom.user = &s;
      assert_ok(check_own(&custom, &pose, landmark, &worst));
      if (!(worst > 1e-2)) fail_msg("matrix %d entry %d: worst %g", matrix, entry, worst);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(head_defaults),
      cmocka_unit_test(camera_defaults),
      cmocka_unit_test(cartesian_and_custom_defaults),
      cmocka_unit_test(sensors_are_numbered_from_zero),
      cmocka_unit_test(every_sensor_places_where_it_looks),
      cmocka_unit_test(placed_covariance_is_that_of_the_noise),
      cmocka_unit_test(a_custom_sensor_equals_the_built_in_one),
      cmocka_unit_test(check_accepts_right_jacobians),
      cmocka_unit_test(check_exposes_every_wrong_entry),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
