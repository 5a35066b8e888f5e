/* SPDX-License-Identifier: BSD-3-Clause */
/* A team of one vehicle equals the ordinary filter, and this vehicle's pose is the current one. */
#include "teams.h"

#define ALONE_LANDMARKS 9
#define ALONE_STEPS 30

/* A boat that drives in a ring of landmarks; every fourth scan contains an outlier. */
typedef struct alone {
  generator random;
  cairn_pose truth, odometry[4];
  double noise[4][36], dt;
  size_t motions;
  cairn_observation seen[ALONE_LANDMARKS];
  size_t count;
  unsigned step;
} alone;

static void alone_next(alone* a) {
  a->motions = a->step == 0 ? 0 : 1 + a->step % 4;
  for (size_t i = 0; i < a->motions; ++i) {
    const double d[3] = {0.5, random_normal(&a->random, 0.02), 0.05 + random_normal(&a->random, 0.01)};
    const cairn_pose moved = pose_at(d[0], d[1], 0, 0, 0, d[2]);
    a->odometry[i] = pose_at(d[0] + random_normal(&a->random, 0.02), d[1] + random_normal(&a->random, 0.02), 0, 0, 0,
                             d[2] + random_normal(&a->random, 0.01));
    diagonal(a->noise[i], 6, 4e-4);
    a->noise[i][35] = 1e-4, a->noise[i][1] = a->noise[i][6] = 1e-4, a->noise[i][5] = a->noise[i][30] = -5e-5;
    assert_ok(cairn_pose_compose(&a->truth, &moved, &a->truth, NULL));
  }
  a->count = 0;
  for (size_t l = 0; l < ALONE_LANDMARKS; ++l) {
    const double point[3] = {6 * cos(0.7 * (double)l), 4 + 6 * sin(0.7 * (double)l), 0};
    double body[3];
    to_body(&a->truth, point, body);
    if (hypot(body[0], body[1]) > 11) continue;
    cairn_observation* o = &a->seen[a->count++];
    memset(o, 0, sizeof *o);
    o->id = 100 - l;
    o->z[0] = hypot(body[0], body[1]) + random_normal(&a->random, 0.05);
    o->z[1] = atan2(body[1], body[0]) + random_normal(&a->random, 0.01);
    if (l % 3 == 0) o->covariance[0] = 4e-3, o->covariance[1] = o->covariance[2] = 1e-5, o->covariance[3] = 2e-4;
    if (a->step % 4 == 3 && a->count == 2) o->z[0] += 3;
  }
  ++a->step;
}

/* Pose, map and their joint covariances, bit for bit. */
static void compare_with_filter(const cairn_team* team, const cairn_filter* filter) {
  cairn_pose pa, pb;
  double ca[36], cb[36];
  cairn_landmark la[ALONE_LANDMARKS], lb[ALONE_LANDMARKS];
  uint64_t ids[ALONE_LANDMARKS];
  double ja[9 * ALONE_LANDMARKS * ALONE_LANDMARKS], jb[9 * ALONE_LANDMARKS * ALONE_LANDMARKS];
  size_t na = 0, nb = 0, needed = 0;
  assert_ok(cairn_team_pose(team, 7, &pa, ca, NULL));
  assert_ok(cairn_filter_pose(filter, &pb, cb, NULL));
  assert_memory_equal(&pa, &pb, sizeof pa);
  assert_memory_equal(ca, cb, sizeof ca);
  assert_ok(cairn_map_landmarks(cairn_team_map(team), la, ALONE_LANDMARKS, &na, NULL));
  assert_ok(cairn_map_landmarks(cairn_filter_map(filter), lb, ALONE_LANDMARKS, &nb, NULL));
  assert_int_equal(na, nb);
  assert_memory_equal(la, lb, na * sizeof la[0]);
  for (size_t i = 0; i < na; ++i) ids[i] = la[i].id;
  assert_ok(cairn_map_joint_covariance(cairn_team_map(team), ids, na, ja, LENGTH(ja), &needed, NULL));
  assert_ok(cairn_map_joint_covariance(cairn_filter_map(filter), ids, nb, jb, LENGTH(jb), &needed, NULL));
  assert_memory_equal(ja, jb, needed * sizeof ja[0]);
}

