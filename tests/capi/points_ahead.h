/* SPDX-License-Identifier: BSD-3-Clause */
/* A filter with one sensor, and landmarks ahead of it, for both kinds of vehicle: shared by the tests of absurd
 * numbers, of full maps and of callbacks. */
#ifndef CAIRN_TESTS_CAPI_POINTS_AHEAD_H
#define CAIRN_TESTS_CAPI_POINTS_AHEAD_H

#include "plane.h"

enum { NEAR = 8 };

static inline cairn_filter* create(const cairn_filter_options* options) {
  cairn_filter* f = NULL;
  assert_ok(cairn_filter_create(options, &f, NULL));
  return f;
}

static inline cairn_filter_options options_of(int32_t vehicle, int32_t error) {
  cairn_filter_options o;
  assert_ok(cairn_filter_options_init(&o, sizeof o, NULL));
  o.vehicle = vehicle, o.state_error = error, o.max_landmarks = 60, o.max_observations = 20;
  return o;
}

static inline int32_t add_sensor(cairn_filter* f, int32_t vehicle) {
  int32_t sensor = -1;
  if (vehicle == CAIRN_VEHICLE_PLANAR) {
    const cairn_range_bearing radar = plane_radar();
    assert_ok(cairn_filter_add_range_bearing(f, &radar, &sensor, NULL));
  } else {
    cairn_cartesian cartesian;
    assert_ok(cairn_cartesian_init(&cartesian, sizeof cartesian, NULL));
    assert_ok(cairn_filter_add_cartesian(f, &cartesian, &sensor, NULL));
  }
  return sensor;
}

/* Landmark i, seen from a vehicle that stands at (x, 0, 0). */
static inline cairn_observation seen(int32_t vehicle, uint64_t id, double x) {
  const double dx = 5 + (double)id - x, dy = 3.0 * (double)(id % 3) - 3;
  cairn_observation o = sighting(id, dx, dy);
  if (vehicle == CAIRN_VEHICLE_PLANAR) o = sighting(id, hypot(dx, dy), atan2(dy, dx));
  return o;
}

static inline void step(cairn_filter* f) {
  const double v[3] = {0.1, 0, 0}, w[3] = {0, 0, 0};
  assert_ok(cairn_filter_predict_twist(f, 1.0, v, w, NULL));
}

#endif
