/* SPDX-License-Identifier: BSD-3-Clause */
/* Frames of observations: matches, gates, reports, and removed landmarks. */
#include "support.h"

#define CHI2_3_999 16.26623619623813 /* 0.999 quantile, 3 degrees of freedom */
#define CHI2_1_999 10.82756617021389 /* 1 degree of freedom */

static cairn_observation seen(uint64_t id, double x, double y, double z) {
  cairn_observation o;
  memset(&o, 0, sizeof o);
  o.id = id, o.z[0] = x, o.z[1] = y, o.z[2] = z;
  return o;
}

/* A rig at the origin with a moderate start covariance. It has seen one landmark, number 1 at (8, 2, 1), without error.
 * */
static void open_with_one(rig* r, cairn_filter_options options) {
  const cairn_observation first = seen(1, 8, 2, 1);
  options.initial_pose = pose_at(0, 0, 0, 0, 0, 0);
  rig_open(r, &options);
  assert_ok(cairn_filter_update(r->filter, r->sensors[CARTESIAN], &first, 1, NULL, NULL));
}

static void an_unknown_id_places_and_a_known_one_updates(void** state) {
  rig r;
  cairn_match m;
  cairn_landmark before, after;
  cairn_observation o = seen(1, 8.05, 1.9, 1.1);
  (void)state;
  open_with_one(&r, test_options());
  cairn_update_report report = last_update(r.filter);
  assert_true(report.placed == 1 && report.matched == 0 && report.rejected == 0 && report.rows == 0);
  const cairn_map* map = cairn_filter_map(r.filter);
  assert_ok(cairn_map_landmark(map, 1, &before, NULL));
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], &o, 1, &m, NULL));
  assert_ok(cairn_map_landmark(map, 1, &after, NULL));
  assert_int_equal(m.result, CAIRN_RESULT_MATCHED);
  assert_int_equal(m.reason, CAIRN_REASON_NONE);
  assert_int_equal(m.landmark, 1);
  assert_near(m.threshold, CHI2_3_999, 1e-6);
  /* placed with noise N, seen again with N: the covariance of the innovation is exactly 2 N */
  assert_near(m.distance, (0.05 * 0.05 + 0.1 * 0.1 + 0.1 * 0.1) / 0.02, 1e-6);
  report = last_update(r.filter);
  assert_true(report.placed == 0 && report.matched == 1 && report.rejected == 0 && report.rows == 3);
  assert_true(report.iterations >= 1 && report.iterations <= 3);
  assert_near(report.nis, m.distance, 1e-9);
  assert_near(report.nis_lower, 0.21579528262389, 1e-6); /* chi-square 0.025 and 0.975, 3 degrees of freedom */
  assert_near(report.nis_upper, 9.34840360449614, 1e-6);
  for (int i = 0; i < 3; ++i) assert_true(after.covariance[4 * i] < before.covariance[4 * i]);
  assert_int_equal(before.observations, 1);
  assert_int_equal(after.observations, 2);
  rig_close(&r);
}

static void an_outlier_is_gated_and_changes_nothing(void** state) {
  rig r;
  cairn_match m;
  cairn_observation o = seen(1, 8, 7, 1);
  cairn_pose pa, pb;
  double ca[36], cb[36];
  cairn_landmark la, lb;
  (void)state;
  open_with_one(&r, test_options());
  const cairn_map* map = cairn_filter_map(r.filter);
  assert_ok(cairn_filter_pose(r.filter, &pa, ca, NULL));
  assert_ok(cairn_map_landmark(map, 1, &la, NULL));
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], &o, 1, &m, NULL));
  assert_int_equal(m.result, CAIRN_RESULT_REJECTED);
  assert_int_equal(m.reason, CAIRN_REASON_GATE);
  assert_int_equal(m.landmark, 1);
  assert_near(m.threshold, CHI2_3_999, 1e-6);
  assert_near(m.distance, 25 / 0.02, 1e-6);
  const cairn_update_report report = last_update(r.filter);
  assert_true(report.rejected == 1 && report.matched == 0 && report.placed == 0 && report.rows == 0);
  assert_ok(cairn_filter_pose(r.filter, &pb, cb, NULL));
  assert_ok(cairn_map_landmark(map, 1, &lb, NULL));
  assert_memory_equal(&pa, &pb, sizeof pa);
  assert_memory_equal(ca, cb, sizeof ca);
  assert_memory_equal(&la, &lb, sizeof la);
  rig_close(&r);
}

