/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Maps: landmarks and their joint uncertainty; queries and merging. */
#ifndef CAIRN_MAP_H
#define CAIRN_MAP_H

#include <cairn/pose.h>
#include <cairn/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Landmarks in one frame with their joint uncertainty. A filter owns a map (\ref cairn_filter_map), which follows
 *  the filter. The caller owns a copy (\ref cairn_map_copy). A copy does not follow the filter, and other maps can be
 *  merged into it (\ref cairn_map_merge). */
typedef struct cairn_map cairn_map;

/** A landmark. Layout frozen. */
typedef struct cairn_landmark {
  uint64_t id;           /**< the caller's id, or the assigned one; it never changes */
  uint64_t observations; /**< observations that placed or updated it */
  double position[3];    /**< in the map frame, m */
  double covariance[9];  /**< covariance of the position, 3x3 row-major, m^2 */
} cairn_landmark;

/** How a map holds the joint uncertainty of its landmarks. Only maps of the same kind can be merged. */
typedef int32_t cairn_map_form;
enum CAIRN_VALUES(cairn_map_form) {
  CAIRN_MAP_DENSE = 0, /**< positions and their joint covariance: a single map, or densely joined submaps */
  CAIRN_MAP_SPARSE = 1 /**< submaps and the factor of their information: sparsely joined submaps */
};

/** How \ref cairn_map_merge finds the landmarks that both maps hold, the common landmarks. */
typedef int32_t cairn_merge_by;
enum CAIRN_VALUES(cairn_merge_by) {
  CAIRN_MERGE_BY_ID = 0,      /**< landmarks with the same id */
  CAIRN_MERGE_BY_GEOMETRY = 1 /**< landmarks that lie in the same way relative to each other; ids are ignored */
};

/** Options of \ref cairn_map_merge. Set them by \ref cairn_merge_options_init first. */
typedef struct cairn_merge_options {
  uint32_t struct_size;          /**< sizeof(cairn_merge_options) of the caller */
  cairn_merge_by association;    /**< CAIRN_MERGE_BY_ID or CAIRN_MERGE_BY_GEOMETRY; default CAIRN_MERGE_BY_ID */
  CAIRN_UNIT(1)
  double gate_probability;       /**< probability that all common landmarks of a correct merge pass their own gates,
                                      in (0, 1]; default 0.9999 */
  CAIRN_UNIT(1)
  double joint_gate_probability; /**< probability that they pass the joint gate, in (0, 1]; default 0.9999 */
  uint64_t max_landmarks;        /**< capacity of the merged map; 0, the default: no limit */
  double max_tilt;               /**< by geometry, without has_transform: largest angle between the z axes of both
                                      frames, rad, 0 to pi; default pi */
  cairn_bool has_transform;      /**< 1: T_map_other is known beforehand, independently of both maps; default 0 */
  uint32_t reserved;             /**< 0 */
  cairn_pose T_map_other;        /**< with has_transform: from the other's frame into the map's frame; default
                                      identity */
  CAIRN_UNIT(pose^2)
  double covariance[36];         /**< covariance of its error [dp; dtheta], 6x6 row-major, positive semidefinite;
                                      default 0: known exactly */
} cairn_merge_options;

/** Report of \ref cairn_map_merge, also of a refused merge. Fields that the merge did not reach are 0. */
typedef struct cairn_merge_report {
  uint32_t struct_size;       /**< sizeof(cairn_merge_report) of the caller; set it before the call */
  cairn_merge_by association; /**< the one of the options */
  uint64_t common;            /**< landmarks that both maps hold */
  uint64_t added;             /**< landmarks that only the other holds */
  uint64_t rows;              /**< degrees of freedom of `distance`: three for each common landmark; without
                                   has_transform six less */
  CAIRN_UNIT(1)
  double distance;            /**< joint squared Mahalanobis distance of the common landmarks */
  CAIRN_UNIT(1)
  double threshold;           /**< its chi-square bound */
  cairn_pose T_map_other;     /**< transforms points from the other's frame into the map's frame */
  CAIRN_UNIT(pose^2)
  double covariance[36];      /**< covariance of its error [dp; dtheta], 6x6 row-major */
  uint64_t broken_id;         /**< id in the map of a common landmark that failed a test; CAIRN_ID_NONE: none */
  uint64_t broken_other_id;   /**< id of the same landmark in the other map; CAIRN_ID_NONE: none */
} cairn_merge_report;

