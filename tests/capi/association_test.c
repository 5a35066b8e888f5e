/* SPDX-License-Identifier: BSD-3-Clause */
/* Observations without ids: which landmark each one is matched with, and when it is refused instead. */
#include "submaps.h"

static cairn_filter_options unnamed(int32_t association) {
  cairn_filter_options options = test_options();
  options.association = association;
  return options;
}

static cairn_observation at(double x, double y, double z) {
  cairn_observation o;
  memset(&o, 0, sizeof o);
  o.id = CAIRN_ID_NONE;
  o.z[0] = x, o.z[1] = y, o.z[2] = z;
  return o;
}

/* A rig that stands at the origin with a known pose and has seen `count` points. Then its x position becomes uncertain
 * by `sigma`. */
static void open_pushed(rig* r, cairn_filter_options options, const cairn_observation* points, size_t count,
                        double sigma) {
  const cairn_pose stay = {{0, 0, 0}, {1, 0, 0, 0}};
  double covariance[36];
  options.initial_pose = stay;
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  options.gate_probability = 0.99;
  rig_open(r, &options);
  assert_ok(cairn_filter_update(r->filter, r->sensors[CARTESIAN], points, count, NULL, NULL));
  diagonal(covariance, 6, 1e-8);
  covariance[0] = sigma * sigma;
  assert_ok(cairn_filter_predict_increment(r->filter, &stay, covariance, NULL));
}

static void without_ids_a_filter_decides_as_with_ids(void** state) {
  const int32_t ways[] = {CAIRN_ASSOCIATION_NEAREST, CAIRN_ASSOCIATION_JOINT};
  (void)state;
  for (size_t k = 0; k < LENGTH(ways); ++k) {
    const cairn_filter_options named = test_options(), options = unnamed(ways[k]);
    rig known, unknown;
    world w;
    uint64_t name_of[WORLD_LANDMARKS] = {0};
    size_t matched = 0;
    rig_open(&known, &named);
    rig_open(&unknown, &options);
    world_init(&w, 77);
    w.noise = 0.2;
    for (int step = 0; step < 80; ++step) {
      frame f;
      cairn_match known_matches[WORLD_LANDMARKS], found_matches[WORLD_LANDMARKS];
      world_frame(&w, &f);
      f.sensor = CARTESIAN;
      f.count = 0;
      for (unsigned i = 0; i < WORLD_LANDMARKS; ++i) {
        cairn_observation o = at(0, 0, 0);
        if (!world_see(&w, CARTESIAN, 0, 0, w.landmarks[i], o.z)) continue;
        for (int n = 0; n < 3; ++n) o.z[n] += random_normal(&w.random, 0.02);
        o.id = i + 1;
        f.observations[f.count++] = o;
      }
      assert_ok(rig_take(&known, &f, known_matches));
      for (size_t i = 0; i < f.count; ++i) f.observations[i].id = step % 2 == 0 ? CAIRN_ID_NONE : 5;
      assert_ok(rig_take(&unknown, &f, found_matches));
      matched += check_same_matches(known_matches, found_matches, f.count, name_of);
    }
    assert_true(matched > 300);
    check_same_pose(known.filter, unknown.filter);
    rig_close(&known);
    rig_close(&unknown);
  }
}

static void pairs_that_contradict_each_other_are_not_accepted_together(void** state) {
  const cairn_observation points[] = {{0, {10, -50, 0}, {0}}, {0, {10, 50, 0}, {0}}};
  const cairn_observation looked[] = {{0, {12.5, -50, 0}, {0}}, {0, {7.5, 50, 0}, {0}}};
  cairn_match m[2];
  rig r;
  (void)state;
  open_pushed(&r, unnamed(CAIRN_ASSOCIATION_JOINT), points, 2, 1.0);
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], looked, 2, m, NULL));
  check_one_of_two_matches(m);
  const cairn_update_report report = last_update(r.filter);
  assert_true(report.association_nodes >= 2 && report.association_exhausted == 0);
  assert_true(report.association_seconds > 0);
  rig_close(&r);
  /* Nearest neighbour matches both. The batch gate finds that they contradict each other. */
  open_pushed(&r, unnamed(CAIRN_ASSOCIATION_NEAREST), points, 2, 1.0);
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], looked, 2, m, NULL));
  assert_true((m[0].reason == CAIRN_REASON_BATCH_GATE) != (m[1].reason == CAIRN_REASON_BATCH_GATE));
  assert_int_equal(last_update(r.filter).association_nodes, 0);
  rig_close(&r);
}

