/* SPDX-License-Identifier: BSD-3-Clause */
/* Measurements compared with truth: field of view, composition of samples, size and independence of the noise. */
#include "support.h"

/* The point in the body frame for an observation of the world's head. */
static void camera_point(const cairn_pose* truth, const cairn_stereo_head* head, double pan, double stick,
                         const double landmark[3], double m[3]) {
  cairn_pose turn = {{0, 0, 0}, {1, 0, 0, 0}}, tilt = {{0, 0, 0}, {1, 0, 0, 0}}, arm = {{0, 0, 0}, {1, 0, 0, 0}}, T;
  const double about_z[3] = {0, 0, pan}, about_y[3] = {0, stick, 0};
  memcpy(turn.position, head->platform, sizeof turn.position);
  memcpy(arm.position, head->stick, sizeof arm.position);
  assert_int_equal(cairn_quaternion_exp(about_z, turn.quaternion, NULL), CAIRN_OK);
  assert_int_equal(cairn_quaternion_exp(about_y, tilt.quaternion, NULL), CAIRN_OK);
  assert_int_equal(cairn_pose_compose(truth, &turn, &T, NULL), CAIRN_OK);
  assert_int_equal(cairn_pose_compose(&T, &tilt, &T, NULL), CAIRN_OK);
  assert_int_equal(cairn_pose_compose(&T, &arm, &T, NULL), CAIRN_OK);
  to_body(&T, landmark, m);
}

static void true_motion_connects_the_true_poses(void** state) {
  cairn_world_options o = default_options();
  cairn_world* w = open_world(&o);
  cairn_pose pose;
  cairn_wheels wheels;
  size_t k, i;
  (void)state;
  wheels.struct_size = sizeof wheels;
  assert_ok(cairn_world_wheels(w, &wheels, NULL));
  assert_near(wheels.rate_sigma, 0.01 / 2, 1e-15); /* mean of four samples */
  assert_near(wheels.radius, 0.3, 0);
  pose = next_step(w).truth;
  for (k = 1; k < 40; ++k) {
    const world_step step = next_step(w);
    double error[6], forward, turning;
    int axis;
    for (i = 0; i < step.motion_count; ++i) {
      const cairn_world_motion* m = &step.motions[i];
      pose = moved(&pose, m->true_velocity, m->true_rate, m->dt);
      forward = wheels.radius * (m->true_wheels[0] + m->true_wheels[1]) / 2;
      turning = wheels.radius / wheels.track * (m->true_wheels[1] - m->true_wheels[0]);
      assert_near(forward, m->true_velocity[0], 1e-12);
      assert_near(turning, m->true_rate[2], 1e-12);
      assert_near(m->true_velocity[1], 0, 0.02); /* the rover drives forward and stays on the ground */
      assert_near(m->true_velocity[2], 0, 0.02);
    }
    assert_int_equal(cairn_pose_error(&step.truth, &pose, error, NULL), CAIRN_OK);
    for (axis = 0; axis < 6; ++axis) assert_near(error[axis], 0, 1e-5 * (double)k);
    pose = step.truth;
    assert_ok(cairn_world_pose(w, step.time, &pose, NULL));
    assert_memory_equal(&pose, &step.truth, sizeof pose);
  }
  cairn_world_destroy(w);
}

/* Without noise all measurements are true, for every composition of samples. */
static void without_noise(void** state) {
  int32_t accelerometer;
  (void)state;
  for (accelerometer = 0; accelerometer < 2; ++accelerometer) {
    cairn_world_options o = default_options();
    cairn_world* w;
    size_t k, i;
    int axis;
    o.velocity_sigma = o.rate_sigma = o.wheel_rate_sigma = o.wheel_slip_sigma = 0;
    o.accelerometer = accelerometer;
    w = open_world(&o);
    for (k = 0; k < 60; ++k) {
      const world_step step = next_step(w);
      for (i = 0; i < step.motion_count; ++i)
        for (axis = 0; axis < 3; ++axis) {
          assert_near(step.motions[i].velocity[axis], step.motions[i].true_velocity[axis], 1e-9);
          assert_near(step.motions[i].rate[axis], step.motions[i].true_rate[axis], 1e-9);
        }
      for (axis = 0; axis < 3; ++axis) assert_near(step.velocity_sigma[axis] + step.rate_sigma[axis], 0, 0);
    }
    cairn_world_destroy(w);
  }
}

