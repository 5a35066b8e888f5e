/* SPDX-License-Identifier: BSD-3-Clause */
/* Queries of the map compared with a plain scan over all landmarks, buffers of wrong size, joint covariances. */
#include "support.h"

enum { MANY = 60 };

/* A map of many landmarks on a grid, so that distances tie. The ids are in random order. */
typedef struct atlas {
  rig rig;
  const cairn_map* map;
  cairn_landmark all[MANY];
  size_t size;
} atlas;

static int setup(void** state) {
  atlas* a = calloc(1, sizeof *a);
  cairn_filter_options options = test_options();
  assert_non_null(a);
  options.max_landmarks = MANY, options.max_observations = MANY;
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  options.initial_pose = pose_at(0, 0, 0, 0, 0, 0);
  rig_open(&a->rig, &options);
  cairn_observation o[MANY];
  memset(o, 0, sizeof o);
  for (int i = 0; i < MANY; ++i) {
    o[i].id = ((uint64_t)i * 37 + 11) % 61 * (i % 3 == 0 ? UINT64_C(1000000007) : 1) + (uint64_t)(i % 3) * 100;
    o[i].z[0] = i % 5 - 2, o[i].z[1] = i / 5 % 4 - 1.5, o[i].z[2] = i / 20 - 1;
  }
  o[8].id = CAIRN_ID_NONE - 1; /* o[3] has id 0: the smallest and the largest id */
  assert_ok(cairn_filter_update(a->rig.filter, a->rig.sensors[CARTESIAN], o, MANY / 2, NULL, NULL));
  assert_ok(cairn_filter_predict_wheels(a->rig.filter, 0.1, 0, 0, NULL));
  assert_ok(cairn_filter_update(a->rig.filter, a->rig.sensors[CARTESIAN], o + MANY / 2, MANY / 2, NULL, NULL));
  a->map = cairn_filter_map(a->rig.filter);
  assert_ok(cairn_map_landmarks(a->map, a->all, MANY, &a->size, NULL));
  assert_int_equal(a->size, MANY);
  *state = a;
  return 0;
}

static int teardown(void** state) {
  atlas* a = *state;
  rig_close(&a->rig);
  free(a);
  return 0;
}

static void landmarks_come_by_ascending_id(void** state) {
  const atlas* a = *state;
  size_t count = 0;
  assert_ok(cairn_map_size(a->map, &count, NULL));
  assert_int_equal(count, MANY);
  for (size_t i = 1; i < a->size; ++i) assert_true(a->all[i - 1].id < a->all[i].id);
  assert_true(a->all[0].id == 0 && a->all[MANY - 1].id == CAIRN_ID_NONE - 1);
  for (size_t i = 0; i < a->size; ++i) {
    cairn_landmark one;
    assert_ok(cairn_map_landmark(a->map, a->all[i].id, &one, NULL));
    assert_memory_equal(&one, &a->all[i], sizeof one);
    for (int k = 0; k < 9; ++k) assert_true(one.covariance[k] == one.covariance[3 * (k % 3) + k / 3]);
    for (int k = 0; k < 3; ++k) assert_true(one.covariance[4 * k] > 0);
  }
}

/* The plain scan. */
typedef struct found {
  double square;
  cairn_landmark landmark;
} found;

static int by_distance(const void* a, const void* b) {
  const found *x = a, *y = b;
  if (x->square != y->square) return x->square < y->square ? -1 : 1;
  return x->landmark.id < y->landmark.id ? -1 : x->landmark.id > y->landmark.id;
}

static size_t scan(const atlas* a, const double centre[3], found out[MANY]) {
  for (size_t i = 0; i < a->size; ++i) {
    double d[3];
    for (int k = 0; k < 3; ++k) d[k] = a->all[i].position[k] - centre[k];
    out[i].square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    out[i].landmark = a->all[i];
  }
  qsort(out, a->size, sizeof out[0], by_distance);
  return a->size;
}

