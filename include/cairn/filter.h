/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  The filter of one vehicle: create it, predict, update, query. */
#ifndef CAIRN_FILTER_H
#define CAIRN_FILTER_H

#include <cairn/map.h>
#include <cairn/motion.h>
#include <cairn/pose.h>
#include <cairn/sensor.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Estimates the pose of one vehicle and its map together. */
typedef struct cairn_filter cairn_filter;

/** Error of the state that the filter's covariance describes (docs/invariant_error.md). */
typedef int32_t cairn_state_error;
enum CAIRN_VALUES(cairn_state_error) {
  CAIRN_STATE_ERROR_INVARIANT = 0, /**< right-invariant error on SE_{K+1}(3): consistent; the default */
  CAIRN_STATE_ERROR_STANDARD = 1   /**< separate errors of position, attitude and landmarks: standard
                                        EKF-SLAM, for comparison */
};

/** Space in which the vehicle moves (docs/plane.md). The interface of a planar vehicle is the same as that of a spatial
 *  one: the vehicle lies in z = 0 and turns about z. The filter reads only the rows and columns of x, y and yaw of
 *  covariances and Jacobians that it gets. Covariances that it returns have zeros elsewhere. */
typedef int32_t cairn_vehicle;
enum CAIRN_VALUES(cairn_vehicle) {
  CAIRN_VEHICLE_SPATIAL = 0, /**< six degrees of freedom; the default */
  CAIRN_VEHICLE_PLANAR = 1   /**< x, y and heading; landmarks x and y */
};

/** How a closed submap joins the map (docs/submaps.md). */
typedef int32_t cairn_join;
enum CAIRN_VALUES(cairn_join) {
  CAIRN_JOIN_AUTO = 0,  /**< dense if max_landmarks is at most 100, sparse otherwise; the default */
  CAIRN_JOIN_DENSE = 1, /**< a filter with the covariance of the whole map: a closing costs O(n^2) for n states of
                             the map */
  CAIRN_JOIN_SPARSE = 2 /**< solves for all submaps together on a sparse factor and relinearises them: the total cost
                             is nearly linear */
};

/** How the filter finds the landmark of an observation (docs/association.md). */
typedef int32_t cairn_association;
enum CAIRN_VALUES(cairn_association) {
  CAIRN_ASSOCIATION_KNOWN = 0,   /**< by the id of the observation; the default */
  CAIRN_ASSOCIATION_NEAREST = 1, /**< nearest neighbour by Mahalanobis distance; each landmark is matched at most
                                      once in a frame. Ids of observations are ignored, and landmarks are numbered
                                      from 0 in the order in which they are placed */
  CAIRN_ASSOCIATION_JOINT = 2    /**< the largest set of pairs that are jointly compatible (branch and bound); ids as
                                      for CAIRN_ASSOCIATION_NEAREST */
};

/** Distance by which CAIRN_ASSOCIATION_NEAREST chooses among landmarks. */
typedef int32_t cairn_distance;
enum CAIRN_VALUES(cairn_distance) {
  CAIRN_DISTANCE_MAHALANOBIS = 0, /**< the squared Mahalanobis distance d^2; the default */
  CAIRN_DISTANCE_LIKELIHOOD = 1   /**< d^2 + log det S, which is -2 log of the likelihood: if two landmarks have the
                                       same d^2, the better known one is chosen. The gates still use d^2 */
};

/** What becomes of the noise that the filter learns from its innovations (docs/trust.md). */
typedef int32_t cairn_noise_learning;
enum CAIRN_VALUES(cairn_noise_learning) {
  CAIRN_NOISE_REPORTED = 0, /**< \ref cairn_filter_health reports it; the default */
  CAIRN_NOISE_APPLIED = 1   /**< from when it is known, it scales the stated noise of each sensor and of the motion */
};

