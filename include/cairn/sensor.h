/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Sensors that observe landmarks: their mounts and their noise; observations, and the result of each observation. */
#ifndef CAIRN_SENSOR_H
#define CAIRN_SENSOR_H

#include <cairn/pose.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The id that no landmark has. */
#define CAIRN_ID_NONE UINT64_MAX

/** CAIRN_ID_NONE, for languages that cannot read a macro. Threads: any. \since 0.2.0 */
CAIRN_API uint64_t cairn_id_none(void);

/** How the noise of the two encoders of a head enters (\ref cairn_stereo_head). */
typedef int32_t cairn_encoder;
enum CAIRN_VALUES(cairn_encoder) {
  CAIRN_ENCODER_PER_OBSERVATION = 0, /**< the head moves between observations: each has independent noise; the
                                          default */
  CAIRN_ENCODER_PER_FRAME = 1        /**< the head stands still: all observations of a frame have the same encoder
                                          error */
};

/** Stereo head on a pan and tilt mount (Mars paper, Figures 2 and 3, eq. 4). It observes range, azimuth and elevation.
 *
 *  A point `m_c` of the camera frame (x out of the lens, y left, z up) lies in the body frame at
 *  `m_b = d + Rz(pan) Ry(stick) (s + R(q) m_c)`. The platform stands at `d`. It turns by `pan` about its z axis, and by
 *  `stick` about the bolt, which is its y axis. The stick carries the camera at `s`, turned by `q`.
 *  The observation is `z = (range, azimuth, elevation)` of `m_c`: `range = |m_c|` (m),
 *  `azimuth = atan2(y, x)` (rad, left positive), `elevation = atan2(z, sqrt(x^2 + y^2))` (rad, up positive).
 *  A positive stick angle lowers the lens, so a stick that turns by -elevation points the lens at the point. With the
 *  default mount the camera frame is the body frame. */
typedef struct cairn_stereo_head {
  uint32_t struct_size;        /**< sizeof(cairn_stereo_head) of the caller */
  cairn_encoder encoder_mode;  /**< CAIRN_ENCODER_PER_OBSERVATION or CAIRN_ENCODER_PER_FRAME; default
                                    CAIRN_ENCODER_PER_OBSERVATION */
  double platform[3];          /**< d: pan axis in the body frame, m; default 0 */
  CAIRN_UNIT(m)
  double stick[3];             /**< s: camera in the stick's frame, which has made both turns, m; default 0 */
  CAIRN_UNIT(1)
  double camera_quaternion[4]; /**< q: camera axes in the stick's frame, w x y z; default identity */
  double range_sigma;          /**< m, > 0; default 1.0 (Table 1) */
  double azimuth_sigma;        /**< rad, > 0; default 3 degrees (Table 1) */
  double elevation_sigma;      /**< rad, > 0; default 3 degrees (Table 1) */
  double pan_sigma;            /**< encoder noise of pan, rad, >= 0; default 0 */
  double stick_sigma;          /**< encoder noise of the stick, rad, >= 0; default 0 */
  double near_range;           /**< an observation is refused if the predicted range, or the observed range of a new
                                    landmark, is below this, m, > 0; default 0.1 */
  double max_elevation;        /**< an observation is also refused above this elevation, where the azimuth is nearly
                                    undefined, rad, in (0, pi/2); default 85 degrees */
} cairn_stereo_head;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_stereo_head_init(CAIRN_OUT cairn_stereo_head *head, size_t struct_size,
                                              cairn_error *error);

/** Rectified stereo camera: `z = (u_left, u_right, v)` in pixels of a point `(x, y, z)` of the left camera's frame
 *  (z out of the lens, x right, y down): `u_left = fu x/z + cu`, `u_right = fu (x - baseline)/z + cu`,
 *  `v = fv y/z + cv`. If both images give a row, pass the mean of both rows and half the variance of one. */
typedef struct cairn_stereo_camera {
  uint32_t struct_size;        /**< sizeof(cairn_stereo_camera) of the caller */
  uint32_t reserved;           /**< 0 */
  double fu;                   /**< focal length in u, pixels, > 0; default 500 */
  double fv;                   /**< focal length in v, pixels, > 0; default 500 */
  double cu;                   /**< principal point, pixels; default 320 */
  double cv;                   /**< principal point, pixels; default 240 */
  double baseline;             /**< m, > 0; default 0.2 */
  cairn_pose T_body_camera;    /**< left camera in the body; default: at the origin, looking along x */
  double sigma[3];             /**< noise of u_left, u_right, v, pixels, > 0; default 1 each */
  double near_depth;           /**< a landmark whose predicted depth is below this has no image, m, > 0; default 0.1 */
  double min_disparity;        /**< an observation places a landmark only if its disparity u_left - u_right is at
                                    least this, pixels, > 0; default 1 */
  CAIRN_UNIT(1)
  double min_disparity_sigmas; /**< and only if its disparity is at least this many of its standard deviations (from
                                    `sigma`), >= 0; default 2.5: the depth is known to 40 %. A landmark that is
                                    farther away is placed when it is seen from nearer */
} cairn_stereo_camera;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_stereo_camera_init(CAIRN_OUT cairn_stereo_camera *camera, size_t struct_size,
                                                cairn_error *error);

