/* SPDX-License-Identifier: BSD-3-Clause */
/* A filter allocates no memory after its creation, and cairn_filter_required_bytes returns beforehand how much it
 * needs. This program replaces the allocator of the C library (glibc) by one that counts. */
#include "interposer.h"
#include "support.h"

static void the_interposer_counts_allocations(void** state) {
  (void)state;
  arm();
  void* volatile a = malloc(100), * volatile b = calloc(3, 50), * volatile c = NULL;
  a = realloc(a, 300);
  assert_int_equal(posix_memalign((void**)&c, 64, 1000), 0);
  counter.armed = false;
  assert_int_equal(counter.calls, 5);
  assert_int_equal(counter.live, 300 + 150 + 1000);
  free(a), free(b), free(c);
}

/* Landmarks on a spiral about the origin, and a noisy observation of any of them by any sensor. */
static void spot(size_t i, double point[3]) {
  const double angle = 0.7 * (double)i, radius = 6 + 0.05 * (double)i;
  point[0] = radius * cos(angle), point[1] = radius * sin(angle), point[2] = 0.01 * (double)(i % 100) - 0.5;
}

static size_t look(world* w, int sensor, size_t first, size_t landmarks, size_t most, cairn_observation* out) {
  size_t count = 0;
  memset(out, 0, most * sizeof *out);
  for (size_t k = 0; k < landmarks && count < most; ++k) {
    double point[3];
    const size_t i = (first + k) % landmarks;
    spot(i, point);
    if (!world_see(w, sensor, 0.1, 0.05, point, out[count].z)) continue;
    for (int n = 0; n < 3; ++n) out[count].z[n] += random_normal(&w->random, sensor == CAMERA ? 1 : 0.01);
    out[count++].id = i + 1;
  }
  return count;
}

typedef struct scale {
  uint32_t landmarks, observations;
  int steps;
  int32_t error, association;
} scale;

