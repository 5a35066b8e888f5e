/* SPDX-License-Identifier: BSD-3-Clause */
/* Options and calls that a team refuses. The estimate stays the same to the bit. */
#include "team_stage.h"

/* --- options --- */

static cairn_status try_create(const cairn_team_options* options, const cairn_filter_options* filter,
                               const cairn_range_bearing* radar) {
  cairn_team* const untouched = (cairn_team*)(void*)&filter;
  cairn_team* team = untouched;
  const cairn_status status = cairn_team_create(options, filter, radar, &team, NULL);
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
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", try_create(&o, NULL, &radar));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "NULL", try_create(&o, &good, NULL));
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_create(&o, &good, &radar, NULL, NULL));
  }
  const cairn_team_options submaps = team_options(CAIRN_TEAM_SUBMAPS, 1);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "submap_landmarks", try_create(&submaps, &good, &radar));
  cairn_team_destroy(NULL);
}

/* Callers that are older or newer than the library, and a byte behind their struct that must not change. */
static void structs_of_other_sizes(void** state) {
  const cairn_pose start = pose_at(0, 0, 0, 0, 0, 0);
  const cairn_filter_options filter = planar_options(&start);
  const cairn_range_bearing radar = fleet_radar();
  cairn_team_options good = team_options(CAIRN_TEAM_JOINT, 1);
  cairn_team* team = NULL;
  (void)state;
  assert_ok(cairn_team_create(&good, &filter, &radar, &team, NULL));
  for (uint32_t size = 0; size < sizeof(cairn_team_report) + 40; ++size) {
    unsigned char buffer[sizeof(cairn_team_report) + 48];
    memset(buffer, 0xa5, sizeof buffer);
    const bool fine = size >= 8;
    const cairn_status expected = fine ? CAIRN_OK : CAIRN_ERROR_ARGUMENT;
    assert_status(cairn_team_options_init((cairn_team_options*)(void*)buffer, size, NULL), expected);
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
    assert_status(cairn_team_last_report(team, (cairn_team_report*)(void*)buffer, NULL), expected);
    const size_t written = !fine ? sizeof size : size < sizeof(cairn_team_report) ? size : sizeof(cairn_team_report);
    for (size_t i = written; i < sizeof buffer; ++i) assert_int_equal(buffer[i], 0xa5);
  }
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options", cairn_team_options_init(NULL, sizeof good, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "report", cairn_team_last_report(team, NULL, NULL));
  good.struct_size = UINT32_MAX;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options", try_create(&good, &filter, &radar));
  cairn_team_destroy(team);
}

/* --- calls --- */

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
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicle",
                 cairn_team_add(s.a, 1, &start, covariance, NULL)); /* this vehicle */
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicle", cairn_team_add(s.a, 1, NULL, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicle", cairn_team_add(s.a, 2, &start, covariance, NULL)); /* twice */
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicle", cairn_team_add(s.a, CAIRN_ID_NONE, &start, covariance, NULL));
  bad.position[2] = 1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "start", cairn_team_add(s.a, 3, &bad, covariance, NULL));
  bad = start, bad.position[1] = NAN;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "start", cairn_team_add(s.a, 3, &bad, covariance, NULL));
  bad = pose_at(0, 0, 0, 0, 0.1, 0);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "start", cairn_team_add(s.a, 3, &bad, covariance, NULL));
  covariance[7] = -1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance", cairn_team_add(s.a, 3, &start, covariance, NULL));
  covariance[7] = INFINITY;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance", cairn_team_add(s.a, 3, &start, covariance, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_add(NULL, 3, &start, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicle", cairn_team_remove(s.a, 1, NULL));
  assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "vehicle", cairn_team_remove(s.a, 3, NULL));
  assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "vehicle", cairn_team_remove(s.a, CAIRN_ID_NONE, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_remove(NULL, 2, NULL));
  unchanged(&s);
  /* There is room for only one more. */
  diagonal(covariance, 6, 1e-2);
  assert_ok(cairn_team_add(s.a, 3, NULL, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_vehicles", cairn_team_add(s.a, 4, &start, covariance, NULL));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_vehicles", cairn_team_add(s.a, 4, NULL, NULL, NULL));
  assert_status(cairn_team_members(s.a, numbers, 2, &needed, NULL), CAIRN_ERROR_BUFFER);
  assert_int_equal(needed, 3);
  for (int i = 0; i < 4; ++i) assert_int_equal(numbers[i], 77);
  assert_status(cairn_team_members(s.a, numbers, 4, NULL, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_members(s.a, NULL, 4, &needed, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_members(NULL, numbers, 4, &needed, NULL), CAIRN_ERROR_ARGUMENT);
  assert_ok(cairn_team_remove(s.a, 3, NULL));
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
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "velocity", cairn_team_predict_twist(s.a, 1, v, w, NULL, NULL));
      v[i] = good_v, w[i] = not_finite[n];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rate", cairn_team_predict_twist(s.a, 1, v, w, NULL, NULL));
      w[i] = good_w, move.position[i] = not_finite[n];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_team_predict_increment(s.a, &move, c, NULL));
      move.position[i] = good_p;
    }
    c[7] = not_finite[n];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance", cairn_team_predict_increment(s.a, &move, c, NULL));
    c[7] = 1e-4;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "dt", cairn_team_predict_twist(s.a, not_finite[n], v, w, NULL, NULL));
  }
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "dt", cairn_team_predict_twist(s.a, 0, v, w, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "dt", cairn_team_predict_twist(s.a, -1, v, w, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "velocity", cairn_team_predict_twist(s.a, 1, NULL, w, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rate", cairn_team_predict_twist(s.a, 1, v, NULL, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_predict_twist(NULL, 1, v, w, NULL, NULL));
  noise.rate_sigma[2] = -1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rate_sigma", cairn_team_predict_twist(s.a, 1, v, w, &noise, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_team_predict_increment(s.a, NULL, c, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance", cairn_team_predict_increment(s.a, &move, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_predict_increment(NULL, &move, c, NULL));
  move = pose_at(1, 0, 0, 0, 0.1, 0);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_team_predict_increment(s.a, &move, c, NULL));
  move = pose_at(1, 0, 0.1, 0, 0, 0);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_team_predict_increment(s.a, &move, c, NULL));
  move = pose_at(1, 0, 0, 0, 0, 0.1), c[35] = -1e-4;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance", cairn_team_predict_increment(s.a, &move, c, NULL));
  v[0] = 1e300;
  assert_refused(NULL, CAIRN_ERROR_NUMERICAL, "", cairn_team_predict_twist(s.a, 1e10, v, w, NULL, NULL));
  stage_close(&s);
}

