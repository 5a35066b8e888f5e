/* SPDX-License-Identifier: BSD-3-Clause */
/* Systematic errors as states: what switches them on, what they find out, and refused inputs. */
#include "support.h"

enum { LANDMARKS = 12, FRAMES = 200 };

/* A vehicle on a circle among landmarks, whose odometry and whose sensor are wrong. */
static const double kVelocityBias[3] = {0.05, -0.12, 0.08}, kRateBias[3] = {0.002, -0.001, 0.003};
static const double kMountTurn[3] = {0.01, -0.015, 0.02};

static void landmark_at(int i, double out[3]) {
  const double angle = 2 * PI * i / LANDMARKS;
  out[0] = 14 * cos(angle);
  out[1] = 14 * sin(angle);
  out[2] = 1.5 * sin(3 * angle);
}

static cairn_filter_options biased_options(void) {
  cairn_filter_options o;
  assert_ok(cairn_filter_options_init(&o, sizeof o, NULL));
  o.max_landmarks = LANDMARKS;
  o.max_observations = LANDMARKS;
  for (int i = 0; i < 3; ++i) {
    o.velocity_bias_sigma[i] = 0.15;
    o.rate_bias_sigma[i] = 0.005;
  }
  o.max_sensor_errors = 3;
  return o;
}

/* Drives and returns the filter. `calibrate`: the turn of the mount is a state. */
static cairn_filter* drive(const cairn_filter_options* options, bool calibrate, cairn_pose* truth) {
  generator random = {7};
  cairn_filter* filter = NULL;
  cairn_cartesian sensor;
  cairn_twist_noise noise;
  int32_t number = -1;
  double mount_quaternion[4] = {1, kMountTurn[0] / 2, kMountTurn[1] / 2, kMountTurn[2] / 2};
  double length = 0;
  assert_ok(cairn_filter_create(options, &filter, NULL));
  assert_ok(cairn_cartesian_init(&sensor, sizeof sensor, NULL));
  assert_ok(cairn_filter_add_cartesian(filter, &sensor, &number, NULL));
  assert_ok(cairn_twist_noise_init(&noise, sizeof noise, NULL));
  for (int i = 0; i < 3; ++i) noise.velocity_sigma[i] = 0.02, noise.rate_sigma[i] = 0.002;
  assert_ok(cairn_filter_set_twist_noise(filter, &noise, NULL));
  if (calibrate) {
    cairn_calibration calibration;
    assert_ok(cairn_calibration_init(&calibration, sizeof calibration, NULL));
    for (int i = 0; i < 3; ++i) calibration.mount_turn_sigma[i] = 0.03;
    assert_ok(cairn_filter_calibrate_sensor(filter, number, &calibration, NULL));
  }
  for (int i = 0; i < 4; ++i) length += mount_quaternion[i] * mount_quaternion[i];
  for (int i = 0; i < 4; ++i) mount_quaternion[i] /= sqrt(length);
  *truth = options->initial_pose;
  for (int k = 0; k < FRAMES; ++k) {
    /* At a constant speed the pitch of the mount and a velocity bias upwards would be one error. */
    const double v[3] = {1 + 0.4 * sin(0.3 * k), 0, 0}, w[3] = {0, 0.02 * sin(0.2 * k), 0.1};
    double measured_v[3], measured_w[3];
    cairn_observation seen[LANDMARKS];
    cairn_filter* guide = NULL; /* integrates the truth */
    cairn_filter_options plain;
    cairn_pose mount = {{0, 0, 0}, {1, 0, 0, 0}}, sensor_pose;
    assert_ok(cairn_filter_options_init(&plain, sizeof plain, NULL));
    plain.max_landmarks = plain.max_observations = 1;
    plain.initial_pose = *truth;
    assert_ok(cairn_filter_create(&plain, &guide, NULL));
    assert_ok(cairn_filter_predict_twist(guide, 0.5, v, w, NULL));
    assert_ok(cairn_filter_pose(guide, truth, NULL, NULL));
    cairn_filter_destroy(guide);
    for (int i = 0; i < 3; ++i) {
      measured_v[i] = v[i] + kVelocityBias[i] + random_normal(&random, 0.02);
      measured_w[i] = w[i] + kRateBias[i] + random_normal(&random, 0.002);
    }
    assert_ok(cairn_filter_predict_twist(filter, 0.5, measured_v, measured_w, NULL));
    memset(seen, 0, sizeof seen);
    memcpy(mount.quaternion, mount_quaternion, sizeof mount_quaternion);
    assert_ok(cairn_pose_compose(truth, &mount, &sensor_pose, NULL));
    for (int i = 0; i < LANDMARKS; ++i) {
      double landmark[3];
      landmark_at(i, landmark);
      seen[i].id = (uint64_t)i;
      to_body(calibrate ? &sensor_pose : truth, landmark, seen[i].z);
      for (int d = 0; d < 3; ++d) seen[i].z[d] += random_normal(&random, 0.1);
    }
    assert_ok(cairn_filter_update(filter, number, seen, LANDMARKS, NULL, NULL));
  }
  return filter;
}

