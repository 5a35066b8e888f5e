/* SPDX-License-Identifier: BSD-3-Clause */
/* Merges of the maps of two rovers, each in its own frame. The merged maps are compared with truth, for both
 * associations and both kinds of maps. Refused merges must leave both maps unchanged to the bit. */
#include "rovers.h"

static cairn_merge_report new_report(void) {
  cairn_merge_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  return report;
}

static cairn_merge_options new_options(int32_t association) {
  cairn_merge_options options;
  assert_ok(cairn_merge_options_init(&options, sizeof options, NULL));
  assert_int_equal(options.association, CAIRN_MERGE_BY_ID);
  options.association = association;
  return options;
}

static cairn_pose between(const rover* a, const rover* b) {
  cairn_pose back, T;
  assert_ok(cairn_pose_inverse(&a->start, &back, NULL));
  assert_ok(cairn_pose_compose(&back, &b->start, &T, NULL));
  return T;
}

/* Squared error of the transform, normalised by its covariance: chi-square with 6 degrees of freedom. */
static double transform_nees(const cairn_merge_report* report, const cairn_pose* truth) {
  double L[36], e[6], sum = 0;
  assert_ok(cairn_pose_error(truth, &report->T_map_other, e, NULL));
  memcpy(L, report->covariance, sizeof L);
  for (int c = 0; c < 6; ++c) {
    for (int r = c; r < 6; ++r) {
      for (int k = 0; k < c; ++k) L[6 * r + c] -= L[6 * r + k] * L[6 * c + k];
      L[6 * r + c] = r == c ? sqrt(L[7 * c]) : L[6 * r + c] / L[7 * c];
    }
    for (int k = 0; k < c; ++k) e[c] -= L[6 * c + k] * e[k];
    e[c] /= L[7 * c];
    sum += e[c] * e[c];
  }
  return sum;
}

static size_t count_common(const cairn_map* a, const cairn_map* b) {
  cairn_landmark all[FIELD], one;
  size_t n, common = 0;
  assert_ok(cairn_map_landmarks(a, all, FIELD, &n, NULL));
  for (size_t i = 0; i < n; ++i) common += cairn_map_landmark(b, all[i].id, &one, NULL) == CAIRN_OK;
  return common;
}

/* Ten pairs of rovers: the merged map is as accurate as its covariance says. */
static void merged_maps_are_true_and_consistent(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    double nees = 0, frame_nees = 0, distance = 0, far_before = 0, far_after = 0;
    size_t dof = 0, rows = 0;
    for (uint64_t seed = 1; seed <= 10; ++seed) {
      rover west, east;
      rover_west(&west, kind, seed), rover_east(&east, kind, seed, 100);
      cairn_map *map = rover_map(&west), *other = rover_map(&east);
      snapshot before = {0, NULL}, after = {0, NULL};
      cairn_merge_report report = new_report();
      cairn_landmark was[FIELD], is;
      size_t n;
      assert_ok(cairn_map_landmarks(map, was, FIELD, &n, NULL));
      const size_t common = count_common(map, other), in_other = size_of(other);
      map_take(&before, other);
      (void)map_nees(other, &east.start, 100, &far_before);
      assert_ok(cairn_map_merge(map, other, NULL, &report, NULL));
      map_take(&after, other);
      assert_true(snapshot_same(&before, &after));
      assert_true(common >= 8 && in_other - common >= 8 && n - common >= 8);
      assert_int_equal(report.common, common);
      assert_int_equal(report.added, in_other - common);
      assert_int_equal(report.rows, 3 * common - 6);
      assert_int_equal(size_of(map), n + report.added);
      assert_true(report.distance <= report.threshold && report.broken_id == CAIRN_ID_NONE);
      for (size_t i = 0; i < n; ++i) {
        cairn_landmark there;
        assert_ok(cairn_map_landmark(map, was[i].id, &is, NULL));
        const bool paired = cairn_map_landmark(other, was[i].id, &there, NULL) == CAIRN_OK;
        assert_int_equal(is.observations, was[i].observations + (paired ? there.observations : 0));
        /* A merge never increases the covariance. */
        for (int k = 0; k < 3; ++k) assert_true(is.covariance[4 * k] <= was[i].covariance[4 * k] * 1.01);
      }
      const cairn_pose T = between(&west, &east);
      nees += map_nees(map, &west.start, 100, &far_after);
      dof += 3 * size_of(map);
      frame_nees += transform_nees(&report, &T);
      distance += report.distance, rows += report.rows;
      snapshot_free(&before), snapshot_free(&after);
      cairn_map_destroy(map), cairn_map_destroy(other);
      rover_close(&west), rover_close(&east);
    }
    print_message("kind %d: NEES %.3f a degree (%zu), of the transform %.2f, distance %.3f, largest error %.2f m\n",
                  kind, nees / (double)dof, dof, frame_nees / 60, distance / (double)rows, far_after);
    assert_true(nees / (double)dof > 0.85 && nees / (double)dof < 1.15);
    assert_true(frame_nees / 60 > 0.5 && frame_nees / 60 < 1.7); /* exceeded once in 10,000 */
    assert_true(distance / (double)rows > 0.75 && distance / (double)rows < 1.25);
    assert_true(far_after < 1.0);
  }
}

