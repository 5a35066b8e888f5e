/* SPDX-License-Identifier: BSD-3-Clause */
/* Members of a team: who is known, who is waited for, who leaves and who joins late. */
#include "team_crew.h"

/* The team waits once for a teammate that never sends a packet, and not again at every step. */
static void whoever_is_never_heard_of_is_given_up(void** state) {
  crew c;
  (void)state;
  crew_open(&c, 2, 7, 12.0, CAIRN_TEAM_JOINT);
  for (size_t k = 0; k < 10; ++k) {
    boat_step(c.teams[0], &c.v, 1, k);
    assert_int_equal(report_of(c.teams[0]).unsettled, c.v.time[k] > 12 ? 0 : k + 1);
  }
  crew_close(&c);
}

/* This vehicle's scan has more landmarks than the map has room for. It is taken in although a teammate's later packet
   shows a gap; only the landmarks that do not fit are refused. */
static void an_own_scan_that_does_not_fit_is_taken_in(void** state) {
  (void)state;
  for (int gap = 0; gap < 2; ++gap) {
    crew c;
    crew_open(&c, 2, 7, 1e9, CAIRN_TEAM_JOINT);
    cairn_team_destroy(c.teams[0]);
    const cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
    cairn_filter_options filter = planar_options(&c.v.boats[0][0].truth);
    const cairn_range_bearing radar = fleet_radar();
    const log_entry* e = &c.v.boats[0][0];
    filter.max_landmarks = 1;
    c.teams[0] = NULL;
    assert_ok(cairn_team_create(&options, &filter, &radar, &c.teams[0], NULL));
    boat_add(c.teams[0], &c.v, 2);
    post p = {NULL, 0, 0};
    for (size_t k = 0; k < 3; ++k) boat_step(c.teams[1], &c.v, 2, k);
    (void)post_collect(&p, c.teams[1], 0);
    for (size_t i = 0; i < p.count; ++i)
      if (kind_of(&p.letters[i]) == DATA && (number_of(&p.letters[i]) == 0 || (gap && number_of(&p.letters[i]) == 2)))
        (void)hand_over(c.teams[0], &p.letters[i]);
    assert_true(e->feature_count > 1);
    size_t size = 0;
    assert_ok(cairn_team_observe(c.teams[0], c.v.time[0], e->features, e->feature_count, NULL, 0, NULL));
    assert_true(report_of(c.teams[0]).failed == 0 && report_of(c.teams[0]).sent == 1); /* and sent to the team */
    assert_ok(cairn_map_size(cairn_team_map(c.teams[0]), &size, NULL));
    assert_int_equal(size, 1);
    post_free(&p);
    crew_close(&c);
  }
}

