/* SPDX-License-Identifier: BSD-3-Clause */
/* The life of a filter: options, creation, queries about itself, removed landmarks. */
#include "support.h"

static void options_defaults(void** state) {
  cairn_filter_options o;
  (void)state;
  memset(&o, 0x5a, sizeof o);
  assert_ok(cairn_filter_options_init(&o, sizeof o, NULL));
  assert_int_equal(o.struct_size, sizeof o);
  assert_int_equal(o.state_error, CAIRN_STATE_ERROR_INVARIANT);
  assert_int_equal(o.max_landmarks, 1000);
  assert_int_equal(o.max_observations, 64);
  assert_int_equal(o.max_sensors, 8);
  assert_int_equal(o.iterations, 3);
  assert_true(o.join_loss == CAIRN_LOSS_NONE && o.join_loss_width == 1.5);
  assert_true(o.iteration_tolerance == 0.1 && o.gate_probability == 0.999 && o.batch_gate_probability == 0.9999);
  for (int i = 0; i < 3; ++i) assert_true(o.initial_pose.position[i] == 0 && o.initial_pose.quaternion[i + 1] == 0);
  assert_true(o.initial_pose.quaternion[0] == 1);
  for (int i = 0; i < 36; ++i) assert_true(o.initial_covariance[i] == 0);
}

static void options_init_fills_at_most_what_it_is_given(void** state) {
  static const size_t none[] = {0, 1, 3, (size_t)1 << 31, (size_t)1 << 32, SIZE_MAX};
  cairn_filter_options whole, part;
  unsigned char a[sizeof whole], b[sizeof whole];
  (void)state;
  assert_ok(cairn_filter_options_init(&whole, sizeof whole, NULL));
  memcpy(a, &whole, sizeof a);
  for (size_t size = 8; size < sizeof whole; ++size) {
    memset(&part, 0x5a, sizeof part);
    assert_ok(cairn_filter_options_init(&part, size, NULL));
    memcpy(b, &part, sizeof b);
    assert_int_equal(part.struct_size, size);
    assert_memory_equal(a + 4, b + 4, size - 4);
    for (size_t i = size; i < sizeof b; ++i) assert_int_equal(b[i], 0x5a);
  }
  memset(&part, 0x5a, sizeof part);
  for (size_t n = 0; n < LENGTH(none); ++n)
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "struct_size", cairn_filter_options_init(&part, none[n], NULL));
  memcpy(b, &part, sizeof b);
  for (size_t i = 0; i < sizeof b; ++i) assert_int_equal(b[i], 0x5a);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options", cairn_filter_options_init(NULL, sizeof part, NULL));
}

/* Neither function accepts them, and the caller's variable stays unchanged. */
static void refuse_options(const cairn_filter_options* options, const char* name) {
  cairn_filter *filter = (cairn_filter*)(void*)&filter, *const kept = filter;
  size_t bytes = 4711;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, name, cairn_filter_create(options, &filter, NULL));
  assert_ptr_equal(filter, kept);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, name, cairn_filter_required_bytes(options, &bytes, NULL));
  assert_int_equal(bytes, 4711);
}

