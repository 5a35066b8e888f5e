/* SPDX-License-Identifier: BSD-3-Clause */
/* The life of a landmark: when it counts, when it is removed, and when two landmarks are merged. The vehicle is planar
 * and has a cartesian sensor, so that expected values can be computed by hand. */
#include "support.h"

typedef struct scene {
  cairn_filter* filter;
  int32_t sensor;
} scene;

static scene open_scene(void (*change)(cairn_filter_options*)) {
  scene s = {NULL, -1};
  cairn_filter_options options;
  assert_ok(cairn_filter_options_init(&options, sizeof options, NULL));
  options.vehicle = CAIRN_VEHICLE_PLANAR;
  options.max_landmarks = options.max_observations = 8;
  if (change != NULL) change(&options);
  assert_ok(cairn_filter_create(&options, &s.filter, NULL));
  cairn_cartesian point;
  assert_ok(cairn_cartesian_init(&point, sizeof point, NULL));
  assert_ok(cairn_filter_add_cartesian(s.filter, &point, &s.sensor, NULL));
  return s;
}

static void look(scene* s, const uint64_t* ids, const double (*points)[2], size_t count, cairn_match* matches) {
  cairn_observation o[8];
  memset(o, 0, sizeof o);
  for (size_t i = 0; i < count; ++i) {
    o[i].id = ids[i];
    o[i].z[0] = points[i][0], o[i].z[1] = points[i][1];
  }
  assert_ok(cairn_filter_update(s->filter, s->sensor, o, count, matches, NULL));
}

static size_t map_size(const scene* s) {
  size_t size = 0;
  assert_ok(cairn_map_size(cairn_filter_map(s->filter), &size, NULL));
  return size;
}

static cairn_landmark landmark(const scene* s, uint64_t id) {
  cairn_landmark out;
  assert_ok(cairn_map_landmark(cairn_filter_map(s->filter), id, &out, NULL));
  return out;
}

static const uint64_t names[4] = {11, 12, 13, 14};
static const double places[4][2] = {{2, 0}, {0, 3}, {-2, 1}, {4, 4}};

static void defer_three(cairn_filter_options* options) {
  options->deferred_sightings = 3;
  options->deferred_frames = 4;
}

static void a_deferred_landmark_counts_after_enough_sightings(void** state) {
  (void)state;
  scene s = open_scene(defer_three), plain = open_scene(NULL);
  cairn_match matches[4];
  look(&s, names, places, 2, matches);
  assert_int_equal(matches[0].result, CAIRN_RESULT_NEW);
  assert_int_equal(map_size(&s), 0);
  assert_int_equal(last_update(s.filter).deferred, 2);
  look(&s, names, places, 2, matches);
  assert_int_equal(matches[0].result, CAIRN_RESULT_MATCHED);
  assert_int_equal(map_size(&s), 0);
  look(&s, names, places, 1, matches); /* only the first landmark: it counts now */
  assert_int_equal(map_size(&s), 1);
  assert_int_equal(last_update(s.filter).deferred, 1);
  look(&s, names + 2, places + 2, 2, matches); /* two more, deferred, listed behind those that count */
  look(&s, names + 1, places + 1, 1, matches);
  assert_int_equal(map_size(&s), 2);
  for (int i = 0; i < 2; ++i) assert_near(landmark(&s, names[i]).position[1], places[i][1], 1e-9);
  cairn_landmark missing;
  assert_status(cairn_map_landmark(cairn_filter_map(s.filter), names[2], &missing, NULL), CAIRN_ERROR_NOT_FOUND);
  /* The estimate uses all their observations: deferral changes which landmarks are listed, not the estimate. */
  look(&plain, names, places, 2, NULL);
  look(&plain, names, places, 2, NULL);
  look(&plain, names, places, 1, NULL);
  look(&plain, names + 2, places + 2, 2, NULL);
  look(&plain, names + 1, places + 1, 1, NULL);
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 9; ++k)
      assert_near(landmark(&s, names[i]).covariance[k], landmark(&plain, names[i]).covariance[k], 1e-15);
  /* A landmark that counts is removed, and the other landmarks keep their ids. */
  assert_ok(cairn_filter_remove_landmark(s.filter, names[0], NULL));
  assert_int_equal(map_size(&s), 1);
  assert_near(landmark(&s, names[1]).position[1], places[1][1], 1e-9);
  look(&s, names + 2, places + 2, 2, matches);
  look(&s, names + 2, places + 2, 2, matches);
  assert_int_equal(map_size(&s), 3);
  for (int i = 1; i < 4; ++i) assert_near(landmark(&s, names[i]).position[0], places[i][0], 1e-9);
  cairn_filter_destroy(s.filter);
  cairn_filter_destroy(plain.filter);
}