static void an_outlier_does_not_touch_what_the_rest_of_its_frame_does(void** state) {
  rig a, b;
  const cairn_observation frame_a[] = {seen(1, 8.1, 2, 1), seen(3, 5, -5, 0), seen(2, -4, 3, 9)};
  const cairn_observation frame_b[] = {seen(1, 8.1, 2, 1), seen(3, 5, -5, 0)}, second = seen(2, -4, 3, 1);
  cairn_match m[3];
  (void)state;
  open_with_one(&a, test_options());
  open_with_one(&b, test_options());
  assert_ok(cairn_filter_update(a.filter, a.sensors[CARTESIAN], &second, 1, NULL, NULL));
  assert_ok(cairn_filter_update(b.filter, b.sensors[CARTESIAN], &second, 1, NULL, NULL));
  assert_ok(cairn_filter_update(a.filter, a.sensors[CARTESIAN], frame_a, 3, m, NULL));
  assert_ok(cairn_filter_update(b.filter, b.sensors[CARTESIAN], frame_b, 2, NULL, NULL));
  assert_int_equal(m[0].result, CAIRN_RESULT_MATCHED);
  assert_int_equal(m[1].result, CAIRN_RESULT_NEW);
  assert_int_equal(m[1].landmark, 3);
  assert_int_equal(m[2].reason, CAIRN_REASON_GATE);
  cairn_pose pa, pb;
  double ca[36], cb[36];
  assert_ok(cairn_filter_pose(a.filter, &pa, ca, NULL));
  assert_ok(cairn_filter_pose(b.filter, &pb, cb, NULL));
  for (int i = 0; i < 3; ++i) assert_near(pa.position[i], pb.position[i], 1e-12);
  for (int i = 0; i < 36; ++i) assert_near(ca[i], cb[i], 1e-14);
  rig_close(&a);
  rig_close(&b);
}

static void gates_of_probability_one_let_all_pass(void** state) {
  rig r;
  cairn_match m;
  const cairn_observation o = seen(1, 8, 7, 1);
  cairn_filter_options options = test_options();
  (void)state;
  options.gate_probability = options.batch_gate_probability = 1;
  open_with_one(&r, options);
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], &o, 1, &m, NULL));
  assert_int_equal(m.result, CAIRN_RESULT_MATCHED);
  assert_near(m.distance, 25 / 0.02, 1e-6);
  rig_close(&r);
}

static void a_batch_that_is_jointly_too_far_off_is_reported(void** state) {
  rig r;
  cairn_match m[WORLD_LANDMARKS];
  cairn_observation o[WORLD_LANDMARKS];
  cairn_filter_options options = test_options();
  size_t batch = 0, matched = 0;
  (void)state;
  open_with_one(&r, options);
  for (int i = 0; i < WORLD_LANDMARKS; ++i) o[i] = seen((uint64_t)i + 1, 6 + 0.5 * i, i - 5, 0.3 * i);
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], o + 1, WORLD_LANDMARKS - 1, NULL, NULL));
  o[0] = seen(1, 8, 2, 1);
  for (int i = 0; i < WORLD_LANDMARKS; ++i)
    o[i].z[i % 3] += (i % 2 ? -1 : 1) * 0.53; /* each squared distance is about 14; the bound is 16.3 */
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], o, WORLD_LANDMARKS, m, NULL));
  for (int i = 0; i < WORLD_LANDMARKS; ++i) {
    batch += m[i].result == CAIRN_RESULT_REJECTED && m[i].reason == CAIRN_REASON_BATCH_GATE;
    matched += m[i].result == CAIRN_RESULT_MATCHED;
    if (m[i].reason == CAIRN_REASON_BATCH_GATE)
      assert_true(m[i].distance > m[i].threshold && m[i].threshold > CHI2_3_999);
  }
  assert_true(batch > 0);
  const cairn_update_report report = last_update(r.filter);
  assert_int_equal(report.matched, matched);
  assert_int_equal(report.matched + report.rejected, WORLD_LANDMARKS);
  assert_int_equal(report.rows, 3 * matched);
  rig_close(&r);
}