static void an_ambiguous_observation_needs_the_support_of_others(void** state) {
  const cairn_observation points[] = {{0, {10, 0, 0}, {0}}, {0, {12, 0.5, 0}, {0}}, {0, {13, -0.5, 0}, {0}}};
  cairn_observation looked[3];
  cairn_match m[3];
  rig r;
  (void)state;
  for (size_t count = 1; count <= 3; ++count) {
    open_pushed(&r, unnamed(CAIRN_ASSOCIATION_JOINT), points, 3, 1.0);
    for (size_t i = 0; i < count; ++i) {
      looked[i] = points[i];
      looked[i].z[0] += 0.8;
    }
    assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], looked, count, m, NULL));
    for (size_t i = 0; i < count; ++i) {
      assert_int_equal(m[i].result, count == 3 ? CAIRN_RESULT_MATCHED : CAIRN_RESULT_REJECTED);
      assert_int_equal(m[i].reason, count == 3 ? CAIRN_REASON_NONE : CAIRN_REASON_AMBIGUOUS);
      if (count == 3) assert_int_equal(m[i].landmark, i);
    }
    rig_close(&r);
  }
}

static void a_new_landmark_keeps_its_distance_from_known_ones(void** state) {
  const cairn_observation point = at(10, 0, 0);
  /* Both sightings have noise 0.1, so the squared distance is d^2 / 0.02. The bounds of 0.99 and 0.9999 are 11.34 and
   * 21.11. */
  const struct {
    double offset;
    int32_t result, reason;
  } looks[] = {{0.4, CAIRN_RESULT_MATCHED, CAIRN_REASON_NONE},
               {0.6, CAIRN_RESULT_REJECTED, CAIRN_REASON_GATE},
               {0.7, CAIRN_RESULT_NEW, CAIRN_REASON_NONE}};
  (void)state;
  for (size_t k = 0; k < LENGTH(looks); ++k) {
    cairn_observation o = point;
    cairn_match m;
    rig r;
    o.z[1] += looks[k].offset;
    for (int i = 0; i < 3; ++i) o.covariance[4 * i] = 0.01;
    cairn_observation first = point;
    memcpy(first.covariance, o.covariance, sizeof first.covariance);
    open_pushed(&r, unnamed(CAIRN_ASSOCIATION_JOINT), &first, 1, 1e-4);
    assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], &o, 1, &m, NULL));
    assert_int_equal(m.result, looks[k].result);
    assert_int_equal(m.reason, looks[k].reason);
    assert_int_equal(m.landmark, m.result == CAIRN_RESULT_NEW ? 1 : 0);
    rig_close(&r);
  }
}

/* Two observations of one frame belong to two landmarks. An observation that noise clearly separates from a matched one
 * is new, although it is too near the mapped landmark to be new otherwise. */
