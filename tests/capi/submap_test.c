/* SPDX-License-Identifier: BSD-3-Clause */
/* Submaps through the C interface: what closes them, reports, and the relation of poses and maps. */
#include "submaps.h"

static const int32_t joins[] = {CAIRN_JOIN_DENSE, CAIRN_JOIN_SPARSE};
static const int32_t errors[] = {CAIRN_STATE_ERROR_INVARIANT, CAIRN_STATE_ERROR_STANDARD};

static size_t submaps_of(const cairn_filter* f) {
  size_t count = 0;
  assert_ok(cairn_filter_submap_count(f, &count, NULL));
  return count;
}

static size_t landmarks_of(const cairn_map* map) {
  size_t count = 0;
  assert_ok(cairn_map_size(map, &count, NULL));
  return count;
}

/* Conditions that hold for the report of any successful closing. */
static void check_report(const cairn_filter* f, int32_t reason, int32_t join) {
  const cairn_closing_report r = last_closing(f);
  assert_int_equal(r.status, CAIRN_OK);
  assert_int_equal(r.reason, reason);
  assert_int_equal(r.submaps, submaps_of(f));
  assert_int_equal(r.landmarks, r.landmarks_new + r.landmarks_fused + r.landmarks_refused);
  assert_int_equal(r.rows, 3 * r.landmarks_fused);
  assert_true(r.seconds > 0 && r.seconds < 10);
  assert_true(r.moved_rms >= 0 && r.moved_max >= r.moved_rms);
  assert_int_equal(r.refactored > 0, join == CAIRN_JOIN_SPARSE);
  if (r.rows > 0) assert_true(r.threshold > 0 && (r.distance <= r.threshold || r.landmarks_refused > 0));
  size_t ids = 0;
  assert_ok(cairn_filter_submap(f, r.submaps - 1, NULL, NULL, 0, &ids, NULL));
  assert_int_equal(ids, r.landmarks);
}

/* Drives until a submap is closed; returns the number of steps. */
static unsigned drive_to_closing(ring* course, cairn_filter* f) {
  const size_t before = submaps_of(f);
  unsigned steps = 0;
  for (; submaps_of(f) == before && steps < 2 * RING_STEPS; ++steps) ring_drive(course, &f, 1, 1);
  assert_int_equal(submaps_of(f), before + 1);
  return steps;
}

static void each_reason_closes(void** state) {
  static const struct {
    int32_t reason;
    uint32_t landmarks;
    double distance, extent, sigma;
  } cases[] = {{CAIRN_CLOSED_BY_LANDMARKS, 7, 0, 0, 0},
               {CAIRN_CLOSED_BY_DISTANCE, 500, 5, 0, 0},
               {CAIRN_CLOSED_BY_EXTENT, 500, 0, 7, 0},
               {CAIRN_CLOSED_BY_SIGMA, 500, 0, 0, 0.04}};
  (void)state;
  for (size_t k = 0; k < LENGTH(cases); ++k)
    for (size_t j = 0; j < LENGTH(joins); ++j) {
      ring course;
      ring_init(&course, 5);
      cairn_filter_options o = ring_options(&course, cases[k].landmarks, joins[j]);
      o.submap_distance = cases[k].distance, o.submap_extent = cases[k].extent, o.submap_sigma = cases[k].sigma;
      cairn_filter* f = ring_filter(&o);
      assert_int_equal(last_closing(f).reason, CAIRN_CLOSED_BY_NONE);
      for (int n = 0; n < 6; ++n) {
        const unsigned steps = drive_to_closing(&course, f);
        check_report(f, cases[k].reason, joins[j]);
        /* A step is 1.047 m, with 2 % noise. */
        if (cases[k].reason == CAIRN_CLOSED_BY_DISTANCE) assert_true(steps >= 5 && steps <= 6);
        if (cases[k].reason == CAIRN_CLOSED_BY_LANDMARKS) assert_true(last_closing(f).landmarks >= 7);
        if (cases[k].reason == CAIRN_CLOSED_BY_EXTENT) assert_true(steps >= 2);
        if (cases[k].reason == CAIRN_CLOSED_BY_SIGMA) assert_true(steps >= 3);
        assert_int_equal(landmarks_of(cairn_filter_local_map(f)), 0);
      }
      ring_drive(&course, &f, 1, 1);
      assert_ok(cairn_filter_close_submap(f, NULL));
      check_report(f, CAIRN_CLOSED_BY_CALLER, joins[j]);
      cairn_filter_destroy(f);
    }
}