static void a_deferred_landmark_that_is_not_seen_again_is_removed(void** state) {
  (void)state;
  scene s = open_scene(defer_three);
  cairn_match match;
  look(&s, names, places, 1, NULL);
  look(&s, names + 1, places + 1, 1, NULL);
  uint32_t removed = 0;
  for (int k = 0; k < 6; ++k) {
    look(&s, names + 1, places + 1, 1, NULL);
    removed += last_update(s.filter).removed;
  }
  assert_int_equal(removed, 1);
  assert_int_equal(map_size(&s), 1);
  look(&s, names, places, 1, &match);
  assert_int_equal(match.result, CAIRN_RESULT_NEW); /* removed */
  cairn_filter_destroy(s.filter);
}

static void miss_two(cairn_filter_options* options) {
  options->missed_frames = 2;
}

static void a_landmark_in_view_that_is_missed_is_removed(void** state) {
  (void)state;
  scene s = open_scene(miss_two);
  const double lower[3] = {-3, -3, 0}, upper[3] = {3, 3.5, 0}, all[2] = {-INFINITY, -INFINITY};
  cairn_match matches[4];
  look(&s, names, places, 4, NULL);
  look(&s, names, places, 4, NULL);
  for (int k = 0; k < 3; ++k)
    look(&s, names, places, 1, NULL); /* no field of view is set: no landmark counts as missed */
  assert_int_equal(map_size(&s), 4);
  assert_ok(cairn_filter_set_view(s.filter, s.sensor, lower, upper, NULL));
  look(&s, names, places, 1, NULL);
  look(&s, names + 1, places + 1, 1, NULL);           /* number 12 was missed once, and is seen now */
  assert_int_equal(last_update(s.filter).removed, 1); /* number 13, missed twice; number 14 is out of view */
  look(&s, names + 1, places + 1, 1, NULL);
  assert_int_equal(last_update(s.filter).removed, 1); /* number 11, missed twice in a row */
  assert_int_equal(map_size(&s), 2);
  assert_near(landmark(&s, names[1]).position[1], places[1][1], 1e-9);
  assert_near(landmark(&s, names[3]).position[0], places[3][0], 1e-9);
  /* An outlier shows that something is there: it is not a miss. */
  const double astray[1][2] = {{1, 3}};
  for (int k = 0; k < 4; ++k) {
    look(&s, names + 1, astray, 1, matches);
    assert_int_equal(matches[0].reason, CAIRN_REASON_GATE);
  }
  assert_int_equal(map_size(&s), 2);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "lower", cairn_filter_set_view(s.filter, s.sensor, upper, lower, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "lower", cairn_filter_set_view(s.filter, s.sensor, NULL, upper, NULL));
  assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "sensor", cairn_filter_set_view(s.filter, 7, lower, upper, NULL));
  const double wide[3] = {all[0], all[1], 0}, open[3] = {INFINITY, INFINITY, 0};
  assert_ok(cairn_filter_set_view(s.filter, s.sensor, wide, open, NULL));
  look(&s, names + 1, places + 1, 1, NULL);
  look(&s, names + 1, places + 1, 1, NULL);
  assert_int_equal(map_size(&s), 1); /* number 14 was in view now */
  cairn_filter_destroy(s.filter);
}

