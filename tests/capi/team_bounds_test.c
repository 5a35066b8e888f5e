/* SPDX-License-Identifier: BSD-3-Clause */
/* Bounds of a team: requests do not fill its queue, a wrong clock locks nobody out, numbers of absurd size do no harm,
 * and each vehicle is added once. */
#include <float.h>

#include "team_crew.h"

static void assert_finite(const cairn_team* team) {
  cairn_pose pose;
  double covariance[36];
  cairn_landmark landmarks[2 * FEATURES];
  size_t n = 0;
  assert_ok(cairn_team_pose(team, 1, &pose, covariance, NULL));
  for (int i = 0; i < 3; ++i) assert_true(isfinite(pose.position[i]));
  for (int i = 0; i < 36; ++i) assert_true(isfinite(covariance[i]));
  for (int i = 0; i < 6; ++i) assert_true(covariance[7 * i] >= 0);
  assert_ok(cairn_map_landmarks(cairn_team_map(team), landmarks, LENGTH(landmarks), &n, NULL));
  for (size_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) assert_true(isfinite(landmarks[i].position[k]) && landmarks[i].covariance[4 * k] >= 0);
}

static void requests_do_not_fill_the_queue(void** state) {
  (void)state;
  static crew c;
  crew_open(&c, 2, 3, 1e6, CAIRN_TEAM_JOINT);
  for (size_t k = 0; k < STEPS; ++k) boat_step(c.teams[0], &c.v, 1, k);
  post own = {NULL, 0, 0}, question = {NULL, 0, 0};
  assert_int_equal(post_collect(&own, c.teams[0], 0), STEPS + 1); /* and one request, for boat 2 is silent */
  assert_ok(cairn_team_ask(c.teams[1], NULL));
  assert_int_equal(post_collect(&question, c.teams[1], 0), 1);
  for (int k = 0; k < 20000; ++k) assert_int_equal(hand_over(c.teams[0], &question.letters[0]), CAIRN_PACKET_REQUEST);
  post_free(&own);
  assert_int_equal(post_collect(&own, c.teams[0], 0), STEPS);
  assert_int_equal(report_of(c.teams[0]).resent, STEPS);
  for (int k = 0; k < 1000; ++k) assert_ok(cairn_team_ask(c.teams[0], NULL));
  post_free(&own);
  assert_int_equal(post_collect(&own, c.teams[0], 0), 1);
  post_free(&own), post_free(&question);
  crew_close(&c);
}

static void a_wrong_own_clock_is_refused(void** state) {
  (void)state;
  static crew c;
  crew_open(&c, 1, 3, 30, CAIRN_TEAM_JOINT);
  cairn_team *team = c.teams[0], *twin = NULL;
  const cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
  twin = boat_open(&c.v, &options);
  for (size_t k = 0; k < 6; ++k) {
    boat_step(team, &c.v, 1, k), boat_step(twin, &c.v, 1, k);
    if (k % 2 == 0) continue;
    assert_status(cairn_team_observe(team, k == 1 ? 1e9 : DBL_MAX, NULL, 0, NULL, 0, NULL), CAIRN_ERROR_ARGUMENT);
    assert_non_null(strstr(cairn_last_message(), "max_jump"));
  }
  assert_same_estimate(team, twin);
  assert_int_equal(report_of(team).sent, 6);
  /* A pause is longer than max_jump: the second call confirms it. */
  const double late = c.v.time[5] + 1000;
  assert_status(cairn_team_observe(team, late, NULL, 0, NULL, 0, NULL), CAIRN_ERROR_ARGUMENT);
  assert_ok(cairn_team_observe(team, late + 1, NULL, 0, NULL, 0, NULL));
  cairn_team_destroy(twin);
  crew_close(&c);
}

