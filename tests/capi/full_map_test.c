/* SPDX-License-Identifier: BSD-3-Clause */
/* A frame that would overfill the map. */
#include "points_ahead.h"

/* A frame that would overfill the map keeps its known landmarks, and as many new ones as there is room for. */
static void a_full_map_refuses_only_new_landmarks(void** state) {
  (void)state;
  for (int32_t vehicle = CAIRN_VEHICLE_SPATIAL; vehicle <= CAIRN_VEHICLE_PLANAR; ++vehicle)
    for (int way = 0; way < 3; ++way) {
      cairn_filter_options o = options_of(vehicle, CAIRN_STATE_ERROR_INVARIANT);
      cairn_observation shot[7];
      cairn_match m[7];
      size_t size = 0;
      o.max_landmarks = 5;
      if (way == 1) o.association = CAIRN_ASSOCIATION_NEAREST;
      cairn_filter* f = create(&o);
      const int32_t sensor = add_sensor(f, vehicle);
      for (uint64_t i = 0; i < 7; ++i) shot[i] = seen(vehicle, 2 * i, 0);
      assert_ok(cairn_filter_update(f, sensor, shot, 3, m, NULL));
      if (way == 2) shot[3] = sighting(70, 1e12, 0); /* places nothing, and takes no room */
      assert_ok(cairn_filter_update(f, sensor, shot, 7, m, NULL));
      for (int i = 0; i < 7; ++i) {
        const bool lost = way == 2 && i == 3, room = i < (way == 2 ? 6 : 5);
        assert_int_equal(m[i].result, i < 3           ? CAIRN_RESULT_MATCHED
                                      : lost || !room ? CAIRN_RESULT_REJECTED
                                                      : CAIRN_RESULT_NEW);
        assert_int_equal(m[i].reason, lost ? CAIRN_REASON_NO_PLACE : !room ? CAIRN_REASON_NO_ROOM : CAIRN_REASON_NONE);
        if (!room) assert_true(m[i].landmark == CAIRN_ID_NONE && m[i].distance == 0);
      }
      assert_int_equal(last_update(f).rejected, way == 2 ? 2 : 2);
      assert_ok(cairn_map_size(cairn_filter_map(f), &size, NULL));
      assert_int_equal(size, 5);
      assert_ok(cairn_filter_remove_landmark(f, m[0].landmark, NULL)); /* there is room again */
      assert_ok(cairn_filter_update(f, sensor, shot + 6, 1, m, NULL));
      assert_int_equal(m[0].result, CAIRN_RESULT_NEW);
      cairn_filter_destroy(f);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_full_map_refuses_only_new_landmarks),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
