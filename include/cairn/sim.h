/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Worlds to try a filter in: terrain, landmarks, a rover, its sensors with their noise, and the truth.
 *
 *  These functions live in a library of their own, libcairn_sim (pkg-config cairn-sim, CMake target cairn::cairn_sim),
 *  and this header is not part of cairn.h. It shares libcairn's types, conventions and rules, and needs no filter:
 *  whatever takes motions and observations can be driven by it.
 *
 *  The scenario is the Mars paper's: a rover whose four wheels follow rolling ground drives along a course, measures
 *  its motion by IMU and wheels, and looks at landmarks by a stereo head on a pan and tilt mount. The paper leaves much
 *  open; each such choice is an option, and says so. Random draws come from the seed alone, with a generator of the
 *  library's own: the same on every machine; what the C library's trigonometry makes of them agrees to its last digits.
 *  Each frame's and each sample's draws are its own, so that turning one option leaves the draws of others as they
 *  were. */
#ifndef CAIRN_SIM_H
#define CAIRN_SIM_H

#include <cairn/motion.h>
#include <cairn/pose.h>
#include <cairn/sensor.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A world with one rover on its way. */
typedef struct cairn_world cairn_world;

/** Courses. On each the rover keeps a constant speed over the map's xy plane. */
enum {
  CAIRN_COURSE_CIRCLE = 0,  /**< the paper's: a circle, driven anticlockwise; the default */
  CAIRN_COURSE_LAPS = 1,    /**< a wandering closed curve, driven several times */
  CAIRN_COURSE_TRAVERSE = 2 /**< a long drive: a chain of circles, left and right by turns; each is driven 1.25 times
                                 round before the next is entered where both touch, so that each closes a loop and a
                                 quarter of it is seen again */
};

/** Ground. */
enum {
  CAIRN_TERRAIN_ROLLING = 0, /**< seeded smooth hills, shifted to `start_height` at (100, 20); the default */
  CAIRN_TERRAIN_WAVES = 1,   /**< z = sin(x / 15) + 0.8 cos(y / 12), the same for every seed; not shifted */
  CAIRN_TERRAIN_FLAT = 2     /**< z = 0 */
};

/** How the rover stands on the ground. Its x axis points along the course, seen from above. */
enum {
  CAIRN_CONTACT_WHEELS = 0, /**< on four wheels, left and right rocker averaged by a differential: all four touch the
                                 ground, height and attitude are those of the chassis between them; the default */
  CAIRN_CONTACT_POINT = 1   /**< at one point, its z axis the ground's normal */
};

/** Which measurements a step's motion samples hold as `velocity` and `rate`. */
enum {
  CAIRN_DRIVE_TWIST = 0,      /**< body velocity and body rate of the IMU; the default */
  CAIRN_DRIVE_WHEELS_GYRO = 1 /**< forward velocity from the wheels (Mars paper, eq. 1), zero along y and z; the gyro's
                                   rate */
};

/** What the noise of the accelerometer is. The paper's Table 1 gives it in m/s. */
enum {
  CAIRN_ACCELEROMETER_VELOCITY = 0,    /**< white noise of the body velocity, m/s a sample; the default */
  CAIRN_ACCELEROMETER_ACCELERATION = 1 /**< white noise of the acceleration, m/s^2 a sample: the velocity is what dead
                                            reckoning from a known start makes of specific force and rate, and drifts */
};

/** How the noise of the stick angle enters. */
enum {
  CAIRN_STICK_PER_OBSERVATION = 0, /**< independent in each observation's elevation; the default */
  CAIRN_STICK_PER_FRAME = 1        /**< one encoder error common to a frame; the image adds `image_sigma` to each
                                        elevation */
};

/** Options of \ref cairn_world_create. Set them by \ref cairn_world_options_init first; the defaults are the paper's
 *  Table 1 with the open choices filled in. */
