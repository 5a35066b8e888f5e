/* SPDX-License-Identifier: BSD-3-Clause */
/* A closing allocates memory. Whichever of its requests fails, the filter must be unchanged to the bit, and it must
 * close when there is memory again. Between closings nothing is allocated. */
#include "interposer.h"
#include "submaps.h"

typedef struct setting {
  int32_t join, error;
} setting;
static const setting settings[] = {{CAIRN_JOIN_DENSE, CAIRN_STATE_ERROR_INVARIANT},
                                   {CAIRN_JOIN_SPARSE, CAIRN_STATE_ERROR_INVARIANT},
                                   {CAIRN_JOIN_DENSE, CAIRN_STATE_ERROR_STANDARD},
                                   {CAIRN_JOIN_SPARSE, CAIRN_STATE_ERROR_STANDARD}};

static size_t seen_by_log;
static void count_lines(void* payload, const char* line) {
  (void)payload;
  seen_by_log += line[0] != '\0';
}

typedef struct stage {
  ring course;
  cairn_filter *filter, *twin;
  snapshot before, after, other;
} stage;

static void stage_open(stage* s, const setting* how, uint32_t landmarks) {
  memset(s, 0, sizeof *s);
  ring_init(&s->course, 11);
  cairn_filter_options options = ring_options(&s->course, landmarks, how->join);
  options.state_error = how->error;
  s->filter = ring_filter(&options);
  s->twin = ring_filter(&options);
}

static void stage_close(stage* s) {
  cairn_filter_destroy(s->filter), cairn_filter_destroy(s->twin);
  snapshot_free(&s->before), snapshot_free(&s->after), snapshot_free(&s->other);
}

static void stage_drive(stage* s, unsigned steps) {
  cairn_filter* const both[] = {s->filter, s->twin};
  ring_drive(&s->course, both, 2, steps);
}

static void assert_unchanged(stage* s, const char* what, size_t at) {
  submaps_take(&s->after, s->filter);
  if (!snapshot_same(&s->before, &s->after)) fail_msg("%s: request %zu refused, and the filter changed", what, at);
}

/* Lets each request of a call fail in turn, or every request from one on with a stride, until the call succeeds.
 * Returns the number of refusals. */
typedef cairn_status (*call)(cairn_filter* filter, cairn_error* error);
static size_t refuse_each(stage* s, const char* what, call make, bool for_good) {
  size_t refusals = 0;
  submaps_take(&s->before, s->filter);
  for (size_t at = 1;; at += for_good ? 5 : 1) {
    arm_to_fail(at, for_good);
    const cairn_status status = make(s->filter, NULL);
    const bool failed = counter.failed;
    counter.armed = false;
    if (!failed) {
      assert_ok(status);
      return refusals;
    }
    ++refusals;
    assert_status(status, CAIRN_ERROR_MEMORY);
    assert_unchanged(s, what, at);
  }
}

/* Both filters have the same inputs. Only one of them had failed requests. */
static void assert_alike(stage* s, const char* what) {
  submaps_take(&s->after, s->filter);
  submaps_take(&s->other, s->twin);
  if (!snapshot_same(&s->after, &s->other)) fail_msg("%s: the two filters differ", what);
}

/* Closings as the map grows: the first one, closings with new landmarks, the end of the loop, and closings with known
 * landmarks only. */
static void a_refused_closing_leaves_the_filter_as_it_was(void** state) {
  static const unsigned legs[] = {3, 7, 20, 29, 5, 9};
  (void)state;
  for (size_t k = 0; k < LENGTH(settings); ++k) {
    stage s;
    size_t refusals = 0;
    stage_open(&s, &settings[k], 500);
    for (size_t leg = 0; leg < LENGTH(legs); ++leg) {
      stage_drive(&s, legs[leg]);
      refusals += refuse_each(&s, "cairn_filter_close_submap", cairn_filter_close_submap, leg % 2 != 0);
      assert_ok(cairn_filter_close_submap(s.twin, NULL));
      assert_alike(&s, "cairn_filter_close_submap");
    }
    assert_true(refusals > 100); /* the interposer does replace the library's allocator */
    stage_close(&s);
  }
}