/* One packet of boat 2 never comes, nor does any repetition. */
static void what_is_lost_for_good_is_given_up(void** state) {
  const uint64_t gone = 9;
  crew c;
  cairn_pose pose;
  double covariance[36], error[6];
  bool unknown = false;
  (void)state;
  crew_open(&c, 2, 7, 12.0, CAIRN_TEAM_JOINT);
  for (size_t k = 0; k < STEPS; ++k) {
    /* The boats do not see each other from step 8 to 19: the pose of boat 2 stays unknown for a while. */
    for (size_t b = 0; b < 2; ++b) {
      boat_move(c.teams[b], &c.v, b + 1, k);
      boat_look(c.teams[b], &c.v, b + 1, k, k >= 8 && k < 20 ? LOOK_AT_FEATURES : LOOK_AT_ALL);
    }
    post p = {NULL, 0, 0};
    for (int round = 0; round < 3; ++round) {
      for (size_t b = 0; b < 2; ++b) (void)post_collect(&p, c.teams[b], 0);
      for (size_t i = 0; i < p.count; ++i) {
        if (sender_of(&p.letters[i]) == 1) (void)hand_over(c.teams[1], &p.letters[i]);
        if (sender_of(&p.letters[i]) == 2 && !(kind_of(&p.letters[i]) == DATA && number_of(&p.letters[i]) == gone))
          (void)hand_over(c.teams[0], &p.letters[i]);
      }
      post_free(&p);
    }
    const cairn_team_report r = report_of(c.teams[0]);
    const cairn_status status = cairn_team_pose(c.teams[0], 2, &pose, covariance, NULL);
    /* The gap before number 10 (at 50 s) is given up after 62 s: step 13. */
    assert_int_equal(r.lost, k < 13 ? 0 : 1);
    assert_int_equal(r.unsettled, k < 9 || k >= 13 ? 0 : k - 8);
    assert_int_equal(status, k < 13 || k >= 20 ? CAIRN_OK : CAIRN_ERROR_NOT_FOUND);
    unknown = unknown || status != CAIRN_OK;
    assert_int_equal(r.vehicles_found, k >= 20);
    assert_ok(cairn_team_pose(c.teams[0], 1, NULL, NULL, NULL));
  }
  assert_true(unknown && report_of(c.teams[0]).requested > 2);
  assert_int_equal(report_of(c.teams[1]).lost, 0);
  for (uint64_t b = 1; b <= 2; ++b) {
    assert_ok(cairn_team_pose(c.teams[0], b, &pose, covariance, NULL));
    assert_ok(cairn_pose_error(&c.v.boats[b - 1][STEPS - 1].truth, &pose, error, NULL));
    for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 4 * sqrt(covariance[7 * i]));
  }
  crew_close(&c);
}

/* p_b = p + r u(phi + theta), phi_b = phi + theta - theta' + pi: pose and covariance computed by hand;
 * this vehicle's pose is uncertain. */
static void a_teammate_is_found_where_both_see_it(void** state) {
  const double x = 10, y = -4, phi = 0.7, r = 200, theta = 0.4, back = -1.1;
  const double s_r = 2, s_t = 0.01, b_r = 1, b_t = 0.02; /* there and back */
  const double P[3] = {0.5, 0.3, 2e-4};                  /* own x, y, heading */
  const cairn_pose start = pose_at(x, y, 0, 0, 0, phi);
  cairn_filter_options options = planar_options(&start);
  const cairn_range_bearing radar = fleet_radar();
  const cairn_team_options one = team_options(CAIRN_TEAM_JOINT, 1), two = team_options(CAIRN_TEAM_JOINT, 2);
  cairn_team *a = NULL, *b = NULL;
  cairn_pose pose;
  double covariance[36], error[6], expected[9], J[3][7] = {{0}};
  (void)state;
  options.initial_covariance[0] = P[0], options.initial_covariance[7] = P[1], options.initial_covariance[35] = P[2];
  assert_ok(cairn_team_create(&one, &options, &radar, &a, NULL));
  assert_ok(cairn_team_create(&two, &options, &radar, &b, NULL));
  assert_ok(cairn_team_add(a, 2, NULL, NULL, NULL));
  assert_status(cairn_team_pose(a, 2, &pose, covariance, NULL), CAIRN_ERROR_NOT_FOUND);
  const double s_rt = 0.3 * s_r * s_t, b_rt = -0.4 * b_r * b_t; /* errors of range and bearing are correlated */
  cairn_observation there = sight(2, r + 1.5, theta, s_r, s_t), here = sight(1, r - 0.5, back, b_r, b_t);
  there.covariance[1] = there.covariance[2] = s_rt, here.covariance[1] = here.covariance[2] = b_rt;
  assert_ok(cairn_team_observe(a, 3.0, NULL, 0, &there, 1, NULL));
  assert_ok(cairn_team_observe(b, 3.0, NULL, 0, &here, 1, NULL));
  letter l = take_one(b);
  assert_int_equal(hand_over(a, &l), CAIRN_PACKET_TAKEN);
  free(l.bytes);
  assert_int_equal(report_of(a).vehicles_found, 1);
  assert_ok(cairn_team_pose(a, 2, &pose, covariance, NULL));

  const double w = b_r * b_r / (s_r * s_r + b_r * b_r), range = w * (r + 1.5) + (1 - w) * (r - 0.5), at = phi + theta;
  const cairn_pose place = pose_at(x + range * cos(at), y + range * sin(at), 0, 0, 0, phi + theta - back + PI);
  assert_ok(cairn_pose_error(&place, &pose, error, NULL));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 1e-9);
  /* By own x, y, heading; range and bearing there; range and bearing back. */
  J[0][0] = J[1][1] = J[2][2] = 1;
  J[0][2] = J[0][4] = -range * sin(at), J[1][2] = J[1][4] = range * cos(at);
  J[0][3] = w * cos(at), J[1][3] = w * sin(at), J[0][5] = (1 - w) * cos(at), J[1][5] = (1 - w) * sin(at);
  J[2][4] = 1, J[2][6] = -1;
  const double variances[7] = {P[0], P[1], P[2], s_r * s_r, s_t * s_t, b_r * b_r, b_t * b_t};
  for (int i = 0; i < 9; ++i) {
    expected[i] = 0;
    for (int k = 0; k < 7; ++k) expected[i] += J[i / 3][k] * variances[k] * J[i % 3][k];
    expected[i] += s_rt * (J[i / 3][3] * J[i % 3][4] + J[i / 3][4] * J[i % 3][3]);
    expected[i] += b_rt * (J[i / 3][5] * J[i % 3][6] + J[i / 3][6] * J[i % 3][5]);
  }
  static const int axes[3] = {0, 1, 5};
  for (int i = 0; i < 9; ++i) assert_near(covariance[6 * axes[i / 3] + axes[i % 3]], expected[i], 1e-8);
  cairn_team_destroy(a);
  cairn_team_destroy(b);
}