/* The scan may order distances that differ only by rounding either way. The order rule of the query is checked exactly.
 * */
static void expect_nearest_first(const cairn_landmark* got, size_t n, const double centre[3], const found* expected) {
  double last = -1;
  for (size_t i = 0; i < n; ++i) {
    double square = 0;
    for (int k = 0; k < 3; ++k) square += pow(got[i].position[k] - centre[k], 2);
    assert_near(square, expected[i].square, 1e-9);
    assert_true(square > last - 1e-9);
    last = square;
    for (size_t j = 0; j < i; ++j) assert_true(got[j].id != got[i].id);
  }
}

static void within_is_the_scan_cut_at_the_radius(void** state) {
  const atlas* a = *state;
  generator random = {12};
  for (int n = 0; n < 300; ++n) {
    const double centre[3] = {random_uniform(&random, -3, 3), random_uniform(&random, -3, 3),
                              random_uniform(&random, -2, 2)};
    const double radius = random_uniform(&random, 0, 4);
    cairn_landmark got[MANY];
    found expected[MANY];
    size_t needed = 4711, count = 0;
    (void)scan(a, centre, expected);
    while (count < MANY && expected[count].square <= radius * radius) ++count;
    assert_ok(cairn_map_within(a->map, centre, radius, got, MANY, &needed, NULL));
    assert_int_equal(needed, count);
    for (size_t i = 0; i < count; ++i) assert_memory_equal(&got[i], &expected[i].landmark, sizeof got[i]);
  }
}

static void nearest_is_the_scan_cut_at_the_count(void** state) {
  const atlas* a = *state;
  generator random = {13};
  for (int n = 0; n < 300; ++n) {
    const double point[3] = {random_uniform(&random, -3, 3), random_uniform(&random, -3, 3),
                             random_uniform(&random, -2, 2)};
    const size_t count = (size_t)random_uniform(&random, 0, MANY + 20);
    cairn_landmark got[MANY];
    found expected[MANY];
    size_t needed = 4711;
    (void)scan(a, point, expected);
    assert_ok(cairn_map_nearest(a->map, point, count, got, MANY, &needed, NULL));
    assert_int_equal(needed, count < MANY ? count : MANY);
    for (size_t i = 0; i < needed; ++i) assert_memory_equal(&got[i], &expected[i].landmark, sizeof got[i]);
  }
  size_t needed = 4711;
  const double far[3] = {1e6, -1e6, 1e6};
  cairn_landmark one;
  assert_ok(cairn_map_nearest(a->map, far, 1, &one, 1, &needed, NULL));
  assert_int_equal(needed, 1);
  assert_ok(cairn_map_nearest(a->map, far, SIZE_MAX, NULL, 0, &needed, NULL));
  assert_int_equal(needed, MANY);
}

/* A landmark whose own position is queried comes first, and is the only one within radius 0. Two landmarks at one place
 * are ordered by id. */
static void ties_come_by_id(void** state) {
  const atlas* a = *state;
  cairn_landmark got[MANY];
  found expected[MANY];
  size_t needed;
  for (size_t i = 0; i < a->size; ++i) {
    assert_ok(cairn_map_within(a->map, a->all[i].position, 0, got, MANY, &needed, NULL));
    assert_int_equal(needed, 1);
    assert_int_equal(got[0].id, a->all[i].id);
  }
  const double centre[3] = {0, 0, 0}; /* the grid is symmetric about this point */
  (void)scan(a, centre, expected);
  assert_ok(cairn_map_nearest(a->map, centre, MANY, got, MANY, &needed, NULL));
  expect_nearest_first(got, needed, centre, expected);
  size_t ties = 0;
  for (size_t i = 1; i < needed; ++i) {
    double s[2] = {0, 0};
    for (int k = 0; k < 3; ++k) s[0] += pow(got[i - 1].position[k], 2), s[1] += pow(got[i].position[k], 2);
    if (s[0] != s[1]) continue;
    assert_true(got[i - 1].id < got[i].id);
    ++ties;
  }
  assert_true(ties > 5);
}

