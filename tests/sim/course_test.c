/* SPDX-License-Identifier: BSD-3-Clause */
/* Courses: their geometry, their smoothness, and the distribution of the landmarks along them. */
#include "support.h"

static cairn_world_options course_options(int32_t course, uint32_t landmarks) {
  cairn_world_options o = default_options();
  o.course = course;
  o.landmarks = landmarks;
  o.terrain = CAIRN_TERRAIN_FLAT;
  return o;
}

static double end_of(const cairn_world* w) {
  return 2.0 * (double)(steps_of(w) - 1);
}

static double yaw_of(const cairn_pose* pose) {
  double roll, pitch, yaw;
  assert_int_equal(cairn_quaternion_to_euler(pose->quaternion, &roll, &pitch, &yaw, NULL), CAIRN_OK);
  return yaw;
}

/* Constant speed, heading along the course, no corners. */
static void check_smooth(const cairn_world* w, double speed, double sharpest) {
  const double dt = 0.01, end = end_of(w);
  double t;
  for (t = 1; t < end - 1; t += 3.7) {
    cairn_pose a, b;
    double dx, dy;
    assert_ok(cairn_world_pose(w, t, &a, NULL));
    assert_ok(cairn_world_pose(w, t + dt, &b, NULL));
    dx = b.position[0] - a.position[0], dy = b.position[1] - a.position[1];
    assert_near(hypot(dx, dy), speed * dt, 1e-6 * speed * dt + speed * dt * pow(speed * dt / sharpest, 2));
    assert_near(remainder(atan2(dy, dx) - yaw_of(&a), 2 * PI), 0, 1.01 * speed * dt / (2 * sharpest) + 1e-6);
  }
}

static void the_papers_circle(void** state) {
  cairn_world_options o = course_options(CAIRN_COURSE_CIRCLE, 200);
  cairn_world* w = open_world(&o);
  cairn_pose pose;
  double t;
  (void)state;
  assert_ok(cairn_world_pose(w, 0, &pose, NULL));
  assert_near(pose.position[0], 100, 1e-9);
  assert_near(pose.position[1], 20, 1e-9);
  assert_near(yaw_of(&pose), atan2(20, 100) + PI / 2, 1e-9);
  for (t = 0; t <= 400; t += 7) {
    assert_ok(cairn_world_pose(w, t, &pose, NULL));
    assert_near(hypot(pose.position[0], pose.position[1]), hypot(100, 20), 1e-9);
  }
  assert_ok(cairn_world_pose(w, 400, &pose, NULL));
  assert_near(pose.position[0], 100, 1e-6);
  assert_near(pose.position[1], 20, 1e-6);
  check_smooth(w, o.speed, 100);
  cairn_world_destroy(w);
  o.centre[0] = 7, o.centre[1] = -3, o.radius = 50, o.start_azimuth = 0, o.laps = 2.5, o.speed = 2;
  w = open_world(&o);
  assert_int_equal(steps_of(w), (size_t)(2.5 * 2 * PI * 50 / 2 / 2) + 1);
  assert_ok(cairn_world_pose(w, 0, &pose, NULL));
  assert_near(pose.position[0], 57, 1e-9);
  assert_near(pose.position[1], -3, 1e-9);
  cairn_world_destroy(w);
}

