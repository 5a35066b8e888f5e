/* SPDX-License-Identifier: BSD-3-Clause */
/* Shared by the tests of the C interface: a small world with its own noise, filters that live in it, snapshots of
 * everything that a filter tells about its state, and checks of refused calls. */
#ifndef CAIRN_TESTS_CAPI_SUPPORT_H
#define CAIRN_TESTS_CAPI_SUPPORT_H

/* cmocka.h needs these four headers before it. */
/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <cairn/cairn.h>
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
#define assert_ok(call) check_status((call), CAIRN_OK, #call, __FILE__, __LINE__)
#define assert_status(call, status) check_status((call), (status), #call, __FILE__, __LINE__)
void check_near(double actual, double expected, double tolerance, const char* what, const char* file, int line);
void check_status(cairn_status actual, cairn_status expected, const char* call, const char* file, int line);

/* A random generator with the same numbers on every machine. */
typedef struct generator {
  uint64_t state;
} generator;
uint64_t random_bits(generator* random);
double random_uniform(generator* random, double lower, double upper);
double random_normal(generator* random, double sigma);

/* Rotations, written independently of the library. */
void rotation_matrix(const double quaternion[4], double matrix[9]);
void cross_matrix(const double v[3], double matrix[9]);
void multiply3(const double a[9], const double b[9], double out[9]);
void to_body(const cairn_pose* pose, const double point[3], double out[3]);
void to_map(const cairn_pose* pose, const double point[3], double out[3]);
cairn_pose pose_at(double x, double y, double z, double roll, double pitch, double yaw);
void diagonal(double* matrix, int size, double value);

/* Sensors of a rig. POINT is a custom sensor that equals CARTESIAN, RANGE a custom one of one row that places nothing.
 */
enum { HEAD, CAMERA, CARTESIAN, POINT, RANGE, SENSORS };
enum { WHEELS, TWIST, INCREMENT, MOTIONS };
#define WORLD_LANDMARKS 12

int32_t point_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z, double* jacobian_pose,
                      double* jacobian_landmark);
int32_t point_place(void* user, const cairn_pose* pose, const double* z, double landmark[3], double* jacobian_pose,
                    double* jacobian_z);
int32_t range_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z, double* jacobian_pose,
                      double* jacobian_landmark);
cairn_stereo_head test_head(void);
cairn_stereo_camera test_camera(void);
cairn_cartesian test_cartesian(void);
/* A sensor of the caller's own: its description, its functions and their pointer. */
typedef struct own_sensor {
  cairn_custom model;
  cairn_custom_predict_fn predict;
  cairn_custom_place_fn place;
  void* user;
} own_sensor;
own_sensor test_point(void);
own_sensor test_range(void);
cairn_status add_own(cairn_filter* filter, const own_sensor* own, int32_t* sensor);
cairn_status check_own(const own_sensor* own, const cairn_pose* pose, const double landmark[3], double* worst);

/* The inputs of one step: plain data, so that several filters can use the same. */
typedef struct frame {
  int motion;
  double dt, left, right, velocity[3], rate[3];
  cairn_pose increment;
  double increment_covariance[36];
  int sensor;
  double pan, stick;
  cairn_observation observations[WORLD_LANDMARKS];
  size_t count;
  bool has_position, has_attitude, has_heading;
  double position[3], quaternion[4], heading;
} frame;

typedef struct world {
  generator random;
  cairn_pose truth;
  double landmarks[WORLD_LANDMARKS][3];
  double noise; /* noise of everything, in proportion to the noise that the sensors state; 0 gives perfect inputs */
  unsigned step;
} world;

void world_init(world* w, uint64_t seed);
/* Moves the vehicle and gives its measurements. Landmark i has the id i + 1. */
void world_frame(world* w, frame* f);
/* The observation of `point` by `sensor` from the true pose, without noise. False if it is not visible. */
bool world_see(const world* w, int sensor, double pan, double stick, const double point[3], double z[3]);

/* A filter with all sensors of the world. */
typedef struct rig {
  cairn_filter* filter;
  int32_t sensors[SENSORS];
} rig;

/* The world's start pose, a moderate start covariance, and room for exactly the landmarks of the world. */
cairn_filter_options test_options(void);
void rig_open(rig* r, const cairn_filter_options* options);
void rig_close(rig* r);
/* Processes a step. `matches` (room for WORLD_LANDMARKS) may be NULL. Returns the first status that is not CAIRN_OK. */
cairn_status rig_take(rig* r, const frame* f, cairn_match* matches);

/* The report of the last update. */
cairn_update_report last_update(const cairn_filter* filter);

/* A frame was given to a filter that knew the landmark ids (`known`) and to one that did not (`found`). Both must have
 * decided alike. `name_of` maps the landmark numbers of the second filter to the ids of the first; new landmarks are
 * added to it. Returns the number of matched observations. */
size_t check_same_matches(const cairn_match* known, const cairn_match* found, size_t count, uint64_t* name_of);
/* Joint compatibility must match one of two observations, number k with landmark k, and refuse the other as ambiguous.
 * Returns the number of the refused one. */
int check_one_of_two_matches(const cairn_match matches[2]);
/* Pose and covariance are the same to the bit. */
void check_same_pose(const cairn_filter* a, const cairn_filter* b);

/* Everything that a filter tells about its state, as bytes. */
typedef struct snapshot {
  size_t size;
  unsigned char* bytes;
} snapshot;
void snapshot_take(snapshot* s, const cairn_filter* filter); /* frees what `s` held */
bool snapshot_same(const snapshot* a, const snapshot* b);
void snapshot_free(snapshot* s);

/* Two filters with the same inputs. Calls that must fail go to `main` only, and both filters must stay equal. */
typedef struct bench {
  world world;
  rig main, shadow;
  snapshot before, after;
} bench;
int bench_setup(void** state);
int bench_teardown(void** state);
void bench_open(bench* b, const cairn_filter_options* options, unsigned steps);
void bench_close(bench* b);
void bench_continue(bench* b, unsigned steps);
/* Continues to a frame in which `sensor` sees at least four landmarks. Both filters have moved there, and neither has
 * processed the frame. */
frame bench_until(bench* b, int sensor);

/* A call that must fail with `status` and a message that contains `name`. If `b` is not NULL, its main filter must be
 * unchanged to the bit, and must continue like the shadow that never got the call. */
#define assert_refused(b, status, name, call)                                \
  do {                                                                       \
    refusal_expected((b), (name));                                           \
    refusal_check((b), (call), (status), (name), #call, __FILE__, __LINE__); \
  } while (0)
void refusal_expected(bench* b, const char* name);
void refusal_check(bench* b, cairn_status actual, cairn_status expected, const char* name, const char* call,
                   const char* file, int line);

/* Values that no argument may have. */
extern const double not_finite[3];

#endif