/* The same data in both kinds of maps give the same result, except for the effects of linearisation. */
static void dense_and_sparse_agree(void** state) {
  (void)state;
  cairn_map* merged[KINDS];
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    rover west, east;
    rover_west(&west, kind, 77), rover_east(&east, kind, 77, 100);
    cairn_map* other = rover_map(&east);
    merged[kind] = rover_map(&west);
    assert_ok(cairn_map_merge(merged[kind], other, NULL, NULL, NULL));
    cairn_map_destroy(other);
    rover_close(&west), rover_close(&east);
  }
  cairn_landmark a[FIELD], b;
  size_t n;
  assert_ok(cairn_map_landmarks(merged[JOINED], a, FIELD, &n, NULL));
  assert_int_equal(n, size_of(merged[SPARSE]));
  for (size_t i = 0; i < n; ++i) {
    assert_ok(cairn_map_landmark(merged[SPARSE], a[i].id, &b, NULL));
    for (int k = 0; k < 3; ++k) {
      const double sigma = sqrt(a[i].covariance[4 * k]);
      assert_near(b.position[k], a[i].position[k], 0.3 * sigma);
      assert_near(sqrt(b.covariance[4 * k]), sigma, 0.1 * sigma);
    }
  }
  for (int kind = SINGLE; kind < KINDS; ++kind) cairn_map_destroy(merged[kind]);
}

