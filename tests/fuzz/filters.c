/* SPDX-License-Identifier: BSD-3-Clause */
/* Creation, sensors and checks of the filters that api_fuzz calls. */
#include "filters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

slot* now;
bool loose;
unsigned long long states_without_positive_pivot;

void check_numbers(const slot* s, const double* values, size_t count) {
  for (size_t i = 0; i < count; ++i) HOLDS_OF_NUMBERS(s, isfinite(values[i]), values[i]);
}

void check_state(const slot* s, bool whole) {
  cairn_pose pose;
  double covariance[36], length = 0, pivot = NAN;
  size_t n = 0, needed = 0;
  HOLDS(cairn_filter_pose(s->filter, &pose, covariance, NULL) == CAIRN_OK, 0);
  check_numbers(s, pose.position, 3);
  check_numbers(s, pose.quaternion, 4);
  for (int i = 0; i < 4; ++i) length += pose.quaternion[i] * pose.quaternion[i];
  HOLDS_OF_NUMBERS(s, fabs(length - 1) < 1e-9, length);
  check_numbers(s, covariance, 36);
  for (int i = 0; i < 6; ++i) HOLDS_OF_NUMBERS(s, covariance[7 * i] >= 0, covariance[7 * i]);
  for (int i = 0; i < 36; ++i) HOLDS_OF_NUMBERS(s, covariance[i] == covariance[6 * (i % 6) + i / 6], covariance[i]);
  const cairn_map* map = cairn_filter_map(s->filter);
  HOLDS(map != NULL && cairn_map_size(map, &n, NULL) == CAIRN_OK && n <= s->max_landmarks, n);
  if (!whole) return;
  cairn_landmark* all = calloc(n + 1, sizeof *all);
  HOLDS(cairn_map_landmarks(map, all, n, &needed, NULL) == CAIRN_OK && needed == n, needed);
  for (size_t i = 0; i < n; ++i) {
    check_numbers(s, all[i].position, 3);
    check_numbers(s, all[i].covariance, 9);
    for (int k = 0; k < 3; ++k) HOLDS_OF_NUMBERS(s, all[i].covariance[4 * k] >= 0, all[i].covariance[4 * k]);
    HOLDS(all[i].id != CAIRN_ID_NONE && all[i].observations > 0, all[i].observations);
    if (i > 0) HOLDS(all[i - 1].id < all[i].id, all[i].id);
  }
  free(all);
  HOLDS(cairn_filter_audit(s->filter, &pivot, NULL) == CAIRN_OK, pivot);
  HOLDS_OF_NUMBERS(s, !isnan(pivot), pivot);
  if (!s->wild) HOLDS(pivot > -1e-9, pivot);
  states_without_positive_pivot += !(pivot > 0);
}

uint64_t random_id(void) {
  return fuzz_one_in(60) ? fuzz_id() : fuzz_below(now->max_landmarks + 3u);
}

int32_t random_sensor(void) {
  return fuzz_one_in(40) ? fuzz_int() : (int32_t)fuzz_below((uint64_t)now->sensors + 1);
}

static void hear(void* payload, const char* line) {
  *(size_t*)payload += strlen(line);
}
static size_t heard;

