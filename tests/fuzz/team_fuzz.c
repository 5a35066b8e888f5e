/* SPDX-License-Identifier: BSD-3-Clause */
/* Teams under random calls and a post gone mad: packets late, twice, out of order, cut, flipped, spoilt and sealed
 * anew, or nothing but random bytes. What has to hold after any call: a status of the pinned set, a line for each
 * failure, an estimate of finite numbers, and the same estimate where a packet was refused.
 *
 *   team_fuzz SEED CALLS [LIMIT]
 *
 * Packets are handed over in buffers of exactly their size, so that a sanitizer sees each byte too far. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

enum { TEAMS = 3, POOL = 64, LANDMARKS = 12, AT_VERSION = 4, AT_SIZE = 8, AT_VEHICLE = 12, HEAD = 36 };

typedef struct letter {
  uint8_t* bytes;
  size_t size;
} letter;

static cairn_team* teams[TEAMS];
static double clocks[TEAMS];
static letter pool[POOL];
static unsigned long long results[18];
static uint64_t taken_by[TEAMS], taken;

/* All that a team tells of its estimate; the caller frees it. */
typedef struct view {
  size_t size;
  unsigned char* bytes;
} view;

static view look(const cairn_team* team) {
  uint64_t members[300];
  size_t count = 0, n = 0, needed = 0;
  const cairn_map* map = cairn_team_map(team);
  HOLDS(cairn_team_members(team, members, 300, &count, NULL) == CAIRN_OK && count > 0, count);
  HOLDS(cairn_map_size(map, &n, NULL) == CAIRN_OK && n <= LANDMARKS, n);
  const size_t one = sizeof(cairn_pose) + 36 * sizeof(double);
  view v = {count * one + n * sizeof(cairn_landmark), NULL};
  v.bytes = calloc(1, v.size + 1);
  for (size_t i = 0; i < count; ++i) {
    cairn_pose pose;
    double covariance[36];
    const cairn_status status = cairn_team_pose(team, members[i], &pose, covariance, NULL);
    HOLDS(status == CAIRN_OK || (i > 0 && status == CAIRN_ERROR_NOT_FOUND), status);
    if (status != CAIRN_OK) continue;
    for (int k = 0; k < 36; ++k) HOLDS(isfinite(covariance[k]), covariance[k]);
    for (int k = 0; k < 6; ++k) HOLDS(covariance[7 * k] >= -1e-9, covariance[7 * k]);
    for (int k = 0; k < 3; ++k) HOLDS(isfinite(pose.position[k]), pose.position[k]);
    memcpy(v.bytes + i * one, &pose, sizeof pose);
    memcpy(v.bytes + i * one + sizeof pose, covariance, sizeof covariance);
  }
  cairn_landmark landmarks[LANDMARKS];
  HOLDS(cairn_map_landmarks(map, landmarks, LANDMARKS, &needed, NULL) == CAIRN_OK && needed == n, needed);
  for (size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) HOLDS(isfinite(landmarks[i].position[k]), landmarks[i].position[k]);
    for (int k = 0; k < 9; ++k) HOLDS(isfinite(landmarks[i].covariance[k]), landmarks[i].covariance[k]);
    HOLDS(landmarks[i].id != CAIRN_ID_NONE && landmarks[i].observations > 0, landmarks[i].observations);
  }
  memcpy(v.bytes + count * one, landmarks, n * sizeof *landmarks);
  return v;
}

static void check_report(size_t number) {
  const cairn_team* team = teams[number];
  cairn_team_report r;
  memset(&r, 0, sizeof r);
  r.struct_size = sizeof r;
  HOLDS(cairn_team_last_report(team, &r, NULL) == CAIRN_OK, 0);
  HOLDS(r.taken + r.repeated + r.own + r.ignored + r.unknown + r.past + r.conflict + r.full + r.foreign + r.version +
                r.cut + r.corrupt + r.nonsense <=
            r.received,
        r.received);
  HOLDS(isfinite(r.position_rmse) && isfinite(r.anees_per_dof), r.position_rmse);
  taken += r.taken - taken_by[number]; /* most of them have their turn long after they came */
  taken_by[number] = r.taken;
}