typedef struct cairn_world_options {
  uint32_t struct_size;        /**< sizeof(cairn_world_options) of the caller */
  int32_t course;              /**< CAIRN_COURSE_...; default CAIRN_COURSE_CIRCLE */
  uint64_t seed;               /**< of everything random; default 1 */
  uint32_t landmarks;          /**< how many, 1 to 10000000; default 200 (Table 1). Laps and traverse get as long as
                                    they ask for */
  int32_t terrain;             /**< CAIRN_TERRAIN_...; default CAIRN_TERRAIN_ROLLING */
  int32_t contact;             /**< CAIRN_CONTACT_...; default CAIRN_CONTACT_WHEELS */
  int32_t drive;               /**< CAIRN_DRIVE_...; default CAIRN_DRIVE_TWIST */
  int32_t accelerometer;       /**< CAIRN_ACCELEROMETER_...; default CAIRN_ACCELEROMETER_VELOCITY */
  int32_t stick_noise;         /**< CAIRN_STICK_...; default CAIRN_STICK_PER_OBSERVATION */
  uint32_t observe_at_start;   /**< 1: step 0, the known start, has a frame too; default 0: the first comes a frame's
                                    period later */
  uint32_t traverse_closed;    /**< 1: the traverse's circles lie on one big ring, and the drive ends with a round of
                                    the first one; takes 1600 landmarks and more at the default strip and area; default
                                    0 */
  double speed;                /**< over the xy plane, m/s, > 0; default 2 pi hypot(100, 20) / 400: the default circle
                                    in 400 s (Table 1) */
  double laps;                 /**< rounds of circle and laps, > 0, or 0: 1 of a circle, 2 of laps; default 0. Not used
                                    by a traverse */
  double centre[2];            /**< of the circle, x and y, m; default the origin (not in the paper) */
  double radius;               /**< of the circle, m, > strip, or 0: hypot(100, 20) landmarks / 200, by which the
                                    default start is (100, 20) as in Table 1, and the density does not depend on the
                                    number; default 0 */
  double start_azimuth;        /**< of the circle's start as seen from its centre, rad; default atan2(20, 100) */
  double round_length;         /**< length of the traverse's circles, m, > 0; default 1500. They are scaled to use up
                                    the landmarks */
  double round_variation;      /**< share by which the seed varies it, [0, 0.3]; default 0.1 */
  double strip;                /**< landmarks lie within this distance of the course, m, > 0; default 25 */
  double landmark_area;        /**< ground a landmark, m^2, > 0, of laps and traverse; default 160 */
  double landmark_height;      /**< landmarks stand between the ground and this above it, m, >= 0; default 1.5 */
  double max_slope;            /**< bound of the rolling ground's slope, rad, [0, 45 degrees]; default 15 degrees */
  double wavelength[2];        /**< shortest and longest of the rolling ground's waves, m, > 0; default 25 and 150 */
  double start_height;         /**< of the rolling ground at (100, 20), m; default -0.3174 (Table 1) */
  double wheel_radius;         /**< m, > 0; default 0.3 (Table 1) */
  double track;                /**< distance of left and right wheels, m, > 0; default 1.0 (not in the paper) */
  double wheelbase;            /**< distance of front and rear wheels, m, > 0; default 1.2 (not in the paper) */
  double velocity_sigma;       /**< white noise a sample and axis, m/s or m/s^2 (`accelerometer`), >= 0; default 2e-3
                                    (Table 1) */
  double rate_sigma;           /**< white noise of the gyro a sample and axis, rad/s, >= 0; default 0.02 degrees/s
                                    (Table 1) */
  double gravity;              /**< m/s^2, >= 0; default 3.71. It matters to CAIRN_ACCELEROMETER_ACCELERATION alone */
  double wheel_rate_sigma;     /**< white noise of each side's wheel rate a sample, rad/s, >= 0; default 0.01 */
  double wheel_slip_sigma;     /**< ... and in proportion to the rate, >= 0; default 0.02 */
  double lateral_sigma;        /**< what a step tells of the wheels' missing velocity along y, m/s, >= 0; default
                                    0.01 */
  double vertical_sigma;       /**< ... and along z, m/s, >= 0; default 0.01 */
  double imu_period;           /**< of IMU and wheel samples, s, > 0; default 0.05: 20 Hz (Table 1) */
  double motion_period;        /**< of the motion samples handed out, s: a multiple of imu_period, whose samples are
                                    composed; default 0.2, the sampling period of Table 1 */
  double frame_period;         /**< of the camera, s: a multiple of motion_period; default 2: 0.5 Hz (Table 1) */
  double range_sigma;          /**< m, > 0; default 1 (Table 1) */
  double azimuth_sigma;        /**< rad, > 0; default 3 degrees (Table 1) */
  double stick_sigma;          /**< of the stick angle, rad, > 0; default 3 degrees (Table 1) */
  double image_sigma;          /**< of an elevation beside CAIRN_STICK_PER_FRAME, rad, > 0; default 0.5 degrees */
  double near_range;           /**< nothing nearer to the camera is seen, m, > 0; default 2 (not in the paper) */
  double far_range;            /**< nothing farther, m, > near_range; default 40 (not in the paper) */
  double half_azimuth;         /**< nothing farther aside of the camera's axis, rad, (0, pi]; default 60 degrees (not in
                                    the paper) */
  double pan_amplitude;        /**< the head scans: pan = amplitude sin(2 pi t / period), rad, [0, pi]; default 0: fixed
                                    forward */
  double pan_period;           /**< s, > 0; default 20 */
  double stick_amplitude;      /**< the same of the stick, rad, [0, 60 degrees]; default 0 */
  double stick_period;         /**< s, > 0; default 26 */
  double platform[3];          /**< d of \ref cairn_stereo_head, m; default 0 (not in the paper) */
  double stick[3];             /**< s of \ref cairn_stereo_head, m; default 0 (not in the paper) */
} cairn_world_options;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_world_options_init(cairn_world_options *options, size_t struct_size);

