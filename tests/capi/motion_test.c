/* SPDX-License-Identifier: BSD-3-Clause */
/* Motion: the pose and the covariance after each motion model, and refused inputs. */
#include "support.h"

static cairn_filter* create(const cairn_pose* start, const double* covariance, int32_t error) {
  cairn_filter_options options = test_options();
  cairn_filter* filter = NULL;
  options.state_error = error;
  options.initial_pose = *start;
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  if (covariance != NULL) memcpy(options.initial_covariance, covariance, sizeof options.initial_covariance);
  assert_ok(cairn_filter_create(&options, &filter, NULL));
  return filter;
}

static void expect_pose(const cairn_filter* filter, const cairn_pose* expected, double tolerance) {
  cairn_pose pose;
  double error[6];
  assert_ok(cairn_filter_pose(filter, &pose, NULL, NULL));
  assert_ok(cairn_pose_error(expected, &pose, error, NULL));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, tolerance);
}

static void wheels_defaults(void** state) {
  cairn_wheels w;
  (void)state;
  memset(&w, 0x5a, sizeof w);
  assert_ok(cairn_wheels_init(&w, sizeof w, NULL));
  assert_int_equal(w.struct_size, sizeof w);
  assert_int_equal(w.yaw_sign, CAIRN_YAW_RIGHT_MINUS_LEFT);
  assert_near(w.radius, 0.3, 0);
  assert_near(w.track, 1.0, 0);
  assert_near(w.rate_sigma, 0.01, 0);
  assert_near(w.slip_sigma, 0.02, 0);
  assert_near(w.lateral_sigma, 0.01, 0);
  assert_near(w.vertical_sigma, 0.01, 0);
  assert_near(w.roll_rate_sigma, 0.05, 0);
  assert_near(w.pitch_rate_sigma, 0.05, 0);
}

static void twist_noise_defaults(void** state) {
  cairn_twist_noise n;
  (void)state;
  memset(&n, 0x5a, sizeof n);
  assert_ok(cairn_twist_noise_init(&n, sizeof n, NULL));
  assert_int_equal(n.struct_size, sizeof n);
  assert_int_equal(n.reserved, 0);
  for (int i = 0; i < 3; ++i) {
    assert_near(n.velocity_sigma[i], 0.05, 0);
    assert_near(n.rate_sigma[i], 0.005, 0);
  }
}

/* Constant body velocity and rate over dt give the exponential of the group: compared with many small Euler steps. */
static void twist_integrates_on_the_group(void** state) {
  const cairn_pose start = pose_at(1, 2, 3, 0.3, -0.4, 2.0);
  const double v[3] = {1.0, -0.4, 0.2}, w[3] = {0.3, -0.2, 0.8}, dt = 0.7;
  cairn_pose expected = start;
  enum { STEPS = 20000 };
  (void)state;
  for (int n = 0; n < STEPS; ++n) { /* midpoint rule: error of order (dt / STEPS)^2 */
    const double h = dt / STEPS;
    cairn_pose half = {{0, 0, 0}, {1, 0, 0, 0}}, whole = half;
    double r[3], moved[3];
    for (int i = 0; i < 3; ++i) r[i] = w[i] * h / 2;
    assert_ok(cairn_quaternion_exp(r, half.quaternion, NULL));
    for (int i = 0; i < 3; ++i) r[i] *= 2;
    assert_ok(cairn_quaternion_exp(r, whole.quaternion, NULL));
    for (int i = 0; i < 3; ++i) r[i] = v[i] * h;
    to_map(&half, r, moved);
    memcpy(whole.position, moved, sizeof moved);
    assert_ok(cairn_pose_compose(&expected, &whole, &expected, NULL));
  }
  cairn_filter* filter = create(&start, NULL, CAIRN_STATE_ERROR_INVARIANT);
  assert_ok(cairn_filter_predict_twist(filter, dt, v, w, NULL));
  expect_pose(filter, &expected, 1e-9);
  cairn_filter_destroy(filter);
}

