/* SPDX-License-Identifier: BSD-3-Clause */
/* Helpers of the tests of libcairn_sim. */
#include "support.h"

void check_near(double actual, double expected, double tolerance, const char* what, const char* file, int line) {
  if (fabs(actual - expected) <= tolerance) return;
  print_error("%s: %.17g against %.17g, tolerance %g\n", what, actual, expected, tolerance);
  _fail(file, line);
}

void check_between(double actual, double lower, double upper, const char* what, const char* file, int line) {
  if (actual >= lower && actual <= upper) return;
  print_error("%s: %.17g lies outside [%g, %g]\n", what, actual, lower, upper);
  _fail(file, line);
}

void check_status(cairn_status actual, cairn_status expected, const char* word, const char* call, const char* file,
                  int line) {
  if (actual == expected && strstr(expected == CAIRN_OK ? "" : cairn_sim_last_message(), word) != NULL) return;
  print_error("%s: %s, expected %s with '%s': %s\n", call, cairn_status_name(actual), cairn_status_name(expected), word,
              cairn_sim_last_message());
  _fail(file, line);
}

cairn_world_options default_options(void) {
  cairn_world_options options;
  assert_ok(cairn_world_options_init(&options, sizeof options, NULL));
  return options;
}

cairn_world_options preset_options(int32_t preset) {
  cairn_world_options options = default_options();
  assert_ok(cairn_world_options_preset(&options, preset, NULL, NULL));
  return options;
}

cairn_world* open_world(const cairn_world_options* options) {
  cairn_world* world = NULL;
  assert_ok(cairn_world_create(options, &world, NULL));
  return world;
}

size_t steps_of(const cairn_world* world) {
  size_t steps = 0;
  assert_ok(cairn_world_steps(world, &steps, NULL));
  return steps;
}

/* The arrays of the last step of each simulation. A test uses few simulations at a time; a slot is used again. */
typedef struct store {
  const void* owner;
  void* arrays[3]; /* motions and observations; or boats, with all their sightings in the second one */
} store;

static store* store_of(const void* owner) {
  static store stores[16];
  static size_t next;
  size_t i;
  for (i = 0; i < LENGTH(stores); ++i)
    if (stores[i].owner == owner) return &stores[i];
  next = (next + 1) % LENGTH(stores);
  stores[next].owner = owner;
  return &stores[next];
}

static void* room(store* of, size_t array, size_t bytes) {
  of->arrays[array] = realloc(of->arrays[array], bytes + 1);
  assert_non_null(of->arrays[array]);
  return of->arrays[array];
}

world_step next_step(cairn_world* world) {
  store* kept = store_of(world);
  cairn_world_step step;
  cairn_world_motion* motions;
  cairn_observation* observations;
  world_step out;
  step.struct_size = sizeof step;
  assert_ok(cairn_world_next(world, &step, NULL));
  out.number = step.number, out.time = step.time, out.truth = step.truth, out.pan = step.pan, out.stick = step.stick;
  memcpy(out.velocity_sigma, step.velocity_sigma, sizeof out.velocity_sigma);
  memcpy(out.rate_sigma, step.rate_sigma, sizeof out.rate_sigma);
  out.motion_count = out.observation_count = 0;
  motions = room(kept, 0, step.motion_count * sizeof *motions);
  observations = room(kept, 1, step.observation_count * sizeof *observations);
  assert_ok(cairn_world_motions(world, motions, step.motion_count, &out.motion_count, NULL));
  assert_ok(cairn_world_observations(world, observations, step.observation_count, &out.observation_count, NULL));
  assert_int_equal(out.motion_count, step.motion_count);
  assert_int_equal(out.observation_count, step.observation_count);
  out.motions = motions, out.observations = observations;
  return out;
}

cairn_fleet_options default_fleet_options(void) {
  cairn_fleet_options options;
  assert_ok(cairn_fleet_options_init(&options, sizeof options, NULL));
  return options;
}