/** Options of \ref cairn_filter_create. Set them by \ref cairn_filter_options_init first. */
typedef struct cairn_filter_options {
  uint32_t struct_size;                /**< sizeof(cairn_filter_options) of the caller */
  cairn_vehicle vehicle;               /**< CAIRN_VEHICLE_SPATIAL or CAIRN_VEHICLE_PLANAR; default
                                            CAIRN_VEHICLE_SPATIAL */
  cairn_state_error state_error;       /**< CAIRN_STATE_ERROR_INVARIANT or CAIRN_STATE_ERROR_STANDARD; default
                                            CAIRN_STATE_ERROR_INVARIANT */
  CAIRN_RANGE(>= 1, <= 10000000)
  uint32_t max_landmarks;              /**< capacity; default 1000. Single map or dense joining: 1 to 30000, the
                                            memory grows with the square of this number and is taken at creation.
                                            Sparse joining: 1 to 10000000, only a bound, memory is taken as the map
                                            grows */
  uint32_t max_observations;           /**< observations of one frame, 1 to 4096; default 64 */
  uint32_t max_sensors;                /**< sensors that can be added, 1 to 256; default 8 */
  cairn_pose initial_pose;             /**< body in the map frame at the start; default identity */
  CAIRN_UNIT(pose^2)
  double initial_covariance[36];       /**< covariance of its error [dp; dtheta], symmetric, positive semidefinite;
                                            default 0: known exactly */
  uint32_t iterations;                 /**< linearisations of an update at most, 1 (plain EKF) to 50; default 3 */
  cairn_noise_learning noise_learning; /**< CAIRN_NOISE_REPORTED or CAIRN_NOISE_APPLIED; default CAIRN_NOISE_REPORTED */
  CAIRN_UNIT(1)
  double iteration_tolerance;          /**< the iteration ends when the linearisation error of the batch is smaller
                                            than this, > 0; it is measured in standard deviations of the
                                            observations, root of the sum of squares; default 0.1 */
  CAIRN_UNIT(1)
  double gate_probability;             /**< chi-square gate of one observation, in (0, 1]; 1: no gate; default 0.999 */
  CAIRN_UNIT(1)
  double batch_gate_probability;       /**< chi-square gate of a whole batch, in (0, 1]; 1: no gate; default 0.9999 */
  CAIRN_UNIT(1)
  double error_persistence;            /**< number of consecutive observations of a landmark whose errors are fully
                                            correlated, 1 to 1000000: an update multiplies the covariance of an
                                            observation's noise by this; association, placing and the weights of a
                                            robust loss use the noise unchanged; default 1 */
  cairn_association association;       /**< CAIRN_ASSOCIATION_KNOWN, CAIRN_ASSOCIATION_NEAREST or
                                            CAIRN_ASSOCIATION_JOINT; default CAIRN_ASSOCIATION_KNOWN */
  cairn_distance association_distance; /**< CAIRN_DISTANCE_MAHALANOBIS or CAIRN_DISTANCE_LIKELIHOOD; default
                                            CAIRN_DISTANCE_MAHALANOBIS */
  uint32_t association_nodes;          /**< joint tests of one frame at most, 1 to 1000000; after this number the
                                            best set found so far is used; default 2000 */
  uint32_t deferred_sightings;         /**< a new landmark is deferred until it was observed this often, 1 to 1000:
                                            until then it is part of the estimate, but no map shows it; default 1 */
  uint32_t deferred_frames;            /**< a deferred landmark is removed if it is not observed often enough within
                                            this many frames, 1 to 1000000; default 20 */
  uint32_t missed_frames;              /**< a landmark is removed if it lay in a sensor's view (\ref
                                            cairn_filter_set_view), but was not seen, in this many consecutive frames
                                            of this sensor; 0, the default: never */
  CAIRN_UNIT(1)
  double new_probability;              /**< unknown ids: an observation places a new landmark only if its distance
                                            from each landmark exceeds the chi-square bound of this probability, in
                                            (0, 1). Landmarks that another observation of the frame is paired with do
                                            not count. A pair beyond this bound is never made. Default 0.9999 */
  uint32_t submap_landmarks;           /**< a submap is closed when it holds this many landmarks, up to 4096; 0, the
                                            default: no submaps, one single map */
  cairn_join join;                     /**< CAIRN_JOIN_AUTO, CAIRN_JOIN_DENSE or CAIRN_JOIN_SPARSE; default
                                            CAIRN_JOIN_AUTO */
  cairn_loss join_loss;                /**< loss of the landmarks that a closed submap shares with the map:
                                            CAIRN_LOSS_NONE, CAIRN_LOSS_HUBER or CAIRN_LOSS_CAUCHY; default
                                            CAIRN_LOSS_NONE */
  uint32_t trajectory_poses;           /**< newest poses that are kept for \ref cairn_filter_trajectory, 0 to
                                            10000000; 0, the default: none. The memory is taken at creation, at most
                                            600 bytes a pose */
  double join_loss_width;              /**< where `join_loss` leaves the parabola, standard deviations, > 0; default
                                            1.5 */
  double submap_distance;              /**< a submap is also closed when the vehicle has driven this far in it, m; 0,
                                            the default: no limit */
  double submap_extent;                /**< a submap is also closed when a landmark lies this far from its origin, m;
                                            0, the default: no limit */
  double submap_sigma;                 /**< a submap is also closed when the largest standard deviation of the
                                            vehicle's position in it exceeds this, m; 0, the default: no limit */
  double velocity_bias_sigma[3];       /**< a constant error of the measured body velocity (x, y, z) is a state, with
                                            this standard deviation at the start, m/s, >= 0; 0, the default: no
                                            state. The velocity is the measured one minus the bias
                                            (docs/systematic_errors.md). A planar vehicle has only x and y */
  CAIRN_UNIT(m/s^1.5)
  double velocity_bias_walk[3];        /**< random walk of that error, m/s in the square root of a second, >= 0; it
                                            needs its velocity_bias_sigma; default 0: constant */
  double rate_bias_sigma[3];           /**< the same for the measured body rate, rad/s, >= 0; default 0. A planar
                                            vehicle has only z */
  CAIRN_UNIT(rad/s^1.5)
  double rate_bias_walk[3];            /**< rad/s in the square root of a second, >= 0; default 0 */
  CAIRN_UNIT(1)
  double wheel_scale_sigma[2];         /**< the same for the scales of the left and the right wheels: a wheel turns
                                            at the measured rate times 1 + its scale, >= 0; default 0 */
  CAIRN_UNIT(1/s^0.5)
  double wheel_scale_walk[2];          /**< in the square root of a second, >= 0; default 0 */
  uint32_t max_sensor_errors;          /**< numbers that \ref cairn_filter_calibrate_sensor makes states, over all
                                            sensors, 0 to 64; default 0 */
  uint32_t reserved;                   /**< 0 */
} cairn_filter_options;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_options_init(CAIRN_OUT cairn_filter_options *options, size_t struct_size,
                                                 cairn_error *error);

