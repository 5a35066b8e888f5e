/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  The trajectory of a vehicle as it is known now (docs/trajectory.md).
 *
 *  A filter that was created with `trajectory_poses` > 0 keeps the pose of each successful update: after
 *  \ref cairn_filter_update the pose of the frame, and after \ref cairn_filter_update_linear,
 *  \ref cairn_filter_update_position, \ref cairn_filter_update_attitude and \ref cairn_filter_update_heading the pose
 *  after the update. Poses are numbered from 0. If there are more than `trajectory_poses`, the oldest ones are dropped;
 *  updates never fail because of them.
 *
 *  A pose is kept relative to its submap, so it moves with the submap when the map is corrected. With a single map, and
 *  in the open submap, poses stay as they were at their update. Filters of teams keep no poses. */
#ifndef CAIRN_TRAJECTORY_H
#define CAIRN_TRAJECTORY_H

#include <cairn/filter.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Keeps the pose of the body now, as an update does: for a step in which nothing was observed. `number` (or NULL) gets
 *  the number of the pose.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (`trajectory_poses` is 0). Complexity: O(1);
 *  allocates nothing. \since 0.2.0 */
CAIRN_API cairn_status cairn_filter_keep_pose(cairn_filter *filter, CAIRN_OUT CAIRN_OPTIONAL uint64_t *number,
                                              cairn_error *error);

/** The numbers of the poses that are kept: from `*first` up to but not including `*end`. `*end` is the number of poses
 *  so far. Each may be NULL.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (`trajectory_poses` is
 *  0). Complexity: O(1). \since 0.2.0 */
CAIRN_API cairn_status cairn_filter_trajectory_range(const cairn_filter *filter,
                                                     CAIRN_OUT CAIRN_OPTIONAL uint64_t *first,
                                                     CAIRN_OUT CAIRN_OPTIONAL uint64_t *end, cairn_error *error);

/** The poses of the body in the map, as they are known now, from the number `first` to the newest one. `capacity` and
 *  `*needed` count poses; capacity 0 asks for the number of poses. Close the open submap first to have its
 *  last corrections.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (`trajectory_poses` is
 *  0), CAIRN_ERROR_CAPACITY (the trajectory has become longer than `trajectory_poses`, and the pose `first` was
 *  dropped), CAIRN_ERROR_NOT_FOUND (`first` is greater than the number of poses so far), CAIRN_ERROR_BUFFER.
 *  Complexity: O(poses); allocates nothing. \since 0.2.0 */
CAIRN_API cairn_status cairn_filter_trajectory(const cairn_filter *filter, uint64_t first,
                                               CAIRN_OUT_ARRAY(capacity) cairn_pose *poses, size_t capacity,
                                               size_t *needed, cairn_error *error);

#ifdef __cplusplus
}
#endif

#endif
