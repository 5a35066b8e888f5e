/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  How far to trust a filter: a verdict with its reasons, and the noise that the observations show (docs/trust.md). */
#ifndef CAIRN_HEALTH_H
#define CAIRN_HEALTH_H

#include <cairn/filter.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The verdict on a filter. */
typedef int32_t cairn_verdict;
enum CAIRN_VALUES(cairn_verdict) {
  CAIRN_VERDICT_GOOD = 0,     /**< what is seen agrees with the estimate and with the stated noise */
  CAIRN_VERDICT_DOUBTFUL = 1, /**< something does not agree; the reasons say what */
  CAIRN_VERDICT_LOST = 2      /**< most of what is seen contradicts the estimate */
};

/** The reasons of a verdict, one bit each. */
typedef uint32_t cairn_doubts;
enum CAIRN_BITS(cairn_doubts) {
  CAIRN_DOUBT_NIS = 1,           /**< the normalised innovations of the window lie above their band */
  CAIRN_DOUBT_REFUSALS = 2,      /**< the gates refuse more than they refuse of honest observations */
  CAIRN_DOUBT_WIDENED = 4,       /**< the motion was widened, because most of what was seen contradicted it */
  CAIRN_DOUBT_SENSOR_NOISE = 8,  /**< a sensor's noise is more than 1.5 times what is stated */
  CAIRN_DOUBT_MOTION_NOISE = 16, /**< the motion's noise is clearly more than what is stated */
  CAIRN_DOUBT_BIAS = 32,         /**< the corrections of the pose have a mean: the motion has a constant error */
  CAIRN_DOUBT_JUMP = 64,         /**< a frame contradicts the motion since the last frame: a slip, or another place */
  CAIRN_DOUBT_LANDMARKS = 128,   /**< single landmarks contradict the rest: moved, or under a wrong id */
  CAIRN_DOUBT_CLOSING = 256,     /**< a closed submap contradicted the map */
  CAIRN_DOUBT_BLIND = 512,       /**< directions of the pose about which the last frames say nothing */
  CAIRN_DOUBT_DEFINITE = 1024    /**< the covariance of the pose is not positive semidefinite */
};

/** The verdict after the last update, and what supports it. A window counts the last 20 updates or so; older updates
 *  fade. A factor that is 1 with a standard deviation above 1 is not known. */
typedef struct cairn_health {
  uint32_t struct_size;      /**< sizeof(cairn_health) of the caller; set it before the call */
  cairn_verdict verdict;     /**< CAIRN_VERDICT_GOOD, CAIRN_VERDICT_DOUBTFUL or CAIRN_VERDICT_LOST */
  cairn_doubts reasons;      /**< bits CAIRN_DOUBT_...; 0 if the verdict is good */
  uint32_t blind_directions; /**< directions of the pose about which the window says nothing */
  uint32_t contradicting;    /**< landmarks of the last frame whose observations contradict the rest */
  uint32_t reserved;         /**< 0 */
  uint64_t updates;          /**< updates so far */
  CAIRN_UNIT(1)
  double good_share;         /**< share of them with this verdict */
  CAIRN_UNIT(1)
  double doubtful_share;     /**< the same */
  CAIRN_UNIT(1)
  double lost_share;         /**< the same */
  CAIRN_UNIT(1)
  double nis_per_row;        /**< normalised innovation squared of the window, for each row; 1 is expected */
  CAIRN_UNIT(1)
  double nis_lower;          /**< its 95 % band: lower bound; 0 before the first row */
  CAIRN_UNIT(1)
  double nis_upper;          /**< its 95 % band: upper bound; 0 before the first row */
  CAIRN_UNIT(1)
  double refused_share;      /**< of the window's observations that were compared with known landmarks */
  uint64_t widenings;        /**< how often the motion was widened */
  CAIRN_UNIT(1)
  double last_widening;      /**< amount of the last one; 0: none */
  CAIRN_UNIT(1)
  double motion_scale;       /**< factor of the motion's stated standard deviations that explains what is seen */
  CAIRN_UNIT(1)
  double motion_scale_sigma; /**< its standard deviation */
  CAIRN_UNIT(1)
  double bias_sigmas;        /**< mean of the pose's corrections in the window, worst axis, over its standard
                                  deviation */
  CAIRN_UNIT(1)
  double jump_sigmas;        /**< how far the last frame contradicts the motion since the frame before */
  CAIRN_UNIT(1)
  double pose_pivot;         /**< smallest pivot of the pose's correlation matrix */
} cairn_health;

/** What the observations of one sensor show. */
typedef struct cairn_sensor_health {
  uint32_t struct_size;  /**< sizeof(cairn_sensor_health) of the caller; set it before the call */
  uint32_t reserved;     /**< 0 */
  uint64_t compared;     /**< observations that were compared with known landmarks, so far */
  uint64_t refused;      /**< of these: refused */
  CAIRN_UNIT(1)
  double nis_per_row;    /**< normalised innovation squared of the window, for each row; 1 is expected */
  CAIRN_UNIT(1)
  double nis_lower;      /**< its 95 % band: lower bound; 0 before the first row */
  CAIRN_UNIT(1)
  double nis_upper;      /**< its 95 % band: upper bound; 0 before the first row */
  CAIRN_UNIT(1)
  double scale;          /**< factor of the sensor's stated standard deviations that explains what is seen */
  CAIRN_UNIT(1)
  double scale_sigma;    /**< its standard deviation */
  CAIRN_UNIT(1)
  double persistence[4]; /**< correlation of a landmark's innovations with those of 1, 2, 3 and 4 sightings before */
} cairn_sensor_health;

/** The verdict on a filter. Set `health->struct_size` first. All of it is what the last update left: the call computes
 *  nothing. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.2.0 */
CAIRN_API cairn_status cairn_filter_health(const cairn_filter *filter, CAIRN_OUT cairn_health *health,
                                           cairn_error *error);

/** What the observations of one sensor show. Set `health->struct_size` first. Threads: as any const query of the
 * handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND (sensor). Complexity: O(1). \since 0.2.0 */
CAIRN_API cairn_status cairn_filter_sensor_health(const cairn_filter *filter, int32_t sensor,
                                                  CAIRN_OUT cairn_sensor_health *health, cairn_error *error);

/** A verdict in one word: "good", "doubtful" or "lost"; "unknown" for any other value. Threads: any. \since 0.2.0 */
CAIRN_API CAIRN_BORROWED(library) const char *cairn_verdict_text(cairn_verdict verdict);

/** A reason in words, for example "single landmarks contradict the rest". `reason` is one bit; anything else gives
 *  "unknown". Threads: any. \since 0.2.0 */
CAIRN_API CAIRN_BORROWED(library) const char *cairn_doubt_text(cairn_doubts reason);

#ifdef __cplusplus
}
#endif

#endif
