/* SPDX-License-Identifier: BSD-3-Clause */
/* The functions of the library that take callbacks, as Go calls them: `user` is the number of a handle of runtime/cgo,
 * for C must not keep a pointer of Go. */
#ifndef CAIRN_GO_BRIDGE_H
#define CAIRN_GO_BRIDGE_H

#include <cairn/cairn.h>

cairn_status go_cairn_custom_check(const cairn_custom *custom, uintptr_t user, int has_place, const cairn_pose *pose,
                                   const double *landmark, double *worst, cairn_error *error);
cairn_status go_cairn_filter_add_custom(cairn_filter *filter, const cairn_custom *custom, uintptr_t user, int has_place,
                                        int32_t *sensor, cairn_error *error);
cairn_status go_cairn_filter_set_log(cairn_filter *filter, uintptr_t payload, cairn_error *error);

#endif