/** Radar, lidar or sonar of a planar vehicle: `z = (range, bearing)` of the landmark in the sensor's frame, m and rad,
 *  positive to the left. */
typedef struct cairn_range_bearing {
  uint32_t struct_size;     /**< sizeof(cairn_range_bearing) of the caller */
  uint32_t reserved;        /**< 0 */
  cairn_pose T_body_sensor; /**< sensor in the body, in the plane; default identity */
  double range_sigma;       /**< m, > 0; default 0.1 */
  double bearing_sigma;     /**< rad, > 0; default 0.01 */
  double near_range;        /**< an observation is refused if the predicted range, or the observed range of a new
                                 landmark, is below this, m, > 0; default 0.01 */
} cairn_range_bearing;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_range_bearing_init(CAIRN_OUT cairn_range_bearing *radar, size_t struct_size,
                                                cairn_error *error);

/** Any sensor that gives a point: `z = (x, y, z)` of the landmark in the sensor's frame, m; for a planar vehicle
 *  `z = (x, y)`. */
typedef struct cairn_cartesian {
  uint32_t struct_size;     /**< sizeof(cairn_cartesian) of the caller */
  uint32_t reserved;        /**< 0 */
  cairn_pose T_body_sensor; /**< sensor in the body; default identity */
  double sigma[3];          /**< noise of x, y, z, m, > 0; default 0.1 each */
} cairn_cartesian;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_cartesian_init(CAIRN_OUT cairn_cartesian *cartesian, size_t struct_size,
                                            cairn_error *error);

/** Predicts the observation of a landmark: the model of a sensor of the caller's own.
 *
 *  \param user             the caller's pointer
 *  \param pose             body in the map, as \ref cairn_pose defines it
 *  \param landmark         point in the map, m
 *  \param z                out, `rows` values
 *  \param jacobian_pose    out, rows x 6, row-major: dz / [dp; dtheta] (the error of \ref cairn_pose)
 *  \param jacobian_landmark out, rows x 3, row-major: dz / dlandmark
 *  \return 1: all values are written. 0: the landmark cannot be seen from this pose; the observation is refused. A
 *          negative value aborts the whole call with CAIRN_ERROR_CALLBACK, and the handle stays as before, bit for bit.
 *          Any other value is refused as an error. The same arguments must always give the same answer.
 *
 *  All three outputs are NaN before the call, and every value must be written, zeros too: the observation is refused
 *  if one is not finite. */
typedef int32_t (*cairn_custom_predict_fn)(void *user, CAIRN_IN const cairn_pose *pose,
    CAIRN_UNIT(m) const double landmark[3], CAIRN_OUT_ARRAY(cairn_custom.rows) CAIRN_UNIT(sensor) double *z,
    CAIRN_OUT_ARRAY(6 * cairn_custom.rows) CAIRN_UNIT(sensor/pose) double *jacobian_pose,
    CAIRN_OUT_ARRAY(3 * cairn_custom.rows) CAIRN_UNIT(sensor/m) double *jacobian_landmark);

/** Computes where the landmark lies that gave `z`: the inverse of \ref cairn_custom_predict_fn.
 *
 *  \param user             the caller's pointer
 *  \param pose             body in the map
 *  \param z                the observation, `rows` values
 *  \param landmark         out, point in the map, m
 *  \param jacobian_pose    out, 3 x 6, row-major: dlandmark / [dp; dtheta]
 *  \param jacobian_z       out, 3 x rows, row-major: dlandmark / dz
 *  \return 1, 0 or a negative value, as for \ref cairn_custom_predict_fn. 0 says that `z` cannot place a landmark. The
 *          outputs are NaN before the call here, too */
typedef int32_t (*cairn_custom_place_fn)(void *user, CAIRN_IN const cairn_pose *pose,
    CAIRN_IN_ARRAY(cairn_custom.rows) CAIRN_UNIT(sensor) const double *z, CAIRN_OUT CAIRN_UNIT(m) double landmark[3],
    CAIRN_OUT_ARRAY(18) CAIRN_UNIT(m/pose) double *jacobian_pose,
    CAIRN_OUT_ARRAY(3 * cairn_custom.rows) CAIRN_UNIT(m/sensor) double *jacobian_z);

/** A sensor of the caller's own, whose model are two functions (\ref cairn_filter_add_custom). */
typedef struct cairn_custom {
  uint32_t struct_size; /**< sizeof(cairn_custom) of the caller */
  uint32_t rows;        /**< values of an observation, 1 to 3; for a planar vehicle 1 or 2; default 3 */
  uint32_t angle_mask;  /**< bit i is set: value i is an angle (rad) and its residual is wrapped to (-pi, pi]; default
                             0 */
  cairn_bool relative;  /**< 1: z depends on pose and landmark only through the body point R^T (l - p), and the filter
                             makes use of that; default 0: any function of both */
  CAIRN_UNIT(sensor)
  double sigma[3];      /**< noise of each value, > 0; default 1 each */
} cairn_custom;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_custom_init(CAIRN_OUT cairn_custom *custom, size_t struct_size, cairn_error *error);

