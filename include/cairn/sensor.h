/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Sensors that see landmarks: their mounts, their noise, and what becomes of each observation. */
#ifndef CAIRN_SENSOR_H
#define CAIRN_SENSOR_H

#include <cairn/pose.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The id that no landmark has. */
#define CAIRN_ID_NONE UINT64_MAX

/** How the noise of a head's two encoders enters (\ref cairn_stereo_head). */
enum {
  CAIRN_ENCODER_PER_OBSERVATION = 0, /**< the head moved between observations: independent noise in each; the default */
  CAIRN_ENCODER_PER_FRAME = 1        /**< the head stood still: one error, common to all observations of a frame */
};

/** Stereo head on a pan and tilt mount (Mars paper, Figures 2 and 3, eq. 4), observing range, azimuth and stick angle.
 *
 *  A point `m_c` of the camera frame (x out of the lens, y left, z up) lies in the body frame at
 *  `m_b = d + Rz(pan) Ry(stick) (s + R(q) m_c)`: the platform sits at `d`, turns by `pan` about its z axis and
 *  by `stick` about the bolt, its y axis; the stick carries the camera at `s`, tilted by `q`.
 *  The observation is `z = (range, azimuth, elevation)` of `m_c`: `range = |m_c|` (m),
 *  `azimuth = atan2(y, x)` (rad, left positive), `elevation = atan2(z, sqrt(x^2 + y^2))` (rad, up positive): a
 *  stick that turns by -elevation (its positive turn lowers the lens) meets the point in the end. With the default mount the camera frame is the body frame. */
typedef struct cairn_stereo_head {
  uint32_t struct_size;       /**< sizeof(cairn_stereo_head) of the caller */
  int32_t encoder_mode;       /**< CAIRN_ENCODER_PER_OBSERVATION or CAIRN_ENCODER_PER_FRAME */
  double platform[3];         /**< d: pan axis in the body frame, m; default 0 */
  double stick[3];            /**< s: camera in the stick's frame, that after both turns, m; default 0 */
  double camera_quaternion[4];/**< q: camera axes in the stick's frame, w x y z; default identity */
  double range_sigma;         /**< m, > 0; default 1.0 (Table 1) */
  double azimuth_sigma;       /**< rad, > 0; default 3 degrees (Table 1) */
  double elevation_sigma;     /**< rad, > 0; default 3 degrees (Table 1) */
  double pan_sigma;           /**< encoder noise of pan, rad, >= 0; default 0 */
  double stick_sigma;         /**< encoder noise of the stick, rad, >= 0; default 0 */
  double near_range;          /**< a prediction, or an observation that would place a landmark, nearer than this is refused, m, > 0; default 0.1 */
  double max_elevation;       /**< one steeper than this has hardly an azimuth and is refused too, rad, in (0, pi/2); default 85 degrees */
} cairn_stereo_head;

/** Fills in the defaults, at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_stereo_head_init(cairn_stereo_head *head, size_t struct_size);

/** Rectified stereo camera: `z = (u_left, u_right, v)` in pixels of a point `(x, y, z)` of the left camera's frame
 *  (z out of the lens, x right, y down): `u_left = fu x/z + cu`, `u_right = fu (x - baseline)/z + cu`,
 *  `v = fv y/z + cv`. Where both images give a row, pass their mean and half its variance. */