/* Every call of a filter's life, `steps` times, while allocations are counted. */
static void live(const scale* s) {
  cairn_filter_options options = test_options();
  cairn_observation* o = calloc(s->observations, sizeof *o);
  cairn_match* m = calloc(s->observations, sizeof *m);
  const size_t rows = 3 * s->observations;
  double *residual = calloc(rows, sizeof *residual), *noise = calloc(rows * rows, sizeof *noise);
  double *jp = calloc(rows * 6, sizeof *jp), *jl = calloc(rows * rows, sizeof *jl);
  uint64_t* ids = calloc(s->observations, sizeof *ids);
  rig r;
  world w;
  size_t result[4] = {0}, reasons[6] = {0}, most = 0, failed = 0, widened = 0;
  cairn_update_report report;
  double covariance[36], small[9], pivot;
  uint64_t kept;
  cairn_pose pose;
  cairn_match one;
  assert_true(o != NULL && m != NULL && residual != NULL && noise != NULL && jp != NULL && jl != NULL && ids != NULL);
  options.max_landmarks = s->association == CAIRN_ASSOCIATION_KNOWN ? s->landmarks : 25 * s->landmarks;
  options.max_observations = s->observations;
  options.iterations = 5, options.iteration_tolerance = 1e-9, options.state_error = s->error,
  options.association = s->association;
  options.trajectory_poses = 50; /* fewer than updates */
  world_init(&w, 31);
  w.truth = options.initial_pose = pose_at(0.5, 0.3, 0.2, 0.02, 0.03, 0.1);
  rig_open(&r, &options);
  cairn_filter* f = r.filter;
  const cairn_map* map = cairn_filter_map(f);
  size_t n = look(&w, CARTESIAN, 0, s->landmarks, s->observations, o);
  assert_ok(cairn_filter_update(f, r.sensors[CARTESIAN], o, n, m, NULL));
  diagonal(covariance, 6, 1e-8), diagonal(small, 3, 1e-2), diagonal(noise, (int)rows, 1e-2);
  const double still[3] = {0, 0, 0};
  const cairn_pose stay = {{0, 0, 0}, {1, 0, 0, 0}};
  const double centre[3] = {0, 0, 0};

  arm();
  for (int step = 0; step < s->steps; ++step) {
    const int sensor = step < (int)(2 * s->landmarks / s->observations) ? CARTESIAN : step % SENSORS;
    if (step % 3 == 0) failed += cairn_filter_predict_wheels(f, 0.001, 0, 0, NULL) != CAIRN_OK;
    if (step % 3 == 1) failed += cairn_filter_predict_twist(f, 0.001, still, still, NULL) != CAIRN_OK;
    if (step % 3 == 2) failed += cairn_filter_predict_increment(f, &stay, covariance, NULL) != CAIRN_OK;
    failed += cairn_filter_point_head(f, r.sensors[HEAD], 0.1, 0.05, NULL) != CAIRN_OK;
    if (step == s->steps / 2) { /* the vehicle is carried off; then losses weigh what its sensors see */
      w.truth.position[0] += 1;
      failed += cairn_filter_set_loss(f, r.sensors[CAMERA], CAIRN_LOSS_HUBER, 1.5, NULL) != CAIRN_OK;
      failed += cairn_filter_set_loss(f, r.sensors[CARTESIAN], CAIRN_LOSS_CAUCHY, 1, NULL) != CAIRN_OK;
    }
    n = look(&w, sensor, (size_t)step * s->observations / 2, s->landmarks, s->observations, o);
    if (step % 4 == 3 && n > 2) o[1].z[0] += 30; /* an outlier, or a point behind the lens */
    failed += cairn_filter_update(f, r.sensors[sensor], o, n, m, NULL) != CAIRN_OK;
    for (size_t i = 0; i < n; ++i) ++result[m[i].result], ++reasons[m[i].reason];
    report.struct_size = sizeof report;
    failed += cairn_filter_last_update(f, &report, NULL) != CAIRN_OK;
    widened += report.widened_position > 0;
    if (n > most) most = n;
    failed +=
        cairn_filter_update_position(f, w.truth.position, small, step % 2 ? NULL : centre, &one, NULL) != CAIRN_OK;
    failed += cairn_filter_last_update(f, &report, NULL) != CAIRN_OK;
    widened += report.widened_position > 0;
    failed += cairn_filter_update_attitude(f, w.truth.quaternion, small, &one, NULL) != CAIRN_OK;
    failed += cairn_filter_update_heading(f, 0.1, 0.1, NULL, NULL) != CAIRN_OK;
    size_t known = 0, needed;
    for (size_t i = 0; i < n; ++i) {
      if (m[i].result == CAIRN_RESULT_REJECTED) continue;
      for (int k = 0; k < 3; ++k) jl[(3 * known + (size_t)k) * rows + 3 * known + (size_t)k] = 1;
      ids[known++] = m[i].landmark;
    }
    if (known == s->observations)
      failed += cairn_filter_update_linear(f, residual, rows, noise, jp, ids, known, jl, &one, NULL) != CAIRN_OK;
    failed += cairn_filter_update_linear(f, residual, 3, small, jp, NULL, 0, NULL, &one, NULL) != CAIRN_OK;
    if (step % 2 && known > 0) failed += cairn_filter_remove_landmark(f, ids[known / 2], NULL) != CAIRN_OK;
    failed += cairn_filter_pose(f, &pose, covariance, NULL) != CAIRN_OK;
    failed += cairn_filter_keep_pose(f, &kept, NULL) != CAIRN_OK;
    failed += cairn_filter_trajectory(f, kept, &pose, 1, &needed, NULL) != CAIRN_OK;
    diagonal(covariance, 6, 1e-8);
    if (step % 16 == 0) failed += cairn_filter_audit(f, &pivot, NULL) != CAIRN_OK;
    failed += cairn_map_size(map, &needed, NULL) != CAIRN_OK;
  }
  counter.armed = false;
  if (failed != 0) fail_msg("%zu calls failed; last message: %s", failed, cairn_last_message());
  if (counter.calls != 0) fail_msg("%zu allocations at %u landmarks", counter.calls, s->landmarks);
  assert_true(most == s->observations);
  assert_true(result[CAIRN_RESULT_MATCHED] > 0 && result[CAIRN_RESULT_NEW] > 0);
  assert_true(reasons[CAIRN_REASON_GATE] + reasons[CAIRN_REASON_NO_IMAGE] > 0);
  if (s->association == CAIRN_ASSOCIATION_KNOWN && s->steps >= 300) assert_true(widened > 0);
  rig_close(&r);
  free(o), free(m), free(residual), free(noise), free(jp), free(jl), free(ids);
}

static void a_small_filter_allocates_nothing(void** state) {
  (void)state;
  live(&(scale){WORLD_LANDMARKS, 6, 300, CAIRN_STATE_ERROR_INVARIANT, CAIRN_ASSOCIATION_KNOWN});
  live(&(scale){WORLD_LANDMARKS, 6, 300, CAIRN_STATE_ERROR_STANDARD, CAIRN_ASSOCIATION_KNOWN});
  live(&(scale){WORLD_LANDMARKS, 6, 300, CAIRN_STATE_ERROR_INVARIANT, CAIRN_ASSOCIATION_NEAREST});
  live(&(scale){WORLD_LANDMARKS, 6, 300, CAIRN_STATE_ERROR_INVARIANT, CAIRN_ASSOCIATION_JOINT});
}

