/* SPDX-License-Identifier: BSD-3-Clause */
/* Bad values that a filter refuses: each bad value in each place. The status, the name in the message, and the state
 * are checked: the state must stay the same to the bit as that of a second filter that never got the call. */
#include "support.h"

/* Replaces one double of `values` at a time by each value that is not finite, and makes the call. */
#define FOR_EACH_SPOILT(array, call_statement)                 \
  for (size_t at = 0; at < LENGTH(array); ++at)                \
    for (size_t with = 0; with < LENGTH(not_finite); ++with) { \
      const double good = (array)[at];                         \
      (array)[at] = not_finite[with];                          \
      call_statement;                                          \
      (array)[at] = good;                                      \
    }

typedef struct matrix_case {
  const char* what;
  double values[9];
} matrix_case;
/* 3 x 3 matrices that are not covariances: not symmetric, a negative variance, an impossible correlation, indefinite,
 * negative definite. */
static const matrix_case no_covariance[] = {
    {"not symmetric", {1, 0.5, 0, 0, 1, 0, 0, 0, 1}},
    {"negative variance", {1, 0, 0, 0, -1e-6, 0, 0, 0, 1}},
    {"correlation above 1", {1, 0, 2, 0, 1, 0, 2, 0, 1}},
    {"indefinite though all pairs are fine", {1, 0.9, 0.9, 0.9, 1, -0.9, 0.9, -0.9, 1}},
    {"negative", {-1, 0, 0, 0, -1, 0, 0, 0, -1}},
};
/* Semidefinite: refused if the noise must be positive definite. */
static const matrix_case semidefinite[] = {
    {"zero", {0}},
    {"a variance of zero", {1, 0, 0, 0, 0, 0, 0, 0, 1}},
    {"rank one", {1, 1, 1, 1, 1, 1, 1, 1, 1}},
};

static void wheels_and_times(void** state) {
  bench* b = *state;
  cairn_filter* f = b->main.filter;
  static const double times[] = {0, -0.1, -0.0, NAN, INFINITY, -INFINITY};
  const double v[3] = {1, 0, 0}, w[3] = {0, 0, 0.1};
  for (size_t n = 0; n < LENGTH(times); ++n) {
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "dt", cairn_filter_predict_wheels(f, times[n], 1, 2, NULL));
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "dt", cairn_filter_predict_twist(f, times[n], v, w, NULL));
  }
  for (size_t n = 0; n < LENGTH(not_finite); ++n) {
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "left_rad_per_s",
                   cairn_filter_predict_wheels(f, 0.1, not_finite[n], 2, NULL));
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "right_rad_per_s",
                   cairn_filter_predict_wheels(f, 0.1, 1, not_finite[n], NULL));
  }
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_predict_wheels(NULL, 0.1, 1, 2, NULL));
}