static void the_first_fix_closes(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j)
    for (int kind = 0; kind < 3; ++kind) {
      ring course;
      cairn_match match;
      double c[9], m[9], before[36], after[36];
      ring_init(&course, 6);
      const cairn_filter_options o = ring_options(&course, 500, joins[j]);
      cairn_filter* f = ring_filter(&o);
      ring_drive(&course, &f, 1, 20);
      assert_int_equal(submaps_of(f), 0);
      assert_ok(cairn_filter_pose(f, NULL, before, NULL));
      diagonal(c, 3, kind == 0 ? 1e-4 : 1e-6);
      rotation_matrix(course.truth.quaternion, m);
      if (kind == 0) assert_ok(cairn_filter_update_position(f, course.truth.position, c, NULL, &match, NULL));
      if (kind == 1) assert_ok(cairn_filter_update_attitude(f, course.truth.quaternion, c, &match, NULL));
      if (kind == 2) assert_ok(cairn_filter_update_heading(f, atan2(m[3], m[0]), 1e-3, &match, NULL));
      assert_int_equal(match.result, CAIRN_RESULT_MATCHED);
      check_report(f, CAIRN_CLOSED_BY_FIX, joins[j]);
      assert_ok(cairn_filter_pose(f, NULL, after, NULL));
      if (kind == 0)
        for (int i = 0; i < 3; ++i) assert_true(after[7 * i] <= 1e-4 && after[7 * i] < before[7 * i]);
      if (kind > 0) assert_true(after[35] <= (kind == 1 ? 1.01e-6 : 2e-6) && after[35] < before[35]);
      /* Later ones do not: at the base, after a drive without landmarks, and after one with some. */
      for (int later = 0; later < 3; ++later) {
        ring_frame next;
        if (later > 0) {
          ring_next(&course, &next);
          if (later == 1) next.count = 0;
          assert_ok(ring_take(f, &next));
        }
        diagonal(c, 3, 1e-2);
        assert_ok(cairn_filter_pose(f, NULL, before, NULL));
        assert_ok(cairn_filter_update_position(f, course.truth.position, c, NULL, &match, NULL));
        assert_int_equal(match.result, CAIRN_RESULT_MATCHED);
        assert_ok(cairn_filter_pose(f, NULL, after, NULL));
        for (int i = 0; i < 3; ++i) assert_true(after[7 * i] <= 1e-2 && after[7 * i] < before[7 * i]);
        assert_int_equal(submaps_of(f), 1);
      }
      /* The closing knows what they told: the pose stays as good, up to linearisation. */
      assert_ok(cairn_filter_close_submap(f, NULL));
      assert_int_equal(last_closing(f).status, CAIRN_OK);
      assert_int_equal(last_closing(f).landmarks_refused, 0);
      assert_ok(cairn_filter_pose(f, NULL, before, NULL));
      for (int i = 0; i < 6; ++i) assert_true(fabs(before[7 * i] - after[7 * i]) <= 0.02 * after[7 * i]);
      cairn_filter_destroy(f);
    }
}