/* Three rovers in any order. Merged maps are copied, queried and merged into other maps. */
static void merged_maps_merge_on(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    rover west, east, middle;
    rover_west(&west, kind, 5), rover_east(&east, kind, 5, 100), rover_middle(&middle, kind, 5);
    cairn_map *a = rover_map(&west), *b = rover_map(&east), *c = rover_map(&middle), *copy = NULL;
    double far = 0;
    assert_ok(cairn_map_merge(b, cairn_filter_map(middle.filter), NULL, NULL,
                              NULL)); /* the map of a filter may be the source */
    assert_ok(cairn_map_copy(b, &copy, NULL));
    assert_ok(cairn_map_merge(a, copy, NULL, NULL, NULL));
    cairn_map_destroy(copy), cairn_map_destroy(b);
    const double nees = map_nees(a, &west.start, 100, &far) / (3.0 * (double)size_of(a));
    assert_true(nees > 0.6 && nees < 1.4);
    assert_true(far < 1.0);
    /* Information that both maps share must count only once. */
    assert_refused(NULL, CAIRN_ERROR_STATE, "other", cairn_map_merge(a, c, NULL, NULL, NULL));
    assert_refused(NULL, CAIRN_ERROR_STATE, "other", cairn_map_merge(c, a, NULL, NULL, NULL));

    generator random = {3};
    cairn_landmark all[FIELD], got[FIELD];
    size_t n, needed;
    assert_ok(cairn_map_landmarks(a, all, FIELD, &n, NULL));
    for (int i = 0; i < 30; ++i) {
      const double p[3] = {random_uniform(&random, 0, 95), random_uniform(&random, -12, 12), 0};
      const double upper[3] = {p[0] + 20, p[1] + 10, 5}, lower[3] = {p[0], p[1], -5};
      size_t inside = 0, boxed = 0;
      for (size_t k = 0; k < n; ++k) {
        const double* x = all[k].position;
        inside += hypot(hypot(x[0] - p[0], x[1] - p[1]), x[2] - p[2]) <= 14;
        boxed += x[0] >= lower[0] && x[0] <= upper[0] && x[1] >= lower[1] && x[1] <= upper[1] && fabs(x[2]) <= 5;
      }
      assert_ok(cairn_map_within(a, p, 14, got, FIELD, &needed, NULL));
      assert_int_equal(needed, inside);
      assert_ok(cairn_map_nearest(a, p, 5, got + 10, 5, &needed, NULL));
      if (inside >= 5) assert_memory_equal(got, got + 10, 5 * sizeof got[0]);
      assert_ok(cairn_map_in_box(a, lower, upper, got, FIELD, &needed, NULL));
      assert_int_equal(needed, boxed);
    }
    cairn_map_destroy(a), cairn_map_destroy(c);
    rover_close(&west), rover_close(&east), rover_close(&middle);
  }
}

/* The other rover uses its own ids. Some of them belong to other landmarks in this map. */
static void maps_merge_by_geometry(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    rover west, east;
    rover_west(&west, kind, 9), rover_east(&east, kind, 9, 90);
    cairn_map *map = rover_map(&west), *other = rover_map(&east);
    const cairn_merge_options options = new_options(CAIRN_MERGE_BY_GEOMETRY);
    cairn_merge_report report = new_report();
    cairn_landmark was[FIELD], of_other[FIELD], one;
    size_t n, in_other, needed, expected = 0;
    assert_ok(cairn_map_landmarks(map, was, FIELD, &n, NULL));
    assert_ok(cairn_map_landmarks(other, of_other, FIELD, &in_other, NULL));
    assert_ok(cairn_map_merge(map, other, &options, &report, NULL));
    cairn_merged_id merged[FIELD];
    assert_ok(cairn_map_merged_ids(map, merged, FIELD, &needed, NULL));
    assert_int_equal(needed, in_other);
    uint64_t largest = was[n - 1].id > of_other[in_other - 1].id ? was[n - 1].id : of_other[in_other - 1].id;
    size_t renamed = 0, common = 0;
    for (size_t i = 0; i < in_other; ++i) {
      const cairn_merged_id* m = &merged[i];
      assert_int_equal(m->other_id, of_other[i].id);
      bool in_map = false, taken = false;
      for (size_t k = 0; k < n; ++k) in_map |= was[k].id == m->other_id + 10, taken |= was[k].id == m->other_id;
      expected += in_map;
      common += m->common != 0;
      if (m->common)
        assert_int_equal(m->id, m->other_id + 10);
      else
        assert_int_equal(m->id, taken ? largest + ++renamed : m->other_id);
      double point[3], truth[3];
      field_landmark((unsigned)(m->other_id - 90), point);
      to_body(&west.start, point, truth);
      assert_ok(cairn_map_landmark(map, m->id, &one, NULL));
      for (int k = 0; k < 3; ++k) assert_near(one.position[k], truth[k], 1.0);
    }
    for (size_t i = 0; i < n; ++i) assert_ok(cairn_map_landmark(map, was[i].id, &one, NULL));
    assert_int_equal(report.common, common);
    assert_true(common + 3 >= expected && common <= expected);
    assert_int_equal(size_of(map), n + in_other - common);
    assert_ok(cairn_map_merged_ids(map, NULL, 0, &needed, NULL));
    assert_status(cairn_map_merged_ids(map, merged, in_other - 1, &needed, NULL), CAIRN_ERROR_BUFFER);
    cairn_map_destroy(map), cairn_map_destroy(other);
    rover_close(&west), rover_close(&east);
  }
}

