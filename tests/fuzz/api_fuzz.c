/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls every function of the library with a random mix of good and bad arguments, determined by a seed. After each
 * call it checks: the status is one of the pinned set, a failure has a one-line message, a failed call changes nothing,
 * and the state has finite numbers and variances that are not negative.
 *
 *   api_fuzz SEED CALLS [LIMIT [loose]]
 *
 * Buffers are exactly as long as the library is told, so that a sanitizer detects each byte beyond them. Half of the
 * filters are "sane": they get numbers of ordinary size and arguments that are wrong in kind (NaN, negative noise,
 * unknown ids), and their covariance must stay positive definite up to rounding. The other filters get numbers of any
 * size, or of sizes up to LIMIT and down to 1 / LIMIT. With `loose` the numbers of these other filters are not checked;
 * all other conditions must hold for them too. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "filters.h"

static slot slots[3];

static void motion(slot* s) {
  cairn_filter* f = fuzz_one_in(100) ? NULL : s->filter;
  double v[3], w[3], c[36];
  cairn_pose T;
  const double dt = fuzz_bad() ? fuzz_garbage() : fuzz_uniform(0.01, 0.5);
  const int kind = (int)fuzz_below(5);
  if (kind == 0) fuzz_check_status(cairn_filter_predict_wheels(f, dt, fuzz_number(5), fuzz_number(5), NULL));
  fuzz_numbers(v, 3, 1), fuzz_numbers(w, 3, 1);
  if (kind == 1) fuzz_check_status(cairn_filter_predict_twist(f, dt, fuzz_maybe(v), fuzz_maybe(w), NULL));
  fuzz_pose(&T), fuzz_covariance(c, 6, 1e-4);
  if (kind == 2) fuzz_check_status(cairn_filter_predict_increment(f, fuzz_maybe(&T), fuzz_maybe(c), NULL));
  if (kind == 3) {
    cairn_wheels wheels;
    fuzz_check_status(cairn_wheels_init(&wheels, sizeof wheels, NULL));
    wheels.radius = fuzz_positive(0.5), wheels.track = fuzz_positive(1), wheels.slip_sigma = fuzz_positive(0.1);
    void* given = fuzz_resized(&wheels, sizeof wheels);
    fuzz_check_status(cairn_filter_set_wheels(f, fuzz_maybe(given), NULL));
    free(given);
  }
  if (kind == 4) {
    cairn_twist_noise noise;
    fuzz_check_status(cairn_twist_noise_init(&noise, sizeof noise, NULL));
    noise.velocity_sigma[fuzz_below(3)] = fuzz_positive(0.1), noise.rate_sigma[fuzz_below(3)] = fuzz_positive(0.1);
    void* given = fuzz_resized(&noise, sizeof noise);
    fuzz_check_status(cairn_filter_set_twist_noise(f, fuzz_maybe(given), NULL));
    free(given);
  }
}

static void observe(slot* s) {
  const size_t count = fuzz_one_in(40) ? fuzz_below(30) : fuzz_below(s->max_observations + 1u);
  cairn_observation* o = malloc(count * sizeof *o + 1); /* + 1: never NULL */
  cairn_match* m = malloc(count * sizeof *m + 1);
  memset(m, 0x5a, count * sizeof *m);
  const int32_t by = random_sensor();
  const uint64_t first = random_id();
  for (size_t i = 0; i < count; ++i) {
    memset(&o[i], 0, sizeof o[i]);
    o[i].id = fuzz_one_in(40) ? random_id() : (first + i) % (s->max_landmarks + 2u);
    fuzz_numbers(o[i].z, 3, 10);
    if (fuzz_one_in(2)) o[i].z[0] = fuzz_uniform(0, 400), o[i].z[1] = o[i].z[0] - fuzz_uniform(0, 30);
    if (fuzz_one_in(10)) fuzz_covariance(o[i].covariance, by >= 0 && by < s->sensors ? s->rows[by] : 3, 1);
  }
  const bool asked = !fuzz_one_in(5);
  const cairn_status status = cairn_filter_update(s->filter, by, fuzz_maybe(o), count, asked ? m : NULL, NULL);
  fuzz_check_status(status);
  for (size_t i = 0; i < count; ++i) {
    if (status != CAIRN_OK) {
      HOLDS(m[i].result == 0x5a5a5a5a && m[i].reason == 0x5a5a5a5a, i);
    } else if (asked) {
      HOLDS(m[i].result >= CAIRN_RESULT_MATCHED && m[i].result <= CAIRN_RESULT_REJECTED, m[i].result);
      HOLDS((m[i].reason != CAIRN_REASON_NONE) == (m[i].result == CAIRN_RESULT_REJECTED), m[i].reason);
      HOLDS_OF_NUMBERS(s, m[i].distance >= 0 && !isnan(m[i].threshold), m[i].distance);
    }
  }
  if (by >= 0 && by < s->sensors)
    fuzz_check_status(cairn_filter_point_head(s->filter, by, fuzz_number(1), fuzz_number(1), NULL));
  free(o), free(m);
}