static void one_vehicle_alone_is_the_ordinary_filter(void** state) {
  static const int32_t modes[] = {CAIRN_TEAM_MONO, CAIRN_TEAM_EO_DIAGONAL, CAIRN_TEAM_EO_FULL, CAIRN_TEAM_JOINT};
  (void)state;
  for (size_t m = 0; m < LENGTH(modes); ++m)
    for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
      const cairn_pose start = pose_at(0.5, -1, 0, 0, 0, 0.3);
      cairn_filter_options options = planar_options(&start);
      cairn_range_bearing radar;
      cairn_team_options own = team_options(modes[m], 7);
      cairn_filter* filter = NULL;
      cairn_team* team = NULL;
      int32_t sensor;
      size_t rejected = 0, placed = 0, matched = 0;
      options.state_error = error;
      options.initial_covariance[0] = options.initial_covariance[7] = 0.01, options.initial_covariance[35] = 1e-3;
      assert_ok(cairn_range_bearing_init(&radar, sizeof radar, NULL));
      radar.range_sigma = 0.05;
      own.baseline = 1;
      assert_ok(cairn_team_create(&own, &options, &radar, &team, NULL));
      assert_ok(cairn_filter_create(&options, &filter, NULL));
      assert_ok(cairn_filter_add_range_bearing(filter, &radar, &sensor, NULL));
      alone a;
      memset(&a, 0, sizeof a);
      a.random.state = 11, a.truth = start;
      for (int step = 0; step < ALONE_STEPS; ++step) {
        cairn_match told[ALONE_LANDMARKS], expected[ALONE_LANDMARKS];
        size_t needed = 0;
        alone_next(&a);
        for (size_t i = 0; i < a.motions; ++i) {
          assert_ok(cairn_team_predict_increment(team, &a.odometry[i], a.noise[i], NULL));
          assert_ok(cairn_filter_predict_increment(filter, &a.odometry[i], a.noise[i], NULL));
        }
        assert_ok(cairn_team_observe(team, 0.5 * step, a.seen, a.count, NULL, 0, NULL));
        assert_ok(cairn_filter_update(filter, sensor, a.seen, a.count, expected, NULL));
        compare_with_filter(team, filter);
        assert_ok(cairn_team_decisions(team, told, LENGTH(told), &needed, NULL));
        assert_int_equal(needed, a.count);
        for (size_t i = 0; i < a.count; ++i) {
          assert_int_equal(told[i].landmark, expected[i].landmark);
          assert_int_equal(told[i].result, expected[i].result);
          assert_int_equal(told[i].reason, expected[i].reason);
          assert_true(told[i].distance == expected[i].distance && told[i].threshold == expected[i].threshold);
          rejected += expected[i].result == CAIRN_RESULT_REJECTED;
          placed += expected[i].result == CAIRN_RESULT_NEW;
          matched += expected[i].result == CAIRN_RESULT_MATCHED;
        }
      }
      assert_true(rejected >= 5 && placed >= 7 && matched >= 60);
      const cairn_team_report report = report_of(team);
      assert_true(report.rejected == rejected && report.placed == placed && report.matched == matched);
      assert_int_equal(report.sent, ALONE_STEPS);
      assert_int_equal(report.unsettled, 0);
      cairn_team_destroy(team);
      cairn_filter_destroy(filter);
    }
}