/** Bytes that \ref cairn_filter_create will take with these options. Only closings of submaps take more: workspace
 *  while they run, and with sparse joining the memory by which the map grows.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_required_bytes(const cairn_filter_options *options, CAIRN_OUT size_t *bytes,
                                                   cairn_error *error);

/** Creates a filter. The caller destroys it with \ref cairn_filter_destroy. Options of an older or a newer header are
 *  used as far as both sides know them. On an error `*filter` is not written.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY. Complexity: O(memory). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_create(const cairn_filter_options *options, cairn_filter **filter,
                                           cairn_error *error);

/** Destroys a filter and the map that it owns. NULL is allowed. Threads: one a handle.
 *  Complexity: O(memory). \since 0.1.0 */
CAIRN_API void cairn_filter_destroy(cairn_filter *filter);

/** Receives a line (UTF-8) of a filter's log. `payload` is the pointer that \ref cairn_filter_set_log got. */
typedef void (*cairn_log_fn)(void *payload, const char *line);

/** Sets the receiver of this filter's log lines (refused batches, numerical refusals). NULL, the default: no log.
 *  The callback runs inside calls of the filter and must not call the same filter. `release` (or NULL) gets `payload`
 *  when the log is replaced or the filter is destroyed. If this call fails, `payload` stays the caller's.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_set_log(cairn_filter *filter, CAIRN_OPTIONAL cairn_log_fn log, void *payload,
                                            cairn_release_fn release, cairn_error *error);

/* Sensors. Each call copies the description and returns the number of the sensor, counted from 0, for later calls. */

