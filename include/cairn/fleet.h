/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  A simulated fleet of boats for cooperative filters: the measurements of each boat and the truth.
 *
 *  These functions are in libcairn_sim, like those of cairn/sim.h. This header is not part of cairn.h. It needs no
 *  filter: any estimator that uses odometry, ranges and bearings can be driven by it.
 *
 *  The scenario is that of the cooperative SLAM paper: boats with radars drive closed courses in a square of sea. The
 *  paper leaves much open. Each such choice is an option, and its comment says so. Everything happens in the plane.
 *  The map frame has x east and y north, with its origin in the middle of the square. Headings and bearings are
 *  anticlockwise, in (-pi, pi]. A heading of 0 is east. A bearing of 0 is straight ahead, and a positive one to the
 *  left.
 *
 *  Random draws depend only on the seed; the generator is that of cairn/sim.h. Each feature, each boat and each
 *  sighting has draws of its own. So more features leave the first ones where they were, more boats do not change the
 *  errors of the first boats, and a larger noise is the same noise scaled. */
#ifndef CAIRN_FLEET_H
#define CAIRN_FLEET_H

#include <cairn/status.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A square of sea with boats that drive in it. */
typedef struct cairn_fleet cairn_fleet;

/** Where the features are. Both layouts have the coast line, but the radars see only features. */
typedef int32_t cairn_fleet_layout;
enum CAIRN_VALUES(cairn_fleet_layout) {
  CAIRN_FLEET_UNIFORM = 0, /**< uniform in the square, on both sides of the coast line; the default */
  CAIRN_FLEET_COAST = 1    /**< along the coast line, in a strip of width `coast_strip` south of it. The coast line
                                runs north of the boats, from the western side of the square to the eastern side */
};

/** Options of \ref cairn_fleet_create. Set them by \ref cairn_fleet_options_init first; the defaults are the
 *  figures of the paper, with the open choices filled in. */
typedef struct cairn_fleet_options {
  uint32_t struct_size;  /**< sizeof(cairn_fleet_options) of the caller */
  cairn_fleet_layout layout; /**< CAIRN_FLEET_...; default CAIRN_FLEET_UNIFORM */
  uint64_t seed;         /**< seed of all random draws; default 1 */
  uint32_t vehicles;     /**< number of boats, 1 to 64; default 2 (paper) */
  uint32_t features;     /**< number of features, 1 to 100000; default 10 (paper: 6, 10, 40) */
  double area;           /**< side of the square, m, > 0; default 10000 (paper) */
  double separation;     /**< distance between neighbours at the start, m, > 0, at most half of `area`; default 1500
                              (not in the paper). Three or more boats may be closer: see \ref cairn_fleet_create */
  double course_length;  /**< circumference of each boat's circle, m, > 0, at most `area`; default 1700 (paper) */
  double duration;       /**< duration of one round, which is the whole drive, s, > 0; default 1500 (paper) */
  double period;         /**< period of the radars, s, > 0, at most `duration`; default 5 (not in the paper) */
  double radar_range;    /**< range of the radars, m, > 0; default 5000 (paper) */
  double range_sigma;    /**< noise of a range, m, >= 0; default 30 (not in the paper) */
  double bearing_sigma;  /**< noise of a bearing, rad, >= 0; default 0.3 degrees (not in the paper) */
  double speed_sigma;    /**< difference between executed and commanded speed: white noise, one draw a period, m/s,
                              >= 0; default 0.2 (not in the paper) */
  double rate_sigma;     /**< the same for the rate of turn, rad/s, >= 0; default 0.1 degrees/s (not in the paper) */
  CAIRN_UNIT(1)
  double coast_distance; /**< distance of the mean coast line north of the origin, as a share of `area`, (0, 0.5];
                              default 0.35 (not in the paper) */
  CAIRN_UNIT(1)
  double coast_relief;   /**< largest deviation of the coast line from its mean, as a share of `area`, [0, 0.5 -
                              coast_distance]; default 0.05 (not in the paper) */
  CAIRN_UNIT(1)
  double coast_strip;    /**< width of the strip of water that holds the features, as a share of `area`, [0, 0.5];
                              default 0.03 (not in the paper). Only CAIRN_FLEET_COAST uses it */
} cairn_fleet_options;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_options_init(CAIRN_OUT cairn_fleet_options *options, size_t struct_size,
                                                cairn_error *error);

/** Creates a fleet before its first step. The caller destroys it with \ref cairn_fleet_destroy. Options of an older
 *  or a newer header are used as far as both sides know them. On an error `*fleet` is not written.
 *
 *  Each boat is commanded once around a circle of radius R = course_length / (2 pi), anticlockwise, at the constant
 *  speed course_length / duration and rate 2 pi / duration. It starts at the southernmost point of the circle,
 *  heading east. The centres of the circles are `separation` apart. The centre of a single boat is the origin. The
 *  centres of two boats are (-separation / 2, 0) and (separation / 2, 0). The centres of more boats form a square
 *  grid about the origin, with as many columns as rows or one more. They are numbered from west to east and row by
 *  row from the south; a last row that is not full is centred. A grid wider than half of `area` is shrunk to that.
 *  With CAIRN_FLEET_COAST all circles must lie south of the coast line.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY. Complexity: O(features). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_create(const cairn_fleet_options *options, cairn_fleet **fleet, cairn_error *error);

/** Destroys a fleet. NULL is allowed. Threads: one a handle. Complexity: O(memory). \since 0.1.0 */
CAIRN_API void cairn_fleet_destroy(cairn_fleet *fleet);