static void max_jump_is_positive(void** state) {
  (void)state;
  static voyage v;
  voyage_record(&v, 1, 3);
  cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
  assert_near(options.max_jump, 60, 0);
  const cairn_filter_options filter = planar_options(&v.boats[0][0].truth);
  const cairn_range_bearing radar = fleet_radar();
  const double wrong[] = {0, -1, NAN, INFINITY};
  for (size_t i = 0; i < LENGTH(wrong); ++i) {
    cairn_team* team = NULL;
    options.max_jump = wrong[i];
    assert_status(cairn_team_create(&options, &filter, &radar, &team, NULL), CAIRN_ERROR_ARGUMENT);
    assert_non_null(strstr(cairn_last_message(), "max_jump"));
    assert_null(team);
  }
}

/* A packet of boat 2, with another number and time. */
static letter forged(const letter* from, uint64_t number, double time) {
  letter l = {malloc(from->size), from->size, 0};
  memcpy(l.bytes, from->bytes, from->size);
  memcpy(l.bytes + AT_NUMBER, &number, 8); /* the tests run on little-endian machines only */
  memcpy(l.bytes + AT_TIME, &time, 8);
  seal(l.bytes, l.size);
  return l;
}

/* The queue of a teammate's packets is full, and its first packet is still missing. That packet has room: it lets all
 * others have their turn. */
static void a_full_queue_takes_the_packet_that_it_waits_for(void** state) {
  enum { WAITING = 3 };
  (void)state;
  static crew c;
  crew_open(&c, 2, 3, 1e6, CAIRN_TEAM_JOINT);
  cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
  options.max_waiting = WAITING, options.max_lag = 1e6;
  const cairn_filter_options filter = planar_options(&c.v.boats[0][0].truth);
  const cairn_range_bearing radar = fleet_radar();
  cairn_team* team = NULL;
  assert_ok(cairn_team_create(&options, &filter, &radar, &team, NULL));
  assert_ok(cairn_team_add(team, 2, &c.v.boats[1][0].truth, NULL, NULL));
  post steps = {NULL, 0, 0};
  letter* packets[WAITING + 2];
  size_t count = 0;
  for (size_t k = 0; k < LENGTH(packets); ++k) {
    boat_step(c.teams[1], &c.v, 2, k);
    boat_step(team, &c.v, 1, k);
    post_collect(&steps, c.teams[1], 0);
  }
  for (size_t i = 0; i < steps.count && count < LENGTH(packets); ++i)
    if (kind_of(&steps.letters[i]) == DATA) packets[count++] = &steps.letters[i];
  assert_int_equal(count, LENGTH(packets));
  for (size_t i = 1; i <= WAITING; ++i) assert_int_equal(hand_over(team, packets[i]), CAIRN_PACKET_WAITING);
  assert_int_equal(hand_over(team, packets[WAITING + 1]), CAIRN_PACKET_FULL);
  assert_int_equal(report_of(team).taken, 0);
  assert_int_equal(hand_over(team, packets[0]), CAIRN_PACKET_TAKEN);
  assert_int_equal(report_of(team).taken, WAITING + 1);
  assert_int_equal(hand_over(team, packets[WAITING + 1]), CAIRN_PACKET_TAKEN);
  cairn_team_destroy(team);
  post_free(&steps);
  crew_close(&c);
}

static void a_wrong_clock_of_a_teammate_locks_no_packet_out(void** state) {
  (void)state;
  for (int32_t mode = CAIRN_TEAM_JOINT; mode >= CAIRN_TEAM_EO_DIAGONAL; --mode) {
    static crew c;
    crew_open(&c, 2, 3, 1e6, mode);
    post steps = {NULL, 0, 0};
    for (size_t k = 0; k < 6; ++k) {
      boat_step(c.teams[1], &c.v, 2, k);
      assert_int_equal(post_collect(&steps, c.teams[1], 0) >= 1, true);
    }
    size_t next = 0;
    for (size_t k = 0; k < 6; ++k) {
      boat_step(c.teams[0], &c.v, 1, k);
      while (kind_of(&steps.letters[next]) != DATA) ++next;
      if (k == 3) {
        letter wrong = forged(&steps.letters[next], k, 1e9);
        assert_int_equal(hand_over(c.teams[0], &wrong), CAIRN_PACKET_AHEAD);
        assert_int_equal(report_of(c.teams[0]).ahead, 1);
        free(wrong.bytes);
      }
      assert_int_equal(hand_over(c.teams[0], &steps.letters[next++]), CAIRN_PACKET_TAKEN);
    }
    assert_int_equal(report_of(c.teams[0]).past, 0);
    post_free(&steps);
    crew_close(&c);
  }
}