/* Removal, merging, splitting and deferral of landmarks. */
static void life(slot* s) {
  double lower[3], upper[3], c[9];
  cairn_match m, *out = fuzz_one_in(3) ? NULL : &m;
  switch (fuzz_below(4)) {
    case 0:
      fuzz_check_status(cairn_filter_remove_landmark(s->filter, random_id(), NULL));
      break;
    case 1:
      fuzz_check_status(cairn_filter_merge_landmarks(s->filter, random_id(), random_id(), out, NULL));
      break;
    case 2:
      fuzz_covariance(c, 3, 0.1);
      fuzz_check_status(cairn_filter_split_landmark(s->filter, random_id(), random_id(), fuzz_maybe(c), NULL));
      break;
    default:
      fuzz_numbers(lower, 3, 10);
      for (int i = 0; i < 3; ++i) upper[i] = fuzz_bad() ? fuzz_number(10) : lower[i] + fuzz_uniform(0, 40);
      fuzz_check_status(cairn_filter_set_view(s->filter, random_sensor(), fuzz_maybe(lower), fuzz_maybe(upper), NULL));
  }
}

static void absolute(slot* s) {
  double z[3], c[9], lever[3], q[4];
  cairn_match m, *out = fuzz_one_in(3) ? NULL : &m;
  fuzz_numbers(z, 3, 5), fuzz_covariance(c, 3, 0.1), fuzz_numbers(lever, 3, 1), fuzz_numbers(q, 4, 1);
  const int kind = (int)fuzz_below(3);
  s->fixed = true;
  if (kind == 0)
    fuzz_check_status(cairn_filter_update_position(s->filter, fuzz_maybe(z), fuzz_maybe(c),
                                                   fuzz_one_in(2) ? NULL : lever, out, NULL));
  if (kind == 1) fuzz_check_status(cairn_filter_update_attitude(s->filter, fuzz_maybe(q), fuzz_maybe(c), out, NULL));
  if (kind == 2)
    fuzz_check_status(cairn_filter_update_heading(s->filter, fuzz_number(4), fuzz_positive(0.2), out, NULL));
}

static void linear(slot* s) {
  const size_t rows = fuzz_one_in(30) ? fuzz_below(60) : 1 + fuzz_below(6),
               count = fuzz_below(fuzz_one_in(30) ? 20 : 4);
  double *r = malloc(rows * sizeof *r + 1), *c = malloc(rows * rows * sizeof *c + 1);
  double *jp = malloc(6 * rows * sizeof *jp + 1), *jl = malloc(3 * count * rows * sizeof *jl + 1);
  uint64_t* ids = malloc(count * sizeof *ids + 1);
  cairn_match m;
  fuzz_numbers(r, rows, 0.3), fuzz_numbers(jp, 6 * rows, 1), fuzz_numbers(jl, 3 * count * rows, 1);
  if (rows > 0) fuzz_covariance(c, rows, 0.1);
  const uint64_t first = random_id();
  for (size_t i = 0; i < count; ++i) ids[i] = fuzz_one_in(10) ? random_id() : first + i;
  fuzz_check_status(cairn_filter_update_linear(s->filter, fuzz_maybe(r), rows, fuzz_maybe(c),
                                               fuzz_one_in(4) ? NULL : jp, fuzz_maybe(ids), count, fuzz_maybe(jl),
                                               fuzz_one_in(3) ? NULL : &m, NULL));
  free(r), free(c), free(jp), free(jl), free(ids);
}

