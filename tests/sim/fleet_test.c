/* SPDX-License-Identifier: BSD-3-Clause */
/* The fleet compared with its truth: courses, radar sightings, and the noise of both. */
#include "support.h"

#define MOST 64

static double wrapped(double angle) {
  return angle - 2 * PI * ceil((angle - PI) / (2 * PI));
}

/* Range and bearing of a feature or a boat at (x, y) from a boat. */
static double range_of(const boat* from, double x, double y) {
  return hypot(x - from->x, y - from->y);
}
static double bearing_of(const boat* from, double x, double y) {
  return wrapped(atan2(y - from->y, x - from->x) - from->heading);
}

static cairn_fleet_options quiet_options(void) {
  cairn_fleet_options o = default_fleet_options();
  o.range_sigma = o.bearing_sigma = o.speed_sigma = o.rate_sigma = 0;
  return o;
}

/* The executed speed and rate between two poses: the chord of a circle and its angle. */
static void executed(const boat* before, const boat* after, double dt, double* speed, double* rate) {
  const double turn = wrapped(after->heading - before->heading);
  const double chord = range_of(before, after->x, after->y);
  const double aside = bearing_of(before, after->x, after->y) - turn / 2;
  *rate = turn / dt;
  *speed = chord * (turn == 0 ? 1 : turn / 2 / sin(turn / 2)) / dt;
  if (fabs(wrapped(aside)) > PI / 2) *speed = -*speed;
  assert_near(chord * sin(aside), 0, 1e-9); /* no boat slides sideways */
}

static void one_round_without_noise(void** state) {
  const cairn_fleet_options o = quiet_options();
  const double radius = 1700 / (2 * PI), centre[] = {-750, 750};
  cairn_fleet* fleet = open_fleet(&o);
  fleet_step step;
  size_t steps = 0, k, i;
  (void)state;
  assert_ok(cairn_fleet_steps(fleet, &steps, NULL));
  assert_int_equal(steps, 301);
  for (k = 0; k < steps; ++k) {
    const double turned = 2 * PI * (double)k / 300;
    step = next_fleet_step(fleet);
    assert_near(step.time, 5 * (double)k, 1e-9);
    assert_near(step.dt, k == 0 ? 0 : 5, 0);
    assert_int_equal(step.vehicle_count, 2);
    for (i = 0; i < 2; ++i) {
      const boat* v = &step.vehicles[i];
      assert_near(v->x, centre[i] + radius * sin(turned), 1e-8);
      assert_near(v->y, -radius * cos(turned), 1e-8);
      assert_near(wrapped(v->heading - turned), 0, 1e-11);
      assert_between(v->heading, -PI, PI);
      assert_near(v->speed, k == 0 ? 0 : 1700. / 1500, 1e-15);
      assert_near(v->rate, k == 0 ? 0 : 2 * PI / 1500, 1e-17);
    }
  }
  cairn_fleet_destroy(fleet);
}

/* Neighbours have the requested distance, or the largest one that fits into the square. */
static void starts_of_any_fleet(void** state) {
  static const struct {
    uint32_t boats;
    double apart, first_x, first_y;
  } fleets[] = {{1, 0, 0, 0},          {2, 1500, -750, 0},      {3, 1500, -750, -750},
                {4, 1500, -750, -750}, {9, 1500, -1500, -1500}, {64, 5000. / 7, -2500, -2500}};
  const double radius = 1700 / (2 * PI);
  size_t f, i, j;
  (void)state;
  for (f = 0; f < LENGTH(fleets); ++f) {
    cairn_fleet_options o = quiet_options();
    cairn_fleet* fleet;
    fleet_step step;
    double nearest = INFINITY;
    o.vehicles = fleets[f].boats;
    fleet = open_fleet(&o);
    step = next_fleet_step(fleet);
    assert_int_equal(step.vehicle_count, fleets[f].boats);
    assert_near(step.vehicles[0].x, fleets[f].first_x, 1e-9);
    assert_near(step.vehicles[0].y, fleets[f].first_y - radius, 1e-9);
    for (i = 0; i < step.vehicle_count; ++i) {
      assert_near(step.vehicles[i].heading, 0, 0);
      assert_between(step.vehicles[i].x, -2500, 2500);
      assert_between(step.vehicles[i].y, -2500 - radius - 1e-9, 2500);
      for (j = 0; j < i; ++j)
        nearest = fmin(nearest, range_of(&step.vehicles[i], step.vehicles[j].x, step.vehicles[j].y));
    }
    if (fleets[f].boats > 1) assert_near(nearest, fleets[f].apart, 1e-9);
    cairn_fleet_destroy(fleet);
  }
}