/* Motion by twist equals that of the filter, too. */
static void a_twist_moves_a_team_as_it_moves_a_filter(void** state) {
  const cairn_pose start = pose_at(2, 3, 0, 0, 0, 2);
  const cairn_filter_options options = planar_options(&start);
  const cairn_range_bearing radar = fleet_radar();
  const cairn_team_options own = team_options(CAIRN_TEAM_JOINT, 7);
  const cairn_twist_noise noise = fleet_noise();
  const double velocity[3] = {1.5, 0.2, 0}, rate[3] = {0, 0, 0.3};
  cairn_filter* filter = NULL;
  cairn_team* team = NULL;
  (void)state;
  for (int with = 0; with < 2; ++with) {
    assert_ok(cairn_team_create(&own, &options, &radar, &team, NULL));
    assert_ok(cairn_filter_create(&options, &filter, NULL));
    if (with) assert_ok(cairn_filter_set_twist_noise(filter, &noise, NULL));
    for (int i = 0; i < 3; ++i) {
      assert_ok(cairn_team_predict_twist(team, 0.5, velocity, rate, with ? &noise : NULL, NULL));
      assert_ok(cairn_filter_predict_twist(filter, 0.5, velocity, rate, NULL));
    }
    assert_ok(cairn_team_observe(team, 1.5, NULL, 0, NULL, 0, NULL));
    compare_with_filter(team, filter);
    cairn_team_destroy(team);
    cairn_filter_destroy(filter);
  }
}

/* This vehicle's pose includes the motions of steps that wait for teammates. */
static void the_own_pose_is_as_of_now(void** state) {
  const cairn_pose start = pose_at(0.5, -1, 0, 0, 0, 0.3);
  cairn_filter_options options = planar_options(&start);
  cairn_range_bearing radar;
  cairn_team_options own = team_options(CAIRN_TEAM_JOINT, 7);
  cairn_filter* filter = NULL;
  cairn_team* team = NULL;
  size_t size = 7;
  (void)state;
  options.initial_covariance[0] = options.initial_covariance[7] = 0.01, options.initial_covariance[35] = 1e-3;
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar, NULL));
  assert_ok(cairn_team_create(&own, &options, &radar, &team, NULL));
  assert_ok(cairn_filter_create(&options, &filter, NULL));
  assert_ok(cairn_team_add(team, 8, &start, NULL, NULL)); /* which never sends a packet */
  alone a;
  memset(&a, 0, sizeof a);
  a.random.state = 11, a.truth = start;
  for (int step = 0; step < 6; ++step) {
    cairn_pose pa, pb;
    double ca[36], cb[36], error[6];
    alone_next(&a);
    for (size_t i = 0; i <= a.motions; ++i) { /* between motions, too */
      assert_ok(cairn_team_pose(team, 7, &pa, ca, NULL));
      assert_ok(cairn_filter_pose(filter, &pb, cb, NULL));
      assert_ok(cairn_pose_error(&pa, &pb, error, NULL));
      for (int k = 0; k < 6; ++k) assert_near(error[k], 0, 1e-12);
      for (int k = 0; k < 36; ++k) assert_near(ca[k], cb[k], 1e-12);
      if (i == a.motions) break;
      assert_ok(cairn_team_predict_increment(team, &a.odometry[i], a.noise[i], NULL));
      assert_ok(cairn_filter_predict_increment(filter, &a.odometry[i], a.noise[i], NULL));
    }
    assert_ok(cairn_team_observe(team, 0.5 * step, a.seen, a.count, NULL, 0, NULL));
    assert_int_equal(report_of(team).unsettled, step + 1);
    assert_ok(cairn_map_size(cairn_team_map(team), &size, NULL));
    assert_int_equal(size, 0);
  }
  assert_ok(cairn_team_remove(team, 8, NULL)); /* the team waits for nobody now */
  assert_int_equal(report_of(team).unsettled, 0);
  assert_ok(cairn_map_size(cairn_team_map(team), &size, NULL));
  assert_true(size > 3);
  cairn_team_destroy(team);
  cairn_filter_destroy(filter);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_vehicle_alone_is_the_ordinary_filter),
      cmocka_unit_test(a_twist_moves_a_team_as_it_moves_a_filter),
      cmocka_unit_test(the_own_pose_is_as_of_now),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