/** Adds a stereo head. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_add_stereo_head(cairn_filter *filter, const cairn_stereo_head *head,
                                                    CAIRN_OUT int32_t *sensor, cairn_error *error);

/** Adds a stereo camera. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_add_stereo_camera(cairn_filter *filter, const cairn_stereo_camera *camera,
                                                      CAIRN_OUT int32_t *sensor, cairn_error *error);

/** Adds a planar range-bearing sensor (radar, lidar, sonar). Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT
 *  (also if the vehicle is spatial), CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_add_range_bearing(cairn_filter *filter, const cairn_range_bearing *radar,
                                                      CAIRN_OUT int32_t *sensor, cairn_error *error);

/** Adds a cartesian sensor, which gives points. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT,
 *  CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_add_cartesian(cairn_filter *filter, const cairn_cartesian *cartesian,
                                                  CAIRN_OUT int32_t *sensor, cairn_error *error);

/** Adds a sensor of the caller's own. `predict` is required. `place` NULL: this sensor places no landmarks, it only
 *  observes landmarks that other sensors placed. It must be NULL if rows < 3 (planar: 2), because such an observation
 *  does not determine a position. `user` is passed to both functions, which run inside \ref cairn_filter_update. They
 *  must not call the same filter, and no exception and no longjmp may leave them. `release` (or NULL) gets `user` when
 *  the filter is destroyed. If this call fails, `user` stays the caller's.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_add_custom(cairn_filter *filter, const cairn_custom *custom,
                                               cairn_custom_predict_fn predict,
                                               CAIRN_OPTIONAL cairn_custom_place_fn place, void *user,
                                               cairn_release_fn release, CAIRN_OUT int32_t *sensor, cairn_error *error);

/** Sets the pan and stick angle (rad) of a stereo head from now on; both are 0 after it was added. Call this function
 *  before each frame that was taken at other angles. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (not finite,
 *  or no stereo head), CAIRN_ERROR_NOT_FOUND. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_point_head(cairn_filter *filter, int32_t sensor, CAIRN_UNIT(rad) double pan,
                                               CAIRN_UNIT(rad) double stick, cairn_error *error);

/** Sets the loss of a sensor's residuals: an observation whose distance is large gets less weight, instead of being
 *  refused. `width` (> 0) is where the loss leaves the parabola, in standard deviations of the observation's noise. The
 *  weights are found in the iteration of the update, and the covariance is that of the robust estimate (docs/update.md,
 *  "Robust losses"). The chi-square gates stay; options with gate probabilities of 1 open them. CAIRN_LOSS_NONE takes
 *  the loss away; `width` is then ignored. Allocates nothing. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT,
 *  CAIRN_ERROR_NOT_FOUND. \since 0.2.0 */
CAIRN_API cairn_status cairn_filter_set_loss(cairn_filter *filter, int32_t sensor, cairn_loss loss,
                                             CAIRN_UNIT(1) CAIRN_RANGE(> 0) double width, cairn_error *error);

/** Sets the region in which a sensor detects every landmark: all observations between `lower` and `upper`, value by
 *  value, in the sensor's units. An infinite value is no bound. A sensor of fewer than 3 rows uses the first values.
 *  A frame has missed a landmark if its predicted observation lies inside the region by three standard deviations,
 *  and no observation of the frame was compared with the landmark (`missed_frames`). Threads: one a handle. Errors:
 *  CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_set_view(cairn_filter *filter, int32_t sensor,
                                             CAIRN_UNIT(sensor) const double lower[3],
                                             CAIRN_UNIT(sensor) const double upper[3], cairn_error *error);

/* Motion. A prediction costs O(1), whatever the size of the map, and allocates nothing. */

/** Sets the wheels for \ref cairn_filter_predict_wheels. Until then those of \ref cairn_wheels_init are used.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_set_wheels(cairn_filter *filter, const cairn_wheels *wheels, cairn_error *error);

/** Sets the noise of \ref cairn_filter_predict_twist. Until then that of \ref cairn_twist_noise_init is used.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_set_twist_noise(cairn_filter *filter, const cairn_twist_noise *noise,
                                                    cairn_error *error);

/** Moves the vehicle by the turning rates of its left and right wheels (rad/s) over `dt` seconds (> 0).
 *  Mars paper, eq. 1 and 2. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL.
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_predict_wheels(cairn_filter *filter, CAIRN_UNIT(s) CAIRN_RANGE(> 0) double dt,
                                                   CAIRN_UNIT(rad/s) double left_rad_per_s,
                                                   CAIRN_UNIT(rad/s) double right_rad_per_s, cairn_error *error);

/** Moves the vehicle by the turning rates of its left and right wheels (rad/s) and the body rate of a gyro (rad/s)
 *  over `dt` seconds (> 0): the velocity is that of \ref cairn_filter_predict_wheels, with its noise, and the rate has
 *  the noise of \ref cairn_filter_set_twist_noise. A planar vehicle reads only the rate about z.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL. Complexity: O(1). \since 0.2.0 */
CAIRN_API cairn_status cairn_filter_predict_wheels_gyro(cairn_filter *filter, CAIRN_UNIT(s) CAIRN_RANGE(> 0) double dt,
                                                        CAIRN_UNIT(rad/s) double left_rad_per_s,
                                                        CAIRN_UNIT(rad/s) double right_rad_per_s,
                                                        CAIRN_UNIT(rad/s) const double rate[3], cairn_error *error);

