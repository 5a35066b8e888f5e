/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Landmarks and how far to trust them. */
#ifndef CAIRN_MAP_H
#define CAIRN_MAP_H

#include <cairn/pose.h>
#include <cairn/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Landmarks in one frame with their joint uncertainty. A filter owns one (\ref cairn_filter_map), which follows it; a
 *  copy (\ref cairn_map_copy) is the caller's, stays as it is, and takes in other maps (\ref cairn_map_merge). */
typedef struct cairn_map cairn_map;

/** A landmark. Layout frozen. */
typedef struct cairn_landmark {
  uint64_t id;           /**< the caller's name for it; stable for the landmark's life */
  uint64_t observations; /**< observations that placed or updated it */
  double position[3];    /**< in the map frame, m */
  double covariance[9];  /**< of position, 3x3 row-major, m^2 */
} cairn_landmark;

/** How a map holds its landmarks' joint uncertainty. Maps of one kind merge. */
enum {
  CAIRN_MAP_DENSE = 0, /**< positions and their joint covariance: of a single map, of densely joined submaps */
  CAIRN_MAP_SPARSE = 1 /**< submaps and the factor of their information: of sparsely joined submaps */
};

/** How \ref cairn_map_merge finds the landmarks that both maps hold. */
enum {
  CAIRN_MERGE_BY_ID = 0,      /**< those of one id */
  CAIRN_MERGE_BY_GEOMETRY = 1 /**< by how they lie to each other; the two maps' ids have nothing in common */
};

/** Options of \ref cairn_map_merge; \ref cairn_merge_options_init sets the defaults named here. */
typedef struct cairn_merge_options {
  uint32_t struct_size; /**< sizeof(cairn_merge_options) of the caller */
  int32_t association;           /**< CAIRN_MERGE_BY_*; BY_ID */
  double gate_probability;       /**< that all common landmarks of a right merge pass their own gates; 0.9999 */
  double joint_gate_probability; /**< that they agree jointly; 0.9999 */
  size_t max_landmarks;          /**< that the merged map may hold; 0, the default: any number */
  int32_t has_transform;         /**< whether T_map_other is known beforehand, independently of both maps; 0 */
  int32_t reserved;              /**< 0 */
  cairn_pose T_map_other;        /**< with has_transform: from the other's frame into the map's; identity */
  double covariance[36]; /**< of its error [dp; dtheta], 6x6 row-major, semidefinite (0: known exactly); 0 */
  double max_tilt; /**< by geometry, without has_transform: angle between both frames' z axes, rad, 0 to pi; pi */
} cairn_merge_options;

/** What \ref cairn_map_merge found, also where it refused: what it did not get to is 0. */
typedef struct cairn_merge_report {
  uint32_t struct_size; /**< sizeof(cairn_merge_report) of the caller; set it before the call */
  int32_t association;    /**< as asked for */
  size_t common;          /**< landmarks that both maps hold */
  size_t added;           /**< landmarks that only the other holds */
  cairn_pose T_map_other; /**< takes points from the other's frame into the map's */
  double covariance[36];  /**< of its error [dp; dtheta], 6x6 row-major */
  double distance;        /**< squared Mahalanobis distance of the common landmarks, jointly */
  double threshold;       /**< its chi-square bound */
  size_t rows;            /**< its degrees of freedom: three a common landmark; less six without has_transform */
  uint64_t broken_id;     /**< common landmark that broke a test, by its id in the map; CAIRN_ID_NONE: none */
  uint64_t broken_other_id; /**< the same by its id in the other; CAIRN_ID_NONE: none */
} cairn_merge_report;

/** What a merge made of a landmark of the other map. Layout frozen. */
typedef struct cairn_merged_id {
  uint64_t other_id; /**< its id in the other map */
  uint64_t id;       /**< its id in the merged map */
  int32_t common;    /**< whether it is a landmark that the map held before */
  int32_t reserved;  /**< 0 */
} cairn_merged_id;

/* Queries that fill an array share one rule: landmarks come ordered as each query says, `*needed` gets their number,
 * and a buffer that is too short is CAIRN_ERROR_BUFFER with nothing written to it. NULL with capacity 0 asks for the
 * number alone and succeeds. */