typedef struct cairn_stereo_camera {
  uint32_t struct_size;  /**< sizeof(cairn_stereo_camera) of the caller */
  uint32_t reserved;     /**< 0 */
  double fu;             /**< focal length in u, pixels, > 0; default 500 */
  double fv;             /**< focal length in v, pixels, > 0; default 500 */
  double cu;             /**< principal point, pixels; default 320 */
  double cv;             /**< principal point, pixels; default 240 */
  double baseline;       /**< m, > 0; default 0.2 */
  cairn_pose T_body_camera; /**< left camera in the body; default: at the origin, looking along x */
  double sigma[3];       /**< noise of u_left, u_right, v, pixels, > 0; default 1 each */
  double near_depth;     /**< a prediction nearer than this has no image, m, > 0; default 0.1 */
  double min_disparity;  /**< a landmark is placed only from an observation of at least this u_left - u_right, pixels, > 0; default 1 */
  double min_disparity_sigmas; /**< and of at least so many of its standard deviations (by `sigma`), >= 0; default 2.5: a
                                    depth known to 40 %. Farther landmarks wait until they are seen from nearer */
} cairn_stereo_camera;

/** Fills in the defaults, at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_stereo_camera_init(cairn_stereo_camera *camera, size_t struct_size);

/** Radar, lidar or sonar of a planar vehicle: `z = (range, bearing)` of the landmark in the sensor's frame, m and rad, left
 *  positive. */
typedef struct cairn_range_bearing {
  uint32_t struct_size;     /**< sizeof(cairn_range_bearing) of the caller */
  uint32_t reserved;        /**< 0 */
  cairn_pose T_body_sensor; /**< sensor in the body, in the plane; default identity */
  double range_sigma;       /**< m, > 0; default 0.1 */
  double bearing_sigma;     /**< rad, > 0; default 0.01 */
  double near_range;        /**< a prediction, or an observation that would place a landmark, nearer than this is refused,
                                 m, > 0; default 0.01 */
} cairn_range_bearing;

/** Fills in the defaults, at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_range_bearing_init(cairn_range_bearing *radar, size_t struct_size);

/** Any sensor that gives a point: `z = (x, y, z)` of the landmark in the sensor's frame, m; of a planar vehicle
 *  (x, y). */
typedef struct cairn_cartesian {
  uint32_t struct_size;     /**< sizeof(cairn_cartesian) of the caller */
  uint32_t reserved;        /**< 0 */
  cairn_pose T_body_sensor; /**< sensor in the body; default identity */
  double sigma[3];          /**< noise of x, y, z, m, > 0; default 0.1 each */
} cairn_cartesian;

/** Fills in the defaults, at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_cartesian_init(cairn_cartesian *cartesian, size_t struct_size);

/** Observation that the caller's model predicts of a landmark.
 *
 *  \param user             the caller's pointer
 *  \param pose             body in the map, as in \ref cairn_pose
 *  \param landmark         point in the map, m
 *  \param z                out, `rows` values
 *  \param jacobian_pose    out, rows x 6, row-major: dz / [dp; dtheta] (the error of \ref cairn_pose)
 *  \param jacobian_landmark out, rows x 3, row-major: dz / dlandmark
 *  \return 0, or anything else where the landmark can't be seen from there: the observation is refused, as it is where
 *          a value written is not finite. For the same arguments it must answer the same */
typedef int32_t (*cairn_custom_predict)(void *user, const cairn_pose *pose, const double landmark[3], double *z,
                                        double *jacobian_pose, double *jacobian_landmark);

/** The inverse of \ref cairn_custom_predict tells where the landmark lies that gave `z`.
 *
 *  \param user             the caller's pointer
 *  \param pose             body in the map
 *  \param z                the observation, `rows` values
 *  \param landmark         out, point in the map, m
 *  \param jacobian_pose    out, 3 x 6, row-major: dlandmark / [dp; dtheta]
 *  \param jacobian_z       out, 3 x rows, row-major: dlandmark / dz
 *  \return 0, or anything else where `z` places no landmark: the observation is refused, as it is where a value
 *          written is not finite */
typedef int32_t (*cairn_custom_place)(void *user, const cairn_pose *pose, const double *z, double landmark[3],
                                      double *jacobian_pose, double *jacobian_z);

/** A sensor of the caller's own. The callbacks run inside \ref cairn_filter_update, must not call the same filter and
 *  must not let an exception or a longjmp pass. */