/* An unknown start is solved at the first step, through a third vehicle if necessary. */
static void unknown_starts_are_found(void** state) {
  crew c;
  (void)state;
  voyage_record(&c.v, 3, 9);
  c.boats = 3;
  for (uint64_t b = 1; b <= 3; ++b) {
    cairn_team_options options = team_options(CAIRN_TEAM_JOINT, b);
    options.max_lag = 1e9;
    c.teams[b - 1] = boat_open(&c.v, &options);
  }
  /* Boat 1 knows no start pose. It does not see boat 3, but boat 2 does. */
  for (size_t k = 0; k < STEPS; ++k)
    for (size_t i = 0; i < c.v.boats[0][k].vehicle_count; ++i)
      if (c.v.boats[0][k].vehicles[i].id == 3) {
        c.v.boats[0][k].vehicles[i] = c.v.boats[0][k].vehicles[--c.v.boats[0][k].vehicle_count];
        break;
      }
  assert_ok(cairn_team_add(c.teams[0], 2, NULL, NULL, NULL));
  assert_ok(cairn_team_add(c.teams[0], 3, NULL, NULL, NULL));
  for (size_t k = 0; k < STEPS; ++k) {
    for (size_t b = 0; b < 3; ++b) boat_step(c.teams[b], &c.v, b + 1, k);
    for (size_t b = 0; b < 3; ++b) {
      post p = {NULL, 0, 0};
      (void)post_collect(&p, c.teams[b], 0);
      for (size_t i = 0; i < p.count && b > 0; ++i) (void)hand_over(c.teams[0], &p.letters[i]);
      post_free(&p);
    }
    assert_int_equal(report_of(c.teams[0]).vehicles_found, 2);
  }
  for (uint64_t b = 1; b <= 3; ++b) {
    cairn_pose pose;
    double covariance[36], error[6];
    assert_ok(cairn_team_pose(c.teams[0], b, &pose, covariance, NULL));
    assert_ok(cairn_pose_error(&c.v.boats[b - 1][STEPS - 1].truth, &pose, error, NULL));
    for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 4 * sqrt(covariance[7 * i]));
  }
  crew_close(&c);
}

static void assert_members(const cairn_team* team, const uint64_t* expected, size_t count) {
  uint64_t members[8];
  size_t needed = 0;
  assert_ok(cairn_team_members(team, NULL, 0, &needed, NULL));
  assert_int_equal(needed, count);
  assert_ok(cairn_team_members(team, members, LENGTH(members), &needed, NULL));
  assert_int_equal(needed, count);
  for (size_t i = 0; i < count; ++i) assert_int_equal(members[i], expected[i]);
}

