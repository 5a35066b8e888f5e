/* SPDX-License-Identifier: BSD-3-Clause */
/* A planar vehicle, the points around it, and its radar: shared by the tests of planar filters. */
#ifndef CAIRN_TESTS_CAPI_PLANE_H
#define CAIRN_TESTS_CAPI_PLANE_H

#include "support.h"

#define POINTS 10
extern const double plane_points[POINTS][3]; /* landmarks, all with z = 0 */

/* Options of a filter of `vehicle` (CAIRN_VEHICLE_) with room for the points. The gates are open: their bounds depend
 * on the number of rows, and a spatial sensor has more rows than a planar one. */
cairn_filter_options plane_options(int32_t vehicle, int32_t error);
cairn_filter* plane_filter(const cairn_filter_options* options);
cairn_range_bearing plane_radar(void);

/* An observation of two values. */
cairn_observation sighting(uint64_t id, double first, double second);
void plane_polar(const cairn_pose* sensor, const double point[3], double* range, double* bearing);

/* Compares pose, landmarks and joint covariance. What `plane` does not have must be exactly 0. */
void plane_compare(const cairn_filter* plane, const cairn_filter* space, double tolerance);

#endif
