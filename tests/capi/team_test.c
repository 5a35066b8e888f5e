/* SPDX-License-Identifier: BSD-3-Clause */
/* Teams: all vehicles get the same estimate even if the post delays, loses, repeats or shuffles packets. */
#include "team_crew.h"

static void all_vehicles_come_to_one_estimate(void** state) {
  const weather fair = {0, 0, 0, false};
  (void)state;
  for (size_t boats = 2; boats <= BOATS; ++boats) {
    crew c;
    crew_open(&c, boats, 3, 1e9, CAIRN_TEAM_JOINT);
    crew_sail(&c, &fair, 1);
    assert_replicas_agree(&c, 1e-6);
    for (size_t b = 0; b < boats; ++b) {
      const cairn_team_report r = report_of(c.teams[b]);
      cairn_pose pose;
      double covariance[36], error[6];
      assert_int_equal(r.sent, STEPS);
      assert_int_equal(r.taken, STEPS * (boats - 1));
      assert_int_equal(r.unsettled, 0);
      assert_true(r.sightings_used == STEPS * boats * (boats - 1) && r.sightings_refused == 0);
      assert_true(r.failed == 0 && r.lost == 0 && r.nonsense == 0 && r.conflict == 0);
      assert_ok(cairn_team_pose(c.teams[b], b + 1, &pose, covariance, NULL));
      assert_ok(cairn_pose_error(&c.v.boats[b][STEPS - 1].truth, &pose, error, NULL));
      for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 4 * sqrt(covariance[7 * i]));
    }
    crew_close(&c);
  }
}

/* The order in which packets are used does not depend on the post: the same bits. */
static void the_post_does_not_matter(void** state) {
  static const weather bad[] = {{3, 0, 0, false},   {0, 0, 0.5, false},  {4, 0, 0, true},
                                {0, 0.3, 0, false}, {4, 0.3, 0.3, true}, {0, 0.6, 0.2, true}};
  const weather fair = {0, 0, 0, false};
  (void)state;
  for (size_t boats = 2; boats <= BOATS; ++boats) {
    crew undisturbed;
    crew_open(&undisturbed, boats, 5, 1e9, CAIRN_TEAM_JOINT);
    crew_sail(&undisturbed, &fair, 1);
    for (size_t n = 0; n < LENGTH(bad); ++n) {
      crew c;
      uint64_t reordered = 0, repeated = 0, resent = 0, requested = 0;
      crew_open(&c, boats, 5, 1e9, CAIRN_TEAM_JOINT);
      crew_sail(&c, &bad[n], 100 + n);
      for (size_t b = 0; b < boats; ++b) {
        const cairn_team_report r = report_of(c.teams[b]);
        assert_int_equal(r.unsettled, 0);
        assert_int_equal(r.taken, STEPS * (boats - 1));
        assert_true(r.lost == 0 && r.conflict == 0 && r.past == 0);
        assert_same_estimate(c.teams[b], undisturbed.teams[b]);
        reordered += r.reordered, repeated += r.repeated, resent += r.resent, requested += r.requested;
      }
      if (bad[n].shuffled) assert_true(reordered > 0); /* the post did shuffle */
      if (bad[n].repeated > 0) assert_true(repeated > 5);
      if (bad[n].lost > 0) assert_true(resent > 5 && requested > 5);
      crew_close(&c);
    }
    crew_close(&undisturbed);
  }
}