/* A base whose heading is hardly known, and a fix so far away that it is not linear in it: the submap is closed. */
static void a_fix_far_from_an_uncertain_base_closes(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j)
    for (int known = 0; known < 2; ++known) {
      ring course;
      cairn_match match;
      double c[9], covariance[36];
      ring_init(&course, 6);
      cairn_filter_options o = ring_options(&course, 500, joins[j]);
      for (int i = 21; i < 36; i += 7) o.initial_covariance[i] = known ? 1e-6 : 0.25;
      cairn_filter* f = ring_filter(&o);
      diagonal(c, 3, 1e-2);
      assert_ok(cairn_filter_update_position(f, course.truth.position, c, NULL, &match, NULL));
      assert_int_equal(submaps_of(f), 0); /* the vehicle has not moved */
      for (int step = 0; step < 10; ++step) ring_drive(&course, &f, 1, 1);
      assert_ok(cairn_filter_update_position(f, course.truth.position, c, NULL, &match, NULL));
      assert_int_equal(match.result, CAIRN_RESULT_MATCHED);
      assert_int_equal(submaps_of(f), known ? 0 : 1);
      if (!known) check_report(f, CAIRN_CLOSED_BY_FIX, joins[j]);
      /* It tells the heading at which the vehicle drove there. */
      assert_ok(cairn_filter_pose(f, NULL, covariance, NULL));
      assert_true(covariance[35] < 0.01);
      cairn_filter_destroy(f);
    }
}

/* out = a b a^T of 6x6 matrices. */
static void congruence(const double a[36], const double b[36], double out[36]) {
  double ab[36] = {0};
  memset(out, 0, 36 * sizeof *out);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) ab[6 * i + j] += a[6 * i + k] * b[6 * k + j];
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) out[6 * i + j] += ab[6 * i + k] * a[6 * j + k];
}

/* pose = base o local, and its error is e_p = e_pS - hat(R_S p_L) e_RS + R_S e_pL, e_R = e_RS + R_S e_RL
 * (docs/submaps.md). */
/* How many landmarks of the open submap the map knows. */
static size_t common_landmarks(const cairn_filter* f) {
  cairn_landmark local[RING_LANDMARKS], known;
  size_t n = 0, common = 0;
  assert_ok(cairn_map_landmarks(cairn_filter_local_map(f), local, RING_LANDMARKS, &n, NULL));
  for (size_t i = 0; i < n; ++i)
    common += cairn_map_landmark(cairn_filter_map(f), local[i].id, &known, NULL) == CAIRN_OK;
  return common;
}

/* Base and open submap compose the pose. Landmarks that both have in common correct it. */
static void poses_compose(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j)
    for (size_t e = 0; e < LENGTH(errors); ++e) {
      ring course;
      ring_init(&course, 7);
      cairn_filter_options o = ring_options(&course, 9, joins[j]);
      o.state_error = errors[e];
      cairn_filter* f = ring_filter(&o);
      unsigned together = 0;
      for (int step = 0; step < 2 * RING_STEPS; ++step) {
        cairn_pose pose, base, local, expected;
        double P[36], B[36], L[36], to_base[36] = {0}, to_local[36] = {0}, from_base[36], from_local[36];
        double R[9], arm[3], hat[9];
        ring_drive(&course, &f, 1, 1);
        assert_ok(cairn_filter_pose(f, &pose, P, NULL));
        assert_ok(cairn_filter_base_pose(f, &base, B, NULL));
        assert_ok(cairn_filter_local_pose(f, &local, L, NULL));
        assert_ok(cairn_pose_compose(&base, &local, &expected, NULL));
        const bool alone = common_landmarks(f) == 0;
        together += !alone;
        for (int i = 0; i < 3; ++i)
          assert_near(pose.position[i], expected.position[i], alone ? 1e-12 : 5 * sqrt(B[7 * i] + L[7 * i]) + 1e-12);
        for (int i = 0; alone && i < 4; ++i) assert_near(pose.quaternion[i], expected.quaternion[i], 1e-12);
        rotation_matrix(base.quaternion, R);
        for (int i = 0; i < 3; ++i) arm[i] = expected.position[i] - base.position[i];
        cross_matrix(arm, hat);
        for (int i = 0; i < 6; ++i) to_base[7 * i] = 1;
        for (int i = 0; i < 9; ++i) {
          to_base[6 * (i / 3) + 3 + i % 3] = -hat[i];
          to_local[6 * (i / 3) + i % 3] = to_local[6 * (i / 3 + 3) + 3 + i % 3] = R[i];
        }
        congruence(to_base, B, from_base);
        congruence(to_local, L, from_local);
        for (int i = 0; alone && i < 36; ++i)
          assert_near(P[i], from_base[i] + from_local[i], 1e-9 * sqrt(P[7 * (i / 6)] * P[7 * (i % 6)]) + 1e-18);
        for (int i = 0; !alone && i < 6; ++i)
          assert_true(P[7 * i] <= (from_base[7 * i] + from_local[7 * i]) * (1 + 1e-9));
      }
      assert_true(together > RING_STEPS && together < 2 * RING_STEPS);
      assert_true(submaps_of(f) > 6);
      cairn_filter_destroy(f);
    }
}

