/* SPDX-License-Identifier: BSD-3-Clause */
/* Options of a fleet: defaults, structs of other versions, refused values, buffers, and the end of the drive. */
#include "support.h"

static void defaults_equal_the_paper(void** state) {
  const cairn_fleet_options o = default_fleet_options();
  (void)state;
  assert_int_equal(o.struct_size, sizeof o);
  assert_int_equal(o.layout, CAIRN_FLEET_UNIFORM);
  assert_int_equal(o.vehicles, 2);
  assert_int_equal(o.features, 10);
  assert_near(o.area, 10000, 0);
  assert_near(o.separation, 1500, 0);
  assert_near(o.course_length, 1700, 0);
  assert_near(o.duration, 1500, 0);
  assert_near(o.period, 5, 0);
  assert_near(o.radar_range, 5000, 0);
  assert_near(o.range_sigma, 30, 0);
  assert_near(o.bearing_sigma, 0.3 * DEGREE, 1e-17);
  assert_near(o.speed_sigma, 0.2, 0);
  assert_near(o.rate_sigma, 0.1 * DEGREE, 1e-17);
}

/* No byte beyond the caller's struct is written, and fields that an older caller lacks have their defaults. */
static void options_of_other_sizes(void** state) {
  const size_t old = offsetof(cairn_fleet_options, vehicles) + sizeof(uint32_t);
  unsigned char* bytes = (unsigned char*)malloc(sizeof(cairn_fleet_options) + 64);
  cairn_fleet_options* o = (cairn_fleet_options*)(void*)bytes;
  cairn_fleet* fleet;
  size_t needed = 0, i;
  (void)state;
  assert_non_null(bytes);
  memset(bytes, 0xa5, sizeof *o + 64);
  assert_ok(cairn_fleet_options_init(o, old, NULL));
  for (i = old; i < sizeof *o + 64; ++i) assert_int_equal(bytes[i], 0xa5);
  o->vehicles = 3;
  fleet = open_fleet(o);
  assert_int_equal(next_fleet_step(fleet).vehicle_count, 3);
  assert_ok(cairn_fleet_features(fleet, NULL, 0, &needed, NULL));
  assert_int_equal(needed, 10);
  cairn_fleet_destroy(fleet);
  memset(bytes, 0xa5, sizeof *o + 64);
  assert_ok(cairn_fleet_options_init(o, sizeof *o + 64, NULL)); /* a newer caller */
  assert_int_equal(bytes[sizeof *o + 63], 0);
  cairn_fleet_destroy(open_fleet(o));
  free(bytes);
}

static void steps_of_other_sizes(void** state) {
  const cairn_fleet_options o = default_fleet_options();
  const size_t old = offsetof(cairn_fleet_step, time);
  union {
    cairn_fleet_step step;
    unsigned char bytes[sizeof(cairn_fleet_step) + 64];
  } u;
  cairn_fleet* fleet = open_fleet(&o);
  size_t i;
  (void)state;
  memset(&u, 0xa5, sizeof u);
  u.step.struct_size = (uint32_t)old;
  assert_ok(cairn_fleet_next(fleet, &u.step, NULL));
  assert_int_equal(u.step.number, 0);
  assert_int_equal(u.step.struct_size, old);
  for (i = old; i < sizeof u; ++i) assert_int_equal(u.bytes[i], 0xa5);
  u.step.struct_size = sizeof u;
  assert_ok(cairn_fleet_next(fleet, &u.step, NULL));
  assert_int_equal(u.step.number, 1);
  assert_int_equal(u.step.struct_size, sizeof u);
  for (i = sizeof u.step; i < sizeof u; ++i) assert_int_equal(u.bytes[i], 0xa5);
  u.step.struct_size = 7;
  assert_refused(cairn_fleet_next(fleet, &u.step, NULL), CAIRN_ERROR_ARGUMENT, "struct_size");
  assert_int_equal(u.step.number, 1);
  assert_int_equal(next_fleet_step(fleet).number, 2); /* the refused call did not consume a step */
  cairn_fleet_destroy(fleet);
}

