/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Simulated worlds for filters: terrain, landmarks, a rover, its sensors with their noise, and the truth.
 *
 *  These functions are in a separate library, libcairn_sim (pkg-config cairn-sim, CMake target cairn::cairn_sim).
 *  This header is not part of cairn.h. It has the types, conventions and rules of libcairn. It needs no filter: any
 *  estimator that uses motions and observations can be driven by it.
 *
 *  The scenario is that of the Mars paper. A rover with four wheels drives along a course on rolling ground, measures
 *  its motion by IMU and wheels, and observes landmarks by a stereo head on a pan and tilt mount. The paper leaves
 *  much open. Each such choice is an option, and its comment says so. Random draws depend only on the seed. The
 *  library has its own generator, which gives the same draws on every machine; values that pass through the
 *  trigonometry of the C library may differ in their last digits. Each frame and each sample has draws of its own, so
 *  a change of one option does not change the draws of the others. */
#ifndef CAIRN_SIM_H
#define CAIRN_SIM_H

#include <cairn/motion.h>
#include <cairn/pose.h>
#include <cairn/sensor.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A world with one rover that drives through it. */
typedef struct cairn_world cairn_world;

/** Courses. On each the rover has a constant speed over the xy plane of the map. */
typedef int32_t cairn_course;
enum CAIRN_VALUES(cairn_course) {
  CAIRN_COURSE_CIRCLE = 0,  /**< the course of the paper: a circle, driven anticlockwise; the default */
  CAIRN_COURSE_LAPS = 1,    /**< a wandering closed curve, driven several times */
  CAIRN_COURSE_TRAVERSE = 2 /**< a long drive: a chain of circles, alternately left and right. Each circle is driven
                                 1.25 times before the next one is entered where both touch. So each circle closes a
                                 loop, and a quarter of it is seen again */
};

/** Ground. */
typedef int32_t cairn_terrain;
enum CAIRN_VALUES(cairn_terrain) {
  CAIRN_TERRAIN_ROLLING = 0, /**< seeded smooth hills, shifted to `start_height` at (100, 20); the default */
  CAIRN_TERRAIN_WAVES = 1,   /**< z = sin(x / 15) + 0.8 cos(y / 12); the same for every seed; not shifted */
  CAIRN_TERRAIN_FLAT = 2     /**< z = 0 */
};

/** How the rover stands on the ground. Seen from above, its x axis points along the course. */
typedef int32_t cairn_contact;
enum CAIRN_VALUES(cairn_contact) {
  CAIRN_CONTACT_WHEELS = 0, /**< on four wheels; a differential averages the left and the right rocker. All four
                                 wheels touch the ground, and height and attitude are those of the chassis between
                                 them; the default */
  CAIRN_CONTACT_POINT = 1   /**< at one point; its z axis is the normal of the ground */
};

/** Measurements that the motion samples of a step hold as `velocity` and `rate`. */
typedef int32_t cairn_drive;
enum CAIRN_VALUES(cairn_drive) {
  CAIRN_DRIVE_TWIST = 0,      /**< body velocity and body rate from the IMU; the default */
  CAIRN_DRIVE_WHEELS_GYRO = 1 /**< forward velocity from the wheels (Mars paper, eq. 1), zero along y and z; body
                                   rate from the gyro */
};

/** Noise of the accelerometer. Table 1 of the paper gives it in m/s. */
typedef int32_t cairn_accelerometer;
enum CAIRN_VALUES(cairn_accelerometer) {
  CAIRN_ACCELEROMETER_VELOCITY = 0,    /**< white noise of the body velocity, m/s a sample; the default */
  CAIRN_ACCELEROMETER_ACCELERATION = 1 /**< white noise of the acceleration, m/s^2 a sample: the velocity comes from
                                            dead reckoning of specific force and rate from a known start, and drifts */
};

/** How the noise of the stick angle enters. */
typedef int32_t cairn_stick;
enum CAIRN_VALUES(cairn_stick) {
  CAIRN_STICK_PER_OBSERVATION = 0, /**< independent in each observation's elevation; the default */
  CAIRN_STICK_PER_FRAME = 1        /**< all observations of a frame share one encoder error; the image adds noise of
                                        `image_sigma` to each elevation */
};