static void options_out_of_range_are_refused_one_by_one(void** state) {
  const cairn_filter_options good = test_options();
  static const struct {
    const char* name;
    size_t offset;
    uint32_t last;
  } counts[] = {{"max_landmarks", offsetof(cairn_filter_options, max_landmarks), 30000},
                {"max_observations", offsetof(cairn_filter_options, max_observations), 4096},
                {"max_sensors", offsetof(cairn_filter_options, max_sensors), 256},
                {"iterations", offsetof(cairn_filter_options, iterations), 50}};
  (void)state;
  for (size_t k = 0; k < LENGTH(counts); ++k) {
    const uint32_t bad[] = {0, counts[k].last + 1, (uint32_t)1 << 31, UINT32_MAX};
    for (size_t n = 0; n < LENGTH(bad); ++n) {
      cairn_filter_options o = good;
      memcpy((unsigned char*)&o + counts[k].offset, &bad[n], sizeof bad[n]);
      refuse_options(&o, counts[k].name);
    }
    cairn_filter_options edge = good;
    size_t bytes = 0;
    memcpy((unsigned char*)&edge + counts[k].offset, &counts[k].last, sizeof counts[k].last);
    assert_ok(cairn_filter_required_bytes(&edge, &bytes, NULL));
    assert_true(bytes > 0);
  }
  static const int32_t errors[] = {-1, 2, INT32_MIN, INT32_MAX};
  for (size_t n = 0; n < LENGTH(errors); ++n) {
    cairn_filter_options o = good;
    o.state_error = errors[n];
    refuse_options(&o, "error");
  }
  const double bad[] = {NAN, INFINITY, -INFINITY, 0, -0.5, 1.0000001};
  for (size_t n = 0; n < LENGTH(bad); ++n) {
    cairn_filter_options o = good;
    o.gate_probability = bad[n];
    refuse_options(&o, "gate_probability");
    o = good;
    o.batch_gate_probability = bad[n];
    refuse_options(&o, "batch_gate_probability");
    if (n == 5) continue; /* a tolerance above 1 is allowed */
    o = good;
    o.iteration_tolerance = bad[n];
    refuse_options(&o, "iteration_tolerance");
    o = good;
    o.join_loss_width = bad[n];
    refuse_options(&o, "join_loss_width");
  }
  static const int32_t losses[] = {-1, 3, INT32_MIN, INT32_MAX};
  for (size_t n = 0; n < LENGTH(losses); ++n) {
    cairn_filter_options o = good;
    o.join_loss = losses[n];
    refuse_options(&o, "join_loss");
  }
}

static void a_bad_initial_pose_is_refused(void** state) {
  const cairn_filter_options good = test_options();
  cairn_filter_options o;
  (void)state;
  for (size_t n = 0; n < LENGTH(not_finite); ++n) {
    for (int i = 0; i < 7; ++i) {
      o = good;
      *(i < 3 ? &o.initial_pose.position[i] : &o.initial_pose.quaternion[i - 3]) = not_finite[n];
      refuse_options(&o, "initial_pose");
    }
    for (int i = 0; i < 36; ++i) {
      o = good;
      o.initial_covariance[i] = o.initial_covariance[6 * (i % 6) + i / 6] = not_finite[n];
      refuse_options(&o, "initial_covariance");
    }
  }
  o = good;
  memset(o.initial_pose.quaternion, 0, sizeof o.initial_pose.quaternion);
  refuse_options(&o, "initial_pose");
  o = good;
  o.initial_covariance[1] = 1e-3; /* the symmetric entry stays 0 */
  refuse_options(&o, "initial_covariance");
  o = good;
  o.initial_covariance[14] = -1e-6;
  refuse_options(&o, "initial_covariance");
  o = good;
  o.initial_covariance[3] = o.initial_covariance[18] = 0.5; /* a correlation of 500 */
  refuse_options(&o, "initial_covariance");
  o = good;
  o.initial_covariance[21] = 0; /* semidefinite is accepted: one component is known */
  cairn_filter* filter = NULL;
  assert_ok(cairn_filter_create(&o, &filter, NULL));
  cairn_filter_destroy(filter);
}

static void nulls_and_sizes_at_creation(void** state) {
  static const uint32_t none[] = {0, 3, (uint32_t)1 << 31, UINT32_MAX};
  cairn_filter_options o = test_options();
  cairn_filter* filter = NULL;
  size_t bytes;
  (void)state;
  refuse_options(NULL, "options");
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_create(&o, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "bytes", cairn_filter_required_bytes(&o, NULL, NULL));
  for (size_t n = 0; n < LENGTH(none); ++n) {
    o.struct_size = none[n];
    refuse_options(&o, "struct_size");
  }
  cairn_filter_destroy(NULL);
  o = test_options();
  assert_ok(cairn_filter_create(&o, &filter, NULL));
  assert_non_null(filter);
  cairn_filter_destroy(filter);
  assert_ok(cairn_filter_required_bytes(&o, &bytes, NULL));
}

