/* SPDX-License-Identifier: BSD-3-Clause */
/* The poses that a filter keeps: how they follow corrections of the map, how many are kept, and what is refused. */
#include "submaps.h"

static const int32_t joins[] = {CAIRN_JOIN_DENSE, CAIRN_JOIN_SPARSE};

#define STEPS (3 * RING_STEPS)

static cairn_pose newest(const cairn_filter* f) {
  uint64_t end = 0;
  cairn_pose pose;
  size_t needed = 0;
  assert_ok(cairn_filter_trajectory_range(f, NULL, &end, NULL));
  assert_ok(cairn_filter_trajectory(f, end - 1, &pose, 1, &needed, NULL));
  assert_int_equal(needed, 1);
  return pose;
}

static void assert_same_pose(const cairn_pose* a, const cairn_pose* b, double tolerance) {
  double error[6];
  assert_ok(cairn_pose_error(a, b, error, NULL));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, tolerance);
}

static double distance(const cairn_pose* a, const cairn_pose* b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += pow(a->position[i] - b->position[i], 2);
  return sqrt(sum);
}

/* Around the ring three times. The newest pose is always the filter's pose. In the end the poses are nearer to the
 * truth than they were online, and no pose lies beside the next one where a submap was closed. */
static void poses_follow_the_map(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j) {
    double online = 0, composed = 0, corrected = 0, odometry = 0, worst = 0;
    for (uint64_t seed = 1; seed <= 10; ++seed) {
      ring course;
      cairn_pose truth[STEPS], first[STEPS], now[STEPS], steps[STEPS];
      size_t count = 0, needed = 0;
      ring_init(&course, seed);
      cairn_filter_options o = ring_options(&course, 9, joins[j]);
      o.trajectory_poses = STEPS;
      for (int i = 0; i < 36; ++i) o.initial_covariance[i] = 0;
      cairn_filter* f = ring_filter(&o);
      for (int k = 0; k < STEPS; ++k) {
        ring_frame seen;
        ring_next(&course, &seen);
        assert_ok(ring_take(f, &seen));
        truth[k] = course.truth, steps[k] = seen.increment;
        assert_ok(cairn_filter_pose(f, &first[k], NULL, NULL));
        const cairn_pose last = newest(f);
        assert_same_pose(&last, &first[k], 1e-8); /* the jitter of a singular covariance */
        cairn_pose base, local, without;          /* what was seen again */
        assert_ok(cairn_filter_base_pose(f, &base, NULL, NULL));
        assert_ok(cairn_filter_local_pose(f, &local, NULL, NULL));
        assert_ok(cairn_pose_compose(&base, &local, &without, NULL));
        composed += pow(distance(&without, &truth[k]), 2);
      }
      assert_ok(cairn_filter_submap_count(f, &count, NULL));
      assert_true(count > 10);
      assert_ok(cairn_filter_trajectory(f, 0, now, STEPS, &needed, NULL));
      assert_int_equal(needed, STEPS);
      for (int k = 0; k < STEPS; ++k) {
        online += pow(distance(&first[k], &truth[k]), 2), corrected += pow(distance(&now[k], &truth[k]), 2);
        if (k == 0) continue;
        cairn_pose moved;
        assert_ok(cairn_pose_compose(&now[k - 1], &steps[k], &moved, NULL));
        worst = fmax(worst, distance(&moved, &now[k]));
        assert_ok(cairn_pose_compose(&first[k - 1], &steps[k], &moved, NULL));
        odometry = fmax(odometry, distance(&moved, &first[k]));
      }
      cairn_filter_destroy(f);
    }
    assert_true(corrected < (joins[j] == CAIRN_JOIN_SPARSE ? 0.55 : 0.8) * composed);
    assert_true(corrected < online && online < composed);
    assert_true(worst < 0.3 * odometry);
  }
}

static void a_single_map_keeps_online_poses(void** state) {
  (void)state;
  ring course;
  cairn_pose first[RING_STEPS], now[RING_STEPS];
  size_t needed = 0;
  ring_init(&course, 4);
  cairn_filter_options o = ring_options(&course, 0, CAIRN_JOIN_AUTO);
  o.trajectory_poses = RING_STEPS;
  cairn_filter* f = ring_filter(&o);
  for (int k = 0; k < RING_STEPS; ++k) {
    ring_drive(&course, &f, 1, 1);
    assert_ok(cairn_filter_pose(f, &first[k], NULL, NULL));
  }
  assert_ok(cairn_filter_trajectory(f, 0, now, RING_STEPS, &needed, NULL));
  assert_memory_equal(now, first, sizeof now);
  cairn_filter_destroy(f);
}