static void wheels_drive_an_arc(void** state) {
  const cairn_pose start = pose_at(0, 0, 0, 0, 0, 0);
  const double left = 2, right = 3, dt = 1.5, speed = 0.3 * 2.5, turn = 0.3 / 1.0 * 1.0;
  (void)state;
  for (int sign = 0; sign < 2; ++sign) {
    cairn_wheels wheels;
    cairn_filter* filter = create(&start, NULL, CAIRN_STATE_ERROR_INVARIANT);
    const double angle = (sign == 0 ? 1 : -1) * turn * dt;
    const cairn_pose expected =
        pose_at(speed * dt / angle * sin(angle), speed * dt / angle * (1 - cos(angle)), 0, 0, 0, angle);
    assert_ok(cairn_wheels_init(&wheels, sizeof wheels, NULL));
    wheels.yaw_sign = sign == 0 ? CAIRN_YAW_RIGHT_MINUS_LEFT : CAIRN_YAW_LEFT_MINUS_RIGHT;
    if (sign == 1)
      assert_ok(cairn_filter_set_wheels(filter, &wheels, NULL)); /* sign 0 is the default before any call */
    assert_ok(cairn_filter_predict_wheels(filter, dt, left, right, NULL));
    expect_pose(filter, &expected, 1e-12);
    cairn_filter_destroy(filter);
  }
}

static void wheels_use_the_geometry_of_the_caller(void** state) {
  const cairn_pose start = pose_at(0, 0, 0, 0, 0, 0);
  cairn_filter* filter = create(&start, NULL, CAIRN_STATE_ERROR_INVARIANT);
  cairn_wheels wheels;
  (void)state;
  assert_ok(cairn_wheels_init(&wheels, sizeof wheels, NULL));
  wheels.radius = 0.1, wheels.track = 0.4;
  assert_ok(cairn_filter_set_wheels(filter, &wheels, NULL));
  memset(&wheels, 0, sizeof wheels); /* the library copied it */
  assert_ok(cairn_filter_predict_wheels(filter, 1, -1, 1, NULL));
  const cairn_pose expected = pose_at(0, 0, 0, 0, 0, 0.1 / 0.4 * 2);
  expect_pose(filter, &expected, 1e-12);
  cairn_filter_destroy(filter);
}

static void increments_compose(void** state) {
  const cairn_pose start = pose_at(1, 2, 3, 0.3, -0.4, 2.0), move = pose_at(0.5, 0.1, -0.2, 0.05, 0.02, -0.3);
  double covariance[36];
  cairn_pose expected;
  cairn_filter* filter = create(&start, NULL, CAIRN_STATE_ERROR_INVARIANT);
  (void)state;
  diagonal(covariance, 6, 1e-4);
  assert_ok(cairn_pose_compose(&start, &move, &expected, NULL));
  assert_ok(cairn_filter_predict_increment(filter, &move, covariance, NULL));
  expect_pose(filter, &expected, 1e-12);
  cairn_filter_destroy(filter);
}

static void expect_covariance(const cairn_filter* filter, const double expected[36], double relative) {
  double covariance[36], scale = 0;
  assert_ok(cairn_filter_pose(filter, NULL, covariance, NULL));
  for (int i = 0; i < 36; ++i) scale = fmax(scale, fabs(expected[i]));
  for (int i = 0; i < 36; ++i) assert_near(covariance[i], expected[i], relative * scale);
}

static void noise_at_rest_is_a_sigma_times_dt(void** state) {
  const cairn_pose start = pose_at(0, 0, 0, 0, 0, 0);
  const double rest[3] = {0, 0, 0}, dt = 0.5;
  (void)state;
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
    cairn_filter* filter = create(&start, NULL, error);
    cairn_twist_noise noise;
    double expected[36] = {0};
    assert_ok(cairn_twist_noise_init(&noise, sizeof noise, NULL));
    for (int i = 0; i < 3; ++i) {
      noise.velocity_sigma[i] = 0.1 * (i + 1), noise.rate_sigma[i] = 0.01 * (i + 1);
      expected[7 * i] = pow(noise.velocity_sigma[i] * dt, 2), expected[7 * (i + 3)] = pow(noise.rate_sigma[i] * dt, 2);
    }
    assert_ok(cairn_filter_set_twist_noise(filter, &noise, NULL));
    assert_ok(cairn_filter_predict_twist(filter, dt, rest, rest, NULL));
    expect_covariance(filter, expected, 1e-12);
    cairn_filter_destroy(filter);
  }
}

