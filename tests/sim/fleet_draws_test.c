/* SPDX-License-Identifier: BSD-3-Clause */
/* Results that the seed of a fleet determines: repeated steps, independent draws, the places of the features and the
   coast. */
#include "support.h"

#define COAST 201

static void assert_same_step(const fleet_step* a, const fleet_step* b) {
  size_t i;
  assert_int_equal(a->number, b->number);
  assert_int_equal(a->vehicle_count, b->vehicle_count);
  for (i = 0; i < a->vehicle_count; ++i) {
    const boat *p = &a->vehicles[i], *q = &b->vehicles[i];
    assert_memory_equal(p, q, offsetof(boat, features));
    assert_int_equal(p->feature_count, q->feature_count);
    assert_int_equal(p->vehicle_count, q->vehicle_count);
    if (p->feature_count > 0) assert_memory_equal(p->features, q->features, p->feature_count * sizeof *p->features);
    if (p->vehicle_count > 0) assert_memory_equal(p->vehicles, q->vehicles, p->vehicle_count * sizeof *p->vehicles);
  }
}

static void read_features(const cairn_fleet* fleet, double* positions, size_t count) {
  size_t needed = 0;
  assert_ok(cairn_fleet_features(fleet, positions, count, &needed, NULL));
  assert_int_equal(needed, count);
}

static void assert_same_drive(cairn_fleet* one, cairn_fleet* two) {
  size_t k;
  for (k = 0; k < 301; ++k) {
    const fleet_step a = next_fleet_step(one), b = next_fleet_step(two);
    assert_same_step(&a, &b);
  }
}

static void the_same_seed_gives_the_same_steps(void** state) {
  cairn_fleet_options o = default_fleet_options();
  cairn_fleet *fleet, *fresh;
  size_t k;
  (void)state;
  o.vehicles = 5, o.features = 40;
  fleet = open_fleet(&o);
  fresh = open_fleet(&o);
  assert_same_drive(fleet, fresh);
  cairn_fleet_destroy(fresh);
  assert_ok(cairn_fleet_rewind(fleet, NULL)); /* after the last step */
  fresh = open_fleet(&o);
  assert_same_drive(fleet, fresh);
  cairn_fleet_destroy(fresh);
  assert_ok(cairn_fleet_rewind(fleet, NULL));
  for (k = 0; k < 20; ++k) next_fleet_step(fleet);
  assert_ok(cairn_fleet_rewind(fleet, NULL)); /* in the middle */
  fresh = open_fleet(&o);
  assert_same_drive(fleet, fresh);
  cairn_fleet_destroy(fresh);
  cairn_fleet_destroy(fleet);
}

static void another_seed_is_another_fleet(void** state) {
  cairn_fleet_options o = default_fleet_options();
  cairn_fleet *one = open_fleet(&o), *two;
  double here[20], there[20];
  fleet_step a, b;
  size_t i;
  (void)state;
  o.seed = 2;
  two = open_fleet(&o);
  read_features(one, here, 10);
  read_features(two, there, 10);
  for (i = 0; i < 20; ++i) assert_true(here[i] != there[i]);
  a = next_fleet_step(one), b = next_fleet_step(two);
  assert_true(a.vehicles[0].vehicles[0].range != b.vehicles[0].vehicles[0].range);
  a = next_fleet_step(one), b = next_fleet_step(two);
  assert_true(a.vehicles[0].heading != b.vehicles[0].heading);
  cairn_fleet_destroy(one);
  cairn_fleet_destroy(two);
}