static void one_landmark_is_seen_once_a_frame(void** state) {
  const cairn_observation point = at(10, 0, 0);
  /* Noise 0.1 on one axis. The second observation has squared distance d^2 / 0.02 to the landmark (bounds 11.34 and
   * 21.11), and d^2 / 0.02 to the first observation. */
  const struct {
    double offset;
    int32_t result, reason;
  } looks[] = {{0.3, CAIRN_RESULT_REJECTED, CAIRN_REASON_AMBIGUOUS}, {0.5, CAIRN_RESULT_NEW, CAIRN_REASON_NONE}};
  (void)state;
  for (size_t k = 0; k < LENGTH(looks); ++k) {
    cairn_observation first = point, both[2];
    cairn_match m[2];
    rig r;
    for (int i = 0; i < 3; ++i) first.covariance[4 * i] = 0.01;
    both[0] = both[1] = first;
    both[1].z[1] += looks[k].offset;
    open_pushed(&r, unnamed(CAIRN_ASSOCIATION_JOINT), &first, 1, 1e-4);
    assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], both, 2, m, NULL));
    assert_int_equal(m[0].result, CAIRN_RESULT_MATCHED);
    assert_int_equal(m[0].landmark, 0);
    assert_int_equal(m[1].result, looks[k].result);
    assert_int_equal(m[1].reason, looks[k].reason);
    if (looks[k].result == CAIRN_RESULT_NEW) { /* each observation is matched with its own landmark */
      assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], both, 2, m, NULL));
      for (size_t i = 0; i < 2; ++i) {
        assert_int_equal(m[i].result, CAIRN_RESULT_MATCHED);
        assert_int_equal(m[i].landmark, i);
      }
    }
    rig_close(&r);
  }
  /* Each of two observations passes by itself, and the batch gate refuses one of them. No landmark is placed next
   * to the refused one. */
  const cairn_observation two[] = {at(10, -50, 0), at(10, 50, 0)};
  cairn_observation known[2], four[] = {at(10.72, -50, 0), at(11.25, -50, 0), at(9.28, 50, 0), at(8.75, 50, 0)};
  cairn_match of_four[4];
  rig refusing;
  memcpy(known, two, sizeof known);
  for (int i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 2; ++k) known[k].covariance[4 * i] = 0.01;
    for (size_t k = 0; k < 4; ++k) four[k].covariance[4 * i] = 0.01;
  }
  open_pushed(&refusing, unnamed(CAIRN_ASSOCIATION_NEAREST), known, 2, 0.25);
  assert_ok(cairn_filter_update(refusing.filter, refusing.sensors[CARTESIAN], four, 4, of_four, NULL));
  const size_t refused = of_four[0].result == CAIRN_RESULT_REJECTED ? 0 : 2, taken = 2 - refused;
  assert_int_equal(of_four[refused].reason, CAIRN_REASON_BATCH_GATE);
  assert_int_equal(of_four[refused + 1].reason, CAIRN_REASON_GATE);
  assert_int_equal(of_four[refused + 1].landmark, refused / 2);
  assert_int_equal(of_four[taken].result, CAIRN_RESULT_MATCHED);
  assert_int_equal(of_four[taken + 1].result, CAIRN_RESULT_NEW);
  assert_int_equal(of_four[taken + 1].landmark, 2);
  rig_close(&refusing);
  /* No landmark is placed next to an observation that is itself doubtful. */
  const cairn_observation apart[] = {at(10, 0, 0), at(12, 0, 0)};
  cairn_match m[2];
  rig r;
  open_pushed(&r, unnamed(CAIRN_ASSOCIATION_JOINT), &point, 1, 1.0);
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], apart, 2, m, NULL));
  for (size_t i = 0; i < 2; ++i) assert_int_equal(m[i].reason, CAIRN_REASON_AMBIGUOUS);
  rig_close(&r);
}

/* Sightings with persistent errors: an update gives them less weight, association and placing do not. */
static void persistent_errors_count_in_updates_only(void** state) {
  cairn_observation point = at(10, 0, 0);
  cairn_filter_options lasting = test_options(), plain = test_options();
  rig a, b;
  (void)state;
  point.id = 3;
  lasting.error_persistence = 4;
  open_pushed(&a, lasting, &point, 1, 0.5);
  open_pushed(&b, plain, &point, 1, 0.5);
  cairn_observation again = at(10.1, 0.05, 0), weaker;
  again.id = point.id;
  for (int i = 0; i < 3; ++i) again.covariance[4 * i] = 0.01;
  weaker = again;
  for (int i = 0; i < 3; ++i) weaker.covariance[4 * i] *= 4;
  assert_ok(cairn_filter_update(a.filter, a.sensors[CARTESIAN], &again, 1, NULL, NULL));
  assert_ok(cairn_filter_update(b.filter, b.sensors[CARTESIAN], &weaker, 1, NULL, NULL));
  snapshot of_a = {0, NULL}, of_b = {0, NULL};
  snapshot_take(&of_a, a.filter);
  snapshot_take(&of_b, b.filter);
  assert_true(snapshot_same(&of_a, &of_b));
  snapshot_free(&of_a);
  snapshot_free(&of_b);
  rig_close(&a);
  rig_close(&b);

  /* 0.6 m off at noise 0.1 for both sightings: beyond the gate of 0.99 with any persistence. */
  cairn_observation first = point, off;
  cairn_match m;
  for (int i = 0; i < 3; ++i) first.covariance[4 * i] = 0.01;
  off = first;
  off.z[1] += 0.6;
  lasting = unnamed(CAIRN_ASSOCIATION_JOINT);
  lasting.error_persistence = 100;
  open_pushed(&a, lasting, &first, 1, 1e-4);
  assert_ok(cairn_filter_update(a.filter, a.sensors[CARTESIAN], &off, 1, &m, NULL));
  assert_int_equal(m.result, CAIRN_RESULT_REJECTED);
  assert_int_equal(m.reason, CAIRN_REASON_GATE);
  rig_close(&a);
}

