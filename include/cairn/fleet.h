/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  A fleet of boats to try cooperative filters in: what each measures of features and of the others, and the truth.
 *
 *  These functions live in libcairn_sim, as those of cairn/sim.h do, and this header is not part of cairn.h. It needs
 *  no filter: whatever takes odometry, ranges and bearings can be driven by it.
 *
 *  The scenario is the cooperative SLAM paper's: boats with radars drive closed courses in a square of sea. The paper
 *  leaves much open; each such choice is an option, and says so. Everything happens in the plane: a map frame with x
 *  east and y north, its origin in the middle of the square; headings and bearings anticlockwise, in (-pi, pi], a
 *  heading of 0 being east, a bearing of 0 straight ahead and a positive one to the left.
 *
 *  Random draws come from the seed alone, with the generator of cairn/sim.h. Each feature's, each boat's and each
 *  sighting's draws are its own: more features leave the first ones where they were, more boats do not change how the
 *  first ones err, and a larger noise is the same noise larger. */
#ifndef CAIRN_FLEET_H
#define CAIRN_FLEET_H

#include <cairn/status.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A square of sea with boats on their way. */
typedef struct cairn_fleet cairn_fleet;

/** Where the features are. The coast line is there in either layout; the radars see features alone. */
enum {
  CAIRN_FLEET_UNIFORM = 0, /**< anywhere in the square, on either side of the coast line; the default */
  CAIRN_FLEET_COAST = 1    /**< along the coast line, which runs north of the boats from the square's western side to
                              its eastern one: between it and `coast_strip` south of it */
};

/** Options of \ref cairn_fleet_create. Set them by \ref cairn_fleet_options_init first; the defaults are the paper's
 *  figures with the open choices filled in. */
typedef struct cairn_fleet_options {
  uint32_t struct_size;  /**< sizeof(cairn_fleet_options) of the caller */
  int32_t layout;        /**< CAIRN_FLEET_...; default CAIRN_FLEET_UNIFORM */
  uint64_t seed;         /**< of everything random; default 1 */
  uint32_t vehicles;     /**< how many boats, 1 to 64; default 2 (paper) */
  uint32_t features;     /**< how many, 1 to 100000; default 10 (paper: 6, 10, 40) */
  double area;           /**< side of the square, m, > 0; default 10000 (paper) */
  double separation;     /**< distance of neighbours at the start, m, > 0, at most half of `area`; default 1500 (not in
                            the paper). Three boats and more may stand closer: \ref cairn_fleet_create */
  double course_length;  /**< of each boat's circle, m, > 0, at most `area`; default 1700 (paper) */
  double duration;       /**< of one round, which is the whole drive, s, > 0; default 1500 (paper) */
  double period;         /**< of the radars, s, > 0, at most `duration`; default 5 (not in the paper) */
  double radar_range;    /**< nothing farther is seen, m, > 0; default 5000 (paper) */
  double range_sigma;    /**< m, >= 0; default 30 (not in the paper) */
  double bearing_sigma;  /**< rad, >= 0; default 0.3 degrees (not in the paper) */
  double speed_sigma;    /**< by which the executed speed differs from the commanded one, white noise a period, m/s,
                            >= 0; default 0.2 (not in the paper) */
  double rate_sigma;     /**< the same of the rate of turn, rad/s, >= 0; default 0.1 degrees/s (not in the paper) */
  double coast_distance; /**< of the coast line's mean north of the origin, as a share of `area`, (0, 0.5]; default 0.35
                            (not in the paper) */
  double coast_relief;   /**< how far it departs from that to either side at most, as a share of `area`, [0, 0.5 -
                            coast_distance]; default 0.05 (not in the paper) */
  double coast_strip;    /**< width of the water with features in it, as a share of `area`, [0, 0.5]; default 0.03 (not
                            in the paper). It matters to CAIRN_FLEET_COAST alone */
} cairn_fleet_options;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_options_init(cairn_fleet_options *options, size_t struct_size);

