/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks, rigs, snapshots and benches of the tests. */
#include "support.h"

const double not_finite[3] = {NAN, INFINITY, -INFINITY};

void check_near(double actual, double expected, double tolerance, const char* what, const char* file, int line) {
  if (fabs(actual - expected) <= tolerance || actual == expected) return; /* NaN does not pass */
  print_error("%s: %.17g, expected %.17g within %g\n", what, actual, expected, tolerance);
  _fail(file, line);
}

void check_status(cairn_status actual, cairn_status expected, const char* call, const char* file, int line) {
  if (actual == expected) return;
  print_error("%s\n  gave %s, expected %s; last message: %s\n", call, cairn_status_name(actual),
              cairn_status_name(expected), cairn_last_message());
  _fail(file, line);
}

cairn_filter_options test_options(void) {
  cairn_filter_options options;
  assert_ok(cairn_filter_options_init(&options, sizeof options, NULL));
  options.max_landmarks = WORLD_LANDMARKS;
  options.max_observations = WORLD_LANDMARKS;
  options.max_sensors = SENSORS;
  options.gate_probability = 0.999;
  options.initial_pose = pose_at(5, 0, 0.5, 0.05, -0.03, PI / 2);
  for (int i = 0; i < 6; ++i) options.initial_covariance[7 * i] = i < 3 ? 1e-2 : 1e-4;
  return options;
}

void rig_open(rig* r, const cairn_filter_options* options) {
  const cairn_stereo_head head = test_head();
  const cairn_stereo_camera camera = test_camera();
  const cairn_cartesian cartesian = test_cartesian();
  const own_sensor point = test_point(), range = test_range();
  r->filter = NULL;
  assert_ok(cairn_filter_create(options, &r->filter, NULL));
  assert_ok(cairn_filter_add_stereo_head(r->filter, &head, &r->sensors[HEAD], NULL));
  assert_ok(cairn_filter_add_stereo_camera(r->filter, &camera, &r->sensors[CAMERA], NULL));
  assert_ok(cairn_filter_add_cartesian(r->filter, &cartesian, &r->sensors[CARTESIAN], NULL));
  assert_ok(add_own(r->filter, &point, &r->sensors[POINT]));
  assert_ok(add_own(r->filter, &range, &r->sensors[RANGE]));
}

void rig_close(rig* r) {
  cairn_filter_destroy(r->filter);
  r->filter = NULL;
}

cairn_status rig_take(rig* r, const frame* f, cairn_match* matches) {
  double covariance[9];
  cairn_status status = CAIRN_OK;
  if (f->motion == WHEELS) status = cairn_filter_predict_wheels(r->filter, f->dt, f->left, f->right, NULL);
  if (f->motion == TWIST) status = cairn_filter_predict_twist(r->filter, f->dt, f->velocity, f->rate, NULL);
  if (f->motion == INCREMENT)
    status = cairn_filter_predict_increment(r->filter, &f->increment, f->increment_covariance, NULL);
  if (status == CAIRN_OK && f->sensor == HEAD)
    status = cairn_filter_point_head(r->filter, r->sensors[HEAD], f->pan, f->stick, NULL);
  if (status == CAIRN_OK)
    status = cairn_filter_update(r->filter, r->sensors[f->sensor], f->observations, f->count, matches, NULL);
  if (status == CAIRN_OK && f->has_position) {
    diagonal(covariance, 3, 0.25);
    status = cairn_filter_update_position(r->filter, f->position, covariance, NULL, NULL, NULL);
  }
  if (status == CAIRN_OK && f->has_attitude) {
    diagonal(covariance, 3, 1e-4);
    status = cairn_filter_update_attitude(r->filter, f->quaternion, covariance, NULL, NULL);
  }
  if (status == CAIRN_OK && f->has_heading)
    status = cairn_filter_update_heading(r->filter, f->heading, 0.02, NULL, NULL);
  return status;
}

void snapshot_free(snapshot* s) {
  free(s->bytes);
  s->bytes = NULL;
  s->size = 0;
}

cairn_update_report last_update(const cairn_filter* filter) {
  cairn_update_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(cairn_filter_last_update(filter, &report, NULL));
  return report;
}

size_t check_same_matches(const cairn_match* known, const cairn_match* found, size_t count, uint64_t* name_of) {
  size_t matched = 0;
  for (size_t i = 0; i < count; ++i) {
    assert_int_equal(found[i].result, known[i].result);
    if (found[i].result == CAIRN_RESULT_NEW) name_of[found[i].landmark] = known[i].landmark;
    if (found[i].result != CAIRN_RESULT_MATCHED) continue;
    assert_int_equal(name_of[found[i].landmark], known[i].landmark);
    ++matched;
  }
  return matched;
}

int check_one_of_two_matches(const cairn_match matches[2]) {
  const int matched = matches[0].result == CAIRN_RESULT_MATCHED ? 0 : 1, refused = 1 - matched;
  assert_int_equal(matches[matched].result, CAIRN_RESULT_MATCHED);
  assert_int_equal(matches[matched].landmark, matched);
  assert_int_equal(matches[refused].result, CAIRN_RESULT_REJECTED);
  assert_int_equal(matches[refused].reason, CAIRN_REASON_AMBIGUOUS);
  assert_int_equal(matches[refused].landmark, refused);
  assert_true(matches[refused].distance < matches[refused].threshold);
  return refused;
}

