/* SPDX-License-Identifier: BSD-3-Clause */
/* Shared by the tests of simulated worlds and fleets. */
#ifndef CAIRN_TESTS_SIM_SUPPORT_H
#define CAIRN_TESTS_SIM_SUPPORT_H

/* cmocka.h needs these headers before it. */
/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
/* clang-format on */

#include <cairn/cairn.h>
#include <cairn/fleet.h>
#include <cairn/sim.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
#define DEGREE (PI / 180.0)
#define LENGTH(array) (sizeof(array) / sizeof((array)[0]))

/* Checks that print the compared values. */
#define assert_near(actual, expected, tolerance) \
  check_near((actual), (expected), (tolerance), #actual " against " #expected, __FILE__, __LINE__)
#define assert_between(actual, lower, upper) check_between((actual), (lower), (upper), #actual, __FILE__, __LINE__)
#define assert_ok(call) check_status((call), CAIRN_OK, "", #call, __FILE__, __LINE__)
/* A call that must be refused. The message must contain `word`. */
#define assert_refused(call, status, word) check_status((call), (status), (word), #call, __FILE__, __LINE__)
void check_near(double actual, double expected, double tolerance, const char* what, const char* file, int line);
void check_between(double actual, double lower, double upper, const char* what, const char* file, int line);
void check_status(cairn_status actual, cairn_status expected, const char* word, const char* call, const char* file,
                  int line);

cairn_world_options default_options(void);
cairn_world_options preset_options(int32_t preset);
cairn_world* open_world(const cairn_world_options* options);
size_t steps_of(const cairn_world* world);
/* The next step, which must exist, with its arrays. These are valid until the next step of this world. */
typedef struct world_step {
  uint64_t number;
  double time;
  cairn_pose truth;
  double velocity_sigma[3], rate_sigma[3], pan, stick;
  const cairn_world_motion* motions;
  size_t motion_count;
  const cairn_observation* observations;
  size_t observation_count;
} world_step;
world_step next_step(cairn_world* world);

cairn_fleet_options default_fleet_options(void);
cairn_fleet* open_fleet(const cairn_fleet_options* options);
/* The same for a fleet. */
typedef struct boat {
  double speed, rate, x, y, heading;
  const cairn_fleet_sighting* features;
  size_t feature_count;
  const cairn_fleet_sighting* vehicles;
  size_t vehicle_count;
} boat;
typedef struct fleet_step {
  uint64_t number;
  double time, dt;
  const boat* vehicles;
  size_t vehicle_count;
} fleet_step;
fleet_step next_fleet_step(cairn_fleet* fleet);

/* A point of the map in the body frame, and the z axis of the body in the map. */
void to_body(const cairn_pose* T_map_body, const double point[3], double out[3]);
/* Moves a pose by a constant twist over a time. */
cairn_pose moved(const cairn_pose* pose, const double velocity[3], const double rate[3], double dt);

/* Mean and spread of a series of numbers. */
typedef struct tally {
  double count, sum, square;
} tally;
void tally_add(tally* t, double value);
double tally_mean(const tally* t);
double tally_sigma(const tally* t); /* root mean square */

#endif
