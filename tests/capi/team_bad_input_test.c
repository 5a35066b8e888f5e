/* SPDX-License-Identifier: BSD-3-Clause */
/* What a team refuses: options, calls, and above all packets, which anybody may send. Whatever it is, the estimate
 * stays as it was, to the bit. */
#include "teams.h"

/* --- options --- */

static cairn_status try_create(const cairn_team_options* options, const cairn_filter_options* filter,
                               const cairn_range_bearing* radar) {
  cairn_team* const untouched = (cairn_team*)(void*)&filter;
  cairn_team* team = untouched;
  const cairn_status status = cairn_team_create(options, filter, radar, &team);
  if (status != CAIRN_OK)
    assert_ptr_equal(team, untouched); /* not written */
  else
    cairn_team_destroy(team);
  return status;
}

static void options_out_of_range(void** state) {
  const cairn_pose start = pose_at(0, 0, 0, 0, 0, 0);
  const cairn_filter_options filter = planar_options(&start);
  const cairn_range_bearing radar = fleet_radar();
  const cairn_team_options good = team_options(CAIRN_TEAM_JOINT, 1);
  cairn_team_options o;
  (void)state;
  assert_ok(try_create(&good, &filter, &radar));
#define REFUSED(field, value)                                                                       \
  do {                                                                                              \
    o = good;                                                                                       \
    o.field = (value);                                                                              \
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options." #field, try_create(&o, &filter, &radar)); \
  } while (0)
#define TAKEN(field, value)                     \
  do {                                          \
    o = good;                                   \
    o.field = (value);                          \
    assert_ok(try_create(&o, &filter, &radar)); \
  } while (0)
  REFUSED(mode, -1);
  REFUSED(mode, 5);
  REFUSED(mode, INT32_MAX);
  REFUSED(mode, INT32_MIN);
  REFUSED(vehicle, CAIRN_ID_NONE);
  TAKEN(vehicle, CAIRN_ID_NONE - 1);
  REFUSED(max_vehicles, 0);
  REFUSED(max_vehicles, 257);
  REFUSED(max_vehicles, UINT32_MAX);
  TAKEN(max_vehicles, 1);
  TAKEN(max_vehicles, 256);
  REFUSED(baseline, 2);
  REFUSED(baseline, UINT32_MAX);
  REFUSED(max_waiting, 0);
  REFUSED(max_waiting, 1000001);
  TAKEN(max_waiting, 1);
  TAKEN(max_waiting, 1000000);
  REFUSED(history, 0);
  REFUSED(history, 1000001);
  TAKEN(history, 1);
  for (size_t i = 0; i < LENGTH(not_finite); ++i) {
    REFUSED(max_lag, not_finite[i]);
    REFUSED(time_tolerance, not_finite[i]);
  }
  REFUSED(max_lag, 0);
  REFUSED(max_lag, -1);
  TAKEN(max_lag, 5e-324);
  REFUSED(time_tolerance, -1e-9);
  TAKEN(time_tolerance, 0);
#undef REFUSED
#undef TAKEN
}

static void options_that_do_not_go_together(void** state) {
  const cairn_pose start = pose_at(0, 0, 0, 0, 0, 0);
  const cairn_filter_options good = planar_options(&start);
  const cairn_range_bearing radar = fleet_radar();
  (void)state;
  cairn_filter_options filter = good;
  filter.vehicle = CAIRN_VEHICLE_SPATIAL;
  for (int32_t mode = CAIRN_TEAM_MONO; mode <= CAIRN_TEAM_JOINT; ++mode) {
    const cairn_team_options o = team_options(mode, 1);
    filter = good, filter.vehicle = CAIRN_VEHICLE_SPATIAL;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", try_create(&o, &filter, &radar));
    filter = good, filter.submap_landmarks = 5;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "submap_landmarks", try_create(&o, &filter, &radar));
    filter = good, filter.initial_pose.position[2] = 0.1;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "initial_pose", try_create(&o, &filter, &radar));
    filter = good, filter.initial_pose = pose_at(0, 0, 0, 0.1, 0, 0);
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "initial_pose", try_create(&o, &filter, &radar));
    filter = good, filter.initial_covariance[0] = -1;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "initial_covariance", try_create(&o, &filter, &radar));
    filter = good, filter.max_landmarks = 0;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "max_landmarks", try_create(&o, &filter, &radar));
    filter = good, filter.struct_size = 4;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options", try_create(&o, &filter, &radar));
    cairn_range_bearing bad = radar;
    bad.range_sigma = 0;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "range_sigma", try_create(&o, &good, &bad));
    bad = radar, bad.bearing_sigma = NAN;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "bearing_sigma", try_create(&o, &good, &bad));
    bad = radar, bad.near_range = 0;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "near_range", try_create(&o, &good, &bad));
    const bool extended = mode == CAIRN_TEAM_EO_DIAGONAL || mode == CAIRN_TEAM_EO_FULL;
    bad = radar, bad.T_body_sensor = pose_at(1, 0, 0, 0, 0, 0);
    assert_status(try_create(&o, &good, &bad), extended ? CAIRN_ERROR_ARGUMENT : CAIRN_OK);
    bad.T_body_sensor = pose_at(0, 0, 0, 0, 0, 0.1);
    assert_status(try_create(&o, &good, &bad), extended ? CAIRN_ERROR_ARGUMENT : CAIRN_OK);
    bad.T_body_sensor = pose_at(0, 0, 0, 0.1, 0, 0);
    assert_status(try_create(&o, &good, &bad), CAIRN_ERROR_ARGUMENT);
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options", try_create(NULL, &good, &radar));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options", try_create(&o, NULL, &radar));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "NULL", try_create(&o, &good, NULL));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_create(&o, &good, &radar, NULL));
  }
  const cairn_team_options submaps = team_options(CAIRN_TEAM_SUBMAPS, 1);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "submap_landmarks", try_create(&submaps, &good, &radar));
  cairn_team_destroy(NULL);
}