/* The message must contain `word`, the name of the field. */
#define REFUSE_AS(field, value, word)                                                    \
  do {                                                                                   \
    cairn_fleet_options bad = default_fleet_options();                                   \
    cairn_fleet* none = NULL;                                                            \
    bad.field = (value);                                                                 \
    assert_refused(cairn_fleet_create(&bad, &none, NULL), CAIRN_ERROR_ARGUMENT, (word)); \
    assert_null(none);                                                                   \
  } while (0)
#define REFUSE(field, value) REFUSE_AS(field, value, "options." #field)

static void bad_options(void** state) {
  const double not_positive[] = {0, -1, NAN, INFINITY}, negative[] = {-1e-9, NAN, INFINITY};
  size_t i;
  (void)state;
  REFUSE_AS(struct_size, 7, "struct_size");
  REFUSE_AS(struct_size, 1 << 20, "struct_size");
  REFUSE(layout, -1);
  REFUSE(layout, 2);
  REFUSE(vehicles, 0);
  REFUSE(vehicles, 65);
  REFUSE(features, 0);
  REFUSE(features, 100001);
  for (i = 0; i < LENGTH(not_positive); ++i) {
    const double v = not_positive[i];
    REFUSE(area, v);
    REFUSE(separation, v);
    REFUSE(course_length, v);
    REFUSE(duration, v);
    REFUSE(period, v);
    REFUSE(radar_range, v);
    REFUSE(coast_distance, v);
  }
  for (i = 0; i < LENGTH(negative); ++i) {
    const double v = negative[i];
    REFUSE(range_sigma, v);
    REFUSE(bearing_sigma, v);
    REFUSE(speed_sigma, v);
    REFUSE(rate_sigma, v);
    REFUSE(coast_relief, v);
    REFUSE(coast_strip, v);
  }
  REFUSE(separation, 5000.1);
  REFUSE(course_length, 10000.1);
  REFUSE(period, 1500.1);
  REFUSE(period, 1e-7); /* too many steps */
  REFUSE(coast_distance, 0.51);
  REFUSE(coast_relief, 0.151); /* out of the square */
  REFUSE(coast_strip, 0.51);
}

/* A coast on which the boats would run aground is refused only if the features are along the coast. */
static void contradictions(void** state) {
  cairn_fleet_options o = default_fleet_options();
  cairn_fleet* fleet = NULL;
  (void)state;
  o.coast_distance = 0.02;
  cairn_fleet_destroy(open_fleet(&o));
  o.layout = CAIRN_FLEET_COAST;
  assert_refused(cairn_fleet_create(&o, &fleet, NULL), CAIRN_ERROR_ARGUMENT, "coast_distance");
  o.coast_distance = 0.1;
  cairn_fleet_destroy(open_fleet(&o));
  o.coast_distance = 0.35, o.vehicles = 64;
  cairn_fleet_destroy(open_fleet(&o)); /* the defaults have room for the largest fleet */
}

/* The largest allowed values are accepted. */
static void good_options(void** state) {
  cairn_fleet_options o = default_fleet_options();
  cairn_fleet* fleet;
  size_t steps = 0;
  (void)state;
  o.vehicles = 64, o.features = 100000, o.separation = 5000, o.course_length = 10000, o.period = 1500;
  o.coast_distance = 0.3, o.coast_relief = 0.2, o.coast_strip = 0.5;
  o.range_sigma = o.bearing_sigma = o.speed_sigma = o.rate_sigma = 0;
  fleet = open_fleet(&o);
  assert_ok(cairn_fleet_steps(fleet, &steps, NULL));
  assert_int_equal(steps, 2);
  assert_int_equal(next_fleet_step(fleet).vehicle_count, 64);
  cairn_fleet_destroy(fleet);
}