/** Moves the vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0).
 *  Mars paper, eq. 2. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL. Complexity: O(1).
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_predict_twist(cairn_filter *filter, CAIRN_UNIT(s) CAIRN_RANGE(> 0) double dt,
                                                  CAIRN_UNIT(m/s) const double velocity[3],
                                                  CAIRN_UNIT(rad/s) const double rate[3], cairn_error *error);

/** Moves the vehicle by a relative pose, `T_map_body <- T_map_body T_before_after`, with the covariance (6x6 row-major,
 *  symmetric, positive semidefinite) of its error [dp; dtheta] in the axes of the body before the motion.
 *  An increment has no duration: a filter that estimates a velocity or rate bias refuses it, and no random walk goes
 * on. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL, CAIRN_ERROR_STATE (a bias is a
 *  state). Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_predict_increment(cairn_filter *filter, CAIRN_IN const cairn_pose *T_before_after,
                                                      CAIRN_UNIT(pose^2) const double covariance[36],
                                                      cairn_error *error);

/* Observations. A call is one batch of observations. A call that fails leaves the filter as it was, bit for bit. */

/** Updates the filter by one frame of one sensor. The observations of known landmarks update the state together. An
 *  observation with an unknown id places a new landmark, with all its correlations. `matches` (room for `count`, or
 *  NULL) gets the match of each observation. `count` may be 0. Allocates nothing.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (also an id twice, CAIRN_ID_NONE, noise that is not a
 *  covariance), CAIRN_ERROR_NOT_FOUND (sensor), CAIRN_ERROR_CAPACITY (more than max_observations),
 *  CAIRN_ERROR_NUMERICAL, CAIRN_ERROR_CALLBACK (a custom sensor's function aborted). Complexity: O(n^2 m) for n states
 *  and m rows. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_update(cairn_filter *filter, int32_t sensor,
                                           CAIRN_IN_ARRAY(count) const cairn_observation *observations, size_t count,
                                           CAIRN_OUT_ARRAY(count) CAIRN_OPTIONAL cairn_match *matches,
                                           cairn_error *error);

/** Updates the filter by an observation that the caller has linearised: `residual = z - h` (rows values),
 *  `covariance` of the noise (rows x rows), `jacobian_pose` = dh/[dp; dtheta] (rows x 6, NULL for zero) and
 *  `jacobian_landmarks` = dh/d positions (rows x 3 count, columns in the order of `landmarks`); all row-major. With
 *  submaps, pose and landmarks are those of the open submap, in its frame. The observation is gated as one of that
 *  many rows (gate_probability) and is not iterated. `match` (or NULL) gets the match; its landmark is the first one,
 *  or CAIRN_ID_NONE. rows is 1 to 3 max_observations (planar: 2), count at most max_observations.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND, CAIRN_ERROR_CAPACITY,
 *  CAIRN_ERROR_NUMERICAL. Complexity: O(n^2 rows). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_update_linear(cairn_filter *filter,
    CAIRN_IN_ARRAY(rows) CAIRN_UNIT(sensor) const double *residual, size_t rows,
    CAIRN_IN_ARRAY(rows * rows) CAIRN_UNIT(sensor^2) const double *covariance,
    CAIRN_IN_ARRAY(rows * 6) CAIRN_OPTIONAL CAIRN_UNIT(sensor/pose) const double *jacobian_pose,
    CAIRN_IN_ARRAY(count) const uint64_t *landmarks, size_t count,
    CAIRN_IN_ARRAY(rows * 3 * count) CAIRN_UNIT(sensor/m) const double *jacobian_landmarks,
    CAIRN_OUT CAIRN_OPTIONAL cairn_match *match, cairn_error *error);

/** Updates the filter by an absolute position (GNSS): `z = p + R lever_arm` in the map frame, m; 3x3 `covariance`,
 *  positive definite. `lever_arm` (body frame, m) may be NULL: zero. `match` (or NULL) gets the match.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL. Complexity: O(n^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_update_position(cairn_filter *filter, CAIRN_UNIT(m) const double position[3],
                                                    CAIRN_UNIT(m^2) const double covariance[9],
                                                    CAIRN_OPTIONAL CAIRN_UNIT(m) const double lever_arm[3],
                                                    CAIRN_OUT CAIRN_OPTIONAL cairn_match *match, cairn_error *error);

/** Updates the filter by an absolute attitude (star tracker): quaternion w x y z from body to map; 3x3 `covariance`
 *  (rad^2, positive definite) of its error dtheta in the map's axes. `match` (or NULL) gets the match.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL. Complexity: O(n^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_update_attitude(cairn_filter *filter, CAIRN_UNIT(1) const double quaternion[4],
                                                    CAIRN_UNIT(rad^2) const double covariance[9],
                                                    CAIRN_OUT CAIRN_OPTIONAL cairn_match *match, cairn_error *error);

/** Updates the filter by an absolute heading (sun sensor, compass): the yaw of the body's x axis in the map, rad,
 *  with its standard deviation (> 0). A tilted body adds noise of second order (docs/sensors.md). The heading is
 *  refused (CAIRN_REASON_NO_IMAGE) if the x axis is within three standard deviations of the tilt of the vertical.
 *  `match` (or NULL) gets the match.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL. Complexity: O(n^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_update_heading(cairn_filter *filter, CAIRN_UNIT(rad) double heading,
                                                   CAIRN_UNIT(rad) CAIRN_RANGE(> 0) double sigma,
                                                   CAIRN_OUT CAIRN_OPTIONAL cairn_match *match, cairn_error *error);

/** Removes a landmark from the map and from the open submap. The information that it gave about other states stays.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_remove_landmark(cairn_filter *filter, uint64_t id, cairn_error *error);

/** Merges two landmarks of the open submap, or of the single map, that are in truth one. The filter observes that
 *  their difference is zero; this observation is gated like any other (gate_probability). If it passes, `other` is
 *  removed, and `id` stays with the observations of both. `match` (or NULL) gets the match.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND, CAIRN_ERROR_CAPACITY (max_observations
 *  is 1), CAIRN_ERROR_NUMERICAL. Complexity: O(n^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_merge_landmarks(cairn_filter *filter, uint64_t id, uint64_t other,
                                                    CAIRN_OUT CAIRN_OPTIONAL cairn_match *match, cairn_error *error);

/** Splits a landmark that is in truth two landmarks. The new landmark `fresh` gets the position of `id` plus an
 *  independent error with this 3x3 covariance (positive definite; it says how far apart the two may be). Later
 *  observations separate the two. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (also if `fresh` exists, or if
 *  the filter names landmarks itself and `fresh` is 2^63 or more), CAIRN_ERROR_NOT_FOUND, CAIRN_ERROR_CAPACITY. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_split_landmark(cairn_filter *filter, uint64_t id, uint64_t fresh,
                                                   CAIRN_UNIT(m^2) const double covariance[9], cairn_error *error);

/* Submaps (docs/submaps.md). With submap_landmarks > 0 the filter works in a submap. A submap starts at the vehicle's
 * pose, with zero covariance, so the cost of a step does not depend on the size of the map. A full submap is closed:
 * its landmarks join the map, and the next submap starts at the vehicle's pose. cairn_filter_update closes the submap
 * after the frame that filled it. If the closing fails (memory, capacity), the update still succeeds, the submap stays
 * open, the report of the closing says why, and later frames try again. An absolute observation (position, attitude,
 * heading) does not close the open submap, but for two: the first one of a filter whose vehicle has moved, and one that
 * is not linear in the error of the submap's base (far away, and the heading there hardly known). */

