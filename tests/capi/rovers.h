/* SPDX-License-Identifier: BSD-3-Clause */
/* Shared by the tests of copies and merges: rovers that drive through one field of landmarks, each in its own frame,
 * and snapshots of everything that a map tells. */
#ifndef CAIRN_TESTS_CAPI_ROVERS_H
#define CAIRN_TESTS_CAPI_ROVERS_H

#include "support.h"

#define FIELD 48
#define SEEN 16

enum { SINGLE, JOINED, SPARSE, KINDS }; /* kind of map of a filter: single, densely joined, sparsely joined */

typedef struct rover {
  generator random;
  cairn_pose start; /* the rover's frame in the world: its exact start */
  cairn_pose truth; /* of the body in the world */
  cairn_filter* filter;
  uint64_t first_id; /* landmark i has the id first_id + i */
} rover;

static inline void field_landmark(unsigned i, double point[3]) {
  generator random = {UINT64_C(7001) + i};
  (void)random_bits(&random);
  point[0] = 1.9 * i + random_uniform(&random, -3, 3);
  point[1] = random_uniform(&random, -11, 11);
  point[2] = random_uniform(&random, -2, 2);
}

static inline cairn_filter_options rover_options(int kind) {
  cairn_filter_options options;
  assert_ok(cairn_filter_options_init(&options, sizeof options, NULL));
  options.max_landmarks = FIELD;
  options.max_observations = SEEN;
  options.gate_probability = options.batch_gate_probability = 1;
  options.submap_landmarks = kind == SINGLE ? 0 : 9;
  options.join = kind == SPARSE ? CAIRN_JOIN_SPARSE : CAIRN_JOIN_DENSE;
  return options;
}

static inline void rover_open(rover* r, int kind, uint64_t seed, cairn_pose start, uint64_t first_id) {
  const cairn_filter_options options = rover_options(kind);
  cairn_cartesian cartesian;
  int32_t sensor;
  memset(r, 0, sizeof *r);
  r->random.state = seed;
  r->start = r->truth = start;
  r->first_id = first_id;
  assert_ok(cairn_filter_create(&options, &r->filter, NULL));
  assert_ok(cairn_cartesian_init(&cartesian, sizeof cartesian, NULL));
  assert_ok(cairn_filter_add_cartesian(r->filter, &cartesian, &sensor, NULL));
}

static inline void rover_close(rover* r) {
  cairn_filter_destroy(r->filter);
  r->filter = NULL;
}

/* Drives one metre at a time. All landmarks within 11 m are seen. */
static inline void rover_drive(rover* r, unsigned steps) {
  const double metres = 0.01, radians = 0.001, seen = 0.04;
  for (unsigned step = 0; step < steps; ++step) {
    const cairn_pose ahead = pose_at(1, 0, 0, 0.01 * sin(0.3 * step), 0, 0.03 * cos(0.2 * step));
    const cairn_pose slip = pose_at(random_normal(&r->random, metres), random_normal(&r->random, metres),
                                    random_normal(&r->random, metres), random_normal(&r->random, radians),
                                    random_normal(&r->random, radians), random_normal(&r->random, radians));
    cairn_pose felt, next;
    double covariance[36];
    cairn_observation o[SEEN];
    size_t count = 0;
    assert_ok(cairn_pose_compose(&r->truth, &ahead, &next, NULL));
    r->truth = next;
    assert_ok(cairn_pose_compose(&ahead, &slip, &felt, NULL));
    diagonal(covariance, 6, metres * metres);
    for (int i = 3; i < 6; ++i) covariance[7 * i] = radians * radians;
    assert_ok(cairn_filter_predict_increment(r->filter, &felt, covariance, NULL));
    memset(o, 0, sizeof o);
    for (unsigned i = 0; i < FIELD && count < SEEN; ++i) {
      double point[3];
      field_landmark(i, point);
      to_body(&r->truth, point, o[count].z);
      if (o[count].z[0] * o[count].z[0] + o[count].z[1] * o[count].z[1] > 121) continue;
      o[count].id = r->first_id + i;
      for (int k = 0; k < 3; ++k) o[count].z[k] += random_normal(&r->random, seen);
      diagonal(o[count].covariance, 3, seen * seen);
      ++count;
    }
    assert_ok(cairn_filter_update(r->filter, 0, o, count, NULL, NULL));
  }
}