static void in_box_is_the_scan_by_id(void** state) {
  const atlas* a = *state;
  generator random = {14};
  for (int n = 0; n < 300; ++n) {
    double lower[3], upper[3];
    cairn_landmark got[MANY];
    size_t needed = 4711, count = 0;
    for (int k = 0; k < 3; ++k) {
      lower[k] = random_uniform(&random, -3, 2), upper[k] = lower[k] + random_uniform(&random, 0, 4);
      if (n % 10 == 0)
        lower[k] = a->all[n % MANY].position[k], upper[k] = a->all[(n + 7) % MANY].position[k]; /* closed intervals */
      if (lower[k] > upper[k]) upper[k] = lower[k];
    }
    assert_ok(cairn_map_in_box(a->map, lower, upper, got, MANY, &needed, NULL));
    for (size_t i = 0; i < a->size; ++i) {
      bool inside = true;
      for (int k = 0; k < 3; ++k) inside &= lower[k] <= a->all[i].position[k] && a->all[i].position[k] <= upper[k];
      if (!inside) continue;
      assert_true(count < needed);
      assert_memory_equal(&got[count++], &a->all[i], sizeof got[0]);
    }
    assert_int_equal(needed, count);
    if (n % 10 == 0) assert_true(count > 0);
  }
}

static const double centre_[3] = {0.1, 0.2, 0.3}, low_[3] = {-9, -9, -9}, high_[3] = {9, 9, 9};

static cairn_status query(const atlas* a, int which, cairn_landmark* out, size_t capacity, size_t* needed) {
  if (which == 0) return cairn_map_landmarks(a->map, out, capacity, needed, NULL);
  if (which == 1) return cairn_map_within(a->map, centre_, 1.5, out, capacity, needed, NULL);
  if (which == 2) return cairn_map_nearest(a->map, centre_, 13, out, capacity, needed, NULL);
  return cairn_map_in_box(a->map, low_, high_, out, capacity, needed, NULL);
}

static void short_buffers_are_told_and_not_touched(void** state) {
  const atlas* a = *state;
  for (int which = 0; which < 4; ++which) {
    size_t size = 4711, needed = 4711;
    cairn_landmark out[MANY + 1], kept[MANY + 1];
    memset(out, 0x5a, sizeof out);
    memcpy(kept, out, sizeof kept);
    assert_ok(query(a, which, NULL, 0, &size));
    assert_true(size > 1 && size <= MANY);
    for (size_t capacity = 1; capacity < size; ++capacity) {
      needed = 4711;
      assert_refused(NULL, CAIRN_ERROR_BUFFER, "landmarks", query(a, which, out, capacity, &needed));
      assert_int_equal(needed, size);
      assert_memory_equal(out, kept, sizeof kept);
    }
    assert_ok(query(a, which, out, size, &needed));
    assert_int_equal(needed, size);
    assert_memory_equal(&out[size], &kept[size], (LENGTH(out) - size) * sizeof out[0]);
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks", query(a, which, NULL, 5, &needed));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "needed", query(a, which, out, MANY, NULL));
  }
}