static void whoever_leaves_is_waited_for_no_more(void** state) {
  static const uint64_t both[] = {1, 2}, one[] = {1};
  crew c;
  size_t before = 0, after = 0;
  post p = {NULL, 0, 0};
  (void)state;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  assert_members(c.teams[0], both, 2);
  for (size_t k = 0; k < 10; ++k)
    for (size_t b = 0; b < 2; ++b) boat_step(c.teams[b], &c.v, b + 1, k);
  assert_ok(cairn_team_leave(c.teams[1], NULL));
  (void)post_collect(&p, c.teams[1], 0);
  size_t leave = p.count;
  for (size_t i = 0; i < p.count; ++i)
    if (kind_of(&p.letters[i]) == LEAVE) leave = i;
  assert_true(leave < p.count);
  assert_int_equal(number_of(&p.letters[leave]), 10);
  /* The farewell arrives first. Its turn comes after all other packets have arrived. */
  assert_int_equal(hand_over(c.teams[0], &p.letters[leave]), CAIRN_PACKET_WAITING);
  assert_members(c.teams[0], both, 2);
  for (size_t i = 0; i < p.count; ++i)
    if (kind_of(&p.letters[i]) == DATA) (void)hand_over(c.teams[0], &p.letters[i]);
  assert_members(c.teams[0], one, 1);
  assert_int_equal(report_of(c.teams[0]).unsettled, 0);
  assert_status(cairn_team_pose(c.teams[0], 2, NULL, NULL, NULL), CAIRN_ERROR_NOT_FOUND);
  assert_int_equal(hand_over(c.teams[0], &p.letters[leave]), CAIRN_PACKET_UNKNOWN);
  assert_ok(cairn_map_size(cairn_team_map(c.teams[0]), &before, NULL));
  boat_step(c.teams[0], &c.v, 1, 10);
  assert_int_equal(report_of(c.teams[0]).unsettled, 0);
  assert_ok(cairn_map_size(cairn_team_map(c.teams[0]), &after, NULL)); /* its information stays */
  assert_true(before > 3 && after >= before);
  post_free(&p);
  crew_close(&c);
}

/* If its packets arrive in order, the outcome is a farewell. */
static void a_farewell_is_told(void** state) {
  crew c;
  (void)state;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  for (size_t b = 0; b < 2; ++b) boat_step(c.teams[b], &c.v, b + 1, 0);
  letter l = take_one(c.teams[1]);
  assert_int_equal(hand_over(c.teams[0], &l), CAIRN_PACKET_TAKEN);
  free(l.bytes);
  assert_ok(cairn_team_leave(c.teams[1], NULL));
  l = take_one(c.teams[1]);
  assert_int_equal(kind_of(&l), LEAVE);
  assert_int_equal(hand_over(c.teams[0], &l), CAIRN_PACKET_LEAVE);
  free(l.bytes);
  crew_close(&c);
}

/* A farewell is the last packet: a later packet would have its number. */
static void nothing_follows_a_farewell(void** state) {
  crew c;
  (void)state;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  boat_step(c.teams[1], &c.v, 2, 0);
  assert_ok(cairn_team_leave(c.teams[1], NULL));
  const log_entry* e = &c.v.boats[1][1];
  const cairn_status status = cairn_team_observe(c.teams[1], c.v.time[1], e->features, e->feature_count, NULL, 0, NULL);
  post p = {NULL, 0, 0};
  (void)post_collect(&p, c.teams[1], 0);
  for (size_t i = 0; i < p.count; ++i)
    for (size_t j = 0; j < i; ++j)
      if (kind_of(&p.letters[i]) != REQUEST && kind_of(&p.letters[j]) != REQUEST)
        assert_int_not_equal(number_of(&p.letters[i]), number_of(&p.letters[j]));
  assert_true(status == CAIRN_OK || status == CAIRN_ERROR_STATE);
  post_free(&p);
  crew_close(&c);
}