/** Worlds to measure by. The rows' velocity and rate noise are a sample of 0.2 s; they use CAIRN_TERRAIN_WAVES and
 *  CAIRN_CONTACT_POINT, and a radius of 101.98 m. */
enum {
  CAIRN_PRESET_PAPER = 0, /**< the defaults: Table 1 as printed */
  CAIRN_PRESET_ROW1 = 1,  /**< 0.002 m/s, 0.02 degrees/s, 1 lap in 400 s */
  CAIRN_PRESET_ROW2 = 2,  /**< 0.05 m/s, 0.2 degrees/s, 1 lap in 400 s */
  CAIRN_PRESET_ROW3 = 3,  /**< 0.05 m/s, 0.2 degrees/s, 2 laps in 400 s */
  CAIRN_PRESET_ROW4 = 4   /**< 0.2 m/s, 1 degree/s, 2 laps in 400 s */
};

/** Sets all options but `struct_size` and `seed` to those of a preset. `submap_landmarks` (or NULL) gets the size of
 *  submap that goes with it: 40, or 20 for rows 3 and 4. `options->struct_size` must be set.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_world_options_preset(cairn_world_options *options, int32_t preset,
                                                  uint32_t *submap_landmarks);

/** Creates a world before its first step; the caller destroys it with \ref cairn_world_destroy. Options of an older or
 *  a newer header are taken as far as both sides know them. On an error `*world` is not written.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY, CAIRN_ERROR_NUMERICAL (the ground is too rough for
 *  four wheels). Complexity: O(n log n) for n landmarks; memory 40 bytes a landmark. \since 0.1.0 */
CAIRN_API cairn_status cairn_world_create(const cairn_world_options *options, cairn_world **world);

/** Destroys a world. NULL is allowed. Threads: one a handle. \since 0.1.0 */
CAIRN_API void cairn_world_destroy(cairn_world *world);

/** How the rover moved, by its measurements and in truth, over `dt` seconds. Layout frozen. */
typedef struct cairn_world_motion {
  double dt;               /**< s */
  double velocity[3];      /**< measured, body axes, m/s (`drive`) */
  double rate[3];          /**< measured, body axes, rad/s */
  double wheels[2];        /**< measured turning rates of the left and the right wheels, rad/s: the mean over dt */
  double true_velocity[3]; /**< that with true_rate leads from the true pose before to the one after: T <- T Exp([v; w]
                                dt) */
  double true_rate[3];     /**< rad/s */
  double true_wheels[2];   /**< rad/s: those that eq. 1 of the paper asks for */
} cairn_world_motion;