static void bearings_are_to_the_left_of_the_bow(void** state) {
  const cairn_fleet_options o = quiet_options();
  cairn_fleet* fleet = open_fleet(&o);
  fleet_step step = next_fleet_step(fleet);
  double features[20];
  size_t needed = 0, i, seen = 0;
  (void)state;
  assert_ok(cairn_fleet_features(fleet, features, 10, &needed, NULL));
  assert_int_equal(step.vehicles[0].vehicle_count, 1);
  assert_int_equal(step.vehicles[0].vehicles[0].id, 2);
  assert_near(step.vehicles[0].vehicles[0].range, 1500, 1e-9);
  assert_near(step.vehicles[0].vehicles[0].bearing, 0, 0); /* ahead */
  assert_int_equal(step.vehicles[1].vehicles[0].id, 1);
  assert_near(step.vehicles[1].vehicles[0].bearing, PI, 0); /* astern: pi, not -pi */
  for (i = 0; i < step.vehicles[0].feature_count; ++i) {    /* both head east: north is to the left */
    const cairn_fleet_sighting* s = &step.vehicles[0].features[i];
    assert_true((s->bearing > 0) == (features[2 * s->id - 1] > step.vehicles[0].y));
    ++seen;
  }
  assert_true(seen > 3);
  cairn_fleet_destroy(fleet);
}

/* Without radar noise everything in range is seen at its place, and nothing else. */
static void sightings_are_the_geometry_cut_at_the_range(void** state) {
  cairn_fleet_options o = default_fleet_options();
  double features[2 * 300], farthest = 0;
  size_t needed = 0, i, j, k, hidden[2] = {0, 0}, seen[2] = {0, 0};
  cairn_fleet* fleet;
  (void)state;
  o.range_sigma = o.bearing_sigma = 0;
  o.vehicles = 9, o.features = 300, o.radar_range = 1900;
  fleet = open_fleet(&o);
  assert_ok(cairn_fleet_features(fleet, features, 300, &needed, NULL));
  for (k = 0; k < 301; ++k) {
    const fleet_step step = next_fleet_step(fleet);
    for (i = 0; i < step.vehicle_count; ++i) {
      const boat* v = &step.vehicles[i];
      const cairn_fleet_sighting *s = v->features, *end = s + v->feature_count;
      for (j = 0; j < 300; ++j) {
        const double x = features[2 * j], y = features[2 * j + 1];
        if (range_of(v, x, y) > 1900) {
          ++hidden[0];
          continue;
        }
        assert_true(s < end); /* by ascending id */
        assert_int_equal(s->id, j + 1);
        assert_near(s->range, range_of(v, x, y), 1e-9);
        assert_near(wrapped(s->bearing - bearing_of(v, x, y)), 0, 1e-12);
        farthest = fmax(farthest, s->range);
        ++seen[0], ++s;
      }
      assert_ptr_equal(s, end);
      s = v->vehicles, end = s + v->vehicle_count;
      for (j = 0; j < step.vehicle_count; ++j) {
        const boat* other = &step.vehicles[j];
        if (j == i) continue;
        if (range_of(v, other->x, other->y) > 1900) {
          ++hidden[1];
          continue;
        }
        assert_true(s < end);
        assert_int_equal(s->id, j + 1);
        assert_near(s->range, range_of(v, other->x, other->y), 1e-9);
        assert_near(wrapped(s->bearing - bearing_of(v, other->x, other->y)), 0, 1e-11);
        ++seen[1], ++s;
      }
      assert_ptr_equal(s, end);
    }
  }
  assert_between(farthest, 1899, 1900);
  for (i = 0; i < 2; ++i) assert_true(hidden[i] > 1000 && seen[i] > 1000);
  cairn_fleet_destroy(fleet);
}

/* Sums over pairs of numbers, for their correlation. */
static double share_in_common(double product, const tally* a, const tally* b) {
  return product / a->count / (tally_sigma(a) * tally_sigma(b));
}

static void motion_noise(void** state) {
  cairn_fleet_options o = default_fleet_options();
  boat before[MOST];
  double last[MOST] = {0}, both = 0, in_turn = 0, beside = 0, n;
  tally speed = {0}, rate = {0};
  cairn_fleet* fleet;
  size_t k, i;
  (void)state;
  o.vehicles = MOST, o.features = 1;
  fleet = open_fleet(&o);
  for (k = 0; k < 301; ++k) {
    const fleet_step step = next_fleet_step(fleet);
    double neighbour = 0;
    for (i = 0; i < MOST && k > 0; ++i) {
      double v, w;
      executed(&before[i], &step.vehicles[i], step.dt, &v, &w);
      v -= step.vehicles[i].speed, w -= step.vehicles[i].rate;
      tally_add(&speed, v), tally_add(&rate, w);
      both += v * w, in_turn += v * last[i], beside += v * neighbour;
      last[i] = neighbour = v;
    }
    memcpy(before, step.vehicles, sizeof before);
  }
  n = sqrt(speed.count); /* five standard deviations of each figure */
  assert_near(tally_mean(&speed), 0, 5 * 0.2 / n);
  assert_near(tally_sigma(&speed), 0.2, 5 * 0.2 / n / sqrt(2));
  assert_near(tally_mean(&rate), 0, 5 * 0.1 * DEGREE / n);
  assert_near(tally_sigma(&rate), 0.1 * DEGREE, 5 * 0.1 * DEGREE / n / sqrt(2));
  assert_near(share_in_common(both, &speed, &rate), 0, 5 / n);
  assert_near(share_in_common(in_turn, &speed, &speed), 0, 5 / n);
  assert_near(share_in_common(beside, &speed, &speed), 0, 5 / n);
  cairn_fleet_destroy(fleet);
}