static void a_large_filter_allocates_nothing(void** state) {
  (void)state;
  live(&(scale){300, 60, 40, CAIRN_STATE_ERROR_INVARIANT, CAIRN_ASSOCIATION_KNOWN});
  live(&(scale){300, 60, 25, CAIRN_STATE_ERROR_STANDARD, CAIRN_ASSOCIATION_KNOWN});
}

static void the_required_bytes_are_told_beforehand(void** state) {
  static const struct {
    uint32_t landmarks, observations, sensors, submap_landmarks;
    int32_t join;
  } cases[] = {{1, 1, 1, 0, 0},
               {12, 12, 5, 0, 0},
               {100, 64, 8, 0, 0},
               {1000, 64, 8, 0, 0},
               {300, 300, 16, 0, 0},
               {50, 1000, 2, 0, 0},
               {2000, 10, 256, 0, 0},
               {100, 16, 4, 20, CAIRN_JOIN_DENSE},
               {1500, 64, 8, 60, CAIRN_JOIN_DENSE},
               {10000000, 64, 8, 60, CAIRN_JOIN_SPARSE}};
  (void)state;
  for (size_t k = 0; k < LENGTH(cases); ++k) {
    cairn_filter_options options = test_options();
    cairn_filter* f = NULL;
    size_t foretold = 0;
    const cairn_stereo_head head = test_head();
    const own_sensor point = test_point();
    const cairn_stereo_camera camera = test_camera();
    options.max_landmarks = cases[k].landmarks, options.max_observations = cases[k].observations;
    options.trajectory_poses = 1000 * (uint32_t)k;
    options.max_sensors = cases[k].sensors;
    options.submap_landmarks = cases[k].submap_landmarks, options.join = cases[k].join;
    assert_ok(cairn_filter_required_bytes(&options, &foretold, NULL));
    arm();
    const cairn_status created = cairn_filter_create(&options, &f, NULL);
    const size_t at_creation = counter.live, peak_at_creation = counter.peak;
    size_t failed = 0;
    for (uint32_t i = 0; i < cases[k].sensors; ++i) {
      int32_t sensor;
      if (i % 3 == 0) failed += cairn_filter_add_stereo_head(f, &head, &sensor, NULL) != CAIRN_OK;
      if (i % 3 == 1) failed += add_own(f, &point, &sensor) != CAIRN_OK;
      if (i % 3 == 2) failed += cairn_filter_add_stereo_camera(f, &camera, &sensor, NULL) != CAIRN_OK;
    }
    const size_t peak = counter.peak;
    cairn_filter_destroy(f);
    counter.armed = false;
    assert_ok(created);
    assert_int_equal(failed, 0);
    assert_true(at_creation > 0); /* the interposer does replace the library's allocator */
    assert_int_equal(counter.live, 0);
    if (at_creation > foretold + 4096 || peak_at_creation > foretold + 4096 || peak > foretold + 4096 ||
        (double)at_creation < 0.9 * (double)foretold - 4096)
      fail_msg("%u landmarks: foretold %zu, at creation %zu (peak %zu), with sensors %zu", cases[k].landmarks, foretold,
               at_creation, peak_at_creation, peak);
  }
}

/* Each allocation of a creation fails once. The call must return a status, write nothing and leak nothing. */
static void refuse_creation(uint32_t submap_landmarks, int32_t join) {
  cairn_filter_options options = test_options();
  size_t failures = 0;
  options.submap_landmarks = submap_landmarks, options.join = join;
  for (size_t at = 1;; ++at) {
    cairn_filter* f = NULL;
    arm();
    counter.fail_at = at;
    const cairn_status status = cairn_filter_create(&options, &f, NULL);
    const size_t live = counter.live;
    counter.armed = false;
    if (status == CAIRN_OK) {
      cairn_filter_destroy(f);
      break;
    }
    assert_status(status, CAIRN_ERROR_MEMORY);
    assert_null(f);
    assert_int_equal(live, 0);
    ++failures;
  }
  assert_true(failures > 0);
}

static void lack_of_memory_is_a_status(void** state) {
  (void)state;
  refuse_creation(0, CAIRN_JOIN_AUTO);
  refuse_creation(6, CAIRN_JOIN_DENSE);
  refuse_creation(6, CAIRN_JOIN_SPARSE);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_interposer_counts_allocations), cmocka_unit_test(a_small_filter_allocates_nothing),
      cmocka_unit_test(a_large_filter_allocates_nothing),  cmocka_unit_test(the_required_bytes_are_told_beforehand),
      cmocka_unit_test(lack_of_memory_is_a_status),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
