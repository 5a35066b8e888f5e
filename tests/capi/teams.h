/* SPDX-License-Identifier: BSD-3-Clause */
/* Shared by the tests of teams: boats on a recorded voyage, the post that carries their packets, and snapshots of
   everything that a team returns about its estimate. */
#ifndef CAIRN_TESTS_CAPI_TEAMS_H
#define CAIRN_TESTS_CAPI_TEAMS_H

#include <cairn/fleet.h>

#include "support.h"

#define BOATS 3
#define FEATURES 10
#define STEPS 40

/* The motions and sightings of each boat, copied from the fleet so that they can be replayed in any order. */
typedef struct log_entry {
  double speed, rate;
  cairn_pose truth;
  cairn_observation features[FEATURES], vehicles[BOATS];
  size_t feature_count, vehicle_count;
} log_entry;

typedef struct voyage {
  double time[STEPS], dt[STEPS];
  log_entry boats[BOATS][STEPS]; /* boat n + 1 is number n + 1 of the fleet */
} voyage;

static inline void read_sightings(const cairn_fleet_sighting* from, size_t count, cairn_observation* to) {
  for (size_t i = 0; i < count; ++i) {
    memset(&to[i], 0, sizeof to[i]);
    to[i].id = from[i].id, to[i].z[0] = from[i].range, to[i].z[1] = from[i].bearing;
  }
}

static inline void voyage_record(voyage* v, uint32_t boats, uint64_t seed) {
  cairn_fleet_options options;
  cairn_fleet* fleet = NULL;
  assert_ok(cairn_fleet_options_init(&options, sizeof options, NULL));
  options.seed = seed, options.vehicles = boats, options.features = FEATURES;
  assert_ok(cairn_fleet_create(&options, &fleet, NULL));
  memset(v, 0, sizeof *v);
  for (size_t k = 0; k < STEPS; ++k) {
    cairn_fleet_step step;
    memset(&step, 0, sizeof step);
    step.struct_size = sizeof step;
    assert_ok(cairn_fleet_next(fleet, &step, NULL));
    v->time[k] = step.time, v->dt[k] = step.dt;
    cairn_fleet_vehicle vehicles[BOATS];
    size_t needed = 0;
    assert_ok(cairn_fleet_vehicles(fleet, vehicles, BOATS, &needed, NULL));
    for (size_t b = 0; b < boats; ++b) {
      const cairn_fleet_vehicle* from = &vehicles[b];
      cairn_fleet_sighting seen[FEATURES + BOATS];
      log_entry* to = &v->boats[b][k];
      to->speed = from->speed, to->rate = from->rate;
      to->truth = pose_at(from->x, from->y, 0, 0, 0, from->heading);
      to->feature_count = from->feature_count, to->vehicle_count = from->vehicle_count;
      assert_ok(cairn_fleet_seen_features(fleet, b + 1, seen, LENGTH(seen), &needed, NULL));
      read_sightings(seen, needed, to->features);
      assert_ok(cairn_fleet_seen_vehicles(fleet, b + 1, seen, LENGTH(seen), &needed, NULL));
      read_sightings(seen, needed, to->vehicles);
    }
  }
  cairn_fleet_destroy(fleet);
}

/* --- boats --- */

static inline cairn_range_bearing fleet_radar(void) {
  cairn_range_bearing radar;
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar, NULL));
  radar.range_sigma = 30, radar.bearing_sigma = 0.3 * DEGREE;
  return radar;
}

static inline cairn_twist_noise fleet_noise(void) {
  cairn_twist_noise noise;
  assert_ok(cairn_twist_noise_init(&noise, sizeof noise, NULL));
  for (int i = 0; i < 3; ++i) noise.velocity_sigma[i] = noise.rate_sigma[i] = 0;
  noise.velocity_sigma[0] = 0.2, noise.rate_sigma[2] = 0.1 * DEGREE;
  return noise;
}

static inline cairn_filter_options planar_options(const cairn_pose* start) {
  cairn_filter_options options;
  assert_ok(cairn_filter_options_init(&options, sizeof options, NULL));
  options.vehicle = CAIRN_VEHICLE_PLANAR;
  options.max_landmarks = 2 * FEATURES;
  options.max_observations = FEATURES + BOATS;
  options.initial_pose = *start;
  return options;
}

