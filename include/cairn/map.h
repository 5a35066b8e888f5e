/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Landmarks and how far to trust them. */
#ifndef CAIRN_MAP_H
#define CAIRN_MAP_H

#include <cairn/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Landmarks in one frame with their joint uncertainty. A filter owns one (\ref cairn_filter_map). */
typedef struct cairn_map cairn_map;

/** A landmark. Layout frozen. */
typedef struct cairn_landmark {
  uint64_t id;           /**< the caller's name for it; stable for the landmark's life */
  uint64_t observations; /**< observations that placed or updated it */
  double position[3];    /**< in the map frame, m */
  double covariance[9];  /**< of position, 3x3 row-major, m^2 */
} cairn_landmark;

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

#ifdef __cplusplus
}
#endif

#endif