/* A filter that keeps few poses has the same poses as one that keeps all. */
static void the_newest_poses_are_kept(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j) {
    ring course;
    ring_init(&course, 8);
    cairn_filter_options o = ring_options(&course, 9, joins[j]);
    o.trajectory_poses = STEPS;
    cairn_filter* all = ring_filter(&o);
    o.trajectory_poses = 7;
    cairn_filter* few = ring_filter(&o);
    cairn_filter* both[] = {all, few};
    for (int k = 1; k <= STEPS; ++k) {
      uint64_t first = 0, end = 0;
      cairn_pose a[7], b[7];
      size_t needed = 0;
      ring_drive(&course, both, 2, 1);
      assert_ok(cairn_filter_trajectory_range(few, &first, &end, NULL));
      assert_int_equal(end, k);
      assert_int_equal(first, k > 7 ? k - 7 : 0);
      assert_ok(cairn_filter_trajectory(few, first, a, 7, &needed, NULL));
      assert_int_equal(needed, end - first);
      assert_ok(cairn_filter_trajectory(all, first, b, 7, &needed, NULL));
      assert_memory_equal(a, b, needed * sizeof a[0]);
    }
    cairn_filter_destroy(all), cairn_filter_destroy(few);
  }
}

static void every_update_keeps_a_pose(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j) {
    ring course;
    uint64_t end = 0, number = 0;
    double c[9], eye[36];
    cairn_pose pose, last;
    const double rows[6] = {0};
    ring_init(&course, 6);
    cairn_filter_options o = ring_options(&course, 500, joins[j]);
    o.trajectory_poses = 2; /* fixes close one submap after the other */
    cairn_filter* f = ring_filter(&o);
    for (int kind = 0; kind < 6; ++kind) {
      ring_drive(&course, &f, 1, 1);
      assert_ok(cairn_filter_trajectory_range(f, NULL, &end, NULL));
      diagonal(c, 3, 1e-2), diagonal(eye, 6, 1);
      cairn_status status = CAIRN_ERROR_INTERNAL;
      if (kind == 0) status = cairn_filter_update_position(f, course.truth.position, c, NULL, NULL, NULL);
      if (kind == 1) status = cairn_filter_update_attitude(f, course.truth.quaternion, c, NULL, NULL);
      if (kind == 2) status = cairn_filter_update_heading(f, 0, 3, NULL, NULL);
      if (kind == 3) status = cairn_filter_update_linear(f, rows, 6, eye, eye, NULL, 0, NULL, NULL, NULL);
      if (kind == 4) status = cairn_filter_keep_pose(f, &number, NULL);
      if (kind == 5) status = cairn_filter_keep_pose(f, NULL, NULL);
      assert_ok(status);
      if (kind == 4) assert_int_equal(number, end);
      assert_ok(cairn_filter_pose(f, &pose, NULL, NULL));
      last = newest(f);
      assert_same_pose(&last, &pose, 1e-8);
      assert_ok(cairn_filter_trajectory_range(f, NULL, &number, NULL));
      assert_int_equal(number, end + 1);
    }
    cairn_filter_destroy(f);
  }
}

/* The message of the last error names what is wrong, and the filter is as before. */
#define assert_same_after(f, call, status, word)                                            \
  do {                                                                                      \
    snapshot before = {0, NULL}, after = {0, NULL};                                         \
    snapshot_take(&before, (f));                                                            \
    assert_status((call), (status));                                                        \
    if (strstr(cairn_last_message(), (word)) == NULL) fail_msg("%s", cairn_last_message()); \
    snapshot_take(&after, (f));                                                             \
    assert_true(snapshot_same(&before, &after));                                            \
    snapshot_free(&before), snapshot_free(&after);                                          \
  } while (0)