typedef struct cairn_custom {
  uint32_t struct_size;         /**< sizeof(cairn_custom) of the caller */
  uint32_t rows;                /**< values of an observation, 1 to 3, of a planar vehicle 1 or 2; default 3 */
  cairn_custom_predict predict; /**< required */
  cairn_custom_place place;     /**< NULL: this sensor places no landmarks, it only observes those that others placed;
                                     required to be NULL where rows < 3 (planar: 2), which leave a landmark's position open */
  void *user;                   /**< handed to both */
  uint32_t angle_mask;          /**< bit i set: value i is an angle (rad), its residual is wrapped to (-pi, pi] */
  uint32_t relative;            /**< 1: pose and landmark enter as the body point R^T (l - p) alone, which the filter
                                     then makes use of; default 0: any function of both */
  double sigma[3];              /**< noise of each value, > 0; default 1 each */
} cairn_custom;

/** Fills in the defaults, at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_custom_init(cairn_custom *custom, size_t struct_size);

/** Compares a custom sensor's Jacobians with central differences on the manifold, at one pose and landmark.
 *  `worst` gets the largest difference, each relative to max(1, |numerical value|); a correct Jacobian gives about 1e-6
 *  and less. Where `place` is set it is checked too, at the observation that `predict` gives, and so is that placing
 *  returns to the landmark. `relative` is not checked. Threads: any. Errors: CAIRN_ERROR_ARGUMENT (also where predict refuses the landmark).
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_custom_check(const cairn_custom *custom, const cairn_pose *pose, const double landmark[3],
                                          double *worst);

/** One observation of one landmark by one sensor. Layout frozen. */
typedef struct cairn_observation {
  uint64_t id;          /**< the landmark, by the caller's name for it; not CAIRN_ID_NONE; once in a frame. Any value where
                             the filter's `association` is not CAIRN_ASSOCIATION_KNOWN */
  double z[3];          /**< values in the sensor's units; a custom sensor of fewer rows uses the first */
  double covariance[9]; /**< 3x3 row-major noise of this observation (custom: rows x rows, packed); all zero: the sensor's default */
} cairn_observation;

/** What became of an observation. */
enum {
  CAIRN_MATCHED = 1,  /**< it updated the landmark */
  CAIRN_NEW = 2,      /**< it placed a new landmark */
  CAIRN_REJECTED = 3  /**< it changed nothing, `reason` tells why */
};

/** Why an observation was rejected. */
enum {
  CAIRN_REASON_NONE = 0,       /**< it was not */
  CAIRN_REASON_GATE = 1,       /**< its distance exceeds the threshold: chi-square gate of one observation */
  CAIRN_REASON_BATCH_GATE = 2, /**< it passed alone, and was among those that kept the whole batch from passing */
  CAIRN_REASON_NO_IMAGE = 3,   /**< the landmark as estimated can't give an observation: behind the lens, too near, too steep */
  CAIRN_REASON_NO_PLACE = 4,   /**< the observation places no landmark: disparity or range too small, or the sensor can't */
  CAIRN_REASON_AMBIGUOUS = 5   /**< without known ids: it passed alone, and no set of pairs with it is as good as that without */
};

/** Decision on one observation. Layout frozen. */
typedef struct cairn_match {
  uint64_t landmark; /**< landmark that it was compared with or that it placed; CAIRN_ID_NONE where there is none */
  int32_t result;    /**< CAIRN_MATCHED, CAIRN_NEW or CAIRN_REJECTED */
  int32_t reason;    /**< one of the CAIRN_REASON_ constants */
  double distance;   /**< squared Mahalanobis distance of the innovation (CAIRN_REASON_BATCH_GATE: of the whole batch
                          when this observation was taken out); 0 where there is none */
  double threshold;  /**< chi-square bound that it was held against (infinity at a gate probability of 1); 0 where there is none */
} cairn_match;

#ifdef __cplusplus
}
#endif

#endif