cairn_fleet* open_fleet(const cairn_fleet_options* options) {
  cairn_fleet* fleet = NULL;
  assert_ok(cairn_fleet_create(options, &fleet, NULL));
  return fleet;
}

fleet_step next_fleet_step(cairn_fleet* fleet) {
  store* kept = store_of(fleet);
  cairn_fleet_step step;
  cairn_fleet_vehicle* from;
  cairn_fleet_sighting* sighting;
  fleet_step out;
  boat* boats;
  size_t i, needed = 0, sightings = 0;
  step.struct_size = sizeof step;
  assert_ok(cairn_fleet_next(fleet, &step, NULL));
  from = room(kept, 2, step.vehicle_count * sizeof *from);
  assert_ok(cairn_fleet_vehicles(fleet, from, step.vehicle_count, &out.vehicle_count, NULL));
  assert_int_equal(out.vehicle_count, step.vehicle_count);
  for (i = 0; i < out.vehicle_count; ++i) sightings += from[i].feature_count + from[i].vehicle_count;
  boats = room(kept, 0, out.vehicle_count * sizeof *boats);
  sighting = room(kept, 1, sightings * sizeof *sighting);
  for (i = 0; i < out.vehicle_count; ++i) {
    boat* to = &boats[i];
    to->speed = from[i].speed, to->rate = from[i].rate, to->x = from[i].x, to->y = from[i].y;
    to->heading = from[i].heading;
    to->feature_count = from[i].feature_count, to->vehicle_count = from[i].vehicle_count;
    to->features = sighting;
    assert_ok(cairn_fleet_seen_features(fleet, i + 1, sighting, to->feature_count, &needed, NULL));
    assert_int_equal(needed, to->feature_count);
    to->vehicles = sighting += to->feature_count;
    assert_ok(cairn_fleet_seen_vehicles(fleet, i + 1, sighting, to->vehicle_count, &needed, NULL));
    assert_int_equal(needed, to->vehicle_count);
    sighting += to->vehicle_count;
  }
  out.number = step.number, out.time = step.time, out.dt = step.dt, out.vehicles = boats;
  return out;
}

void to_body(const cairn_pose* T_map_body, const double point[3], double out[3]) {
  cairn_pose inverse;
  assert_int_equal(cairn_pose_inverse(T_map_body, &inverse, NULL), CAIRN_OK);
  assert_int_equal(cairn_pose_apply(&inverse, point, out, NULL), CAIRN_OK);
}

/* 64 short steps of second order, independent of the library's exponential. */
cairn_pose moved(const cairn_pose* pose, const double velocity[3], const double rate[3], double dt) {
  cairn_pose result = *pose, half, step;
  double way[3], turn[3];
  int i, k;
  for (k = 0; k < 64; ++k) {
    for (i = 0; i < 3; ++i) way[i] = velocity[i] * dt / 64, turn[i] = rate[i] * dt / 128;
    memset(half.position, 0, sizeof half.position);
    assert_int_equal(cairn_quaternion_exp(turn, half.quaternion, NULL), CAIRN_OK);
    memcpy(step.position, way, sizeof way);
    step.quaternion[0] = 1, step.quaternion[1] = step.quaternion[2] = step.quaternion[3] = 0;
    assert_int_equal(cairn_pose_compose(&result, &half, &result, NULL), CAIRN_OK);
    assert_int_equal(cairn_pose_compose(&result, &step, &result, NULL), CAIRN_OK);
    assert_int_equal(cairn_pose_compose(&result, &half, &result, NULL), CAIRN_OK);
  }
  return result;
}

void tally_add(tally* t, double value) {
  t->count += 1, t->sum += value, t->square += value * value;
}
double tally_mean(const tally* t) {
  return t->sum / t->count;
}
double tally_sigma(const tally* t) {
  return sqrt(t->square / t->count);
}
