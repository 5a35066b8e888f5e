/* SPDX-License-Identifier: BSD-3-Clause */
/* Closings that are refused, and submaps with exact or too little information that must close. After each refusal the
 * filter must be unchanged and behave like a filter that never got the call. */
#include "submaps.h"

static const int32_t joins[] = {CAIRN_JOIN_DENSE, CAIRN_JOIN_SPARSE};

typedef struct pair {
  ring course;
  cairn_filter *filter, *twin;
  snapshot before, after, other;
} pair;

static void pair_open(pair* p, const cairn_filter_options* change, uint32_t landmarks, int32_t join) {
  memset(p, 0, sizeof *p);
  ring_init(&p->course, 21);
  cairn_filter_options o = ring_options(&p->course, landmarks, join);
  if (change != NULL) o.max_landmarks = change->max_landmarks;
  p->filter = ring_filter(&o);
  p->twin = ring_filter(&o);
}

static void pair_drive(pair* p, unsigned steps) {
  cairn_filter* const both[] = {p->filter, p->twin};
  ring_drive(&p->course, both, 2, steps);
}

static void pair_close(pair* p) {
  cairn_filter_destroy(p->filter), cairn_filter_destroy(p->twin);
  snapshot_free(&p->before), snapshot_free(&p->after), snapshot_free(&p->other);
}

static void assert_alike(pair* p) {
  submaps_take(&p->after, p->filter);
  submaps_take(&p->other, p->twin);
  if (!snapshot_same(&p->after, &p->other)) fail_msg("the filter and its twin differ");
}