static void missing_arguments(void** state) {
  cairn_fleet_options o = default_fleet_options();
  cairn_fleet* fleet = NULL;
  cairn_fleet_step step = {0};
  double points[2];
  size_t count = 0;
  (void)state;
  step.struct_size = sizeof step;
  assert_refused(cairn_fleet_options_init(NULL, 100, NULL), CAIRN_ERROR_ARGUMENT, "options");
  assert_refused(cairn_fleet_options_init(&o, 4, NULL), CAIRN_ERROR_ARGUMENT, "struct_size");
  assert_refused(cairn_fleet_create(NULL, &fleet, NULL), CAIRN_ERROR_ARGUMENT, "options");
  assert_refused(cairn_fleet_create(&o, NULL, NULL), CAIRN_ERROR_ARGUMENT, "fleet");
  assert_refused(cairn_fleet_next(NULL, &step, NULL), CAIRN_ERROR_ARGUMENT, "fleet");
  assert_refused(cairn_fleet_rewind(NULL, NULL), CAIRN_ERROR_ARGUMENT, "fleet");
  assert_refused(cairn_fleet_steps(NULL, &count, NULL), CAIRN_ERROR_ARGUMENT, "fleet");
  assert_refused(cairn_fleet_features(NULL, points, 1, &count, NULL), CAIRN_ERROR_ARGUMENT, "fleet");
  assert_refused(cairn_fleet_coast(NULL, points, 1, &count, NULL), CAIRN_ERROR_ARGUMENT, "fleet");
  cairn_fleet_destroy(NULL);
  fleet = open_fleet(&o);
  assert_refused(cairn_fleet_next(fleet, NULL, NULL), CAIRN_ERROR_ARGUMENT, "step");
  assert_refused(cairn_fleet_steps(fleet, NULL, NULL), CAIRN_ERROR_ARGUMENT, "steps");
  assert_refused(cairn_fleet_vehicles(NULL, NULL, 0, &count, NULL), CAIRN_ERROR_ARGUMENT, "fleet");
  assert_refused(cairn_fleet_vehicles(fleet, NULL, 0, NULL, NULL), CAIRN_ERROR_ARGUMENT, "needed");
  assert_refused(cairn_fleet_seen_features(NULL, 1, NULL, 0, &count, NULL), CAIRN_ERROR_ARGUMENT, "fleet");
  assert_refused(cairn_fleet_seen_vehicles(NULL, 1, NULL, 0, &count, NULL), CAIRN_ERROR_ARGUMENT, "fleet");
  cairn_fleet_destroy(fleet);
}

/* Before the first step nothing was seen. After it the fleet tells what each boat saw, and knows no other boats. */
static void boats_of_a_step(void** state) {
  const cairn_fleet_options o = default_fleet_options();
  cairn_fleet* fleet = open_fleet(&o);
  cairn_fleet_sighting one;
  size_t count = 9;
  (void)state;
  assert_ok(cairn_fleet_vehicles(fleet, NULL, 0, &count, NULL));
  assert_int_equal(count, 0);
  assert_ok(cairn_fleet_seen_features(fleet, 1, NULL, 0, &count, NULL));
  assert_int_equal(count, 0);
  next_fleet_step(fleet);
  assert_ok(cairn_fleet_vehicles(fleet, NULL, 0, &count, NULL));
  assert_int_equal(count, 2);
  assert_ok(cairn_fleet_seen_vehicles(fleet, 2, &one, 1, &count, NULL));
  assert_int_equal(count, 1);
  assert_int_equal(one.id, 1);
  assert_refused(cairn_fleet_seen_features(fleet, 0, &one, 1, &count, NULL), CAIRN_ERROR_NOT_FOUND, "vehicle 0");
  assert_refused(cairn_fleet_seen_vehicles(fleet, 3, &one, 1, &count, NULL), CAIRN_ERROR_NOT_FOUND, "1 to 2");
  assert_ok(cairn_fleet_rewind(fleet, NULL));
  assert_ok(cairn_fleet_vehicles(fleet, NULL, 0, &count, NULL));
  assert_int_equal(count, 0);
  cairn_fleet_destroy(fleet);
}

typedef cairn_status points_of(const cairn_fleet*, double*, size_t, size_t*, cairn_error*);

