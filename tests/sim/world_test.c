/* SPDX-License-Identifier: BSD-3-Clause */
/* A world and its queries: the ground, the wheels on it, the drive step by step, and the rules that all calls follow.
 * */
#include "support.h"

static void null_and_bad_values_are_refused(void** state) {
  const cairn_world_options o = default_options();
  cairn_world* w = open_world(&o);
  cairn_world_step step;
  cairn_stereo_head head;
  cairn_wheels wheels;
  cairn_pose pose;
  double v[12];
  size_t n;
  (void)state;
  step.struct_size = sizeof step, head.struct_size = sizeof head, wheels.struct_size = sizeof wheels;
  assert_refused(cairn_world_next(NULL, &step, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_next(w, NULL, NULL), CAIRN_ERROR_ARGUMENT, "step");
  assert_refused(cairn_world_rewind(NULL, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_steps(NULL, &n, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_steps(w, NULL, NULL), CAIRN_ERROR_ARGUMENT, "steps");
  assert_refused(cairn_world_most_observations(w, NULL, NULL), CAIRN_ERROR_ARGUMENT, "count");
  assert_refused(cairn_world_most_observations(NULL, &n, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_head(NULL, &head, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_head(w, NULL, NULL), CAIRN_ERROR_ARGUMENT, "head");
  assert_refused(cairn_world_wheels(NULL, &wheels, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_wheels(w, NULL, NULL), CAIRN_ERROR_ARGUMENT, "wheels");
  assert_refused(cairn_world_pose(NULL, 0, &pose, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_pose(w, 0, NULL, NULL), CAIRN_ERROR_ARGUMENT, "pose");
  assert_refused(cairn_world_pose(w, -0.1, &pose, NULL), CAIRN_ERROR_ARGUMENT, "time");
  assert_refused(cairn_world_pose(w, 400.1, &pose, NULL), CAIRN_ERROR_ARGUMENT, "time");
  assert_refused(cairn_world_pose(w, NAN, &pose, NULL), CAIRN_ERROR_ARGUMENT, "time");
  assert_refused(cairn_world_contacts(NULL, 0, v, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_contacts(w, 0, NULL, NULL), CAIRN_ERROR_ARGUMENT, "points");
  assert_refused(cairn_world_contacts(w, 401, v, NULL), CAIRN_ERROR_ARGUMENT, "time");
  assert_refused(cairn_world_height(NULL, 0, 0, v, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_height(w, NAN, 0, v, NULL), CAIRN_ERROR_ARGUMENT, "x");
  assert_refused(cairn_world_height(w, 0, INFINITY, v, NULL), CAIRN_ERROR_ARGUMENT, "y");
  assert_refused(cairn_world_height(w, 0, 0, NULL, NULL), CAIRN_ERROR_ARGUMENT, "height");
  assert_refused(cairn_world_extent(NULL, v, v, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_extent(w, NULL, v, NULL), CAIRN_ERROR_ARGUMENT, "lower");
  assert_refused(cairn_world_extent(w, v, NULL, NULL), CAIRN_ERROR_ARGUMENT, "upper");
  assert_refused(cairn_world_landmark(NULL, 0, v, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_landmark(w, 0, NULL, NULL), CAIRN_ERROR_ARGUMENT, "position");
  assert_refused(cairn_world_landmark(w, 200, v, NULL), CAIRN_ERROR_NOT_FOUND, "id 200");
  assert_refused(cairn_world_landmark(w, CAIRN_ID_NONE, v, NULL), CAIRN_ERROR_NOT_FOUND, "id");
  assert_refused(cairn_world_landmarks(NULL, v, 4, &n, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_landmarks(w, v, 4, NULL, NULL), CAIRN_ERROR_ARGUMENT, "needed");
  assert_refused(cairn_world_motions(NULL, NULL, 0, &n, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_motions(w, NULL, 1, &n, NULL), CAIRN_ERROR_ARGUMENT, "motions");
  assert_refused(cairn_world_motions(w, NULL, 0, NULL, NULL), CAIRN_ERROR_ARGUMENT, "needed");
  assert_refused(cairn_world_observations(NULL, NULL, 0, &n, NULL), CAIRN_ERROR_ARGUMENT, "world");
  assert_refused(cairn_world_observations(w, NULL, 1, &n, NULL), CAIRN_ERROR_ARGUMENT, "observations");
  n = 0;
  assert_refused(cairn_world_landmarks(w, v, 4, &n, NULL), CAIRN_ERROR_BUFFER, "200");
  assert_int_equal(n, 200);
  cairn_world_destroy(w);
  cairn_world_destroy(NULL);
}

/* A failed call does not consume a step. A short struct gets only its part. */
static void sizes_of_step(void** state) {
  const cairn_world_options o = default_options();
  cairn_world* w = open_world(&o);
  unsigned char bytes[sizeof(cairn_world_step)];
  cairn_world_step step;
  const size_t old = offsetof(cairn_world_step, truth);
  const uint32_t size = (uint32_t)old, wrong = 4;
  uint64_t number;
  size_t i;
  (void)state;
  memset(bytes, 0x5a, sizeof bytes);
  memcpy(&step, bytes, sizeof step);
  step.struct_size = wrong;
  assert_refused(cairn_world_next(w, &step, NULL), CAIRN_ERROR_ARGUMENT, "step");
  step.struct_size = size;
  assert_ok(cairn_world_next(w, &step, NULL));
  assert_int_equal(step.number, 0);
  memcpy(bytes, &step, sizeof step);
  for (i = old; i < sizeof bytes; ++i) assert_int_equal(bytes[i], 0x5a);
  number = next_step(w).number;
  assert_int_equal(number, 1);
  cairn_world_destroy(w);
}

static void the_end_and_rewind(void** state) {
  const cairn_world_options o = default_options();
  cairn_world* w = open_world(&o);
  const size_t steps = steps_of(w);
  world_step step;
  cairn_world_step beyond = {0};
  cairn_observation first[3];
  double velocity[3];
  size_t k;
  (void)state;
  assert_int_equal(steps, 201);
  step = next_step(w);
  assert_int_equal(step.motion_count, 0);
  assert_int_equal(step.observation_count, 0);
  step = next_step(w);
  assert_true(step.observation_count >= 3);
  memcpy(first, step.observations, sizeof first);
  memcpy(velocity, step.motions[9].velocity, sizeof velocity);
  for (k = 2; k < steps; ++k) {
    step = next_step(w);
    assert_int_equal(step.number, k);
    assert_near(step.time, 2.0 * (double)k, 1e-12);
    assert_int_equal(step.motion_count, 10);
  }
  beyond.struct_size = sizeof beyond;
  assert_refused(cairn_world_next(w, &beyond, NULL), CAIRN_ERROR_STATE, "201 steps");
  assert_refused(cairn_world_next(w, &beyond, NULL), CAIRN_ERROR_STATE, "201 steps");
  assert_ok(cairn_world_motions(w, NULL, 0, &k, NULL)); /* the last step is still there */
  assert_int_equal(k, 10);
  assert_ok(cairn_world_rewind(w, NULL));
  assert_ok(cairn_world_motions(w, NULL, 0, &k, NULL));
  assert_int_equal(k, 0);
  assert_ok(cairn_world_observations(w, NULL, 0, &k, NULL));
  assert_int_equal(k, 0);
  next_step(w);
  step = next_step(w);
  assert_memory_equal(step.observations, first, sizeof first);
  assert_memory_equal(step.motions[9].velocity, velocity, sizeof velocity);
  cairn_world_destroy(w);
}

/* Two worlds with the same seed give the same bytes; different seeds give different bytes. */
static void deterministic(void** state) {
  static const int32_t courses[] = {CAIRN_COURSE_CIRCLE, CAIRN_COURSE_LAPS, CAIRN_COURSE_TRAVERSE};
  size_t c, k, i;
  (void)state;
  for (c = 0; c < LENGTH(courses); ++c) {
    cairn_world_options o = default_options();
    cairn_world *a, *b, *other;
    bool differs = false;
    o.course = courses[c], o.seed = 5;
    a = open_world(&o), b = open_world(&o);
    o.seed = 6;
    other = open_world(&o);
    for (k = 0; k < steps_of(a); ++k) {
      const world_step x = next_step(a), y = next_step(b);
      assert_memory_equal(&x.truth, &y.truth, sizeof x.truth);
      assert_int_equal(x.motion_count, y.motion_count);
      for (i = 0; i < x.motion_count; ++i) assert_memory_equal(&x.motions[i], &y.motions[i], sizeof x.motions[i]);
      assert_int_equal(x.observation_count, y.observation_count);
      for (i = 0; i < x.observation_count; ++i)
        assert_memory_equal(&x.observations[i], &y.observations[i], sizeof x.observations[i]);
      if (k < 50) {
        const world_step z = next_step(other);
        if (z.motion_count > 0 && z.motions[0].rate[0] != x.motions[0].rate[0]) differs = true;
      }
    }
    assert_true(differs);
    cairn_world_destroy(a), cairn_world_destroy(b), cairn_world_destroy(other);
  }
}

/* The draws are pinned, so that another compiler or machine cannot change the worlds unnoticed. An independent program
 * computed the values (Python: SplitMix64 and the polar method written out). */
static void draws_are_pinned(void** state) {
  cairn_world_options o = default_options();
  cairn_world* w;
  world_step step;
  double position[3];
  (void)state;
  o.terrain = CAIRN_TERRAIN_FLAT;
  o.landmark_height = 1;
  o.motion_period = o.imu_period;
  o.rate_sigma = 1;
  w = open_world(&o);
  assert_ok(cairn_world_landmark(w, 0, position, NULL));
  assert_near(position[2], 0.7072563490833963, 0);
  assert_near(hypot(position[0], position[1]), 98.20688325407642, 1e-12);
  next_step(w);
  step = next_step(w);
  assert_near(step.motions[0].rate[0], 1.6390710571589302, 1e-13); /* the ground is flat: only noise remains */
  assert_near(step.motions[0].rate[1], -0.2439869727027117, 1e-13);
  cairn_world_destroy(w);
}

static double slope_of(const cairn_world* w, double x, double y) {
  const double h = 1e-4;
  double a, b, c, d;
  assert_ok(cairn_world_height(w, x - h, y, &a, NULL));
  assert_ok(cairn_world_height(w, x + h, y, &b, NULL));
  assert_ok(cairn_world_height(w, x, y - h, &c, NULL));
  assert_ok(cairn_world_height(w, x, y + h, &d, NULL));
  return hypot(b - a, d - c) / (2 * h);
}

static void rolling_ground(void** state) {
  uint64_t seed;
  (void)state;
  for (seed = 1; seed <= 5; ++seed) {
    cairn_world_options o = default_options();
    cairn_world* w;
    double height, steepest = 0;
    int i;
    o.seed = seed;
    w = open_world(&o);
    assert_ok(cairn_world_height(w, 100, 20, &height, NULL));
    assert_near(height, -0.3174, 1e-12);
    for (i = 0; i < 20000; ++i) {
      const double slope = slope_of(w, -300 + 6.1 * (i % 100), -300 + 3.07 * (i / 100));
      if (slope > steepest) steepest = slope;
    }
    assert_between(atan(steepest), 4 * DEGREE, 15 * DEGREE); /* rolling ground, nowhere steeper than max_slope */
    cairn_world_destroy(w);
  }
}

static void other_grounds(void** state) {
  cairn_world_options o = default_options();
  cairn_world* w;
  double height;
  (void)state;
  o.terrain = CAIRN_TERRAIN_WAVES;
  w = open_world(&o);
  assert_ok(cairn_world_height(w, 31, -17, &height, NULL));
  assert_near(height, sin(31.0 / 15) + 0.8 * cos(-17.0 / 12), 1e-15);
  cairn_world_destroy(w);
  o.terrain = CAIRN_TERRAIN_FLAT;
  w = open_world(&o);
  assert_ok(cairn_world_height(w, 31, -17, &height, NULL));
  assert_near(height, 0, 0);
  cairn_world_destroy(w);
}

/* All four wheels touch the ground. In the body frame they stand at the corners, shifted by the rockers and their
 * differential. */
static void wheels_touch_the_ground(void** state) {
  cairn_world_options o = default_options();
  cairn_world* w;
  double deepest = 0;
  int k, i;
  (void)state;
  o.wavelength[0] = 6; /* rough enough to matter */
  o.track = 1.4, o.wheelbase = 2;
  w = open_world(&o);
  for (k = 0; k <= 400; ++k) {
    double points[12], give[4];
    cairn_pose pose;
    assert_ok(cairn_world_contacts(w, k, points, NULL));
    assert_ok(cairn_world_pose(w, k, &pose, NULL));
    for (i = 0; i < 4; ++i) {
      double height, body[3];
      assert_ok(cairn_world_height(w, points[3 * i], points[3 * i + 1], &height, NULL));
      assert_near(points[3 * i + 2], height, 1e-9);
      to_body(&pose, points + 3 * i, body);
      assert_near(body[0], i < 2 ? 1 : -1, 1e-9);
      assert_near(body[1], i % 2 == 0 ? 0.7 : -0.7, 1e-9);
      give[i] = body[2];
    }
    assert_near(give[0], -give[1], 1e-9);
    assert_near(give[0], -give[2], 1e-9);
    assert_near(give[0], give[3], 1e-9);
    if (fabs(give[0]) > deepest) deepest = fabs(give[0]);
  }
  assert_between(deepest, 1e-3, 0.5);
  cairn_world_destroy(w);
}

/* The smaller the rover, the more it agrees with a rover on one point, whose z axis is the normal of the ground. */
static void small_rover_stands_on_a_point(void** state) {
  cairn_world_options o = default_options();
  cairn_world *wheels, *point;
  double points[12];
  int k, i;
  (void)state;
  o.track = o.wheelbase = 1e-3;
  wheels = open_world(&o);
  o.contact = CAIRN_CONTACT_POINT;
  point = open_world(&o);
  for (k = 0; k < 400; k += 13) {
    cairn_pose a, b;
    double error[6];
    assert_ok(cairn_world_pose(wheels, k, &a, NULL));
    assert_ok(cairn_world_pose(point, k, &b, NULL));
    assert_int_equal(cairn_pose_error(&a, &b, error, NULL), CAIRN_OK);
    for (i = 0; i < 6; ++i) assert_near(error[i], 0, 1e-6);
  }
  assert_refused(cairn_world_contacts(point, 0, points, NULL), CAIRN_ERROR_STATE, "CAIRN_CONTACT_POINT");
  cairn_world_destroy(wheels), cairn_world_destroy(point);
}

/* Ground as steep as the options allow, with waves hardly longer than the rover. */
static void rough_ground(void** state) {
  cairn_world_options o = default_options();
  cairn_world* w;
  double deepest = 0;
  int k, i;
  (void)state;
  o.wavelength[0] = 1, o.wavelength[1] = 2;
  o.max_slope = 45 * DEGREE;
  w = open_world(&o);
  for (k = 0; k <= 400; ++k) {
    double points[12];
    assert_ok(cairn_world_contacts(w, k, points, NULL));
    for (i = 0; i < 4; ++i) {
      double height;
      assert_ok(cairn_world_height(w, points[3 * i], points[3 * i + 1], &height, NULL));
      assert_near(points[3 * i + 2], height, 1e-9);
      if (fabs(height - points[2]) > deepest) deepest = fabs(height - points[2]);
    }
  }
  assert_true(deepest > 0.1);
  cairn_world_destroy(w);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(null_and_bad_values_are_refused),
      cmocka_unit_test(sizes_of_step),
      cmocka_unit_test(the_end_and_rewind),
      cmocka_unit_test(deterministic),
      cmocka_unit_test(draws_are_pinned),
      cmocka_unit_test(rolling_ground),
      cmocka_unit_test(other_grounds),
      cmocka_unit_test(wheels_touch_the_ground),
      cmocka_unit_test(small_rover_stands_on_a_point),
      cmocka_unit_test(rough_ground),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