static void the_limit_of_joint_tests_is_kept_and_reported(void** state) {
  cairn_filter_options options = unnamed(CAIRN_ASSOCIATION_JOINT);
  cairn_observation points[WORLD_LANDMARKS];
  cairn_match m[WORLD_LANDMARKS];
  rig r;
  (void)state;
  options.association_nodes = 1;
  for (int i = 0; i < WORLD_LANDMARKS; ++i) points[i] = at(10 + 0.9 * (i % 4), 0.9 * (i / 4), 0.1 * i);
  open_pushed(&r, options, points, WORLD_LANDMARKS, 2.0);
  for (int i = 0; i < WORLD_LANDMARKS; ++i)
    points[i].z[0] += i % 3 == 0 ? 1.3 : i % 3 == 1 ? 0.4 : -0.7; /* offsets that no shift along x explains */
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], points, WORLD_LANDMARKS, m, NULL));
  const cairn_update_report report = last_update(r.filter);
  assert_int_equal(report.association_exhausted, 1);
  assert_true(report.association_nodes >= 1 && report.association_nodes <= 8 * WORLD_LANDMARKS);
  assert_int_equal(report.matched + report.placed + report.rejected, WORLD_LANDMARKS);
  rig_close(&r);
}

/* Drives over the same ground twice in submaps. The closings of the second pass must find the landmarks of the map. */
static void closings_find_the_landmarks_of_the_map(void** state) {
  const int32_t joins[] = {CAIRN_JOIN_DENSE, CAIRN_JOIN_SPARSE};
  (void)state;
  for (size_t k = 0; k < LENGTH(joins); ++k) {
    cairn_filter_options options = unnamed(CAIRN_ASSOCIATION_JOINT);
    cairn_pose back = pose_at(-20, 0, 0, 0, 0, 0), step = pose_at(2, 0, 0, 0, 0, 0);
    uint32_t fused = 0, closings = 0;
    double covariance[36];
    size_t size;
    rig r;
    options.submap_landmarks = 5;
    options.max_landmarks = 60;
    options.join = joins[k];
    options.initial_pose = pose_at(0, 0, 0, 0, 0, 0);
    rig_open(&r, &options);
    diagonal(covariance, 6, 1e-8);
    for (int i = 0; i < 22; ++i) {
      cairn_observation o[WORLD_LANDMARKS];
      size_t count = 0;
      const int at_step = i % 11;
      if (i > 0) assert_ok(cairn_filter_predict_increment(r.filter, at_step == 0 ? &back : &step, covariance, NULL));
      for (int l = 0; l < 12; ++l) {
        const double x = 2.5 * l - 2.0 * at_step;
        if (x > 1 && x < 9) o[count++] = at(x, l % 2 == 0 ? 3 : -3, 0.2 * l);
      }
      assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], o, count, NULL, NULL));
      const cairn_closing_report report = last_closing(r.filter);
      assert_int_equal(report.status, CAIRN_OK);
      if (report.submaps == closings) continue;
      closings = report.submaps;
      assert_int_equal(
          report.landmarks_new + report.landmarks_fused + report.landmarks_refused + report.landmarks_ambiguous,
          report.landmarks);
      assert_int_equal(report.landmarks_ambiguous, 0);
      assert_int_equal(report.association_exhausted, 0);
      fused += report.landmarks_fused;
    }
    assert_ok(cairn_map_size(cairn_filter_local_map(r.filter), &size, NULL));
    if (size > 0) assert_ok(cairn_filter_close_submap(r.filter, NULL));
    assert_true(closings >= 4 && fused >= 8);
    assert_ok(cairn_map_size(cairn_filter_map(r.filter), &size, NULL));
    assert_int_equal(size, 11); /* the landmarks that were in sight, each once */
    rig_close(&r);
  }
}