static inline cairn_team_options team_options(int32_t mode, uint64_t vehicle) {
  cairn_team_options options;
  assert_ok(cairn_team_options_init(&options, sizeof options, NULL));
  options.mode = mode, options.vehicle = vehicle;
  return options;
}

/* Boat `vehicle` of the voyage, at first the only member of its team. */
static inline cairn_team* boat_open(const voyage* v, const cairn_team_options* options) {
  const cairn_filter_options filter = planar_options(&v->boats[options->vehicle - 1][0].truth);
  const cairn_range_bearing radar = fleet_radar();
  cairn_team* team = NULL;
  assert_ok(cairn_team_create(options, &filter, &radar, &team, NULL));
  return team;
}

static inline void boat_add(cairn_team* team, const voyage* v, uint64_t vehicle) {
  assert_ok(cairn_team_add(team, vehicle, &v->boats[vehicle - 1][0].truth, NULL, NULL));
}

static inline void boat_move(cairn_team* team, const voyage* v, uint64_t vehicle, size_t k) {
  const log_entry* e = &v->boats[vehicle - 1][k];
  const double velocity[3] = {e->speed, 0, 0}, rate[3] = {0, 0, e->rate};
  const cairn_twist_noise noise = fleet_noise();
  if (v->dt[k] > 0) assert_ok(cairn_team_predict_twist(team, v->dt[k], velocity, rate, &noise, NULL));
}

enum { LOOK_AT_FEATURES = 1, LOOK_AT_VEHICLES = 2, LOOK_AT_ALL = 3 };

static inline void boat_look(cairn_team* team, const voyage* v, uint64_t vehicle, size_t k, int at) {
  const log_entry* e = &v->boats[vehicle - 1][k];
  assert_ok(cairn_team_observe(team, v->time[k], e->features, (at & LOOK_AT_FEATURES) != 0 ? e->feature_count : 0,
                               e->vehicles, (at & LOOK_AT_VEHICLES) != 0 ? e->vehicle_count : 0, NULL));
}

static inline void boat_step(cairn_team* team, const voyage* v, uint64_t vehicle, size_t k) {
  boat_move(team, v, vehicle, k);
  boat_look(team, v, vehicle, k, LOOK_AT_ALL);
}

static inline cairn_team_report report_of(const cairn_team* team) {
  cairn_team_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(cairn_team_last_report(team, &report, NULL));
  return report;
}

/* --- packets --- */

enum { DATA = 1, REQUEST = 2, LEAVE = 3 };
enum { AT_VERSION = 4, AT_KIND = 6, AT_SIZE = 8, AT_VEHICLE = 12, AT_NUMBER = 20, AT_TIME = 28, AT_BODY = 36 };

typedef struct letter {
  uint8_t* bytes;
  size_t size;
  size_t due; /* step at which it arrives */
} letter;

typedef struct post {
  letter* letters;
  size_t count, room;
} post;

static inline uint64_t read_number(const uint8_t* at, size_t bytes) {
  uint64_t value = 0;
  for (size_t i = 0; i < bytes; ++i) value |= (uint64_t)at[i] << (8 * i);
  return value;
}
static inline uint64_t sender_of(const letter* l) {
  return read_number(l->bytes + AT_VEHICLE, 8);
}
static inline uint64_t number_of(const letter* l) {
  return read_number(l->bytes + AT_NUMBER, 8);
}
static inline uint64_t kind_of(const letter* l) {
  return read_number(l->bytes + AT_KIND, 2);
}

static inline letter* post_add(post* p, const uint8_t* bytes, size_t size, size_t due) {
  if (p->count == p->room) {
    p->room = 2 * p->room + 16;
    p->letters = realloc(p->letters, p->room * sizeof *p->letters);
    assert_non_null(p->letters);
  }
  letter* l = &p->letters[p->count++];
  l->bytes = malloc(size + (size == 0));
  assert_non_null(l->bytes);
  memcpy(l->bytes, bytes, size);
  l->size = size, l->due = due;
  return l;
}

static inline void post_free(post* p) {
  for (size_t i = 0; i < p->count; ++i) free(p->letters[i].bytes);
  free(p->letters);
  memset(p, 0, sizeof *p);
}