/* A transform that is known beforehand: exactly, well, hardly. */
static void a_known_transform_helps(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    double sigmas[4];
    for (int known = 0; known < 4; ++known) {
      rover west, east;
      rover_west(&west, kind, 12), rover_east(&east, kind, 12, 100);
      cairn_map *map = rover_map(&west), *other = rover_map(&east);
      cairn_merge_options options = new_options(known == 1 ? CAIRN_MERGE_BY_GEOMETRY : CAIRN_MERGE_BY_ID);
      cairn_merge_report report = new_report();
      const double metres = known == 0   ? 0
                            : known == 1 ? 0.1
                                         : 1000,
                   radians = known == 0   ? 0
                             : known == 1 ? 0.001
                                          : 10;
      options.has_transform = known < 3;
      options.T_map_other = between(&west, &east);
      for (int i = 0; i < 6; ++i) options.covariance[7 * i] = i < 3 ? metres * metres : radians * radians;
      assert_ok(cairn_map_merge(map, other, &options, &report, NULL));
      assert_int_equal(report.rows, 3 * report.common - (known < 3 ? 0 : 6));
      double far = 0;
      const double nees = map_nees(map, &west.start, 100, &far) / (3.0 * (double)size_of(map));
      assert_true(nees > 0.5 && nees < 1.5);
      cairn_landmark last[FIELD];
      size_t n;
      assert_ok(cairn_map_landmarks(map, last, FIELD, &n, NULL));
      sigmas[known] = sqrt(last[n - 1].covariance[0] + last[n - 1].covariance[4] + last[n - 1].covariance[8]);
      double error[6];
      assert_ok(cairn_pose_error(&options.T_map_other, &report.T_map_other, error, NULL));
      if (known == 0)
        for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 1e-12);
      cairn_map_destroy(map), cairn_map_destroy(other);
      rover_close(&west), rover_close(&east);
    }
    assert_true(sigmas[0] < sigmas[1] && sigmas[1] < sigmas[2]);
    assert_near(sigmas[2], sigmas[3], 0.02 * sigmas[3]); /* practically unknown */
  }
}

/* A sparse map that was merged by a known transform is tied to its frame: other maps can be merged into it, but it
 * cannot be merged into another one. */
static void maps_tied_to_a_frame_stay_in_it(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    rover west, east, middle;
    rover_west(&west, kind, 6), rover_east(&east, kind, 6, 100), rover_middle(&middle, kind, 6);
    cairn_map *a = rover_map(&west), *b = rover_map(&east), *c = rover_map(&middle);
    cairn_merge_options options = new_options(CAIRN_MERGE_BY_ID);
    options.has_transform = 1;
    options.T_map_other = between(&west, &east);
    assert_ok(cairn_map_merge(a, b, &options, NULL, NULL));
    if (kind == SPARSE)
      assert_refused(NULL, CAIRN_ERROR_STATE, "other", cairn_map_merge(c, a, NULL, NULL, NULL));
    else
      assert_ok(cairn_map_merge(c, a, NULL, NULL, NULL));
    if (kind == SPARSE) assert_ok(cairn_map_merge(a, c, NULL, NULL, NULL));
    const double nees = kind == SPARSE ? map_nees(a, &west.start, 100, NULL) : map_nees(c, &middle.start, 100, NULL);
    assert_true(nees / (3.0 * (double)size_of(a)) < 1.4);
    cairn_map_destroy(a), cairn_map_destroy(b), cairn_map_destroy(c);
    rover_close(&west), rover_close(&east), rover_close(&middle);
  }
}

/* --- refusals --- */

typedef struct duo {
  rover west, east;
  cairn_map *map, *other;
  snapshot before[2], after;
} duo;

static void duo_open(duo* d, int kind, uint64_t first_id) {
  memset(d, 0, sizeof *d);
  rover_west(&d->west, kind, 21), rover_east(&d->east, kind, 21, first_id);
  d->map = rover_map(&d->west), d->other = rover_map(&d->east);
  map_take(&d->before[0], d->map), map_take(&d->before[1], d->other);
}