static void create(size_t number) {
  cairn_team_options o;
  cairn_filter_options f;
  cairn_range_bearing radar;
  cairn_team* team = NULL;
  fuzz_operation = "create";
  fuzz_check_status(cairn_team_options_init(&o, sizeof o, NULL));
  fuzz_check_status(cairn_filter_options_init(&f, sizeof f, NULL));
  fuzz_check_status(cairn_range_bearing_init(&radar, sizeof radar, NULL));
  o.mode = fuzz_one_in(3) ? (int32_t)fuzz_below(5) : CAIRN_TEAM_JOINT;
  o.vehicle = number + 1;
  o.max_vehicles = fuzz_one_in(5) ? 1 + (uint32_t)fuzz_below(5) : 5;
  o.baseline = fuzz_one_in(3);
  o.max_lag = fuzz_uniform(1, 60);
  if (fuzz_one_in(4)) o.time_tolerance = fuzz_number(1);
  if (fuzz_one_in(4)) o.max_waiting = 1 + (uint32_t)fuzz_below(5);
  if (fuzz_one_in(4)) o.history = 1 + (uint32_t)fuzz_below(5);
  if (fuzz_one_in(30)) o.mode = fuzz_int();
  if (fuzz_one_in(30)) o.max_lag = fuzz_garbage();
  f.vehicle = fuzz_one_in(30) ? fuzz_int() : CAIRN_VEHICLE_PLANAR;
  f.max_landmarks = LANDMARKS;
  f.max_observations = 1 + (uint32_t)fuzz_below(10);
  f.state_error = fuzz_one_in(3);
  if (fuzz_one_in(4)) f.association = (int32_t)fuzz_below(3);
  if (fuzz_one_in(3)) f.initial_covariance[0] = f.initial_covariance[7] = fuzz_positive(1);
  if (o.mode == CAIRN_TEAM_SUBMAPS) f.submap_landmarks = 1 + (uint32_t)fuzz_below(8);
  if (fuzz_one_in(30)) f.submap_landmarks = 5;
  radar.range_sigma = fuzz_uniform(0.01, 1);
  if (fuzz_one_in(4)) radar.T_body_sensor.position[0] = fuzz_number(1);
  void* given = fuzz_one_in(5) ? fuzz_resized(&o, sizeof o) : memcpy(malloc(sizeof o), &o, sizeof o);
  const cairn_status status = cairn_team_create(fuzz_maybe(given), fuzz_maybe(&f), fuzz_maybe(&radar), &team, NULL);
  free(given);
  fuzz_check_status(status);
  HOLDS((team != NULL) == (status == CAIRN_OK), status);
  if (team == NULL) return;
  cairn_team_destroy(teams[number]);
  teams[number] = team;
  taken_by[number] = 0;
  clocks[number] = 0;
  for (uint64_t other = 1; other <= TEAMS; ++other)
    if (other != number + 1)
      fuzz_check_status(cairn_team_add(team, other, fuzz_one_in(3) ? NULL : &f.initial_pose, NULL, NULL));
}

static void level_pose(cairn_pose* out) {
  memset(out, 0, sizeof *out);
  const double half = fuzz_uniform(-1.6, 1.6);
  out->position[0] = fuzz_number(5), out->position[1] = fuzz_number(5);
  out->quaternion[0] = cos(half), out->quaternion[3] = sin(half);
  if (fuzz_one_in(40)) fuzz_pose(out);
}

static void level_covariance(double* out, double scale) {
  fuzz_covariance(out, 6, scale);
  for (int i = 0; i < 3 && fuzz_one_in(4); ++i) /* few directions */
    for (int k = 0; k < 6; ++k) {
      const int axis = i == 2 ? 5 : i;
      out[6 * axis + k] = out[6 * k + axis] = 0;
    }
}

static void check_nees(const cairn_team* team, const cairn_pose* truth) {
  double nees = -1;
  const cairn_status status = cairn_team_pose_nees(team, truth, &nees, NULL);
  fuzz_check_status(status);
  HOLDS((status == CAIRN_OK) == (nees >= 0), nees);
}