/* The call must fail, change nothing, and leave a filter that works. */
#define assert_left_alone(p, status, name, call)                                             \
  do {                                                                                       \
    submaps_take(&(p)->before, (p)->filter);                                                 \
    refusal_expected(NULL, (name));                                                          \
    refusal_check(NULL, (call), (status), (name), #call, __FILE__, __LINE__);                \
    submaps_take(&(p)->after, (p)->filter);                                                  \
    if (!snapshot_same(&(p)->before, &(p)->after)) fail_msg("%s changed the filter", #call); \
  } while (0)

static void null_pointers(void** state) {
  pair p;
  cairn_pose pose;
  cairn_closing_report report;
  size_t count = 0;
  uint64_t ids[4];
  (void)state;
  memset(&report, 0, sizeof report);
  pair_open(&p, NULL, 7, CAIRN_JOIN_SPARSE);
  pair_drive(&p, 20);
  const cairn_filter* f = p.filter;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_close_submap(NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_last_closing(NULL, &report, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_local_pose(NULL, &pose, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_base_pose(NULL, &pose, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_submap_count(NULL, &count, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_submap(NULL, 0, &pose, NULL, 0, &count, NULL));
  assert_null(cairn_filter_local_map(NULL));
  assert_left_alone(&p, CAIRN_ERROR_ARGUMENT, "report", cairn_filter_last_closing(f, NULL, NULL));
  assert_left_alone(&p, CAIRN_ERROR_ARGUMENT, "count", cairn_filter_submap_count(f, NULL, NULL));
  assert_left_alone(&p, CAIRN_ERROR_ARGUMENT, "needed", cairn_filter_submap(f, 0, &pose, ids, 4, NULL, NULL));
  assert_left_alone(&p, CAIRN_ERROR_ARGUMENT, "ids", cairn_filter_submap(f, 0, &pose, NULL, 4, &count, NULL));
  assert_left_alone(&p, CAIRN_ERROR_ARGUMENT, "struct_size", cairn_filter_last_closing(f, &report, NULL));
  assert_ok(cairn_filter_local_pose(f, NULL, NULL, NULL));
  assert_ok(cairn_filter_base_pose(f, NULL, NULL, NULL));
  pair_close(&p);
}

static void indices(void** state) {
  static const size_t beyond[] = {1, 2, SIZE_MAX};
  pair p;
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j) {
    pair_open(&p, NULL, 500, joins[j]);
    pair_drive(&p, 5);
    cairn_pose pose;
    uint64_t ids[64];
    size_t needed = 0;
    assert_left_alone(&p, CAIRN_ERROR_NOT_FOUND, "index",
                      cairn_filter_submap(p.filter, 0, &pose, ids, 64, &needed, NULL));
    assert_ok(cairn_filter_close_submap(p.filter, NULL));
    assert_ok(cairn_filter_submap(p.filter, 0, &pose, ids, 64, &needed, NULL));
    for (size_t i = 0; i < LENGTH(beyond); ++i)
      assert_left_alone(&p, CAIRN_ERROR_NOT_FOUND, "index",
                        cairn_filter_submap(p.filter, beyond[i], &pose, ids, 64, &needed, NULL));
    pair_close(&p);
  }
}

static void nothing_to_close(void** state) {
  pair p;
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j) {
    pair_open(&p, NULL, 500, joins[j]);
    assert_left_alone(&p, CAIRN_ERROR_STATE, "submap", cairn_filter_close_submap(p.filter, NULL));
    ring_frame blind; /* without observations a drive is not a submap yet */
    ring_next(&p.course, &blind);
    blind.count = 0;
    assert_ok(ring_take(p.filter, &blind));
    assert_ok(ring_take(p.twin, &blind));
    assert_left_alone(&p, CAIRN_ERROR_STATE, "landmark", cairn_filter_close_submap(p.filter, NULL));
    pair_drive(&p, 8);
    assert_ok(cairn_filter_close_submap(p.filter, NULL));
    assert_left_alone(&p, CAIRN_ERROR_STATE, "landmark", cairn_filter_close_submap(p.filter, NULL));
    assert_ok(cairn_filter_close_submap(p.twin, NULL));
    pair_drive(&p, 20);
    assert_alike(&p);
    pair_close(&p);
  }
  pair_open(&p, NULL, 0, CAIRN_JOIN_AUTO);
  pair_drive(&p, 8);
  assert_left_alone(&p, CAIRN_ERROR_STATE, "submap_landmarks", cairn_filter_close_submap(p.filter, NULL));
  pair_drive(&p, 8);
  assert_alike(&p);
  pair_close(&p);
}

static void options(void** state) {
  ring course;
  cairn_filter* f = NULL;
  size_t bytes = 0;
  (void)state;
  ring_init(&course, 22);
#define REFUSED(field, value)                                                                          \
  do {                                                                                                 \
    cairn_filter_options o = ring_options(&course, 7, CAIRN_JOIN_AUTO);                                \
    o.field = value;                                                                                   \
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, #field, cairn_filter_create(&o, &f, NULL));             \
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, #field, cairn_filter_required_bytes(&o, &bytes, NULL)); \
    assert_null(f);                                                                                    \
  } while (0)
  REFUSED(submap_landmarks, 4097);
  REFUSED(submap_landmarks, UINT32_MAX);
  REFUSED(join, -1);
  REFUSED(join, 3);
  REFUSED(submap_distance, -1);
  REFUSED(submap_extent, -1e-9);
  REFUSED(submap_sigma, -INFINITY);
  for (size_t i = 0; i < LENGTH(not_finite); ++i) {
    REFUSED(submap_distance, not_finite[i]);
    REFUSED(submap_extent, not_finite[i]);
    REFUSED(submap_sigma, not_finite[i]);
  }
  REFUSED(max_landmarks, 10000001);
  cairn_filter_options dense = ring_options(&course, 7, CAIRN_JOIN_DENSE);
  dense.max_landmarks = 30001;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "max_landmarks", cairn_filter_create(&dense, &f, NULL));
  dense.submap_landmarks = 0, dense.join = CAIRN_JOIN_SPARSE; /* a single map has no submaps to join */
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "max_landmarks", cairn_filter_create(&dense, &f, NULL));
#undef REFUSED
  cairn_filter_options huge =
      ring_options(&course, 4096, CAIRN_JOIN_SPARSE); /* only a bound: no memory is allocated for it */
  huge.max_landmarks = 10000000, huge.submap_landmarks = 20;
  assert_ok(cairn_filter_required_bytes(&huge, &bytes, NULL));
  assert_true(bytes < 10000000);
}

/* A submap closed by every frame; by limits that each landmark exceeds; by limits that are never reached. */
static void extreme_policies(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j)
    for (int kind = 0; kind < 3; ++kind) {
      ring course;
      size_t count = 0;
      ring_init(&course, 23);
      cairn_filter_options o = ring_options(&course, kind == 0 ? 1 : 500, joins[j]);
      if (kind == 1) o.submap_distance = o.submap_extent = o.submap_sigma = 1e-300;
      if (kind == 2) o.submap_distance = o.submap_extent = o.submap_sigma = 1e300;
      cairn_filter* f = ring_filter(&o);
      ring_drive(&course, &f, 1, RING_STEPS);
      assert_ok(cairn_filter_submap_count(f, &count, NULL));
      if (kind == 2) assert_int_equal(count, 0);
      if (kind < 2) assert_true(count > RING_STEPS * 3 / 4);
      cairn_pose pose;
      assert_ok(cairn_filter_pose(f, &pose, NULL, NULL));
      for (int i = 0; i < 3; ++i) assert_near(pose.position[i], course.truth.position[i], 1.5);
      cairn_filter_destroy(f);
    }
}

/* More landmarks than max_landmarks: the caller gets an error, frames go on, and the report says why no submap closes.
 * */
static void a_map_that_is_full(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j) {
    pair p;
    cairn_filter_options o;
    assert_ok(cairn_filter_options_init(&o, sizeof o, NULL));
    o.max_landmarks = 12;
    pair_open(&p, &o, 9, joins[j]);
    size_t closed = 0, count = 0;
    for (int step = 0; step < RING_STEPS && last_closing(p.filter).status == CAIRN_OK; ++step) pair_drive(&p, 1);
    assert_int_equal(last_closing(p.filter).status, CAIRN_ERROR_CAPACITY);
    assert_int_equal(last_closing(p.filter).reason, CAIRN_CLOSED_BY_LANDMARKS);
    assert_ok(cairn_filter_submap_count(p.filter, &closed, NULL));
    assert_left_alone(&p, CAIRN_ERROR_CAPACITY, "max_landmarks", cairn_filter_close_submap(p.filter, NULL));
    pair_drive(&p, 2);
    assert_ok(cairn_filter_submap_count(p.filter, &count, NULL));
    assert_int_equal(count, closed);
    assert_alike(&p);
    /* When there is room, the next attempt closes the submap. */
    uint64_t ids[64];
    size_t needed = 0;
    assert_ok(cairn_filter_submap(p.filter, 0, NULL, ids, 64, &needed, NULL));
    for (size_t i = 0; i < needed; ++i) (void)cairn_filter_remove_landmark(p.filter, ids[i], NULL);
    assert_ok(cairn_filter_close_submap(p.filter, NULL));
    assert_ok(cairn_filter_submap_count(p.filter, &count, NULL));
    assert_int_equal(count, closed + 1);
    pair_close(&p);
  }
}