/** Why a submap was closed. */
typedef int32_t cairn_closed_by;
enum CAIRN_VALUES(cairn_closed_by) {
  CAIRN_CLOSED_BY_NONE = 0,      /**< no submap was closed yet */
  CAIRN_CLOSED_BY_CALLER = 1,    /**< \ref cairn_filter_close_submap */
  CAIRN_CLOSED_BY_LANDMARKS = 2, /**< submap_landmarks */
  CAIRN_CLOSED_BY_DISTANCE = 3,  /**< submap_distance */
  CAIRN_CLOSED_BY_EXTENT = 4,    /**< submap_extent */
  CAIRN_CLOSED_BY_SIGMA = 5,     /**< submap_sigma */
  CAIRN_CLOSED_BY_FIX = 6        /**< an absolute position, attitude or heading could not be taken in otherwise */
};

/** Report of the last attempt to close a submap. */
typedef struct cairn_closing_report {
  uint32_t struct_size;             /**< sizeof(cairn_closing_report) of the caller; set it before the call */
  cairn_status status;              /**< CAIRN_OK, or the error because of which the submap stayed open */
  cairn_closed_by reason;           /**< CAIRN_CLOSED_BY_... */
  uint32_t submaps;                 /**< submaps closed so far */
  uint32_t landmarks;               /**< landmarks of the submap */
  uint32_t landmarks_new;           /**< landmarks of the submap that are new to the map */
  uint32_t landmarks_fused;         /**< landmarks of the submap that the map knows, and that were fused with it */
  uint32_t landmarks_refused;       /**< landmarks of the submap that contradict the map's estimates, and that were
                                         left out */
  uint32_t landmarks_ambiguous;     /**< unknown ids: landmarks of the submap that may be landmarks of the map, but
                                         no pair is certain: left out */
  uint32_t rows;                    /**< degrees of freedom of `distance` */
  CAIRN_UNIT(1)
  double distance;                  /**< joint squared Mahalanobis distance between both estimates of the fused
                                         landmarks */
  CAIRN_UNIT(1)
  double threshold;                 /**< its chi-square bound at batch_gate_probability */
  double moved_max;                 /**< largest movement of an older landmark of the map, m */
  double moved_rms;                 /**< root mean square of these movements, m */
  double widened_position;          /**< most known landmarks of the submap contradicted the map and agreed on
                                         another pose of its origin: how far from the estimate, m; 0: they did not
                                         (docs/update.md, "Finding back") */
  double widened_attitude;          /**< the same of the attitude, rad */
  uint32_t association_nodes;       /**< joint tests of the association with the map */
  cairn_bool association_exhausted; /**< 1: it stopped at the bound `association_nodes` of the options */
  uint32_t relinearised;            /**< submaps linearised again (sparse) */
  uint32_t refactored;              /**< blocks of the factor computed again (sparse) */
  uint32_t iterations;              /**< linear solutions */
  uint32_t reserved;                /**< 0 */
  double seconds;                   /**< duration of the closing, s; it differs from run to run */
} cairn_closing_report;