void check_same_pose(const cairn_filter* a, const cairn_filter* b) {
  cairn_pose pose_a, pose_b;
  double covariance_a[36], covariance_b[36];
  assert_ok(cairn_filter_pose(a, &pose_a, covariance_a, NULL));
  assert_ok(cairn_filter_pose(b, &pose_b, covariance_b, NULL));
  assert_memory_equal(&pose_a, &pose_b, sizeof pose_a);
  assert_memory_equal(covariance_a, covariance_b, sizeof covariance_a);
}

void snapshot_take(snapshot* s, const cairn_filter* filter) {
  const cairn_map* map = cairn_filter_map(filter);
  size_t n = 0, needed = 0;
  assert_non_null(map);
  assert_ok(cairn_map_size(map, &n, NULL));
  const size_t side = 6 + 3 * n;
  const size_t head = sizeof(cairn_pose) + 36 * sizeof(double) + sizeof(cairn_update_report);
  snapshot_free(s);
  s->size = head + n * sizeof(cairn_landmark) + side * side * sizeof(double);
  s->bytes = calloc(1, s->size);
  assert_non_null(s->bytes);

  cairn_pose pose;
  double covariance[36];
  const cairn_update_report report = last_update(filter);
  assert_ok(cairn_filter_pose(filter, &pose, covariance, NULL));
  memcpy(s->bytes, &pose, sizeof pose);
  memcpy(s->bytes + sizeof pose, covariance, sizeof covariance);
  memcpy(s->bytes + sizeof pose + sizeof covariance, &report, sizeof report);
  cairn_landmark* landmarks = (cairn_landmark*)(void*)(s->bytes + head);
  assert_ok(cairn_map_landmarks(map, n == 0 ? NULL : landmarks, n, &needed, NULL));
  assert_int_equal(needed, n);
  uint64_t* ids = calloc(n + 1, sizeof *ids);
  assert_non_null(ids);
  for (size_t i = 0; i < n; ++i) ids[i] = landmarks[i].id;
  double* joint = (double*)(void*)(s->bytes + head + n * sizeof(cairn_landmark));
  assert_ok(cairn_filter_joint_covariance(filter, n == 0 ? NULL : ids, n, joint, side * side, &needed, NULL));
  assert_int_equal(needed, side * side);
  free(ids);
}

bool snapshot_same(const snapshot* a, const snapshot* b) {
  return a->size == b->size && memcmp(a->bytes, b->bytes, a->size) == 0;
}

void bench_open(bench* b, const cairn_filter_options* options, unsigned steps) {
  memset(b, 0, sizeof *b);
  world_init(&b->world, 20240229);
  rig_open(&b->main, options);
  rig_open(&b->shadow, options);
  bench_continue(b, steps);
}

void bench_close(bench* b) {
  rig_close(&b->main);
  rig_close(&b->shadow);
  snapshot_free(&b->before);
  snapshot_free(&b->after);
}

void bench_continue(bench* b, unsigned steps) {
  for (unsigned i = 0; i < steps; ++i) {
    frame f;
    cairn_match main[WORLD_LANDMARKS], shadow[WORLD_LANDMARKS];
    world_frame(&b->world, &f);
    assert_ok(rig_take(&b->main, &f, main));
    assert_ok(rig_take(&b->shadow, &f, shadow));
    assert_memory_equal(main, shadow, f.count * sizeof main[0]);
    snapshot_take(&b->before, b->main.filter);
    snapshot_take(&b->after, b->shadow.filter);
    if (!snapshot_same(&b->before, &b->after)) fail_msg("two filters with the same inputs differ");
  }
  snapshot_take(&b->before, b->main.filter);
}

frame bench_until(bench* b, int sensor) {
  for (;;) {
    frame f, blind;
    world_frame(&b->world, &f);
    const bool found = f.sensor == sensor && f.count >= 4;
    blind = f;
    if (found) blind.count = 0, blind.has_position = blind.has_attitude = blind.has_heading = false;
    assert_ok(rig_take(&b->main, &blind, NULL));
    assert_ok(rig_take(&b->shadow, &blind, NULL));
    if (found) return f;
  }
}

int bench_setup(void** state) {
  bench* b = malloc(sizeof *b);
  const cairn_filter_options options = test_options();
  assert_non_null(b);
  bench_open(b, &options, 24);
  *state = b;
  return 0;
}

int bench_teardown(void** state) {
  bench_close(*state);
  free(*state);
  return 0;
}

void refusal_expected(bench* b, const char* name) {
  /* Makes another call fail first, so that an older message is not mistaken for the expected one. */
  double rest[3];
  size_t count;
  if (strstr(name, "map") == NULL)
    assert_status(cairn_map_size(NULL, &count, NULL), CAIRN_ERROR_ARGUMENT);
  else
    assert_status(cairn_quaternion_log(NULL, rest, NULL), CAIRN_ERROR_ARGUMENT);
  if (b != NULL) snapshot_take(&b->before, b->main.filter);
}

void refusal_check(bench* b, cairn_status actual, cairn_status expected, const char* name, const char* call,
                   const char* file, int line) {
  const char* message = cairn_last_message();
  if (actual != expected) {
    print_error("%s\n  gave %s, expected %s for %s; last message: %s\n", call, cairn_status_name(actual),
                cairn_status_name(expected), name, message);
    _fail(file, line);
  }
  if (strstr(message, name) == NULL || strchr(message, '\n') != NULL) {
    print_error("%s\n  the message has to name %s on one line, and is: %s\n", call, name, message);
    _fail(file, line);
  }
  if (b == NULL) return;
  snapshot_take(&b->after, b->main.filter);
  if (!snapshot_same(&b->before, &b->after)) {
    print_error("%s\n  failed, and changed the filter\n", call);
    _fail(file, line);
  }
  bench_continue(b, 2);
}