static void ask(slot* s) {
  const cairn_map* map = fuzz_one_in(60) ? NULL : cairn_filter_map(s->filter);
  const size_t capacity = fuzz_below(30), count = fuzz_below(6);
  cairn_landmark *out = malloc(capacity * sizeof *out + 1), one;
  double *matrix = malloc(capacity * 12 * sizeof *matrix + 1), a[3], b[3], nees;
  uint64_t ids[6];
  cairn_pose truth;
  size_t needed;
  fuzz_numbers(a, 3, 10), fuzz_numbers(b, 3, 10), fuzz_pose(&truth);
  for (int i = 0; i < 3 && fuzz_one_in(2); ++i) b[i] = a[i] + fabs(b[i]);
  for (size_t i = 0; i < count; ++i) ids[i] = random_id();
  switch (fuzz_below(9)) {
    case 0:
      fuzz_check_status(cairn_map_landmark(map, random_id(), fuzz_maybe_out(&one), NULL));
      break;
    case 1:
      fuzz_check_status(cairn_map_landmarks(map, fuzz_maybe_out(out), capacity, fuzz_maybe_out(&needed), NULL));
      break;
    case 2:
      fuzz_check_status(
          cairn_map_within(map, fuzz_maybe(a), fuzz_positive(10), out, capacity, fuzz_maybe_out(&needed), NULL));
      break;
    case 3:
      fuzz_check_status(
          cairn_map_nearest(map, fuzz_maybe(a), fuzz_one_in(9) ? SIZE_MAX : count, out, capacity, &needed, NULL));
      break;
    case 4:
      fuzz_check_status(
          cairn_map_in_box(map, fuzz_maybe(a), fuzz_maybe(b), out, capacity, fuzz_maybe_out(&needed), NULL));
      break;
    case 5:
      fuzz_check_status(cairn_map_joint_covariance(map, fuzz_maybe(ids), count, matrix, capacity * 12, &needed, NULL));
      break;
    case 6:
      fuzz_check_status(
          cairn_filter_joint_covariance(s->filter, fuzz_maybe(ids), count, matrix, capacity * 12, &needed, NULL));
      break;
    case 7:
      fuzz_check_status(cairn_filter_pose_nees(s->filter, fuzz_maybe(&truth), fuzz_maybe_out(&nees), NULL));
      break;
    default: {
      cairn_update_report report;
      memset(&report, 0, sizeof report);
      void* given = fuzz_resized(&report, sizeof report);
      fuzz_check_status(cairn_filter_last_update(s->filter, fuzz_maybe_out(given), NULL));
      free(given);
    }
  }
  free(out), free(matrix);
}

/* The calls about submaps must agree with each other. */
static void ask_submaps(slot* s) {
  const cairn_filter* f = fuzz_one_in(40) ? NULL : s->filter;
  cairn_pose pose, base, local, composed;
  double covariance[36];
  size_t count = 0, needed = 0, open = 0;
  cairn_closing_report report;
  memset(&report, 0, sizeof report);
  void* given = fuzz_resized(&report, sizeof report);
  fuzz_check_status(cairn_filter_last_closing(f, fuzz_maybe_out(given), NULL));
  free(given);
  fuzz_check_status(cairn_filter_local_pose(f, fuzz_maybe_out(&local), fuzz_maybe_out(covariance), NULL));
  fuzz_check_status(cairn_filter_base_pose(f, fuzz_maybe_out(&base), fuzz_maybe_out(covariance), NULL));
  fuzz_check_status(cairn_filter_submap_count(f, fuzz_maybe_out(&count), NULL));
  const size_t capacity = fuzz_below(20), index = fuzz_one_in(9) ? (size_t)fuzz_id() : fuzz_below(count + 1);
  uint64_t* ids = malloc(capacity * sizeof *ids + 1);
  fuzz_check_status(cairn_filter_submap(f, index, fuzz_maybe_out(&pose), fuzz_maybe_out(ids), capacity, &needed, NULL));
  free(ids);
  if (f == NULL) return;
  report.struct_size = sizeof report;
  HOLDS(cairn_filter_last_closing(f, &report, NULL) == CAIRN_OK, 0);
  HOLDS(cairn_filter_submap_count(f, &count, NULL) == CAIRN_OK && report.submaps <= count, report.submaps);
  HOLDS(report.status <= 0 && report.status >= CAIRN_ERROR_STATE, report.status);
  HOLDS(report.reason >= CAIRN_CLOSED_BY_NONE && report.reason <= CAIRN_CLOSED_BY_FIX, report.reason);
  if (report.status == CAIRN_OK)
    HOLDS(report.landmarks ==
              report.landmarks_new + report.landmarks_fused + report.landmarks_refused + report.landmarks_ambiguous,
          report.landmarks);
  HOLDS(cairn_map_size(cairn_filter_local_map(f), &open, NULL) == CAIRN_OK, open);
  HOLDS(cairn_filter_local_pose(f, &local, covariance, NULL) == CAIRN_OK, 0);
  check_numbers(s, covariance, 36);
  HOLDS(cairn_filter_base_pose(f, &base, covariance, NULL) == CAIRN_OK, 0);
  check_numbers(s, covariance, 36);
  for (int i = 0; i < 6; ++i) HOLDS_OF_NUMBERS(s, covariance[7 * i] >= 0, covariance[7 * i]);
  HOLDS(cairn_filter_pose(f, &pose, NULL, NULL) == CAIRN_OK, 0);
  if (s->wild) return;
  HOLDS(cairn_pose_compose(&base, &local, &composed, NULL) == CAIRN_OK, 0);
  size_t mapped = 0;
  HOLDS(cairn_map_size(cairn_filter_map(f), &mapped, NULL) == CAIRN_OK, mapped);
  /* What submap and map have in common corrects the pose, also what is still deferred; so do fixes. */
  if (s->fixed || (count > 0 && mapped > 0)) return;
  for (int i = 0; i < 3; ++i) {
    const double scale =
        1 + fabs(base.position[i]) + fabs(local.position[0]) + fabs(local.position[1]) + fabs(local.position[2]);
    HOLDS(fabs(composed.position[i] - pose.position[i]) <= 1e-9 * scale, composed.position[i] - pose.position[i]);
  }
}