/* Takes all packets that a team has to send; returns their number. */
static inline size_t post_collect(post* p, cairn_team* team, size_t due) {
  size_t size = 0, taken = 0, count = 0;
  for (;;) {
    assert_ok(cairn_team_take_packet(team, NULL, 0, &size, NULL));
    if (size == 0) return count;
    uint8_t* bytes = malloc(size);
    assert_non_null(bytes);
    assert_ok(cairn_team_take_packet(team, bytes, size, &taken, NULL));
    assert_int_equal(taken, size);
    (void)post_add(p, bytes, size, due);
    free(bytes);
    ++count;
  }
}

static inline int32_t hand_over(cairn_team* team, const letter* l) {
  int32_t result = 0;
  assert_ok(cairn_team_receive(team, l->bytes, l->size, &result, NULL));
  return result;
}

/* The one packet that the team has to send. */
static inline letter take_one(cairn_team* team) {
  post p = {NULL, 0, 0};
  assert_int_equal(post_collect(&p, team, 0), 1);
  const letter l = p.letters[0];
  free(p.letters);
  return l;
}

/* CRC-32 bit by bit, independent of the library. */
static inline void seal(uint8_t* bytes, size_t size) {
  uint32_t crc = UINT32_C(0xFFFFFFFF);
  for (size_t i = 0; i + 4 < size; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? UINT32_C(0xEDB88320) : 0u);
  }
  for (int i = 0; i < 4; ++i) bytes[size - 4 + (size_t)i] = (uint8_t)(~crc >> (8 * i));
}

/* --- everything that a team returns about its estimate, as bytes --- */

static inline void team_snapshot(snapshot* s, const cairn_team* team) {
  const cairn_map* map = cairn_team_map(team);
  uint64_t members[16];
  size_t count = 0, n = 0, needed = 0;
  assert_ok(cairn_team_members(team, members, LENGTH(members), &count, NULL));
  assert_ok(cairn_map_size(map, &n, NULL));
  const size_t one = sizeof(uint64_t) + sizeof(cairn_pose) + 36 * sizeof(double), side = 3 * n;
  snapshot_free(s);
  s->size = count * one + n * sizeof(cairn_landmark) + side * side * sizeof(double);
  s->bytes = calloc(1, s->size + 1);
  assert_non_null(s->bytes);
  unsigned char* to = s->bytes;
  for (size_t i = 0; i < count; ++i, to += one) {
    cairn_pose pose;
    double covariance[36];
    memcpy(to, &members[i], sizeof members[i]);
    const cairn_status status = cairn_team_pose(team, members[i], &pose, covariance, NULL);
    if (status == CAIRN_ERROR_NOT_FOUND) continue;
    assert_int_equal(status, CAIRN_OK);
    memcpy(to + sizeof(uint64_t), &pose, sizeof pose);
    memcpy(to + sizeof(uint64_t) + sizeof pose, covariance, sizeof covariance);
  }
  cairn_landmark* landmarks = calloc(n + 1, sizeof *landmarks);
  uint64_t* ids = calloc(n + 1, sizeof *ids);
  double* joint = calloc(side * side + 1, sizeof *joint);
  assert_true(landmarks != NULL && ids != NULL && joint != NULL);
  assert_ok(cairn_map_landmarks(map, landmarks, n + 1, &needed, NULL));
  for (size_t i = 0; i < n; ++i) ids[i] = landmarks[i].id;
  assert_ok(cairn_map_joint_covariance(map, ids, n, joint, side * side + 1, &needed, NULL));
  memcpy(to, landmarks, n * sizeof *landmarks);
  memcpy(to + n * sizeof *landmarks, joint, side * side * sizeof *joint);
  free(landmarks), free(ids), free(joint);
}

static inline void assert_same_estimate(const cairn_team* a, const cairn_team* b) {
  snapshot sa = {0, NULL}, sb = {0, NULL};
  team_snapshot(&sa, a);
  team_snapshot(&sb, b);
  if (!snapshot_same(&sa, &sb)) fail_msg("two estimates differ that should be the same to the bit");
  snapshot_free(&sa);
  snapshot_free(&sb);
}

#endif