static void wheel_noise_follows_eq_1(void** state) {
  const cairn_pose start = pose_at(0, 0, 0, 0, 0, 0);
  const double dt = 1e-3, left = 2, right = 4; /* a short step: terms of order dt^3 are negligible */
  cairn_wheels w;
  cairn_filter* filter = create(&start, NULL, CAIRN_STATE_ERROR_INVARIANT);
  double expected[36] = {0};
  (void)state;
  assert_ok(cairn_wheels_init(&w, sizeof w, NULL));
  w.rate_sigma = 0.1, w.slip_sigma = 0.05, w.lateral_sigma = 0.02, w.vertical_sigma = 0.03;
  w.roll_rate_sigma = 0.04, w.pitch_rate_sigma = 0.06;
  assert_ok(cairn_filter_set_wheels(filter, &w, NULL));
  const double l = pow(w.rate_sigma, 2) + pow(w.slip_sigma * left, 2),
               r = pow(w.rate_sigma, 2) + pow(w.slip_sigma * right, 2), per_track = w.radius / w.track;
  expected[0] = pow(w.radius / 2, 2) * (l + r);
  expected[7] = pow(w.lateral_sigma, 2), expected[14] = pow(w.vertical_sigma, 2);
  expected[21] = pow(w.roll_rate_sigma, 2), expected[28] = pow(w.pitch_rate_sigma, 2);
  expected[35] = pow(per_track, 2) * (l + r);
  expected[5] = expected[30] = w.radius / 2 * per_track * (r - l);
  for (int i = 0; i < 36; ++i) expected[i] *= dt * dt;
  assert_ok(cairn_filter_predict_wheels(filter, dt, left, right, NULL));
  expect_covariance(filter, expected, 5e-3);
  cairn_filter_destroy(filter);
}

/* The error of the increment is in the axes of the body before the step; the lever arm turns the error of the prior
 * attitude into a position error. */
static void increment_covariance_is_rotated_and_propagated(void** state) {
  const cairn_pose start = pose_at(4, -3, 2, 0.4, -0.7, 1.9), move = pose_at(3, 1, -0.5, 0.2, 0.1, 0.6);
  double prior[36], noise[36], expected[36], R[9], arm[3], cross[9], full[36] = {0}, F[36];
  (void)state;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      prior[6 * i + j] = 1e-4 * ((i == j) + 0.1 * (i + j == 5)), noise[6 * i + j] = 1e-4 * ((i == j) * (i + 1) + 0.2);
    }
  rotation_matrix(start.quaternion, R);
  for (int i = 0; i < 3; ++i) arm[i] = R[3 * i] * 3 + R[3 * i + 1] * 1 + R[3 * i + 2] * -0.5;
  cross_matrix(arm, cross);
  diagonal(F, 6, 1); /* dp' = dp - [R t]x dtheta + R ep, dtheta' = dtheta + R er */
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) F[6 * i + 3 + j] = -cross[3 * i + j];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) full[6 * i + j] = full[6 * (i + 3) + j + 3] = R[3 * i + j];
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      expected[6 * i + j] = 0;
      for (int k = 0; k < 6; ++k)
        for (int n = 0; n < 6; ++n)
          expected[6 * i + j] +=
              F[6 * i + k] * prior[6 * k + n] * F[6 * j + n] + full[6 * i + k] * noise[6 * k + n] * full[6 * j + n];
    }
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
    cairn_filter* filter = create(&start, prior, error);
    assert_ok(cairn_filter_predict_increment(filter, &move, noise, NULL));
    expect_covariance(filter, expected, 1e-12);
    cairn_filter_destroy(filter);
  }
}