/** Options of \ref cairn_world_create. Set them by \ref cairn_world_options_init first; the defaults are
 *  Table 1 of the paper, with the open choices filled in. */
typedef struct cairn_world_options {
  uint32_t struct_size;              /**< sizeof(cairn_world_options) of the caller */
  cairn_course course;               /**< CAIRN_COURSE_...; default CAIRN_COURSE_CIRCLE */
  uint64_t seed;                     /**< seed of all random draws; default 1 */
  uint32_t landmarks;                /**< number of landmarks, 1 to 10000000; default 200 (Table 1). The length of
                                          laps and traverse follows from it */
  cairn_terrain terrain;             /**< CAIRN_TERRAIN_...; default CAIRN_TERRAIN_ROLLING */
  cairn_contact contact;             /**< CAIRN_CONTACT_...; default CAIRN_CONTACT_WHEELS */
  cairn_drive drive;                 /**< CAIRN_DRIVE_...; default CAIRN_DRIVE_TWIST */
  cairn_accelerometer accelerometer; /**< CAIRN_ACCELEROMETER_...; default CAIRN_ACCELEROMETER_VELOCITY */
  cairn_stick stick_noise;           /**< CAIRN_STICK_...; default CAIRN_STICK_PER_OBSERVATION */
  cairn_bool observe_at_start;       /**< 1: step 0, the known start, has a frame, too; default 0: the first frame
                                          comes one frame period later */
  cairn_bool traverse_closed;        /**< 1: the circles of the traverse lie on one big ring, and the drive ends with
                                          a round of the first circle; this needs at least 1600 landmarks at the
                                          default strip and area; default 0 */
  double speed;                      /**< speed over the xy plane, m/s, > 0; default 2 pi hypot(100, 20) / 400: the
                                          default circle in 400 s (Table 1) */
  CAIRN_UNIT(1)
  double laps;                       /**< rounds of circle and laps, > 0; 0, the default: 1 round of a circle, 2
                                          rounds of laps. Not used by a traverse */
  double centre[2];                  /**< centre of the circle, x and y, m; default the origin (not in the paper) */
  double radius;                     /**< radius of the circle, m, > strip; 0, the default: hypot(100, 20) landmarks
                                          / 200. With it the default start is (100, 20) as in Table 1, and the
                                          density of landmarks does not depend on their number */
  double start_azimuth;              /**< azimuth of the start as seen from the centre of the circle, rad; default
                                          atan2(20, 100) */
  double round_length;               /**< circumference of the circles of the traverse, m, > 0; default 1500. They
                                          are scaled so that all landmarks are used */
  CAIRN_UNIT(1)
  double round_variation;            /**< share by which the seed varies this length, [0, 0.3]; default 0.1 */
  double strip;                      /**< landmarks lie within this distance of the course, m, > 0; default 25 */
  double landmark_area;              /**< area of ground for each landmark of laps and traverse, m^2, > 0; default
                                          160 */
  double landmark_height;            /**< landmarks are between 0 and this height above the ground, m, >= 0; default
                                          1.5 */
  double max_slope;                  /**< largest slope of the rolling ground, rad, [0, 45 degrees]; default 15
                                          degrees */
  double wavelength[2];              /**< shortest and longest wave of the rolling ground, m, > 0; default 25 and 150 */
  double start_height;               /**< height of the rolling ground at (100, 20), m; default -0.3174 (Table 1) */
  double wheel_radius;               /**< m, > 0; default 0.3 (Table 1) */
  double track;                      /**< distance between left and right wheels, m, > 0; default 1.0 (not in the
                                          paper) */
  double wheelbase;                  /**< distance between front and rear wheels, m, > 0; default 1.2 (not in the
                                          paper) */
  CAIRN_UNIT(m/s or m/s^2)
  double velocity_sigma;             /**< white noise per sample and axis, m/s or m/s^2 (`accelerometer`), >= 0;
                                          default 2e-3 (Table 1) */
  double rate_sigma;                 /**< white noise of the gyro per sample and axis, rad/s, >= 0; default 0.02
                                          degrees/s (Table 1) */
  double gravity;                    /**< m/s^2, >= 0; default 3.71. Only CAIRN_ACCELEROMETER_ACCELERATION uses it */
  double wheel_rate_sigma;           /**< white noise of each side's wheel rate per sample, rad/s, >= 0; default 0.01 */
  CAIRN_UNIT(1)
  double wheel_slip_sigma;           /**< white noise of each side's wheel rate in proportion to this rate, >= 0;
                                          default 0.02 */
  double lateral_sigma;              /**< noise that a step states for the velocity along y, which wheels do not
                                          measure, m/s, >= 0; default 0.01 */
  double vertical_sigma;             /**< the same along z, m/s, >= 0; default 0.01 */
  double imu_period;                 /**< period of IMU and wheel samples, s, > 0; default 0.05: 20 Hz (Table 1) */
  double motion_period;              /**< period of the motion samples in a step, s: a multiple of imu_period. IMU
                                          samples are composed into one motion sample. Default 0.2, the sampling
                                          period of Table 1 */
  double frame_period;               /**< period of the camera, s: a multiple of motion_period; default 2: 0.5 Hz
                                          (Table 1) */
  double range_sigma;                /**< noise of a range, m, > 0; default 1 (Table 1) */
  double azimuth_sigma;              /**< noise of an azimuth, rad, > 0; default 3 degrees (Table 1) */
  double stick_sigma;                /**< noise of the stick angle, rad, > 0; default 3 degrees (Table 1) */
  double image_sigma;                /**< noise of each elevation with CAIRN_STICK_PER_FRAME, rad, > 0; default 0.5
                                          degrees */
  double near_range;                 /**< shortest distance at which the camera sees a landmark, m, > 0; default 2
                                          (not in the paper) */
  double far_range;                  /**< longest such distance, m, > near_range; default 40 (not in the paper) */
  double half_azimuth;               /**< largest azimuth from the axis of the camera, rad, (0, pi]; default 60
                                          degrees (not in the paper) */
  double pan_amplitude;              /**< the head scans: pan = amplitude sin(2 pi t / period), rad, [0, pi]; default
                                          0: fixed forward */
  double pan_period;                 /**< s, > 0; default 20 */
  double stick_amplitude;            /**< the same for the stick, rad, [0, 60 degrees]; default 0 */
  double stick_period;               /**< s, > 0; default 26 */
  double platform[3];                /**< d of \ref cairn_stereo_head, m; default 0 (not in the paper) */
  double stick[3];                   /**< s of \ref cairn_stereo_head, m; default 0 (not in the paper) */
  double velocity_bias[3];           /**< systematic errors of the rover, which \ref cairn_world_head and \ref
                                          cairn_world_wheels do not tell (docs/systematic_errors.md). Added to the
                                          measured body velocity, m/s; default 0; the wheels turn faster by the first
                                          component */
  double rate_bias[3];               /**< added to the rate of the gyro, rad/s; default 0 */
  CAIRN_UNIT(1)
  double wheel_scale[2];             /**< left and right: a wheel turns at its measured rate times 1 + this, > -1;
                                          default 0 */
  double mount_turn[3];              /**< rotation vector by which the head is turned about the origin of the body,
                                          rad; default 0 */
  double mount_shift[3];             /**< by which the head is shifted after that, m; default 0 */
  CAIRN_UNIT(m, rad, rad)
  double value_offset[3];            /**< added to the observed range (m), azimuth and elevation (rad); default 0 */
} cairn_world_options;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_world_options_init(CAIRN_OUT cairn_world_options *options, size_t struct_size,
                                                cairn_error *error);