/* What the open submap has seen again corrects the pose before the closing as the closing does. */
static void the_pose_knows_what_was_seen_again(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j)
    for (size_t e = 0; e < LENGTH(errors); ++e) {
      ring course;
      ring_init(&course, 21);
      cairn_filter_options o = ring_options(&course, 60, joins[j]);
      o.state_error = errors[e];
      cairn_filter* f = ring_filter(&o);
      unsigned compared = 0;
      for (int step = 1; step <= 3 * RING_STEPS; ++step) {
        ring_drive(&course, &f, 1, 1);
        if (step % 12 != 0) continue;
        cairn_pose before, after;
        double P[36], Q[36], joint[81];
        size_t needed = 0;
        const bool together = common_landmarks(f) > 2;
        const uint64_t known = 1;
        cairn_landmark first;
        const bool ask = together && cairn_map_landmark(cairn_filter_map(f), known, &first, NULL) == CAIRN_OK;
        assert_ok(cairn_filter_pose(f, &before, P, NULL));
        if (ask) assert_ok(cairn_filter_joint_covariance(f, &known, 1, joint, LENGTH(joint), &needed, NULL));
        assert_ok(cairn_filter_close_submap(f, NULL));
        assert_ok(cairn_filter_pose(f, &after, Q, NULL));
        if (!together) continue;
        ++compared;
        /* A sparse map is also linearised again at its closings, as a whole after a loop. */
        const double same = joins[j] == CAIRN_JOIN_DENSE ? 0.1 : 0.6;
        for (int i = 0; i < 3; ++i) {
          assert_near(before.position[i], after.position[i], same * sqrt(Q[7 * i]));
          assert_near(before.quaternion[i + 1], after.quaternion[i + 1], same * sqrt(Q[7 * i + 21]));
        }
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c) assert_near(P[6 * r + c], Q[6 * r + c], 0.05 * sqrt(Q[7 * r] * Q[7 * c]));
        if (!ask) continue;
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c) assert_near(joint[9 * r + c], P[6 * r + c], 1e-9 * sqrt(P[7 * r] * P[7 * c]));
      }
      assert_true(compared >= 5);
      cairn_filter_destroy(f);
    }
}