static void membership(cairn_team* team) {
  const uint64_t vehicle = fuzz_one_in(20) ? fuzz_id() : 1 + fuzz_below(TEAMS + 1);
  cairn_pose start;
  double covariance[36];
  level_pose(&start), level_covariance(covariance, 0.1);
  switch (fuzz_below(8)) {
    case 0:
      if (fuzz_one_in(5)) fuzz_check_status(cairn_team_remove(team, vehicle, NULL));
      break;
    case 1:
      fuzz_check_status(cairn_team_ask(team, NULL));
      break;
    case 2:
      if (fuzz_one_in(60)) fuzz_check_status(cairn_team_leave(team, NULL));
      break;
    case 3:
      fuzz_check_status(cairn_team_add(team, vehicle, NULL, NULL, NULL));
      break;
    case 4:
      fuzz_check_status(cairn_team_score(team, &start, NULL));
      check_nees(team, &start);
      break;
    default:
      fuzz_check_status(cairn_team_add(team, vehicle, &start, fuzz_one_in(3) ? NULL : covariance, NULL));
  }
}

static void motion(cairn_team* team) {
  cairn_pose T;
  double c[36], v[3], w[3];
  if (fuzz_one_in(2)) {
    level_pose(&T), level_covariance(c, 1e-3);
    fuzz_check_status(cairn_team_predict_increment(team, fuzz_maybe(&T), fuzz_maybe(c), NULL));
  } else {
    fuzz_numbers(v, 3, 1), fuzz_numbers(w, 3, 1);
    fuzz_check_status(cairn_team_predict_twist(team, fuzz_positive(1), fuzz_maybe(v), fuzz_maybe(w), NULL, NULL));
  }
}

static void sights(cairn_observation* out, size_t count, uint64_t names) {
  const uint64_t first = fuzz_below(names);
  for (size_t i = 0; i < count; ++i) {
    memset(&out[i], 0, sizeof out[i]);
    out[i].id = fuzz_one_in(40) ? fuzz_id() : 1 + (first + i) % names;
    out[i].z[0] = fuzz_bad() ? fuzz_garbage() : fuzz_uniform(0, 10);
    out[i].z[1] = fuzz_number(4);
    if (fuzz_one_in(8)) fuzz_covariance(out[i].covariance, 2, 0.1);
  }
}

static void observe(size_t number) {
  cairn_observation landmarks[12], vehicles[4];
  const size_t n = fuzz_below(fuzz_one_in(10) ? 12 : 5), m = fuzz_below(4);
  sights(landmarks, n, LANDMARKS + 2), sights(vehicles, m, TEAMS + 1);
  const double time = fuzz_bad() ? fuzz_garbage() : clocks[number] + 1;
  const cairn_status status =
      cairn_team_observe(teams[number], time, fuzz_one_in(60) ? NULL : landmarks, n, vehicles, m, NULL);
  fuzz_check_status(status);
  if (time == clocks[number] + 1 && status != CAIRN_ERROR_ARGUMENT) clocks[number] = time;
  if (fuzz_one_in(200)) clocks[number] += fuzz_uniform(0, 100); /* a long silence */
}

static void seal(uint8_t* bytes, size_t size) {
  uint32_t crc = UINT32_C(0xFFFFFFFF);
  for (size_t i = 0; i + 4 < size; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? UINT32_C(0xEDB88320) : 0u);
  }
  for (int i = 0; i < 4; ++i) bytes[size - 4 + (size_t)i] = (uint8_t)(~crc >> (8 * i));
}

static void spoil(uint8_t* bytes, size_t* size) {
  const int kind = (int)fuzz_below(6);
  if (*size == 0) return;
  if (kind == 0) *size = fuzz_below(*size);
  if (kind == 1) bytes[fuzz_below(*size)] ^= (uint8_t)(1 + fuzz_below(255));
  if (kind >= 2 && *size > HEAD + 12) {
    const size_t at =
        kind == 2 ? AT_VERSION + fuzz_below(*size - AT_VERSION) : AT_VEHICLE + 8 * fuzz_below((*size - 16) / 8);
    if (kind == 2) bytes[at] = (uint8_t)fuzz_bits();
    if (kind == 3) bytes[at] = (uint8_t)fuzz_below(5);
    if (kind >= 4) {
      const double value = fuzz_garbage();
      memcpy(bytes + at, &value, *size - 4 - at < 8 ? *size - 4 - at : 8);
    }
    seal(bytes, *size);
  }
}

