/* SPDX-License-Identifier: BSD-3-Clause */
/* The same inputs give the same bits: repeated, interleaved with another handle, and in separate threads. */
#include <pthread.h>

#include "support.h"

enum { STEPS = 60 };

static void frames_of(uint64_t seed, frame frames[STEPS]) {
  world w;
  world_init(&w, seed);
  for (int n = 0; n < STEPS; ++n) world_frame(&w, &frames[n]);
}

static void open_as(rig* r, int32_t error) {
  cairn_filter_options options = test_options();
  options.state_error = error;
  rig_open(r, &options);
}

static void run(const frame frames[STEPS], int32_t error, snapshot* end) {
  rig r;
  open_as(&r, error);
  for (int n = 0; n < STEPS; ++n) assert_ok(rig_take(&r, &frames[n], NULL));
  snapshot_take(end, r.filter);
  rig_close(&r);
}

static void repeated_runs_give_the_same_bits(void** state) {
  (void)state;
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
    frame frames[STEPS];
    snapshot a = {0, NULL}, b = {0, NULL}, other = {0, NULL};
    frames_of(1, frames);
    run(frames, error, &a);
    void* between = malloc(4096 + 17); /* different memory addresses */
    run(frames, error, &b);
    free(between);
    assert_true(snapshot_same(&a, &b));
    frames[3].observations[0].z[0] += 1e-9;
    run(frames, error, &other);
    assert_false(snapshot_same(&a, &other)); /* the comparison does detect a difference */
    snapshot_free(&a);
    snapshot_free(&b);
    snapshot_free(&other);
  }
}

static void interleaved_handles_are_independent(void** state) {
  static frame frames[2][STEPS];
  snapshot alone[2] = {{0, NULL}, {0, NULL}}, mixed[2] = {{0, NULL}, {0, NULL}};
  rig r[2];
  (void)state;
  for (int k = 0; k < 2; ++k) {
    frames_of((uint64_t)k + 5, frames[k]);
    run(frames[k], k, &alone[k]);
    open_as(&r[k], k);
  }
  for (int n = 0; n < STEPS; ++n)
    for (int k = 0; k < 2; ++k) assert_ok(rig_take(&r[k], &frames[k][n], NULL));
  for (int k = 0; k < 2; ++k) {
    snapshot_take(&mixed[k], r[k].filter);
    assert_true(snapshot_same(&alone[k], &mixed[k]));
    rig_close(&r[k]);
    snapshot_free(&alone[k]);
    snapshot_free(&mixed[k]);
  }
}

/* Queries between the steps change nothing. */
static void queries_change_nothing(void** state) {
  static frame frames[STEPS];
  snapshot quiet = {0, NULL}, asked = {0, NULL};
  rig r;
  (void)state;
  frames_of(9, frames);
  run(frames, CAIRN_STATE_ERROR_INVARIANT, &quiet);
  open_as(&r, CAIRN_STATE_ERROR_INVARIANT);
  for (int n = 0; n < STEPS; ++n) {
    double value;
    assert_ok(rig_take(&r, &frames[n], NULL));
    snapshot_take(&asked, r.filter);
    assert_ok(cairn_filter_audit(r.filter, &value, NULL));
    assert_ok(cairn_filter_pose_nees(r.filter, &frames[n].increment, &value, NULL));
  }
  snapshot_take(&asked, r.filter);
  assert_true(snapshot_same(&quiet, &asked));
  rig_close(&r);
  snapshot_free(&quiet);
  snapshot_free(&asked);
}

typedef struct job {
  rig rig;
  frame frames[STEPS];
  cairn_status status;
} job;

static void* work(void* argument) {
  job* j = argument;
  j->status = CAIRN_OK;
  for (int n = 0; n < STEPS && j->status == CAIRN_OK; ++n) j->status = rig_take(&j->rig, &j->frames[n], NULL);
  return NULL;
}

static void threads_give_the_same_bits_as_a_serial_run(void** state) {
  enum { JOBS = 4 };
  static job jobs[JOBS];
  pthread_t threads[JOBS];
  (void)state;
  for (int k = 0; k < JOBS; ++k) {
    frames_of((uint64_t)k / 2 + 20, jobs[k].frames); /* two pairs of filters with the same inputs */
    open_as(&jobs[k].rig, k % 2);
  }
  for (int k = 0; k < JOBS; ++k) assert_int_equal(pthread_create(&threads[k], NULL, work, &jobs[k]), 0);
  for (int k = 0; k < JOBS; ++k) assert_int_equal(pthread_join(threads[k], NULL), 0);
  for (int k = 0; k < JOBS; ++k) {
    snapshot serial = {0, NULL}, threaded = {0, NULL};
    assert_ok(jobs[k].status);
    run(jobs[k].frames, k % 2, &serial);
    snapshot_take(&threaded, jobs[k].rig.filter);
    assert_true(snapshot_same(&serial, &threaded));
    rig_close(&jobs[k].rig);
    snapshot_free(&serial);
    snapshot_free(&threaded);
  }
}