/* Compares the motion and the sightings of boat 1 of two with those in a fleet in which one option is changed. */
static void check_unchanged(const cairn_fleet_options* changed) {
  const cairn_fleet_options o = default_fleet_options();
  cairn_fleet *one = open_fleet(&o), *two = open_fleet(changed);
  double here[20];
  double* there = (double*)malloc(2 * changed->features * sizeof(double));
  size_t k;
  assert_non_null(there);
  read_features(one, here, 10);
  read_features(two, there, changed->features);
  assert_memory_equal(here, there, sizeof here);
  for (k = 0; k < 100; ++k) {
    const fleet_step a = next_fleet_step(one), b = next_fleet_step(two);
    const boat *p = a.vehicles, *q = b.vehicles;
    assert_memory_equal(p, q, offsetof(boat, features));
    if (changed->range_sigma > 0) { /* additional features are at the end of the list */
      assert_true(p->feature_count > 0 && p->feature_count <= q->feature_count);
      assert_memory_equal(p->features, q->features, p->feature_count * sizeof *p->features);
    }
  }
  free(there);
  cairn_fleet_destroy(one);
  cairn_fleet_destroy(two);
}

static void draws_are_independent(void** state) {
  cairn_fleet_options o = default_fleet_options();
  (void)state;
  o.features = 40;
  check_unchanged(&o);
  o = default_fleet_options();
  o.range_sigma = o.bearing_sigma = 0;
  check_unchanged(&o);
  o = default_fleet_options();
  o.coast_relief = 0.01, o.coast_strip = 0.1;
  check_unchanged(&o);
}

/* Boats at other places have the same errors: their rates are the same numbers, however many boats there are. */
static void more_boats_leave_the_first_ones_errors(void** state) {
  cairn_fleet_options o = default_fleet_options();
  cairn_fleet *two = open_fleet(&o), *many;
  size_t k;
  (void)state;
  o.vehicles = 20;
  many = open_fleet(&o);
  for (k = 0; k < 301; ++k) {
    const fleet_step a = next_fleet_step(two), b = next_fleet_step(many);
    assert_near(a.vehicles[0].heading, b.vehicles[0].heading, 0);
    assert_near(a.vehicles[1].heading, b.vehicles[1].heading, 0);
    if (k > 0) assert_true(a.vehicles[0].heading != a.vehicles[1].heading);
  }
  cairn_fleet_destroy(two);
  cairn_fleet_destroy(many);
}

static void larger_noise_scales_the_same_draws(void** state) {
  cairn_fleet_options o = default_fleet_options();
  cairn_fleet *none, *some, *more;
  size_t k, j;
  (void)state;
  o.radar_range = 20000;
  some = open_fleet(&o);
  o.range_sigma *= 2, o.bearing_sigma *= 3;
  more = open_fleet(&o);
  o.range_sigma = o.bearing_sigma = 0;
  none = open_fleet(&o);
  for (k = 0; k < 50; ++k) {
    const fleet_step n = next_fleet_step(none), s = next_fleet_step(some), m = next_fleet_step(more);
    assert_int_equal(n.vehicles[0].feature_count, 10);
    for (j = 0; j < 10; ++j) {
      const cairn_fleet_sighting *a = &n.vehicles[0].features[j], *b = &s.vehicles[0].features[j],
                                 *c = &m.vehicles[0].features[j];
      assert_near(c->range - a->range, 2 * (b->range - a->range), 1e-9);
      assert_near(remainder(c->bearing - a->bearing - 3 * (b->bearing - a->bearing), 2 * PI), 0, 1e-12);
    }
  }
  cairn_fleet_destroy(none);
  cairn_fleet_destroy(some);
  cairn_fleet_destroy(more);
}

static void features_are_uniform(void** state) {
  cairn_fleet_options o = default_fleet_options();
  double positions[2 * 5000], both = 0;
  tally place[2] = {{0, 0, 0}, {0, 0, 0}};
  size_t quarters[4] = {0, 0, 0, 0}, i, axis;
  cairn_fleet* fleet;
  (void)state;
  o.features = 5000;
  fleet = open_fleet(&o);
  read_features(fleet, positions, 5000);
  for (i = 0; i < 5000; ++i) {
    const double *p = &positions[2 * i], sigma = 10000 / sqrt(12);
    for (axis = 0; axis < 2; ++axis) {
      assert_between(p[axis], -5000, 5000);
      tally_add(&place[axis], p[axis] / sigma);
    }
    both += p[0] * p[1] / sigma / sigma;
    ++quarters[(fabs(p[0]) > 2500) + 2 * (fabs(p[1]) > 2500)];
  }
  for (axis = 0; axis < 2; ++axis) {
    assert_near(tally_mean(&place[axis]), 0, 5 / sqrt(5000));
    assert_near(tally_sigma(&place[axis]), 1,
                5 * sqrt(0.8 / 5000) / 2); /* the fourth moment of a uniform distribution is 1.8 */
  }
  assert_near(both / 5000, 0, 5 / sqrt(5000));
  for (i = 0; i < 4; ++i) assert_near((double)quarters[i], 1250, 5 * sqrt(5000 * 3 / 16.));
  cairn_fleet_destroy(fleet);
}