static void deliver(cairn_team* team, const letter* l) {
  const bool random = fuzz_one_in(20);
  size_t size = random ? fuzz_below(200) : l->size;
  uint8_t* copy = malloc(size + 1);
  if (random)
    for (size_t i = 0; i < size; ++i) copy[i] = (uint8_t)fuzz_bits();
  else if (size > 0)
    memcpy(copy, l->bytes, size);
  if (fuzz_one_in(8)) spoil(copy, &size);
  uint8_t* exact = malloc(size + (size == 0));
  memcpy(exact, copy, size);
  int32_t result = 0;
  const view before = look(team);
  const cairn_status status = cairn_team_receive(team, exact, size, &result, NULL);
  fuzz_check_status(status);
  HOLDS(status == CAIRN_OK, status);
  HOLDS(result >= CAIRN_PACKET_TAKEN && result <= CAIRN_PACKET_AHEAD, result);
  ++results[result];
  const view after = look(team);
  if (result == CAIRN_PACKET_REQUEST || result >= CAIRN_PACKET_REPEATED)
    HOLDS(before.size == after.size && memcmp(before.bytes, after.bytes, before.size) == 0, result);
  free(before.bytes), free(after.bytes), free(copy), free(exact);
}

/* Takes what there is to send, or only asks for it, into the pool. */
static void take(cairn_team* team) {
  size_t needed = 0, given = 0;
  const cairn_status status = cairn_team_take_packet(team, NULL, 0, fuzz_maybe_out(&needed), NULL);
  fuzz_check_status(status);
  if (status != CAIRN_OK || needed == 0) return;
  const size_t room = fuzz_one_in(10) ? fuzz_below(needed) : needed;
  uint8_t* bytes = malloc(room + 1);
  const cairn_status copied = cairn_team_take_packet(team, bytes, room, &given, NULL);
  fuzz_check_status(copied);
  /* No room is a question, and takes nothing. */
  HOLDS(given == needed && (copied == CAIRN_OK) == (room == needed || room == 0), copied);
  if (room < needed) {
    free(bytes);
    return;
  }
  letter* l = &pool[fuzz_below(POOL)];
  free(l->bytes);
  l->bytes = bytes, l->size = needed;
  for (size_t i = 0; i < TEAMS; ++i) /* the post mostly does its duty; the pool has what comes late or twice */
    if (teams[i] != NULL && teams[i] != team && !fuzz_one_in(30)) deliver(teams[i], l);
}

static void call_one(void) {
  const size_t number = fuzz_below(TEAMS);
  if (fuzz_one_in(600)) { /* another voyage */
    for (size_t i = 0; i < TEAMS; ++i) create(i);
  }
  if (teams[number] == NULL || fuzz_one_in(4000)) create(number);
  cairn_team* team = teams[number];
  if (team == NULL) return;
  const uint64_t what = fuzz_below(100);
  if (what < 5) {
    fuzz_operation = "membership";
    membership(team);
  } else if (what < 20) {
    fuzz_operation = "motion";
    motion(team);
  } else if (what < 35) {
    fuzz_operation = "observe";
    observe(number);
  } else if (what < 80) {
    fuzz_operation = "take";
    take(team);
  } else {
    fuzz_operation = "deliver";
    deliver(team, &pool[fuzz_below(POOL)]);
  }
  free(look(team).bytes);
  check_report(number);
}

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    fprintf(stderr, "usage: team_fuzz SEED CALLS [LIMIT]\n");
    return 2;
  }
  const uint64_t seed = strtoull(argv[1], NULL, 10);
  fuzz_program = "team_fuzz";
  const unsigned long long calls = strtoull(argv[2], NULL, 10);
  fuzz_wild = false;
  fuzz_seed(seed, argc > 3 ? strtod(argv[3], NULL) : 1e4);
  for (fuzz_call = 1; fuzz_call <= calls; ++fuzz_call) call_one();
  for (size_t i = 0; i < TEAMS; ++i) cairn_team_destroy(teams[i]);
  for (size_t i = 0; i < POOL; ++i) free(pool[i].bytes);
  printf("seed %llu: %llu calls", (unsigned long long)seed, calls);
  for (int i = 0; i < 10; ++i) printf(", %s %llu", cairn_status_name(-i), fuzz_counts[i]);
  printf("\npackets by result:");
  for (int i = 1; i < 18; ++i) printf(" %llu", results[i]);
  printf("; %llu taken\n", (unsigned long long)taken);
  /* A run that never gets anywhere proves nothing. */
  return calls >= 10000 && (fuzz_counts[0] < calls / 2 || taken < calls / 100);
}