static void a_landmark_without_an_image_is_refused(void** state) {
  rig r;
  cairn_match m;
  const cairn_observation behind = seen(5, -6, 1, 0), above = seen(6, 0.1, 0, 9), image = seen(5, 320, 300, 240);
  const cairn_observation polar = seen(6, 9, 0, 1.4);
  (void)state;
  open_with_one(&r, test_options());
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], &behind, 1, NULL, NULL));
  assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], &above, 1, NULL, NULL));
  assert_ok(cairn_filter_update(r.filter, r.sensors[CAMERA], &image, 1, &m, NULL));
  assert_int_equal(m.result, CAIRN_RESULT_REJECTED);
  assert_int_equal(m.reason, CAIRN_REASON_NO_IMAGE);
  assert_int_equal(m.landmark, 5);
  assert_true(m.distance == 0 && m.threshold == 0);
  assert_int_equal(last_update(r.filter).rejected, 1);
  cairn_filter_options options = test_options();
  cairn_stereo_head
      head; /* the camera frame is the body frame: landmark 6 is at an elevation of 89 degrees, above 85 */
  cairn_filter* filter = NULL;
  int32_t added;
  assert_ok(cairn_stereo_head_init(&head, sizeof head, NULL));
  options.initial_pose = pose_at(0, 0, 0, 0, 0, 0);
  assert_ok(cairn_filter_create(&options, &filter, NULL));
  assert_ok(cairn_filter_add_stereo_head(filter, &head, &added, NULL));
  cairn_cartesian cartesian = test_cartesian();
  int32_t points;
  assert_ok(cairn_filter_add_cartesian(filter, &cartesian, &points, NULL));
  assert_ok(cairn_filter_update(filter, points, &above, 1, NULL, NULL));
  assert_ok(cairn_filter_update(filter, added, &polar, 1, &m, NULL));
  assert_int_equal(m.reason, CAIRN_REASON_NO_IMAGE);
  cairn_filter_destroy(filter);
  rig_close(&r);
}

static void an_observation_that_places_nothing_is_refused(void** state) {
  rig r;
  const struct {
    int sensor;
    cairn_observation o;
  } cases[] = {
      {CAMERA, seen(9, 320.5, 320, 240)}, /* disparity 0.5, below 1 */
      {CAMERA, seen(9, 323, 320, 240)},   /* disparity 3, below 2.5 standard deviations of 1.41 */
      {CAMERA, seen(9, 300, 320, 240)},   /* negative disparity */
      {HEAD, seen(9, 0.05, 0, 0)},        /* nearer than near_range */
      {HEAD, seen(9, -3, 0, 0)},          /* range 0 */
      {HEAD, seen(9, 5, 0, 1.55)},        /* steeper than max_elevation */
      {RANGE, seen(9, 5, 0, 0)},          /* a sensor that cannot place landmarks */
  };
  (void)state;
  open_with_one(&r, test_options());
  for (size_t n = 0; n < LENGTH(cases); ++n) {
    cairn_match m;
    size_t count = 0;
    memset(&m, 0x5a, sizeof m);
    assert_ok(cairn_filter_update(r.filter, r.sensors[cases[n].sensor], &cases[n].o, 1, &m, NULL));
    assert_int_equal(m.result, CAIRN_RESULT_REJECTED);
    assert_int_equal(m.reason, CAIRN_REASON_NO_PLACE);
    assert_true(m.landmark == CAIRN_ID_NONE);
    assert_true(m.distance == 0 && m.threshold == 0);
    assert_ok(cairn_map_size(cairn_filter_map(r.filter), &count, NULL));
    assert_int_equal(count, 1);
    assert_int_equal(last_update(r.filter).rejected, 1);
  }
  rig_close(&r);
}