/* Structs of other versions. The bytes behind a short struct stay unchanged; a longer struct acts like the exact one.
 * */
static void wheels_of_other_versions(void** state) {
  struct {
    cairn_wheels wheels;
    double later[4];
  } future;
  cairn_wheels exact, old;
  cairn_pose start = pose_at(0, 0, 0, 0, 0, 0), a, b;
  double pa[36], pb[36];
  (void)state;
  const size_t known = offsetof(cairn_wheels, track);
  memset(&old, 0x5a, sizeof old);
  assert_ok(cairn_wheels_init(&old, known, NULL));
  assert_int_equal(old.struct_size, known);
  assert_near(old.radius, 0.3, 0);
  for (size_t i = known; i < sizeof old; ++i) assert_int_equal(((unsigned char*)&old)[i], 0x5a);

  assert_ok(cairn_wheels_init(&exact, sizeof exact, NULL));
  exact.radius = old.radius = 0.5;
  memset(&future, 0, sizeof future); /* what this library does not know must be zero */
  memcpy(&future.wheels, &exact, sizeof exact);
  future.wheels.struct_size = sizeof future;
  const cairn_wheels* others[] = {&old, &future.wheels};
  cairn_filter* reference = create(&start, NULL, CAIRN_STATE_ERROR_INVARIANT);
  assert_ok(cairn_filter_set_wheels(reference, &exact, NULL));
  assert_ok(cairn_filter_predict_wheels(reference, 0.1, 1, 2, NULL));
  assert_ok(cairn_filter_pose(reference, &a, pa, NULL));
  for (size_t i = 0; i < LENGTH(others); ++i) {
    cairn_filter* filter = create(&start, NULL, CAIRN_STATE_ERROR_INVARIANT);
    assert_ok(cairn_filter_set_wheels(filter, others[i], NULL));
    assert_ok(cairn_filter_predict_wheels(filter, 0.1, 1, 2, NULL));
    assert_ok(cairn_filter_pose(filter, &b, pb, NULL));
    assert_memory_equal(&a, &b, sizeof a);
    assert_memory_equal(pa, pb, sizeof pa);
    cairn_filter_destroy(filter);
  }
  cairn_filter_destroy(reference);
}

static void init_refuses_too_small_sizes(void** state) {
  static const size_t sizes[] = {0, 1, 3, (size_t)1 << 31, (size_t)1 << 32, SIZE_MAX};
  cairn_wheels wheels, kept_wheels;
  cairn_twist_noise noise, kept_noise;
  (void)state;
  memset(&wheels, 0x5a, sizeof wheels), kept_wheels = wheels;
  memset(&noise, 0x5a, sizeof noise), kept_noise = noise;
  for (size_t i = 0; i < LENGTH(sizes); ++i) {
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "struct_size", cairn_wheels_init(&wheels, sizes[i], NULL));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "struct_size", cairn_twist_noise_init(&noise, sizes[i], NULL));
  }
  assert_memory_equal(&wheels, &kept_wheels, sizeof wheels);
  assert_memory_equal(&noise, &kept_noise, sizeof noise);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "wheels", cairn_wheels_init(NULL, sizeof wheels, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "noise", cairn_twist_noise_init(NULL, sizeof noise, NULL));
}