/* Callers older and newer than the library, and a byte behind their struct that is nobody's. */
static void structs_of_other_sizes(void** state) {
  const cairn_pose start = pose_at(0, 0, 0, 0, 0, 0);
  const cairn_filter_options filter = planar_options(&start);
  const cairn_range_bearing radar = fleet_radar();
  cairn_team_options good = team_options(CAIRN_TEAM_JOINT, 1);
  cairn_team* team = NULL;
  (void)state;
  assert_ok(cairn_team_create(&good, &filter, &radar, &team));
  for (uint32_t size = 0; size < sizeof(cairn_team_report) + 40; ++size) {
    unsigned char buffer[sizeof(cairn_team_report) + 48];
    memset(buffer, 0xa5, sizeof buffer);
    const bool fine = size >= 8;
    const cairn_status expected = fine ? CAIRN_OK : CAIRN_ERROR_ARGUMENT;
    assert_status(cairn_team_options_init((cairn_team_options*)(void*)buffer, size), expected);
    for (size_t i = fine ? size : 0; i < sizeof buffer; ++i) assert_int_equal(buffer[i], 0xa5);
    if (fine) { /* in a buffer of its own, so that nothing behind it can be read */
      void* exact = malloc(size);
      assert_non_null(exact);
      memcpy(exact, buffer, size);
      assert_ok(try_create(exact, &filter, &radar));
      free(exact);
    }
    memset(buffer, 0xa5, sizeof buffer);
    memcpy(buffer, &size, sizeof size);
    assert_status(cairn_team_last_report(team, (cairn_team_report*)(void*)buffer), expected);
    const size_t written = !fine ? sizeof size : size < sizeof(cairn_team_report) ? size : sizeof(cairn_team_report);
    for (size_t i = written; i < sizeof buffer; ++i) assert_int_equal(buffer[i], 0xa5);
  }
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options", cairn_team_options_init(NULL, sizeof good));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "report", cairn_team_last_report(team, NULL));
  good.struct_size = UINT32_MAX;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options", try_create(&good, &filter, &radar));
  cairn_team_destroy(team);
}

/* --- calls --- */

/* Boats 1 and 2 under way, both with much to tell; the tests spoil what boat 1 gets. */
typedef struct stage {
  voyage v;
  cairn_team *a, *b;
  letter next; /* of boat 2, that boat 1 takes */
  post old;    /* of boat 2, that boat 1 took */
  snapshot before, after;
} stage;

#define UNDER_WAY 6

static void stage_open(stage* s) {
  memset(s, 0, sizeof *s);
  voyage_record(&s->v, 2, 21);
  cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
  options.max_vehicles = 3, options.max_waiting = 5;
  s->a = boat_open(&s->v, &options);
  options.vehicle = 2, options.max_waiting = 4096;
  s->b = boat_open(&s->v, &options);
  boat_add(s->a, &s->v, 2);
  for (size_t k = 0; k < UNDER_WAY; ++k) {
    boat_step(s->a, &s->v, 1, k);
    boat_step(s->b, &s->v, 2, k);
    const letter own = take_one(s->a);
    free(own.bytes);
    (void)post_collect(&s->old, s->b, 0);
    assert_int_equal(hand_over(s->a, &s->old.letters[k]), CAIRN_PACKET_TAKEN);
  }
  boat_step(s->a, &s->v, 1, UNDER_WAY);
  boat_step(s->b, &s->v, 2, UNDER_WAY);
  s->next = take_one(s->b);
  post p = {NULL, 0, 0};
  (void)post_collect(&p, s->a, 0);
  post_free(&p);
  team_snapshot(&s->before, s->a);
}

/* However much it was bothered, the next good packet is taken. */
static void stage_close(stage* s) {
  team_snapshot(&s->after, s->a);
  assert_true(snapshot_same(&s->before, &s->after));
  assert_int_equal(hand_over(s->a, &s->next), CAIRN_PACKET_TAKEN);
  team_snapshot(&s->after, s->a);
  assert_false(snapshot_same(&s->before, &s->after));
  assert_int_equal(report_of(s->a).failed, 0);
  cairn_team_destroy(s->a);
  cairn_team_destroy(s->b);
  free(s->next.bytes);
  post_free(&s->old);
  snapshot_free(&s->before);
  snapshot_free(&s->after);
}

static void unchanged(stage* s) {
  team_snapshot(&s->after, s->a);
  if (!snapshot_same(&s->before, &s->after)) fail_msg("the estimate has changed");
}