/* Packets of a vehicle that were used before its removal are not used again when the vehicle is a member again. */
static void nothing_is_taken_in_twice_over_a_return(void** state) {
  crew c;
  post p = {NULL, 0, 0};
  snapshot before = {0, NULL}, after = {0, NULL};
  cairn_pose pose;
  (void)state;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  for (size_t k = 0; k < 5; ++k)
    for (size_t b = 0; b < 2; ++b) boat_step(c.teams[b], &c.v, b + 1, k);
  (void)post_collect(&p, c.teams[1], 0);
  for (size_t i = 0; i < p.count; ++i)
    if (kind_of(&p.letters[i]) == DATA) (void)hand_over(c.teams[0], &p.letters[i]);
  assert_int_equal(report_of(c.teams[0]).taken, 5);
  assert_ok(cairn_team_pose(c.teams[0], 2, &pose, NULL, NULL));
  assert_ok(cairn_team_remove(c.teams[0], 2, NULL));
  assert_ok(cairn_team_add(c.teams[0], 2, &pose, NULL, NULL));
  team_snapshot(&before, c.teams[0]);
  for (size_t i = 0; i < p.count; ++i)
    if (kind_of(&p.letters[i]) == DATA) (void)hand_over(c.teams[0], &p.letters[i]); /* late copies of the packets */
  team_snapshot(&after, c.teams[0]);
  assert_int_equal(report_of(c.teams[0]).taken, 5);
  assert_true(snapshot_same(&before, &after));
  snapshot_free(&before), snapshot_free(&after);
  post_free(&p);
  crew_close(&c);
}

/* Boat 2 joins long after the start of boat 1, and both get the same estimate. */
static void join_late(const double* start_covariance) {
  const size_t late = 15;
  crew c;
  voyage_record(&c.v, 2, 5);
  c.boats = 2;
  for (uint64_t b = 1; b <= 2; ++b) {
    cairn_team_options options = team_options(CAIRN_TEAM_JOINT, b);
    options.max_lag = 1e9;
    if (b == 1) {
      c.teams[0] = boat_open(&c.v, &options);
    } else {
      cairn_filter_options filter = planar_options(&c.v.boats[1][late].truth);
      const cairn_range_bearing radar = fleet_radar();
      if (start_covariance != NULL)
        memcpy(filter.initial_covariance, start_covariance, sizeof filter.initial_covariance);
      c.teams[1] = NULL;
      assert_ok(cairn_team_create(&options, &filter, &radar, &c.teams[1], NULL));
    }
  }
  for (size_t k = 0; k < late; ++k) {
    boat_step(c.teams[0], &c.v, 1, k);
    assert_int_equal(report_of(c.teams[0]).unsettled, 0);
  }
  assert_ok(cairn_team_add(c.teams[0], 2, &c.v.boats[1][late].truth, start_covariance, NULL));
  boat_add(c.teams[1], &c.v, 1); /* its pose before its first packet, which is requested */
  for (size_t k = late; k < STEPS; ++k) {
    boat_step(c.teams[0], &c.v, 1, k);
    if (k > late) boat_move(c.teams[1], &c.v, 2, k);
    boat_look(c.teams[1], &c.v, 2, k, LOOK_AT_ALL);
    post p = {NULL, 0, 0};
    for (int round = 0; round < 3; ++round) {
      for (size_t b = 0; b < 2; ++b) (void)post_collect(&p, c.teams[b], 0);
      for (size_t i = 0; i < p.count; ++i) (void)hand_over(c.teams[sender_of(&p.letters[i]) == 1], &p.letters[i]);
      post_free(&p);
    }
  }
  for (size_t b = 0; b < 2; ++b) assert_int_equal(report_of(c.teams[b]).unsettled, 0);
  assert_int_equal(report_of(c.teams[1]).taken, STEPS);
  assert_int_equal(report_of(c.teams[0]).taken, STEPS - late);
  for (size_t b = 0; b < 2; ++b) assert_int_equal(report_of(c.teams[b]).failed, 0);
  assert_replicas_agree(&c, 1e-6);
  crew_close(&c);
}