static void duo_same(duo* d) {
  map_take(&d->after, d->map);
  assert_true(snapshot_same(&d->before[0], &d->after));
  map_take(&d->after, d->other);
  assert_true(snapshot_same(&d->before[1], &d->after));
}

static void duo_close(duo* d) {
  cairn_map_destroy(d->map), cairn_map_destroy(d->other);
  rover_close(&d->west), rover_close(&d->east);
  for (int i = 0; i < 2; ++i) snapshot_free(&d->before[i]);
  snapshot_free(&d->after);
}

static void refusals_change_nothing(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    duo d;
    duo_open(&d, kind, 100);
    cairn_merge_options options = new_options(CAIRN_MERGE_BY_ID);
    cairn_merge_report report = new_report();
    cairn_map *copy = NULL, *empty = NULL;
    rover empty_rover, foreign;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "map", cairn_map_merge(NULL, d.other, NULL, NULL, NULL));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "other", cairn_map_merge(d.map, NULL, NULL, NULL, NULL));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "other", cairn_map_merge(d.map, d.map, NULL, NULL, NULL));
    assert_ok(cairn_map_copy(d.map, &copy, NULL));
    assert_refused(NULL, CAIRN_ERROR_STATE, "other", cairn_map_merge(d.map, copy, NULL, NULL, NULL));
    assert_refused(NULL, CAIRN_ERROR_STATE, "other",
                   cairn_map_merge(d.map, cairn_filter_map(d.west.filter), NULL, NULL, NULL));
    assert_refused(NULL, CAIRN_ERROR_STATE, "cairn_map_copy",
                   cairn_map_merge((cairn_map*)(uintptr_t)cairn_filter_map(d.west.filter), d.other, NULL, NULL, NULL));
    cairn_map_destroy(copy);
    /* a map of the other kind */
    rover_east(&foreign, kind == SPARSE ? JOINED : SPARSE, 1, 100);
    copy = rover_map(&foreign);
    assert_refused(NULL, CAIRN_ERROR_STATE, "other", cairn_map_merge(d.map, copy, NULL, NULL, NULL));
    cairn_map_destroy(copy), rover_close(&foreign);
    /* nothing in common; an empty map */
    rover_east(&foreign, kind, 1, 500);
    copy = rover_map(&foreign);
    assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "other", cairn_map_merge(d.map, copy, NULL, &report, NULL));
    assert_true(report.common == 0 && report.broken_id == CAIRN_ID_NONE);
    cairn_map_destroy(copy), rover_close(&foreign);
    rover_open(&empty_rover, kind, 1, pose_at(0, 0, 0, 0, 0, 0), 1);
    assert_ok(cairn_map_copy(cairn_filter_map(empty_rover.filter), &empty, NULL));
    for (int32_t by = CAIRN_MERGE_BY_ID; by <= CAIRN_MERGE_BY_GEOMETRY; ++by) {
      options.association = by;
      assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "other", cairn_map_merge(d.map, empty, &options, NULL, NULL));
      assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "map", cairn_map_merge(empty, d.other, &options, NULL, NULL));
    }
    assert_int_equal(size_of(empty), 0);
    cairn_map_destroy(empty), rover_close(&empty_rover);
    /* max_landmarks */
    options = new_options(CAIRN_MERGE_BY_ID);
    options.max_landmarks = size_of(d.map) + size_of(d.other) - count_common(d.map, d.other) - 1;
    assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_landmarks", cairn_map_merge(d.map, d.other, &options, NULL, NULL));
    /* values that no option may have */
    struct {
      const char* name;
      double *value, bad;
    } fields[] = {{"gate_probability", &options.gate_probability, 0},
                  {"joint_gate_probability", &options.joint_gate_probability, 1.5},
                  {"max_tilt", &options.max_tilt, -1},
                  {"T_map_other", &options.T_map_other.position[1], NAN},
                  {"covariance", &options.covariance[7], -1}};
    for (size_t i = 0; i < LENGTH(fields); ++i)
      for (int k = 0; k < 4; ++k) {
        options = new_options(CAIRN_MERGE_BY_ID);
        options.has_transform = 1;
        *fields[i].value = k < 3 ? not_finite[k] : fields[i].bad;
        assert_refused(NULL, CAIRN_ERROR_ARGUMENT, fields[i].name,
                       cairn_map_merge(d.map, d.other, &options, NULL, NULL));
      }
    options = new_options(2);
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "association", cairn_map_merge(d.map, d.other, &options, NULL, NULL));
    duo_same(&d);
    /* after all these refusals the merge succeeds */
    options.association = CAIRN_MERGE_BY_ID;
    options.max_landmarks = size_of(d.map) + size_of(d.other) - count_common(d.map, d.other);
    assert_ok(cairn_map_merge(d.map, d.other, &options, &report, NULL));
    duo_close(&d);
  }
}

