/* SPDX-License-Identifier: BSD-3-Clause */
/* Copies of maps: equal to the original, and unchanged when the original changes. */
#include "rovers.h"

/* Compares landmarks to the bit, and the joint covariance up to rounding, which depends on the order of the ids. */
static void expect_equal(const snapshot* a, const snapshot* b, size_t landmarks) {
  assert_int_equal(a->size, b->size);
  assert_memory_equal(a->bytes, b->bytes, landmarks * sizeof(cairn_landmark));
  const double* P = (const double*)(const void*)(a->bytes + landmarks * sizeof(cairn_landmark));
  const double* Q = (const double*)(const void*)(b->bytes + landmarks * sizeof(cairn_landmark));
  for (size_t i = 0; i < 9 * landmarks * landmarks; ++i) assert_near(Q[i], P[i], 1e-15);
}

static void a_copy_is_equal_and_does_not_change(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    rover r;
    cairn_map *copy = NULL, *second = NULL;
    snapshot original = {0, NULL}, copied = {0, NULL};
    int32_t of_original = -1, of_copy = -1;
    rover_open(&r, kind, 5, pose_at(0, 0, 0, 0, 0, 0), 100);
    rover_drive(&r, 40);
    const cairn_map* map = cairn_filter_map(r.filter);
    map_take(&original, map);
    assert_true(size_of(map) > 10);
    assert_ok(cairn_map_copy(map, &copy, NULL));
    map_take(&copied, copy);
    expect_equal(&original, &copied, size_of(map));
    map_take(&original, copy);
    assert_ok(cairn_map_kind(map, &of_original, NULL));
    assert_ok(cairn_map_kind(copy, &of_copy, NULL));
    assert_int_equal(of_original, kind == SPARSE ? CAIRN_MAP_SPARSE : CAIRN_MAP_DENSE);
    assert_int_equal(of_copy, of_original);

    rover_drive(&r, 25);
    map_take(&copied, map);
    assert_false(snapshot_same(&original, &copied)); /* the filter changed */
    map_take(&copied, copy);
    assert_true(snapshot_same(&original, &copied)); /* the copy did not change */
    assert_ok(cairn_filter_remove_landmark(r.filter, 105, NULL));
    rover_close(&r);
    map_take(&copied, copy);
    assert_true(snapshot_same(&original, &copied));
    assert_ok(cairn_map_copy(copy, &second, NULL));
    cairn_map_destroy(copy);
    map_take(&copied, second);
    assert_true(snapshot_same(&original, &copied));
    cairn_map_destroy(second);
    snapshot_free(&original);
    snapshot_free(&copied);
  }
}

static void all_queries_work_on_copies(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    rover r;
    generator random = {99};
    rover_west(&r, kind, 1);
    cairn_map* copy = rover_map(&r);
    const cairn_map* map = cairn_filter_map(r.filter);
    for (int n = 0; n < 50; ++n) {
      const double p[3] = {random_uniform(&random, -5, 65), random_uniform(&random, -12, 12), 0};
      const double q[3] = {p[0] + random_uniform(&random, 0, 30), p[1] + 12, 1};
      cairn_landmark a[FIELD], b[FIELD];
      size_t in_a = 0, in_b = 0;
      memset(a, 0, sizeof a), memset(b, 0, sizeof b);
      assert_ok(cairn_map_within(map, p, 15, a, FIELD, &in_a, NULL));
      assert_ok(cairn_map_within(copy, p, 15, b, FIELD, &in_b, NULL));
      assert_true(in_a == in_b && memcmp(a, b, sizeof a) == 0);
      assert_ok(cairn_map_nearest(map, p, 7, a, FIELD, &in_a, NULL));
      assert_ok(cairn_map_nearest(copy, p, 7, b, FIELD, &in_b, NULL));
      assert_true(in_a == 7 && in_b == 7 && memcmp(a, b, sizeof a) == 0);
      assert_ok(cairn_map_in_box(map, p, q, a, FIELD, &in_a, NULL));
      assert_ok(cairn_map_in_box(copy, p, q, b, FIELD, &in_b, NULL));
      assert_true(in_a == in_b && memcmp(a, b, sizeof a) == 0);
      assert_ok(cairn_map_landmark(copy, b[0].id == 0 ? 101 : b[0].id, &a[0], NULL));
    }
    cairn_landmark none;
    uint64_t unknown = 4711;
    double matrix[9];
    size_t needed;
    assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "4711", cairn_map_landmark(copy, unknown, &none, NULL));
    assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "4711",
                   cairn_map_joint_covariance(copy, &unknown, 1, matrix, 9, &needed, NULL));
    cairn_map_destroy(copy);
    rover_close(&r);
  }
}

static void the_open_submap_and_an_empty_map_are_copied_too(void** state) {
  (void)state;
  rover r;
  cairn_map* copy = NULL;
  int32_t kind = -1;
  snapshot a = {0, NULL}, b = {0, NULL};
  rover_open(&r, SPARSE, 8, pose_at(0, 0, 0, 0, 0, 0), 100);
  assert_ok(cairn_map_copy(cairn_filter_map(r.filter), &copy, NULL));
  assert_int_equal(size_of(copy), 0);
  cairn_map_destroy(copy);
  rover_drive(&r, 1);
  assert_true(size_of(cairn_filter_local_map(r.filter)) > 2);
  assert_ok(cairn_map_copy(cairn_filter_local_map(r.filter), &copy, NULL));
  assert_ok(cairn_map_kind(copy, &kind, NULL));
  assert_int_equal(kind, CAIRN_MAP_DENSE);
  map_take(&a, cairn_filter_local_map(r.filter));
  map_take(&b, copy);
  expect_equal(&a, &b, size_of(copy));
  cairn_map_destroy(copy);
  snapshot_free(&a), snapshot_free(&b);
  rover_close(&r);
}

static void a_filters_map_is_not_destroyed(void** state) {
  (void)state;
  rover r;
  snapshot a = {0, NULL}, b = {0, NULL};
  rover_west(&r, JOINED, 2);
  map_take(&a, cairn_filter_map(r.filter));
  cairn_map_destroy((cairn_map*)(uintptr_t)cairn_filter_map(r.filter));
  cairn_map_destroy((cairn_map*)(uintptr_t)cairn_filter_local_map(r.filter));
  cairn_map_destroy(NULL);
  map_take(&b, cairn_filter_map(r.filter));
  assert_true(snapshot_same(&a, &b));
  rover_drive(&r, 3);
  snapshot_free(&a), snapshot_free(&b);
  rover_close(&r);
}

static void null_is_refused(void** state) {
  (void)state;
  cairn_map* copy = NULL;
  rover r;
  int32_t kind;
  size_t needed;
  rover_open(&r, SINGLE, 8, pose_at(0, 0, 0, 0, 0, 0), 100);
  const cairn_map* map = cairn_filter_map(r.filter);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "map", cairn_map_copy(NULL, &copy, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "copy", cairn_map_copy(map, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "map", cairn_map_kind(NULL, &kind, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "kind", cairn_map_kind(map, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "map", cairn_map_merged_ids(NULL, NULL, 0, &needed, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "needed", cairn_map_merged_ids(map, NULL, 0, NULL, NULL));
  assert_null(copy);
  rover_close(&r);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_copy_is_equal_and_does_not_change),
      cmocka_unit_test(all_queries_work_on_copies),
      cmocka_unit_test(the_open_submap_and_an_empty_map_are_copied_too),
      cmocka_unit_test(a_filters_map_is_not_destroyed),
      cmocka_unit_test(null_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