static void the_list_of_submaps(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j) {
    ring course;
    ring_init(&course, 8);
    const cairn_pose start = course.truth;
    const cairn_filter_options o = ring_options(&course, 7, joins[j]);
    cairn_filter* f = ring_filter(&o);
    ring_drive(&course, &f, 1, RING_STEPS);
    const size_t count = submaps_of(f);
    uint64_t ids[64], canary[64];
    bool held[RING_LANDMARKS + 1] = {false};
    size_t needed = 0;
    for (size_t i = 0; i < count; ++i) {
      cairn_pose base;
      assert_ok(cairn_filter_submap(f, i, &base, NULL, 0, &needed, NULL));
      assert_true(needed >= 7 && needed <= LENGTH(ids));
      memset(ids, 0xa5, sizeof ids), memset(canary, 0xa5, sizeof canary);
      const size_t whole = needed;
      assert_status(cairn_filter_submap(f, i, NULL, ids, whole - 1, &needed, NULL), CAIRN_ERROR_BUFFER);
      assert_int_equal(needed, whole);
      assert_memory_equal(ids, canary, sizeof ids);
      assert_ok(cairn_filter_submap(f, i, NULL, ids, whole, &needed, NULL));
      assert_memory_equal(ids + whole, canary, (LENGTH(ids) - whole) * sizeof ids[0]);
      for (size_t a = 0; a < whole; ++a) {
        cairn_landmark l;
        assert_ok(cairn_map_landmark(cairn_filter_map(f), ids[a], &l, NULL));
        held[ids[a]] = true;
        for (size_t b = 0; b < a; ++b) assert_int_not_equal(ids[a], ids[b]);
      }
      if (i == 0)
        for (int k = 0; k < 3; ++k) assert_near(base.position[k], start.position[k], 0.5);
      if (i > 0) /* on the course */
        assert_near(sqrt(base.position[0] * base.position[0] + base.position[1] * base.position[1]), 10, 1.5);
    }
    size_t in_list = 0;
    for (size_t i = 0; i < LENGTH(held); ++i) in_list += held[i];
    assert_int_equal(in_list, landmarks_of(cairn_filter_map(f)));
    assert_status(cairn_filter_submap(f, count, NULL, NULL, 0, &needed, NULL), CAIRN_ERROR_NOT_FOUND);
    cairn_filter_destroy(f);
  }
}

/* The map holds only closed submaps. The landmarks of the open submap are found in the local map. */
static void maps_while_a_submap_is_open(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j) {
    ring course;
    ring_init(&course, 9);
    const cairn_filter_options o = ring_options(&course, 500, joins[j]);
    cairn_filter* f = ring_filter(&o);
    ring_drive(&course, &f, 1, 10);
    const size_t first = landmarks_of(cairn_filter_local_map(f));
    assert_true(first > 3);
    assert_int_equal(landmarks_of(cairn_filter_map(f)), 0);
    assert_ok(cairn_filter_close_submap(f, NULL));
    assert_int_equal(landmarks_of(cairn_filter_map(f)), first);
    assert_int_equal(landmarks_of(cairn_filter_local_map(f)), 0);
    ring_drive(&course, &f, 1, 25);
    assert_int_equal(landmarks_of(cairn_filter_map(f)), first);
    cairn_landmark l[RING_LANDMARKS];
    cairn_pose base;
    size_t n = 0, fresh = 0, needed = 0;
    double joint[81];
    assert_ok(cairn_map_landmarks(cairn_filter_local_map(f), l, LENGTH(l), &n, NULL));
    assert_ok(cairn_filter_base_pose(f, &base, NULL, NULL));
    for (size_t i = 0; i < n; ++i) {
      double there[3], truth[3];
      cairn_landmark known;
      assert_ok(cairn_pose_apply(&base, l[i].position, there, NULL));
      ring_landmark((unsigned)l[i].id - 1, truth);
      for (int k = 0; k < 3; ++k) assert_near(there[k], truth[k], 0.8);
      if (cairn_map_landmark(cairn_filter_map(f), l[i].id, &known, NULL) == CAIRN_OK) continue;
      ++fresh; /* not yet in the map, so the map does not know it */
      assert_status(cairn_filter_joint_covariance(f, &l[i].id, 1, joint, LENGTH(joint), &needed, NULL),
                    CAIRN_ERROR_NOT_FOUND);
    }
    assert_true(fresh > 3);
    /* Removed from both. */
    assert_ok(cairn_filter_remove_landmark(f, l[0].id, NULL));
    assert_int_equal(landmarks_of(cairn_filter_local_map(f)), n - 1);
    assert_status(cairn_map_landmark(cairn_filter_local_map(f), l[0].id, &l[1], NULL), CAIRN_ERROR_NOT_FOUND);
    assert_status(cairn_map_landmark(cairn_filter_map(f), l[0].id, &l[1], NULL), CAIRN_ERROR_NOT_FOUND);
    assert_ok(cairn_filter_close_submap(f, NULL));
    assert_status(cairn_map_landmark(cairn_filter_map(f), l[0].id, &l[1], NULL), CAIRN_ERROR_NOT_FOUND);
    cairn_filter_destroy(f);
  }
}