/* A caller whose options end at `iterations`, and a caller whose options have more fields than the library's. */
static void options_of_other_versions_work(void** state) {
  struct {
    cairn_filter_options now;
    double later[5];
  } future;
  cairn_filter_options exact, old;
  const size_t known = offsetof(cairn_filter_options, iteration_tolerance);
  snapshot a = {0, NULL}, b = {0, NULL};
  size_t bytes[3];
  (void)state;
  assert_ok(cairn_filter_options_init(&exact, sizeof exact, NULL));
  memset(&old, 0xff, sizeof old); /* NaN in the fields that the old caller does not know */
  assert_ok(cairn_filter_options_init(&old, known, NULL));
  exact.max_landmarks = old.max_landmarks = WORLD_LANDMARKS;
  exact.max_sensors = old.max_sensors = SENSORS;
  memset(&future, 0, sizeof future); /* what this library does not know must be zero */
  future.now = exact;
  future.now.struct_size = sizeof future;
  const cairn_filter_options* all[] = {&exact, &old, &future.now};
  for (size_t k = 0; k < LENGTH(all); ++k) {
    rig r;
    cairn_observation o = {3, {4, 5, 6}, {0}};
    rig_open(&r, all[k]);
    assert_ok(cairn_filter_required_bytes(all[k], &bytes[k], NULL));
    assert_int_equal(bytes[k], bytes[0]);
    for (int n = 0; n < 4; ++n) {
      o.z[1] = 5 + 0.05 * n;
      assert_ok(cairn_filter_predict_wheels(r.filter, 0.1, 1, 2, NULL));
      assert_ok(cairn_filter_update(r.filter, r.sensors[CARTESIAN], &o, 1, NULL, NULL));
    }
    snapshot_take(k == 0 ? &a : &b, r.filter);
    if (k > 0) assert_true(snapshot_same(&a, &b));
    rig_close(&r);
  }
  snapshot_free(&a);
  snapshot_free(&b);
}

static void a_new_filter_stands_at_its_start(void** state) {
  const cairn_filter_options options = test_options();
  cairn_update_report report, zero;
  cairn_pose pose;
  double covariance[36], error[6];
  size_t count = 4711;
  rig r;
  (void)state;
  rig_open(&r, &options);
  assert_ok(cairn_filter_pose(r.filter, &pose, covariance, NULL));
  assert_ok(cairn_pose_error(&options.initial_pose, &pose, error, NULL));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 1e-15);
  for (int i = 0; i < 36; ++i) assert_near(covariance[i], options.initial_covariance[i], 1e-16);
  assert_ok(cairn_map_size(cairn_filter_map(r.filter), &count, NULL));
  assert_int_equal(count, 0);
  memset(&zero, 0, sizeof zero);
  memset(&report, 0x5a, sizeof report);
  report.struct_size = zero.struct_size = sizeof report;
  assert_ok(cairn_filter_last_update(r.filter, &report, NULL));
  assert_memory_equal(&report, &zero, sizeof zero);
  rig_close(&r);
}

static void pose_queries(void** state) {
  bench* b = *state;
  cairn_pose both, alone;
  double c[36], d[36];
  assert_ok(cairn_filter_pose(b->main.filter, &both, c, NULL));
  assert_ok(cairn_filter_pose(b->main.filter, &alone, NULL, NULL));
  assert_ok(cairn_filter_pose(b->main.filter, NULL, d, NULL));
  assert_ok(cairn_filter_pose(b->main.filter, NULL, NULL, NULL));
  assert_memory_equal(&both, &alone, sizeof both);
  assert_memory_equal(c, d, sizeof c);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_pose(NULL, &both, c, NULL));
  assert_null(cairn_filter_map(NULL));
  assert_ptr_equal(cairn_filter_map(b->main.filter), cairn_filter_map(b->main.filter));
}