static void nothing_is_on_by_default(void** state) {
  cairn_filter_options o;
  cairn_calibration c;
  cairn_filter* filter = NULL;
  size_t needed = 77;
  (void)state;
  memset(&c, 0x5a, sizeof c);
  assert_ok(cairn_calibration_init(&c, sizeof c, NULL));
  assert_int_equal(c.struct_size, sizeof c);
  for (int i = 0; i < 3; ++i) {
    assert_near(c.mount_shift_sigma[i] + c.mount_shift_walk[i] + c.mount_turn_sigma[i], 0, 0);
    assert_near(c.mount_turn_walk[i] + c.offset_sigma[i] + c.offset_walk[i], 0, 0);
  }
  assert_ok(cairn_filter_options_init(&o, sizeof o, NULL));
  assert_ok(cairn_filter_create(&o, &filter, NULL));
  assert_ok(cairn_filter_systematic_errors(filter, NULL, NULL, 0, &needed, NULL));
  assert_int_equal(needed, 0);
  cairn_filter_destroy(filter);
}

static void errors_are_found(void** state) {
  static const uint32_t submaps[] = {0, 6};
  (void)state;
  for (size_t way = 0; way < 3; ++way) {
    cairn_filter_options o = biased_options();
    cairn_systematic_error errors[9];
    double covariance[81], error[6], pose_covariance[36];
    size_t needed = 0;
    cairn_pose truth, pose;
    cairn_filter* filter;
    o.submap_landmarks = submaps[way > 0];
    o.join = way == 1 ? CAIRN_JOIN_DENSE : CAIRN_JOIN_SPARSE;
    if (way > 0) o.submap_distance = 8;
    filter = drive(&o, true, &truth);
    assert_status(cairn_filter_systematic_errors(filter, errors, covariance, 8, &needed, NULL), CAIRN_ERROR_BUFFER);
    assert_int_equal(needed, 9);
    assert_ok(cairn_filter_systematic_errors(filter, errors, covariance, 9, &needed, NULL));
    for (int i = 0; i < 9; ++i) {
      const double* expected = i < 3 ? kVelocityBias : i < 6 ? kRateBias : kMountTurn;
      const double prior = i < 3 ? 0.15 : i < 6 ? 0.005 : 0.03;
      const int32_t kind = i < 3   ? CAIRN_SYSTEMATIC_VELOCITY_BIAS
                           : i < 6 ? CAIRN_SYSTEMATIC_RATE_BIAS
                                   : CAIRN_SYSTEMATIC_MOUNT_TURN;
      assert_int_equal(errors[i].kind, kind);
      assert_int_equal(errors[i].component, i % 3);
      assert_int_equal(errors[i].sensor, i < 6 ? -1 : 0);
      assert_near(errors[i].sigma, sqrt(covariance[10 * i]), 1e-15);
      assert_true(errors[i].sigma < 0.5 * prior);
      assert_near(errors[i].value, expected[i % 3], 4 * errors[i].sigma);
    }
    assert_ok(cairn_filter_pose(filter, &pose, pose_covariance, NULL));
    assert_ok(cairn_pose_error(&truth, &pose, error, NULL));
    for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 4 * sqrt(pose_covariance[7 * i]));
    if (way == 0) { /* the calibration made the map of the handle anew */
      size_t landmarks = 0;
      assert_ok(cairn_map_size(cairn_filter_map(filter), &landmarks, NULL));
      assert_int_equal(landmarks, LANDMARKS);
    } else {
      size_t landmarks = 0;
      assert_ok(cairn_map_size(cairn_filter_map(filter), &landmarks, NULL));
      assert_true(landmarks > 0);
    }
    cairn_filter_destroy(filter);
  }
}