static void submaps(slot* s) {
  if (fuzz_one_in(3)) {
    fuzz_check_status(cairn_filter_close_submap(fuzz_one_in(40) ? NULL : s->filter, NULL));
    return;
  }
  ask_submaps(s);
}

static void call_one(void) {
  static const char* const names[] = {"add_sensor", "motion", "observe", "absolute", "linear",
                                      "ask",        "life",   "helpers", "submaps"};
  static const unsigned char weights[] = {3, 22, 38, 9, 7, 9, 4, 3, 5};
  slot* s = &slots[fuzz_below(3)];
  uint64_t pick = fuzz_below(100);
  size_t kind = 0;
  if (s->filter == NULL || fuzz_one_in(400)) create_filter(s);
  if (s->filter == NULL) return;
  now = s;
  fuzz_wild = s->wild;
  while (pick >= weights[kind]) pick -= weights[kind++];
  if (s->sensors == 0) kind = 0;
  fuzz_operation = names[kind];
  fuzz_shadow before, after;
  fuzz_fickle = fuzz_one_in(10);
  const unsigned long long failures = fuzz_counts[0];
  fuzz_shadow_take(&before, s->filter);
  switch (kind) {
    case 0:
      add_sensor(s);
      break;
    case 1:
      motion(s);
      break;
    case 2:
      observe(s);
      break;
    case 3:
      absolute(s);
      break;
    case 4:
      linear(s);
      break;
    case 5:
      ask(s);
      break;
    case 6:
      life(s);
      break;
    case 7:
      fuzz_helpers(fuzz_check_status);
      break;
    default:
      submaps(s);
      break;
  }
  fuzz_shadow_take(&after, s->filter);
  if (fuzz_counts[0] == failures || kind == 5) /* all its calls failed, or were queries */
    HOLDS(memcmp(&before, &after, sizeof before) == 0, 0);
  check_state(s, fuzz_one_in(16));
}

int main(int argc, char** argv) {
  if (argc < 3 || argc > 5 || (argc == 5 && strcmp(argv[4], "loose") != 0)) {
    fprintf(stderr, "usage: api_fuzz SEED CALLS [LIMIT [loose]]\n");
    return 2;
  }
  const uint64_t seed = strtoull(argv[1], NULL, 10);
  fuzz_program = "api_fuzz";
  const unsigned long long calls = strtoull(argv[2], NULL, 10);
  loose = argc == 5;
  fuzz_seed(seed, argc > 3 ? strtod(argv[3], NULL) : INFINITY);
  for (fuzz_call = 1; fuzz_call <= calls; ++fuzz_call) call_one();
  for (size_t i = 0; i < sizeof slots / sizeof slots[0]; ++i) {
    if (slots[i].filter != NULL) check_state(&slots[i], true);
    cairn_filter_destroy(slots[i].filter);
  }
  printf("seed %llu: %llu calls", (unsigned long long)seed, calls);
  for (int i = 0; i < 10; ++i) printf(", %s %llu", cairn_status_name(-i), fuzz_counts[i]);
  printf("; %llu wild states without a positive pivot\n", states_without_positive_pivot);
  /* A run in which no call succeeds proves nothing. */
  return calls >= 1000 && fuzz_counts[0] < calls / 4;
}