static cairn_status fix_position(cairn_filter* filter, cairn_error* error) {
  const double there[3] = {0.2, 9.8, 0.4};
  double covariance[9];
  diagonal(covariance, 3, 25);
  return cairn_filter_update_position(filter, there, covariance, NULL, NULL, error);
}

/* A fix closes the open submap and then moves the base. Both must happen, or neither. */
static void a_refused_fix_leaves_the_filter_as_it_was(void** state) {
  (void)state;
  for (size_t k = 0; k < LENGTH(settings); ++k)
    for (int for_good = 0; for_good < 2; ++for_good) {
      stage s;
      size_t refusals = 0;
      stage_open(&s, &settings[k], 500);
      for (int leg = 0; leg < 3; ++leg) {
        stage_drive(&s, 9);
        refusals += refuse_each(&s, "cairn_filter_update_position", fix_position, for_good != 0);
        assert_ok(fix_position(s.twin, NULL));
        assert_alike(&s, "cairn_filter_update_position");
        if (settings[k].join == CAIRN_JOIN_SPARSE) /* a second fix, with no submap to close */
          refusals += refuse_each(&s, "cairn_filter_update_position", fix_position, for_good != 0);
        else
          assert_ok(fix_position(s.filter, NULL));
        assert_ok(fix_position(s.twin, NULL));
        assert_alike(&s, "cairn_filter_update_position");
      }
      assert_true(refusals > 20);
      stage_close(&s);
    }
}

static cairn_status ask_all(cairn_filter* filter) {
  cairn_landmark l[RING_LANDMARKS];
  double joint[36 * 36];
  size_t needed = 0;
  const uint64_t ids[] = {1, 2, 5};
  const double point[3] = {5, 5, 0};
  const cairn_map* map = cairn_filter_map(filter);
  cairn_status status = cairn_map_landmarks(map, l, LENGTH(l), &needed, NULL);
  if (status == CAIRN_OK) status = cairn_map_nearest(map, point, 5, l, LENGTH(l), &needed, NULL);
  if (status == CAIRN_OK) status = cairn_map_landmark(map, 2, l, NULL);
  if (status == CAIRN_OK) status = cairn_map_joint_covariance(map, ids, 3, joint, LENGTH(joint), &needed, NULL);
  return status != CAIRN_OK ? status
                            : cairn_filter_joint_covariance(filter, ids, 3, joint, LENGTH(joint), &needed, NULL);
}

static void a_refused_query_does_not_harm_later_ones(void** state) {
  (void)state;
  for (size_t k = 0; k < LENGTH(settings); ++k)
    for (int for_good = 0; for_good < 2; ++for_good) {
      stage s;
      stage_open(&s, &settings[k], 6);
      stage_drive(&s, 35);
      /* No query was made since the last closing. The data that a query keeps for the next one is created while
       * requests fail. */
      size_t at = 1;
      for (bool failed = true; failed; at += for_good ? 5 : 1) {
        arm_to_fail(at, for_good != 0);
        const cairn_status status = ask_all(s.filter);
        failed = counter.failed;
        counter.armed = false;
        assert_status(status, failed ? CAIRN_ERROR_MEMORY : CAIRN_OK);
      }
      assert_true(at > 2);
      assert_alike(&s, "queries");
      stage_drive(&s, 30);
      assert_alike(&s, "queries, and a drive");
      stage_close(&s);
    }
}

