/* SPDX-License-Identifier: BSD-3-Clause */
/* The figures of a team: scores against the truth, normalised errors, and counters of packets. */
#include "team_crew.h"

static double frobenius(const double covariance[36]) {
  return sqrt(covariance[0] * covariance[0] + 2 * covariance[1] * covariance[1] + covariance[7] * covariance[7]);
}

static void scores_are_what_they_say(void** state) {
  (void)state;
  crew c;
  double claimed = 0, claimed_alone = 0, squared = 0, squared_alone = 0, nees_alone = 0;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  cairn_team_destroy(c.teams[0]);
  cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
  options.baseline = 1;
  c.teams[0] = boat_open(&c.v, &options);
  boat_add(c.teams[0], &c.v, 2);
  /* Two estimates of boat 1 by itself: one by a team of one vehicle, whose figures are known, and one by a filter. */
  options.mode = CAIRN_TEAM_MONO;
  cairn_team* mono = boat_open(&c.v, &options);
  cairn_filter* filter = NULL;
  const cairn_filter_options lone = planar_options(&c.v.boats[0][0].truth);
  const cairn_range_bearing radar = fleet_radar();
  const cairn_twist_noise noise = fleet_noise();
  int32_t sensor;
  assert_ok(cairn_filter_create(&lone, &filter, NULL));
  assert_ok(cairn_filter_add_range_bearing(filter, &radar, &sensor, NULL));
  assert_ok(cairn_filter_set_twist_noise(filter, &noise, NULL));
  assert_int_equal(report_of(c.teams[0]).scored, 0);
  assert_true(report_of(c.teams[0]).position_rmse == 0 && report_of(c.teams[0]).claimed_improvement == 0);
  size_t steps = 0, nees_steps = 0;
  for (size_t k = 0; k < STEPS; ++k) {
    const log_entry* e = &c.v.boats[0][k];
    const double velocity[3] = {e->speed, 0, 0}, rate[3] = {0, 0, e->rate};
    cairn_pose pose;
    double covariance[36], nees = 0;
    for (size_t b = 0; b < 2; ++b) boat_step(c.teams[b], &c.v, b + 1, k);
    boat_step(mono, &c.v, 1, k);
    post p = {NULL, 0, 0};
    (void)post_collect(&p, c.teams[1], 0);
    for (size_t i = 0; i < p.count; ++i) (void)hand_over(c.teams[0], &p.letters[i]);
    post_free(&p);
    (void)post_collect(&p, c.teams[0], 0);
    for (size_t i = 0; i < p.count; ++i) (void)hand_over(c.teams[1], &p.letters[i]);
    post_free(&p);
    if (k > 0) assert_ok(cairn_filter_predict_twist(filter, c.v.dt[k], velocity, rate, NULL));
    assert_ok(cairn_filter_update(filter, sensor, e->features, e->feature_count, NULL, NULL));
    assert_ok(cairn_team_score(c.teams[0], &e->truth, NULL));
    assert_ok(cairn_team_score(mono, &e->truth, NULL));
    ++steps;
    assert_ok(cairn_team_pose(c.teams[0], 1, &pose, covariance, NULL));
    claimed += frobenius(covariance);
    squared += pow(pose.position[0] - e->truth.position[0], 2) + pow(pose.position[1] - e->truth.position[1], 2);
    assert_ok(cairn_filter_pose(filter, &pose, covariance, NULL));
    claimed_alone += frobenius(covariance);
    squared_alone += pow(pose.position[0] - e->truth.position[0], 2) + pow(pose.position[1] - e->truth.position[1], 2);
    if (cairn_filter_pose_nees(filter, &e->truth, &nees, NULL) == CAIRN_OK) nees_alone += nees, ++nees_steps;
  }
  const cairn_team_report joint = report_of(c.teams[0]), single = report_of(mono);
  assert_int_equal(joint.scored, steps);
  assert_near(joint.position_rmse, sqrt(squared / (double)steps), 1e-9);
  assert_near(joint.claimed_improvement, 1 - claimed / claimed_alone, 1e-9);
  assert_near(joint.true_improvement, 1 - squared / squared_alone, 1e-9);
  assert_true(joint.claimed_improvement > 0.05);
  assert_near(single.position_rmse, sqrt(squared_alone / (double)steps), 1e-9);
  assert_near(single.claimed_improvement, 0, 1e-12);
  assert_near(single.true_improvement, 0, 1e-12);
  assert_near(single.anees_per_dof, nees_alone / (3 * (double)nees_steps), 1e-6);
  assert_true(nees_steps >= STEPS - 4); /* the start is known exactly, and the first noise has two directions */
  cairn_filter_destroy(filter);
  cairn_team_destroy(mono);
  crew_close(&c);
}

