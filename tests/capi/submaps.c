/* SPDX-License-Identifier: BSD-3-Clause */
/* The ring of landmarks, and snapshots of a filter with submaps. */
#include "submaps.h"

void ring_init(ring* r, uint64_t seed) {
  memset(r, 0, sizeof *r);
  r->random.state = seed;
  r->truth = pose_at(10, 0, 0.5, 0.05, -0.03, PI / 2);
}

void ring_landmark(unsigned i, double point[3]) {
  const double angle = 2 * PI * i / RING_LANDMARKS, radius = i % 2 == 0 ? 12.5 : 8;
  point[0] = radius * cos(angle), point[1] = radius * sin(angle), point[2] = 0.8 * sin(2.3 * i);
}

/* A step on a circle of 10 m around the origin. The vehicle keeps its initial tilt against the circle. */
void ring_next(ring* r, ring_frame* f) {
  const double angle = 2 * PI / RING_STEPS, chord = 2 * 10 * sin(angle / 2);
  const cairn_pose lap = {{0, 0, 0}, {cos(angle / 2), 0, 0, sin(angle / 2)}}, start = r->truth;
  cairn_pose inverse;
  memset(f, 0, sizeof *f);
  assert_ok(cairn_pose_compose(&lap, &start, &r->truth, NULL));
  assert_ok(cairn_pose_inverse(&start, &inverse, NULL));
  assert_ok(cairn_pose_compose(&inverse, &r->truth, &f->increment, NULL));
  double turn[3], noise[4];
  for (int i = 0; i < 3; ++i) {
    f->increment.position[i] += random_normal(&r->random, 0.02 * chord);
    turn[i] = random_normal(&r->random, 0.004);
    f->covariance[7 * i] = 4e-4 * chord * chord;
    f->covariance[7 * (i + 3)] = 1.6e-5;
  }
  assert_ok(cairn_quaternion_exp(turn, noise, NULL));
  const cairn_pose wobble = {{0, 0, 0}, {noise[0], noise[1], noise[2], noise[3]}};
  cairn_pose turned = {{0, 0, 0}, {0}};
  memcpy(turned.quaternion, f->increment.quaternion, sizeof turned.quaternion);
  assert_ok(cairn_pose_compose(&wobble, &turned, &turned, NULL));
  memcpy(f->increment.quaternion, turned.quaternion, sizeof turned.quaternion);
  for (unsigned i = 0; i < RING_LANDMARKS && f->count < RING_SEEN; ++i) {
    double point[3];
    cairn_observation* o = &f->seen[f->count];
    ring_landmark(i, point);
    to_body(&r->truth, point, o->z);
    if (o->z[0] * o->z[0] + o->z[1] * o->z[1] + o->z[2] * o->z[2] > 25) continue;
    o->id = i + 1;
    for (int k = 0; k < 3; ++k) o->z[k] += random_normal(&r->random, 0.05), o->covariance[4 * k] = 0.0025;
    ++f->count;
  }
  ++r->step;
}

cairn_filter_options ring_options(const ring* r, uint32_t landmarks, int32_t join) {
  cairn_filter_options options;
  assert_ok(cairn_filter_options_init(&options, sizeof options, NULL));
  options.max_landmarks = RING_LANDMARKS;
  options.max_observations = RING_SEEN;
  options.gate_probability = 0.99999;
  options.batch_gate_probability = 0.999999;
  options.initial_pose = r->truth;
  for (int i = 0; i < 6; ++i) options.initial_covariance[7 * i] = i < 3 ? 1e-2 : 1e-4;
  options.submap_landmarks = landmarks;
  options.join = join;
  return options;
}

cairn_filter* ring_filter(const cairn_filter_options* options) {
  const cairn_cartesian cartesian = test_cartesian();
  cairn_filter* filter = NULL;
  int32_t sensor = -1;
  assert_ok(cairn_filter_create(options, &filter, NULL));
  assert_ok(cairn_filter_add_cartesian(filter, &cartesian, &sensor, NULL));
  assert_int_equal(sensor, 0);
  return filter;
}