void create_filter(slot* s) {
  cairn_filter_options o;
  cairn_filter* filter = NULL;
  size_t bytes = 0;
  fuzz_operation = "create";
  fuzz_wild = true;
  fuzz_check_status(cairn_filter_options_init(&o, sizeof o, NULL));
  slot fresh = {NULL,
                fuzz_one_in(2),
                fuzz_one_in(3),
                false,
                1 + (uint32_t)fuzz_below(fuzz_one_in(10) ? 120 : 25),
                1 + (uint32_t)fuzz_below(12),
                0,
                {0}};
  o.vehicle = fuzz_one_in(60) ? fuzz_int() : fresh.planar ? CAIRN_VEHICLE_PLANAR : CAIRN_VEHICLE_SPATIAL;
  o.state_error = fuzz_one_in(3);
  o.max_landmarks = fresh.max_landmarks, o.max_observations = fresh.max_observations;
  o.max_sensors = 1 + (uint32_t)fuzz_below(10);
  o.iterations = 1 + (uint32_t)fuzz_below(6);
  if (fuzz_one_in(3)) o.gate_probability = fuzz_uniform(0.1, 1.02);
  if (fuzz_one_in(3)) o.batch_gate_probability = fuzz_one_in(2) ? 1 : fuzz_uniform(0.1, 1);
  if (fuzz_one_in(8)) o.iteration_tolerance = fuzz_garbage();
  /* A submap of thousands of landmarks takes minutes to audit: beside small ones there are some of a few hundred, and
     some beyond the range. */
  if (fuzz_one_in(2)) o.submap_landmarks = 1 + (uint32_t)fuzz_below(fuzz_one_in(20) ? 300 : 12);
  if (fuzz_one_in(100)) o.submap_landmarks = 4097 + (uint32_t)fuzz_below(1000);
  o.join = fuzz_one_in(20) ? fuzz_int() : (int32_t)fuzz_below(3);
  if (fuzz_one_in(3)) o.association = fuzz_one_in(20) ? fuzz_int() : (int32_t)fuzz_below(3);
  if (fuzz_one_in(6)) o.association_nodes = (uint32_t)fuzz_below(50);
  if (fuzz_one_in(6)) o.new_probability = fuzz_positive(0.5);
  if (fuzz_one_in(6)) o.association_distance = fuzz_one_in(20) ? fuzz_int() : (int32_t)fuzz_below(2);
  if (fuzz_one_in(4)) o.deferred_sightings = 1 + (uint32_t)fuzz_below(4), o.deferred_frames = (uint32_t)fuzz_below(9);
  if (fuzz_one_in(4)) o.missed_frames = (uint32_t)fuzz_below(4);
  if (fuzz_one_in(4)) o.error_persistence = fuzz_bad() ? fuzz_garbage() : fuzz_uniform(1, 30);
  if (fuzz_one_in(6)) o.submap_distance = fuzz_positive(5);
  if (fuzz_one_in(6)) o.submap_extent = fuzz_positive(10);
  if (fuzz_one_in(6)) o.submap_sigma = fuzz_positive(0.1);
  if (fuzz_one_in(12)) o.state_error = fuzz_int();
  now = &fresh;
  fuzz_wild = fresh.wild;
  if (fuzz_one_in(2)) fuzz_covariance(o.initial_covariance, 6, 0.01);
  if (fuzz_one_in(2)) fuzz_pose(&o.initial_pose);
  void* given = fuzz_one_in(4) ? fuzz_resized(&o, sizeof o) : NULL;
  uint32_t stated;
  if (given != NULL) memcpy(&stated, given, sizeof stated);
  /* A caller whose struct is that short would get default capacities, which are large. */
  if (given == NULL || stated < offsetof(cairn_filter_options, iterations)) {
    free(given);
    given = malloc(sizeof o);
    memcpy(given, &o, sizeof o);
  }
  const cairn_status sized = cairn_filter_required_bytes(fuzz_maybe(given), fuzz_maybe_out(&bytes), NULL);
  fuzz_check_status(sized);
  const cairn_status status = cairn_filter_create(fuzz_maybe(given), fuzz_one_in(50) ? NULL : &filter, NULL);
  fuzz_check_status(status);
  HOLDS((filter != NULL) == (status == CAIRN_OK), status);
  free(given);
  if (filter == NULL) return;
  cairn_filter_destroy(s->filter);
  *s = fresh;
  s->filter = filter;
  if (fuzz_one_in(2)) fuzz_check_status(cairn_filter_set_log(filter, hear, &heard, NULL, NULL));
  now = s;
}

static void draw_radar(cairn_range_bearing* r) {
  fuzz_check_status(cairn_range_bearing_init(r, sizeof *r, NULL));
  if (fuzz_one_in(3)) r->T_body_sensor.position[fuzz_below(2)] = fuzz_number(1);
  r->range_sigma = fuzz_positive(0.5), r->bearing_sigma = fuzz_positive(0.1);
  if (fuzz_one_in(4)) r->near_range = fuzz_positive(0.1);
}