static void absurd_numbers_do_no_harm(void** state) {
  (void)state;
  for (int32_t mode = CAIRN_TEAM_MONO; mode <= CAIRN_TEAM_JOINT; ++mode) {
    static crew c;
    crew_open(&c, 2, 3, 1e6, mode);
    const weather fair = {0, 0, 0, false};
    generator random = {1};
    post p = {NULL, 0, 0};
    for (size_t k = 0; k < 8; ++k) {
      const double huge[] = {1e10, 1e154, 1e300, DBL_MAX};
      double covariance[36];
      diagonal(covariance, 6, k % 2 == 0 ? 1e308 : 1e40);
      const cairn_pose still = pose_at(0, 0, 0, 0, 0, 0), far = pose_at(huge[k % 4], 0, 0, 0, 0, 0);
      assert_true(cairn_team_predict_increment(c.teams[0], &still, covariance, NULL) != CAIRN_OK);
      diagonal(covariance, 6, 1e-4);
      assert_true(cairn_team_predict_increment(c.teams[0], &far, covariance, NULL) != CAIRN_OK);
      for (size_t b = 0; b < 2; ++b) {
        const log_entry* e = &c.v.boats[b][k];
        cairn_observation features[FEATURES], vehicles[BOATS];
        memcpy(features, e->features, sizeof features), memcpy(vehicles, e->vehicles, sizeof vehicles);
        if (k % 2 == 1 && e->vehicle_count > 0) vehicles[0].z[0] = huge[k % 4]; /* no echo */
        boat_move(c.teams[b], &c.v, b + 1, k);
        assert_ok(
            cairn_team_observe(c.teams[b], c.v.time[k], features, e->feature_count, vehicles, e->vehicle_count, NULL));
      }
      collect_all(&c, &p, k, &fair, &random);
      deliver_due(&c, &p, k, &fair, &random);
      assert_finite(c.teams[0]);
    }
    assert_int_equal(report_of(c.teams[0]).failed, 0);
    post_free(&p);
    crew_close(&c);
  }
}

/* A vehicle that was removed has submaps in the map: it does not come back under its number. */
static void a_vehicle_joins_a_map_of_submaps_once(void** state) {
  (void)state;
  static voyage v;
  voyage_record(&v, 2, 3);
  const cairn_team_options options = team_options(CAIRN_TEAM_SUBMAPS, 1);
  cairn_filter_options filter = planar_options(&v.boats[0][0].truth);
  filter.submap_landmarks = 5, filter.join = CAIRN_JOIN_DENSE;
  const cairn_range_bearing radar = fleet_radar();
  cairn_team* team = NULL;
  assert_ok(cairn_team_create(&options, &filter, &radar, &team, NULL));
  boat_add(team, &v, 2);
  assert_ok(cairn_team_remove(team, 2, NULL));
  assert_status(cairn_team_add(team, 2, &v.boats[1][0].truth, NULL, NULL), CAIRN_ERROR_ARGUMENT);
  uint64_t members[4];
  size_t count = 0;
  assert_ok(cairn_team_members(team, members, LENGTH(members), &count, NULL));
  assert_int_equal(count, 1);
  cairn_team_destroy(team);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(requests_do_not_fill_the_queue),
      cmocka_unit_test(a_wrong_own_clock_is_refused),
      cmocka_unit_test(max_jump_is_positive),
      cmocka_unit_test(a_full_queue_takes_the_packet_that_it_waits_for),
      cmocka_unit_test(a_wrong_clock_of_a_teammate_locks_no_packet_out),
      cmocka_unit_test(absurd_numbers_do_no_harm),
      cmocka_unit_test(a_vehicle_joins_a_map_of_submaps_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
