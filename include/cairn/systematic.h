/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Systematic errors that a filter estimates as states: biases and scales of the motion (docs/systematic_errors.md).
 *  They are switched on by \ref cairn_filter_options; a filter has none by default. */
#ifndef CAIRN_SYSTEMATIC_H
#define CAIRN_SYSTEMATIC_H

#include <cairn/filter.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Kinds of systematic errors. */
enum {
  CAIRN_SYSTEMATIC_VELOCITY_BIAS = 0, /**< of the measured body velocity, m/s; components x, y, z */
  CAIRN_SYSTEMATIC_RATE_BIAS = 1,     /**< of the measured body rate, rad/s; components x, y, z */
  CAIRN_SYSTEMATIC_WHEEL_SCALE = 2    /**< of a wheel's measured rate; components left and right */
};

/** The estimate of one component of a systematic error. */
typedef struct cairn_systematic_error {
  int32_t kind;      /**< CAIRN_SYSTEMATIC_VELOCITY_BIAS and so on */
  int32_t sensor;    /**< the sensor whose error it is; -1: of the motion */
  int32_t component; /**< counted from 0 */
  int32_t reserved;  /**< 0 */
  double value;      /**< in the units of its kind */
  double sigma;      /**< its standard deviation now, in the same units */
} cairn_systematic_error;

/** The estimates of all components that are states, in the order of their kinds and components. `*needed` is their
 *  number. `errors` has room for `capacity` of them, and `covariance` (NULL: not wanted) for the square of that number:
 *  the joint covariance of the `*needed` components, row-major. Capacity 0 asks for the number.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER.
 *  Complexity: O(1). \since 0.2.0 */
CAIRN_API cairn_status cairn_filter_systematic_errors(const cairn_filter *filter, cairn_systematic_error *errors,
                                                      double *covariance, size_t capacity, size_t *needed);

#ifdef __cplusplus
}
#endif

#endif