static void an_empty_frame_is_a_frame(void** state) {
  bench* b = *state;
  const cairn_observation o = seen(1, 1, 1, 1);
  assert_ok(cairn_filter_update(b->main.filter, b->main.sensors[HEAD], NULL, 0, NULL, NULL));
  assert_ok(cairn_filter_update(b->shadow.filter, b->shadow.sensors[HEAD], &o, 0, NULL, NULL));
  const cairn_update_report report = last_update(b->main.filter);
  assert_true(report.matched == 0 && report.placed == 0 && report.rejected == 0 && report.rows == 0);
  bench_continue(b, 3);
}

static void matches_are_optional_and_unused_values_are_not_read(void** state) {
  bench* b = *state;
  frame f = bench_until(b, RANGE);
  assert_ok(cairn_filter_update(b->main.filter, b->main.sensors[RANGE], f.observations, f.count, NULL, NULL));
  for (size_t i = 0; i < f.count; ++i) {
    f.observations[i].z[1] = NAN, f.observations[i].z[2] = INFINITY;
  }
  cairn_match m[WORLD_LANDMARKS];
  assert_ok(cairn_filter_update(b->shadow.filter, b->shadow.sensors[RANGE], f.observations, f.count, m, NULL));
  assert_near(m[0].threshold, CHI2_1_999, 1e-6);
  bench_continue(b, 3);
}

static void an_observation_brings_its_own_noise(void** state) {
  rig a, b;
  cairn_match ma, mb;
  cairn_observation o = seen(1, 8, 2.3, 1);
  (void)state;
  open_with_one(&a, test_options());
  open_with_one(&b, test_options());
  assert_ok(cairn_filter_update(a.filter, a.sensors[CARTESIAN], &o, 1, &ma, NULL));
  diagonal(o.covariance, 3, 0.01); /* the noise of the sensor */
  assert_ok(cairn_filter_update(b.filter, b.sensors[CARTESIAN], &o, 1, &mb, NULL));
  assert_near(ma.distance, mb.distance, 1e-9);
  assert_near(ma.distance, 0.09 / 0.02, 1e-9);
  rig_close(&b);
  open_with_one(&b, test_options());
  diagonal(o.covariance, 3, 0.08);
  assert_ok(cairn_filter_update(b.filter, b.sensors[CARTESIAN], &o, 1, &mb, NULL));
  assert_near(mb.distance, 0.09 / 0.09, 1e-9);
  rig_close(&b);
  open_with_one(&b, test_options());
  memset(&o, 0, sizeof o);
  o.id = 1, o.z[0] = sqrt(69) + 0.3, o.covariance[0] = 0.08; /* one row: packed 1 x 1 */
  assert_ok(cairn_filter_update(b.filter, b.sensors[RANGE], &o, 1, &mb, NULL));
  assert_near(mb.distance, 0.09 / 0.09, 1e-9);
  rig_close(&a);
  rig_close(&b);
}