/* The largest number of motions in a packet, and one more. */
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
  assert_ok(cairn_team_create(&one, &filter, &radar, &a, NULL));
  assert_ok(cairn_team_create(&two, &filter, &radar, &b, NULL));
  assert_ok(cairn_team_add(a, 2, &start, NULL, NULL));
  for (int i = 0; i < 65535; ++i) assert_ok(cairn_team_predict_increment(b, &step, c, NULL));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "prediction", cairn_team_predict_increment(b, &step, c, NULL));
  assert_ok(cairn_team_observe(b, 1, NULL, 0, NULL, 0, NULL));
  assert_ok(cairn_team_predict_increment(b, &step, c, NULL));
  letter l = take_one(b);
  assert_ok(cairn_team_observe(a, 1, NULL, 0, NULL, 0, NULL));
  assert_int_equal(hand_over(a, &l), CAIRN_PACKET_TAKEN);
  assert_ok(cairn_team_pose(a, 2, &pose, NULL, NULL));
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
  cairn_observation many[FEATURES + BOATS + 1], o[3], teammates[2];
  memset(many, 0, sizeof many), memset(o, 0, sizeof o), memset(teammates, 0, sizeof teammates);
  for (size_t i = 0; i < 3; ++i) o[i].id = i + 1, o[i].z[0] = 1000, o[i].z[1] = 0.1 * (double)i;
  for (size_t i = 0; i < LENGTH(many); ++i) many[i].id = i, many[i].z[0] = 1000;
  teammates[0] = o[0], teammates[0].id = 2;
  teammates[1] = o[0], teammates[1].id = 3;