/** Worlds for measurements. In the rows, velocity and rate noise are those of a sample of 0.2 s. The rows use
 *  CAIRN_TERRAIN_WAVES, CAIRN_CONTACT_POINT and a radius of 101.98 m. */
typedef int32_t cairn_preset;
enum CAIRN_VALUES(cairn_preset) {
  CAIRN_PRESET_PAPER = 0, /**< the defaults: Table 1 as printed */
  CAIRN_PRESET_ROW1 = 1,  /**< 0.002 m/s, 0.02 degrees/s, 1 lap in 400 s */
  CAIRN_PRESET_ROW2 = 2,  /**< 0.05 m/s, 0.2 degrees/s, 1 lap in 400 s */
  CAIRN_PRESET_ROW3 = 3,  /**< 0.05 m/s, 0.2 degrees/s, 2 laps in 400 s */
  CAIRN_PRESET_ROW4 = 4   /**< 0.2 m/s, 1 degree/s, 2 laps in 400 s */
};

/** Sets all options except `struct_size` and `seed` to those of a preset. `submap_landmarks` (or NULL) gets the size of
 *  submaps that belongs to the preset: 40, or 20 for rows 3 and 4. Set `options->struct_size` first.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_world_options_preset(CAIRN_INOUT cairn_world_options *options, cairn_preset preset,
                                                  CAIRN_OUT CAIRN_OPTIONAL uint32_t *submap_landmarks,
                                                  cairn_error *error);

/** Creates a world before its first step. The caller destroys it with \ref cairn_world_destroy. Options of an older or
 *  a newer header are used as far as both sides know them. On an error `*world` is not written.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY, CAIRN_ERROR_NUMERICAL (the ground is too rough for
 *  four wheels). Complexity: O(n log n) for n landmarks; memory: 40 bytes for each landmark. \since 0.1.0 */