/* The scene of the preset rows: ground, radius, and an attitude that follows the normal of the ground. */
static void the_rows_scene(void** state) {
  const cairn_world_options o = preset_options(CAIRN_PRESET_ROW3);
  cairn_world* w = open_world(&o);
  cairn_pose pose;
  double azimuth, x, y, landmark[3], normal[3] = {0, 0, 1}, inverse[3];
  size_t i;
  (void)state;
  assert_int_equal(steps_of(w), 201);
  assert_ok(cairn_world_pose(w, 50, &pose, NULL));
  azimuth = atan2(20, 100) + 2 * 2 * PI * 50 / 400;
  x = 101.98 * cos(azimuth), y = 101.98 * sin(azimuth);
  assert_near(pose.position[0], x, 1e-9);
  assert_near(pose.position[1], y, 1e-9);
  assert_near(pose.position[2], sin(x / 15) + 0.8 * cos(y / 12), 1e-12);
  normal[0] = pose.position[0] - cos(x / 15) / 15, normal[1] = pose.position[1] + 0.8 * sin(y / 12) / 12;
  normal[2] = pose.position[2] + 1;
  to_body(&pose, normal, inverse); /* the normal of the ground is the z axis of the body */
  assert_near(inverse[0], 0, 1e-12);
  assert_near(inverse[1], 0, 1e-12);
  for (i = 0; i < 200; ++i) {
    assert_ok(cairn_world_landmark(w, i, landmark, NULL));
    assert_between(hypot(landmark[0], landmark[1]), 101.98 - 25, 101.98 + 25);
    assert_between(landmark[2] - sin(landmark[0] / 15) - 0.8 * cos(landmark[1] / 12), 0, 1.5);
  }
  cairn_world_destroy(w);
}

/* Distance of each landmark from the course, and the area that the strip covers, by a raster. */
typedef struct coverage {
  double farthest, area, per_landmark_least, per_landmark_most;
} coverage;

#define CELL 2.5
static coverage measure(const cairn_world* w, double speed) {
  coverage c = {0, 0, 0, 0};
  double lower[2], upper[2], end = end_of(w), t;
  long columns, rows, i, cells = 0;
  unsigned char* covered;
  double* positions;
  size_t count, k;
  assert_ok(cairn_world_extent(w, lower, upper, NULL));
  for (i = 0; i < 2; ++i) lower[i] -= 30, upper[i] += 30;
  columns = (long)((upper[0] - lower[0]) / CELL) + 1, rows = (long)((upper[1] - lower[1]) / CELL) + 1;
  covered = (unsigned char*)calloc((size_t)(columns * rows), 1);
  assert_non_null(covered);
  for (t = 0; t <= end; t += CELL / 2 / speed) {
    cairn_pose pose;
    long cx, cy, x, y;
    assert_ok(cairn_world_pose(w, t, &pose, NULL));
    cx = (long)((pose.position[0] - lower[0]) / CELL), cy = (long)((pose.position[1] - lower[1]) / CELL);
    for (y = cy - 11; y <= cy + 11; ++y)
      for (x = cx - 11; x <= cx + 11; ++x) {
        const double dx = lower[0] + (x + 0.5) * CELL - pose.position[0],
                     dy = lower[1] + (y + 0.5) * CELL - pose.position[1];
        if (x < 0 || y < 0 || x >= columns || y >= rows || dx * dx + dy * dy > 25 * 25) continue;
        covered[y * columns + x] = 1;
      }
  }
  for (i = 0; i < columns * rows; ++i) cells += covered[i];
  c.area = (double)cells * CELL * CELL;
  assert_ok(cairn_world_landmarks(w, NULL, 0, &count, NULL));
  positions = (double*)malloc(count * 3 * sizeof(double));
  assert_non_null(positions);
  assert_ok(cairn_world_landmarks(w, positions, count, &count, NULL));
  /* all landmarks lie in the strip, up to the edge of the raster */
  for (k = 0, cells = 0; k < count; ++k) {
    const long x = (long)((positions[3 * k] - lower[0]) / CELL), y = (long)((positions[3 * k + 1] - lower[1]) / CELL);
    cells += covered[y * columns + x];
  }
  c.farthest = 1 - (double)cells / (double)count; /* share of landmarks outside */
  /* uniformity by chi-square over pieces of the raster with about 20 landmarks each */
  {
    const long piece = 24;
    const long pc = columns / piece + 1, pr = rows / piece + 1;
    double *ground = (double*)calloc((size_t)(pc * pr), sizeof(double)),
           *seen = (double*)calloc((size_t)(pc * pr), sizeof(double));
    double statistic = 0, pieces = 0;
    const double density = (double)count / c.area;
    for (i = 0; i < columns * rows; ++i)
      ground[(i / columns / piece) * pc + i % columns / piece] += covered[i] * CELL * CELL;
    for (k = 0; k < count; ++k) {
      const long x = (long)((positions[3 * k] - lower[0]) / CELL), y = (long)((positions[3 * k + 1] - lower[1]) / CELL);
      seen[(y / piece) * pc + x / piece] += 1;
    }
    for (i = 0; i < pc * pr; ++i) {
      const double expected = ground[i] * density;
      if (expected < 5) continue;
      statistic += (seen[i] - expected) * (seen[i] - expected) / expected, pieces += 1;
    }
    c.per_landmark_most = statistic / pieces; /* about 1 for a uniform random distribution */
    free(ground), free(seen);
  }
  free(covered), free(positions);
  return c;
}