static void bad_calls_are_refused(void** state) {
  (void)state;
  ring course;
  cairn_pose poses[8], untouched[8];
  size_t needed = 77;
  uint64_t first = 0, end = 0;
  memset(untouched, 7, sizeof untouched);
  memcpy(poses, untouched, sizeof poses);
  ring_init(&course, 2);
  cairn_filter_options o = ring_options(&course, 9, CAIRN_JOIN_SPARSE);

  cairn_filter* f = ring_filter(&o); /* keeps none */
  ring_drive(&course, &f, 1, 3);
  assert_same_after(f, cairn_filter_trajectory(f, 0, poses, 8, &needed, NULL), CAIRN_ERROR_STATE, "trajectory_poses");
  assert_same_after(f, cairn_filter_trajectory_range(f, &first, &end, NULL), CAIRN_ERROR_STATE, "trajectory_poses");
  assert_same_after(f, cairn_filter_keep_pose(f, &first, NULL), CAIRN_ERROR_STATE, "trajectory_poses");
  cairn_filter_destroy(f);

  o.trajectory_poses = 5;
  f = ring_filter(&o);
  ring_drive(&course, &f, 1, 9);
  assert_same_after(f, cairn_filter_trajectory(f, 0, poses, 8, &needed, NULL), CAIRN_ERROR_CAPACITY,
                    "trajectory_poses is 5");
  assert_same_after(f, cairn_filter_trajectory(f, 3, poses, 8, &needed, NULL), CAIRN_ERROR_CAPACITY,
                    "trajectory_poses is 5");
  assert_same_after(f, cairn_filter_trajectory(f, 10, poses, 8, &needed, NULL), CAIRN_ERROR_NOT_FOUND, "first is 10");
  assert_same_after(f, cairn_filter_trajectory(f, 4, poses, 8, NULL, NULL), CAIRN_ERROR_ARGUMENT, "needed");
  assert_same_after(f, cairn_filter_trajectory(f, 4, NULL, 8, &needed, NULL), CAIRN_ERROR_ARGUMENT, "poses");
  assert_int_equal(needed, 77);
  assert_same_after(f, cairn_filter_trajectory(f, 4, poses, 4, &needed, NULL), CAIRN_ERROR_BUFFER, "poses");
  assert_int_equal(needed, 5);
  assert_memory_equal(poses, untouched, sizeof poses);
  assert_ok(cairn_filter_trajectory(f, 9, NULL, 0, &needed, NULL));
  assert_int_equal(needed, 0);
  assert_ok(cairn_filter_trajectory(f, 4, poses, 5, &needed, NULL));
  assert_ok(cairn_filter_trajectory_range(f, NULL, NULL, NULL));
  cairn_filter_destroy(f);

  assert_status(cairn_filter_trajectory(NULL, 0, poses, 8, &needed, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_filter_trajectory_range(NULL, &first, &end, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_filter_keep_pose(NULL, &first, NULL), CAIRN_ERROR_ARGUMENT);
  o.trajectory_poses = 10000001;
  f = NULL;
  assert_status(cairn_filter_create(&o, &f, NULL), CAIRN_ERROR_ARGUMENT);
  assert_non_null(strstr(cairn_last_message(), "options.trajectory_poses"));
  assert_null(f);
}

static void teams_keep_no_poses(void** state) {
  (void)state;
  cairn_team_options own;
  cairn_filter_options filter;
  cairn_range_bearing radar;
  cairn_team* team = NULL;
  assert_ok(cairn_team_options_init(&own, sizeof own, NULL));
  assert_ok(cairn_filter_options_init(&filter, sizeof filter, NULL));
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar, NULL));
  own.vehicle = 1;
  filter.vehicle = CAIRN_VEHICLE_PLANAR;
  filter.trajectory_poses = 1;
  assert_status(cairn_team_create(&own, &filter, &radar, &team, NULL), CAIRN_ERROR_ARGUMENT);
  assert_non_null(strstr(cairn_last_message(), "trajectory_poses"));
  filter.trajectory_poses = 0;
  assert_ok(cairn_team_create(&own, &filter, &radar, &team, NULL));
  cairn_team_destroy(team);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(poses_follow_the_map),      cmocka_unit_test(a_single_map_keeps_online_poses),
      cmocka_unit_test(the_newest_poses_are_kept), cmocka_unit_test(every_update_keeps_a_pose),
      cmocka_unit_test(bad_calls_are_refused),     cmocka_unit_test(teams_keep_no_poses),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