static void refuse_options(const cairn_filter_options* options, const char* name) {
  cairn_filter* filter = NULL;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, name, cairn_filter_create(options, &filter, NULL));
  assert_null(filter);
}

static void bad_options_are_refused(void** state) {
  const struct field {
    const char* name;
    size_t sigma, walk;
    int count;
  } fields[] = {
      {"velocity_bias", offsetof(cairn_filter_options, velocity_bias_sigma),
       offsetof(cairn_filter_options, velocity_bias_walk), 3},
      {"rate_bias", offsetof(cairn_filter_options, rate_bias_sigma), offsetof(cairn_filter_options, rate_bias_walk), 3},
      {"wheel_scale", offsetof(cairn_filter_options, wheel_scale_sigma),
       offsetof(cairn_filter_options, wheel_scale_walk), 2}};
  const double bad[] = {NAN, INFINITY, -INFINITY, -1e-9, 1e7};
  (void)state;
  for (size_t k = 0; k < LENGTH(fields); ++k)
    for (int i = 0; i < fields[k].count; ++i) {
      char name[64];
      cairn_filter_options o;
      double value = 0.1;
      for (size_t n = 0; n < LENGTH(bad); ++n) {
        o = test_options();
        snprintf(name, sizeof name, "%s_sigma[%d]", fields[k].name, i);
        memcpy((unsigned char*)&o + fields[k].sigma + sizeof value * (size_t)i, &bad[n], sizeof value);
        refuse_options(&o, name);
        o = test_options();
        memcpy((unsigned char*)&o + fields[k].sigma + sizeof value * (size_t)i, &value, sizeof value);
        snprintf(name, sizeof name, "%s_walk[%d]", fields[k].name, i);
        memcpy((unsigned char*)&o + fields[k].walk + sizeof value * (size_t)i, &bad[n], sizeof value);
        refuse_options(&o, name);
      }
      o = test_options(); /* a walk without a prior */
      memcpy((unsigned char*)&o + fields[k].walk + sizeof value * (size_t)i, &value, sizeof value);
      snprintf(name, sizeof name, "%s_walk[%d]", fields[k].name, i);
      refuse_options(&o, name);
    }
  cairn_filter_options o = test_options();
  o.max_sensor_errors = 65;
  refuse_options(&o, "max_sensor_errors");
  o = test_options();
  o.vehicle = CAIRN_VEHICLE_PLANAR;
  o.initial_pose = pose_at(5, 0, 0, 0, 0, PI / 2);
  o.velocity_bias_sigma[2] = 0.1;
  refuse_options(&o, "velocity_bias_sigma[2]");
  o.velocity_bias_sigma[2] = 0;
  o.rate_bias_sigma[0] = 0.1;
  refuse_options(&o, "rate_bias_sigma[0]");
}

static void an_increment_has_no_duration(void** state) {
  cairn_filter_options o = test_options();
  bench b;
  const cairn_pose step = pose_at(0.1, 0, 0, 0, 0, 0);
  double covariance[36];
  (void)state;
  diagonal(covariance, 6, 1e-4);
  o.velocity_bias_sigma[1] = 0.1;
  bench_open(&b, &o, 0);
  assert_refused(&b, CAIRN_ERROR_STATE, "increment",
                 cairn_filter_predict_increment(b.main.filter, &step, covariance, NULL));
  bench_close(&b);
  o = test_options(); /* a scale of the wheels is no matter of an increment */
  o.wheel_scale_sigma[0] = 0.1;
  bench_open(&b, &o, 0);
  assert_ok(cairn_filter_predict_increment(b.main.filter, &step, covariance, NULL));
  bench_close(&b);
}