static void twists(void** state) {
  bench* b = *state;
  cairn_filter* f = b->main.filter;
  double v[3] = {1, 0.1, 0.2}, w[3] = {0.1, 0.2, 0.1};
  FOR_EACH_SPOILT(v,
                  assert_refused(b, CAIRN_ERROR_ARGUMENT, "velocity", cairn_filter_predict_twist(f, 0.1, v, w, NULL)));
  FOR_EACH_SPOILT(w, assert_refused(b, CAIRN_ERROR_ARGUMENT, "rate", cairn_filter_predict_twist(f, 0.1, v, w, NULL)));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "velocity", cairn_filter_predict_twist(f, 0.1, NULL, w, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "rate", cairn_filter_predict_twist(f, 0.1, v, NULL, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_predict_twist(NULL, 0.1, v, w, NULL));
}

static void increments(void** state) {
  bench* b = *state;
  cairn_filter* f = b->main.filter;
  cairn_pose move = pose_at(0.3, 0.1, 0.05, 0.02, 0.01, 0.1);
  double c[36];
  diagonal(c, 6, 1e-4);
  FOR_EACH_SPOILT(move.position, assert_refused(b, CAIRN_ERROR_ARGUMENT, "T_before_after",
                                                cairn_filter_predict_increment(f, &move, c, NULL)));
  FOR_EACH_SPOILT(move.quaternion, assert_refused(b, CAIRN_ERROR_ARGUMENT, "T_before_after",
                                                  cairn_filter_predict_increment(f, &move, c, NULL)));
  FOR_EACH_SPOILT(
      c, assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", cairn_filter_predict_increment(f, &move, c, NULL)));
  cairn_pose zero = move;
  memset(zero.quaternion, 0, sizeof zero.quaternion);
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_filter_predict_increment(f, &zero, c, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "T_before_after", cairn_filter_predict_increment(f, NULL, c, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", cairn_filter_predict_increment(f, &move, NULL, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_predict_increment(NULL, &move, c, NULL));
  for (size_t n = 0; n < LENGTH(no_covariance); ++n)
    for (int block = 0; block < 4; ++block) { /* in each corner of the 6x6 */
      diagonal(c, 6, 4);
      for (int i = 0; i < 9; ++i) {
        const int row = i / 3 + 3 * (block & 1), column = i % 3 + 3 * (block & 1);
        if (block < 2) c[6 * row + column] = no_covariance[n].values[i];
      }
      if (block == 2) c[3] = 0.5;                     /* correlates two blocks, without the symmetric entry */
      if (block == 3) c[5] = c[30] = 4.1 + (double)n; /* correlates two blocks more than the variances allow */
      assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", cairn_filter_predict_increment(f, &move, c, NULL));
    }
}

/* Frames in which one observation is bad and the others would change the state. No observation may be used, and the
 * caller's matches must stay unchanged. */
static frame frame_of(bench* b, int sensor) {
  frame f = bench_until(b, sensor);
  for (size_t i = 0; i < f.count; ++i) f.observations[i].z[0] *= 1.01;
  return f;
}

static void refuse_frame(bench* b, const frame* f, cairn_status status, const char* name) {
  cairn_match matches[WORLD_LANDMARKS + 1], kept[WORLD_LANDMARKS + 1];
  memset(matches, 0xa5, sizeof matches);
  memset(kept, 0xa5, sizeof kept);
  assert_refused(
      b, status, name,
      cairn_filter_update(b->main.filter, b->main.sensors[f->sensor], f->observations, f->count, matches, NULL));
  assert_memory_equal(matches, kept, sizeof kept);
  assert_refused(
      b, status, name,
      cairn_filter_update(b->main.filter, b->main.sensors[f->sensor], f->observations, f->count, NULL, NULL));
}

static void values_of_observations(void** state) {
  bench* b = *state;
  for (int sensor = 0; sensor < SENSORS; ++sensor)
    for (size_t n = 0; n < LENGTH(not_finite); ++n)
      for (int k = 0; k < (sensor == RANGE ? 1 : 3); ++k)
        for (int last = 0; last < 2; ++last) {
          frame f = frame_of(b, sensor);
          f.observations[last ? f.count - 1 : 0].z[k] = not_finite[n];
          refuse_frame(b, &f, CAIRN_ERROR_ARGUMENT, "observations");
        }
}

static void noise_of_observations(void** state) {
  bench* b = *state;
  for (int sensor = 0; sensor < RANGE; ++sensor) {
    for (size_t n = 0; n < LENGTH(not_finite); ++n)
      for (int k = 0; k < 9; ++k) {
        frame f = frame_of(b, sensor);
        diagonal(f.observations[f.count - 1].covariance, 3, 1);
        f.observations[f.count - 1].covariance[k] = not_finite[n];
        refuse_frame(b, &f, CAIRN_ERROR_ARGUMENT, "covariance");
      }
    for (size_t n = 0; n < LENGTH(no_covariance) + LENGTH(semidefinite) - 1; ++n) {
      /* all zero is left out: it selects the noise of the sensor */
      const double* c =
          n < LENGTH(no_covariance) ? no_covariance[n].values : semidefinite[n - LENGTH(no_covariance) + 1].values;
      frame f = frame_of(b, sensor);
      memcpy(f.observations[f.count - 1].covariance, c, 9 * sizeof c[0]);
      refuse_frame(b, &f, CAIRN_ERROR_ARGUMENT, "covariance");
    }
  }
  frame f = frame_of(b, RANGE);
  f.observations[1].covariance[0] = -0.01;
  refuse_frame(b, &f, CAIRN_ERROR_ARGUMENT, "covariance");
}

static void ids_of_observations(void** state) {
  bench* b = *state;
  frame f = frame_of(b, CARTESIAN);
  f.observations[f.count - 1].id = CAIRN_ID_NONE;
  refuse_frame(b, &f, CAIRN_ERROR_ARGUMENT, "observations");
  f = frame_of(b, HEAD);
  f.observations[f.count - 1].id = f.observations[0].id;
  refuse_frame(b, &f, CAIRN_ERROR_ARGUMENT, "observations");
  f = frame_of(b, CARTESIAN); /* the same new landmark twice */
  assert_ok(cairn_filter_remove_landmark(b->main.filter, f.observations[1].id, NULL));
  assert_ok(cairn_filter_remove_landmark(b->shadow.filter, f.observations[1].id, NULL));
  f.observations[0].id = f.observations[1].id;
  refuse_frame(b, &f, CAIRN_ERROR_ARGUMENT, "observations");
}

static void sensors_of_frames(void** state) {
  bench* b = *state;
  static const int32_t unknown[] = {-1, SENSORS, 99, INT32_MAX, INT32_MIN};
  frame f = frame_of(b, CARTESIAN);
  cairn_match matches[WORLD_LANDMARKS], kept[WORLD_LANDMARKS];
  memset(matches, 0xa5, sizeof matches);
  memset(kept, 0xa5, sizeof kept);
  for (size_t n = 0; n < LENGTH(unknown); ++n) {
    assert_refused(b, CAIRN_ERROR_NOT_FOUND, "sensor",
                   cairn_filter_update(b->main.filter, unknown[n], f.observations, f.count, matches, NULL));
    assert_refused(b, CAIRN_ERROR_NOT_FOUND, "sensor",
                   cairn_filter_update(b->main.filter, unknown[n], NULL, 0, NULL, NULL));
  }
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter",
                 cairn_filter_update(NULL, 0, f.observations, f.count, matches, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "observations",
                 cairn_filter_update(b->main.filter, b->main.sensors[CARTESIAN], NULL, f.count, matches, NULL));
  assert_memory_equal(matches, kept, sizeof kept);
}

static void capacities(void** state) {
  bench* b = *state;
  frame f;
  cairn_observation many[WORLD_LANDMARKS + 1];
  cairn_match matches[WORLD_LANDMARKS + 1], kept[WORLD_LANDMARKS + 1];
  memset(matches, 0xa5, sizeof matches);
  memset(kept, 0xa5, sizeof kept);
  f = frame_of(b, RANGE);
  memset(many, 0, sizeof many);
  memcpy(many, f.observations, sizeof f.observations);
  many[WORLD_LANDMARKS] = many[0];
  many[WORLD_LANDMARKS].id = 1001;
  assert_refused(b, CAIRN_ERROR_CAPACITY, "max_observations",
                 cairn_filter_update(b->main.filter, b->main.sensors[RANGE], many, WORLD_LANDMARKS + 1, matches, NULL));
  assert_refused(b, CAIRN_ERROR_CAPACITY, "max_observations",
                 cairn_filter_update(b->main.filter, b->main.sensors[RANGE], many, SIZE_MAX / 2, matches, NULL));
  assert_memory_equal(matches, kept, sizeof kept);
  f = frame_of(b, RANGE); /* the map is full, but this observation cannot place a landmark: a match, not an error */
  f.observations[0].id = 1002;
  cairn_match m[WORLD_LANDMARKS];
  for (int k = 0; k < 2; ++k)
    assert_ok(cairn_filter_update(k == 0 ? b->main.filter : b->shadow.filter, b->main.sensors[RANGE], f.observations,
                                  f.count, m, NULL));
  assert_int_equal(m[0].reason, CAIRN_REASON_NO_PLACE);
}

static void absolute_position(void** state) {
  bench* b = *state;
  cairn_filter* f = b->main.filter;
  double z[3] = {1, 2, 3}, c[9], lever[3] = {0.1, 0.2, 0.3};
  cairn_match m, kept;
  memset(&m, 0xa5, sizeof m), kept = m;
  diagonal(c, 3, 1e3); /* no gate refuses anything */
  FOR_EACH_SPOILT(
      z, assert_refused(b, CAIRN_ERROR_ARGUMENT, "position", cairn_filter_update_position(f, z, c, lever, &m, NULL)));
  FOR_EACH_SPOILT(
      c, assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", cairn_filter_update_position(f, z, c, lever, &m, NULL)));
  FOR_EACH_SPOILT(lever, assert_refused(b, CAIRN_ERROR_ARGUMENT, "lever_arm",
                                        cairn_filter_update_position(f, z, c, lever, &m, NULL)));
  for (size_t n = 0; n < LENGTH(no_covariance); ++n)
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance",
                   cairn_filter_update_position(f, z, no_covariance[n].values, NULL, &m, NULL));
  for (size_t n = 0; n < LENGTH(semidefinite); ++n)
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance",
                   cairn_filter_update_position(f, z, semidefinite[n].values, NULL, &m, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "position", cairn_filter_update_position(f, NULL, c, lever, &m, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", cairn_filter_update_position(f, z, NULL, lever, &m, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_update_position(NULL, z, c, lever, &m, NULL));
  assert_memory_equal(&m, &kept, sizeof m);
}

static void absolute_attitude_and_heading(void** state) {
  bench* b = *state;
  cairn_filter* f = b->main.filter;
  static const double sigmas[] = {0, -0.1, NAN, INFINITY, -INFINITY};
  double q[4] = {0.5, 0.5, 0.5, 0.5}, c[9], zero[4] = {0, 0, 0, 0};
  cairn_match m, kept;
  memset(&m, 0xa5, sizeof m), kept = m;
  diagonal(c, 3, 10);
  FOR_EACH_SPOILT(
      q, assert_refused(b, CAIRN_ERROR_ARGUMENT, "quaternion", cairn_filter_update_attitude(f, q, c, &m, NULL)));
  FOR_EACH_SPOILT(
      c, assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", cairn_filter_update_attitude(f, q, c, &m, NULL)));
  for (size_t n = 0; n < LENGTH(no_covariance); ++n)
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance",
                   cairn_filter_update_attitude(f, q, no_covariance[n].values, &m, NULL));
  for (size_t n = 0; n < LENGTH(semidefinite); ++n)
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance",
                   cairn_filter_update_attitude(f, q, semidefinite[n].values, &m, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "quaternion", cairn_filter_update_attitude(f, zero, c, &m, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "quaternion", cairn_filter_update_attitude(f, NULL, c, &m, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", cairn_filter_update_attitude(f, q, NULL, &m, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_update_attitude(NULL, q, c, &m, NULL));
  for (size_t n = 0; n < LENGTH(not_finite); ++n)
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "heading", cairn_filter_update_heading(f, not_finite[n], 0.1, &m, NULL));
  for (size_t n = 0; n < LENGTH(sigmas); ++n)
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "sigma", cairn_filter_update_heading(f, 0.1, sigmas[n], &m, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_update_heading(NULL, 0.1, 0.1, &m, NULL));
  assert_memory_equal(&m, &kept, sizeof m);
}

static void linear(void** state) {
  bench* b = *state;
  cairn_filter* f = b->main.filter;
  double r[3] = {0.1, 0.2, 0.3}, c[9], jp[18] = {1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, jl[18] = {0.1};
  const uint64_t ids[2] = {4, 2}, unknown[2] = {4, 4711}, twice[2] = {4, 4}, none[2] = {4, CAIRN_ID_NONE};
  static uint64_t many[WORLD_LANDMARKS + 1];
  cairn_match m, kept;
  memset(&m, 0xa5, sizeof m), kept = m;
  diagonal(c, 3, 1e3);
#define LINEAR(...) cairn_filter_update_linear(f, __VA_ARGS__, &m, NULL)
  FOR_EACH_SPOILT(r, assert_refused(b, CAIRN_ERROR_ARGUMENT, "residual", LINEAR(r, 3, c, jp, ids, 2, jl)));
  FOR_EACH_SPOILT(c, assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", LINEAR(r, 3, c, jp, ids, 2, jl)));
  FOR_EACH_SPOILT(jp, assert_refused(b, CAIRN_ERROR_ARGUMENT, "jacobian_pose", LINEAR(r, 3, c, jp, ids, 2, jl)));
  FOR_EACH_SPOILT(jl, assert_refused(b, CAIRN_ERROR_ARGUMENT, "jacobian_landmarks", LINEAR(r, 3, c, jp, ids, 2, jl)));
  for (size_t n = 0; n < LENGTH(no_covariance); ++n)
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", LINEAR(r, 3, no_covariance[n].values, jp, ids, 2, jl));
  for (size_t n = 0; n < LENGTH(semidefinite); ++n)
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", LINEAR(r, 3, semidefinite[n].values, jp, ids, 2, jl));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "residual", LINEAR(NULL, 3, c, jp, ids, 2, jl));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance", LINEAR(r, 3, NULL, jp, ids, 2, jl));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "landmarks", LINEAR(r, 3, c, jp, NULL, 2, jl));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "jacobian_landmarks", LINEAR(r, 3, c, jp, ids, 2, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter",
                 cairn_filter_update_linear(NULL, r, 3, c, jp, ids, 2, jl, &m, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "rows", LINEAR(r, 0, c, jp, ids, 2, jl));
  assert_refused(b, CAIRN_ERROR_NOT_FOUND, "landmarks", LINEAR(r, 3, c, jp, unknown, 2, jl));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "landmarks", LINEAR(r, 3, c, jp, twice, 2, jl));
  assert_refused(b, CAIRN_ERROR_NOT_FOUND, "landmarks", LINEAR(r, 3, c, jp, none, 2, jl));
  assert_refused(b, CAIRN_ERROR_CAPACITY, "rows", LINEAR(r, 3 * WORLD_LANDMARKS + 1, c, jp, ids, 2, jl));
  assert_refused(b, CAIRN_ERROR_CAPACITY, "rows", LINEAR(r, SIZE_MAX, c, jp, ids, 2, jl));
  assert_refused(b, CAIRN_ERROR_CAPACITY, "count", LINEAR(r, 3, c, jp, many, WORLD_LANDMARKS + 1, jl));
  assert_refused(b, CAIRN_ERROR_CAPACITY, "count", LINEAR(r, 3, c, jp, many, SIZE_MAX / 8, jl));
  assert_memory_equal(&m, &kept, sizeof m);
#undef LINEAR
}

static void removal(void** state) {
  bench* b = *state;
  assert_refused(b, CAIRN_ERROR_NOT_FOUND, "id", cairn_filter_remove_landmark(b->main.filter, 4711, NULL));
  assert_refused(b, CAIRN_ERROR_NOT_FOUND, "id", cairn_filter_remove_landmark(b->main.filter, CAIRN_ID_NONE, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_remove_landmark(NULL, 1, NULL));
}

static void losses(void** state) {
  bench* b = *state;
  cairn_filter* f = b->main.filter;
  const int32_t sensor = b->main.sensors[CARTESIAN];
  static const int32_t unknown[] = {-1, 3, INT32_MIN, INT32_MAX};
  static const double widths[] = {0, -1, NAN, INFINITY, -INFINITY, 1.1e6};
  for (size_t n = 0; n < LENGTH(unknown); ++n)
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "loss", cairn_filter_set_loss(f, sensor, unknown[n], 1, NULL));
  for (size_t n = 0; n < LENGTH(widths); ++n) {
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "width",
                   cairn_filter_set_loss(f, sensor, CAIRN_LOSS_HUBER, widths[n], NULL));
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "width",
                   cairn_filter_set_loss(f, sensor, CAIRN_LOSS_CAUCHY, widths[n], NULL));
  }
  assert_refused(b, CAIRN_ERROR_NOT_FOUND, "sensor", cairn_filter_set_loss(f, SENSORS, CAIRN_LOSS_HUBER, 1, NULL));
  assert_refused(b, CAIRN_ERROR_NOT_FOUND, "sensor", cairn_filter_set_loss(f, -1, CAIRN_LOSS_NONE, 1, NULL));
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_set_loss(NULL, sensor, CAIRN_LOSS_HUBER, 1, NULL));
  assert_ok(cairn_filter_set_loss(f, sensor, CAIRN_LOSS_NONE, NAN, NULL)); /* ignores the width */
}

/* A result that would not be finite is a numerical error, and the state stays unchanged. */
static void overflow(void** state) {
  bench* b = *state;
  cairn_filter* f = b->main.filter;
  const double huge[3] = {1e300, 1e300, 1e300}, still[3] = {0, 0, 0};
  double covariance[36];
  cairn_pose far = pose_at(1e308, 0, 0, 0, 0, 0);
  assert_refused(b, CAIRN_ERROR_NUMERICAL, "", cairn_filter_predict_twist(f, 1e10, huge, still, NULL));
  assert_refused(b, CAIRN_ERROR_NUMERICAL, "", cairn_filter_predict_wheels(f, 1e200, 1e200, 1e200, NULL));
  const double fast[3] = {1e10, 0, 0};
  assert_refused(b, CAIRN_ERROR_NUMERICAL, "longer than 1e+09 m", cairn_filter_predict_twist(f, 1, fast, still, NULL));
  diagonal(covariance, 6, 0.01);
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "T_before_after.position[0]",
                 cairn_filter_predict_increment(f, &far, covariance, NULL));
  far.position[0] = 0;
  covariance[7] = 1e19;
  assert_refused(b, CAIRN_ERROR_NUMERICAL, "position's noise",
                 cairn_filter_predict_increment(f, &far, covariance, NULL));
  for (int i = 0; i < 6; ++i) {
    diagonal(covariance, 6, 0.01);
    covariance[7 * i] = i % 2 == 0 ? 1e308 : 1e-320;
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "covariance: the variance at",
                   cairn_filter_predict_increment(f, &far, covariance, NULL));
  }
}

static int32_t poisoned_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                                double* jacobian_pose, double* jacobian_landmark) {
  (void)point_predict(NULL, pose, landmark, z, jacobian_pose, jacobian_landmark);
  const int where = *(const int*)user;
  if (where == 0) z[1] = NAN;
  if (where == 1) jacobian_pose[7] = INFINITY;
  if (where == 2) jacobian_landmark[4] = NAN;
  return where != 3;
}

static int32_t poisoned_place(void* user, const cairn_pose* pose, const double* z, double landmark[3],
                              double* jacobian_pose, double* jacobian_z) {
  (void)point_place(NULL, pose, z, landmark, jacobian_pose, jacobian_z);
  const int where = *(const int*)user;
  if (where == 0) landmark[1] = NAN;
  if (where == 1) jacobian_pose[7] = INFINITY;
  if (where == 2) jacobian_z[4] = NAN;
  return where != 3;
}

/* A callback that gives no numbers refuses, like a callback that returns 0: a match, and the state stays
 * unchanged. */
static void a_custom_sensor_that_gives_no_numbers_is_refused(void** state) {
  cairn_filter_options options = test_options();
  bench b;
  int where = -1;
  int32_t sensor = -1;
  (void)state;
  options.max_sensors = SENSORS + 1, options.max_landmarks = WORLD_LANDMARKS + 1;
  bench_open(&b, &options, 12);
  own_sensor custom = test_point();
  custom.predict = poisoned_predict, custom.place = poisoned_place, custom.user = &where;
  assert_ok(add_own(b.main.filter, &custom, &sensor));
  cairn_observation o[2];
  memset(o, 0, sizeof o);
  o[0].id = 1, o[1].id = 500;
  to_body(&b.world.truth, b.world.landmarks[0], o[0].z);
  o[1].z[0] = 5, o[1].z[1] = 1;
  for (where = 0; where < 4; ++where) {
    cairn_match m[2];
    assert_ok(cairn_filter_update(b.main.filter, sensor, o, 2, m, NULL));
    assert_int_equal(m[0].result, CAIRN_RESULT_REJECTED);
    assert_int_equal(m[0].reason, CAIRN_REASON_NO_IMAGE);
    assert_int_equal(m[1].result, CAIRN_RESULT_REJECTED);
    assert_int_equal(m[1].reason, CAIRN_REASON_NO_PLACE);
    bench_continue(&b, 3);
  }
  to_body(&b.world.truth, b.world.landmarks[0], o[0].z);
  where = -1; /* with numbers it is an ordinary sensor */
  cairn_match m[2];
  assert_ok(cairn_filter_update(b.main.filter, sensor, o, 2, m, NULL));
  assert_int_equal(m[0].result, CAIRN_RESULT_MATCHED);
  assert_int_equal(m[1].result, CAIRN_RESULT_NEW);
  bench_close(&b);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, bench_setup, bench_teardown)
  const struct CMUnitTest tests[] = {
      TEST(wheels_and_times),
      TEST(twists),
      TEST(increments),
      TEST(values_of_observations),
      TEST(noise_of_observations),
      TEST(ids_of_observations),
      TEST(sensors_of_frames),
      TEST(capacities),
      TEST(absolute_position),
      TEST(absolute_attitude_and_heading),
      TEST(linear),
      TEST(removal),
      TEST(losses),
      TEST(overflow),
      cmocka_unit_test(a_custom_sensor_that_gives_no_numbers_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
