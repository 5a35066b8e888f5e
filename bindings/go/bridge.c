/* SPDX-License-Identifier: BSD-3-Clause */
#include "bridge.h"

#include "_cgo_export.h"

/* Go's functions know no const. */
static int32_t predict(void *user, const cairn_pose *pose, const double landmark[3], double *z, double *jacobian_pose,
                       double *jacobian_landmark) {
  return cairnGoPredict((uintptr_t)user, (cairn_pose *)pose, (double *)landmark, z, jacobian_pose, jacobian_landmark);
}

static int32_t place(void *user, const cairn_pose *pose, const double *z, double landmark[3], double *jacobian_pose,
                     double *jacobian_z) {
  return cairnGoPlace((uintptr_t)user, (cairn_pose *)pose, (double *)z, landmark, jacobian_pose, jacobian_z);
}

static void log_line(void *payload, const char *line) { cairnGoLog((uintptr_t)payload, (char *)line); }

static void release(void *user) { cairnGoRelease((uintptr_t)user); }

cairn_status go_cairn_custom_check(const cairn_custom *custom, uintptr_t user, int has_place, const cairn_pose *pose,
                                   const double *landmark, double *worst, cairn_error *error) {
  return cairn_custom_check(custom, predict, has_place ? place : NULL, (void *)user, pose, landmark, worst, error);
}

cairn_status go_cairn_filter_add_custom(cairn_filter *filter, const cairn_custom *custom, uintptr_t user, int has_place,
                                        int32_t *sensor, cairn_error *error) {
  return cairn_filter_add_custom(filter, custom, predict, has_place ? place : NULL, (void *)user, release, sensor,
                                 error);
}

cairn_status go_cairn_filter_set_log(cairn_filter *filter, uintptr_t payload, cairn_error *error) {
  return payload ? cairn_filter_set_log(filter, log_line, (void *)payload, release, error)
                 : cairn_filter_set_log(filter, NULL, NULL, NULL, error);
}