static void joint_covariance_of_the_map(void** state) {
  bench* b = *state;
  const cairn_map* map = cairn_filter_map(b->main.filter);
  const uint64_t ids[3] = {9, 2, 12};
  double joint[81], with_pose[225], pose[36], canary[81];
  size_t needed = 0;
  assert_ok(cairn_map_joint_covariance(map, ids, 3, NULL, 0, &needed, NULL));
  assert_int_equal(needed, 81);
  assert_ok(cairn_map_joint_covariance(map, ids, 3, joint, 81, &needed, NULL));
  assert_ok(cairn_filter_joint_covariance(b->main.filter, ids, 3, NULL, 0, &needed, NULL));
  assert_int_equal(needed, 225);
  assert_ok(cairn_filter_joint_covariance(b->main.filter, ids, 3, with_pose, 225, &needed, NULL));
  assert_ok(cairn_filter_pose(b->main.filter, NULL, pose, NULL));
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j) {
      assert_true(joint[9 * i + j] == joint[9 * j + i]);
      assert_near(with_pose[15 * (i + 6) + j + 6], joint[9 * i + j], 1e-12 * fabs(joint[9 * i + j]));
    }
  for (int i = 0; i < 15; ++i)
    for (int j = 0; j < 15; ++j) assert_true(with_pose[15 * i + j] == with_pose[15 * j + i]);
  for (int i = 0; i < 36; ++i) assert_near(with_pose[15 * (i / 6) + i % 6], pose[i], 1e-12 * fabs(pose[i]));
  double cross = 0;
  for (int k = 0; k < 3; ++k) {
    cairn_landmark landmark;
    assert_ok(cairn_map_landmark(map, ids[k], &landmark, NULL));
    for (int i = 0; i < 9; ++i) {
      const double value = joint[9 * (3 * k + i / 3) + 3 * k + i % 3];
      assert_near(value, landmark.covariance[i], 1e-12 * fabs(value));
    }
  }
  for (int i = 0; i < 9; ++i) cross += fabs(joint[9 * (i / 3) + 3 + i % 3]);
  assert_true(cross > 1e-6); /* landmarks that were seen from one uncertain vehicle are correlated */

  /* too short, and NULL */
  memset(joint, 0x5a, sizeof joint);
  memcpy(canary, joint, sizeof canary);
  assert_refused(NULL, CAIRN_ERROR_BUFFER, "matrix", cairn_map_joint_covariance(map, ids, 3, joint, 80, &needed, NULL));
  assert_int_equal(needed, 81);
  needed = 0;
  assert_refused(NULL, CAIRN_ERROR_BUFFER, "matrix",
                 cairn_filter_joint_covariance(b->main.filter, ids, 3, joint, 81, &needed, NULL));
  assert_int_equal(needed, 225);
  assert_memory_equal(joint, canary, sizeof canary);
  assert_ok(cairn_map_joint_covariance(map, NULL, 0, NULL, 0, &needed, NULL));
  assert_int_equal(needed, 0);
  assert_ok(cairn_filter_joint_covariance(b->main.filter, NULL, 0, with_pose, 225, &needed, NULL));
  assert_int_equal(needed, 36);
  assert_memory_equal(with_pose, pose, sizeof pose);
}