static double coast_north_of(const double* coast, double x) {
  size_t i = 1;
  while (i < COAST - 1 && coast[2 * i] < x) ++i;
  return coast[2 * i - 1] +
         (x - coast[2 * i - 2]) / (coast[2 * i] - coast[2 * i - 2]) * (coast[2 * i + 1] - coast[2 * i - 1]);
}

static void features_are_along_the_coast(void** state) {
  cairn_fleet_options o = default_fleet_options();
  uint64_t seed;
  double highest = -INFINITY, lowest = INFINITY;
  (void)state;
  for (seed = 1; seed <= 30; ++seed) {
    double coast[2 * COAST], again[2 * COAST], positions[2 * 500], length = 0, west = 0;
    tally off = {0, 0, 0};
    size_t needed = 0, i, in_west = 0;
    cairn_fleet* fleet;
    o.seed = seed, o.features = 500, o.layout = CAIRN_FLEET_UNIFORM;
    fleet = open_fleet(&o);
    assert_ok(cairn_fleet_coast(fleet, again, COAST, &needed, NULL));
    cairn_fleet_destroy(fleet);
    o.layout = CAIRN_FLEET_COAST;
    fleet = open_fleet(&o);
    assert_ok(cairn_fleet_coast(fleet, coast, COAST, &needed, NULL));
    assert_int_equal(needed, COAST);
    assert_memory_equal(coast, again, sizeof coast); /* the layout does not change the coast */
    assert_near(coast[0], -5000, 1e-9);
    assert_near(coast[2 * COAST - 2], 5000, 1e-9);
    for (i = 0; i < COAST; ++i) {
      double step = 0;
      assert_between(coast[2 * i + 1], 3000, 4000);
      highest = fmax(highest, coast[2 * i + 1]), lowest = fmin(lowest, coast[2 * i + 1]);
      if (i > 0) step = hypot(coast[2 * i] - coast[2 * i - 2], coast[2 * i + 1] - coast[2 * i - 1]);
      if (i > 0) assert_true(coast[2 * i] > coast[2 * i - 2]);
      length += step, west += i <= COAST / 2 ? step : 0;
    }
    assert_true(length > 10010);
    read_features(fleet, positions, 500);
    for (i = 0; i < 500; ++i) {
      const double *p = &positions[2 * i], south = coast_north_of(coast, p[0]) - p[1];
      assert_between(p[0], -5000, 5000);
      assert_between(south, -1e-9, 300 + 1e-9);
      tally_add(&off, south);
      in_west += p[0] < 0;
    }
    assert_near(tally_mean(&off), 150, 5 * 300 / sqrt(12 * 500.));
    assert_near((double)in_west, 500 * west / length, 5 * sqrt(500 / 4.));
    cairn_fleet_destroy(fleet);
  }
  assert_true(highest > 3750 && lowest < 3250); /* the requested relief, at least in some fleets */
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_same_seed_gives_the_same_steps),
      cmocka_unit_test(another_seed_is_another_fleet),
      cmocka_unit_test(draws_are_independent),
      cmocka_unit_test(more_boats_leave_the_first_ones_errors),
      cmocka_unit_test(larger_noise_scales_the_same_draws),
      cmocka_unit_test(features_are_uniform),
      cmocka_unit_test(features_are_along_the_coast),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