/** Where a landmark of the other map is after a merge. Layout frozen. */
typedef struct cairn_merged_id {
  uint64_t other_id; /**< its id in the other map */
  uint64_t id;       /**< its id in the merged map */
  cairn_bool common; /**< 1: the map held this landmark before; 0: it was added */
  uint32_t reserved; /**< 0 */
} cairn_merged_id;

/* All queries that fill an array share one rule. The order is the one that each query names. `*needed` gets the number
 * of elements. If the buffer is too short, the query returns CAIRN_ERROR_BUFFER and writes nothing to the buffer.
 * Capacity 0 asks only for the number, with any pointer, and succeeds. */

/** Number of landmarks. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT (NULL).
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_size(const cairn_map *map, CAIRN_OUT size_t *count, cairn_error *error);

/** A landmark by its id. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_landmark(const cairn_map *map, uint64_t id, CAIRN_OUT cairn_landmark *landmark,
                                          cairn_error *error);

/** All landmarks, by ascending id. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n log n). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_landmarks(const cairn_map *map, CAIRN_OUT_ARRAY(capacity) cairn_landmark *landmarks,
                                           size_t capacity, size_t *needed, cairn_error *error);

/** Landmarks whose estimate lies within `radius` (m, >= 0) of `centre` (map frame, m): nearest first, ties by id.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER.
 *  Complexity: O(n + k log k) for k found.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_map_within(const cairn_map *map, CAIRN_UNIT(m) const double centre[3],
                                        CAIRN_UNIT(m) CAIRN_RANGE(>= 0) double radius,
                                        CAIRN_OUT_ARRAY(capacity) cairn_landmark *landmarks, size_t capacity,
                                        size_t *needed, cairn_error *error);

/** The `count` landmarks nearest to `point` (map frame, m): nearest first, ties by id. Fewer if the map holds fewer.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER.
 *  Complexity: O(n + k log k). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_nearest(const cairn_map *map, CAIRN_UNIT(m) const double point[3], size_t count,
                                         CAIRN_OUT_ARRAY(capacity) cairn_landmark *landmarks, size_t capacity,
                                         size_t *needed, cairn_error *error);

/** Landmarks whose estimate lies in the closed box between `lower` and `upper` (map frame, m), by ascending id.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT (also lower > upper), CAIRN_ERROR_BUFFER.
 *  Complexity: O(n + k log k). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_in_box(const cairn_map *map, CAIRN_UNIT(m) const double lower[3],
                                        CAIRN_UNIT(m) const double upper[3],
                                        CAIRN_OUT_ARRAY(capacity) cairn_landmark *landmarks, size_t capacity,
                                        size_t *needed, cairn_error *error);

/** Joint covariance of the positions of chosen landmarks: `matrix` is 3 count x 3 count, row-major, blocks in the order
 *  of `ids`. `capacity` and `*needed` count doubles. No id may appear twice.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND, CAIRN_ERROR_BUFFER.
 *  Complexity: O(count^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_joint_covariance(const cairn_map *map, CAIRN_IN_ARRAY(count) const uint64_t *ids,
                                                  size_t count,
                                                  CAIRN_OUT_ARRAY(capacity) CAIRN_UNIT(m^2) double *matrix,
                                                  size_t capacity, size_t *needed, cairn_error *error);

/** Kind of a map: CAIRN_MAP_DENSE or CAIRN_MAP_SPARSE. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT (NULL). Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_kind(const cairn_map *map, CAIRN_OUT cairn_map_form *kind, cairn_error *error);

/** Makes a copy of the same kind. The copy stays as it is when the filter goes on or is destroyed. All queries work
 *  on it. The caller owns the copy and frees it with \ref cairn_map_destroy. A copy of a filter's open submap
 *  (\ref cairn_filter_local_map) is in the frame of this submap.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT (NULL), CAIRN_ERROR_MEMORY. Complexity:
 *  dense O(n^2); sparse O(n): the factor's parts are shared. \since 0.1.0 */
