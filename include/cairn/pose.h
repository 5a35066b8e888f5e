/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Poses, their errors, and conversions from and to Euler angles. docs/notation.md defines the conventions. */
#ifndef CAIRN_POSE_H
#define CAIRN_POSE_H

#include <cairn/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Pose of a frame b in a frame a: `p_a = R(quaternion) p_b + position`. SI units, Hamilton quaternion, w first.
 *
 *  The error of a pose is `[dp; dtheta]` (m, rad), both in the axes of the parent frame a:
 *  `position_true = position + dp`, `R_true = Exp(dtheta) R`. Every 6x6 covariance of a pose in this interface is the
 *  covariance of this error, row-major. Layout frozen. */
typedef struct cairn_pose {
  double position[3];   /**< origin of b in a, m */
  CAIRN_UNIT(1)
  double quaternion[4]; /**< rotation from b to a: w x y z, unit length */
} cairn_pose;

/** Sets a pose to the identity. Threads: any. Errors: CAIRN_ERROR_ARGUMENT (NULL). \since 0.1.0 */
CAIRN_API cairn_status cairn_pose_identity(CAIRN_OUT cairn_pose *pose, cairn_error *error);

/** Composes two poses: `T_a_c = T_a_b * T_b_c`. Quaternions are normalised; a quaternion that is zero or not finite is
 *  refused. `result` may be one of the inputs. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_pose_compose(CAIRN_IN const cairn_pose *T_a_b, CAIRN_IN const cairn_pose *T_b_c,
                                          CAIRN_OUT cairn_pose *result, cairn_error *error);

/** Inverts a pose: `T_b_a` from `T_a_b`. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_pose_inverse(CAIRN_IN const cairn_pose *T_a_b, CAIRN_OUT cairn_pose *result,
                                          cairn_error *error);

/** Transforms a point from frame b to frame a (m). Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_pose_apply(CAIRN_IN const cairn_pose *T_a_b, CAIRN_UNIT(m) const double point_b[3],
                                        CAIRN_OUT CAIRN_UNIT(m) double point_a[3], cairn_error *error);

/** Quaternion of roll, pitch and yaw (rad): `R = Rz(yaw) Ry(pitch) Rx(roll)`.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT (NULL, not finite). \since 0.1.0 */
CAIRN_API cairn_status cairn_quaternion_from_euler(CAIRN_UNIT(rad) double roll, CAIRN_UNIT(rad) double pitch,
                                                   CAIRN_UNIT(rad) double yaw,
                                                   CAIRN_OUT CAIRN_UNIT(1) double quaternion[4], cairn_error *error);

/** Roll, pitch and yaw (rad) of a quaternion; pitch lies in [-pi/2, pi/2]. At pitch = +-pi/2 roll and yaw turn about
 *  the same axis; there roll is set to 0. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_quaternion_to_euler(CAIRN_UNIT(1) const double quaternion[4],
                                                 CAIRN_OUT CAIRN_UNIT(rad) double *roll,
                                                 CAIRN_OUT CAIRN_UNIT(rad) double *pitch,
                                                 CAIRN_OUT CAIRN_UNIT(rad) double *yaw, cairn_error *error);

/** Quaternion of a rotation vector (axis times angle, rad). Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_quaternion_exp(CAIRN_UNIT(rad) const double rotation_vector[3],
                                            CAIRN_OUT CAIRN_UNIT(1) double quaternion[4], cairn_error *error);

/** Rotation vector of a quaternion (rad). Its length is at most pi. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_quaternion_log(CAIRN_UNIT(1) const double quaternion[4],
                                            CAIRN_OUT CAIRN_UNIT(rad) double rotation_vector[3], cairn_error *error);

/** Error of an estimate against the truth: `difference` gets `[dp; dtheta]` as \ref cairn_pose defines it.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_pose_error(CAIRN_IN const cairn_pose *truth, CAIRN_IN const cairn_pose *estimate,
                                        CAIRN_OUT CAIRN_UNIT(pose) double difference[6], cairn_error *error);

#ifdef __cplusplus
}
#endif

#endif
