/* SPDX-License-Identifier: BSD-3-Clause */
/* Copies and merges allocate memory. Whichever request fails, both maps must be unchanged to the bit, nothing may leak,
 * and the call must succeed when there is memory again. */
#include "interposer.h"
#include "rovers.h"

static void same(snapshot* after, const cairn_map* map, const snapshot* before, const char* what, size_t at) {
  map_take(after, map);
  if (!snapshot_same(before, after)) fail_msg("%s: request %zu refused, and a map changed", what, at);
}

static void a_merge_without_memory_changes_nothing(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind)
    for (int32_t by = CAIRN_MERGE_BY_ID; by <= CAIRN_MERGE_BY_GEOMETRY; ++by) {
      rover west, east;
      rover_west(&west, kind, 31), rover_east(&east, kind, 31, 100);
      cairn_map *map = rover_map(&west), *other = rover_map(&east), *twin = rover_map(&west);
      snapshot before[2] = {{0, NULL}, {0, NULL}}, after = {0, NULL};
      cairn_merge_options options;
      assert_ok(cairn_merge_options_init(&options, sizeof options, NULL));
      options.association = by;
      map_take(&before[0], map), map_take(&before[1], other);
      /* A merge by geometry makes hundreds of thousands of requests. The test samples them, ever more sparsely. */
      size_t refusals = 0;
      for (size_t at = 1;; at += by == CAIRN_MERGE_BY_ID ? 1 + at / 40 : 1 + at / 4) {
        arm_to_fail(at, refusals % 2 == 0);
        const cairn_status status = cairn_map_merge(map, other, &options, NULL, NULL);
        const bool failed = counter.failed;
        counter.armed = false;
        if (!failed) {
          assert_int_equal(status, CAIRN_OK);
          break;
        }
        if (status == CAIRN_OK) fail_msg("kind %d: request %zu refused, and the call succeeded", kind, at);
        assert_int_equal(status, CAIRN_ERROR_MEMORY);
        ++refusals;
        same(&after, map, &before[0], "map", at);
        same(&after, other, &before[1], "other", at);
      }
      print_message("kind %d, association %d: refused %zu times\n", kind, (int)by, refusals);
      assert_true(refusals > 20);
      assert_ok(cairn_map_merge(twin, other, &options, NULL, NULL)); /* the same merge without failures */
      map_take(&before[0], twin);
      same(&after, map, &before[0], "merged", 0);
      for (int i = 0; i < 2; ++i) snapshot_free(&before[i]);
      snapshot_free(&after);
      cairn_map_destroy(map), cairn_map_destroy(other), cairn_map_destroy(twin);
      rover_close(&west), rover_close(&east);
    }
}

static void a_copy_without_memory_does_not_exist(void** state) {
  (void)state;
  for (int kind = SINGLE; kind < KINDS; ++kind) {
    rover west;
    rover_west(&west, kind, 32);
    cairn_map *map = rover_map(&west), *copy = NULL;
    snapshot before = {0, NULL}, after = {0, NULL};
    map_take(&before, map);
    size_t refusals = 0;
    for (size_t at = 1; copy == NULL; ++at) {
      arm_to_fail(at, false);
      const cairn_status status = cairn_map_copy(map, &copy, NULL);
      const bool failed = counter.failed;
      counter.armed = false;
      assert_int_equal(status, failed ? CAIRN_ERROR_MEMORY : CAIRN_OK);
      assert_true(failed == (copy == NULL));
      refusals += failed;
      same(&after, map, &before, "map", at);
    }
    assert_true(refusals > 5);
    same(&after, copy, &before, "copy", 0);
    cairn_map_destroy(copy), cairn_map_destroy(map);
    snapshot_free(&before), snapshot_free(&after);
    rover_close(&west);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_merge_without_memory_changes_nothing),
      cmocka_unit_test(a_copy_without_memory_does_not_exist),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