/* Mean 0, the size that the step states, and independent samples. The bounds are 4 standard deviations of the estimate.
 * */
static void check_white(const tally* t, const tally* lagged, double size) {
  assert_near(tally_mean(t), 0, 4 * size / sqrt(t->count));
  assert_near(tally_sigma(t), size, 4 * size / sqrt(2 * t->count));
  assert_near(tally_mean(lagged) / (size * size), 0, 4 / sqrt(lagged->count));
}

static void motion_noise(void** state) {
  static const double periods[] = {0.05, 0.2, 1};
  size_t p;
  (void)state;
  for (p = 0; p < LENGTH(periods); ++p) {
    cairn_world_options o = default_options();
    cairn_world* w;
    tally t[6], lagged[6];
    double last[6] = {0, 0, 0, 0, 0, 0}, sigma[6];
    size_t k, i;
    int axis;
    memset(t, 0, sizeof t), memset(lagged, 0, sizeof lagged);
    o.motion_period = periods[p];
    o.seed = 11 + p;
    o.laps = 3;
    w = open_world(&o);
    for (k = 0; k < steps_of(w); ++k) {
      const world_step step = next_step(w);
      memcpy(sigma, step.velocity_sigma, sizeof step.velocity_sigma);
      memcpy(sigma + 3, step.rate_sigma, sizeof step.rate_sigma);
      for (i = 0; i < step.motion_count; ++i)
        for (axis = 0; axis < 6; ++axis) {
          const cairn_world_motion* m = &step.motions[i];
          const double e =
              axis < 3 ? m->velocity[axis] - m->true_velocity[axis] : m->rate[axis - 3] - m->true_rate[axis - 3];
          tally_add(&t[axis], e), tally_add(&lagged[axis], e * last[axis]);
          last[axis] = e;
        }
    }
    for (axis = 0; axis < 6; ++axis) {
      const double size = (axis < 3 ? 2e-3 : 0.02 * DEGREE) / sqrt(periods[p] / 0.05);
      assert_near(sigma[axis], size, 1e-12);
      check_white(&t[axis], &lagged[axis], size);
    }
    cairn_world_destroy(w);
  }
}

static void wheel_noise(void** state) {
  cairn_world_options o = default_options();
  cairn_world* w;
  tally left = {0, 0, 0}, right = {0, 0, 0}, both = {0, 0, 0}, forward = {0, 0, 0};
  size_t k, i;
  double stated = 0, rate = 0, size;
  (void)state;
  o.drive = CAIRN_DRIVE_WHEELS_GYRO;
  o.motion_period = o.imu_period;
  w = open_world(&o);
  for (k = 0; k < steps_of(w); ++k) {
    const world_step step = next_step(w);
    for (i = 0; i < step.motion_count; ++i) {
      const cairn_world_motion* m = &step.motions[i];
      const double l = m->wheels[0] - m->true_wheels[0], r = m->wheels[1] - m->true_wheels[1];
      tally_add(&left, l), tally_add(&right, r), tally_add(&both, l * r);
      tally_add(&forward, m->velocity[0] - m->true_velocity[0]);
      assert_near(m->velocity[0], 0.3 * (m->wheels[0] + m->wheels[1]) / 2, 1e-12);
      assert_near(m->velocity[1], 0, 0);
      assert_near(m->velocity[2], 0, 0);
      rate = m->true_wheels[0];
    }
    if (step.motion_count > 0) stated = step.velocity_sigma[0];
    assert_near(step.velocity_sigma[1], 0.01, 0);
  }
  size = hypot(0.01, 0.02 * rate);
  assert_near(tally_sigma(&left), size, 0.05 * size);
  assert_near(tally_sigma(&right), size, 0.05 * size);
  assert_near(tally_mean(&both) / (size * size), 0, 4 / sqrt(both.count));
  assert_near(tally_sigma(&forward), stated, 0.05 * stated);
  cairn_world_destroy(w);
}