/* Both sides of the comparison are current: they include motion without a following scan, and steps that wait for
   teammates. */
static void a_score_between_scans_compares_like_with_like(void** state) {
  (void)state;
  voyage v;
  voyage_record(&v, 1, 5);
  cairn_team_options options = team_options(CAIRN_TEAM_MONO, 1);
  options.baseline = 1;
  cairn_team* team = boat_open(&v, &options);
  for (size_t k = 0; k < 20; ++k) {
    boat_move(team, &v, 1, k);
    if (k % 2 == 1) boat_look(team, &v, 1, k, LOOK_AT_FEATURES);
    assert_ok(cairn_team_score(team, &v.boats[0][k].truth, NULL));
  }
  assert_near(report_of(team).claimed_improvement, 0, 1e-12);
  assert_near(report_of(team).true_improvement, 0, 1e-12);
  cairn_team_destroy(team);
}

/* --- the normalised error of this vehicle's pose --- */

/* e^T P^-1 e in three dimensions, by the adjugate. */
static double normalised3(const double P[3][3], const double e[3]) {
  double sum = 0, determinant = 0, adjugate[3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      adjugate[i][k] = P[a][c] * P[b][d] - P[a][d] * P[b][c];
    }
  for (int k = 0; k < 3; ++k) determinant += P[0][k] * adjugate[k][0];
  for (int i = 0; i < 9; ++i) sum += e[i / 3] * adjugate[i / 3][i % 3] * e[i % 3];
  return sum / determinant;
}

static double heading_of(const cairn_pose* pose) {
  return 2 * atan2(pose->quaternion[3], pose->quaternion[0]);
}

/* Computed from the result of cairn_team_pose: the standard error directly, the invariant error as Log(T_true T_hat^-1)
   against J P J^T, positions counted from the start (docs/invariant_error.md). */
static double expected_nees(const cairn_team* team, const cairn_pose* start, const cairn_pose* truth, int32_t error) {
  static const int axes[3] = {0, 1, 5};
  cairn_pose pose;
  double covariance[36], P[3][3], J[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, own[3][3] = {{0}}, e[3];
  assert_ok(cairn_team_pose(team, 1, &pose, covariance, NULL));
  for (int i = 0; i < 9; ++i) P[i / 3][i % 3] = covariance[6 * axes[i / 3] + axes[i % 3]];
  for (int i = 0; i < 2; ++i) e[i] = truth->position[i] - pose.position[i];
  e[2] = remainder(heading_of(truth) - heading_of(&pose), 2 * PI);
  if (error == CAIRN_STATE_ERROR_STANDARD) return normalised3(P, e);
  const double x = pose.position[0] - start->position[0], y = pose.position[1] - start->position[1];
  const double turn = e[2], c = cos(turn), s = sin(turn);
  const double tx = truth->position[0] - start->position[0] - (c * x - s * y);
  const double ty = truth->position[1] - start->position[1] - (s * x + c * y);
  const double a = s / turn, b = (1 - c) / turn; /* t = [a -b; b a] e */
  e[0] = (a * tx + b * ty) / (a * a + b * b), e[1] = (a * ty - b * tx) / (a * a + b * b);
  J[0][2] = y, J[1][2] = -x;
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 9; ++k) own[i / 3][i % 3] += J[i / 3][k / 3] * P[k / 3][k % 3] * J[i % 3][k % 3];
  return normalised3((const double(*)[3])own, e);
}

/* With steps that were taken, and with steps that wait for a teammate. */
static void the_normalised_error_is_that_of_the_own_pose(void** state) {
  (void)state;
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
    voyage v;
    voyage_record(&v, 2, 5);
    const cairn_pose start = v.boats[0][0].truth;
    const cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
    cairn_filter_options filter = planar_options(&start);
    const cairn_range_bearing radar = fleet_radar();
    cairn_team* team = NULL;
    double sum = 0, nees = -7;
    filter.state_error = error;
    filter.initial_covariance[0] = 25, filter.initial_covariance[7] = 16, filter.initial_covariance[35] = 1e-4;
    filter.initial_covariance[1] = filter.initial_covariance[6] = 3;
    assert_ok(cairn_team_create(&options, &filter, &radar, &team, NULL));
    for (size_t k = 0; k < 20; ++k) {
      cairn_pose truth = v.boats[0][k].truth;
      if (k == 0) truth = pose_at(start.position[0] + 3, start.position[1] - 2, 0, 0, 0, heading_of(&start) + 0.01);
      if (k == 14) boat_add(team, &v, 2); /* which never sends a packet */
      boat_step(team, &v, 1, k);
      assert_ok(cairn_team_pose_nees(team, &truth, &nees, NULL));
      const double expected = expected_nees(team, &start, &truth, error);
      assert_true(expected > 0);
      assert_near(nees, expected, 1e-6 * expected);
      assert_ok(cairn_team_score(team, &truth, NULL));
      sum += nees;
    }
    assert_true(report_of(team).unsettled > 3);
    assert_int_equal(report_of(team).scored_nees, 20);
    assert_near(3 * 20 * report_of(team).anees_per_dof, sum, 1e-12 * sum);
    cairn_team_destroy(team);
  }
}