/** Creates a fleet before its first step; the caller destroys it with \ref cairn_fleet_destroy. Options of an older or
 *  a newer header are taken as far as both sides know them. On an error `*fleet` is not written.
 *
 *  Each boat is commanded once round a circle of radius R = course_length / (2 pi), anticlockwise, at the constant
 *  speed course_length / duration and rate 2 pi / duration; it starts at the circle's southernmost place, heading
 *  east. The circles' centres lie `separation` apart: one boat's at the origin, those of two at (-separation / 2, 0)
 *  and (separation / 2, 0), more on a square grid about the origin, as many columns as rows or one more, numbered from
 *  west to east and row by row from the south, a last row that is not full in its middle. A grid wider than half of
 *  `area` is shrunk to that. With CAIRN_FLEET_COAST all circles must end south of the coast line.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY. Complexity: O(features). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_create(const cairn_fleet_options *options, cairn_fleet **fleet);

/** Destroys a fleet. NULL is allowed. Threads: one a handle. \since 0.1.0 */
CAIRN_API void cairn_fleet_destroy(cairn_fleet *fleet);

/** What a radar measured of a feature or of a boat. Layout frozen. */
typedef struct cairn_fleet_sighting {
  uint64_t id;    /**< features are numbered from 1, and so are boats */
  double range;   /**< m, > 0: noise that would make it 0 or less is drawn again */
  double bearing; /**< in the frame of the boat that looks, rad */
} cairn_fleet_sighting;

/** One boat at the end of a step. Layout frozen. */
typedef struct cairn_fleet_vehicle {
  double speed;                         /**< commanded over the step's dt, m/s: what a filter is told; 0 at step 0 */
  double rate;                          /**< commanded over the step's dt, rad/s; 0 at step 0 */
  double x;                             /**< true position, m */
  double y;                             /**< m */
  double heading;                       /**< true, rad */
  const cairn_fleet_sighting *features; /**< `feature_count` of them, by ascending id */
  size_t feature_count;                 /**< how many */
  const cairn_fleet_sighting *vehicles; /**< the other boats: `vehicle_count` of them, by ascending id */
  size_t vehicle_count;                 /**< how many */
} cairn_fleet_vehicle;

/** One step: all boats move, then all of them look. */
typedef struct cairn_fleet_step {
  uint32_t struct_size;                /**< sizeof(cairn_fleet_step) of the caller; set it before the call */
  uint32_t reserved;                   /**< 0 */
  uint64_t number;                     /**< counted from 0, which is the start: a scan before any motion */
  double time;                         /**< s, from 0 */
  double dt;                           /**< since the step before, s: `period`, or 0 at step 0 */
  const cairn_fleet_vehicle *vehicles; /**< `vehicle_count` of them, boat 1 first; they and their sightings are the
                                          fleet's, valid until its next call */
  size_t vehicle_count;                /**< all boats */
} cairn_fleet_step;

/** Hands out the next step. Set `step->struct_size` first. Over a period each boat keeps the speed and the rate that it
 *  executes, and its true pose is the exact integral of them. Each boat then sees all features and all other boats
 *  within `radar_range` (true distance, which is not 0), each with noise of its own: two boats that see each other err
 *  independently. Nothing is stored: memory does not grow with the drive.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (the last step was handed out),
 *  CAIRN_ERROR_MEMORY (the same step is handed out by the next call).
 *  Complexity: O(vehicles (features + vehicles)). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_next(cairn_fleet *fleet, cairn_fleet_step *step);

/** Back to before the first step. The same steps again, to the bit. Threads: one a handle. Errors:
 *  CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_rewind(cairn_fleet *fleet);

/** How many steps there are: 1 and as many as whole periods fit in the duration. Threads: as any const query of the
 *  handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_steps(const cairn_fleet *fleet, size_t *steps);

/** True positions of all features, x y each, m, the feature with id 1 first. `capacity` and `*needed` count features;
 *  NULL with capacity 0 asks for their number. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_features(const cairn_fleet *fleet, double *positions, size_t capacity,
                                            size_t *needed);

/** The coast line from west to east, a polyline, x y each, m; the land is north of it. `capacity` and `*needed` count
 *  points; NULL with capacity 0 asks for their number. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_fleet_coast(const cairn_fleet *fleet, double *points, size_t capacity, size_t *needed);

#ifdef __cplusplus
}
#endif

#endif
