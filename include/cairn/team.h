/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Teams of planar vehicles that exchange packets of measurements and map together (docs/team.md). *This vehicle* is
 *  the vehicle that a handle belongs to. The other vehicles are its *teammates*. */
#ifndef CAIRN_TEAM_H
#define CAIRN_TEAM_H

#include <cairn/filter.h>

#ifdef __cplusplus
extern "C" {
#endif

/** One vehicle's view of its team. Each vehicle has its own handle, on its own computer. The vehicles exchange
 *  packets by any transport. Unlike a filter, a team allocates memory in its calls. A call that fails leaves the team
 *  as it was, also if memory runs out; the call can be repeated. Exceptions: \ref cairn_team_observe tells what it
 *  keeps of a step that the filter refuses and of a time that is refused. In mode CAIRN_TEAM_SUBMAPS a closing that
 *  runs out of memory does not fail the call: the packets that have their turn after it wait, and the next call first
 *  makes up for it (`interrupted` of \ref cairn_team_report). If there is still no memory, this next call fails. */
typedef struct cairn_team cairn_team;

/** Mode: how a vehicle uses the packets of its teammates. */
typedef int32_t cairn_team_mode;
enum CAIRN_VALUES(cairn_team_mode) {
  CAIRN_TEAM_MONO = 0,        /**< it ignores them; for comparison */
  CAIRN_TEAM_EO_DIAGONAL = 1, /**< extended observations with independent noise, as printed in the cooperative paper:
                                   overconfident, and more so with more landmarks */
  CAIRN_TEAM_EO_FULL = 2,     /**< extended observations with the noise that all observations of a scan share through
                                   the sighting */
  CAIRN_TEAM_JOINT = 3,       /**< every vehicle runs the same filter over all poses and all landmarks; the default */
  CAIRN_TEAM_SUBMAPS = 4      /**< every vehicle works in its own submaps, which are fused by their common landmarks;
                                   sightings between vehicles are not used */
};

/** Options of \ref cairn_team_create. Set them by \ref cairn_team_options_init first. */
typedef struct cairn_team_options {
  uint32_t struct_size;  /**< sizeof(cairn_team_options) of the caller */
  cairn_team_mode mode;  /**< CAIRN_TEAM_...; default CAIRN_TEAM_JOINT */
  uint64_t vehicle;      /**< number of this vehicle; unique in the team; not CAIRN_ID_NONE; default 0 */
  uint32_t max_vehicles; /**< vehicles of the team, this one included, 1 to 256; default 8 */
  cairn_bool baseline;   /**< 1: a second filter uses only this vehicle's data, for comparison by \ref
                              cairn_team_score; default 0 */
  double max_lag;        /**< how long the team waits for a missing packet of a teammate, by the times of its own
                              packets, s, > 0; default 30 */
  double time_tolerance; /**< packets whose times differ by at most this belong to the same time, s, >= 0; default
                              0.01 */
  double max_jump;       /**< a step that follows the one before it by more than this, s, > 0, is refused until the
                              next one confirms it; default 60 \since 0.2.0 */
  uint32_t max_waiting;  /**< packets of one teammate that can wait for their turn, 1 to 1000000; default 4096. The one
                              that the others wait for has room beside them */
  uint32_t history;      /**< own packets that are kept for teammates that miss them, 1 to 1000000; default 1024 */
} cairn_team_options;

/** Fills in the defaults and writes at most `struct_size` bytes. Threads: any. Errors: CAIRN_ERROR_ARGUMENT.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_team_options_init(CAIRN_OUT cairn_team_options *options, size_t struct_size,
                                               cairn_error *error);

/** Creates a vehicle's view of its team. The caller destroys it with \ref cairn_team_destroy. `filter` holds the
 *  options of the filter that the team runs: `vehicle` must be CAIRN_VEHICLE_PLANAR, `initial_pose` is the start of
 *  this vehicle in the frame of the team, and `submap_landmarks` must be greater than 0 in mode CAIRN_TEAM_SUBMAPS
 *  and 0 in all other modes. `radar` is the sensor of all vehicles. With extended observations it must be mounted at
 *  the body's origin. On an error `*team` is not written.
 *  Threads: any. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY. Complexity: O(memory). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_create(const cairn_team_options *options, const cairn_filter_options *filter,
                                         const cairn_range_bearing *radar, cairn_team **team, cairn_error *error);

/** Destroys a team and the map that it owns. NULL is allowed. Threads: one a handle.
 *  Complexity: O(memory). \since 0.1.0 */
CAIRN_API void cairn_team_destroy(cairn_team *team);

/** Adds a teammate. `start` is its pose before its first packet, and `covariance` (6x6; NULL: known exactly) the
 *  covariance of the error of `start`. Both must be the values that the teammate itself starts with. `start` NULL:
 *  the start is unknown. It is solved from the first mutual sighting, at one time, between the teammate and a vehicle
 *  whose pose is known. Modes with extended observations need no start.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (also a teammate that exists, and in mode CAIRN_TEAM_SUBMAPS one
 *  that was removed, for its submaps are in the map), CAIRN_ERROR_CAPACITY, CAIRN_ERROR_STATE (mode CAIRN_TEAM_SUBMAPS
 *  and no start), CAIRN_ERROR_MEMORY. Complexity: O(n). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_add(cairn_team *team, uint64_t vehicle,
                                      CAIRN_IN CAIRN_OPTIONAL const cairn_pose *start,
                                      CAIRN_OPTIONAL CAIRN_UNIT(pose^2) const double covariance[36],
                                      cairn_error *error);

/** Removes a teammate: the team neither waits for it nor uses its packets any more. The information from its earlier
 *  packets stays. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT (this vehicle), CAIRN_ERROR_NOT_FOUND,
 *  CAIRN_ERROR_MEMORY. Complexity: O(waiting packets). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_remove(cairn_team *team, uint64_t vehicle, cairn_error *error);

/** Numbers of the vehicles of the team, this vehicle's number first. Capacity 0 asks for how many there are.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER.
 *  Complexity: O(vehicles). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_members(const cairn_team *team, CAIRN_OUT_ARRAY(capacity) uint64_t *vehicles,
                                          size_t capacity, size_t *needed, cairn_error *error);

/** Moves this vehicle by a relative pose, like \ref cairn_filter_predict_increment. The teammates learn of this
 *  motion by the packet of the next \ref cairn_team_observe. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT,
 *  CAIRN_ERROR_NUMERICAL (more than 1e9 m, or noise of more than 1e9 m or a whole turn), CAIRN_ERROR_CAPACITY (65535
 *  motions without an observation), CAIRN_ERROR_MEMORY. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_predict_increment(cairn_team *team, CAIRN_IN const cairn_pose *T_before_after,
                                                    CAIRN_UNIT(pose^2) const double covariance[36], cairn_error *error);

/** Moves this vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0). `noise` NULL: that
 *  of
 *  \ref cairn_twist_noise_init. Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NUMERICAL,
 *  CAIRN_ERROR_CAPACITY, CAIRN_ERROR_MEMORY. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_predict_twist(cairn_team *team, CAIRN_UNIT(s) CAIRN_RANGE(> 0) double dt,
                                                CAIRN_UNIT(m/s) const double velocity[3],
                                                CAIRN_UNIT(rad/s) const double rate[3],
                                                CAIRN_OPTIONAL const cairn_twist_noise *noise, cairn_error *error);

/** Ends a step of this vehicle at `time` with its scan. `time` is in s, by a clock that all vehicles share, and must
 *  be later than the last one. The scan is ranges and bearings of `landmarks`, by their ids, and of `vehicles`, by
 *  their numbers; both may be empty. Motion and scan become a packet for \ref cairn_team_take_packet. The filter is
 *  updated by the step when the packets of all teammates up to this time have arrived; the order is the same at every
 *  vehicle. If the update by this vehicle's scan fails, the call fails, but the packet is sent all the same. A time
 *  that is more than `max_jump` after the last one is refused, and the motions are kept for the next call. If the
 *  next call has a later time, by at most `max_jump`, both were right, and it succeeds. Threads: one a handle.
 *  Errors: CAIRN_ERROR_ARGUMENT (also a time in the past, an id or a number twice, CAIRN_ID_NONE, this vehicle's
 *  number), CAIRN_ERROR_CAPACITY, CAIRN_ERROR_NUMERICAL, CAIRN_ERROR_STATE (the vehicle has left the team),
 *  CAIRN_ERROR_MEMORY. Complexity: O(n^2 m) for n states and m rows of each vehicle. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_observe(cairn_team *team, CAIRN_UNIT(s) double time,
                                          CAIRN_IN_ARRAY(landmark_count) const cairn_observation *landmarks,
                                          size_t landmark_count,
                                          CAIRN_IN_ARRAY(vehicle_count) const cairn_observation *vehicles,
                                          size_t vehicle_count, cairn_error *error);

/** Matches of the last scan of this vehicle that updated the filter: those of landmarks, then those of vehicles, by
 *  their ids, in the order in which they were processed. Capacity 0 asks for how many there are. Threads: as
 *  any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER.
 *  Complexity: O(matches). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_decisions(const cairn_team *team, CAIRN_OUT_ARRAY(capacity) cairn_match *matches,
                                            size_t capacity, size_t *needed, cairn_error *error);

/** Leaves the team: makes a last packet, the farewell, after which the teammates do not wait for this vehicle any
 *  more. Own steps are then refused. Packets of teammates are still used.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_STATE (the vehicle has already left),
 *  CAIRN_ERROR_MEMORY.
 *  \since 0.1.0 */
CAIRN_API cairn_status cairn_team_leave(cairn_team *team, cairn_error *error);

/** Takes the next packet that is to be sent to all teammates: a step of this vehicle, a repetition that a teammate
 *  asked for, or a request for missing packets. `*needed` gets its size in bytes, 0 if there is no packet. The packet
 *  leaves the queue when it was copied. Own steps wait until they are taken. A packet that was asked for waits once,
 *  however often it was asked for, and so does the request to each teammate: beside own steps the queue holds at most
 *  `history` repetitions and `max_vehicles` requests. Capacity 0 asks for its size. Threads: one a handle.
 *  Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_BUFFER. Complexity: O(size of the packet). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_take_packet(cairn_team *team, CAIRN_OUT_ARRAY(capacity) uint8_t *packet,
                                              size_t capacity, size_t *needed, cairn_error *error);

/** Asks the teammates for all missing packets. The team does so itself when it finds a gap at a step of this vehicle;
 *  call this function at the end of a mission or after a long silence. Threads: one a handle. Errors:
 *  CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY (mode CAIRN_TEAM_SUBMAPS). Complexity: O(missing packets). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_ask(cairn_team *team, cairn_error *error);

/** Result of a received packet. */
typedef int32_t cairn_packet;
enum CAIRN_VALUES(cairn_packet) {
  CAIRN_PACKET_TAKEN = 1,     /**< it had its turn and is part of the estimate */
  CAIRN_PACKET_WAITING = 2,   /**< it waits for its turn */
  CAIRN_PACKET_REQUEST = 3,   /**< a teammate misses own packets; they are queued to be sent again */
  CAIRN_PACKET_LEAVE = 4,     /**< a teammate leaves the team when this packet has its turn */
  CAIRN_PACKET_REPEATED = 5,  /**< it was received before */
  CAIRN_PACKET_OWN = 6,       /**< it is an own packet that came back */
  CAIRN_PACKET_IGNORED = 7,   /**< the mode does not use it, or it is for another vehicle */
  CAIRN_PACKET_UNKNOWN = 8,   /**< its sender is not in the team */
  CAIRN_PACKET_PAST = 9,      /**< its time does not agree with its number */
  CAIRN_PACKET_CONFLICT = 10, /**< a different packet of this sender with this number was received before: two
                                   vehicles have the same number */
  CAIRN_PACKET_FULL = 11,     /**< max_waiting packets of this sender wait already */
  CAIRN_PACKET_FOREIGN = 12,  /**< it is not a packet of a team */
  CAIRN_PACKET_VERSION = 13,  /**< this library does not read its version */
  CAIRN_PACKET_CUT = 14,      /**< bytes are missing, or there are too many */
  CAIRN_PACKET_CORRUPT = 15,  /**< its checksum is wrong */
  CAIRN_PACKET_NONSENSE = 16, /**< it is complete, but not a valid step: values that are not finite, noise that is
                                   not a covariance, an id or a number twice, numbers of absurd size */
  CAIRN_PACKET_AHEAD = 17     /**< its time is more than max_jump after that of the sender's packet before it. The next
                                   packet of the sender decides: if it agrees with this one, both are right, and this
                                   one can be received again \since 0.2.0 */
};

/** Receives a packet of a teammate. Packets may come late, repeatedly and in any order. `result` (or NULL) gets one
 *  of the CAIRN_PACKET_ constants. A refused packet is counted and changes nothing; the call succeeds all the same.
 *  Threads: one a handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_MEMORY.
 *  Complexity: O(n^2 m) for n states and m rows of each packet that has its turn. \since 0.1.0 */
CAIRN_API cairn_status cairn_team_receive(cairn_team *team, CAIRN_IN_ARRAY(size) const uint8_t *packet, size_t size,
                                          CAIRN_OUT CAIRN_OPTIONAL cairn_packet *result, cairn_error *error);

/** Pose of a vehicle of the team, and the covariance of its error [dp; dtheta] (6x6 row-major); each may be NULL. The
 *  own pose is the present one: it includes the motions of own steps that still wait for teammates, but not their
 *  scans. The pose of a teammate is that of its last packet that is part of the estimate; only the modes
 *  CAIRN_TEAM_JOINT and CAIRN_TEAM_SUBMAPS have it.
 *  Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT, CAIRN_ERROR_NOT_FOUND (not in the team,
 *  or its pose is unknown). Complexity: O(own motions that wait for teammates). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_pose(const cairn_team *team, uint64_t vehicle,
                                       CAIRN_OUT CAIRN_OPTIONAL cairn_pose *pose,
                                       CAIRN_OUT CAIRN_OPTIONAL CAIRN_UNIT(pose^2) double covariance[36],
                                       cairn_error *error);

/** Normalised estimation error squared (NEES) of this vehicle's pose against the true pose, in the error coordinates of
 *  the filter. The pose is the one that \ref cairn_team_pose returns. A consistent filter has 3 on average. On an error
 *  `*nees` is not written. Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT,
 *  CAIRN_ERROR_NUMERICAL (the covariance of this pose is singular, as it is at a known start).
 *  Complexity: O(own motions that wait for teammates). \since 0.1.1 */
CAIRN_API cairn_status cairn_team_pose_nees(const cairn_team *team, CAIRN_IN const cairn_pose *truth,
                                            CAIRN_OUT CAIRN_UNIT(1) double *nees, cairn_error *error);

/** The team's map. The team owns this map; it lives as long as the team and follows it. Fails only for NULL, and then
 *  returns NULL. Threads: as any const query of the handle. Complexity: O(1). \since 0.1.0 */
CAIRN_API CAIRN_BORROWED(team) const cairn_map *cairn_team_map(const cairn_team *team);

/** Compares the present pose of this vehicle with the true pose. With the option `baseline` it compares the pose of
 *  the second filter, too. \ref cairn_team_last_report returns the means. Threads: one a handle. Errors:
 *  CAIRN_ERROR_ARGUMENT. Complexity: O(own motions that wait for teammates). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_score(cairn_team *team, CAIRN_IN const cairn_pose *truth, cairn_error *error);

/** Report of a team. */
typedef struct cairn_team_report {
  uint32_t struct_size;       /**< sizeof(cairn_team_report) of the caller; set it before the call */
  uint32_t unsettled;         /**< own steps that still wait for teammates */
  cairn_bool interrupted;     /**< 1: memory ran out while a submap was closed. The next call closes it first. Until
                                   then no further packet has its turn. Otherwise 0 \since 0.2.0 */
  uint32_t reserved;          /**< 0 */
  uint64_t sent;              /**< own steps that became packets */
  uint64_t resent;            /**< packets sent again because a teammate asked */
  uint64_t requested;         /**< requests sent */
  uint64_t received;          /**< packets received */
  uint64_t taken;             /**< received packets that are part of the estimate */
  uint64_t reordered;         /**< received packets that arrived after a later packet of the same sender */
  uint64_t repeated;          /**< received packets that had been received before */
  uint64_t own;               /**< received packets that were own packets */
  uint64_t ignored;           /**< received packets that were not for this vehicle or its mode */
  uint64_t unknown;           /**< received packets whose sender is not in the team */
  uint64_t past;              /**< received packets whose time does not agree with their number */
  uint64_t ahead;             /**< received packets that were too far ahead \since 0.2.0 */
  uint64_t conflict;          /**< received packets that contradict a packet that was received before */
  uint64_t full;              /**< received packets that found no room to wait */
  uint64_t foreign;           /**< received packets that were not packets of a team */
  uint64_t version;           /**< received packets of another version */
  uint64_t cut;               /**< received packets with bytes missing, or too many */
  uint64_t corrupt;           /**< received packets with a wrong checksum */
  uint64_t nonsense;          /**< received packets that were complete, but not a valid step */
  uint64_t lost;              /**< packets that never arrived and were given up after max_lag */
  uint64_t matched;           /**< observations, own and teammates', that updated a landmark */
  uint64_t placed;            /**< observations that placed a new landmark */
  uint64_t rejected;          /**< observations that were refused */
  uint64_t sightings_used;    /**< sightings of vehicles that were used */
  uint64_t sightings_refused; /**< sightings of vehicles that were refused: the pose of the seen vehicle is unknown,
                                   or it has no step at this time */
  uint64_t vehicles_found;    /**< starts solved from mutual sightings */
  uint64_t failed;            /**< motions and scans by which the filter could not be updated */
  uint64_t scored;            /**< calls of \ref cairn_team_score */
  uint64_t scored_nees;       /**< scored steps with a covariance that is not singular (at a known start it is
                                   singular): the steps of `anees_per_dof` */
  double position_rmse;       /**< root mean square position error of this vehicle, m */
  CAIRN_UNIT(1)
  double anees_per_dof;       /**< average NEES of its pose over the degrees of freedom: 1 for an honest covariance */
  CAIRN_UNIT(1)
  double claimed_improvement; /**< (||C_mono|| - ||C||) / ||C_mono||: Frobenius norms of the position's covariance,
                                   summed over all scored steps (cooperative paper, section 3); 0 without `baseline` */
  CAIRN_UNIT(1)
  double true_improvement;    /**< 1 - MSE / MSE_mono of the position; 0 without `baseline` */
} cairn_team_report;

/** Reports on the team so far. Set `report->struct_size` first. Threads: as any const query of the handle. Errors:
 *  CAIRN_ERROR_ARGUMENT. Complexity: O(1). \since 0.1.0 */
CAIRN_API cairn_status cairn_team_last_report(const cairn_team *team, CAIRN_OUT cairn_team_report *report,
                                              cairn_error *error);

#ifdef __cplusplus
}
#endif

#endif