static void a_normalised_error_wants_a_regular_covariance(void** state) {
  (void)state;
  voyage v;
  voyage_record(&v, 1, 5);
  const cairn_pose* truth = &v.boats[0][0].truth;
  const cairn_pose tilted = pose_at(0, 0, 0, 0, 0.1, 0), lifted = pose_at(0, 0, 1, 0, 0, 0);
  const cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
  cairn_team* team = boat_open(&v, &options);
  double nees = -7;
  assert_refused(NULL, CAIRN_ERROR_NUMERICAL, "singular",
                 cairn_team_pose_nees(team, truth, &nees, NULL)); /* a known start */
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_pose_nees(NULL, truth, &nees, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "truth", cairn_team_pose_nees(team, NULL, &nees, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "truth", cairn_team_pose_nees(team, &tilted, &nees, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "truth", cairn_team_pose_nees(team, &lifted, &nees, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "nees", cairn_team_pose_nees(team, truth, NULL, NULL));
  assert_true(nees == -7); /* not written */
  assert_int_equal(report_of(team).scored, 0);
  cairn_team_destroy(team);
}

static void counters_count(void** state) {
  crew c;
  (void)state;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  post own = {NULL, 0, 0}, of_teammate = {NULL, 0, 0};
  for (size_t k = 0; k < 4; ++k)
    for (size_t b = 0; b < 2; ++b) boat_step(c.teams[b], &c.v, b + 1, k);
  (void)post_collect(&own, c.teams[0], 0);
  (void)post_collect(&of_teammate, c.teams[1], 0);
  const letter* by_number[4] = {NULL, NULL, NULL, NULL};
  for (size_t i = 0; i < of_teammate.count; ++i)
    if (kind_of(&of_teammate.letters[i]) == DATA)
      by_number[number_of(&of_teammate.letters[i])] = &of_teammate.letters[i];
  cairn_team* team = c.teams[0];
  assert_int_equal(hand_over(team, by_number[1]), CAIRN_PACKET_WAITING);
  assert_int_equal(hand_over(team, by_number[1]), CAIRN_PACKET_REPEATED);
  assert_int_equal(report_of(team).reordered, 0);
  assert_int_equal(hand_over(team, by_number[0]), CAIRN_PACKET_TAKEN);
  assert_int_equal(report_of(team).reordered, 1);
  assert_int_equal(report_of(team).unsettled, 2);
  assert_int_equal(hand_over(team, by_number[0]), CAIRN_PACKET_REPEATED);
  assert_int_equal(hand_over(team, &own.letters[0]), CAIRN_PACKET_OWN);
  for (size_t i = 0; i < of_teammate.count; ++i)
    if (kind_of(&of_teammate.letters[i]) == REQUEST) {
      assert_int_equal(hand_over(team, &of_teammate.letters[i]), CAIRN_PACKET_REQUEST);
      break;
    }
  post again = {NULL, 0, 0};
  (void)post_collect(&again, team, 0);
  const cairn_team_report r = report_of(team);
  assert_int_equal(r.sent, 4);
  assert_int_equal(r.taken, 2);
  assert_int_equal(r.repeated, 2);
  assert_int_equal(r.own, 1);
  assert_int_equal(r.received, 6);
  assert_int_equal(r.resent, 4);
  assert_int_equal(again.count, 4);
  assert_true(r.requested > 0);
  assert_true(r.matched + r.placed + r.rejected > 10);
  post_free(&own), post_free(&of_teammate), post_free(&again);
  crew_close(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(scores_are_what_they_say),
      cmocka_unit_test(a_score_between_scans_compares_like_with_like),
      cmocka_unit_test(the_normalised_error_is_that_of_the_own_pose),
      cmocka_unit_test(a_normalised_error_wants_a_regular_covariance),
      cmocka_unit_test(counters_count),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