void add_sensor(slot* s) {
  int32_t added = -77, *out = fuzz_maybe_out(&added);
  cairn_status status = CAIRN_OK;
  void* given = NULL;
  uint32_t rows = 3;
  const int kind = s->planar && !fuzz_one_in(9) ? 2 + (int)fuzz_below(4) : (int)fuzz_below(fuzz_one_in(9) ? 6 : 5);
  if (kind == 0) {
    cairn_stereo_head h;
    fuzz_check_status(cairn_stereo_head_init(&h, sizeof h, NULL));
    h.encoder_mode = fuzz_one_in(30) ? fuzz_int() : (int32_t)fuzz_below(2);
    fuzz_numbers(h.platform, 3, 1), fuzz_numbers(h.stick, 3, 1);
    if (fuzz_one_in(2)) fuzz_numbers(h.camera_quaternion, 4, 1);
    h.range_sigma = fuzz_positive(1), h.azimuth_sigma = fuzz_positive(0.1), h.elevation_sigma = fuzz_positive(0.1);
    h.pan_sigma = fuzz_positive(0.02), h.stick_sigma = fuzz_one_in(3) ? 0 : fuzz_positive(0.02);
    if (fuzz_one_in(4)) h.max_elevation = fuzz_positive(1.5);
    given = fuzz_one_in(4) ? fuzz_resized(&h, sizeof h) : memcpy(malloc(sizeof h), &h, sizeof h);
    status = cairn_filter_add_stereo_head(s->filter, fuzz_maybe(given), out, NULL);
  } else if (kind == 1) {
    cairn_stereo_camera c;
    fuzz_check_status(cairn_stereo_camera_init(&c, sizeof c, NULL));
    c.fu = fuzz_positive(500), c.fv = fuzz_positive(500), c.baseline = fuzz_positive(1), c.cu = fuzz_number(500);
    if (fuzz_one_in(3)) fuzz_pose(&c.T_body_camera);
    c.sigma[fuzz_below(3)] = fuzz_positive(2);
    given = fuzz_one_in(4) ? fuzz_resized(&c, sizeof c) : memcpy(malloc(sizeof c), &c, sizeof c);
    status = cairn_filter_add_stereo_camera(s->filter, fuzz_maybe(given), out, NULL);
  } else if (kind == 2) {
    cairn_cartesian c;
    fuzz_check_status(cairn_cartesian_init(&c, sizeof c, NULL));
    if (fuzz_one_in(2)) fuzz_pose(&c.T_body_sensor);
    c.sigma[fuzz_below(3)] = fuzz_positive(1);
    given = fuzz_one_in(4) ? fuzz_resized(&c, sizeof c) : memcpy(malloc(sizeof c), &c, sizeof c);
    status = cairn_filter_add_cartesian(s->filter, fuzz_maybe(given), out, NULL);
    if (s->planar) rows = 2;
  } else if (kind == 5) {
    cairn_range_bearing r;
    draw_radar(&r);
    given = fuzz_one_in(4) ? fuzz_resized(&r, sizeof r) : memcpy(malloc(sizeof r), &r, sizeof r);
    status = cairn_filter_add_range_bearing(s->filter, fuzz_maybe(given), out, NULL);
    rows = 2;
  } else {
    cairn_custom c;
    double worst, landmark[3];
    cairn_pose T;
    fuzz_check_status(cairn_custom_init(&c, sizeof c, NULL));
    cairn_custom_predict_fn predict = kind == 3 ? fuzz_custom_predict : fuzz_range_predict;
    cairn_custom_place_fn place = kind == 3 && !fuzz_one_in(4) ? fuzz_custom_place : NULL;
    c.rows = rows = kind == 3 ? 3 : 1;
    if (fuzz_one_in(30)) c.rows = fuzz_one_in(2) ? 0 : 4 + (uint32_t)fuzz_below(5);
    if (fuzz_one_in(30)) predict = NULL;
    c.angle_mask = (uint32_t)fuzz_below(8);
    c.sigma[0] = fuzz_positive(1);
    fuzz_pose(&T), fuzz_numbers(landmark, 3, 5);
    fuzz_check_status(cairn_custom_check(fuzz_maybe(&c), predict, place, NULL, fuzz_maybe(&T), fuzz_maybe(landmark),
                                         fuzz_maybe_out(&worst), NULL));
    given = memcpy(malloc(sizeof c), &c, sizeof c);
    status = cairn_filter_add_custom(s->filter, fuzz_maybe(given), predict, place, NULL, NULL, out, NULL);
  }
  free(given);
  fuzz_check_status(status);
  HOLDS((status == CAIRN_OK) == (added != -77), added);
  if (status != CAIRN_OK) return;
  HOLDS(added == s->sensors, added);
  s->rows[s->sensors++] = rows;
}