/** Number of landmarks. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT (NULL).
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_size(const cairn_map *map, size_t *count);

/** One landmark by its id. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_landmark(const cairn_map *map, uint64_t id, cairn_landmark *landmark);

/** All landmarks, by ascending id. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n log n). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_landmarks(const cairn_map *map, cairn_landmark *landmarks, size_t capacity,
                                           size_t *needed);

/** Landmarks whose estimate lies within `radius` (m, >= 0) of `centre` (map frame, m), nearest first, ties by id.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(n + k log k) for k found.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_map_within(const cairn_map *map, const double centre[3], double radius,
                                        cairn_landmark *landmarks, size_t capacity, size_t *needed);

/** The `count` landmarks nearest to `point` (map frame, m), fewer where the map holds fewer, nearest first, ties by id.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER.
 *  Complexity: O(n + k log k). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_nearest(const cairn_map *map, const double point[3], size_t count,
                                         cairn_landmark *landmarks, size_t capacity, size_t *needed);

/** Landmarks whose estimate lies in the closed box between `lower` and `upper` (map frame, m), by ascending id.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT (also lower > upper), CAIRN_ERROR_BUFFER.
 *  Complexity: O(n + k log k). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_in_box(const cairn_map *map, const double lower[3], const double upper[3],
                                        cairn_landmark *landmarks, size_t capacity, size_t *needed);

/** Joint covariance of the positions of chosen landmarks: `matrix` is 3 count x 3 count, row-major, blocks in the order
 *  of `ids`. `capacity` and `*needed` count doubles. An id may not come twice.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND, CAIRN_ERROR_BUFFER.
 *  Complexity: O(count^2). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_joint_covariance(const cairn_map *map, const uint64_t *ids, size_t count, double *matrix,
                                                  size_t capacity, size_t *needed);

/** Whether a map is dense or sparse: CAIRN_MAP_DENSE or CAIRN_MAP_SPARSE. Threads: as any const query of the handle.
 *  Errors: CAIRN_ERROR_ARGUMENT (NULL). Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_kind(const cairn_map *map, int32_t *kind);

/** Makes a copy that stays when the filter goes on or is destroyed, of the same kind; all queries work on it. The
 *  caller owns it. A copy of a filter's open submap (\ref cairn_filter_local_map) stands in the submap's frame.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT (NULL), CAIRN_ERROR_MEMORY.
 *  Complexity: dense O(n^2); sparse O(n): the factor's parts are shared. \since 0.1.0 */
CAIRN_API cairn_status cairn_map_copy(const cairn_map *map, cairn_map **copy);

/** Frees a copy. NULL is allowed; a map that a filter owns stays, for it goes with its filter.
 *  Threads: one a handle. \since 0.1.0 */
CAIRN_API void cairn_map_destroy(cairn_map *map);

/** Sets all options to their defaults, writing at most `struct_size` bytes. Threads: any.
 *  Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_merge_options_init(cairn_merge_options *options, size_t struct_size);

/** Takes the landmarks of `other` into `map`, which stays in its own frame. Where the other's frame lies there is
 *  found from the landmarks that both hold (with has_transform also from what is told beforehand), and both maps'
 *  estimates become the best that follows from the two (docs/map_merging.md). A call that fails changes neither map.
 *
 *  Ids stay: those of `map` never change; a common landmark goes by the map's id. A landmark that is added keeps its
 *  id; by geometry, where the map has another one of that id, it gets the smallest free one above all ids of both
 *  (beyond the largest possible, the smallest free). \ref cairn_map_merged_ids tells.
 *
 *  The maps must be of independent data: two copies of one filter's map, or a merged map and one of its parts, are
 *  refused, because what they share would count twice. What a sparse `other` knows of its own frame (start pose,
 *  absolute fixes) does not come along, except its start pose where has_transform says how the frames lie.
 *
 *  `map` is a copy, `other` a copy or a filter's map. `options` may be NULL for the defaults. `report` may be NULL;
 *  set its struct_size first. It is filled in also where the merge is refused for what the maps hold.
 *
 *  Threads: `map` one a handle; `other` as any const query. Errors: CAIRN_ERROR_ARGUMENT (also map == other),
 *  CAIRN_ERROR_STATE (`map` is a filter's: copy it; the kinds differ; both hold the same filter's landmarks; a sparse
 *  `other` was itself merged by has_transform: merge the other way round), CAIRN_ERROR_NOT_FOUND (a map is empty, or
 *  too few landmarks are in common: it takes one with has_transform, three without), CAIRN_ERROR_NUMERICAL (the common
 *  ones lie on a line; contradict each other, and the message and the report name the worst pair; by geometry: more
 *  than one transform fits), CAIRN_ERROR_CAPACITY (max_landmarks), CAIRN_ERROR_MEMORY.
 *  Complexity, for n landmarks in both and k common ones: dense O(n^2 k + k^3); sparse as closing all of the other's
 *  submaps at once, and the test of at most 300 common landmarks jointly. By geometry besides: O(n log n) and the
 *  budget of triangles. \since 0.1.0 */
CAIRN_API cairn_status cairn_map_merge(cairn_map *map, const cairn_map *other, const cairn_merge_options *options,
                                       cairn_merge_report *report);

/** What the last merge into this map made of the other's landmarks, by ascending other_id; none before a merge. A copy
 *  tells the same. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER.
 *  Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_map_merged_ids(const cairn_map *map, cairn_merged_id *merged, size_t capacity,
                                            size_t *needed);

#ifdef __cplusplus
}
#endif

#endif