/* Exact knowledge in a submap: a vehicle that did not move, motion without noise in some axes, a landmark seen from one
 * place only, a known start. Submaps must close nevertheless. */
static void exact_knowledge(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j)
    for (int known_start = 0; known_start < 2; ++known_start)
      /* axes 0: parked, 1: no noise at all, 2: no rotation noise, 3: no noise of height and tilt */
      for (int axes = 0; axes < 4; ++axes) {
        ring course;
        ring_init(&course, 24);
        cairn_filter_options o = ring_options(&course, 500, joins[j]);
        if (known_start) memset(o.initial_covariance, 0, sizeof o.initial_covariance);
        cairn_filter* f = ring_filter(&o);
        const cairn_pose stay = {{0, 0, 0}, {1, 0, 0, 0}};
        for (int submap = 0; submap < 6; ++submap) {
          for (int step = 0; step < (submap % 2 == 0 ? 1 : 6); ++step) {
            ring_frame seen;
            const cairn_pose before = course.truth;
            ring_next(&course, &seen);
            cairn_pose inverse, exact;
            assert_ok(cairn_pose_inverse(&before, &inverse, NULL));
            assert_ok(cairn_pose_compose(&inverse, &course.truth, &exact, NULL));
            for (int i = 0; i < 6; ++i) {
              const bool noisy = axes == 2 ? i < 3 : axes == 3 && (i < 2 || i == 5);
              if (!noisy) seen.covariance[7 * i] = 0;
            }
            if (axes < 3) memcpy(seen.increment.quaternion, exact.quaternion, sizeof exact.quaternion);
            if (axes < 2) seen.increment = exact;
            if (axes == 3) seen.increment.position[2] = exact.position[2];
            if (axes == 3) memcpy(seen.increment.quaternion, exact.quaternion, sizeof exact.quaternion);
            if (axes == 0) {
              seen.increment = stay;
              course.truth = before;
              for (size_t i = 0; i < seen.count; ++i) {
                double point[3];
                ring_landmark((unsigned)seen.seen[i].id - 1, point);
                to_body(&before, point, seen.seen[i].z);
                for (int k = 0; k < 3; ++k) seen.seen[i].z[k] += random_normal(&course.random, 0.05);
              }
            }
            assert_ok(ring_take(f, &seen));
          }
          assert_ok(cairn_filter_close_submap(f, NULL));
          const cairn_closing_report r = last_closing(f);
          assert_true(r.landmarks > 0 && isfinite(r.distance) && isfinite(r.moved_max));
          cairn_pose pose;
          double P[36], joint[81 * 81];
          cairn_landmark l[RING_LANDMARKS];
          uint64_t ids[RING_LANDMARKS];
          size_t n = 0, needed = 0;
          assert_ok(cairn_filter_pose(f, &pose, P, NULL));
          for (int i = 0; i < 3; ++i) assert_near(pose.position[i], course.truth.position[i], 1.2);
          for (int i = 0; i < 6; ++i) assert_true(P[7 * i] >= 0 && P[7 * i] < 1);
          assert_ok(cairn_map_landmarks(cairn_filter_map(f), l, LENGTH(l), &n, NULL));
          for (size_t i = 0; i < n; ++i) {
            ids[i] = l[i].id;
            for (int k = 0; k < 3; ++k) assert_true(l[i].covariance[4 * k] > 0 && l[i].covariance[4 * k] < 1);
          }
          assert_ok(cairn_filter_joint_covariance(f, ids, n, joint, LENGTH(joint), &needed, NULL));
          for (size_t i = 0; i < needed; ++i) assert_true(isfinite(joint[i]));
        }
        cairn_filter_destroy(f);
      }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(null_pointers),   cmocka_unit_test(indices),          cmocka_unit_test(nothing_to_close),
      cmocka_unit_test(options),         cmocka_unit_test(extreme_policies), cmocka_unit_test(a_map_that_is_full),
      cmocka_unit_test(exact_knowledge),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