static void members(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  const cairn_pose start = s.v.boats[0][0].truth;
  cairn_pose bad = start;
  double covariance[36];
  uint64_t numbers[4] = {77, 77, 77, 77};
  size_t needed = 99;
  diagonal(covariance, 6, 1e-2);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicle", cairn_team_add(s.a, 1, &start, covariance)); /* the own one */
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicle", cairn_team_add(s.a, 1, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicle", cairn_team_add(s.a, 2, &start, covariance)); /* twice */
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicle", cairn_team_add(s.a, CAIRN_ID_NONE, &start, covariance));
  bad.position[2] = 1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "start", cairn_team_add(s.a, 3, &bad, covariance));
  bad = start, bad.position[1] = NAN;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "start", cairn_team_add(s.a, 3, &bad, covariance));
  bad = pose_at(0, 0, 0, 0, 0.1, 0);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "start", cairn_team_add(s.a, 3, &bad, covariance));
  covariance[7] = -1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance", cairn_team_add(s.a, 3, &start, covariance));
  covariance[7] = INFINITY;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance", cairn_team_add(s.a, 3, &start, covariance));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_add(NULL, 3, &start, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicle", cairn_team_remove(s.a, 1));
  assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "vehicle", cairn_team_remove(s.a, 3));
  assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "vehicle", cairn_team_remove(s.a, CAIRN_ID_NONE));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_remove(NULL, 2));
  unchanged(&s);
  /* Room for one more, and no more. */
  diagonal(covariance, 6, 1e-2);
  assert_ok(cairn_team_add(s.a, 3, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_vehicles", cairn_team_add(s.a, 4, &start, covariance));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_vehicles", cairn_team_add(s.a, 4, NULL, NULL));
  assert_status(cairn_team_members(s.a, numbers, 2, &needed), CAIRN_ERROR_BUFFER);
  assert_int_equal(needed, 3);
  for (int i = 0; i < 4; ++i) assert_int_equal(numbers[i], 77);
  assert_status(cairn_team_members(s.a, numbers, 4, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_members(s.a, NULL, 4, &needed), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_members(NULL, numbers, 4, &needed), CAIRN_ERROR_ARGUMENT);
  assert_ok(cairn_team_remove(s.a, 3));
  stage_close(&s);
}

static void motions(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  cairn_pose move = pose_at(1, 0, 0, 0, 0, 0.1);
  double c[36], v[3] = {1, 0, 0}, w[3] = {0, 0, 0.1};
  cairn_twist_noise noise = fleet_noise();
  diagonal(c, 6, 1e-4);
  for (size_t n = 0; n < LENGTH(not_finite); ++n) {
    for (int i = 0; i < 3; ++i) {
      const double good_v = v[i], good_w = w[i], good_p = move.position[i];
      v[i] = not_finite[n];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "velocity", cairn_team_predict_twist(s.a, 1, v, w, NULL));
      v[i] = good_v, w[i] = not_finite[n];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rate", cairn_team_predict_twist(s.a, 1, v, w, NULL));
      w[i] = good_w, move.position[i] = not_finite[n];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_team_predict_increment(s.a, &move, c));
      move.position[i] = good_p;
    }
    c[7] = not_finite[n];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance", cairn_team_predict_increment(s.a, &move, c));
    c[7] = 1e-4;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "dt", cairn_team_predict_twist(s.a, not_finite[n], v, w, NULL));
  }
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "dt", cairn_team_predict_twist(s.a, 0, v, w, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "dt", cairn_team_predict_twist(s.a, -1, v, w, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "velocity", cairn_team_predict_twist(s.a, 1, NULL, w, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rate", cairn_team_predict_twist(s.a, 1, v, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_predict_twist(NULL, 1, v, w, NULL));
  noise.rate_sigma[2] = -1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rate_sigma", cairn_team_predict_twist(s.a, 1, v, w, &noise));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_team_predict_increment(s.a, NULL, c));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance", cairn_team_predict_increment(s.a, &move, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_predict_increment(NULL, &move, c));
  move = pose_at(1, 0, 0, 0, 0.1, 0);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_team_predict_increment(s.a, &move, c));
  move = pose_at(1, 0, 0.1, 0, 0, 0);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_team_predict_increment(s.a, &move, c));
  move = pose_at(1, 0, 0, 0, 0, 0.1), c[35] = -1e-4;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance", cairn_team_predict_increment(s.a, &move, c));
  v[0] = 1e300;
  assert_refused(NULL, CAIRN_ERROR_NUMERICAL, "", cairn_team_predict_twist(s.a, 1e10, v, w, NULL));
  stage_close(&s);
}

/* As many motions as a packet has room for, and one more. */
static void too_many_motions(void** state) {
  const cairn_pose start = pose_at(0, 0, 0, 0, 0, 0), step = pose_at(1e-3, 0, 0, 0, 0, 0);
  const cairn_filter_options filter = planar_options(&start);
  const cairn_range_bearing radar = fleet_radar();
  const cairn_team_options one = team_options(CAIRN_TEAM_JOINT, 1), two = team_options(CAIRN_TEAM_JOINT, 2);
  cairn_team *a = NULL, *b = NULL;
  cairn_pose pose;
  double c[36];
  (void)state;
  diagonal(c, 6, 1e-10);
  assert_ok(cairn_team_create(&one, &filter, &radar, &a));
  assert_ok(cairn_team_create(&two, &filter, &radar, &b));
  assert_ok(cairn_team_add(a, 2, &start, NULL));
  for (int i = 0; i < 65535; ++i) assert_ok(cairn_team_predict_increment(b, &step, c));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "prediction", cairn_team_predict_increment(b, &step, c));
  assert_ok(cairn_team_observe(b, 1, NULL, 0, NULL, 0));
  assert_ok(cairn_team_predict_increment(b, &step, c));
  letter l = take_one(b);
  assert_ok(cairn_team_observe(a, 1, NULL, 0, NULL, 0));
  assert_int_equal(hand_over(a, &l), CAIRN_PACKET_TAKEN);
  assert_ok(cairn_team_pose(a, 2, &pose, NULL));
  assert_near(pose.position[0], 65.535, 1e-6);
  free(l.bytes);
  cairn_team_destroy(a);
  cairn_team_destroy(b);
}