/** Radar measurement of a feature or of a boat. Layout frozen. */
typedef struct cairn_fleet_sighting {
  uint64_t id;    /**< number of the feature or of the boat; both count from 1 */
  double range;   /**< m, > 0: noise that would make it 0 or less is drawn again */
  double bearing; /**< in the frame of the boat that measures, rad */
} cairn_fleet_sighting;

/** A boat at the end of a step. Layout frozen. */
typedef struct cairn_fleet_vehicle {
  double speed;           /**< commanded speed during the step, m/s: the input of a filter; 0 at step 0 */
  double rate;            /**< commanded rate during the step, rad/s; 0 at step 0 */
  double x;               /**< true position, east, m */
  double y;               /**< true position, north, m */
  double heading;         /**< true heading, rad */
  uint64_t feature_count; /**< measured features, for \ref cairn_fleet_seen_features */
  uint64_t vehicle_count; /**< measured other boats, for \ref cairn_fleet_seen_vehicles */
} cairn_fleet_vehicle;

/** A step: all boats move, then all boats scan. */
typedef struct cairn_fleet_step {
  uint32_t struct_size;   /**< sizeof(cairn_fleet_step) of the caller; set it before the call */
  uint32_t reserved;      /**< 0 */
  uint64_t number;        /**< counted from 0; step 0 is a scan at the start, before any motion */
  double time;            /**< s, from 0 */
  double dt;              /**< since the step before, s: `period`, or 0 at step 0 */
  uint64_t vehicle_count; /**< number of boats, for \ref cairn_fleet_vehicles */
} cairn_fleet_step;

/** Returns the next step. Set `step->struct_size` first. During a period each boat keeps its executed speed and rate,
 *  and its true pose is their exact integral. Then each boat measures all features and all other boats within
 *  `radar_range` (true distance, not 0). Each measurement has its own noise: two boats that see each other have
 *  independent errors. Nothing is stored, so memory does not grow with the drive.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (there are no more steps),
 *  CAIRN_ERROR_MEMORY (the next call returns the same step). Complexity: O(vehicles (features + vehicles)).
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_next(cairn_fleet *fleet, CAIRN_OUT cairn_fleet_step *step, cairn_error *error);

/** The boats at the end of the last step, boat 1 first; none before the first step. Capacity 0 asks for their number.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n).
 *  \since 0.2.0 */
CAIRN_API cairn_status cairn_fleet_vehicles(const cairn_fleet *fleet,
                                            CAIRN_OUT_ARRAY(capacity) cairn_fleet_vehicle *vehicles, size_t capacity,
                                            size_t *needed, cairn_error *error);

/** The features that boat `vehicle` (counted from 1) measured in the last step, by ascending id; none before the first
 *  step. Capacity 0 asks for their number. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT,
 *  CAIRN_ERROR_NOT_FOUND (boat), CAIRN_ERROR_BUFFER. Complexity: O(n). \since 0.2.0 */
CAIRN_API cairn_status cairn_fleet_seen_features(const cairn_fleet *fleet, uint64_t vehicle,
                                                 CAIRN_OUT_ARRAY(capacity) cairn_fleet_sighting *features,
                                                 size_t capacity, size_t *needed, cairn_error *error);

/** The other boats that boat `vehicle` (counted from 1) measured in the last step, by ascending id; none before the
 *  first step. Capacity 0 asks for their number. Threads: as any const query of the handle. Errors:
 *  CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND (boat), CAIRN_ERROR_BUFFER. Complexity: O(n). \since 0.2.0 */
CAIRN_API cairn_status cairn_fleet_seen_vehicles(const cairn_fleet *fleet, uint64_t vehicle,
                                                 CAIRN_OUT_ARRAY(capacity) cairn_fleet_sighting *vehicles,
                                                 size_t capacity, size_t *needed, cairn_error *error);

/** Goes back to before the first step. The same steps follow, bit for bit. Threads: one a handle. Errors:
 *  CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_rewind(cairn_fleet *fleet, cairn_error *error);

/** Number of steps: 1 plus the number of whole periods in the duration. Threads: as any const query of the
 *  handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_steps(const cairn_fleet *fleet, CAIRN_OUT size_t *steps, cairn_error *error);

/** True positions of all features, x y each, m; the feature with id 1 is the first. `capacity` and `*needed` count
 *  features; capacity 0 asks for their number. Threads: as any const query of the handle. Errors:
 *  CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_features(const cairn_fleet *fleet,
                                            CAIRN_OUT_ARRAY(2 * capacity) CAIRN_UNIT(m) double *positions,
                                            size_t capacity, size_t *needed, cairn_error *error);

/** The coast line from west to east: a polyline, x y each, m. The land is north of it. `capacity` and `*needed` count
 *  points; capacity 0 asks for their number. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_coast(const cairn_fleet *fleet,
                                         CAIRN_OUT_ARRAY(2 * capacity) CAIRN_UNIT(m) double *points, size_t capacity,
                                         size_t *needed, cairn_error *error);

#ifdef __cplusplus
}
#endif

#endif