static void a_single_map_has_no_submaps(void** state) {
  ring course;
  cairn_pose pose, local, base;
  double P[36], L[36], B[36];
  size_t needed = 0;
  cairn_closing_report none;
  (void)state;
  ring_init(&course, 10);
  const cairn_filter_options o = ring_options(&course, 0, CAIRN_JOIN_AUTO);
  cairn_filter* f = ring_filter(&o);
  ring_drive(&course, &f, 1, 20);
  assert_int_equal(submaps_of(f), 0);
  assert_ok(cairn_filter_pose(f, &pose, P, NULL));
  assert_ok(cairn_filter_local_pose(f, &local, L, NULL));
  assert_ok(cairn_filter_base_pose(f, &base, B, NULL));
  assert_memory_equal(&pose, &local, sizeof pose);
  assert_memory_equal(P, L, sizeof P);
  const cairn_pose identity = {{0, 0, 0}, {1, 0, 0, 0}};
  assert_memory_equal(&base, &identity, sizeof base);
  for (int i = 0; i < 36; ++i) assert_true(B[i] == 0);
  assert_int_equal(landmarks_of(cairn_filter_map(f)), landmarks_of(cairn_filter_local_map(f)));
  assert_status(cairn_filter_submap(f, 0, NULL, NULL, 0, &needed, NULL), CAIRN_ERROR_NOT_FOUND);
  const cairn_closing_report r = last_closing(f);
  memset(&none, 0, sizeof none);
  none.struct_size = r.struct_size;
  assert_memory_equal(&r, &none, sizeof r);
  cairn_filter_destroy(f);
}

/* Structs of other versions: options from before submaps select no submaps, and no byte beyond the stated size is
 * changed. */
static void structs_of_older_versions(void** state) {
  ring course;
  union {
    cairn_filter_options options;
    cairn_closing_report report;
    unsigned char bytes[sizeof(cairn_filter_options) + 64];
  } u;
  (void)state;
  ring_init(&course, 11);
  const size_t old = offsetof(cairn_filter_options, submap_landmarks);
  memset(&u, 0xa5, sizeof u);
  assert_ok(cairn_filter_options_init(&u.options, old, NULL));
  for (size_t i = old; i < sizeof u; ++i) assert_int_equal(u.bytes[i], 0xa5);
  u.options.max_landmarks = RING_LANDMARKS;
  cairn_filter* f = ring_filter(&u.options); /* with 0xa5a5a5a5 in the place of submap_landmarks */
  ring_drive(&course, &f, 1, 3);
  assert_status(cairn_filter_close_submap(f, NULL), CAIRN_ERROR_STATE);
  cairn_filter_destroy(f);

  const cairn_filter_options o = ring_options(&course, 7, CAIRN_JOIN_AUTO);
  f = ring_filter(&o);
  ring_drive(&course, &f, 1, 20);
  const cairn_closing_report whole = last_closing(f);
  assert_true(whole.submaps > 0);
  const size_t sizes[] = {offsetof(cairn_closing_report, submaps), offsetof(cairn_closing_report, distance),
                          offsetof(cairn_closing_report, moved_rms)};
  for (size_t k = 0; k < LENGTH(sizes); ++k) {
    memset(&u, 0xa5, sizeof u);
    u.report.struct_size = (uint32_t)sizes[k];
    assert_ok(cairn_filter_last_closing(f, &u.report, NULL));
    assert_memory_equal(u.bytes + sizeof(uint32_t), (const unsigned char*)&whole + sizeof(uint32_t),
                        sizes[k] - sizeof(uint32_t));
    for (size_t i = sizes[k]; i < sizeof u; ++i) assert_int_equal(u.bytes[i], 0xa5);
  }
  cairn_filter_destroy(f);
}