/* `mutual` pairs the sightings of boat 2 by boat 1 with the sightings of boat 1 by boat 2. */
static void radar_noise(void** state) {
  cairn_fleet_options o = default_fleet_options();
  double features[2 * 100], both = 0, mutual[2] = {0, 0}, in_turn = 0, n, m, last = 0;
  tally range = {0}, bearing = {0}, boats[2] = {{0, 0, 0}, {0, 0, 0}};
  cairn_fleet* fleet;
  size_t needed = 0, k, i, j;
  (void)state;
  o.features = 100, o.period = 0.5;
  fleet = open_fleet(&o);
  assert_ok(cairn_fleet_features(fleet, features, 100, &needed, NULL));
  for (k = 0; k < 3001; ++k) {
    const fleet_step step = next_fleet_step(fleet);
    double said[2][2];
    for (i = 0; i < 2; ++i) {
      const boat *v = &step.vehicles[i], *other = &step.vehicles[1 - i];
      for (j = 0; j < v->feature_count; ++j) {
        const cairn_fleet_sighting* s = &v->features[j];
        const double x = features[2 * s->id - 2], y = features[2 * s->id - 1];
        const double dr = s->range - range_of(v, x, y), db = wrapped(s->bearing - bearing_of(v, x, y));
        if (range_of(v, x, y) < 200) continue; /* here ranges are drawn again */
        tally_add(&range, dr), tally_add(&bearing, db);
        both += dr * db, in_turn += dr * last;
        last = dr;
      }
      assert_int_equal(v->vehicle_count, 1);
      said[i][0] = v->vehicles[0].range - range_of(v, other->x, other->y);
      said[i][1] = wrapped(v->vehicles[0].bearing - bearing_of(v, other->x, other->y));
      tally_add(&boats[0], said[i][0]), tally_add(&boats[1], said[i][1]);
    }
    for (j = 0; j < 2; ++j) mutual[j] += said[0][j] * said[1][j];
  }
  n = sqrt(range.count), m = sqrt(boats[0].count);
  assert_true(range.count > 100000);
  assert_near(tally_mean(&range), 0, 5 * 30 / n);
  assert_near(tally_sigma(&range), 30, 5 * 30 / n / sqrt(2));
  assert_near(tally_mean(&bearing), 0, 5 * 0.3 * DEGREE / n);
  assert_near(tally_sigma(&bearing), 0.3 * DEGREE, 5 * 0.3 * DEGREE / n / sqrt(2));
  assert_near(share_in_common(both, &range, &bearing), 0, 5 / n);
  assert_near(share_in_common(in_turn, &range, &range), 0, 5 / n);
  assert_near(tally_sigma(&boats[0]), 30, 5 * 30 / m / sqrt(2));
  assert_near(tally_sigma(&boats[1]), 0.3 * DEGREE, 5 * 0.3 * DEGREE / m / sqrt(2));
  for (j = 0; j < 2; ++j) assert_near(2 * share_in_common(mutual[j], &boats[j], &boats[j]), 0, 5 * sqrt(2) / m);
  cairn_fleet_destroy(fleet);
}

/* Ranges are positive and bearings in (-pi, pi] for any size of the noise. */
static void measurements_keep_their_bounds(void** state) {
  cairn_fleet_options o = default_fleet_options();
  cairn_fleet* fleet;
  size_t k, j, near_the_ends = 0, short_ones = 0;
  (void)state;
  o.range_sigma = 1e5, o.bearing_sigma = 3, o.features = 50;
  fleet = open_fleet(&o);
  for (k = 0; k < 301; ++k) {
    const fleet_step step = next_fleet_step(fleet);
    for (j = 0; j < step.vehicles[0].feature_count; ++j) {
      const cairn_fleet_sighting* s = &step.vehicles[0].features[j];
      assert_true(s->range > 0);
      assert_true(s->bearing > -PI && s->bearing <= PI);
      near_the_ends += fabs(s->bearing) > 3;
      short_ones += s->range < 5000;
    }
  }
  assert_true(near_the_ends > 100 && short_ones > 100);
  cairn_fleet_destroy(fleet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_round_without_noise),
      cmocka_unit_test(starts_of_any_fleet),
      cmocka_unit_test(bearings_are_to_the_left_of_the_bow),
      cmocka_unit_test(sightings_are_the_geometry_cut_at_the_range),
      cmocka_unit_test(motion_noise),
      cmocka_unit_test(radar_noise),
      cmocka_unit_test(measurements_keep_their_bounds),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
