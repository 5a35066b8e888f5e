/* SPDX-License-Identifier: BSD-3-Clause */
/* What the calls of make_refusals.py need: handles that are fresh for each call, and arguments that are valid at first
 * sight. */
#ifndef CAIRN_TESTS_REFUSALS_H
#define CAIRN_TESTS_REFUSALS_H

#include <cairn/cairn.h>
#include <cairn/fleet.h>
#include <cairn/sim.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static cairn_error error;
static size_t needed;
static int calls_made, failures;

/* Handles that are made anew for each call, so that no call sees what another one did. */
static struct {
  cairn_filter *filter;
  cairn_map *map;
  cairn_team *team;
  cairn_world *world;
  cairn_fleet *fleet;
} fresh;

static void prepare_cairn_pose(cairn_pose *pose) { cairn_pose_identity(pose, NULL); }

static void prepare_cairn_filter_options(cairn_filter_options *options) {
  options->vehicle = CAIRN_VEHICLE_PLANAR; /* as teams ask for, with room for little */
  options->max_landmarks = 4;
  options->max_observations = 4;
}

static void prepare_cairn_merge_options(cairn_merge_options *options) {
  options->has_transform = 1; /* without it the transform is not read */
}

static void prepare_cairn_fleet_options(cairn_fleet_options *options) {
  options->coast_relief = 0; /* it and coast_distance share one bound */
}

/* Numbers for one argument: an identity matrix of this many rows, which begins like a unit quaternion. */
static double *valid_doubles(int rows) {
  static double pool[16][64];
  static int next;
  double *values = pool[next++ % 16];
  memset(values, 0, sizeof pool[0]);
  for (int i = 0; i < rows; i++) values[i * rows + i] = 1;
  return values;
}

static double *not_a_number_double(void) {
  double *values = valid_doubles(1);
  values[0] = NAN;
  return values;
}

static cairn_pose *not_a_number_cairn_pose(void) {
  static cairn_pose pose;
  prepare_cairn_pose(&pose);
  pose.position[1] = NAN;
  return &pose;
}

static uint64_t *valid_uint64_t(void) {
  static uint64_t values[64];
  memset(values, 0, sizeof values);
  return values;
}

static uint32_t *valid_uint32_t(void) { return (uint32_t *)valid_uint64_t(); }
static int32_t *valid_int32_t(void) { return (int32_t *)valid_uint64_t(); }
static uint8_t *valid_uint8_t(void) { return (uint8_t *)valid_uint64_t(); }
static size_t *valid_size_t(void) { return (size_t *)valid_uint64_t(); }

static int32_t valid_cairn_custom_predict_fn(void *user, const cairn_pose *pose, const double landmark[3], double *z,
                                             double *jacobian_pose, double *jacobian_landmark) {
  (void)user, (void)pose, (void)landmark, (void)z, (void)jacobian_pose, (void)jacobian_landmark;
  return 0;
}

static int32_t valid_cairn_custom_place_fn(void *user, const cairn_pose *pose, const double *z, double landmark[3],
                                           double *jacobian_pose, double *jacobian_z) {
  (void)user, (void)pose, (void)z, (void)landmark, (void)jacobian_pose, (void)jacobian_z;
  return 0;
}

static void valid_cairn_log_fn(void *payload, const char *line) { (void)payload, (void)line; }

static void must(cairn_status status, const char *what) {
  if (status == CAIRN_OK) return;
  fprintf(stderr, "%s: %s\n", what, cairn_last_message());
  exit(2);
}

static void begin(void) {
  cairn_filter_options options;
  must(cairn_filter_options_init(&options, sizeof options, NULL), "options");
  prepare_cairn_filter_options(&options);
  cairn_team_options team;
  cairn_range_bearing radar;
  must(cairn_team_options_init(&team, sizeof team, NULL), "team options");
  must(cairn_range_bearing_init(&radar, sizeof radar, NULL), "radar");
  must(cairn_team_create(&team, &options, &radar, &fresh.team, NULL), "team");

  /* The filter has a sensor 0, a pose 0, a closed submap 0, and a landmark 0 in it and in the open one. */
  cairn_cartesian cartesian;
  must(cairn_cartesian_init(&cartesian, sizeof cartesian, NULL), "cartesian");
  options.vehicle = CAIRN_VEHICLE_SPATIAL;
  options.trajectory_poses = 4;
  options.submap_landmarks = 4;
  must(cairn_filter_create(&options, &fresh.filter, NULL), "filter");
  int32_t sensor;
  must(cairn_filter_add_cartesian(fresh.filter, &cartesian, &sensor, NULL), "sensor");
  cairn_observation observation = {0};
  observation.z[0] = 10;
  must(cairn_filter_update(fresh.filter, sensor, &observation, 1, NULL, NULL), "update");
  must(cairn_filter_close_submap(fresh.filter, NULL), "submap");
  must(cairn_filter_update(fresh.filter, sensor, &observation, 1, NULL, NULL), "update");
  must(cairn_map_copy(cairn_filter_map(fresh.filter), &fresh.map, NULL), "map");

  cairn_world_options world;
  cairn_fleet_options fleet;
  cairn_world_options_init(&world, sizeof world, NULL);
  must(cairn_world_create(&world, &fresh.world, NULL), "world");
  cairn_fleet_options_init(&fleet, sizeof fleet, NULL);
  must(cairn_fleet_create(&fleet, &fresh.fleet, NULL), "fleet");

  memset(&error, 0, sizeof error);
  error.struct_size = sizeof error;
}

static void end(void) {
  cairn_fleet_destroy(fresh.fleet);
  cairn_world_destroy(fresh.world);
  cairn_team_destroy(fresh.team);
  cairn_map_destroy(fresh.map);
  cairn_filter_destroy(fresh.filter);
  calls_made++;
}

/* Whether the call was refused with a message that has these words. */
static int names(cairn_status status, const char *words) {
  return status == CAIRN_ERROR_ARGUMENT && strstr(error.message, words) != NULL;
}

static void judge_null(cairn_status status, const char *function, const char *pointer, int optional) {
  char refusal[64];
  snprintf(refusal, sizeof refusal, "%s is NULL", pointer);
  const size_t length = strlen(refusal);
  const int refused = status == CAIRN_ERROR_ARGUMENT && strncmp(error.message, refusal, length) == 0;
  if (refused == !optional) return;
  fprintf(stderr, "%s(%s = NULL): the mark says it may %sbe NULL, and the call returns %s: %s\n", function, pointer,
          optional ? "" : "not ", cairn_status_name(status), error.message);
  failures++;
}

static void judge_parameter(cairn_status status, const char *function, const char *parameter, const char *value) {
  if (names(status, parameter)) return;
  fprintf(stderr, "%s(%s = %s): it is not refused by its name, and the call returns %s: %s\n", function, parameter,
          value, cairn_status_name(status), error.message);
  failures++;
}

/* `takers` functions take the option, `refusals` of them refused it. One is enough: a team refuses more than a
 * filter. */
static void judge_option(int refusals, int takers, int expected, const char *field, const char *value) {
  if (expected ? refusals > 0 : refusals < takers) return;
  fprintf(stderr, "%s = %s: it is %srefused by its name; the last call said: %s\n", field, value,
          expected ? "not " : "", error.message);
  failures++;
}

static int report(void) {
  printf("%d calls, %d failures\n", calls_made, failures);
  return failures != 0;
}

#endif