typedef struct reader {
  const cairn_filter* filter;
  bool same;
} reader;

static void* read_side_by_side(void* argument) {
  reader* r = argument;
  cairn_landmark first[WORLD_LANDMARKS], again[WORLD_LANDMARKS];
  const uint64_t ids[3] = {3, 1, 7};
  const double centre[3] = {1, 2, 0};
  double a[225], b[225];
  size_t n, m;
  const cairn_map* map = cairn_filter_map(r->filter);
  r->same = cairn_map_within(map, centre, 14, first, WORLD_LANDMARKS, &n, NULL) == CAIRN_OK &&
            cairn_filter_joint_covariance(r->filter, ids, 3, a, 225, &m, NULL) == CAIRN_OK;
  for (int k = 0; k < 300 && r->same; ++k)
    r->same = cairn_map_within(map, centre, 14, again, WORLD_LANDMARKS, &m, NULL) == CAIRN_OK && m == n &&
              memcmp(first, again, n * sizeof first[0]) == 0 &&
              cairn_filter_joint_covariance(r->filter, ids, 3, b, 225, &m, NULL) == CAIRN_OK &&
              memcmp(a, b, sizeof a) == 0;
  return NULL;
}

/* Const queries of one handle may run in parallel. A thread sanitizer detects it if they may not. */
static void queries_run_in_parallel(void** state) {
  bench* b = *state;
  reader readers[3];
  pthread_t threads[3];
  for (int k = 0; k < 3; ++k) readers[k].filter = b->main.filter;
  for (int k = 0; k < 3; ++k) assert_int_equal(pthread_create(&threads[k], NULL, read_side_by_side, &readers[k]), 0);
  for (int k = 0; k < 3; ++k) assert_int_equal(pthread_join(threads[k], NULL), 0);
  for (int k = 0; k < 3; ++k) assert_true(readers[k].same);
}

/* The log: silent by default, passes the caller's payload, has one line for each refusal, and does not influence the
 * filter. */
typedef struct diary {
  int lines;
  bool whole;
} diary;

static void write_down(void* payload, const char* line) {
  diary* d = payload;
  ++d->lines;
  d->whole &= line != NULL && line[0] != '\0' && strchr(line, '\n') == NULL;
}

static void the_log_reports_rejections_and_changes_nothing(void** state) {
  bench* b = *state;
  diary d = {0, true};
  double covariance[9];
  const double far[3] = {1000, 1000, 1000};
  cairn_match m;
  diagonal(covariance, 3, 1e-2);
  assert_ok(cairn_filter_set_log(b->main.filter, write_down, &d, NULL, NULL));
  for (int k = 0; k < 2; ++k)
    assert_ok(
        cairn_filter_update_position(k == 0 ? b->main.filter : b->shadow.filter, far, covariance, NULL, &m, NULL));
  assert_int_equal(m.result, CAIRN_RESULT_REJECTED);
  assert_int_equal(d.lines, 1);
  frame f = bench_until(b, CARTESIAN); /* each value is slightly off; together they are too far off */
  for (size_t i = 0; i < f.count; ++i) f.observations[i].z[i % 3] += i % 2 ? 0.4 : -0.4;
  cairn_match matches[WORLD_LANDMARKS];
  assert_ok(cairn_filter_update(b->main.filter, b->main.sensors[CARTESIAN], f.observations, f.count, matches, NULL));
  size_t batch = 0;
  for (size_t i = 0; i < f.count; ++i) batch += matches[i].reason == CAIRN_REASON_BATCH_GATE;
  assert_true(batch > 0);
  assert_ok(cairn_filter_update(b->shadow.filter, b->shadow.sensors[CARTESIAN], f.observations, f.count, NULL, NULL));
  assert_true(d.lines >= 2 && d.whole);
  bench_continue(b, 12);
  assert_ok(cairn_filter_set_log(b->main.filter, NULL, NULL, NULL, NULL));
  const int lines = d.lines;
  assert_ok(cairn_filter_update_position(b->main.filter, far, covariance, NULL, &m, NULL));
  assert_int_equal(d.lines, lines);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_set_log(NULL, write_down, &d, NULL, NULL));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(repeated_runs_give_the_same_bits),
      cmocka_unit_test(interleaved_handles_are_independent),
      cmocka_unit_test(queries_change_nothing),
      cmocka_unit_test(threads_give_the_same_bits_as_a_serial_run),
      cmocka_unit_test_setup_teardown(queries_run_in_parallel, bench_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(the_log_reports_rejections_and_changes_nothing, bench_setup, bench_teardown),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