static void bad_wheels_are_refused(void** state) {
  bench* b = *state;
  cairn_wheels good;
  assert_ok(cairn_wheels_init(&good, sizeof good, NULL));
  static const struct {
    const char* name;
    size_t offset;
    bool may_be_zero;
  } fields[] = {{"radius", offsetof(cairn_wheels, radius), false},
                {"track", offsetof(cairn_wheels, track), false},
                {"rate_sigma", offsetof(cairn_wheels, rate_sigma), true},
                {"slip_sigma", offsetof(cairn_wheels, slip_sigma), true},
                {"lateral_sigma", offsetof(cairn_wheels, lateral_sigma), true},
                {"vertical_sigma", offsetof(cairn_wheels, vertical_sigma), true},
                {"roll_rate_sigma", offsetof(cairn_wheels, roll_rate_sigma), true},
                {"pitch_rate_sigma", offsetof(cairn_wheels, pitch_rate_sigma), true}};
  for (size_t k = 0; k < LENGTH(fields); ++k) {
    const double bad[] = {NAN, INFINITY, -INFINITY, -1e-9, fields[k].may_be_zero ? -1.0 : 0.0};
    for (size_t n = 0; n < LENGTH(bad); ++n) {
      cairn_wheels wheels = good;
      *(double*)(void*)((unsigned char*)&wheels + fields[k].offset) = bad[n];
      assert_refused(b, CAIRN_ERROR_ARGUMENT, fields[k].name, cairn_filter_set_wheels(b->main.filter, &wheels, NULL));
    }
  }
  static const int32_t signs[] = {-1, 2, INT32_MAX};
  for (size_t n = 0; n < LENGTH(signs); ++n) {
    cairn_wheels wheels = good;
    wheels.yaw_sign = signs[n];
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "yaw_sign", cairn_filter_set_wheels(b->main.filter, &wheels, NULL));
  }
  static const uint32_t sizes[] = {0, 3, (uint32_t)1 << 31, UINT32_MAX};
  for (size_t n = 0; n < LENGTH(sizes); ++n) {
    cairn_wheels wheels = good;
    wheels.struct_size = sizes[n];
    wheels.radius = 2;
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "struct_size", cairn_filter_set_wheels(b->main.filter, &wheels, NULL));
  }
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "wheels", cairn_filter_set_wheels(b->main.filter, NULL, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_set_wheels(NULL, &good, NULL));
}

static void bad_twist_noise_is_refused(void** state) {
  bench* b = *state;
  static const double bad[] = {NAN, INFINITY, -INFINITY, -1e-9};
  cairn_twist_noise good, noise;
  assert_ok(cairn_twist_noise_init(&good, sizeof good, NULL));
  for (int i = 0; i < 3; ++i)
    for (size_t n = 0; n < LENGTH(bad); ++n) {
      noise = good;
      noise.velocity_sigma[i] = bad[n];
      assert_refused(b, CAIRN_ERROR_ARGUMENT, "velocity_sigma",
                     cairn_filter_set_twist_noise(b->main.filter, &noise, NULL));
      noise = good;
      noise.rate_sigma[i] = bad[n];
      assert_refused(b, CAIRN_ERROR_ARGUMENT, "rate_sigma", cairn_filter_set_twist_noise(b->main.filter, &noise, NULL));
    }
  static const uint32_t sizes[] = {0, 3, (uint32_t)1 << 31};
  for (size_t n = 0; n < LENGTH(sizes); ++n) {
    noise = good;
    noise.struct_size = sizes[n];
    noise.rate_sigma[0] = 2;
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "struct_size", cairn_filter_set_twist_noise(b->main.filter, &noise, NULL));
  }
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "noise", cairn_filter_set_twist_noise(b->main.filter, NULL, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_set_twist_noise(NULL, &good, NULL));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(wheels_defaults),
      cmocka_unit_test(twist_noise_defaults),
      cmocka_unit_test(twist_integrates_on_the_group),
      cmocka_unit_test(wheels_drive_an_arc),
      cmocka_unit_test(wheels_use_the_geometry_of_the_caller),
      cmocka_unit_test(increments_compose),
      cmocka_unit_test(noise_at_rest_is_a_sigma_times_dt),
      cmocka_unit_test(wheel_noise_follows_eq_1),
      cmocka_unit_test(increment_covariance_is_rotated_and_propagated),
      cmocka_unit_test(wheels_of_other_versions),
      cmocka_unit_test(init_refuses_too_small_sizes),
      cmocka_unit_test_setup_teardown(bad_wheels_are_refused, bench_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(bad_twist_noise_is_refused, bench_setup, bench_teardown),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
