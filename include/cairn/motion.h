/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Motion models and their noise: wheels and twist. (Each call with an increment brings its own covariance.) */
#ifndef CAIRN_MOTION_H
#define CAIRN_MOTION_H

#include <cairn/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Sign of the yaw rate that follows from two wheel rates. */
typedef int32_t cairn_yaw;
enum CAIRN_VALUES(cairn_yaw) {
  CAIRN_YAW_RIGHT_MINUS_LEFT = 0, /**< z up: the vehicle turns left (positive yaw rate) when the right wheels turn
                                       faster; the default */
  CAIRN_YAW_LEFT_MINUS_RIGHT = 1  /**< z down: eq. 1 as printed in the Mars paper */
};

/** Four-wheel differential drive; both wheels of a side turn at the same rate (Mars paper, eq. 1):
 *  `v_x = r (w_left + w_right) / 2`, `w_z = +-(r / B) (w_right - w_left)`. The model has no motion along y and z and no
 *  roll and pitch rate. Noise is white; each call is one sample with the standard deviations below. */
typedef struct cairn_wheels {
  uint32_t struct_size;    /**< sizeof(cairn_wheels) of the caller */
  cairn_yaw yaw_sign;      /**< CAIRN_YAW_RIGHT_MINUS_LEFT or CAIRN_YAW_LEFT_MINUS_RIGHT; default
                                CAIRN_YAW_RIGHT_MINUS_LEFT */
  double radius;           /**< r, m, > 0; default 0.3 */
  double track;            /**< B, distance between left and right wheels, m, > 0; default 1.0 */
  double rate_sigma;       /**< noise of each side's wheel rate, rad/s, >= 0; default 0.01 */
  CAIRN_UNIT(1)
  double slip_sigma;       /**< noise of each side's wheel rate in proportion to this rate, >= 0; default 0.02 */
  double lateral_sigma;    /**< side slip: noise of the velocity along y, m/s, >= 0; default 0.01 */
  double vertical_sigma;   /**< noise of the velocity along z, m/s, >= 0; default 0.01 */
  double roll_rate_sigma;  /**< noise of the roll rate, which is not measured, rad/s, >= 0; default 0.05 */
  double pitch_rate_sigma; /**< noise of the pitch rate, which is not measured, rad/s, >= 0; default 0.05 */
} cairn_wheels;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_wheels_init(CAIRN_OUT cairn_wheels *wheels, size_t struct_size, cairn_error *error);

/** Noise of measured body velocity and body rate (IMU, visual odometry). It is white, with a standard deviation per
 *  sample and axis (x, y, z of the body). Mars paper, eq. 2, integrated on the group: `T <- T Exp([v; w] dt)`. */
typedef struct cairn_twist_noise {
  uint32_t struct_size;     /**< sizeof(cairn_twist_noise) of the caller */
  uint32_t reserved;        /**< 0 */
  double velocity_sigma[3]; /**< m/s, >= 0; default 0.05 each */
  double rate_sigma[3];     /**< rad/s, >= 0; default 0.005 each */
} cairn_twist_noise;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_twist_noise_init(CAIRN_OUT cairn_twist_noise *noise, size_t struct_size,
                                              cairn_error *error);

#ifdef __cplusplus
}
#endif

#endif