CAIRN_API cairn_status cairn_map_copy(const cairn_map *map, cairn_map **copy, cairn_error *error);

/** Frees a copy. NULL is allowed. A map that a filter owns is not freed: it is destroyed with its filter.
 *  Threads: one a handle. Complexity: O(n). \since 0.1.0 */
CAIRN_API void cairn_map_destroy(cairn_map *map);

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_merge_options_init(CAIRN_OUT cairn_merge_options *options, size_t struct_size,
                                                cairn_error *error);

/** Merges the landmarks of `other` into `map`. `map` stays in its own frame. The merge finds the transform between
 *  both frames from the common landmarks (with has_transform also from the transform that the caller knows).
 *  Afterwards `map` holds the best estimate that follows from both maps (docs/map_merging.md). A call that fails
 *  changes neither map.
 *
 *  Ids of `map` never change. A common landmark keeps the id that it has in `map`. An added landmark keeps its id. By
 *  geometry, an added landmark whose id is already used in `map` gets the smallest free id above all ids of both
 *  maps; if there is none, the smallest free id. \ref cairn_map_merged_ids returns all new ids.
 *
 *  The maps must come from independent data. Two copies of one filter's map, or a merged map and one of its parts,
 *  are refused, because the data that they share would count twice. Information of a sparse `other` about its own
 *  frame (start pose, absolute observations) is not merged. With has_transform its start pose is merged.
 *
 *  `map` must be a copy. `other` may be a copy or a filter's map. `options` may be NULL for the defaults. `report`
 *  may be NULL; set its struct_size first. It is also filled in if the merge is refused because of the contents of
 *  the maps.
 *
 *  Threads: `map` one a handle; `other` as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT (also map ==
 *  other), CAIRN_ERROR_STATE (`map` belongs to a filter: copy it; the kinds differ; both hold landmarks of the same
 *  filter; a sparse `other` was itself merged with has_transform: merge the other way round), CAIRN_ERROR_NOT_FOUND (a
 *  map is empty, or there are too few common landmarks: with has_transform one is necessary, without it three),
 *  CAIRN_ERROR_NUMERICAL (the common landmarks lie on a line; they contradict each other, and message and report name
 *  the worst pair; by geometry: more than one transform fits), CAIRN_ERROR_CAPACITY (max_landmarks),
 *  CAIRN_ERROR_MEMORY. Complexity, for n landmarks in both maps and k common ones: dense O(n^2 k + k^3); sparse: that
 *  of closing all submaps of `other` at once, plus the joint test of at most 300 common landmarks. By geometry
 *  additionally O(n log n) and the search among triangles, which has a budget. \since 0.1.0 */
CAIRN_API cairn_status cairn_map_merge(cairn_map *map, const cairn_map *other,
                                       CAIRN_OPTIONAL const cairn_merge_options *options,
                                       CAIRN_OUT CAIRN_OPTIONAL cairn_merge_report *report, cairn_error *error);

/** Where the landmarks of the other map are after the last merge into this map, by ascending other_id; none before a
 *  merge. A copy returns the same. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT,
 *  CAIRN_ERROR_BUFFER. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_merged_ids(const cairn_map *map, CAIRN_OUT_ARRAY(capacity) cairn_merged_id *merged,
                                            size_t capacity, size_t *needed, cairn_error *error);

#ifdef __cplusplus
}
#endif

#endif