static void joining_late(void** state) {
  double covariance[36];
  (void)state;
  diagonal(covariance, 6, 0);
  covariance[0] = covariance[7] = 25, covariance[35] = 1e-4;
  join_late(covariance);
}

/* The new boat's start has zero covariance while a heading is uncertain: the two estimates differ only by rounding. */
static void joining_late_from_a_place_known_exactly(void** state) {
  (void)state;
  join_late(NULL);
}

/* Teammates accept every motion that the vehicle's own team accepts, even if its noise has few directions. */
static void noise_of_any_rank_is_told(void** state) {
  generator random = {77};
  (void)state;
  for (int n = 0; n < 400; ++n) {
    const cairn_pose start = pose_at(0, 0, 0, 0, 0, random_uniform(&random, -3, 3));
    const cairn_filter_options options = planar_options(&start);
    const cairn_range_bearing radar = fleet_radar();
    const cairn_team_options one = team_options(CAIRN_TEAM_JOINT, 1), two = team_options(CAIRN_TEAM_JOINT, 2);
    cairn_team *a = NULL, *b = NULL;
    assert_ok(cairn_team_create(&one, &options, &radar, &a, NULL));
    assert_ok(cairn_team_create(&two, &options, &radar, &b, NULL));
    assert_ok(cairn_team_add(a, 2, &start, NULL, NULL));
    cairn_twist_noise noise;
    assert_ok(cairn_twist_noise_init(&noise, sizeof noise, NULL));
    for (int i = 0; i < 3; ++i) noise.velocity_sigma[i] = noise.rate_sigma[i] = 0;
    if ((n & 1) != 0) noise.velocity_sigma[0] = random_uniform(&random, 1e-3, 1);
    if ((n & 2) != 0) noise.velocity_sigma[1] = random_uniform(&random, 1e-3, 1);
    if ((n & 4) != 0) noise.rate_sigma[2] = random_uniform(&random, 1e-4, 0.1);
    const double velocity[3] = {random_uniform(&random, -3, 3), random_uniform(&random, -1, 1), 0};
    const double rate[3] = {0, 0, random_uniform(&random, -1, 1)};
    assert_ok(cairn_team_predict_twist(b, random_uniform(&random, 0.01, 5), velocity, rate, &noise, NULL));
    if (n % 3 == 0) { /* given as a matrix of rank one */
      double g[3], covariance[36] = {0};
      static const int axes[3] = {0, 1, 5};
      for (int i = 0; i < 3; ++i) g[i] = random_normal(&random, 0.1);
      for (int i = 0; i < 9; ++i) covariance[6 * axes[i / 3] + axes[i % 3]] = g[i / 3] * g[i % 3];
      assert_ok(cairn_team_predict_increment(b, &start, covariance, NULL));
    }
    assert_ok(cairn_team_observe(b, 1, NULL, 0, NULL, 0, NULL));
    assert_ok(cairn_team_observe(a, 1, NULL, 0, NULL, 0, NULL));
    letter l = take_one(b);
    assert_int_equal(hand_over(a, &l), CAIRN_PACKET_TAKEN);
    free(l.bytes);
    cairn_team_destroy(a);
    cairn_team_destroy(b);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(whoever_is_never_heard_of_is_given_up),
      cmocka_unit_test(an_own_scan_that_does_not_fit_is_taken_in),
      cmocka_unit_test(what_is_lost_for_good_is_given_up),
      cmocka_unit_test(a_teammate_is_found_where_both_see_it),
      cmocka_unit_test(unknown_starts_are_found),
      cmocka_unit_test(whoever_leaves_is_waited_for_no_more),
      cmocka_unit_test(a_farewell_is_told),
      cmocka_unit_test(nothing_follows_a_farewell),
      cmocka_unit_test(nothing_is_taken_in_twice_over_a_return),
      cmocka_unit_test(joining_late),
      cmocka_unit_test(joining_late_from_a_place_known_exactly),
      cmocka_unit_test(noise_of_any_rank_is_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