static void observations(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  const double later = s.v.time[UNDER_WAY] + 5;
  cairn_observation many[FEATURES + BOATS + 1], o[3], mate[2];
  memset(many, 0, sizeof many), memset(o, 0, sizeof o), memset(mate, 0, sizeof mate);
  for (size_t i = 0; i < 3; ++i) o[i].id = i + 1, o[i].z[0] = 1000, o[i].z[1] = 0.1 * (double)i;
  for (size_t i = 0; i < LENGTH(many); ++i) many[i].id = i, many[i].z[0] = 1000;
  mate[0] = o[0], mate[0].id = 2;
  mate[1] = o[0], mate[1].id = 3;
#define LOOK(time, mates) cairn_team_observe(s.a, (time), o, 3, mate, (mates))
  for (size_t n = 0; n < LENGTH(not_finite); ++n) {
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "time", LOOK(not_finite[n], 2));
    for (int k = 0; k < 2; ++k) {
      o[2].z[k] = not_finite[n];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[2].z", LOOK(later, 2));
      o[2].z[0] = 1000, o[2].z[1] = 0.2;
      mate[1].z[k] = not_finite[n];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles[1].z", LOOK(later, 2));
      mate[1].z[0] = 1000, mate[1].z[1] = 0;
    }
    o[1].covariance[3] = not_finite[n], o[1].covariance[0] = 1;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[1].covariance", LOOK(later, 2));
    memset(o[1].covariance, 0, sizeof o[1].covariance);
  }
  o[0].z[0] = -1e-9;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[0].z", LOOK(later, 2));
  o[0].z[0] = 1000, mate[0].z[0] = -1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles[0].z", LOOK(later, 2));
  mate[0].z[0] = 1000;
  o[0].covariance[0] = 1, o[0].covariance[3] = -1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[0].covariance", LOOK(later, 2));
  o[0].covariance[3] = 0;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[0].covariance", LOOK(later, 2));
  memset(o[0].covariance, 0, sizeof o[0].covariance);
  o[1].id = 1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "observations", LOOK(later, 2));
  o[1].id = CAIRN_ID_NONE;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[1].id", LOOK(later, 2));
  o[1].id = 2, mate[1].id = 2;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles", LOOK(later, 2));
  mate[1].id = CAIRN_ID_NONE;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles[1].id", LOOK(later, 2));
  mate[1].id = 1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles", LOOK(later, 2)); /* itself */
  mate[1].id = 3;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "time", LOOK(s.v.time[UNDER_WAY], 2)); /* the last one again */
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "time", LOOK(s.v.time[UNDER_WAY] - 1e-9, 2));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "time", LOOK(-1e300, 2));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_observations",
                 cairn_team_observe(s.a, later, many, FEATURES + BOATS + 1, NULL, 0));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_observations",
                 cairn_team_observe(s.a, later, many, FEATURES + BOATS - 1, mate, 2));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks", cairn_team_observe(s.a, later, NULL, 1, NULL, 0));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles", cairn_team_observe(s.a, later, NULL, 0, NULL, 1));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_observe(NULL, later, o, 3, NULL, 0));
#undef LOOK
  assert_int_equal(report_of(s.a).sent, UNDER_WAY + 1); /* nobody was told */
  stage_close(&s);
}

/* Counts that no array has: refused before anything is taken for them. */
static void absurd_counts(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  cairn_observation o;
  memset(&o, 0, sizeof o);
  o.z[0] = 1000;
  const size_t absurd[] = {SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / sizeof(cairn_observation) + 1};
  for (size_t i = 0; i < LENGTH(absurd); ++i) {
    assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_observations",
                   cairn_team_observe(s.a, 1e6, &o, absurd[i], NULL, 0));
    assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_observations",
                   cairn_team_observe(s.a, 1e6, NULL, 0, &o, absurd[i]));
  }
  stage_close(&s);
}