static void check_buffers(points_of* query, const cairn_fleet* fleet, size_t expected, const char* name) {
  double *buffer = (double*)malloc((expected + 1) * 2 * sizeof(double)), first;
  size_t needed = 0, i;
  assert_non_null(buffer);
  assert_ok(query(fleet, NULL, 0, &needed, NULL));
  assert_int_equal(needed, expected);
  for (i = 0; i < 2 * expected + 2; ++i) buffer[i] = -12345;
  needed = 0;
  assert_refused(query(fleet, buffer, expected - 1, &needed, NULL), CAIRN_ERROR_BUFFER, name);
  assert_int_equal(needed, expected);
  for (i = 0; i < 2 * expected + 2; ++i) assert_near(buffer[i], -12345, 0);
  assert_ok(query(fleet, buffer, 0, &needed, NULL)); /* capacity 0 asks, with any pointer */
  assert_int_equal(needed, expected);
  assert_ok(query(fleet, buffer, expected, &needed, NULL));
  for (i = 0; i < 2 * expected; ++i) assert_between(buffer[i], -5000, 5000);
  for (; i < 2 * expected + 2; ++i) assert_near(buffer[i], -12345, 0);
  first = buffer[0];
  assert_ok(query(fleet, buffer, expected + 1, &needed, NULL));
  assert_int_equal(needed, expected);
  assert_near(buffer[0], first, 0);
  assert_near(buffer[2 * expected], -12345, 0);
  assert_refused(query(fleet, NULL, 1, &needed, NULL), CAIRN_ERROR_ARGUMENT, name);
  assert_refused(query(fleet, buffer, expected, NULL, NULL), CAIRN_ERROR_ARGUMENT, "needed");
  free(buffer);
}

static void buffers(void** state) {
  cairn_fleet_options o = default_fleet_options();
  cairn_fleet* fleet;
  (void)state;
  o.features = 17;
  fleet = open_fleet(&o);
  check_buffers(cairn_fleet_features, fleet, 17, "positions");
  check_buffers(cairn_fleet_coast, fleet, 201, "points");
  cairn_fleet_destroy(fleet);
}

static void the_end(void** state) {
  cairn_fleet_options o = default_fleet_options();
  cairn_fleet* fleet;
  cairn_fleet_step beyond = {0};
  size_t steps = 0, k;
  (void)state;
  o.duration = 0.7, o.period = 0.1; /* their quotient is not a whole number */
  fleet = open_fleet(&o);
  assert_ok(cairn_fleet_steps(fleet, &steps, NULL));
  assert_int_equal(steps, 8);
  for (k = 0; k < steps; ++k) {
    const fleet_step step = next_fleet_step(fleet);
    assert_int_equal(step.number, k);
    assert_near(step.time, 0.1 * (double)k, 1e-12);
    assert_near(step.dt, k == 0 ? 0 : 0.1, 0);
  }
  beyond.struct_size = sizeof beyond;
  assert_refused(cairn_fleet_next(fleet, &beyond, NULL), CAIRN_ERROR_STATE, "rewind");
  assert_refused(cairn_fleet_next(fleet, &beyond, NULL), CAIRN_ERROR_STATE, "8 steps");
  assert_ok(cairn_fleet_rewind(fleet, NULL));
  assert_int_equal(next_fleet_step(fleet).number, 0);
  cairn_fleet_destroy(fleet);
  o.duration = 0.79;
  fleet = open_fleet(&o);
  assert_ok(cairn_fleet_steps(fleet, &steps, NULL));
  assert_int_equal(steps, 8);
  cairn_fleet_destroy(fleet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_equal_the_paper),
      cmocka_unit_test(options_of_other_sizes),
      cmocka_unit_test(steps_of_other_sizes),
      cmocka_unit_test(bad_options),
      cmocka_unit_test(contradictions),
      cmocka_unit_test(good_options),
      cmocka_unit_test(missing_arguments),
      cmocka_unit_test(boats_of_a_step),
      cmocka_unit_test(buffers),
      cmocka_unit_test(the_end),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