static void reports_of_other_versions_work(void** state) {
  bench* b = *state;
  cairn_update_report whole, part;
  struct {
    cairn_update_report now;
    unsigned char later[24];
  } future;
  static const uint32_t none[] = {0, 3, (uint32_t)1 << 31, UINT32_MAX};
  memset(&whole, 0, sizeof whole);
  whole.struct_size = sizeof whole;
  assert_ok(cairn_filter_last_update(b->main.filter, &whole, NULL));
  assert_true(whole.matched > 0 || whole.rows > 0);
  for (size_t size = 8; size < sizeof whole; size += 4) {
    memset(&part, 0x5a, sizeof part);
    part.struct_size = (uint32_t)size;
    assert_ok(cairn_filter_last_update(b->main.filter, &part, NULL));
    assert_int_equal(part.struct_size, size);
    assert_memory_equal((unsigned char*)&part + 4, (unsigned char*)&whole + 4, size - 4);
    for (size_t i = size; i < sizeof part; ++i) assert_int_equal(((unsigned char*)&part)[i], 0x5a);
  }
  memset(&future, 0x5a, sizeof future);
  future.now.struct_size = sizeof future;
  assert_ok(cairn_filter_last_update(b->main.filter, &future.now, NULL));
  assert_memory_equal((unsigned char*)&future.now + 4, (unsigned char*)&whole + 4, sizeof whole - 4);
  for (size_t n = 0; n < LENGTH(none); ++n) {
    memset(&part, 0x5a, sizeof part);
    part.struct_size = none[n];
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "struct_size", cairn_filter_last_update(b->main.filter, &part, NULL));
    assert_int_equal(part.matched, 0x5a5a5a5a);
  }
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "report", cairn_filter_last_update(b->main.filter, NULL, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_last_update(NULL, &whole, NULL));
}

static void audit_of_a_healthy_filter_is_positive(void** state) {
  bench* b = *state;
  double pivot = 0;
  assert_ok(cairn_filter_audit(b->main.filter, &pivot, NULL));
  assert_true(pivot > 0 && pivot <= 1);
  snapshot_take(&b->after, b->main.filter);
  assert_true(snapshot_same(&b->before, &b->after)); /* it uses only the workspace */
  bench_continue(b, 4);
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_audit(NULL, &pivot, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "min_pivot", cairn_filter_audit(b->main.filter, NULL, NULL));
}

static void nees_of_a_known_offset(void** state) {
  cairn_filter_options options = test_options();
  cairn_filter* filter = NULL;
  double nees = 4711;
  (void)state;
  options.initial_pose = pose_at(0, 0, 0, 0, 0, 0);
  assert_ok(cairn_filter_create(&options, &filter, NULL));
  for (int i = 0; i < 6; ++i) {
    cairn_pose truth = options.initial_pose;
    const double sigma = sqrt(options.initial_covariance[7 * i]);
    double rotation[3] = {0, 0, 0};
    if (i < 3) truth.position[i] = 2 * sigma;
    if (i >= 3) rotation[i - 3] = 2 * sigma;
    assert_ok(cairn_quaternion_exp(rotation, truth.quaternion, NULL));
    assert_ok(cairn_filter_pose_nees(filter, &truth, &nees, NULL));
    assert_near(nees, 4, 1e-9);
  }
  cairn_pose bad = options.initial_pose;
  bad.position[1] = NAN;
  nees = 4711;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "truth", cairn_filter_pose_nees(filter, &bad, &nees, NULL));
  bad = options.initial_pose, memset(bad.quaternion, 0, sizeof bad.quaternion);
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "truth", cairn_filter_pose_nees(filter, &bad, &nees, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "truth", cairn_filter_pose_nees(filter, NULL, &nees, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "nees", cairn_filter_pose_nees(filter, &options.initial_pose, NULL, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "filter",
                 cairn_filter_pose_nees(NULL, &options.initial_pose, &nees, NULL));
  cairn_filter_destroy(filter);
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  assert_ok(cairn_filter_create(&options, &filter, NULL));
  assert_refused(NULL, CAIRN_ERROR_NUMERICAL, "covariance",
                 cairn_filter_pose_nees(filter, &options.initial_pose, &nees, NULL));
  assert_true(nees == 4711);
  cairn_filter_destroy(filter);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(options_defaults),
      cmocka_unit_test(options_init_fills_at_most_what_it_is_given),
      cmocka_unit_test(options_out_of_range_are_refused_one_by_one),
      cmocka_unit_test(a_bad_initial_pose_is_refused),
      cmocka_unit_test(nulls_and_sizes_at_creation),
      cmocka_unit_test(options_of_other_versions_work),
      cmocka_unit_test(a_new_filter_stands_at_its_start),
      cmocka_unit_test_setup_teardown(pose_queries, bench_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(reports_of_other_versions_work, bench_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(audit_of_a_healthy_filter_is_positive, bench_setup, bench_teardown),
      cmocka_unit_test(nees_of_a_known_offset),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