/* Two landmarks at one place. Merging leaves their mean, weighted by their covariances. */
static void merging_equals_observing_a_difference_of_zero(void** state) {
  (void)state;
  scene s = open_scene(NULL);
  const double twice[2][2] = {{2, 0}, {2.1, 0.06}};
  cairn_match match;
  look(&s, names, twice, 2, NULL);
  look(&s, names, twice, 1, NULL); /* the first is observed twice as often: variances 0.005 and 0.01 */
  assert_ok(cairn_filter_merge_landmarks(s.filter, names[0], names[1], &match, NULL));
  assert_int_equal(match.result, CAIRN_RESULT_MATCHED);
  assert_near(match.distance, (0.1 * 0.1 + 0.06 * 0.06) / 0.015, 1e-3);
  assert_int_equal(map_size(&s), 1);
  const cairn_landmark one = landmark(&s, names[0]);
  assert_near(one.position[0], 2 + 0.1 / 3, 1e-6);
  assert_near(one.position[1], 0.02, 1e-6);
  assert_near(one.covariance[0], 0.01 / 3, 1e-7);
  assert_int_equal(one.observations, 3);
  /* A merge that contradicts the estimates is refused, and nothing changes. */
  look(&s, names + 1, places + 1, 1, NULL);
  const cairn_landmark before = landmark(&s, names[0]);
  assert_ok(cairn_filter_merge_landmarks(s.filter, names[0], names[1], &match, NULL));
  assert_int_equal(match.result, CAIRN_RESULT_REJECTED);
  assert_int_equal(match.reason, CAIRN_REASON_GATE);
  const cairn_landmark after = landmark(&s, names[0]);
  assert_memory_equal(&before, &after, sizeof before);
  assert_int_equal(map_size(&s), 2);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "itself", cairn_filter_merge_landmarks(s.filter, 11, 11, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "99", cairn_filter_merge_landmarks(s.filter, 11, 99, NULL, NULL));
  cairn_filter_destroy(s.filter);
}

static void a_split_landmark_becomes_two(void** state) {
  (void)state;
  scene s = open_scene(NULL);
  double covariance[9];
  diagonal(covariance, 3, 0.25);
  look(&s, names, places, 2, NULL);
  assert_ok(cairn_filter_split_landmark(s.filter, names[0], 77, covariance, NULL));
  assert_int_equal(map_size(&s), 3);
  const cairn_landmark old = landmark(&s, names[0]), fresh = landmark(&s, 77);
  assert_near(fresh.position[0], old.position[0], 0);
  assert_near(fresh.covariance[0], old.covariance[0] + 0.25, 1e-15);
  const uint64_t both[2] = {77, 11};
  double joint[36];
  size_t needed = 0;
  assert_ok(cairn_map_joint_covariance(cairn_filter_map(s.filter), both, 2, joint, 36, &needed, NULL));
  assert_near(joint[3], old.covariance[0], 1e-15); /* the new landmark shares the whole error of the old one */
  const double apart[2][2] = {{2.4, 0}, {2, 0}};
  cairn_match matches[2];
  for (int k = 0; k < 30; ++k) look(&s, both, apart, 2, matches);
  assert_int_equal(matches[0].result, CAIRN_RESULT_MATCHED);
  assert_near(landmark(&s, 77).position[0] - landmark(&s, 11).position[0], 0.4, 0.01);
  covariance[0] = -1;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance",
                 cairn_filter_split_landmark(s.filter, 11, 78, covariance, NULL));
  diagonal(covariance, 3, 0.25);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "77", cairn_filter_split_landmark(s.filter, 11, 77, covariance, NULL));
  assert_refused(NULL, CAIRN_ERROR_NOT_FOUND, "99", cairn_filter_split_landmark(s.filter, 99, 78, covariance, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "fresh",
                 cairn_filter_split_landmark(s.filter, 11, CAIRN_ID_NONE, covariance, NULL));
  for (uint64_t id = 80; id < 85; ++id) assert_ok(cairn_filter_split_landmark(s.filter, 11, id, covariance, NULL));
  assert_refused(NULL, CAIRN_ERROR_CAPACITY, "fresh", cairn_filter_split_landmark(s.filter, 11, 90, covariance, NULL));
  cairn_filter_destroy(s.filter);
}