/* In cairn_filter_update a failed closing is postponed: the frame counts, and a later frame closes the submap. */
static void a_failed_closing_of_an_update_is_postponed(void** state) {
  (void)state;
  for (size_t k = 0; k < LENGTH(settings); ++k)
    for (int late = 0; late < 2; ++late) {
      size_t refusals = 0;
      for (size_t at = 1, more = 1; more; at += 3) {
        stage s;
        ring_frame f;
        stage_open(&s, &settings[k], 7);
        assert_ok(cairn_filter_set_log(s.filter, count_lines, NULL, NULL, NULL));
        stage_drive(&s, late ? 60 : 1);
        size_t closed = 0, count = 0, left = 0;
        assert_ok(cairn_filter_submap_count(s.twin, &closed, NULL));
        for (count = closed; count == closed;) { /* the twin closes with this frame; the other filter must close too */
          ring_next(&s.course, &f);
          assert_ok(ring_take(s.twin, &f));
          assert_ok(cairn_filter_submap_count(s.twin, &count, NULL));
          if (count == closed) assert_ok(ring_take(s.filter, &f));
        }
        seen_by_log = 0;
        assert_ok(cairn_filter_predict_increment(s.filter, &f.increment, f.covariance, NULL));
        cairn_match matches[RING_SEEN];
        memset(matches, 0xff, sizeof matches);
        arm_to_fail(at, at % 2 == 0);
        const cairn_status status = cairn_filter_update(s.filter, 0, f.seen, f.count, matches, NULL);
        more = counter.failed;
        counter.armed = false;
        assert_ok(status);
        for (size_t i = 0; i < f.count; ++i)
          assert_true(matches[i].result <= CAIRN_RESULT_REJECTED && matches[i].result >= 0);
        cairn_closing_report report = last_closing(s.filter);
        assert_int_equal(report.status, more ? CAIRN_ERROR_MEMORY : CAIRN_OK);
        assert_int_equal(report.reason, CAIRN_CLOSED_BY_LANDMARKS);
        assert_true(report.landmarks >= 7);
        assert_ok(cairn_filter_submap_count(s.filter, &count, NULL));
        assert_int_equal(count, closed + !more);
        assert_int_equal(report.submaps, count);
        assert_ok(cairn_map_size(cairn_filter_local_map(s.filter), &left, NULL));
        assert_int_equal(left, more ? report.landmarks : 0);
        if (more) {
          cairn_pose a, b;
          ++refusals;
          assert_int_equal(seen_by_log, 1);
          assert_ok(cairn_filter_pose(s.filter, &a, NULL, NULL));
          assert_ok(cairn_filter_pose(s.twin, &b, NULL, NULL)); /* the base: fused landmarks may have moved it */
          for (int i = 0; i < 3; ++i) assert_near(a.position[i], b.position[i], 0.3);
          for (int wait = 0; wait < 3 && count == closed; ++wait) {
            ring_next(&s.course, &f);
            assert_ok(ring_take(s.filter, &f));
            assert_ok(cairn_filter_submap_count(s.filter, &count, NULL));
          }
          assert_int_equal(count, closed + 1);
          report = last_closing(s.filter);
          assert_int_equal(report.status, CAIRN_OK);
        }
        stage_close(&s);
      }
      assert_true(refusals > 3);
    }
}

/* Predictions, and updates that close no submap. */
static void between_closings_nothing_is_allocated(void** state) {
  (void)state;
  for (size_t k = 0; k < LENGTH(settings); ++k) {
    stage s;
    size_t closings = 0;
    stage_open(&s, &settings[k], 7);
    for (int step = 0; step < 2 * RING_STEPS; ++step) {
      ring_frame f;
      size_t before = 0, after = 0;
      ring_next(&s.course, &f);
      assert_ok(cairn_filter_submap_count(s.filter, &before, NULL));
      arm_to_fail(0, false);
      const cairn_status moved = cairn_filter_predict_increment(s.filter, &f.increment, f.covariance, NULL);
      const size_t by_motion = counter.calls;
      const cairn_status updated = cairn_filter_update(s.filter, 0, f.seen, f.count, NULL, NULL);
      const size_t by_update = counter.calls - by_motion;
      counter.armed = false;
      assert_true(moved == CAIRN_OK && updated == CAIRN_OK);
      assert_int_equal(by_motion, 0);
      assert_ok(cairn_filter_submap_count(s.filter, &after, NULL));
      if (after == before)
        assert_int_equal(by_update, 0);
      else
        ++closings;
    }
    assert_true(closings > 8);
    stage_close(&s);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_refused_closing_leaves_the_filter_as_it_was),
      cmocka_unit_test(a_refused_fix_leaves_the_filter_as_it_was),
      cmocka_unit_test(a_refused_query_does_not_harm_later_ones),
      cmocka_unit_test(a_failed_closing_of_an_update_is_postponed),
      cmocka_unit_test(between_closings_nothing_is_allocated),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