#define LOOK(time, count) cairn_team_observe(s.a, (time), o, 3, teammates, (count), NULL)
  for (size_t n = 0; n < LENGTH(not_finite); ++n) {
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "time", LOOK(not_finite[n], 2));
    for (int k = 0; k < 2; ++k) {
      o[2].z[k] = not_finite[n];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[2].z", LOOK(later, 2));
      o[2].z[0] = 1000, o[2].z[1] = 0.2;
      teammates[1].z[k] = not_finite[n];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles[1].z", LOOK(later, 2));
      teammates[1].z[0] = 1000, teammates[1].z[1] = 0;
    }
    o[1].covariance[3] = not_finite[n], o[1].covariance[0] = 1;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[1].covariance", LOOK(later, 2));
    memset(o[1].covariance, 0, sizeof o[1].covariance);
  }
  o[0].z[0] = -1e-9;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[0].z", LOOK(later, 2));
  o[0].z[0] = 1000, teammates[0].z[0] = -1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles[0].z", LOOK(later, 2));
  teammates[0].z[0] = 1000;
  o[0].covariance[0] = 1, o[0].covariance[3] = -1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[0].covariance", LOOK(later, 2));
  o[0].covariance[3] = 0;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[0].covariance", LOOK(later, 2));
  memset(o[0].covariance, 0, sizeof o[0].covariance);
  o[1].id = 1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "observations", LOOK(later, 2));
  o[1].id = CAIRN_ID_NONE;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks[1].id", LOOK(later, 2));
  o[1].id = 2, teammates[1].id = 2;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles", LOOK(later, 2));
  teammates[1].id = CAIRN_ID_NONE;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles[1].id", LOOK(later, 2));
  teammates[1].id = 1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles", LOOK(later, 2)); /* itself */
  teammates[1].id = 3;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "time", LOOK(s.v.time[UNDER_WAY], 2)); /* the last one again */
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "time", LOOK(s.v.time[UNDER_WAY] - 1e-9, 2));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "time", LOOK(-1e300, 2));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_observations",
                 cairn_team_observe(s.a, later, many, FEATURES + BOATS + 1, NULL, 0, NULL));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_observations",
                 cairn_team_observe(s.a, later, many, FEATURES + BOATS - 1, teammates, 2, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmarks", cairn_team_observe(s.a, later, NULL, 1, NULL, 0, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "vehicles", cairn_team_observe(s.a, later, NULL, 0, NULL, 1, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "team", cairn_team_observe(NULL, later, o, 3, NULL, 0, NULL));
#undef LOOK
  assert_int_equal(report_of(s.a).sent, UNDER_WAY + 1); /* nothing was sent */
  stage_close(&s);
}

/* Impossible counts are refused before memory is allocated for them. */
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
                   cairn_team_observe(s.a, 1e6, &o, absurd[i], NULL, 0, NULL));
    assert_refused(NULL, CAIRN_ERROR_CAPACITY, "max_observations",
                   cairn_team_observe(s.a, 1e6, NULL, 0, &o, absurd[i], NULL));
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
  assert_status(cairn_team_pose(s.a, 3, &pose, covariance, NULL), CAIRN_ERROR_NOT_FOUND);
  assert_status(cairn_team_pose(s.a, CAIRN_ID_NONE, &pose, covariance, NULL), CAIRN_ERROR_NOT_FOUND);
  assert_status(cairn_team_pose(NULL, 1, &pose, covariance, NULL), CAIRN_ERROR_ARGUMENT);
  assert_memory_equal(&pose, &kept, sizeof pose);
  assert_ok(cairn_team_pose(s.a, 1, NULL, NULL, NULL));
  assert_null(cairn_team_map(NULL));
  assert_ok(cairn_team_decisions(s.a, NULL, 0, &needed, NULL));
  assert_true(needed > 2);
  memset(matches, 0x5a, sizeof matches);
  assert_status(cairn_team_decisions(s.a, matches, 2, &needed, NULL), CAIRN_ERROR_BUFFER);
  assert_int_equal(matches[0].result, 0x5a5a5a5a);
  assert_status(cairn_team_decisions(s.a, matches, 2, NULL, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_decisions(NULL, matches, 2, &needed, NULL), CAIRN_ERROR_ARGUMENT);
  assert_ok(cairn_team_take_packet(s.a, &byte, 1, &needed, NULL)); /* none is there */
  assert_int_equal(needed, 0);
  boat_step(s.b, &s.v, 2, UNDER_WAY + 1);
  assert_status(cairn_team_take_packet(s.b, &byte, 1, &needed, NULL), CAIRN_ERROR_BUFFER);
  assert_int_equal(byte, 0x5a);
  const size_t size = needed;
  assert_status(cairn_team_take_packet(s.b, NULL, 1, &needed, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_take_packet(s.b, &byte, 1, NULL, NULL), CAIRN_ERROR_ARGUMENT);
  assert_ok(cairn_team_take_packet(s.b, NULL, 0, &needed, NULL)); /* it is still there */
  assert_int_equal(needed, size);
  assert_status(cairn_team_take_packet(NULL, &byte, 1, &needed, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_receive(NULL, &byte, 1, NULL, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_receive(s.a, NULL, 1, NULL, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_leave(NULL, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_ask(NULL, NULL), CAIRN_ERROR_ARGUMENT);
  pose = pose_at(0, 0, 1, 0, 0, 0);
  assert_status(cairn_team_score(s.a, &pose, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_score(s.a, NULL, NULL), CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_team_score(NULL, &kept, NULL), CAIRN_ERROR_ARGUMENT);
  assert_int_equal(report_of(s.a).scored, 0);
  cairn_team_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_status(cairn_team_last_report(NULL, &report, NULL), CAIRN_ERROR_ARGUMENT);
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
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