/* The block of the pose is the covariance of the pose, the block of the landmarks that of the map, and no correlation
 * between them exceeds one. */
static void pose_and_map_jointly(void** state) {
  (void)state;
  for (int32_t join = CAIRN_JOIN_DENSE; join <= CAIRN_JOIN_SPARSE; ++join) {
    ring course;
    ring_init(&course, 12);
    const cairn_filter_options o = ring_options(&course, 7, join);
    cairn_filter* f = ring_filter(&o);
    ring_drive(&course, &f, 1, 23);
    cairn_landmark some[3];
    size_t needed = 0;
    const cairn_map* map = cairn_filter_map(f);
    cairn_pose pose;
    double P[36], joint[225], of_map[81];
    assert_ok(cairn_filter_pose(f, &pose, P, NULL));
    assert_ok(cairn_map_nearest(map, pose.position, 3, some, 3, &needed, NULL));
    const uint64_t ids[3] = {some[0].id, some[1].id, some[2].id};
    assert_ok(cairn_filter_joint_covariance(f, ids, 3, joint, LENGTH(joint), &needed, NULL));
    assert_ok(cairn_map_joint_covariance(map, ids, 3, of_map, LENGTH(of_map), &needed, NULL));
    for (int r = 0; r < 15; ++r)
      for (int c = 0; c < 15; ++c) {
        const double scale = sqrt(joint[16 * r] * joint[16 * c]);
        assert_true(joint[15 * r + c] == joint[15 * c + r]);
        assert_true(fabs(joint[15 * r + c]) <= scale * (1 + 1e-9));
        if (r < 6 && c < 6) assert_true(fabs(joint[15 * r + c] - P[6 * r + c]) <= 1e-9 * scale);
        if (r >= 6 && c >= 6) assert_true(fabs(joint[15 * r + c] - of_map[9 * (r - 6) + c - 6]) <= 1e-9 * scale);
      }
    cairn_filter_destroy(f);
  }
}

static void auto_picks_by_capacity(void** state) {
  (void)state;
  for (int large = 0; large < 2; ++large) {
    ring course;
    size_t bytes[3];
    cairn_filter* f[3];
    snapshot s[3] = {{0, NULL}, {0, NULL}, {0, NULL}};
    ring_init(&course, 12);
    for (int32_t join = CAIRN_JOIN_AUTO; join <= CAIRN_JOIN_SPARSE; ++join) {
      cairn_filter_options o = ring_options(&course, 7, join);
      o.max_landmarks = large ? 101 : 100;
      assert_ok(cairn_filter_required_bytes(&o, &bytes[join], NULL));
      f[join] = ring_filter(&o);
    }
    ring_drive(&course, f, 3, 40);
    for (int i = 0; i < 3; ++i) submaps_take(&s[i], f[i]);
    const int same = large ? CAIRN_JOIN_SPARSE : CAIRN_JOIN_DENSE, other = large ? CAIRN_JOIN_DENSE : CAIRN_JOIN_SPARSE;
    assert_int_equal(bytes[CAIRN_JOIN_AUTO], bytes[same]);
    assert_true(bytes[CAIRN_JOIN_DENSE] > bytes[CAIRN_JOIN_SPARSE]);
    assert_true(snapshot_same(&s[CAIRN_JOIN_AUTO], &s[same]));
    assert_false(snapshot_same(&s[CAIRN_JOIN_AUTO], &s[other]));
    for (int i = 0; i < 3; ++i) cairn_filter_destroy(f[i]), snapshot_free(&s[i]);
  }
}

