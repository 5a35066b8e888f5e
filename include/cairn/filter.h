/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  The filter of one vehicle: create, predict, update, ask. */
#ifndef CAIRN_FILTER_H
#define CAIRN_FILTER_H

#include <cairn/map.h>
#include <cairn/motion.h>
#include <cairn/pose.h>
#include <cairn/sensor.h>

#ifdef __cplusplus
extern "C" {
#endif

/** One vehicle's pose and map, estimated together. */
typedef struct cairn_filter cairn_filter;

/** Which error of the state the filter's covariance speaks of (docs/invariant_error.md). */
enum {
  CAIRN_ERROR_INVARIANT = 0, /**< right-invariant on SE_{K+1}(3): consistent; the default */
  CAIRN_ERROR_STANDARD = 1   /**< position, attitude and landmarks apart: standard EKF-SLAM, to compare with */
};

/** What the filter's vehicle moves in (docs/plane.md). A planar one is told and asked of in space all the same: it lies in
 *  z = 0 and turns about z. Of covariances that it is given, the rows of x, y and yaw count; those that it gives have zeros
 *  elsewhere. Jacobians likewise. */
enum {
  CAIRN_VEHICLE_SPATIAL = 0, /**< six degrees of freedom; the default */
  CAIRN_VEHICLE_PLANAR = 1   /**< x, y and heading; landmarks x and y */
};

/** How a closed submap enters the map (docs/submaps.md). */
enum {
  CAIRN_JOIN_AUTO = 0,  /**< dense where max_landmarks is at most 100, sparse above; the default */
  CAIRN_JOIN_DENSE = 1, /**< a constrained filter over the whole map's covariance: O(n^2) a closing, n states of the map */
  CAIRN_JOIN_SPARSE = 2 /**< all submaps solved for together on a sparse factor, relinearised: near-linear in all */
};

/** Which landmark an observation is of (docs/association.md). */
enum {
  CAIRN_ASSOCIATION_KNOWN = 0,   /**< the one that its id names; the default */
  CAIRN_ASSOCIATION_NEAREST = 1, /**< the nearest by Mahalanobis distance that no nearer observation is of; ids are not
                                      looked at, landmarks are numbered from 0 in the order of their placing */
  CAIRN_ASSOCIATION_JOINT = 2    /**< the largest set of pairs that fit together (joint compatibility, branch and bound);
                                      ids as for CAIRN_ASSOCIATION_NEAREST */
};

/** By what CAIRN_ASSOCIATION_NEAREST tells near from far. */
enum {
  CAIRN_DISTANCE_MAHALANOBIS = 0, /**< the squared Mahalanobis distance d^2; the default */
  CAIRN_DISTANCE_LIKELIHOOD = 1   /**< d^2 + log det S, -2 log of the likelihood: of two landmarks that fit as well, the
                                       one that is known better. Gates go by d^2 all the same */
};

/** Options of \ref cairn_filter_create. Set them by \ref cairn_filter_options_init first. */
typedef struct cairn_filter_options {
  uint32_t struct_size;          /**< sizeof(cairn_filter_options) of the caller */
  int32_t error;                 /**< CAIRN_ERROR_INVARIANT or CAIRN_ERROR_STANDARD */
  uint32_t max_landmarks;        /**< capacity; default 1000. 1 to 30000 where the map is a single one or joined densely:
                                      memory grows with its square, and is taken at creation. Up to 10000000 where it
                                      is joined sparsely: a bound alone, memory is taken as the map grows */
  uint32_t max_observations;     /**< observations of one frame, 1 to 4096; default 64 */
  uint32_t max_sensors;          /**< sensors that can be added, 1 to 256; default 8 */
  uint32_t iterations;           /**< linearisations of an update, 1 (plain EKF) to 50; default 3 */
  double iteration_tolerance;    /**< iterating ends where the linearisation misses the observations of the batch by less
                                      than this, in their standard deviations, root of the sum of squares, > 0; default 0.1 */
  double gate_probability;       /**< chi-square gate of one observation, in (0, 1]; 1 lets all pass; default 0.99 */
  double batch_gate_probability; /**< chi-square gate of a whole batch, in (0, 1]; 1 lets all pass; default 0.9999 */
  cairn_pose initial_pose;       /**< body in the map frame at the start; default identity */
  double initial_covariance[36]; /**< of its error [dp; dtheta], symmetric, positive semidefinite; default 0: it is known */
  uint32_t submap_landmarks;     /**< work in local submaps, each closed once it holds this many landmarks, up to 4096;
                                      0, the default: one single map */
  int32_t join;                  /**< CAIRN_JOIN_AUTO, CAIRN_JOIN_DENSE or CAIRN_JOIN_SPARSE; default CAIRN_JOIN_AUTO */
  double submap_distance;        /**< ... or once the vehicle has driven this far in it, m; 0, the default: no matter */
  double submap_extent;          /**< ... or once a landmark stands this far from its origin, m; 0, the default: no matter */
  double submap_sigma;           /**< ... or once the largest standard deviation of the vehicle's position in it exceeds
                                      this, m; 0, the default: no matter */
  int32_t association;           /**< CAIRN_ASSOCIATION_KNOWN, CAIRN_ASSOCIATION_NEAREST or CAIRN_ASSOCIATION_JOINT; default
                                      CAIRN_ASSOCIATION_KNOWN */
  uint32_t association_nodes;    /**< joint tests of one frame at most, 1 to 1000000: after so many the best set that was
                                      found is taken; default 2000 */
  double new_probability;        /**< without known ids: an observation places a new landmark only where its distance from each
                                      that exists, and was not paired with another of the frame, exceeds the chi-square bound
                                      of this probability, in (0, 1); none beyond it is paired; default 0.9999 */
  int32_t vehicle;               /**< CAIRN_VEHICLE_SPATIAL or CAIRN_VEHICLE_PLANAR; default CAIRN_VEHICLE_SPATIAL */
  int32_t association_distance;  /**< CAIRN_DISTANCE_MAHALANOBIS or CAIRN_DISTANCE_LIKELIHOOD; default
                                      CAIRN_DISTANCE_MAHALANOBIS */
  uint32_t deferred_sightings;   /**< a new landmark counts once it was observed so often, 1 to 1000: before, it is part of
                                      the estimate, and of no map; default 1 */
  uint32_t deferred_frames;      /**< ... and is dropped if it does not come to that within so many frames, 1 to 1000000;
                                      default 20 */
  uint32_t missed_frames;        /**< a landmark that lay in a sensor's view (\ref cairn_filter_set_view) and was not seen in
                                      so many of that sensor's frames in a row is dropped; 0, the default: never */
  uint32_t reserved;             /**< 0 */
  double error_persistence;      /**< so many sightings of a landmark in a row have one error between them, 1 to 1000000: an
                                      update takes an observation's noise times this, association and placing take it as
                                      it is; default 1 */
} cairn_filter_options;

/** Fills in the defaults, at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_options_init(cairn_filter_options *options, size_t struct_size);

/** Bytes that \ref cairn_filter_create will take with these options: all that the filter ever takes, but for closings of
 *  submaps: those take workspace while they last, and with the sparse joining what the map grows by.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_required_bytes(const cairn_filter_options *options, size_t *bytes);

/** Creates a filter; the caller destroys it with \ref cairn_filter_destroy. Options of an older or a newer header are
 *  taken as far as both sides know them. On an error `*filter` is not written.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_create(const cairn_filter_options *options, cairn_filter **filter);

/** Destroys a filter, and the map that it owns. NULL is allowed. Threads: one a handle. \since 0.1.0 */
CAIRN_API void cairn_filter_destroy(cairn_filter *filter);

/** A line of a filter's log; `payload` is what \ref cairn_filter_set_log got. */
typedef void (*cairn_log)(void *payload, const char *line);

/** Sets where this filter's log lines go (rejected batches, numerical refusals); NULL, the default, is silence.
 *  The callback runs inside the filter's calls and must not call the same filter. Threads: one a handle.
 *  Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_set_log(cairn_filter *filter, cairn_log log, void *payload);

/* Sensors. Each call copies the description and gives the sensor's number, counted from 0, for later calls. */

/** Adds a stereo head. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_add_stereo_head(cairn_filter *filter, const cairn_stereo_head *head, int32_t *sensor);

/** Adds a stereo camera. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_add_stereo_camera(cairn_filter *filter, const cairn_stereo_camera *camera,
                                                      int32_t *sensor);

/** Adds a radar or lidar of the plane. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (also where the vehicle is
 *  spatial), CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_add_range_bearing(cairn_filter *filter, const cairn_range_bearing *radar,
                                                      int32_t *sensor);

/** Adds a sensor of points. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_add_cartesian(cairn_filter *filter, const cairn_cartesian *cartesian,
                                                  int32_t *sensor);

/** Adds a sensor of the caller's own. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_CAPACITY.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_add_custom(cairn_filter *filter, const cairn_custom *custom, int32_t *sensor);

/** Tells how a stereo head stands from now on: pan and stick angle (rad), 0 after it was added. Call it before each
 *  frame that was seen with other angles. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (not finite, or no stereo
 *  head), CAIRN_ERROR_NOT_FOUND. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_point_head(cairn_filter *filter, int32_t sensor, double pan, double stick);

/** Tells what a sensor sees for sure: whatever it would give an observation of between `lower` and `upper`, value by value
 *  in the sensor's units (of 3 values, a planar sensor's or a custom one's of fewer rows the first; infinite ones are no
 *  bound). A landmark whose image lies inside by three standard deviations, and that no observation of a frame was compared
 *  with, was missed (`missed_frames`). Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_set_view(cairn_filter *filter, int32_t sensor, const double lower[3],
                                             const double upper[3]);

/* Motion. Every prediction costs O(1), whatever the size of the map, and allocates nothing. */

/** Sets the vehicle's wheels for \ref cairn_filter_predict_wheels; before it those of \ref cairn_wheels_init hold.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_set_wheels(cairn_filter *filter, const cairn_wheels *wheels);

/** Sets the noise of \ref cairn_filter_predict_twist; before it that of \ref cairn_twist_noise_init holds.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_set_twist_noise(cairn_filter *filter, const cairn_twist_noise *noise);

/** Moves the vehicle by the turning rates of its left and right wheels (rad/s) over `dt` seconds (> 0).
 *  Mars paper, eq. 1 and 2. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL.
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_predict_wheels(cairn_filter *filter, double dt, double left_rad_per_s,
                                                   double right_rad_per_s);

/** Moves the vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0).
 *  Mars paper, eq. 2. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL. Complexity: O(1).
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_predict_twist(cairn_filter *filter, double dt, const double velocity[3],
                                                  const double rate[3]);

/** Moves the vehicle by a relative pose, `T_map_body <- T_map_body T_before_after`, with the covariance (6x6 row-major,
 *  symmetric, positive semidefinite) of its error [dp; dtheta] in the axes of the body before.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_predict_increment(cairn_filter *filter, const cairn_pose *T_before_after,
                                                      const double covariance[36]);

/* Observations. All of a call are one batch. A call that fails leaves the filter as it was, bit for bit. */

/** Takes in one frame of one sensor. Known landmarks update the state, together; unknown ids place new landmarks, with
 *  their full correlations. `matches` (room for `count`, or NULL) gets the decision on each observation.
 *  `count` may be 0. Allocates nothing.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (also an id twice, CAIRN_ID_NONE, noise that is no covariance),
 *  CAIRN_ERROR_NOT_FOUND (sensor), CAIRN_ERROR_CAPACITY (more than max_observations, or the map would hold more than
 *  max_landmarks), CAIRN_ERROR_NUMERICAL. Complexity: O(n^2 m) for n states and m rows. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_update(cairn_filter *filter, int32_t sensor, const cairn_observation *observations,
                                           size_t count, cairn_match *matches);

/** Updates by what the caller linearised itself: `residual = z - h` (rows values), the noise's `covariance`
 *  (rows x rows), `jacobian_pose` = dh/[dp; dtheta] (rows x 6, NULL for zero) and `jacobian_landmarks` = dh/d positions
 *  (rows x 3 count, the columns in the order of `landmarks`); all row-major; with submaps, pose and landmarks are those of the open submap, in its frame. Gated as one observation of that many rows (gate_probability); not iterated.
 *  `match` (or NULL) gets the decision; its landmark is the first one, or CAIRN_ID_NONE. rows is 1 to 3 max_observations
 *  (planar: 2), count at most max_observations.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND, CAIRN_ERROR_CAPACITY,
 *  CAIRN_ERROR_NUMERICAL. Complexity: O(n^2 rows). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_update_linear(cairn_filter *filter, const double *residual, size_t rows,
                                                  const double *covariance, const double *jacobian_pose,
                                                  const uint64_t *landmarks, size_t count,
                                                  const double *jacobian_landmarks, cairn_match *match);

/** Updates by an absolute position (GNSS): `z = p + R lever_arm` in the map frame, m; 3x3 `covariance`, positive definite.
 *  `lever_arm` (body frame, m) may be NULL: zero. `match` (or NULL) gets the decision.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL. Complexity: O(n^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_update_position(cairn_filter *filter, const double position[3],
                                                    const double covariance[9], const double lever_arm[3],
                                                    cairn_match *match);

/** Updates by an absolute attitude (star tracker): quaternion w x y z from body to map; 3x3 `covariance` (rad^2, positive
 *  definite) of its error dtheta in the map's axes. `match` (or NULL) gets the decision.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL. Complexity: O(n^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_update_attitude(cairn_filter *filter, const double quaternion[4],
                                                    const double covariance[9], cairn_match *match);

/** Updates by an absolute heading (sun sensor, compass): the yaw of the body's x axis in the map, rad, with its standard
 *  deviation (> 0). Refused as CAIRN_REASON_NO_IMAGE where that axis stands within 5 degrees of the vertical.
 *  `match` (or NULL) gets the decision.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL. Complexity: O(n^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_update_heading(cairn_filter *filter, double heading, double sigma,
                                                   cairn_match *match);

/** Forgets a landmark, in the map and in the open submap; what it taught about the others stays.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_remove_landmark(cairn_filter *filter, uint64_t id);

/** Tells the filter that two landmarks of the open submap, or of the single map, are one: their difference is observed to
 *  be zero, gated as an observation is (gate_probability). Where it passes, `other` is gone and `id` stays, with the
 *  observations of both. `match` (or NULL) gets the decision.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND, CAIRN_ERROR_CAPACITY (max_observations is
 *  1), CAIRN_ERROR_NUMERICAL. Complexity: O(n^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_merge_landmarks(cairn_filter *filter, uint64_t id, uint64_t other,
                                                    cairn_match *match);

/** Splits a landmark that turned out to be two: `fresh` stands where `id` does, but for an error of its own with this
 *  3x3 covariance (positive definite: how far apart the two may be), and observations tell them apart from then on.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (also where `fresh` exists), CAIRN_ERROR_NOT_FOUND,
 *  CAIRN_ERROR_CAPACITY. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_split_landmark(cairn_filter *filter, uint64_t id, uint64_t fresh,
                                                   const double covariance[9]);

/* Submaps (docs/submaps.md). With submap_landmarks > 0 the filter works in a submap that starts where the vehicle stood,
 * with zero covariance, so that a step's cost does not know how large the map is. A submap that is full is closed: its
 * landmarks join the map, and the next one starts at the vehicle's pose. cairn_filter_update closes after the frame that
 * filled it; if that fails (memory, capacity), the update stands all the same, the submap stays open, the report of the
 * closing says why, and later frames try again. A known pose in the map (position, attitude, heading) closes the open
 * submap first, whatever it holds. */

/** What made a submap close. */
enum {
  CAIRN_CLOSED_BY_NONE = 0,      /**< none was closed yet */
  CAIRN_CLOSED_BY_CALLER = 1,    /**< \ref cairn_filter_close_submap */
  CAIRN_CLOSED_BY_LANDMARKS = 2, /**< submap_landmarks */
  CAIRN_CLOSED_BY_DISTANCE = 3,  /**< submap_distance */
  CAIRN_CLOSED_BY_EXTENT = 4,    /**< submap_extent */
  CAIRN_CLOSED_BY_SIGMA = 5,     /**< submap_sigma */
  CAIRN_CLOSED_BY_FIX = 6        /**< an absolute position, attitude or heading came */
};

/** What the last attempt to close a submap did. */
typedef struct cairn_closing_report {
  uint32_t struct_size;       /**< sizeof(cairn_closing_report) of the caller; set it before the call */
  int32_t status;             /**< CAIRN_OK, or why the submap was left open */
  uint32_t submaps;           /**< closed so far */
  int32_t reason;             /**< CAIRN_CLOSED_BY_... */
  uint32_t landmarks;         /**< of the submap */
  uint32_t landmarks_new;     /**< of them, new to the map */
  uint32_t landmarks_fused;   /**< known to the map, and fused with it */
  uint32_t landmarks_refused; /**< known to the map, whose estimate there contradicts the submap's: left out */
  uint32_t relinearised;      /**< submaps linearised anew (sparse) */
  uint32_t refactored;        /**< blocks of the factor computed anew (sparse) */
  uint32_t iterations;        /**< linear solutions */
  uint32_t rows;              /**< degrees of freedom of `distance` */
  double distance;            /**< squared Mahalanobis distance of the fused landmarks' estimates, jointly */
  double threshold;           /**< its chi-square bound at batch_gate_probability */
  double seconds;             /**< what the closing took */
  double moved_max;           /**< how far the map's older landmarks moved: the largest way, m */
  double moved_rms;           /**< ... and root mean square, m */
  uint32_t landmarks_ambiguous;   /**< without known ids: near landmarks of the map, but of none for sure: left out */
  uint32_t association_nodes;     /**< joint tests that association with the map took */
  uint32_t association_exhausted; /**< 1: it stopped at the bound of the options */
} cairn_closing_report;

/** Closes the open submap now. Allocates. A call that fails leaves the filter as it was, the submap open.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (a single map, or the submap holds no landmark),
 *  CAIRN_ERROR_CAPACITY (max_landmarks), CAIRN_ERROR_NUMERICAL, CAIRN_ERROR_MEMORY. Complexity: dense O(n^2) for n states
 *  of the map; sparse: what the closing affects of the factor. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_close_submap(cairn_filter *filter);

/** Reports on the last attempt to close a submap; zeros before the first. Set `report->struct_size` first.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_last_closing(const cairn_filter *filter, cairn_closing_report *report);

/** Pose of the body in the open submap, and the covariance of its error [dp; dtheta] (6x6 row-major); each may be NULL.
 *  With a single map: in the map. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT.
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_local_pose(const cairn_filter *filter, cairn_pose *pose, double covariance[36]);

/** Pose of the open submap's origin in the map, and the covariance of its error [dp; dtheta] (6x6 row-major); each may be
 *  NULL. With a single map: identity and zero. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT.
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_base_pose(const cairn_filter *filter, cairn_pose *pose, double covariance[36]);

/** Number of closed submaps. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1).
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_submap_count(const cairn_filter *filter, size_t *count);

/** A closed submap, counted from 0: the pose of its origin in the map, as known now (dense: as known at its closing), and
 *  the ids of its landmarks in the order of their placing. `base` may be NULL. NULL with capacity 0 asks for their number.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND, CAIRN_ERROR_BUFFER.
 *  Complexity: O(landmarks of the submap). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_submap(const cairn_filter *filter, size_t index, cairn_pose *base, uint64_t *ids,
                                           size_t capacity, size_t *needed);

/** What the last update did. */
typedef struct cairn_update_report {
  uint32_t struct_size;  /**< sizeof(cairn_update_report) of the caller; set it before the call */
  uint32_t matched;      /**< observations that updated a landmark */
  uint32_t placed;       /**< observations that placed one */
  uint32_t rejected;     /**< observations refused */
  uint32_t rows;         /**< rows of the batch after the gates: degrees of freedom of `nis` */
  uint32_t iterations;   /**< linearisations done */
  double nis;            /**< normalised innovation squared of the batch at the prediction */
  double nis_lower;      /**< 95 % band of `nis`: lower bound */
  double nis_upper;      /**< 95 % band of `nis`: upper bound */
  uint32_t association_nodes;     /**< joint tests that association took */
  uint32_t association_exhausted; /**< 1: it stopped at the bound of the options; there may be a better set of pairs */
  double association_seconds;     /**< what association took */
  uint32_t deferred;              /**< landmarks that do not count yet, after it */
  uint32_t removed;               /**< landmarks dropped after it: missed too often, or not seen again in time */
} cairn_update_report;

/** Reports on the last successful update of any kind; zeros before the first. Set `report->struct_size` first.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_last_update(const cairn_filter *filter, cairn_update_report *report);

/** Pose of the body in the map, and the covariance of its error [dp; dtheta] (6x6 row-major); each may be NULL.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_pose(const cairn_filter *filter, cairn_pose *pose, double covariance[36]);

/** Joint covariance of the pose's error [dp; dtheta] and the positions of chosen landmarks, in this order, row-major,
 *  6 + 3 count on a side. `capacity` and `*needed` count doubles; NULL with 0 asks for the size.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND, CAIRN_ERROR_BUFFER.
 *  Complexity: O(count^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_joint_covariance(const cairn_filter *filter, const uint64_t *ids, size_t count,
                                                     double *matrix, size_t capacity, size_t *needed);

/** The landmarks of the open submap, in its frame; with a single map the same as \ref cairn_filter_map.
 *  It lives as long as the filter and follows it. Never fails but for NULL, which gives NULL.
 *  Threads: as any const query of the handle. Complexity: O(1). \since 0.1.0 */
CAIRN_API const cairn_map *cairn_filter_local_map(const cairn_filter *filter);

/** The filter's map; with submaps, that of the closed ones: what the open one holds joins it when it is closed.
 *  It lives as long as the filter and follows it. Never fails but for NULL, which gives NULL.
 *  Threads: as any const query of the handle. Complexity: O(1). \since 0.1.0 */
CAIRN_API const cairn_map *cairn_filter_map(const cairn_filter *filter);

/** Normalised estimation error squared of the pose against a true one, in the filter's own error coordinates: about 6,
 *  of a planar vehicle 3, on average for a consistent filter. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT,
 *  CAIRN_ERROR_NUMERICAL (the pose's covariance is singular, as at a known start). Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_pose_nees(const cairn_filter *filter, const cairn_pose *truth, double *nees);

/** Audits the whole covariance (with submaps, the open one's): `min_pivot` gets the smallest pivot of its Cholesky factor after scaling to unit
 *  diagonal, 0 or less where it is not positive definite. States that are exactly known (zero variance) are left out.
 *  Threads: one a handle (it uses the filter's workspace). Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(n^3). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_audit(cairn_filter *filter, double *min_pivot);

#ifdef __cplusplus
}
#endif

#endif
