/* SPDX-License-Identifier: BSD-3-Clause */
/* Observations without landmark ids, of a planar vehicle. */
#include "plane.h"

static void without_ids_a_filter_decides_as_with_ids(void** state) {
  static const int32_t ways[] = {CAIRN_ASSOCIATION_NEAREST, CAIRN_ASSOCIATION_JOINT};
  (void)state;
  for (size_t k = 0; k < LENGTH(ways); ++k) {
    cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT);
    const cairn_range_bearing radar = plane_radar();
    generator random = {31};
    cairn_pose truth;
    uint64_t name_of[POINTS] = {0};
    size_t matched = 0;
    int32_t sensor;
    options.gate_probability = 0.999, options.batch_gate_probability = 0.9999;
    options.initial_covariance[1] = options.initial_covariance[6] = 0;
    options.initial_covariance[5] = options.initial_covariance[30] = 0;
    options.initial_covariance[0] = options.initial_covariance[7] = 1e-4, options.initial_covariance[35] = 1e-6;
    truth = options.initial_pose;
    cairn_filter* known = plane_filter(&options);
    options.association = ways[k];
    cairn_filter* unknown = plane_filter(&options);
    assert_ok(cairn_filter_add_range_bearing(known, &radar, &sensor, NULL));
    assert_ok(cairn_filter_add_range_bearing(unknown, &radar, &sensor, NULL));
    for (int step = 0; step < 60; ++step) {
      const cairn_pose moved = pose_at(0.5, 0, 0, 0, 0, 0.1);
      cairn_observation o[POINTS];
      cairn_match known_matches[POINTS], found_matches[POINTS];
      double c[36];
      size_t count = 0;
      assert_ok(cairn_pose_compose(&truth, &moved, &truth, NULL));
      diagonal(c, 6, 1e-4);
      c[35] = 1e-5;
      for (size_t l = 0; l < POINTS; ++l) {
        double range, bearing;
        plane_polar(&truth, plane_points[l], &range, &bearing);
        if (range > 9 || range < 1) continue;
        o[count++] = sighting(l + 1, range + random_normal(&random, 0.03), bearing + random_normal(&random, 0.003));
      }
      assert_ok(cairn_filter_predict_increment(known, &moved, c, NULL));
      assert_ok(cairn_filter_predict_increment(unknown, &moved, c, NULL));
      assert_ok(cairn_filter_update(known, sensor, o, count, known_matches, NULL));
      for (size_t i = 0; i < count; ++i) o[i].id = step % 2 == 0 ? CAIRN_ID_NONE : 5;
      assert_ok(cairn_filter_update(unknown, sensor, o, count, found_matches, NULL));
      matched += check_same_matches(known_matches, found_matches, count, name_of);
    }
    assert_true(matched > 150);
    check_same_pose(known, unknown);
    cairn_filter_destroy(known);
    cairn_filter_destroy(unknown);
  }
}

/* The filter stands at the origin with a known pose and has seen `count` points. Then its x position becomes uncertain
 * by `sigma`. */
static cairn_filter* open_pushed(int32_t way, uint32_t nodes, const cairn_observation* points, size_t count,
                                 double sigma) {
  cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT);
  const cairn_pose stay = pose_at(0, 0, 0, 0, 0, 0);
  cairn_cartesian cartesian;
  double covariance[36];
  int32_t sensor;
  options.association = way, options.association_nodes = nodes;
  options.gate_probability = 0.99, options.batch_gate_probability = 0.9999;
  options.initial_pose = stay;
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  cairn_filter* f = plane_filter(&options);
  assert_ok(cairn_cartesian_init(&cartesian, sizeof cartesian, NULL));
  assert_ok(cairn_filter_add_cartesian(f, &cartesian, &sensor, NULL));
  assert_ok(cairn_filter_update(f, sensor, points, count, NULL, NULL));
  diagonal(covariance, 6, 1e-8);
  covariance[0] = sigma * sigma;
  assert_ok(cairn_filter_predict_increment(f, &stay, covariance, NULL));
  return f;
}