static void joint_covariance_refuses(void** state) {
  bench* b = *state;
  const cairn_map* map = cairn_filter_map(b->main.filter);
  cairn_filter* f = b->main.filter;
  const uint64_t ids[2] = {9, 2}, unknown[2] = {9, 4711}, twice[2] = {9, 9};
  double m[225];
  size_t n = 4711;
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "map", cairn_map_joint_covariance(NULL, ids, 2, m, 225, &n, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "ids", cairn_map_joint_covariance(map, NULL, 2, m, 225, &n, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "matrix", cairn_map_joint_covariance(map, ids, 2, NULL, 225, &n, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "needed", cairn_map_joint_covariance(map, ids, 2, m, 225, NULL, NULL));
  assert_refused(b, CAIRN_ERROR_NOT_FOUND, "ids", cairn_map_joint_covariance(map, unknown, 2, m, 225, &n, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "ids", cairn_map_joint_covariance(map, twice, 2, m, 225, &n, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_joint_covariance(NULL, ids, 2, m, 225, &n, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "ids", cairn_filter_joint_covariance(f, NULL, 2, m, 225, &n, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "matrix", cairn_filter_joint_covariance(f, ids, 2, NULL, 225, &n, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "needed", cairn_filter_joint_covariance(f, ids, 2, m, 225, NULL, NULL));
  assert_refused(b, CAIRN_ERROR_NOT_FOUND, "ids", cairn_filter_joint_covariance(f, unknown, 2, m, 225, &n, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "ids", cairn_filter_joint_covariance(f, twice, 2, m, 225, &n, NULL));
  assert_int_equal(n, 4711);
}

static void bad_queries_are_refused_by_name(void** state) {
  const atlas* a = *state;
  cairn_landmark out[MANY];
  double p[3] = {0, 0, 0}, q[3] = {1, 1, 1};
  size_t n = 4711;
  const cairn_map* m = a->map;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "map", cairn_map_size(NULL, &n, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "count", cairn_map_size(m, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "map", cairn_map_landmark(NULL, 1, out, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmark", cairn_map_landmark(m, a->all[3].id, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "id", cairn_map_landmark(m, 999999999, out, NULL));
  assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "id", cairn_map_landmark(m, CAIRN_ID_NONE, out, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "map", cairn_map_landmarks(NULL, out, MANY, &n, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "map", cairn_map_within(NULL, p, 1, out, MANY, &n, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "centre", cairn_map_within(m, NULL, 1, out, MANY, &n, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "radius", cairn_map_within(m, p, -1e-9, out, MANY, &n, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "map", cairn_map_nearest(NULL, p, 3, out, MANY, &n, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "point", cairn_map_nearest(m, NULL, 3, out, MANY, &n, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "map", cairn_map_in_box(NULL, p, q, out, MANY, &n, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "lower", cairn_map_in_box(m, NULL, q, out, MANY, &n, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "upper", cairn_map_in_box(m, p, NULL, out, MANY, &n, NULL));
  for (size_t k = 0; k < LENGTH(not_finite); ++k) {
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "radius", cairn_map_within(m, p, not_finite[k], out, MANY, &n, NULL));
    for (int i = 0; i < 3; ++i) {
      double bad[3] = {0.5, 0.5, 0.5};
      bad[i] = not_finite[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "centre", cairn_map_within(m, bad, 1, out, MANY, &n, NULL));
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "point", cairn_map_nearest(m, bad, 3, out, MANY, &n, NULL));
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "lower", cairn_map_in_box(m, bad, q, out, MANY, &n, NULL));
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "upper", cairn_map_in_box(m, p, bad, out, MANY, &n, NULL));
    }
  }
  for (int i = 0; i < 3; ++i) {
    double above[3] = {0.5, 0.5, 0.5};
    above[i] = 1.0000001;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "lower", cairn_map_in_box(m, above, q, out, MANY, &n, NULL));
  }
  assert_int_equal(n, 4711);
}

static void an_empty_map_can_be_queried(void** state) {
  rig r;
  const cairn_filter_options options = test_options();
  size_t n = 4711;
  cairn_landmark out;
  (void)state;
  rig_open(&r, &options);
  const cairn_map* map = cairn_filter_map(r.filter);
  assert_ok(cairn_map_landmarks(map, NULL, 0, &n, NULL));
  assert_int_equal(n, 0);
  assert_ok(cairn_map_within(map, centre_, 100, &out, 1, &n, NULL));
  assert_int_equal(n, 0);
  assert_ok(cairn_map_nearest(map, centre_, 3, &out, 1, &n, NULL));
  assert_int_equal(n, 0);
  assert_ok(cairn_map_in_box(map, low_, high_, &out, 1, &n, NULL));
  assert_int_equal(n, 0);
  assert_status(cairn_map_landmark(map, 0, &out, NULL), CAIRN_ERROR_NOT_FOUND);
  rig_close(&r);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
  const struct CMUnitTest tests[] = {
      TEST(landmarks_come_by_ascending_id),
      TEST(within_is_the_scan_cut_at_the_radius),
      TEST(nearest_is_the_scan_cut_at_the_count),
      TEST(ties_come_by_id),
      TEST(in_box_is_the_scan_by_id),
      TEST(short_buffers_are_told_and_not_touched),
      cmocka_unit_test_setup_teardown(joint_covariance_of_the_map, bench_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(joint_covariance_refuses, bench_setup, bench_teardown),
      TEST(bad_queries_are_refused_by_name),
      cmocka_unit_test(an_empty_map_can_be_queried),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