CAIRN_API cairn_status cairn_world_create(const cairn_world_options *options, cairn_world **world, cairn_error *error);

/** Destroys a world. NULL is allowed. Threads: one a handle. Complexity: O(memory). \since 0.1.0 */
CAIRN_API void cairn_world_destroy(cairn_world *world);

/** A motion sample: measured and true motion of the rover during `dt` seconds. Layout frozen. */
typedef struct cairn_world_motion {
  double dt;               /**< s */
  CAIRN_UNIT(m/s)
  double velocity[3];      /**< measured velocity, body axes, m/s (`drive`) */
  double rate[3];          /**< measured rate, body axes, rad/s */
  double wheels[2];        /**< measured turning rates of the left and the right wheels, rad/s: means over dt */
  double true_velocity[3]; /**< true velocity, m/s. With true_rate it leads from the true pose before to the true
                                pose after: T <- T Exp([v; w] dt) */
  double true_rate[3];     /**< true rate, rad/s */
  double true_wheels[2];   /**< true turning rates, rad/s: those that follow from eq. 1 of the paper */
} cairn_world_motion;

/** A step: the motion samples since the previous step (\ref cairn_world_motions), then one frame
 *  (\ref cairn_world_observations). */
typedef struct cairn_world_step {
  uint32_t struct_size;       /**< sizeof(cairn_world_step) of the caller; set it before the call */
  uint32_t reserved;          /**< 0 */
  uint64_t number;            /**< counted from 0; step 0 is the start */
  double time;                /**< s, from 0 */
  cairn_pose truth;           /**< true pose of the body in the map at the end of the step */
  CAIRN_UNIT(m/s)
  double velocity_sigma[3];   /**< noise of the `velocity` of each motion sample, for \ref cairn_twist_noise. The
                                   drift of an accelerometer is stated by its size at this time, as if it were white
                                   noise */
  CAIRN_UNIT(rad/s)
  double rate_sigma[3];       /**< noise of the `rate` of each motion sample */
  double pan;                 /**< pan angle of the head, from its encoder, rad */
  double stick;               /**< stick angle of the head, from its encoder, rad */
  uint64_t motion_count;      /**< motion samples of the step, for \ref cairn_world_motions; 0 at step 0 */
  uint64_t observation_count; /**< observations of the frame, for \ref cairn_world_observations */
} cairn_world_step;

/** Returns the next step. Set `step->struct_size` first. Nothing is stored, so memory does not grow with the drive.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (there are no more steps),
 *  CAIRN_ERROR_NUMERICAL (the ground is too rough for four wheels).
 *  Complexity: O(motions + landmarks in range). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_next(cairn_world *world, CAIRN_OUT cairn_world_step *step, cairn_error *error);

/** The motion samples of the last step, in order; none before the first step. Capacity 0 asks for their number.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n).
 *  \since 0.2.0 */