/* A teammate may observe first: its packet arrives before this vehicle's scan of the same time. */
static void a_packet_that_comes_before_the_own_scan_waits_for_it(void** state) {
  const weather fair = {0, 0, 0, false};
  crew expected, c;
  (void)state;
  crew_open(&expected, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  crew_sail(&expected, &fair, 1);
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  for (size_t k = 0; k < STEPS; ++k)
    for (size_t turn = 0; turn < 2; ++turn) {
      const size_t b = (k + turn) % 2;
      boat_step(c.teams[b], &c.v, b + 1, k);
      post p = {NULL, 0, 0};
      (void)post_collect(&p, c.teams[b], 0);
      for (size_t i = 0; i < p.count; ++i) {
        const int32_t result = hand_over(c.teams[1 - b], &p.letters[i]);
        if (kind_of(&p.letters[i]) == DATA)
          assert_int_equal(result, turn == 0 ? CAIRN_PACKET_WAITING : CAIRN_PACKET_TAKEN);
      }
      post_free(&p);
    }
  for (size_t b = 0; b < 2; ++b) {
    assert_int_equal(report_of(c.teams[b]).sightings_refused, 0);
    assert_same_estimate(c.teams[b], expected.teams[b]);
  }
  crew_close(&expected);
  crew_close(&c);
}

/* The same for extended observations, which need this vehicle's sighting of that time. */
static void extended_observations_wait_for_the_own_scan(void** state) {
  (void)state;
  for (int32_t mode = CAIRN_TEAM_EO_DIAGONAL; mode <= CAIRN_TEAM_EO_FULL; ++mode) {
    crew expected, c;
    crew_open(&expected, 2, 5, 1e9, mode);
    crew_open(&c, 2, 5, 1e9, mode);
    for (size_t k = 0; k < 10; ++k) {
      boat_step(expected.teams[0], &c.v, 1, k);
      boat_step(expected.teams[1], &c.v, 2, k);
      letter to = take_one(expected.teams[0]), from = take_one(expected.teams[1]);
      assert_int_equal(hand_over(expected.teams[1], &to), CAIRN_PACKET_TAKEN);
      assert_int_equal(hand_over(expected.teams[0], &from), CAIRN_PACKET_TAKEN);
      (void)hand_over(c.teams[0], &from);
      boat_step(c.teams[0], &c.v, 1, k);
      free(to.bytes), free(from.bytes);
    }
    assert_int_equal(report_of(expected.teams[0]).sightings_used, 20);
    assert_int_equal(report_of(c.teams[0]).sightings_used, 20);
    assert_same_estimate(expected.teams[0], c.teams[0]);
    crew_close(&expected);
    crew_close(&c);
  }
}

/* Without ids all vehicles give the same landmarks the same numbers, because they use the same packets in the same
   order. */
static void names_are_not_needed(void** state) {
  static const int32_t ways[] = {CAIRN_ASSOCIATION_NEAREST, CAIRN_ASSOCIATION_JOINT};
  const weather fair = {0, 0, 0, false}, bad = {3, 0.3, 0.3, true};
  (void)state;
  for (size_t n = 0; n < LENGTH(ways); ++n) {
    crew c;
    size_t size = 0;
    voyage_record(&c.v, 2, 5);
    c.boats = 2;
    for (size_t b = 0; b < 2; ++b) {
      cairn_team_options options = team_options(CAIRN_TEAM_JOINT, b + 1);
      cairn_filter_options filter = planar_options(&c.v.boats[b][0].truth);
      const cairn_range_bearing radar = fleet_radar();
      options.max_lag = 1e9, filter.association = ways[n];
      c.teams[b] = NULL;
      assert_ok(cairn_team_create(&options, &filter, &radar, &c.teams[b], NULL));
      boat_add(c.teams[b], &c.v, 2 - b);
      for (size_t k = 0; k < STEPS; ++k)
        for (size_t i = 0; i < c.v.boats[b][k].feature_count; ++i) c.v.boats[b][k].features[i].id = CAIRN_ID_NONE;
    }
    crew_sail(&c, n == 0 ? &fair : &bad, 3);
    assert_replicas_agree(&c, 1e-6);
    assert_ok(cairn_map_size(cairn_team_map(c.teams[0]), &size, NULL));
    assert_true(size >= 6 && size <= FEATURES);
    crew_close(&c);
  }
}

/* If two vehicles see a new landmark, the nearer one places it, even if its number is higher. */
static void the_nearest_places_a_landmark(void** state) {
  const cairn_pose starts[2] = {pose_at(0, 0, 0, 0, 0, 0), pose_at(900, 0, 0, 0, 0, 0)};
  const cairn_observation looks[2][2] = {{sight(11, 1000, 0, 30, 0.005), sight(12, 200, 0, 30, 0.005)},
                                         {sight(11, 100, 0, 30, 0.005), sight(12, 700, PI, 30, 0.005)}};
  const cairn_range_bearing radar = fleet_radar();
  cairn_team* teams[2];
  letter letters[2];
  (void)state;
  for (size_t b = 0; b < 2; ++b) {
    const cairn_team_options options = team_options(CAIRN_TEAM_JOINT, b + 1);
    const cairn_filter_options filter = planar_options(&starts[b]);
    teams[b] = NULL;
    assert_ok(cairn_team_create(&options, &filter, &radar, &teams[b], NULL));
    assert_ok(cairn_team_add(teams[b], 2 - b, &starts[1 - b], NULL, NULL));
    assert_ok(cairn_team_observe(teams[b], 0, looks[b], 2, NULL, 0, NULL));
    letters[b] = take_one(teams[b]);
  }
  for (size_t b = 0; b < 2; ++b) {
    cairn_match m[2];
    size_t count = 0;
    assert_int_equal(hand_over(teams[b], &letters[1 - b]), CAIRN_PACKET_TAKEN);
    assert_ok(cairn_team_decisions(teams[b], m, 2, &count, NULL));
    assert_int_equal(count, 2);
    for (size_t i = 0; i < 2; ++i) { /* 12 lies near boat 1, 11 near boat 2 */
      const bool near = m[i].landmark == (b == 0 ? 12 : 11);
      assert_int_equal(m[i].result, near ? CAIRN_RESULT_NEW : CAIRN_RESULT_MATCHED);
    }
  }
  for (size_t b = 0; b < 2; ++b) {
    free(letters[b].bytes);
    cairn_team_destroy(teams[b]);
  }
}

/* Teammates' packets cannot make a vehicle's covariance larger than that of a filter of this vehicle only. Tested for
   each mode. */
static void whoever_is_told_more_claims_more(void** state) {
  static const int32_t modes[] = {CAIRN_TEAM_MONO, CAIRN_TEAM_EO_FULL, CAIRN_TEAM_JOINT};
  const weather fair = {0, 0, 0, false};
  double claimed[3];
  (void)state;
  for (size_t m = 0; m < LENGTH(modes); ++m) {
    crew c;
    double covariance[36];
    crew_open(&c, 2, 5, 1e9, modes[m]);
    crew_sail(&c, &fair, 1);
    assert_ok(cairn_team_pose(c.teams[0], 1, NULL, covariance, NULL));
    claimed[m] = covariance[0] + covariance[7];
    const cairn_team_report r = report_of(c.teams[0]);
    assert_int_equal(r.ignored, modes[m] == CAIRN_TEAM_MONO ? STEPS : 0);
    if (modes[m] != CAIRN_TEAM_JOINT)
      assert_status(cairn_team_pose(c.teams[0], 2, NULL, covariance, NULL), CAIRN_ERROR_NOT_FOUND);
    crew_close(&c);
  }
  assert_true(claimed[1] < 0.98 * claimed[0]);
  assert_true(claimed[2] < 0.98 * claimed[1]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_vehicles_come_to_one_estimate),
      cmocka_unit_test(the_post_does_not_matter),
      cmocka_unit_test(a_packet_that_comes_before_the_own_scan_waits_for_it),
      cmocka_unit_test(extended_observations_wait_for_the_own_scan),
      cmocka_unit_test(names_are_not_needed),
      cmocka_unit_test(the_nearest_places_a_landmark),
      cmocka_unit_test(whoever_is_told_more_claims_more),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