/* The requested number of landmarks, one for each 160 m^2 of the strip, uniformly. */
static void constant_density(void** state) {
  static const struct {
    int32_t course;
    uint32_t landmarks, closed;
  } cases[] = {{CAIRN_COURSE_LAPS, 200, 0},      {CAIRN_COURSE_LAPS, 3000, 0},     {CAIRN_COURSE_TRAVERSE, 300, 0},
               {CAIRN_COURSE_TRAVERSE, 1500, 0}, {CAIRN_COURSE_TRAVERSE, 6000, 0}, {CAIRN_COURSE_TRAVERSE, 8000, 1}};
  size_t i;
  (void)state;
  for (i = 0; i < LENGTH(cases); ++i) {
    cairn_world_options o = course_options(cases[i].course, cases[i].landmarks);
    cairn_world* w;
    coverage c;
    o.traverse_closed = cases[i].closed;
    o.seed = 3 + i;
    w = open_world(&o);
    c = measure(w, o.speed);
    assert_near(c.area / cases[i].landmarks, 160, 4);
    assert_between(c.farthest, 0, 0.04); /* the edge of the raster */
    assert_between(c.per_landmark_most, 0.6, 1.5);
    cairn_world_destroy(w);
  }
}

static void laps_close_and_repeat(void** state) {
  uint64_t seed;
  (void)state;
  for (seed = 1; seed <= 4; ++seed) {
    cairn_world_options o = course_options(CAIRN_COURSE_LAPS, 500);
    cairn_world* w;
    cairn_pose start, half, pose;
    double lap, least = 1e9, most = 0, t;
    o.seed = seed;
    w = open_world(&o);
    lap = 500 * 160 / 50.0 / o.speed;
    assert_near(end_of(w), 2 * lap, 2);
    assert_ok(cairn_world_pose(w, 0, &start, NULL));
    assert_near(start.position[0], 100, 1e-9);
    assert_near(start.position[1], 20, 1e-9);
    assert_ok(cairn_world_pose(w, lap, &half, NULL));
    assert_near(half.position[0], 100, 1e-5);
    assert_near(half.position[1], 20, 1e-5);
    assert_near(remainder(yaw_of(&half) - yaw_of(&start), 2 * PI), 0, 1e-6);
    check_smooth(w, o.speed, 60);
    for (t = 0; t < lap; t += 5) { /* the course has bends: its curvature is not constant */
      cairn_pose next;
      double bend;
      assert_ok(cairn_world_pose(w, t, &pose, NULL));
      assert_ok(cairn_world_pose(w, t + 1, &next, NULL));
      bend = remainder(yaw_of(&next) - yaw_of(&pose), 2 * PI) / o.speed;
      if (bend < least) least = bend;
      if (bend > most) most = bend;
    }
    assert_true(most > 1.3 * least);
    cairn_world_destroy(w);
  }
}