static void a_frame_that_does_not_fit_places_what_fits(void** state) {
  cairn_filter_options options = unnamed(CAIRN_ASSOCIATION_JOINT);
  snapshot before = {0, NULL}, after = {0, NULL};
  cairn_observation o[3];
  cairn_match m[3];
  rig r;
  (void)state;
  options.max_landmarks = 2;
  rig_open(&r, &options);
  for (int i = 0; i < 3; ++i) o[i] = at(8 + 3 * i, 2, 1);
  snapshot_take(&before, r.filter);
  const double kept = o[1].z[2];
  o[1].z[2] = NAN;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "observations[1].z",
                 cairn_filter_update(r.filter, r.sensors[CARTESIAN], o, 2, NULL, NULL));
  snapshot_take(&after, r.filter);
  assert_true(snapshot_same(&before, &after));
  o[1].z[2] = kept;
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], o, 3, m, NULL));
  for (int i = 0; i < 2; ++i) assert_int_equal(m[i].landmark, i); /* the failed call used no number */
  assert_int_equal(m[2].reason, CAIRN_REASON_NO_ROOM);
  assert_true(m[2].landmark == CAIRN_ID_NONE);
  snapshot_free(&before);
  snapshot_free(&after);
  rig_close(&r);
}

static void options_out_of_range_are_refused(void** state) {
  cairn_filter* filter = NULL;
  (void)state;
  const int32_t ways[] = {-1, 3, 77};
  for (size_t i = 0; i < LENGTH(ways); ++i) {
    const cairn_filter_options options = unnamed(ways[i]);
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options.association", cairn_filter_create(&options, &filter, NULL));
  }
  const uint32_t nodes[] = {0, 1000001, UINT32_MAX};
  for (size_t i = 0; i < LENGTH(nodes); ++i) {
    cairn_filter_options options = test_options();
    options.association_nodes = nodes[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options.association_nodes",
                   cairn_filter_create(&options, &filter, NULL));
  }
  const double probabilities[] = {0, 1, -0.1, 1.5, NAN, INFINITY};
  for (size_t i = 0; i < LENGTH(probabilities); ++i) {
    cairn_filter_options options = test_options();
    options.new_probability = probabilities[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options.new_probability", cairn_filter_create(&options, &filter, NULL));
  }
  const double persistences[] = {0, 0.5, -1, 1.1e6, NAN, INFINITY};
  for (size_t i = 0; i < LENGTH(persistences); ++i) {
    cairn_filter_options options = test_options();
    options.error_persistence = persistences[i];
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options.error_persistence",
                   cairn_filter_create(&options, &filter, NULL));
  }
  assert_null(filter);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_ids_a_filter_decides_as_with_ids),
      cmocka_unit_test(pairs_that_contradict_each_other_are_not_accepted_together),
      cmocka_unit_test(an_ambiguous_observation_needs_the_support_of_others),
      cmocka_unit_test(a_new_landmark_keeps_its_distance_from_known_ones),
      cmocka_unit_test(one_landmark_is_seen_once_a_frame),
      cmocka_unit_test(persistent_errors_count_in_updates_only),
      cmocka_unit_test(the_limit_of_joint_tests_is_kept_and_reported),
      cmocka_unit_test(closings_find_the_landmarks_of_the_map),
      cmocka_unit_test(a_frame_that_does_not_fit_places_what_fits),
      cmocka_unit_test(options_out_of_range_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