static void pairs_that_contradict_each_other_are_not_accepted_together(void** state) {
  const cairn_observation points[] = {sighting(0, 0, -50), sighting(0, 100, 50)};
  const cairn_observation looked[] = {sighting(0, 2.5, -50), sighting(0, 97.5, 50)};
  cairn_match m[2];
  (void)state;
  cairn_filter* f = open_pushed(CAIRN_ASSOCIATION_JOINT, 2000, points, 2, 1.0);
  assert_ok(cairn_filter_update(f, 0, looked, 2, m, NULL));
  const int refused = check_one_of_two_matches(m);
  assert_near(m[refused].threshold, 9.21034037197618, 1e-9); /* chi-square quantile 0.99, 2 degrees of freedom */
  assert_true(last_update(f).association_nodes >= 2 && last_update(f).association_exhausted == 0);
  cairn_filter_destroy(f);
  f = open_pushed(CAIRN_ASSOCIATION_NEAREST, 2000, points, 2, 1.0);
  assert_ok(cairn_filter_update(f, 0, looked, 2, m, NULL));
  assert_true((m[0].reason == CAIRN_REASON_BATCH_GATE) != (m[1].reason == CAIRN_REASON_BATCH_GATE));
  assert_int_equal(last_update(f).association_nodes, 0);
  cairn_filter_destroy(f);
}

static void a_new_landmark_keeps_its_distance_from_known_ones(void** state) {
  /* Both sightings have noise 0.1, so the squared distance is d^2 / 0.02. The bounds of 0.99 and 0.9999 are 9.21 and
   * 18.42. */
  const struct {
    double offset;
    int32_t result, reason;
  } looks[] = {{0.42, CAIRN_RESULT_MATCHED, CAIRN_REASON_NONE},
               {0.44, CAIRN_RESULT_REJECTED, CAIRN_REASON_GATE},
               {0.60, CAIRN_RESULT_REJECTED, CAIRN_REASON_GATE},
               {0.62, CAIRN_RESULT_NEW, CAIRN_REASON_NONE}};
  (void)state;
  for (size_t k = 0; k < LENGTH(looks); ++k) {
    const cairn_observation point = sighting(0, 10, 0), looked = sighting(0, 10, looks[k].offset);
    cairn_match m;
    cairn_filter* f = open_pushed(CAIRN_ASSOCIATION_JOINT, 2000, &point, 1, 1e-4);
    assert_ok(cairn_filter_update(f, 0, &looked, 1, &m, NULL));
    assert_int_equal(m.result, looks[k].result);
    assert_int_equal(m.reason, looks[k].reason);
    assert_int_equal(m.landmark, m.result == CAIRN_RESULT_NEW ? 1 : 0);
    cairn_filter_destroy(f);
  }
}

static void an_ambiguous_observation_needs_the_support_of_others(void** state) {
  const cairn_observation points[] = {sighting(0, 10, 0), sighting(0, 12, 0.3), sighting(0, 13, -0.3)};
  (void)state;
  for (size_t count = 1; count <= 3; ++count) {
    cairn_observation looked[3];
    cairn_match m[3];
    cairn_filter* f = open_pushed(CAIRN_ASSOCIATION_JOINT, 2000, points, 3, 1.0);
    for (size_t i = 0; i < count; ++i) looked[i] = points[i], looked[i].z[0] += 0.8;
    assert_ok(cairn_filter_update(f, 0, looked, count, m, NULL));
    for (size_t i = 0; i < count; ++i) {
      assert_int_equal(m[i].result, count == 3 ? CAIRN_RESULT_MATCHED : CAIRN_RESULT_REJECTED);
      assert_int_equal(m[i].reason, count == 3 ? CAIRN_REASON_NONE : CAIRN_REASON_AMBIGUOUS);
      if (count == 3) assert_int_equal(m[i].landmark, i);
    }
    cairn_filter_destroy(f);
  }
}

static void the_limit_of_joint_tests_is_kept_and_reported(void** state) {
  cairn_observation points[POINTS];
  cairn_match m[POINTS];
  (void)state;
  for (int i = 0; i < POINTS; ++i) points[i] = sighting(0, 10 + 0.9 * (i % 4), 0.9 * (i / 4));
  cairn_filter* f = open_pushed(CAIRN_ASSOCIATION_JOINT, 1, points, POINTS, 2.0);
  for (int i = 0; i < POINTS; ++i)
    points[i].z[0] += i % 3 == 0 ? 1.3 : i % 3 == 1 ? 0.4 : -0.7; /* offsets that no shift along x explains */
  assert_ok(cairn_filter_update(f, 0, points, POINTS, m, NULL));
  const cairn_update_report report = last_update(f);
  assert_int_equal(report.association_exhausted, 1);
  assert_true(report.association_nodes >= 1 && report.association_nodes <= 8 * POINTS);
  assert_int_equal(report.matched + report.placed + report.rejected, POINTS);
  cairn_filter_destroy(f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_ids_a_filter_decides_as_with_ids),
      cmocka_unit_test(pairs_that_contradict_each_other_are_not_accepted_together),
      cmocka_unit_test(a_new_landmark_keeps_its_distance_from_known_ones),
      cmocka_unit_test(an_ambiguous_observation_needs_the_support_of_others),
      cmocka_unit_test(the_limit_of_joint_tests_is_kept_and_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