/* With an accelerometer (m/s^2) the velocity drifts, by about as much as the step states. */
static void accelerometer_drifts(void** state) {
  tally early = {0, 0, 0}, late = {0, 0, 0};
  uint64_t seed;
  (void)state;
  for (seed = 1; seed <= 40; ++seed) {
    cairn_world_options o = default_options();
    cairn_world* w;
    size_t k, axis;
    o.accelerometer = CAIRN_ACCELEROMETER_ACCELERATION;
    o.seed = seed;
    w = open_world(&o);
    for (k = 0; k <= 150; ++k) {
      const world_step step = next_step(w);
      for (axis = 0; axis < 2; ++axis) {
        if (k != 10 && k != 150) continue;
        tally_add(k == 10 ? &early : &late,
                  (step.motions[9].velocity[axis] - step.motions[9].true_velocity[axis]) / step.velocity_sigma[axis]);
      }
    }
    cairn_world_destroy(w);
  }
  assert_between(tally_sigma(&early), 0.7, 1.3);
  assert_between(tally_sigma(&late), 0.7, 1.3);
}

/* Everything in the field of view is seen, and nothing else. The noise is that of Table 1. */
static void field_of_view_and_noise(void** state) {
  cairn_world_options o = default_options();
  cairn_world* w;
  cairn_stereo_head head;
  double* p;
  tally noise[3], cross = {0, 0, 0};
  size_t count, k, i, a;
  double seen_total = 0;
  (void)state;
  memset(noise, 0, sizeof noise);
  o.laps = 2;
  o.seed = 4;
  w = open_world(&o);
  head.struct_size = sizeof head;
  assert_ok(cairn_world_head(w, &head, NULL));
  assert_int_equal(head.encoder_mode, CAIRN_ENCODER_PER_OBSERVATION);
  p = (double*)malloc(200 * 3 * sizeof(double));
  assert_ok(cairn_world_landmarks(w, p, 200, &count, NULL));
  for (k = 0; k < steps_of(w); ++k) {
    const world_step step = next_step(w);
    size_t at = 0;
    assert_near(step.pan, 0, 0);
    assert_near(step.stick, 0, 0);
    for (i = 0; i < count && k > 0; ++i) {
      double m[3], range, azimuth, error[3];
      camera_point(&step.truth, &head, 0, 0, p + 3 * i, m);
      range = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]), azimuth = atan2(m[1], m[0]);
      if (range < 2 || range > 40 || fabs(azimuth) > 60 * DEGREE) continue;
      assert_true(at < step.observation_count);
      assert_int_equal(step.observations[at].id, i); /* by ascending id */
      error[0] = step.observations[at].z[0] - range, error[1] = remainder(step.observations[at].z[1] - azimuth, 2 * PI);
      error[2] = step.observations[at].z[2] - atan2(m[2], hypot(m[0], m[1]));
      for (a = 0; a < 3; ++a) tally_add(&noise[a], error[a]);
      tally_add(&cross, error[0] * error[1]);
      for (a = 0; a < 9; ++a) assert_near(step.observations[at].covariance[a], 0, 0);
      ++at;
    }
    assert_int_equal(at, step.observation_count);
    seen_total += (double)at;
  }
  assert_between(seen_total / 400, 8, 11); /* for each frame */
  check_white(&noise[0], &cross, 1);
  assert_near(tally_sigma(&noise[1]), 3 * DEGREE, 4 * 3 * DEGREE / sqrt(2 * noise[1].count));
  assert_near(tally_sigma(&noise[2]), 3 * DEGREE, 4 * 3 * DEGREE / sqrt(2 * noise[2].count));
  assert_near(head.range_sigma, 1, 0);
  assert_near(head.azimuth_sigma, 3 * DEGREE, 1e-15);
  assert_near(head.elevation_sigma, 3 * DEGREE, 1e-15);
  free(p);
  cairn_world_destroy(w);
}