/** One step: the motions since the step before, then one frame. */
typedef struct cairn_world_step {
  uint32_t struct_size;      /**< sizeof(cairn_world_step) of the caller; set it before the call */
  uint32_t reserved;         /**< 0 */
  uint64_t number;           /**< counted from 0, which is the start */
  double time;               /**< s, from 0 */
  cairn_pose truth;          /**< body in the map at the step's end */
  double velocity_sigma[3];  /**< noise of each motion sample's `velocity`, as \ref cairn_twist_noise wants it. An
                                  accelerometer's drift is told by its size at this time, as if it were white */
  double rate_sigma[3];      /**< noise of its `rate` */
  double pan;                /**< how the head stood, by its encoders, rad */
  double stick;              /**< rad */
  const cairn_world_motion *motions;      /**< `motion_count` of them, in order; the world's, valid until its next
                                               call */
  size_t motion_count;                    /**< 0 at step 0 */
  const cairn_observation *observations;  /**< by ascending id; z as \ref cairn_stereo_head has it, covariance zero; the
                                               world's, valid until its next call */
  size_t observation_count;               /**< how many */
} cairn_world_step;

/** Hands out the next step. Set `step->struct_size` first. Nothing is stored: memory does not grow with the drive.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (the last step was handed out),
 *  CAIRN_ERROR_NUMERICAL (the ground is too rough for four wheels).
 *  Complexity: O(motions + landmarks in range). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_next(cairn_world *world, cairn_world_step *step);

/** Back to before the first step: the same drive again, to the bit. Threads: one a handle. Errors:
 *  CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_rewind(cairn_world *world);

/** Number of steps, the start included. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT.
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_steps(const cairn_world *world, size_t *steps);

/** An upper bound of the observations of a frame, for \ref cairn_filter_options. Threads: as any const query of the
 *  handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_most_observations(const cairn_world *world, size_t *count);

/** The stereo head as the world's observations have it, to add to a filter: mount, noise, encoder mode. Set
 *  `head->struct_size` first. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_world_head(const cairn_world *world, cairn_stereo_head *head);

/** The wheels as the world drives them, for \ref cairn_filter_set_wheels, with the noise of one motion sample's wheel
 *  rates. Set `wheels->struct_size` first; noise of the rates that no wheel measures is that of \ref cairn_wheels_init.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_world_wheels(const cairn_world *world, cairn_wheels *wheels);

/** True pose of the body in the map at `time` (s, 0 to the end of the drive): its origin lies on the ground in the
 *  middle between the wheels. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_world_pose(const cairn_world *world, double time, cairn_pose *pose);

/** Where the wheels touch the ground at `time`: front left, front right, rear left, rear right, x y z each, in the map,
 *  m. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (CAIRN_CONTACT_POINT).
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_world_contacts(const cairn_world *world, double time, double points[12]);

/** Height of the ground, m. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1).
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_world_height(const cairn_world *world, double x, double y, double *height);

/** The rectangle that holds the course and all landmarks, m. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_extent(const cairn_world *world, double lower[2], double upper[2]);

/** True position of the landmark `id`, 0 to the number of landmarks less 1. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_landmark(const cairn_world *world, uint64_t id, double position[3]);

/** True positions of all landmarks, x y z each, by ascending id. `capacity` and `*needed` count landmarks; NULL with
 *  capacity 0 asks for their number. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_world_landmarks(const cairn_world *world, double *positions, size_t capacity,
                                             size_t *needed);

/** What \ref cairn_last_message is for libcairn, for the calls of this library. Threads: any. \since 0.1.0 */
CAIRN_API const char *cairn_sim_last_message(void);

#ifdef __cplusplus
}
#endif

#endif
