/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Teams of planar vehicles: what they tell each other, and what each makes of it (docs/team.md). */
#ifndef CAIRN_TEAM_H
#define CAIRN_TEAM_H

#include <cairn/filter.h>

#ifdef __cplusplus
extern "C" {
#endif

/** One vehicle's view of its team. Each vehicle has one of its own, wherever it runs; they exchange packets, by any
 *  transport. Unlike a filter it allocates in its calls. */
typedef struct cairn_team cairn_team;

/** What a vehicle does with its teammates' packets. */
enum {
  CAIRN_TEAM_MONO = 0,        /**< nothing: to compare with */
  CAIRN_TEAM_EO_DIAGONAL = 1, /**< extended observations with independent noise, as the cooperative paper prints them:
                                   they claim more than they know, the more the more landmarks there are */
  CAIRN_TEAM_EO_FULL = 2,     /**< the same with the noise that all of a scan have in common through the sighting */
  CAIRN_TEAM_JOINT = 3,       /**< every vehicle runs the same filter over all poses and landmarks; the default */
  CAIRN_TEAM_SUBMAPS = 4      /**< every vehicle works in submaps of its own, which are fused by their common landmarks;
                                   vehicles' sightings of each other are not used */
};

/** Options of \ref cairn_team_create. Set them by \ref cairn_team_options_init first. */
typedef struct cairn_team_options {
  uint32_t struct_size;    /**< sizeof(cairn_team_options) of the caller */
  int32_t mode;            /**< CAIRN_TEAM_...; default CAIRN_TEAM_JOINT */
  uint64_t vehicle;        /**< the own number; no two vehicles of a team have the same; not CAIRN_ID_NONE; default 0 */
  uint32_t max_vehicles;   /**< of the team, the own among them, 1 to 256; default 8 */
  uint32_t baseline;       /**< 1: a filter of the own vehicle alone runs beside, for \ref cairn_team_score; default 0 */
  double max_lag;          /**< for so long a teammate's missing packet is waited for, by the times of the own ones, s,
                                > 0; default 30 */
  double time_tolerance;   /**< packets whose times differ by no more are of one time, s, >= 0; default 0.01 */
  uint32_t max_waiting;    /**< packets of one teammate that may wait for their turn, 1 to 1000000; default 4096 */
  uint32_t history;        /**< own packets kept for teammates that miss them, 1 to 1000000; default 1024 */
} cairn_team_options;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_team_options_init(cairn_team_options *options, size_t struct_size);

/** Creates a vehicle's view of its team; the caller destroys it with \ref cairn_team_destroy. `filter` describes the filter
 *  that it runs: its `vehicle` is CAIRN_VEHICLE_PLANAR, its start the own one, in the frame of the whole team, its
 *  `submap_landmarks` greater than 0 in mode CAIRN_TEAM_SUBMAPS alone. `radar` is the sensor of all vehicles, mounted at
 *  the body's origin where extended observations are used. On an error `*team` is not written.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_create(const cairn_team_options *options, const cairn_filter_options *filter,
                                         const cairn_range_bearing *radar, cairn_team **team);

/** Destroys a team, and the map that it owns. NULL is allowed. Threads: one a handle. \since 0.1.0 */
CAIRN_API void cairn_team_destroy(cairn_team *team);

/** A teammate joins. `start` and `covariance` (6x6, of its error; NULL: known exactly) tell where it stood before its
 *  first packet; they must be what the teammate itself starts with. `start` NULL: it is solved from the first sightings of
 *  each other that it and a vehicle whose place is known have at one time (modes with extended observations ask for no
 *  start at all).
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (also one that is there), CAIRN_ERROR_CAPACITY,
 *  CAIRN_ERROR_STATE (mode CAIRN_TEAM_SUBMAPS and no start). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_add(cairn_team *team, uint64_t vehicle, const cairn_pose *start,
                                      const double covariance[36]);

/** A teammate is waited for and listened to no more; what it taught stays.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (the own one), CAIRN_ERROR_NOT_FOUND. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_remove(cairn_team *team, uint64_t vehicle);

/** Numbers of the team's vehicles, the own first. NULL with capacity 0 asks for how many.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_members(const cairn_team *team, uint64_t *vehicles, size_t capacity, size_t *needed);

/** The own vehicle moved, as \ref cairn_filter_predict_increment has it. It is told to the team with the next
 *  \ref cairn_team_observe. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL,
 *  CAIRN_ERROR_CAPACITY (65535 motions without an observation). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_predict_increment(cairn_team *team, const cairn_pose *T_before_after,
                                                    const double covariance[36]);

/** The same by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0) and their noise (NULL: that of
 *  \ref cairn_twist_noise_init). Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL,
 *  CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_predict_twist(cairn_team *team, double dt, const double velocity[3],
                                                const double rate[3], const cairn_twist_noise *noise);

/** Ends a step of the own vehicle at `time` (s, a clock that all vehicles share, later than the last one) with what it
 *  saw: `landmarks` by their ids, `vehicles` by their numbers, each by range and bearing; both may be empty. Motion and
 *  scan become a packet, to be had by \ref cairn_team_take_packet, and are taken in as soon as all teammates have been
 *  heard of up to this time, in an order that is the same at every vehicle. Where the own scan cannot be taken in the
 *  call fails, and is told to the team all the same.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (also a time in the past, a name twice, CAIRN_ID_NONE, the own
 *  number), CAIRN_ERROR_CAPACITY, CAIRN_ERROR_NUMERICAL, CAIRN_ERROR_STATE (it left). Complexity: O(n^2 m) for n states and m rows a vehicle.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_team_observe(cairn_team *team, double time, const cairn_observation *landmarks,
                                          size_t landmark_count, const cairn_observation *vehicles,
                                          size_t vehicle_count);

/** Decisions on the own scan that was taken in last, landmarks, then vehicles, by their ids, in the order in which they
 *  were taken in. NULL with capacity 0 asks for how many. Threads: as any const query of the handle. Errors:
 *  CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_decisions(const cairn_team *team, cairn_match *matches, size_t capacity,
                                            size_t *needed);

/** Bids the team farewell: one more packet, after which teammates do not wait for this vehicle any more.
 *  Own steps are not taken any more; packets of teammates are.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (it left already). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_leave(cairn_team *team);

/** The next packet to be sent to all teammates: own steps, repetitions that somebody asked for, and questions for packets
 *  that are missing. `*needed` gets its size in bytes, 0 where there is none. It is taken out of the queue when it was
 *  copied; NULL with capacity 0 asks for its size.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_take_packet(cairn_team *team, uint8_t *packet, size_t capacity, size_t *needed);

/** Has the team ask for all packets that are missing, as it does by itself where a gap shows at an own step: for the end
 *  of a mission, or after a long silence. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_ask(cairn_team *team);

/** What became of a packet. */
enum {
  CAIRN_PACKET_TAKEN = 1,    /**< it was its turn, and it is part of the estimate */
  CAIRN_PACKET_WAITING = 2,  /**< it waits for its turn */
  CAIRN_PACKET_REQUEST = 3,  /**< a teammate misses own packets: they are to be sent again */
  CAIRN_PACKET_LEAVE = 4,    /**< a teammate left, or will when it is its turn */
  CAIRN_PACKET_REPEATED = 5, /**< it was here before */
  CAIRN_PACKET_OWN = 6,      /**< an own one came back */
  CAIRN_PACKET_IGNORED = 7,  /**< the mode makes no use of it, or it is for somebody else */
  CAIRN_PACKET_UNKNOWN = 8,  /**< of a vehicle that is not of the team */
  CAIRN_PACKET_PAST = 9,     /**< its time does not fit its number */
  CAIRN_PACKET_CONFLICT = 10, /**< another one of this vehicle and this number was here before: two vehicles have one
                                   number */
  CAIRN_PACKET_FULL = 11,     /**< max_waiting packets of this vehicle wait already */
  CAIRN_PACKET_FOREIGN = 12,  /**< no packet of a team */
  CAIRN_PACKET_VERSION = 13,  /**< of a version that this library does not read */
  CAIRN_PACKET_CUT = 14,      /**< bytes are missing, or there are too many */
  CAIRN_PACKET_CORRUPT = 15,  /**< its checksum does not fit */
  CAIRN_PACKET_NONSENSE = 16  /**< whole, and yet no step of a vehicle: values that are not finite, noise that is no
                                   covariance, a name twice */
};

/** Takes a packet of a teammate, whenever and as often as it comes. `result` (or NULL) gets one of the CAIRN_PACKET_
 *  constants; a packet that is refused is counted and changes nothing, and the call succeeds.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_receive(cairn_team *team, const uint8_t *packet, size_t size, int32_t *result);

/** Pose of a vehicle of the team, and the covariance of its error [dp; dtheta] (6x6 row-major); each may be NULL. The own
 *  one is as of now: where own steps still wait for teammates, their motions are counted in, their scans are not. A
 *  teammate's is that of its last packet that was taken in; only mode CAIRN_TEAM_JOINT and CAIRN_TEAM_SUBMAPS have it.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND (not of the team, or not
 *  known where). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_pose(const cairn_team *team, uint64_t vehicle, cairn_pose *pose, double covariance[36]);

/** The team's map. It lives as long as the team and follows it. Never fails but for NULL, which gives NULL.
 *  Threads: as any const query of the handle. Complexity: O(1). \since 0.1.0 */
CAIRN_API const cairn_map *cairn_team_map(const cairn_team *team);

/** Compares the own pose as of now with the truth, and with the filter of the vehicle alone where `baseline` has it run.
 *  \ref cairn_team_last_report tells the means. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_score(cairn_team *team, const cairn_pose *truth);

/** What a team did so far. */
typedef struct cairn_team_report {
  uint32_t struct_size;  /**< sizeof(cairn_team_report) of the caller; set it before the call */
  uint32_t unsettled;    /**< own steps that wait for teammates */
  uint64_t sent;         /**< own steps that became packets */
  uint64_t resent;       /**< packets given out again to those who asked */
  uint64_t requested;    /**< questions asked */
  uint64_t received;     /**< packets that came; of these: */
  uint64_t taken;        /**< are part of the estimate */
  uint64_t reordered;    /**< came after a later one of the same vehicle */
  uint64_t repeated;     /**< had come before */
  uint64_t own;          /**< were own ones */
  uint64_t ignored;      /**< were not for this vehicle or its mode */
  uint64_t unknown;      /**< were of vehicles that are not of the team */
  uint64_t past;         /**< had a time that does not fit */
  uint64_t conflict;     /**< contradicted one that was here before */
  uint64_t full;         /**< found no room to wait */
  uint64_t foreign;      /**< were no packets of a team */
  uint64_t version;      /**< were of another version */
  uint64_t cut;          /**< were cut short */
  uint64_t corrupt;      /**< had a wrong checksum */
  uint64_t nonsense;     /**< were whole and told nothing sensible */
  uint64_t lost;         /**< packets that never came, and were given up after max_lag */
  uint64_t matched;      /**< observations, own and teammates', that updated something */
  uint64_t placed;       /**< ... that placed a landmark */
  uint64_t rejected;     /**< ... that were refused */
  uint64_t sightings_used;    /**< sightings of vehicles that were taken in */
  uint64_t sightings_refused; /**< ... that were not: whoever was seen is not known where, or told of no step at that
                                   time */
  uint64_t vehicles_found;    /**< starts solved from mutual sightings */
  uint64_t failed;            /**< motions and scans that the filter could not take in */
  uint64_t scored;            /**< calls of \ref cairn_team_score */
  uint64_t scored_nees;       /**< ... with a covariance that is not singular, as it is at a known start: the steps of
                                   `anees_per_dof` */
  double position_rmse;       /**< of the own vehicle, m */
  double anees_per_dof;       /**< of its pose: 1 for an honest covariance */
  double claimed_improvement; /**< (||C_mono|| - ||C||) / ||C_mono|| of the position's covariance, Frobenius, over the sums
                                   of all scored steps (cooperative paper, section 3); 0 without a baseline */
  double true_improvement;    /**< 1 - MSE / MSE_mono of the position; 0 without a baseline */
} cairn_team_report;

/** Reports. Set `report->struct_size` first. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT.
 *  Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_last_report(const cairn_team *team, cairn_team_report *report);

#ifdef __cplusplus
}
#endif

#endif