/* Ids that are shifted by one: every common landmark is a different one in truth. */
static void contradictions_are_named(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    duo d;
    cairn_merge_report report = new_report();
    cairn_landmark one;
    duo_open(&d, kind, 101);
    assert_refused(NULL, CAIRN_ERROR_NUMERICAL, "contradicts landmark",
                   cairn_map_merge(d.map, d.other, NULL, &report, NULL));
    assert_true(report.common > 8 && report.distance > report.threshold);
    assert_int_equal(report.broken_id, report.broken_other_id);
    assert_ok(cairn_map_landmark(d.map, report.broken_id, &one, NULL));
    char name[32];
    snprintf(name, sizeof name, "%llu", (unsigned long long)report.broken_id);
    assert_non_null(strstr(cairn_last_message(), name));
    duo_same(&d);
    /* A known transform that is wrong. */
    cairn_merge_options options = new_options(CAIRN_MERGE_BY_ID);
    options.has_transform = 1;
    options.T_map_other = pose_at(5, 5, 5, 0, 0, 1);
    for (int i = 0; i < 6; ++i) options.covariance[7 * i] = 1e-4;
    assert_status(cairn_map_merge(d.map, d.other, &options, &report, NULL), CAIRN_ERROR_NUMERICAL);
    duo_same(&d);
    duo_close(&d);
  }
}

/* Options and reports of older and newer callers. */
static void structs_of_other_sizes(void** state) {
  (void)state;
  duo d;
  duo_open(&d, SINGLE, 100);
  union {
    cairn_merge_options options;
    cairn_merge_report report;
    unsigned char bytes[1024];
  } box;
  memset(&box, 0x5a, sizeof box);
  assert_ok(cairn_merge_options_init(&box.options, 24, NULL));
  for (size_t i = 24; i < sizeof box; ++i) assert_int_equal(box.bytes[i], 0x5a);
  assert_status(cairn_merge_options_init(&box.options, 4, NULL), CAIRN_ERROR_ARGUMENT);
  assert_ok(cairn_merge_options_init(&box.options, 24, NULL));
  cairn_merge_options old = box.options;
  memset(&box, 0x5a, sizeof box);
  box.report.struct_size = 24;
  assert_ok(cairn_map_merge(d.map, d.other, &old, &box.report, NULL));
  assert_true(box.report.common > 8);
  for (size_t i = 24; i < sizeof box; ++i) assert_int_equal(box.bytes[i], 0x5a);
  duo_close(&d);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(merged_maps_are_true_and_consistent),
      cmocka_unit_test(dense_and_sparse_agree),
      cmocka_unit_test(merged_maps_merge_on),
      cmocka_unit_test(maps_merge_by_geometry),
      cmocka_unit_test(a_known_transform_helps),
      cmocka_unit_test(maps_tied_to_a_frame_stay_in_it),
      cmocka_unit_test(refusals_change_nothing),
      cmocka_unit_test(contradictions_are_named),
      cmocka_unit_test(structs_of_other_sizes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