static void questions(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  cairn_pose pose, kept;
  cairn_match matches[2];
  uint8_t byte = 0x5a;
  double covariance[36];
  size_t needed = 0;
  memset(&pose, 0x5a, sizeof pose);
  kept = pose;
  assert_status(cairn_team_pose(s.a, 3, &pose, covariance), CAIRN_ERROR_NOT_FOUND);
  assert_status(cairn_team_pose(s.a, CAIRN_ID_NONE, &pose, covariance), CAIRN_ERROR_NOT_FOUND);
  assert_status(cairn_team_pose(NULL, 1, &pose, covariance), CAIRN_ERROR_ARGUMENT);
  assert_memory_equal(&pose, &kept, sizeof pose);
  assert_ok(cairn_team_pose(s.a, 1, NULL, NULL));
  assert_null(cairn_team_map(NULL));
  assert_ok(cairn_team_decisions(s.a, NULL, 0, &needed));
  assert_true(needed > 2);
  memset(matches, 0x5a, sizeof matches);
  assert_status(cairn_team_decisions(s.a, matches, 2, &needed), CAIRN_ERROR_BUFFER);
  assert_int_equal(matches[0].result, 0x5a5a5a5a);
  assert_status(cairn_team_decisions(s.a, matches, 2, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_decisions(NULL, matches, 2, &needed), CAIRN_ERROR_ARGUMENT);
  assert_ok(cairn_team_take_packet(s.a, &byte, 1, &needed)); /* none is there */
  assert_int_equal(needed, 0);
  boat_step(s.b, &s.v, 2, UNDER_WAY + 1);
  assert_status(cairn_team_take_packet(s.b, &byte, 1, &needed), CAIRN_ERROR_BUFFER);
  assert_int_equal(byte, 0x5a);
  const size_t size = needed;
  assert_status(cairn_team_take_packet(s.b, NULL, 1, &needed), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_take_packet(s.b, &byte, 1, NULL), CAIRN_ERROR_ARGUMENT);
  assert_ok(cairn_team_take_packet(s.b, NULL, 0, &needed)); /* it is still there */
  assert_int_equal(needed, size);
  assert_status(cairn_team_take_packet(NULL, &byte, 1, &needed), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_receive(NULL, &byte, 1, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_receive(s.a, NULL, 1, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_leave(NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_ask(NULL), CAIRN_ERROR_ARGUMENT);
  pose = pose_at(0, 0, 1, 0, 0, 0);
  assert_status(cairn_team_score(s.a, &pose), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_score(s.a, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_score(NULL, &kept), CAIRN_ERROR_ARGUMENT);
  assert_int_equal(report_of(s.a).scored, 0);
  cairn_team_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_status(cairn_team_last_report(NULL, &report), CAIRN_ERROR_ARGUMENT);
  stage_close(&s);
}

/* --- packets --- */

/* Hands a copy over, in a buffer of exactly its size; tells what became of it. */
static int32_t give(stage* s, const uint8_t* bytes, size_t size) {
  int32_t result = 0;
  uint8_t* exact = malloc(size + (size == 0));
  assert_non_null(exact);
  memcpy(exact, bytes, size);
  assert_ok(cairn_team_receive(s->a, exact, size, &result));
  free(exact);
  return result;
}

static void write_number(uint8_t* at, uint64_t value, size_t bytes) {
  for (size_t i = 0; i < bytes; ++i) at[i] = (uint8_t)(value >> (8 * i));
}
static void write_real(uint8_t* at, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  write_number(at, bits, 8);
}

static void packets_cut_short(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  for (size_t size = 0; size < s.next.size; ++size)
    assert_int_equal(give(&s, s.next.bytes, size), size < 4 ? CAIRN_PACKET_FOREIGN : CAIRN_PACKET_CUT);
  uint8_t* longer = calloc(1, s.next.size + 8);
  assert_non_null(longer);
  memcpy(longer, s.next.bytes, s.next.size);
  for (size_t more = 1; more <= 8; ++more) assert_int_equal(give(&s, longer, s.next.size + more), CAIRN_PACKET_CUT);
  free(longer);
  const cairn_team_report r = report_of(s.a);
  assert_int_equal(r.foreign, 4);
  assert_int_equal(r.cut, s.next.size - 4 + 8);
  unchanged(&s);
  /* Cut with a size and a checksum that fit what is left. */
  for (size_t size = 16; size < s.next.size; ++size) {
    uint8_t* cut = malloc(size);
    assert_non_null(cut);
    memcpy(cut, s.next.bytes, size);
    write_number(cut + AT_SIZE, size, 4);
    seal(cut, size);
    assert_int_equal(give(&s, cut, size), CAIRN_PACKET_NONSENSE);
    free(cut);
  }
  stage_close(&s);
}

static void every_byte_flipped(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  for (size_t i = 0; i < s.next.size; ++i)
    for (int bit = 0; bit < 9; ++bit) {
      const uint8_t good = s.next.bytes[i];
      s.next.bytes[i] ^= (uint8_t)(bit < 8 ? 1 << bit : 0xff);
      const int32_t expected = i < 4            ? CAIRN_PACKET_FOREIGN
                               : i < AT_KIND    ? CAIRN_PACKET_VERSION
                               : i < AT_SIZE    ? CAIRN_PACKET_CORRUPT
                               : i < AT_VEHICLE ? CAIRN_PACKET_CUT
                                                : CAIRN_PACKET_CORRUPT;
      assert_int_equal(give(&s, s.next.bytes, s.next.size), expected);
      s.next.bytes[i] = good;
    }
  stage_close(&s);
}

static void foreign_bytes(void** state) {
  stage s;
  generator random = {3};
  uint8_t bytes[300];
  (void)state;
  stage_open(&s);
  assert_int_equal(give(&s, bytes, 0), CAIRN_PACKET_FOREIGN);
  for (int n = 0; n < 2000; ++n) {
    const size_t size = (size_t)(random_bits(&random) % sizeof bytes);
    for (size_t i = 0; i < size; ++i) bytes[i] = (uint8_t)random_bits(&random);
    if (n % 2 == 0 && size >= 8) { /* a good beginning */
      memcpy(bytes, s.next.bytes, 8);
      if (size >= 12) write_number(bytes + AT_SIZE, size, 4);
      if (size >= 16 && n % 4 == 0) seal(bytes, size);
    }
    assert_true(give(&s, bytes, size) >= CAIRN_PACKET_UNKNOWN);
  }
  const cairn_team_report r = report_of(s.a);
  assert_int_equal(r.taken, UNDER_WAY);
  assert_int_equal(r.received, UNDER_WAY + 2001);
  stage_close(&s);
}

/* A change to a good packet that is sealed again: what a broken sender, or an evil one, could send. */
static int32_t give_changed(stage* s, size_t at, uint64_t value, size_t bytes) {
  uint8_t* copy = malloc(s->next.size);
  assert_non_null(copy);
  memcpy(copy, s->next.bytes, s->next.size);
  write_number(copy + at, value, bytes);
  seal(copy, s->next.size);
  const int32_t result = give(s, copy, s->next.size);
  free(copy);
  return result;
}
static int32_t give_real(stage* s, size_t at, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  return give_changed(s, at, bits, 8);
}

static void heads_that_do_not_fit(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  const uint64_t number = number_of(&s.next);
  assert_int_equal(number, UNDER_WAY);
  assert_int_equal(give_changed(&s, AT_VERSION, 0, 2), CAIRN_PACKET_VERSION);
  assert_int_equal(give_changed(&s, AT_VERSION, 2, 2), CAIRN_PACKET_VERSION);
  assert_int_equal(give_changed(&s, AT_VERSION, 0xffff, 2), CAIRN_PACKET_VERSION);
  assert_int_equal(give_changed(&s, AT_KIND, 0, 2), CAIRN_PACKET_NONSENSE);
  assert_int_equal(give_changed(&s, AT_KIND, 4, 2), CAIRN_PACKET_NONSENSE);
  assert_int_equal(give_changed(&s, AT_KIND, REQUEST, 2), CAIRN_PACKET_NONSENSE); /* too long for one */
  assert_int_equal(give_changed(&s, AT_VEHICLE, 3, 8), CAIRN_PACKET_UNKNOWN);
  assert_int_equal(give_changed(&s, AT_VEHICLE, CAIRN_ID_NONE, 8), CAIRN_PACKET_UNKNOWN);
  unchanged(&s);
  /* By the own number: another vehicle of that name. (Its sighting of 1 would be of itself: nonsense first.) */
  const int32_t own = give_changed(&s, AT_VEHICLE, 1, 8);
  assert_true(own == CAIRN_PACKET_CONFLICT || own == CAIRN_PACKET_NONSENSE);
  /* Numbers that were here, with another content. */
  for (uint64_t n = 0; n < number; ++n) assert_int_equal(give_changed(&s, AT_NUMBER, n, 8), CAIRN_PACKET_CONFLICT);
  /* Times that do not fit. */
  const double past[] = {-1e300, -1, 0, s.v.time[UNDER_WAY - 1]};
  for (size_t i = 0; i < LENGTH(past); ++i) assert_int_equal(give_real(&s, AT_TIME, past[i]), CAIRN_PACKET_PAST);
  for (size_t i = 0; i < LENGTH(not_finite); ++i)
    assert_int_equal(give_real(&s, AT_TIME, not_finite[i]), CAIRN_PACKET_NONSENSE);
  for (size_t i = 0; i < s.old.count; ++i)
    assert_int_equal(give(&s, s.old.letters[i].bytes, s.old.letters[i].size), CAIRN_PACKET_REPEATED);
  const cairn_team_report r = report_of(s.a);
  assert_int_equal(r.version, 3);
  assert_int_equal(r.unknown, 2);
  assert_int_equal(r.conflict, UNDER_WAY + (own == CAIRN_PACKET_CONFLICT));
  assert_int_equal(r.past, LENGTH(past));
  assert_int_equal(r.repeated, UNDER_WAY);
  assert_int_equal(r.nonsense, 3 + LENGTH(not_finite) + (own == CAIRN_PACKET_NONSENSE));
  stage_close(&s);
}

/* Two boats that both go by number 2: the first one's packets stand. */
static void two_vehicles_of_one_number(void** state) {
  stage s;
  voyage other;
  (void)state;
  stage_open(&s);
  voyage_record(&other, 2, 22);
  const cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 2);
  cairn_team* impostor = boat_open(&other, &options);
  for (size_t k = 0; k < UNDER_WAY; ++k) {
    boat_step(impostor, &other, 2, k);
    letter l = take_one(impostor);
    assert_int_equal(hand_over(s.a, &l), CAIRN_PACKET_CONFLICT);
    free(l.bytes);
  }
  assert_int_equal(report_of(s.a).conflict, UNDER_WAY);
  cairn_team_destroy(impostor);
  /* And one that goes by the own number. */
  const cairn_team_options own = team_options(CAIRN_TEAM_JOINT, 1);
  impostor = boat_open(&other, &own);
  boat_step(impostor, &other, 1, 0);
  letter l = take_one(impostor);
  assert_int_equal(hand_over(s.a, &l), CAIRN_PACKET_CONFLICT);
  free(l.bytes);
  cairn_team_destroy(impostor);
  stage_close(&s);
}

/* Those that wait contradict each other, too, and there is room for so many only. */
static void packets_that_wait(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  post later = {NULL, 0, 0};
  for (size_t k = UNDER_WAY + 1; k < UNDER_WAY + 8; ++k) boat_step(s.b, &s.v, 2, k);
  (void)post_collect(&later, s.b, 0);
  assert_int_equal(later.count, 7);
  for (size_t i = 0; i < later.count; ++i)
    assert_int_equal(give(&s, later.letters[i].bytes, later.letters[i].size),
                     i < 5 ? CAIRN_PACKET_WAITING : CAIRN_PACKET_FULL);
  for (size_t i = 0; i < 5; ++i) {
    letter* l = &later.letters[i];
    assert_int_equal(give(&s, l->bytes, l->size), CAIRN_PACKET_REPEATED);
    write_real(l->bytes + AT_TIME, s.v.time[number_of(l)] + 0.5);
    seal(l->bytes, l->size);
    assert_int_equal(give(&s, l->bytes, l->size), CAIRN_PACKET_CONFLICT);
  }
  /* A fresh number between those that wait, at a time that is not between theirs. */
  assert_int_equal(give_real(&s, AT_TIME, s.v.time[UNDER_WAY + 3]), CAIRN_PACKET_PAST);
  const cairn_team_report r = report_of(s.a);
  assert_true(r.full == 2 && r.conflict == 5 && r.repeated == 5 && r.past == 1);
  unchanged(&s);
  post_free(&later);
  cairn_team_destroy(s.a), cairn_team_destroy(s.b);
  free(s.next.bytes);
  post_free(&s.old);
  snapshot_free(&s.before), snapshot_free(&s.after);
}

/* --- content --- built by hand: [head] counts, motions of 10, sightings of 6 words */

typedef struct content {
  uint8_t bytes[4096];
  size_t size;
} content;

static void put(content* c, uint64_t value, size_t bytes) {
  assert_true(c->size + bytes <= sizeof c->bytes);
  write_number(c->bytes + c->size, value, bytes);
  c->size += bytes;
}
static void put_real(content* c, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  put(c, bits, 8);
}

typedef struct sighting {
  uint64_t id;
  double values[5]; /* range, bearing, covariance 00 01 11 */
} sighting;

static int32_t give_content(stage* s, uint32_t motion_count, const double (*motion)[10], uint32_t landmark_count,
                            const sighting* landmarks, uint32_t vehicle_count, const sighting* vehicles) {
  content c;
  c.size = 0;
  memcpy(c.bytes, s->next.bytes, AT_BODY);
  c.size = AT_BODY;
  put(&c, motion_count, 4), put(&c, landmark_count, 4), put(&c, vehicle_count, 4);
  for (uint32_t i = 0; i < motion_count; ++i)
    for (int k = 0; k < 10; ++k) put_real(&c, motion[i][k]);
  for (uint32_t i = 0; i < landmark_count + vehicle_count; ++i) {
    const sighting* one = i < landmark_count ? &landmarks[i] : &vehicles[i - landmark_count];
    put(&c, one->id, 8);
    for (int k = 0; k < 5; ++k) put_real(&c, one->values[k]);
  }
  c.size += 4;
  write_number(c.bytes + AT_SIZE, c.size, 4);
  seal(c.bytes, c.size);
  return give(s, c.bytes, c.size);
}

static void nonsense_with_the_right_checksum(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  const double good_motion[10] = {5, 0.1, 0.8, 0.6, 1, 0.1, 0.01, 1, 0.02, 1e-3};
  const sighting landmarks[2] = {{1, {1000, 0.1, 100, 0.1, 1e-3}}, {2, {1000, 0.2, 0, 0, 0}}};
  const sighting vehicles[1] = {{1, {1500, 3, 0, 0, 0}}};
  double motion[1][10];
  sighting l[2], v[2];
#define RESET memcpy(motion[0], good_motion, sizeof good_motion), memcpy(l, landmarks, sizeof l), v[0] = vehicles[0]
#define NONSENSE() assert_int_equal(give_content(&s, 1, (const double(*)[10])motion, 2, l, 1, v), CAIRN_PACKET_NONSENSE)
  for (size_t n = 0; n < LENGTH(not_finite); ++n) {
    for (int k = 0; k < 10; ++k) RESET, motion[0][k] = not_finite[n], NONSENSE();
    for (int k = 0; k < 5; ++k) {
      RESET, l[0].values[k] = not_finite[n], NONSENSE();
      RESET, l[1].values[k] = not_finite[n], NONSENSE();
      RESET, v[0].values[k] = not_finite[n], NONSENSE();
    }
  }
  RESET, motion[0][2] = 0.9, NONSENSE(); /* no rotation: a vector of another length */
  RESET, motion[0][2] = motion[0][3] = 0, NONSENSE();
  RESET, motion[0][4] = -1e-9, NONSENSE(); /* variances below zero */
  RESET, motion[0][7] = -1, NONSENSE();
  RESET, motion[0][9] = -1e-12, NONSENSE();
  RESET, motion[0][5] = 1.1, NONSENSE(); /* correlations beyond 1 */
  RESET, motion[0][6] = 0.1, NONSENSE();
  RESET, motion[0][8] = -0.1, NONSENSE();
  RESET, motion[0][4] = 0, NONSENSE(); /* of what has no variance */
  RESET, motion[0][5] = 0.9, motion[0][6] = 0.9 * sqrt(1e-3), motion[0][8] = -0.9 * sqrt(1e-3), NONSENSE();
  RESET, l[0].values[0] = -1, NONSENSE(); /* ranges below zero */
  RESET, v[0].values[0] = -1e-300, NONSENSE();
  RESET, l[0].values[2] = -1, NONSENSE(); /* noise that is no covariance, or not definite */
  RESET, l[0].values[4] = 0, NONSENSE();
  RESET, l[0].values[4] = -1e-3, NONSENSE();
  RESET, l[0].values[3] = 1, NONSENSE();
  RESET, l[1].values[3] = 1e-9, NONSENSE();
  RESET, v[0].values[2] = 1, NONSENSE();
  RESET, l[1].id = 1, NONSENSE(); /* a name twice */
  RESET, v[0].id = 2, NONSENSE(); /* itself */
  RESET, v[0].id = CAIRN_ID_NONE, NONSENSE();
  RESET, v[1] = v[0];
  assert_int_equal(give_content(&s, 0, NULL, 0, NULL, 2, v), CAIRN_PACKET_NONSENSE);
#undef NONSENSE
  unchanged(&s);
  const cairn_team_report r = report_of(s.a);
  assert_int_equal(r.nonsense, 3 * 25 + 22);
  assert_int_equal(r.taken, UNDER_WAY);
  /* What all of that was made of is fine, so that each of it was refused for what it says. */
  RESET;
  assert_int_equal(give_content(&s, 1, (const double(*)[10])motion, 2, l, 1, v), CAIRN_PACKET_TAKEN);
#undef RESET
  cairn_team_destroy(s.a), cairn_team_destroy(s.b);
  free(s.next.bytes);
  post_free(&s.old);
  snapshot_free(&s.before), snapshot_free(&s.after);
}

/* Landmarks without a name where names count. */
static void nameless_landmarks(void** state) {
  stage s;
  const sighting l[1] = {{CAIRN_ID_NONE, {1000, 0.1, 0, 0, 0}}};
  size_t before = 0, after = 0;
  (void)state;
  stage_open(&s);
  assert_ok(cairn_map_size(cairn_team_map(s.a), &before));
  const int32_t result = give_content(&s, 0, NULL, 1, l, 0, NULL);
  assert_ok(cairn_map_size(cairn_team_map(s.a), &after));
  assert_int_equal(before, after); /* nothing may go by that name */
  cairn_landmark landmark;
  assert_status(cairn_map_landmark(cairn_team_map(s.a), CAIRN_ID_NONE, &landmark), CAIRN_ERROR_NOT_FOUND);
  assert_true(result == CAIRN_PACKET_NONSENSE || report_of(s.a).failed > 0);
  cairn_team_destroy(s.a), cairn_team_destroy(s.b);
  free(s.next.bytes);
  post_free(&s.old);
  snapshot_free(&s.before), snapshot_free(&s.after);
}

/* Counts of what a packet does not hold, up to what would overflow a product. */
static void counts_that_lie(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  const uint64_t lies[] = {0, 1, 7, 65535, 65536, 0x7fffffff, 0x80000000, 0xffffffff};
  for (size_t n = 0; n < LENGTH(lies); ++n)
    for (size_t at = 0; at < 3; ++at) {
      if (read_number(s.next.bytes + AT_BODY + 4 * at, 4) == lies[n]) continue;
      assert_int_equal(give_changed(&s, AT_BODY + 4 * at, lies[n], 4), CAIRN_PACKET_NONSENSE);
    }
  stage_close(&s);
}

/* Questions for packets, sensible or not, never change the estimate, and are answered by what there is. */
static void requests(void** state) {
  const uint64_t from[] = {0, 2, UNDER_WAY, UNDER_WAY + 1, UINT64_MAX}, counts[] = {0, 1, 3, UINT64_MAX};
  stage s;
  (void)state;
  stage_open(&s);
  for (size_t f = 0; f < LENGTH(from); ++f)
    for (size_t n = 0; n < LENGTH(counts); ++n)
      for (uint64_t subject = 1; subject <= 2; ++subject)
        for (uint64_t sender = 2; sender <= 3; ++sender) {
          content c;
          post answers = {NULL, 0, 0};
          memcpy(c.bytes, s.next.bytes, AT_BODY);
          write_number(c.bytes + AT_KIND, REQUEST, 2);
          write_number(c.bytes + AT_VEHICLE, sender, 8);
          c.size = AT_BODY;
          put(&c, subject, 8), put(&c, from[f], 8), put(&c, counts[n], 8);
          c.size += 4;
          write_number(c.bytes + AT_SIZE, c.size, 4);
          seal(c.bytes, c.size);
          const bool for_it = subject == 1 && sender == 2;
          assert_int_equal(give(&s, c.bytes, c.size), for_it ? CAIRN_PACKET_REQUEST : CAIRN_PACKET_IGNORED);
          const size_t there = from[f] > UNDER_WAY ? 0 : UNDER_WAY + 1 - from[f];
          const size_t expected = !for_it ? 0 : counts[n] == 0 || counts[n] > there ? there : counts[n];
          assert_int_equal(post_collect(&answers, s.a, 0), expected);
          for (size_t i = 0; i < answers.count; ++i) assert_int_equal(number_of(&answers.letters[i]), from[f] + i);
          post_free(&answers);
        }
  stage_close(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(options_out_of_range),
      cmocka_unit_test(options_that_do_not_go_together),
      cmocka_unit_test(structs_of_other_sizes),
      cmocka_unit_test(members),
      cmocka_unit_test(motions),
      cmocka_unit_test(too_many_motions),
      cmocka_unit_test(observations),
      cmocka_unit_test(absurd_counts),
      cmocka_unit_test(questions),
      cmocka_unit_test(packets_cut_short),
      cmocka_unit_test(every_byte_flipped),
      cmocka_unit_test(foreign_bytes),
      cmocka_unit_test(heads_that_do_not_fit),
      cmocka_unit_test(two_vehicles_of_one_number),
      cmocka_unit_test(packets_that_wait),
      cmocka_unit_test(nonsense_with_the_right_checksum),
      cmocka_unit_test(nameless_landmarks),
      cmocka_unit_test(counts_that_lie),
      cmocka_unit_test(requests),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