/* Two rovers that start at both ends of the field and both see its middle, and one rover in the middle. */
static inline void rover_west(rover* r, int kind, uint64_t seed) {
  rover_open(r, kind, 1000 + seed, pose_at(-2, 1, 0.3, 0.02, -0.01, 0.05), 100);
  rover_drive(r, 58);
}
static inline void rover_east(rover* r, int kind, uint64_t seed, uint64_t first_id) {
  rover_open(r, kind, 2000 + seed, pose_at(95, -2, -0.4, -0.03, 0.02, PI - 0.1), first_id);
  rover_drive(r, 58);
}
static inline void rover_middle(rover* r, int kind, uint64_t seed) {
  rover_open(r, kind, 3000 + seed, pose_at(25, 3, 0, 0, 0, -0.05), 100);
  rover_drive(r, 40);
}

/* A copy of the rover's map, with the landmarks of the open submap. */
static inline cairn_map* rover_map(rover* r) {
  cairn_map* map = NULL;
  (void)cairn_filter_close_submap(r->filter, NULL); /* there may be no open submap, or an empty one */
  assert_ok(cairn_map_copy(cairn_filter_map(r->filter), &map, NULL));
  assert_non_null(map);
  return map;
}

static inline size_t size_of(const cairn_map* map) {
  size_t count = 0;
  assert_ok(cairn_map_size(map, &count, NULL));
  return count;
}

/* Everything that a map returns, as bytes: landmarks, their joint covariance, the merged ids. */
static inline void map_take(snapshot* s, const cairn_map* map) {
  const size_t n = size_of(map);
  size_t renamed = 0, needed = 0;
  assert_ok(cairn_map_merged_ids(map, NULL, 0, &renamed, NULL));
  snapshot_free(s);
  const size_t landmarks = n * sizeof(cairn_landmark), joint = 9 * n * n * sizeof(double);
  s->size = landmarks + joint + renamed * sizeof(cairn_merged_id);
  s->bytes = calloc(1, s->size + 1);
  assert_non_null(s->bytes);
  uint64_t ids[4 * FIELD];
  assert_true(n <= LENGTH(ids));
  cairn_landmark* all = (cairn_landmark*)(void*)s->bytes;
  assert_ok(cairn_map_landmarks(map, all, n, &needed, NULL));
  for (size_t i = 0; i < n; ++i) ids[i] = all[i].id;
  assert_ok(cairn_map_joint_covariance(map, ids, n, (double*)(void*)(s->bytes + landmarks), 9 * n * n, &needed, NULL));
  assert_ok(cairn_map_merged_ids(map, (cairn_merged_id*)(void*)(s->bytes + landmarks + joint), renamed, &needed, NULL));
}

/* Squared error of all landmarks of a map in the frame `start` of the world, normalised by their joint covariance:
 * chi-square with 3 n degrees of freedom. `*far` (or NULL) gets the largest error, m. Landmark i has the id first_id +
 * i. */
static inline double map_nees(const cairn_map* map, const cairn_pose* start, uint64_t first_id, double* far) {
  const size_t n = size_of(map), m = 3 * n;
  size_t needed;
  cairn_landmark all[FIELD];
  uint64_t ids[FIELD];
  double *P = calloc(m * m, sizeof *P), error[3 * FIELD], sum = 0;
  assert_non_null(P);
  assert_ok(cairn_map_landmarks(map, all, FIELD, &needed, NULL));
  for (size_t i = 0; i < n; ++i) {
    double point[3], truth[3], square = 0;
    ids[i] = all[i].id;
    field_landmark((unsigned)(ids[i] - first_id), point);
    to_body(start, point, truth);
    for (size_t k = 0; k < 3; ++k) error[3 * i + k] = truth[k] - all[i].position[k];
    for (size_t k = 0; k < 3; ++k) square += error[3 * i + k] * error[3 * i + k];
    if (far != NULL && sqrt(square) > *far) *far = sqrt(square);
  }
  assert_ok(cairn_map_joint_covariance(map, ids, n, P, m * m, &needed, NULL));
  for (size_t c = 0; c < m; ++c) { /* Cholesky factorisation with forward substitution in the same loop */
    for (size_t r = c; r < m; ++r) {
      for (size_t k = 0; k < c; ++k) P[r * m + c] -= P[r * m + k] * P[c * m + k];
      if (r == c) assert_true(P[c * m + c] > 0);
      P[r * m + c] = r == c ? sqrt(P[r * m + c]) : P[r * m + c] / P[c * m + c];
    }
    for (size_t k = 0; k < c; ++k) error[c] -= P[c * m + k] * error[k];
    error[c] /= P[c * m + c];
    sum += error[c] * error[c];
  }
  free(P);
  return sum;
}

#endif