/** Closes the open submap now. Allocates. A call that fails leaves the filter as it was, with the submap open.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (a single map, or the submap holds no
 *  landmark), CAIRN_ERROR_CAPACITY (max_landmarks), CAIRN_ERROR_NUMERICAL, CAIRN_ERROR_MEMORY. Complexity: dense
 *  O(n^2) for n states of the map; sparse: the part of the factor that the closing affects. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_close_submap(cairn_filter *filter, cairn_error *error);

/** Reports on the last attempt to close a submap; zeros before the first attempt. Set `report->struct_size` first.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_last_closing(const cairn_filter *filter, CAIRN_OUT cairn_closing_report *report,
                                                 cairn_error *error);

/** Pose of the body in the open submap, and the covariance of its error [dp; dtheta] (6x6 row-major); each may be NULL.
 *  With a single map: in the map. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT.
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_local_pose(const cairn_filter *filter, CAIRN_OUT CAIRN_OPTIONAL cairn_pose *pose,
                                               CAIRN_OUT CAIRN_OPTIONAL CAIRN_UNIT(pose^2) double covariance[36],
                                               cairn_error *error);

/** Pose of the open submap's origin in the map, and the covariance of its error [dp; dtheta] (6x6 row-major); each
 *  may be NULL. That is what the closed submaps tell: landmarks that the open submap sees again, and fixes in it, correct
 *  \ref cairn_filter_pose at once and the origin at the closing. With a single map: identity and zero. Threads: as any const query of the handle. Errors:
 *  CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_base_pose(const cairn_filter *filter, CAIRN_OUT CAIRN_OPTIONAL cairn_pose *pose,
                                              CAIRN_OUT CAIRN_OPTIONAL CAIRN_UNIT(pose^2) double covariance[36],
                                              cairn_error *error);

/** Number of submaps closed so far. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT.
 *  Complexity: O(1).
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_submap_count(const cairn_filter *filter, CAIRN_OUT size_t *count,
                                                 cairn_error *error);

/** A closed submap, counted from 0: the pose of its origin in the map as known now (dense: as known at its closing),
 *  and the ids of its landmarks in the order in which they were placed. Of a submap that a sparse map has fused with
 *  others of its place they are the ids of this place. `base` may be NULL. Capacity 0 asks for the number of ids.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND,
 *  CAIRN_ERROR_BUFFER. Complexity: O(landmarks of the submap). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_submap(const cairn_filter *filter, size_t index,
                                           CAIRN_OUT CAIRN_OPTIONAL cairn_pose *base,
                                           CAIRN_OUT_ARRAY(capacity) uint64_t *ids, size_t capacity, size_t *needed,
                                           cairn_error *error);

/** Report of the last update. */
typedef struct cairn_update_report {
  uint32_t struct_size;             /**< sizeof(cairn_update_report) of the caller; set it before the call */
  uint32_t matched;                 /**< observations that updated a landmark */
  uint32_t placed;                  /**< observations that placed a new landmark */
  uint32_t placed_again;            /**< landmarks among `placed` that had been placed wrongly before
                                         (docs/update.md, "A landmark that was placed wrongly") */
  uint32_t rejected;                /**< observations that were refused */
  uint32_t deferred;                /**< landmarks that do not count after the update: seen too rarely
                                         (`deferred_sightings`, or once while gross errors are many), or as many
                                         observations contradict them as agree */
  uint32_t removed;                 /**< landmarks removed after the update: missed too often, not seen again in
                                         time, or none of a full submap counted */
  uint32_t rows;                    /**< rows of the batch after the gates: degrees of freedom of `nis` */
  CAIRN_UNIT(1)
  double nis;                       /**< normalised innovation squared of the batch at the prediction */
  CAIRN_UNIT(1)
  double nis_lower;                 /**< 95 % band of `nis`: lower bound */
  CAIRN_UNIT(1)
  double nis_upper;                 /**< 95 % band of `nis`: upper bound */
  double widened_position;          /**< most of what was seen contradicted the estimate: standard deviation by which
                                         the motion since the last agreement was widened, m; 0: it was not
                                         (docs/update.md, "Finding back") */
  double widened_attitude;          /**< the same of the attitude, rad */
  uint32_t iterations;              /**< number of linearisations */
  uint32_t association_nodes;       /**< joint tests of the association */
  cairn_bool association_exhausted; /**< 1: it stopped at the bound `association_nodes` of the options; a better set
                                         of pairs may exist */
  uint32_t reserved;                /**< 0 */
  double association_seconds;       /**< duration of the association, s; it differs from run to run */
} cairn_update_report;