/* Circles are driven left and right alternately, one and a quarter rounds each. */
static void traverse_turns_by_turns(void** state) {
  cairn_world_options o = course_options(CAIRN_COURSE_TRAVERSE, 2400);
  cairn_world* w = open_world(&o);
  double turned = 0, travelled = 0, t;
  int rounds = 0, sense = 1;
  cairn_pose a, b;
  (void)state;
  check_smooth(w, o.speed, 150);
  assert_ok(cairn_world_pose(w, 0, &a, NULL));
  assert_near(a.position[0], 100, 1e-9);
  assert_near(a.position[1], 20, 1e-9);
  for (t = 0.5; t < end_of(w); t += 0.5) {
    double bend;
    assert_ok(cairn_world_pose(w, t, &b, NULL));
    bend = remainder(yaw_of(&b) - yaw_of(&a), 2 * PI);
    if (bend * sense < 0) { /* on to the next circle */
      assert_near(turned, sense * 2.5 * PI, 0.02);
      assert_between(travelled / 1.25, 1500 * 0.8, 1500 * 1.25);
      travelled = 0, turned = 0, sense = -sense, ++rounds;
    }
    turned += bend, travelled += 0.5 * o.speed, a = b;
  }
  assert_near(turned, sense * 2.5 * PI, 0.03);
  assert_int_equal(rounds + 1, 5); /* 2400 landmarks: 384000 m^2 in circles of 75000 */
  cairn_world_destroy(w);
}

static void closed_traverse_comes_home(void** state) {
  uint64_t seed;
  (void)state;
  for (seed = 1; seed <= 3; ++seed) {
    cairn_world_options o = course_options(CAIRN_COURSE_TRAVERSE, 9000);
    cairn_world* w;
    cairn_pose start, end;
    double lower[2], upper[2];
    o.seed = seed;
    o.traverse_closed = 1;
    w = open_world(&o);
    check_smooth(w, o.speed, 100);
    assert_ok(cairn_world_pose(w, 0, &start, NULL));
    assert_ok(cairn_world_pose(w, end_of(w), &end, NULL));
    /* the last step may end before the course does, by less than the distance of one frame */
    assert_between(hypot(end.position[0] - start.position[0], end.position[1] - start.position[1]), 0, 2.01 * o.speed);
    assert_ok(cairn_world_extent(w, lower, upper, NULL));
    assert_between((upper[0] - lower[0]) / (upper[1] - lower[1]), 0.7, 1.4); /* a ring, not a line */
    cairn_world_destroy(w);
  }
}

static void extent_holds_everything(void** state) {
  cairn_world_options o = course_options(CAIRN_COURSE_LAPS, 400);
  cairn_world* w = open_world(&o);
  double lower[2], upper[2], p[3];
  uint64_t i;
  (void)state;
  assert_ok(cairn_world_extent(w, lower, upper, NULL));
  for (i = 0; i < 400; ++i) {
    assert_ok(cairn_world_landmark(w, i, p, NULL));
    assert_between(p[0], lower[0], upper[0]);
    assert_between(p[1], lower[1], upper[1]);
  }
  cairn_world_destroy(w);
}

/* A world with very few landmarks works too. */
static void few_landmarks(void** state) {
  static const uint32_t counts[] = {1, 2, 10, 60};
  int32_t course;
  size_t i;
  (void)state;
  for (course = 0; course < 3; ++course)
    for (i = 0; i < LENGTH(counts); ++i) {
      const cairn_world_options o = course_options(course, counts[i]);
      cairn_world* w = open_world(&o);
      size_t k, most;
      assert_ok(cairn_world_most_observations(w, &most, NULL));
      assert_between((double)most, 1, counts[i]);
      for (k = steps_of(w); k > 0; --k) assert_true(next_step(w).observation_count <= most);
      cairn_world_destroy(w);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_papers_circle),       cmocka_unit_test(the_rows_scene),
      cmocka_unit_test(constant_density),        cmocka_unit_test(laps_close_and_repeat),
      cmocka_unit_test(traverse_turns_by_turns), cmocka_unit_test(closed_traverse_comes_home),
      cmocka_unit_test(extent_holds_everything), cmocka_unit_test(few_landmarks),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