/* The same inputs give the same bits, with any queries in between. */
static void the_same_bits_twice(void** state) {
  (void)state;
  for (size_t j = 0; j < LENGTH(joins); ++j)
    for (size_t e = 0; e < LENGTH(errors); ++e) {
      ring course;
      snapshot a = {0, NULL}, b = {0, NULL};
      ring_init(&course, 13);
      cairn_filter_options o = ring_options(&course, 8, joins[j]);
      o.state_error = errors[e];
      cairn_filter* f[] = {ring_filter(&o), ring_filter(&o)};
      for (unsigned step = 0; step < 2 * RING_STEPS; ++step) {
        cairn_landmark l;
        ring_drive(&course, f, 2, 1);
        (void)cairn_map_landmark(cairn_filter_map(f[0]), 1 + step % RING_LANDMARKS, &l,
                                 NULL); /* one filter is queried, the other is not */
        if (step % 10 != 9) continue;
        submaps_take(&a, f[0]);
        submaps_take(&b, f[1]);
        assert_true(snapshot_same(&a, &b));
      }
      cairn_filter_destroy(f[0]), cairn_filter_destroy(f[1]);
      snapshot_free(&a), snapshot_free(&b);
    }
}

/* Submaps give the same result as a single map, up to different linearisation points. */
static void submaps_and_a_single_map_agree(void** state) {
  (void)state;
  for (size_t e = 0; e < LENGTH(errors); ++e) {
    ring course;
    cairn_filter* f[3];
    ring_init(&course, 14);
    for (int i = 0; i < 3; ++i) {
      cairn_filter_options o = ring_options(&course, i == 0 ? 0 : 8, i == 1 ? CAIRN_JOIN_DENSE : CAIRN_JOIN_SPARSE);
      o.state_error = errors[e];
      f[i] = ring_filter(&o);
    }
    ring_drive(&course, f, 3, 3 * RING_STEPS);
    cairn_landmark l[3][RING_LANDMARKS];
    for (int i = 0; i < 3; ++i) {
      size_t n = 0;
      double nees = 0;
      if (i > 0) (void)cairn_filter_close_submap(f[i], NULL);
      assert_ok(cairn_map_landmarks(cairn_filter_map(f[i]), l[i], RING_LANDMARKS, &n, NULL));
      assert_int_equal(n, RING_LANDMARKS);
      assert_ok(cairn_filter_pose_nees(f[i], &course.truth, &nees, NULL));
      assert_true(nees > 0 && nees < 25);
    }
    for (int i = 1; i < 3; ++i)
      for (int k = 0; k < RING_LANDMARKS; ++k)
        for (int d = 0; d < 3; ++d) {
          const double sigma = sqrt(l[0][k].covariance[4 * d]);
          assert_near(l[i][k].position[d], l[0][k].position[d], sigma);
          assert_near(sqrt(l[i][k].covariance[4 * d]), sigma, 0.1 * sigma);
        }
    for (int i = 0; i < 3; ++i) cairn_filter_destroy(f[i]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_reason_closes),
      cmocka_unit_test(the_first_fix_closes),
      cmocka_unit_test(a_fix_far_from_an_uncertain_base_closes),
      cmocka_unit_test(poses_compose),
      cmocka_unit_test(the_pose_knows_what_was_seen_again),
      cmocka_unit_test(the_list_of_submaps),
      cmocka_unit_test(maps_while_a_submap_is_open),
      cmocka_unit_test(a_single_map_has_no_submaps),
      cmocka_unit_test(structs_of_older_versions),
      cmocka_unit_test(pose_and_map_jointly),
      cmocka_unit_test(auto_picks_by_capacity),
      cmocka_unit_test(the_same_bits_twice),
      cmocka_unit_test(submaps_and_a_single_map_agree),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