/* A scanning head on a mast: observations are true for the camera at its place, and the field of view turns with it. */
static void scanning_head(void** state) {
  cairn_world_options o = default_options();
  cairn_world* w;
  cairn_stereo_head head;
  size_t k, i;
  double widest = 0, most_stick = 0;
  (void)state;
  o.pan_amplitude = 70 * DEGREE, o.stick_amplitude = 10 * DEGREE;
  o.platform[0] = 0.4, o.platform[2] = 1.1, o.stick[0] = 0.2, o.stick[2] = 0.3;
  o.range_sigma = o.azimuth_sigma = o.stick_sigma = 1e-9;
  w = open_world(&o);
  head.struct_size = sizeof head;
  assert_ok(cairn_world_head(w, &head, NULL));
  for (k = 0; k < 100; ++k) {
    const world_step step = next_step(w);
    assert_near(step.pan, 70 * DEGREE * sin(2 * PI * step.time / 20), 1e-12);
    assert_near(step.stick, 10 * DEGREE * sin(2 * PI * step.time / 26), 1e-12);
    if (fabs(step.stick) > most_stick) most_stick = fabs(step.stick);
    for (i = 0; i < step.observation_count; ++i) {
      const double* z = step.observations[i].z;
      double p[3], m[3], body[3];
      assert_ok(cairn_world_landmark(w, step.observations[i].id, p, NULL));
      camera_point(&step.truth, &head, step.pan, step.stick, p, m);
      assert_near(z[0] * cos(z[2]) * cos(z[1]), m[0], 1e-6);
      assert_near(z[0] * cos(z[2]) * sin(z[1]), m[1], 1e-6);
      assert_near(z[0] * sin(z[2]), m[2], 1e-6);
      assert_between(z[1], -60 * DEGREE - 1e-6, 60 * DEGREE + 1e-6);
      to_body(&step.truth, p, body);
      if (fabs(atan2(body[1], body[0])) > widest) widest = fabs(atan2(body[1], body[0]));
    }
  }
  assert_true(widest > 100 * DEGREE);
  assert_true(most_stick > 9 * DEGREE);
  cairn_world_destroy(w);
}

/* One error of the stick for each frame: all elevations of a frame are off by the same angle. */
static void stick_noise_of_a_frame(void** state) {
  cairn_world_options o = default_options();
  cairn_world* w;
  cairn_stereo_head head;
  tally frames = {0, 0, 0}, within = {0, 0, 0};
  size_t k, i;
  (void)state;
  o.stick_noise = CAIRN_STICK_PER_FRAME;
  o.half_azimuth = 20 * DEGREE; /* near the axis a rotation of the stick is a change of elevation */
  o.laps = 4;
  w = open_world(&o);
  head.struct_size = sizeof head;
  assert_ok(cairn_world_head(w, &head, NULL));
  assert_int_equal(head.encoder_mode, CAIRN_ENCODER_PER_FRAME);
  assert_near(head.stick_sigma, 3 * DEGREE, 1e-15);
  assert_near(head.elevation_sigma, 0.5 * DEGREE, 1e-15);
  for (k = 0; k < steps_of(w); ++k) {
    const world_step step = next_step(w);
    double mean = 0, error[64];
    for (i = 0; i < step.observation_count && i < 64; ++i) {
      double p[3], m[3];
      assert_ok(cairn_world_landmark(w, step.observations[i].id, p, NULL));
      camera_point(&step.truth, &head, step.pan, step.stick, p, m);
      error[i] = step.observations[i].z[2] - atan2(m[2], hypot(m[0], m[1]));
      mean += error[i] / (double)step.observation_count;
    }
    if (step.observation_count < 3) continue;
    tally_add(&frames, mean);
    for (i = 0; i < step.observation_count; ++i) tally_add(&within, error[i] - mean);
  }
  assert_between(tally_sigma(&frames), 2.7 * DEGREE, 3.3 * DEGREE);
  assert_between(tally_sigma(&within), 0.3 * DEGREE, 0.7 * DEGREE);
  cairn_world_destroy(w);
}

/* A change of one option leaves the draws of the others unchanged. */
static void draws_are_independent(void** state) {
  cairn_world_options o = default_options();
  cairn_world *a = open_world(&o), *b;
  size_t k, i;
  (void)state;
  o.observe_at_start = 1;
  o.velocity_sigma = 0;
  b = open_world(&o);
  for (k = 0; k < 50; ++k) {
    const world_step x = next_step(a), y = next_step(b);
    if (k == 0) assert_true(x.observation_count == 0 && y.observation_count > 0);
    if (k == 0) continue;
    assert_int_equal(x.observation_count, y.observation_count);
    for (i = 0; i < x.observation_count; ++i)
      assert_memory_equal(&x.observations[i], &y.observations[i], sizeof *x.observations);
    assert_near(x.motions[3].wheels[0], y.motions[3].wheels[0], 0);
  }
  cairn_world_destroy(a), cairn_world_destroy(b);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(true_motion_connects_the_true_poses),
      cmocka_unit_test(without_noise),
      cmocka_unit_test(motion_noise),
      cmocka_unit_test(wheel_noise),
      cmocka_unit_test(accelerometer_drifts),
      cmocka_unit_test(field_of_view_and_noise),
      cmocka_unit_test(scanning_head),
      cmocka_unit_test(stick_noise_of_a_frame),
      cmocka_unit_test(draws_are_independent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
