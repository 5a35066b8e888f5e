/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Teams of planar vehicles: what the vehicles tell each other, and how each uses it (docs/team.md). The *own vehicle* is
 *  the one that a handle belongs to; the others are its *teammates*. */
#ifndef CAIRN_TEAM_H
#define CAIRN_TEAM_H

#include <cairn/filter.h>

#ifdef __cplusplus
extern "C" {
#endif

/** One vehicle's view of its team. Each vehicle has a handle of its own, wherever it runs; vehicles exchange packets, by
 *  any transport. Unlike a filter, a team allocates memory in its calls. */
typedef struct cairn_team cairn_team;

/** How a vehicle uses its teammates' packets. */
enum {
  CAIRN_TEAM_MONO = 0,        /**< not at all: to compare with */
  CAIRN_TEAM_EO_DIAGONAL = 1, /**< extended observations with independent noise, as the cooperative paper prints them:
                                   they are overconfident, and more so with more landmarks */
  CAIRN_TEAM_EO_FULL = 2,     /**< extended observations with the noise that a scan has in common through the sighting */
  CAIRN_TEAM_JOINT = 3,       /**< every vehicle runs the same filter over all poses and landmarks; the default */
  CAIRN_TEAM_SUBMAPS = 4      /**< every vehicle works in submaps of its own, which are fused by their common landmarks;
                                   sightings of vehicles are not used */
};

/** Options of \ref cairn_team_create. Set them by \ref cairn_team_options_init first. */
typedef struct cairn_team_options {
  uint32_t struct_size;    /**< sizeof(cairn_team_options) of the caller */
  int32_t mode;            /**< CAIRN_TEAM_...; default CAIRN_TEAM_JOINT */
  uint64_t vehicle;        /**< number of the own vehicle, unique in the team; not CAIRN_ID_NONE; default 0 */
  uint32_t max_vehicles;   /**< of the team, with the own vehicle, 1 to 256; default 8 */
  uint32_t baseline;       /**< 1: a filter of the own vehicle only runs beside, for \ref cairn_team_score; default 0 */
  double max_lag;          /**< a teammate's missing packet is waited for this long, by the times of the own steps, s,
                                > 0; default 30 */
  double time_tolerance;   /**< packets whose times differ by no more than this are of one time, s, >= 0; default 0.01 */
  uint32_t max_waiting;    /**< packets of one teammate that may wait for their turn, 1 to 1000000; default 4096 */
  uint32_t history;        /**< own packets kept for teammates that miss them, 1 to 1000000; default 1024 */
} cairn_team_options;

/** Fills in the defaults, at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_options_init(cairn_team_options *options, size_t struct_size);

/** Creates a vehicle's view of its team; the caller destroys it with \ref cairn_team_destroy. `filter` describes the filter
 *  that it runs: `vehicle` is CAIRN_VEHICLE_PLANAR, the start is that of the own vehicle in the frame of the whole team,
 *  and `submap_landmarks` is greater than 0 in mode CAIRN_TEAM_SUBMAPS and 0 in all others. `radar` is the sensor of all
 *  vehicles; modes with extended observations want it at the body's origin. On an error `*team` is not written.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_create(const cairn_team_options *options, const cairn_filter_options *filter,
                                         const cairn_range_bearing *radar, cairn_team **team);

/** Destroys a team and the map that it owns. NULL is allowed. Threads: one a handle. \since 0.1.0 */
CAIRN_API void cairn_team_destroy(cairn_team *team);

/** A teammate joins. `start` and `covariance` (6x6, of its error; NULL: known exactly) are its pose before its first
 *  packet; they must be what the teammate itself starts with. `start` NULL: the start is solved from the first mutual
 *  sighting with a vehicle whose pose is known (modes with extended observations need no start).
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (also where it is a member already), CAIRN_ERROR_CAPACITY,
 *  CAIRN_ERROR_STATE (mode CAIRN_TEAM_SUBMAPS and no start). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_add(cairn_team *team, uint64_t vehicle, const cairn_pose *start,
                                      const double covariance[36]);

/** Removes a teammate: the team neither waits for its packets nor takes them any more. The landmarks that it saw stay.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (the own vehicle), CAIRN_ERROR_NOT_FOUND. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_remove(cairn_team *team, uint64_t vehicle);

/** Numbers of the team's vehicles, the own vehicle first. NULL with capacity 0 asks for the count.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_members(const cairn_team *team, uint64_t *vehicles, size_t capacity, size_t *needed);

/** The own vehicle moved, as in \ref cairn_filter_predict_increment. The motion is sent to the team with the next
 *  \ref cairn_team_observe. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL,
 *  CAIRN_ERROR_CAPACITY (65535 motions without an observation). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_predict_increment(cairn_team *team, const cairn_pose *T_before_after,
                                                    const double covariance[36]);

/** The own vehicle moved with this body velocity (m/s) and body rate (rad/s) for `dt` seconds (> 0); `noise` is theirs
 *  (NULL: that of \ref cairn_twist_noise_init). Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL,
 *  CAIRN_ERROR_CAPACITY. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_predict_twist(cairn_team *team, double dt, const double velocity[3],
                                                const double rate[3], const cairn_twist_noise *noise);

/** Ends a step of the own vehicle at `time` (s, on a clock that all vehicles share, later than the last step) with what it
 *  saw: `landmarks` with their ids, `vehicles` with their numbers, each by range and bearing; both may be empty. Motions and
 *  scan become a packet for \ref cairn_team_take_packet. They update the filter as soon as the packets of all teammates up
 *  to this time are here, in an order that is the same at every vehicle. If the filter refuses the own scan, the call fails,
 *  but the packet is sent to the team all the same.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (also a time in the past, a name twice, CAIRN_ID_NONE, the number
 *  of the own vehicle), CAIRN_ERROR_CAPACITY, CAIRN_ERROR_NUMERICAL, CAIRN_ERROR_STATE (the vehicle left the team).
 *  Complexity: O(n^2 m) for n states and m rows a vehicle. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_observe(cairn_team *team, double time, const cairn_observation *landmarks,
                                          size_t landmark_count, const cairn_observation *vehicles,
                                          size_t vehicle_count);

/** Matches of the own scan that updated the filter last, landmarks, then vehicles, in the order in which the filter took
 *  them. NULL with capacity 0 asks for the count. Threads: as any const query of the handle. Errors:
 *  CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_decisions(const cairn_team *team, cairn_match *matches, size_t capacity,
                                            size_t *needed);

/** The own vehicle leaves the team: it sends one more packet, after which teammates do not wait for it any more.
 *  The team takes no more own steps, but it still takes packets of teammates.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (the vehicle left already). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_leave(cairn_team *team);

/** The next packet to be sent to all teammates: an own step, a repetition that a teammate asked for, or a request for
 *  packets that are missing. `*needed` gets its size in bytes, 0 where there is none. The packet leaves the queue when it
 *  was copied; NULL with capacity 0 asks for its size.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_take_packet(cairn_team *team, uint8_t *packet, size_t capacity, size_t *needed);

/** Sends requests for all packets that are missing. The team does so by itself where a gap shows at an own step; this call
 *  is for the end of a mission, or after a long silence. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_ask(cairn_team *team);

/** What became of a packet. */
enum {
  CAIRN_PACKET_TAKEN = 1,    /**< it was its turn, and it is part of the estimate */
  CAIRN_PACKET_WAITING = 2,  /**< it waits for its turn */
  CAIRN_PACKET_REQUEST = 3,  /**< a teammate misses own packets; they are in the queue again */
  CAIRN_PACKET_LEAVE = 4,    /**< a teammate left, or leaves when its turn comes */
  CAIRN_PACKET_REPEATED = 5, /**< it had arrived before */
  CAIRN_PACKET_OWN = 6,      /**< an own packet came back */
  CAIRN_PACKET_IGNORED = 7,  /**< the mode does not use it, or it is for another vehicle */
  CAIRN_PACKET_UNKNOWN = 8,  /**< its sender is not a member of the team */
  CAIRN_PACKET_PAST = 9,     /**< its time does not fit its number */
  CAIRN_PACKET_CONFLICT = 10, /**< another packet with this vehicle and this number had arrived before: two vehicles
                                   have one number */
  CAIRN_PACKET_FULL = 11,     /**< max_waiting packets of its sender wait already */
  CAIRN_PACKET_FOREIGN = 12,  /**< it is no packet of a team */
  CAIRN_PACKET_VERSION = 13,  /**< this library does not read its version */
  CAIRN_PACKET_CUT = 14,      /**< bytes are missing, or there are too many */
  CAIRN_PACKET_CORRUPT = 15,  /**< its checksum does not fit */
  CAIRN_PACKET_NONSENSE = 16  /**< it is whole, but no step of a vehicle: a value is not finite, noise is no covariance,
                                   or a name comes twice */
};

/** Takes a packet of a teammate, whenever and as often as it arrives. `result` (or NULL) gets one of the CAIRN_PACKET_
 *  constants; a packet that is refused is counted and changes nothing else, and the call succeeds.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_receive(cairn_team *team, const uint8_t *packet, size_t size, int32_t *result);

/** Pose of a vehicle of the team, and the covariance of its error [dp; dtheta] (6x6 row-major); each may be NULL. The own
 *  pose is as of now: where own steps still wait for teammates, it includes their motions, but not their scans. A
 *  teammate's pose is as of its last packet that had its turn; only modes CAIRN_TEAM_JOINT and CAIRN_TEAM_SUBMAPS have it.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND (no member, or its
 *  pose is not known). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_pose(const cairn_team *team, uint64_t vehicle, cairn_pose *pose, double covariance[36]);

/** Normalised estimation error squared of the own pose, as \ref cairn_team_pose gives it, against a true one, in the
 *  filter's own error coordinates: about 3 on average for a consistent filter. On an error `*nees` is not written.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL (the covariance of the
 *  own pose is singular, as at a known start). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_pose_nees(const cairn_team *team, const cairn_pose *truth, double *nees);

/** The team's map. It lives as long as the team and follows it. Never fails but for NULL, which gives NULL.
 *  Threads: as any const query of the handle. Complexity: O(1). \since 0.1.0 */
CAIRN_API const cairn_map *cairn_team_map(const cairn_team *team);

/** Compares the own pose as of now with the truth, and with the filter of the own vehicle only if `baseline` is 1.
 *  \ref cairn_team_last_report gives the means. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_score(cairn_team *team, const cairn_pose *truth);

/** What a team did so far. */
typedef struct cairn_team_report {
  uint32_t struct_size;  /**< sizeof(cairn_team_report) of the caller; set it before the call */
  uint32_t unsettled;    /**< own steps that wait for teammates */
  uint64_t sent;         /**< own steps that became packets */
  uint64_t resent;       /**< own packets that were sent again on request */
  uint64_t requested;    /**< requests sent */
  uint64_t received;     /**< packets that arrived; of these: */
  uint64_t taken;        /**< had their turn */
  uint64_t reordered;    /**< arrived after a later one of the same vehicle */
  uint64_t repeated;     /**< had arrived before */
  uint64_t own;          /**< were own packets */
  uint64_t ignored;      /**< were not for this vehicle or its mode */
  uint64_t unknown;      /**< had a sender that is not a member */
  uint64_t past;         /**< had a time that does not fit */
  uint64_t conflict;     /**< contradicted a packet that had arrived before */
  uint64_t full;         /**< found no room to wait */
  uint64_t foreign;      /**< were no packets of a team */
  uint64_t version;      /**< were of another version */
  uint64_t cut;          /**< were cut short */
  uint64_t corrupt;      /**< had a wrong checksum */
  uint64_t nonsense;     /**< were whole, but no step of a vehicle */
  uint64_t lost;         /**< packets that never arrived and were given up after max_lag */
  uint64_t matched;      /**< observations, own and teammates', that updated something */
  uint64_t placed;       /**< ... that placed a landmark */
  uint64_t rejected;     /**< ... that were refused */
  uint64_t sightings_used;    /**< sightings of vehicles that updated something */
  uint64_t sightings_refused; /**< ... that did not: the pose of the seen vehicle is not known, or it has no packet
                                   of that time */
  uint64_t vehicles_found;    /**< starts solved from mutual sightings */
  uint64_t failed;            /**< motions and scans that the filter refused */
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