/* The information that a removed landmark gave about others stays. Its id and its place in the map are free again. */
static void a_removed_landmark_is_gone(void** state) {
  bench* b = *state;
  const cairn_map* map = cairn_filter_map(b->main.filter);
  cairn_landmark before[WORLD_LANDMARKS], after[WORLD_LANDMARKS], near[WORLD_LANDMARKS];
  double ja[(6 + 33) * (6 + 33)], jb[(6 + 33) * (6 + 33)];
  uint64_t ids[WORLD_LANDMARKS - 1];
  size_t needed, k = 0;
  const double origin[3] = {0, 0, 0};
  assert_ok(cairn_map_landmarks(map, before, WORLD_LANDMARKS, &needed, NULL));
  assert_int_equal(needed, WORLD_LANDMARKS);
  for (uint64_t id = 1; id <= WORLD_LANDMARKS; ++id)
    if (id != 5) ids[k++] = id;
  assert_ok(cairn_filter_joint_covariance(b->main.filter, ids, k, ja, LENGTH(ja), &needed, NULL));
  assert_ok(cairn_filter_remove_landmark(b->main.filter, 5, NULL));
  assert_ok(cairn_filter_joint_covariance(b->main.filter, ids, k, jb, LENGTH(jb), &needed, NULL));
  for (size_t i = 0; i < LENGTH(ja); ++i) assert_near(jb[i], ja[i], 1e-12 * fabs(ja[i]));
  assert_ok(cairn_map_landmarks(map, after, WORLD_LANDMARKS, &needed, NULL));
  assert_int_equal(needed, WORLD_LANDMARKS - 1);
  for (size_t i = 0; i < needed; ++i) {
    assert_int_equal(after[i].id, ids[i]);
    assert_memory_equal(after[i].position, before[ids[i] - 1].position, sizeof after[i].position);
    assert_int_equal(after[i].observations, before[ids[i] - 1].observations);
  }
  assert_status(cairn_map_landmark(map, 5, &near[0], NULL), CAIRN_ERROR_NOT_FOUND);
  assert_ok(cairn_map_within(map, origin, 1000, near, WORLD_LANDMARKS, &needed, NULL));
  assert_int_equal(needed, WORLD_LANDMARKS - 1);
  for (size_t i = 0; i < needed; ++i) assert_int_not_equal(near[i].id, 5);
  assert_ok(cairn_filter_remove_landmark(b->shadow.filter, 5, NULL));
  bench_continue(b, 1);
  assert_ok(cairn_filter_remove_landmark(b->main.filter, 7, NULL));
  assert_ok(cairn_filter_remove_landmark(b->shadow.filter, 7, NULL));
  assert_refused(b, CAIRN_ERROR_NOT_FOUND, "id", cairn_filter_remove_landmark(b->main.filter, 7, NULL));
}

static void every_landmark_can_be_removed_and_placed_again(void** state) {
  bench* b = *state;
  size_t count;
  cairn_landmark landmark;
  double pivot;
  for (uint64_t id = 1; id <= WORLD_LANDMARKS; ++id) {
    assert_ok(cairn_filter_remove_landmark(b->main.filter, id, NULL));
    assert_ok(cairn_filter_remove_landmark(b->shadow.filter, id, NULL));
    assert_ok(cairn_filter_audit(b->main.filter, &pivot, NULL));
    assert_true(pivot > 0);
  }
  assert_ok(cairn_map_size(cairn_filter_map(b->main.filter), &count, NULL));
  assert_int_equal(count, 0);
  bench_continue(b, 10);
  assert_ok(cairn_map_size(cairn_filter_map(b->main.filter), &count, NULL));
  assert_int_equal(count, WORLD_LANDMARKS);
  assert_ok(cairn_map_landmark(cairn_filter_map(b->main.filter), 4, &landmark, NULL));
  assert_true(landmark.observations <= 10); /* counted since it was placed again */
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(an_unknown_id_places_and_a_known_one_updates),
      cmocka_unit_test(an_outlier_is_gated_and_changes_nothing),
      cmocka_unit_test(an_outlier_does_not_touch_what_the_rest_of_its_frame_does),
      cmocka_unit_test(gates_of_probability_one_let_all_pass),
      cmocka_unit_test(a_batch_that_is_jointly_too_far_off_is_reported),
      cmocka_unit_test(a_landmark_without_an_image_is_refused),
      cmocka_unit_test(an_observation_that_places_nothing_is_refused),
      cmocka_unit_test_setup_teardown(an_empty_frame_is_a_frame, bench_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(matches_are_optional_and_unused_values_are_not_read, bench_setup, bench_teardown),
      cmocka_unit_test(an_observation_brings_its_own_noise),
      cmocka_unit_test_setup_teardown(a_removed_landmark_is_gone, bench_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(every_landmark_can_be_removed_and_placed_again, bench_setup, bench_teardown),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