static void bad_calibrations_are_refused(void** state) {
  cairn_filter_options o = test_options();
  bench b;
  cairn_calibration good, c;
  (void)state;
  o.max_sensor_errors = 4;
  bench_open(&b, &o, 0);
  assert_ok(cairn_calibration_init(&good, sizeof good, NULL));
  c = good;
  c.mount_turn_sigma[1] = -1;
  assert_refused(&b, CAIRN_ERROR_ARGUMENT, "mount_turn_sigma[1]",
                 cairn_filter_calibrate_sensor(b.main.filter, b.main.sensors[HEAD], &c, NULL));
  c = good;
  c.offset_walk[2] = 1;
  assert_refused(&b, CAIRN_ERROR_ARGUMENT, "offset_walk[2]",
                 cairn_filter_calibrate_sensor(b.main.filter, b.main.sensors[HEAD], &c, NULL));
  c = good;
  c.mount_shift_sigma[0] = NAN;
  assert_refused(&b, CAIRN_ERROR_ARGUMENT, "mount_shift_sigma[0]",
                 cairn_filter_calibrate_sensor(b.main.filter, b.main.sensors[HEAD], &c, NULL));
  bench_close(&b);

  bench_open(&b, &o, 0); /* each refusal moves the bench, and only a filter that stands can be calibrated */
  c = good;
  c.offset_sigma[1] = 0.1;
  assert_refused(&b, CAIRN_ERROR_ARGUMENT, "offset_sigma[1]",
                 cairn_filter_calibrate_sensor(b.main.filter, b.main.sensors[RANGE], &c, NULL));
  assert_refused(&b, CAIRN_ERROR_NOT_FOUND, "sensor", cairn_filter_calibrate_sensor(b.main.filter, SENSORS, &c, NULL));
  assert_refused(&b, CAIRN_ERROR_ARGUMENT, "calibration",
                 cairn_filter_calibrate_sensor(b.main.filter, b.main.sensors[HEAD], NULL, NULL));
  bench_close(&b);

  bench_open(&b, &o, 0);
  c = good;
  for (int i = 0; i < 3; ++i) c.mount_shift_sigma[i] = c.mount_turn_sigma[i] = 0.1;
  assert_refused(&b, CAIRN_ERROR_CAPACITY, "max_sensor_errors",
                 cairn_filter_calibrate_sensor(b.main.filter, b.main.sensors[HEAD], &c, NULL));
  bench_close(&b);

  bench_open(&b, &o, 1); /* too late */
  c = good;
  c.mount_turn_sigma[0] = 0.1;
  assert_refused(&b, CAIRN_ERROR_STATE, "calibrate",
                 cairn_filter_calibrate_sensor(b.main.filter, b.main.sensors[HEAD], &c, NULL));
  bench_close(&b);

  rig r;
  rig_open(&r, &o);
  assert_ok(cairn_filter_calibrate_sensor(r.filter, r.sensors[HEAD], &c, NULL));
  assert_refused(NULL, CAIRN_ERROR_STATE, "already",
                 cairn_filter_calibrate_sensor(r.filter, r.sensors[HEAD], &c, NULL));
  size_t needed = 0;
  assert_ok(cairn_filter_systematic_errors(r.filter, NULL, NULL, 0, &needed, NULL));
  assert_int_equal(needed, 1);
  rig_close(&r);
}

/* The gyro's rate takes the place of the rate of the wheels. */
static void wheels_with_a_gyro(void** state) {
  cairn_filter_options o = test_options();
  cairn_filter* filter = NULL;
  const double rate[3] = {0, 0, 0.4};
  double bad[3] = {0, NAN, 0};
  cairn_pose pose;
  (void)state;
  o.initial_pose = pose_at(0, 0, 0, 0, 0, 0);
  assert_ok(cairn_filter_create(&o, &filter, NULL));
  assert_ok(cairn_filter_predict_wheels_gyro(filter, 0.5, 2, 2, rate, NULL)); /* radius 0.3: 0.6 m/s */
  assert_ok(cairn_filter_pose(filter, &pose, NULL, NULL));
  assert_near(2 * atan2(pose.quaternion[3], pose.quaternion[0]), 0.2, 1e-12);
  assert_near(hypot(pose.position[0], pose.position[1]), 0.6 / 0.4 * 2 * sin(0.1), 1e-12);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rate", cairn_filter_predict_wheels_gyro(filter, 0.5, 2, 2, bad, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rate", cairn_filter_predict_wheels_gyro(filter, 0.5, 2, 2, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "dt", cairn_filter_predict_wheels_gyro(filter, 0, 2, 2, rate, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "left",
                 cairn_filter_predict_wheels_gyro(filter, 1, INFINITY, 2, rate, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "right", cairn_filter_predict_wheels_gyro(filter, 1, 2, NAN, rate, NULL));
  cairn_filter_destroy(filter);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_is_on_by_default),     cmocka_unit_test(errors_are_found),
      cmocka_unit_test(bad_options_are_refused),      cmocka_unit_test(an_increment_has_no_duration),
      cmocka_unit_test(bad_calibrations_are_refused), cmocka_unit_test(wheels_with_a_gyro),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