/** Reports on the last successful update of any kind; zeros before the first update. Set `report->struct_size` first.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_last_update(const cairn_filter *filter, CAIRN_OUT cairn_update_report *report,
                                                cairn_error *error);

/** Pose of the body in the map, and the covariance of its error [dp; dtheta] (6x6 row-major); each may be NULL.
 *  With submaps the pose knows what the open submap has seen again of the map, before the submap is closed.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1); with submaps O(d^3) for d
 *  landmarks that the open submap and the map have in common, and once after d has changed what
 *  cairn_map_joint_covariance of them costs. \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_pose(const cairn_filter *filter, CAIRN_OUT CAIRN_OPTIONAL cairn_pose *pose,
                                         CAIRN_OUT CAIRN_OPTIONAL CAIRN_UNIT(pose^2) double covariance[36],
                                         cairn_error *error);

/** Joint covariance of the pose's error [dp; dtheta] and the positions of chosen landmarks, in this order, row-major,
 *  with 6 + 3 count rows and columns. `capacity` and `*needed` count doubles; capacity 0 asks for the size.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND,
 *  CAIRN_ERROR_BUFFER. Complexity: O(count^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_joint_covariance(const cairn_filter *filter,
                                                     CAIRN_IN_ARRAY(count) const uint64_t *ids, size_t count,
                                                     CAIRN_OUT_ARRAY(capacity) CAIRN_UNIT([pose, m]^2) double *matrix,
                                                     size_t capacity, size_t *needed, cairn_error *error);

/** The landmarks of the open submap, in its frame; with a single map the same as \ref cairn_filter_map. The filter owns
 *  this map; it lives as long as the filter and follows it. Fails only for NULL, and then returns NULL.
 *  Threads: as any const query of the handle. Complexity: O(1). \since 0.1.0 */
CAIRN_API CAIRN_BORROWED(filter) const cairn_map *cairn_filter_local_map(const cairn_filter *filter);

/** The filter's map. With submaps it holds the landmarks of the closed submaps; the landmarks of the open submap join
 *  it when this submap is closed. The filter owns this map; it lives as long as the filter and follows it. Fails only
 *  for NULL, and then returns NULL.
 *  Threads: as any const query of the handle. Complexity: O(1). \since 0.1.0 */
CAIRN_API CAIRN_BORROWED(filter) const cairn_map *cairn_filter_map(const cairn_filter *filter);

/** Normalised estimation error squared (NEES) of the pose against the true pose, in the error coordinates of the
 *  filter. A consistent filter has 6 on average, for a planar vehicle 3. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL (the covariance of the pose is singular, as at a known start).
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_pose_nees(const cairn_filter *filter, CAIRN_IN const cairn_pose *truth,
                                              CAIRN_OUT CAIRN_UNIT(1) double *nees, cairn_error *error);

/** Checks the whole covariance (with submaps, that of the open submap): `min_pivot` gets the smallest pivot of its
 *  Cholesky factor after scaling to unit diagonal. It is 0 or less if the covariance is not positive definite. States
 *  that are known exactly (zero variance) are left out. Threads: one a handle (the call uses the filter's workspace).
 *  Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(n^3). \since 0.1.0 */
CAIRN_API cairn_status cairn_filter_audit(cairn_filter *filter, CAIRN_OUT CAIRN_UNIT(1) double *min_pivot,
                                          cairn_error *error);

#ifdef __cplusplus
}
#endif

#endif