CAIRN_API cairn_status cairn_world_motions(const cairn_world *world,
                                           CAIRN_OUT_ARRAY(capacity) cairn_world_motion *motions, size_t capacity,
                                           size_t *needed, cairn_error *error);

/** The observations of the last step's frame, by ascending id, z as \ref cairn_stereo_head defines it, covariance zero;
 *  none before the first step. Capacity 0 asks for their number. Threads: as any const query of the handle. Errors:
 *  CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n). \since 0.2.0 */
CAIRN_API cairn_status cairn_world_observations(const cairn_world *world,
                                                CAIRN_OUT_ARRAY(capacity) cairn_observation *observations,
                                                size_t capacity, size_t *needed, cairn_error *error);

/** Goes back to before the first step. The same drive follows, bit for bit. Threads: one a handle. Errors:
 *  CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_rewind(cairn_world *world, cairn_error *error);

/** Number of steps, including the start. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT.
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_steps(const cairn_world *world, CAIRN_OUT size_t *steps, cairn_error *error);

/** Upper bound of the number of observations in a frame, for \ref cairn_filter_options. Threads: as any const query
 *  of the handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_most_observations(const cairn_world *world, CAIRN_OUT size_t *count,
                                                     cairn_error *error);

/** The stereo head of the world, to be added to a filter: mount, noise, encoder mode. Set `head->struct_size` first.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_world_head(const cairn_world *world, CAIRN_OUT cairn_stereo_head *head,
                                        cairn_error *error);

/** The wheels of the rover, for \ref cairn_filter_set_wheels, with the noise of the wheel rates of one motion sample.
 *  Set `wheels->struct_size` first. The noise of rates that wheels do not measure is that of \ref cairn_wheels_init.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_world_wheels(const cairn_world *world, CAIRN_OUT cairn_wheels *wheels, cairn_error *error);

/** True pose of the body in the map at `time` (s, 0 to the end of the drive). The origin of the body lies on the
 *  ground in the middle between the wheels. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_world_pose(const cairn_world *world, CAIRN_UNIT(s) CAIRN_RANGE(>= 0) double time,
                                        CAIRN_OUT cairn_pose *pose, cairn_error *error);

/** Points at which the wheels touch the ground at `time`: front left, front right, rear left, rear right, x y z each,
 *  in the map, m. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE
 *  (CAIRN_CONTACT_POINT).
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_world_contacts(const cairn_world *world, CAIRN_UNIT(s) CAIRN_RANGE(>= 0) double time,
                                            CAIRN_OUT CAIRN_UNIT(m) double points[12], cairn_error *error);

/** Height of the ground at x, y (m), m. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT.
 *  Complexity: O(1).
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_world_height(const cairn_world *world, CAIRN_UNIT(m) double x, CAIRN_UNIT(m) double y,
                                          CAIRN_OUT CAIRN_UNIT(m) double *height, cairn_error *error);

/** The rectangle in the xy plane that contains the course and all landmarks, m. Threads: as any const query of the
 *  handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_extent(const cairn_world *world, CAIRN_OUT CAIRN_UNIT(m) double lower[2],
                                          CAIRN_OUT CAIRN_UNIT(m) double upper[2], cairn_error *error);

/** True position (m) of the landmark `id`, 0 to the number of landmarks minus 1. Threads: as any const query of the
 *  handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_landmark(const cairn_world *world, uint64_t id,
                                            CAIRN_OUT CAIRN_UNIT(m) double position[3], cairn_error *error);

/** True positions of all landmarks, x y z each, m, by ascending id. `capacity` and `*needed` count landmarks; capacity
 *  0 asks for their number. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_landmarks(const cairn_world *world,
                                             CAIRN_OUT_ARRAY(3 * capacity) CAIRN_UNIT(m) double *positions,
                                             size_t capacity, size_t *needed, cairn_error *error);

/** One line about the last call of this library that failed in this thread, like \ref cairn_last_message for libcairn.
 *  Threads: any. \since 0.1.0 */
CAIRN_API CAIRN_BORROWED(thread) const char *cairn_sim_last_message(void);

#ifdef __cplusplus
}
#endif

#endif