cairn_status ring_take(cairn_filter* filter, const ring_frame* f) {
  const cairn_status status = cairn_filter_predict_increment(filter, &f->increment, f->covariance, NULL);
  return status != CAIRN_OK ? status : cairn_filter_update(filter, 0, f->seen, f->count, NULL, NULL);
}

void ring_drive(ring* r, cairn_filter* const* filters, size_t count, unsigned steps) {
  for (unsigned k = 0; k < steps; ++k) {
    ring_frame f;
    ring_next(r, &f);
    for (size_t i = 0; i < count; ++i) assert_ok(ring_take(filters[i], &f));
  }
}

cairn_closing_report last_closing(const cairn_filter* filter) {
  cairn_closing_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(cairn_filter_last_closing(filter, &report, NULL));
  return report;
}

static void append(snapshot* s, const void* bytes, size_t size) {
  unsigned char* grown = realloc(s->bytes, s->size + size + 1);
  assert_non_null(grown);
  s->bytes = grown;
  if (size > 0) memcpy(grown + s->size, bytes, size);
  s->size += size;
}

static void append_map(snapshot* s, const cairn_map* map, const cairn_filter* joint_with) {
  const double origin[3] = {0.3, -0.2, 0.1}, side[3] = {9, 4, 0};
  size_t n = 0, needed = 0;
  assert_ok(cairn_map_size(map, &n, NULL));
  append(s, &n, sizeof n);
  if (n == 0) return;
  cairn_landmark* l = calloc(n, sizeof *l);
  uint64_t* ids = calloc(n, sizeof *ids);
  const size_t edge = 6 + 3 * n;
  double* joint = calloc(edge * edge, sizeof *joint);
  assert_true(l != NULL && ids != NULL && joint != NULL);
  assert_ok(cairn_map_landmarks(map, l, n, &needed, NULL));
  append(s, l, n * sizeof *l);
  for (size_t i = 0; i < n; ++i) ids[i] = l[i].id;
  assert_ok(cairn_map_joint_covariance(map, ids, n, joint, edge * edge, &needed, NULL));
  append(s, joint, needed * sizeof *joint);
  if (joint_with != NULL) {
    assert_ok(cairn_filter_joint_covariance(joint_with, ids, n, joint, edge * edge, &needed, NULL));
    append(s, joint, needed * sizeof *joint);
  }
  assert_ok(cairn_map_nearest(map, origin, n, l, n, &needed, NULL));
  append(s, l, needed * sizeof *l);
  assert_ok(cairn_map_within(map, side, 7, l, n, &needed, NULL));
  append(s, l, needed * sizeof *l);
  free(l), free(ids), free(joint);
}

void submaps_take(snapshot* s, const cairn_filter* filter) {
  cairn_pose pose;
  double covariance[36];
  const cairn_update_report report = last_update(filter);
  size_t count = 0;
  snapshot_free(s);
  append(s, &report, sizeof report);
  cairn_status (*const poses[])(const cairn_filter*, cairn_pose*, double*, cairn_error*) = {
      cairn_filter_pose, cairn_filter_local_pose, cairn_filter_base_pose};
  for (size_t i = 0; i < LENGTH(poses); ++i) {
    assert_ok(poses[i](filter, &pose, covariance, NULL));
    append(s, &pose, sizeof pose);
    append(s, covariance, sizeof covariance);
  }
  append_map(s, cairn_filter_map(filter), filter);
  append_map(s, cairn_filter_local_map(filter), NULL);
  assert_ok(cairn_filter_submap_count(filter, &count, NULL));
  append(s, &count, sizeof count);
  for (size_t i = 0; i < count; ++i) {
    uint64_t ids[256];
    size_t needed = 0;
    assert_ok(cairn_filter_submap(filter, i, &pose, ids, LENGTH(ids), &needed, NULL));
    append(s, &pose, sizeof pose);
    append(s, ids, needed * sizeof ids[0]);
  }
}