/** Compares a custom sensor's Jacobians with central differences on the manifold, at one pose and landmark. `worst`
 *  gets the largest difference; each difference is relative to max(1, |numerical value|). A correct Jacobian gives
 *  about 1e-6 or less. If `place` is not NULL, it is checked at the observation that `predict` gives: its Jacobians,
 *  and that it returns to the landmark. `relative` is not checked. `user` is passed to both functions.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT (also if `predict` refuses the landmark), CAIRN_ERROR_CALLBACK.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_custom_check(const cairn_custom *custom, cairn_custom_predict_fn predict,
                                          CAIRN_OPTIONAL cairn_custom_place_fn place, void *user,
                                          CAIRN_IN const cairn_pose *pose, CAIRN_UNIT(m) const double landmark[3],
                                          CAIRN_OUT CAIRN_UNIT(1) double *worst, cairn_error *error);

/** Loss of a residual at the distance d, in standard deviations (docs/update.md, "Robust losses"). */
typedef int32_t cairn_loss;
enum CAIRN_VALUES(cairn_loss) {
  CAIRN_LOSS_NONE = 0,  /**< d^2 / 2: least squares; the default */
  CAIRN_LOSS_HUBER = 1, /**< d^2 / 2 up to the width k, k d - k^2 / 2 beyond: the influence of an observation is
                             bounded */
  CAIRN_LOSS_CAUCHY = 2 /**< c^2 / 2 log(1 + d^2 / c^2): the influence falls with the distance, and gross outliers have
                             nearly none */
};

/** One observation of one landmark by one sensor. Layout frozen. */
typedef struct cairn_observation {
  uint64_t id;          /**< the caller's id of the landmark; not CAIRN_ID_NONE; once in a frame. Any value if the
                             filter's `association` is not CAIRN_ASSOCIATION_KNOWN */
  CAIRN_UNIT(sensor)
  double z[3];          /**< values in the sensor's units; a custom sensor of fewer rows uses the first */
  CAIRN_UNIT(sensor^2)
  double covariance[9]; /**< noise of this observation, 3x3 row-major (custom: rows x rows, packed); all zero: the
                             sensor's noise */
} cairn_observation;

/** Result of an observation. */
typedef int32_t cairn_result;
enum CAIRN_VALUES(cairn_result) {
  CAIRN_RESULT_MATCHED = 1, /**< it updated the landmark */
  CAIRN_RESULT_NEW = 2,     /**< it placed a new landmark, or placed a landmark again that had been placed wrongly;
                                 then `distance` and `threshold` are those of its test against the former place */
  CAIRN_RESULT_REJECTED = 3 /**< it was refused and changed nothing; `reason` says why */
};

/** Why an observation was refused. */
typedef int32_t cairn_reason;
enum CAIRN_VALUES(cairn_reason) {
  CAIRN_REASON_NONE = 0,       /**< it was not refused */
  CAIRN_REASON_GATE = 1,       /**< its distance exceeds the threshold of the gate of one observation (chi-square) */
  CAIRN_REASON_BATCH_GATE = 2, /**< it passed its own gate, but was removed so that the whole batch passes the batch
                                    gate */
  CAIRN_REASON_NO_IMAGE = 3,   /**< the estimated landmark cannot give an observation: behind the lens, too near, too
                                    steep */
  CAIRN_REASON_NO_PLACE = 4,   /**< the observation cannot place a landmark: disparity or range too small, range too
                                    large beside its noise, or the sensor never places landmarks */
  CAIRN_REASON_AMBIGUOUS = 5,  /**< unknown ids: it passed its own gate, but the best set of pairs does not contain
                                    it */
  CAIRN_REASON_NO_ROOM = 6,    /**< the observation could place a landmark, but the map is full */
  CAIRN_REASON_CONTRADICTED = 7 /**< the observation could place a landmark, but most of what is seen contradicts the
                                     pose: nothing is placed until it is decided what is wrong. \since 0.2.0 */
};

/** Match of one observation: what it was paired with, and whether it was used. Layout frozen. */
typedef struct cairn_match {
  uint64_t landmark; /**< landmark that the observation was compared with or that it placed; CAIRN_ID_NONE if there
                          is none */
  cairn_result result; /**< CAIRN_RESULT_MATCHED, CAIRN_RESULT_NEW or CAIRN_RESULT_REJECTED */
  cairn_reason reason; /**< one of the CAIRN_REASON_ constants */
  CAIRN_UNIT(1)
  double distance;   /**< squared Mahalanobis distance of the innovation (CAIRN_REASON_BATCH_GATE: that of the whole
                          batch when this observation was removed); 0 if there is none */
  CAIRN_UNIT(1)
  double threshold;  /**< chi-square bound that `distance` was compared with (infinity at a gate probability of 1); 0
                          if there is none */
} cairn_match;

#ifdef __cplusplus
}
#endif

#endif
