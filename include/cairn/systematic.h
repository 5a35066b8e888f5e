/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Systematic errors that a filter estimates as states (docs/systematic_errors.md): biases and scales of the motion,
 *  which \ref cairn_filter_options switches on, mounts and offsets of sensors, which \ref
 *  cairn_filter_calibrate_sensor switches on. A filter has none by default. */
#ifndef CAIRN_SYSTEMATIC_H
#define CAIRN_SYSTEMATIC_H

#include <cairn/filter.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Kinds of systematic errors. */
typedef int32_t cairn_systematic;
enum CAIRN_VALUES(cairn_systematic) {
  CAIRN_SYSTEMATIC_VELOCITY_BIAS = 0, /**< of the measured body velocity, m/s; components x, y, z */
  CAIRN_SYSTEMATIC_RATE_BIAS = 1,     /**< of the measured body rate, rad/s; components x, y, z */
  CAIRN_SYSTEMATIC_WHEEL_SCALE = 2,   /**< of a wheel's measured rate; components left and right */
  CAIRN_SYSTEMATIC_MOUNT_SHIFT = 3,   /**< of a sensor against the body, m; components x, y, z */
  CAIRN_SYSTEMATIC_MOUNT_TURN = 4,    /**< of a sensor about the origin of the body: a rotation vector, rad */
  CAIRN_SYSTEMATIC_OFFSET = 5         /**< of the values of a sensor's observations, in their units */
};

/** Systematic errors of one sensor. A standard deviation at the start that is 0 (the default) means: no state. A random
 *  walk is that in the square root of a second; it needs its standard deviation. The sensor works as if the body were
 * at T_map_body E, E = (Exp(turn), shift); an observed value is the predicted one plus its offset. */
typedef struct cairn_calibration {
  uint32_t struct_size;        /**< sizeof(cairn_calibration) of the caller */
  uint32_t reserved;           /**< 0 */
  double mount_shift_sigma[3]; /**< x, y, z, m, >= 0; default 0. A planar vehicle has only x and y */
  CAIRN_UNIT(m/s^0.5)
  double mount_shift_walk[3];  /**< >= 0; default 0 */
  double mount_turn_sigma[3];  /**< rotation vector, rad, >= 0; default 0. A planar vehicle has only z */
  CAIRN_UNIT(rad/s^0.5)
  double mount_turn_walk[3];   /**< >= 0; default 0 */
  CAIRN_UNIT(sensor)
  double offset_sigma[3];      /**< of each value of an observation, in its unit, >= 0; default 0 */
  CAIRN_UNIT(sensor/s^0.5)
  double offset_walk[3];       /**< >= 0; default 0 */
} cairn_calibration;

/** Fills in the defaults: no errors. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.2.0 */
CAIRN_API cairn_status cairn_calibration_init(CAIRN_OUT cairn_calibration *calibration, size_t struct_size,
                                              cairn_error *error);

/** Makes systematic errors of a sensor states of the filter. Call it after the sensor was added, before the first
 * motion and the first observation, at most once for a sensor. All sensors together have at most max_sensor_errors of
 *  \ref cairn_filter_options. Association (with unknown ids) uses the estimates, but leaves their uncertainty out of
 * its gates. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND (sensor), CAIRN_ERROR_CAPACITY,
 *  CAIRN_ERROR_STATE (too late, or calibrated already), CAIRN_ERROR_MEMORY. \since 0.2.0 */
CAIRN_API cairn_status cairn_filter_calibrate_sensor(cairn_filter *filter, int32_t sensor,
                                                     const cairn_calibration *calibration, cairn_error *error);

/** The estimate of one component of a systematic error. Layout frozen. */
typedef struct cairn_systematic_error {
  cairn_systematic kind; /**< CAIRN_SYSTEMATIC_VELOCITY_BIAS and so on */
  int32_t sensor;    /**< the sensor whose error it is; -1: of the motion */
  int32_t component; /**< counted from 0 */
  int32_t reserved;  /**< 0 */
  CAIRN_UNIT(kind)
  double value;      /**< in the units of its kind */
  CAIRN_UNIT(kind)
  double sigma;      /**< its standard deviation now, in the same units */
} cairn_systematic_error;

/** The estimates of all components that are states, those of the motion first, then sensor by
 *  sensor in the order of their calibration, each in the order of kinds and components. `*needed` is their
 *  number. `errors` has room for `capacity` of them, and `covariance` (NULL: not wanted) for the square of that number:
 *  the joint covariance of the `*needed` components, row-major. Capacity 0 asks for the number.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER.
 *  Complexity: O(1). \since 0.2.0 */
CAIRN_API cairn_status cairn_filter_systematic_errors(const cairn_filter *filter,
    CAIRN_OUT_ARRAY(capacity) cairn_systematic_error *errors,
    CAIRN_OUT_ARRAY(capacity * capacity) CAIRN_OPTIONAL CAIRN_UNIT(kind^2) double *covariance, size_t capacity,
    size_t *needed, cairn_error *error);

#ifdef __cplusplus
}
#endif

#endif