static void nearest_neighbour(cairn_filter_options* options) {
  options->association = CAIRN_ASSOCIATION_NEAREST;
}

/* A filter that names landmarks counts on from the names of its caller, and never comes to the end of the numbers. */
static void names_of_split_landmarks_leave_room(void** state) {
  (void)state;
  scene s = open_scene(nearest_neighbour);
  double covariance[9];
  diagonal(covariance, 3, 0.25);
  look(&s, names, places, 2, NULL);
  cairn_landmark all[8];
  size_t n = 0;
  assert_ok(cairn_map_landmarks(cairn_filter_map(s.filter), all, LENGTH(all), &n, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "2^63",
                 cairn_filter_split_landmark(s.filter, all[0].id, UINT64_MAX - 1, covariance, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "2^63",
                 cairn_filter_split_landmark(s.filter, all[0].id, (uint64_t)1 << 63, covariance, NULL));
  const uint64_t highest = ((uint64_t)1 << 63) - 1;
  assert_ok(cairn_filter_split_landmark(s.filter, all[0].id, highest, covariance, NULL));
  const double far[2][2] = {{9, 40}, {9, -40}};
  look(&s, names, far, 2, NULL);
  assert_ok(cairn_map_landmarks(cairn_filter_map(s.filter), all, LENGTH(all), &n, NULL));
  assert_int_equal(n, 5);
  for (size_t i = 1; i < n; ++i) assert_true(all[i - 1].id < all[i].id);
  assert_true(all[4].id == highest + 2);
  cairn_filter_destroy(s.filter);
}

static void by_distance(cairn_filter_options* options) {
  options->association = CAIRN_ASSOCIATION_NEAREST;
  options->new_probability = 0.999;
}
static void by_likelihood(cairn_filter_options* options) {
  by_distance(options);
  options->association_distance = CAIRN_DISTANCE_LIKELIHOOD;
}

/* Number 0 is uncertain, number 1 is well known. Half way between them the uncertain one is nearer by Mahalanobis
 * distance, and the well known one is more likely. */
static void likelihood_prefers_the_better_known_landmark(void** state) {
  (void)state;
  for (int likely = 0; likely < 2; ++likely) {
    scene s = open_scene(likely ? by_likelihood : by_distance);
    cairn_observation o[2];
    memset(o, 0, sizeof o);
    o[0].z[0] = 0, o[0].z[1] = 5;
    o[0].covariance[0] = o[0].covariance[3] = 1;
    o[1].z[0] = 6, o[1].z[1] = 5;
    o[1].covariance[0] = o[1].covariance[3] = 0.04;
    cairn_match match[2];
    assert_ok(cairn_filter_update(s.filter, s.sensor, o, 2, match, NULL));
    assert_int_equal(match[1].result, CAIRN_RESULT_NEW);
    cairn_observation between;
    memset(&between, 0, sizeof between);
    between.z[0] = 4.6, between.z[1] = 5;
    between.covariance[0] = between.covariance[3] = 0.25;
    /* d^2: 4.6^2 / 1.25 = 16.9 is beyond the gate. At 2.9: 6.7 to number 0, and 33 to number 1. */
    between.z[0] = 2.9;
    assert_ok(cairn_filter_update(s.filter, s.sensor, &between, 1, match, NULL));
    assert_int_equal(match[0].landmark, 0);
    cairn_filter_destroy(s.filter);

    s = open_scene(likely ? by_likelihood : by_distance);
    o[1].z[0] = 3;
    assert_ok(cairn_filter_update(s.filter, s.sensor, o, 2, match, NULL));
    assert_int_equal(match[1].result, CAIRN_RESULT_NEW);
    /* At 1.95: d^2 = 3.04 to number 0, 3.80 to number 1; with log det S: 3.49 and 1.33. */
    between.z[0] = 1.95;
    assert_ok(cairn_filter_update(s.filter, s.sensor, &between, 1, match, NULL));
    assert_int_equal(match[0].landmark, likely ? 1 : 0);
    cairn_filter_destroy(s.filter);
  }
}

static void options_are_checked(void** state) {
  (void)state;
  static const struct {
    size_t at;
    uint32_t value;
    const char* name;
  } bad[] = {{offsetof(cairn_filter_options, deferred_sightings), 0, "deferred_sightings"},
             {offsetof(cairn_filter_options, deferred_sightings), 1001, "deferred_sightings"},
             {offsetof(cairn_filter_options, deferred_frames), 0, "deferred_frames"},
             {offsetof(cairn_filter_options, missed_frames), 1000001, "missed_frames"},
             {offsetof(cairn_filter_options, association_distance), 2, "association_distance"},
             {offsetof(cairn_filter_options, vehicle), 2, "vehicle"}};
  for (size_t i = 0; i < LENGTH(bad); ++i) {
    cairn_filter_options options;
    cairn_filter* filter = NULL;
    assert_ok(cairn_filter_options_init(&options, sizeof options, NULL));
    memcpy((char*)&options + bad[i].at, &bad[i].value, sizeof bad[i].value);
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, bad[i].name, cairn_filter_create(&options, &filter, NULL));
    assert_null(filter);
  }
}

/* The first observation of the last landmark is a gross error. Two later ones outvote it; one does not. */
static void a_landmark_that_was_placed_wrongly_is_placed_again(void** state) {
  (void)state;
  scene s = open_scene(NULL);
  cairn_match matches[4];
  double wrong[4][2];
  memcpy(wrong, places, sizeof wrong);
  wrong[3][0] += 5;
  look(&s, names, places, 3, NULL);
  look(&s, names, (const double(*)[2])wrong, 4, NULL);
  assert_int_equal(map_size(&s), 4);
  look(&s, names, places, 4, matches);
  assert_int_equal(matches[3].result, CAIRN_RESULT_REJECTED);
  assert_int_equal(matches[3].reason, CAIRN_REASON_GATE);
  assert_int_equal(map_size(&s), 3); /* nobody knows which is right: it does not count */
  assert_int_equal(last_update(s.filter).deferred, 1);
  look(&s, names, places, 4, matches);
  assert_int_equal(matches[3].result, CAIRN_RESULT_NEW);
  assert_int_equal(matches[3].reason, CAIRN_REASON_NONE);
  assert_int_equal(matches[3].landmark, names[3]);
  assert_true(matches[3].distance > matches[3].threshold && matches[3].threshold > 0);
  const cairn_update_report report = last_update(s.filter);
  assert_int_equal(report.matched, 3);
  assert_int_equal(report.placed, 1);
  assert_int_equal(report.placed_again, 1);
  assert_int_equal(report.rejected, 0);
  assert_int_equal(report.deferred, 0);
  assert_int_equal(map_size(&s), 4);
  for (int i = 0; i < 4; ++i) assert_near(landmark(&s, names[i]).position[0], places[i][0], 1e-9);
  look(&s, names, places, 4, matches);
  assert_int_equal(matches[3].result, CAIRN_RESULT_MATCHED);
  assert_int_equal(last_update(s.filter).placed_again, 0);
  cairn_filter_destroy(s.filter);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_deferred_landmark_counts_after_enough_sightings),
      cmocka_unit_test(a_landmark_that_was_placed_wrongly_is_placed_again),
      cmocka_unit_test(a_deferred_landmark_that_is_not_seen_again_is_removed),
      cmocka_unit_test(a_landmark_in_view_that_is_missed_is_removed),
      cmocka_unit_test(merging_equals_observing_a_difference_of_zero),
      cmocka_unit_test(a_split_landmark_becomes_two),
      cmocka_unit_test(names_of_split_landmarks_leave_room),
      cmocka_unit_test(likelihood_prefers_the_better_known_landmark),
      cmocka_unit_test(options_are_checked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
