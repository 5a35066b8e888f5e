// SPDX-License-Identifier: BSD-3-Clause
// One vehicle's view of its team.
#ifndef CAIRN_CPP_TEAM_HPP
#define CAIRN_CPP_TEAM_HPP

#include <cairn/cpp/map.hpp>

namespace cairn {
namespace detail {

struct TeamKind {
  using Handle = cairn_team;
  static constexpr const char* name = "team";
  //~ cairn_team_destroy
  /// Destroys a team and the map that it owns.
  ///
  /// Complexity: O(memory).
  static void destroy(Handle* handle) noexcept { cairn_team_destroy(handle); }
};

}  // namespace detail

/// One vehicle's view of its team. The vehicles exchange packets by any transport.
class Team : public detail::Owner<detail::TeamKind> {
 public:
  //~ cairn_team_create
  /// Creates a vehicle's view of its team. `filter` holds the options of the filter that the team runs: `vehicle` must
  /// be Vehicle::kPlanar, `initial_pose` is the start of this vehicle in the frame of the team, and `submap_landmarks`
  /// must be greater than 0 in mode TeamMode::kSubmaps and 0 in all other modes. `radar` is the sensor of all vehicles.
  /// With extended observations it must be mounted at the body's origin.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorMemory.
  ///
  /// Complexity: O(memory).
  Team(const TeamOptions& options, const FilterOptions& filter, const RangeBearing& radar)
      : Owner([&](cairn_team** team, cairn_error* error) {
          return cairn_team_create(detail::as_c(&options), detail::as_c(&filter), detail::as_c(&radar), team, error);
        }) {}

  //~ cairn_team_add
  /// Adds a teammate. `start` is its pose before its first packet, and `covariance` (6x6; none: known exactly) the
  /// covariance of the error of `start`. Both must be the values that the teammate itself starts with. `start` none:
  /// the start is unknown. It is solved from the first mutual sighting, at one time, between the teammate and a vehicle
  /// whose pose is known. Modes with extended observations need no start.
  ///
  /// Throws Error: Status::kErrorArgument (also a teammate that exists, and in mode TeamMode::kSubmaps one that was
  /// removed, for its submaps are in the map); Status::kErrorCapacity; Status::kErrorState (mode TeamMode::kSubmaps and
  /// no start); Status::kErrorMemory.
  ///
  /// Complexity: O(n).
  void add(std::uint64_t vehicle, const Pose& start, Symmetric<6> covariance = {}) {
    change(cairn_team_add, vehicle, detail::as_c(&start), covariance.get_optional("covariance"));
  }

  /// Adds a teammate whose start is unknown.
  void add(std::uint64_t vehicle) {
    change(cairn_team_add, vehicle, static_cast<const cairn_pose*>(nullptr), static_cast<const double*>(nullptr));
  }

  //~ cairn_team_remove
  /// Removes a teammate: the team neither waits for it nor uses its packets any more. The information from its earlier
  /// packets stays.
  ///
  /// Throws Error: Status::kErrorArgument (this vehicle); Status::kErrorNotFound; Status::kErrorMemory.
  ///
  /// Complexity: O(waiting packets).
  void remove(std::uint64_t vehicle) { change(cairn_team_remove, vehicle); }

  //~ cairn_team_members
  /// Numbers of the vehicles of the team, this vehicle's number first.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(vehicles).
  std::vector<std::uint64_t> members() const { return list<std::uint64_t>(cairn_team_members); }

  //~ cairn_team_predict_increment
  /// Moves this vehicle by a relative pose, like Filter::predict_increment. The teammates learn of this motion by the
  /// packet of the next Team::observe.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical (more than 1e9 m, or noise of more than 1e9 m or a
  /// whole turn); Status::kErrorCapacity (65535 motions without an observation); Status::kErrorMemory.
  ///
  /// Complexity: O(1).
  void predict_increment(const Pose& T_before_after, Symmetric<6> covariance) {
    change(cairn_team_predict_increment, detail::as_c(&T_before_after), covariance.get("covariance"));
  }

  //~ cairn_team_predict_twist
  /// Moves this vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0). `noise` none: that of
  /// TwistNoise::TwistNoise.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical; Status::kErrorCapacity; Status::kErrorMemory.
  ///
  /// Complexity: O(1).
  void predict_twist(double dt, Vector<3> velocity, Vector<3> rate, const TwistNoise& noise = {}) {
    change(cairn_team_predict_twist, dt, velocity.get("velocity"), rate.get("rate"), detail::as_c(&noise));
  }

  //~ cairn_team_observe
  /// Ends a step of this vehicle at `time` with its scan. `time` is in s, by a clock that all vehicles share, and must
  /// be later than the last one. The scan is ranges and bearings of `landmarks`, by their ids, and of `vehicles`, by
  /// their numbers; both may be empty. Motion and scan become a packet for Team::take_packet. The filter is updated by
  /// the step when the packets of all teammates up to this time have arrived; the order is the same at every vehicle.
  /// If the update by this vehicle's scan fails, the call fails, but the packet is sent all the same. A time that is
  /// more than `max_jump` after the last one is refused, and the motions are kept for the next call. If the next call
  /// has a later time, by at most `max_jump`, both were right, and it succeeds.
  ///
  /// Throws Error: Status::kErrorArgument (also a time in the past, an id or a number twice, kIdNone, this vehicle's
  /// number); Status::kErrorCapacity; Status::kErrorNumerical; Status::kErrorState (the vehicle has left the team);
  /// Status::kErrorMemory.
  ///
  /// Complexity: O(n^2 m) for n states and m rows of each vehicle.
  void observe(double time, Input<Observation> landmarks, Input<Observation> vehicles) {
    change(cairn_team_observe, time, detail::as_c(landmarks.data()), landmarks.size(), detail::as_c(vehicles.data()),
           vehicles.size());
  }

  //~ cairn_team_decisions
  /// Matches of the last scan of this vehicle that updated the filter: those of landmarks, then those of vehicles, by
  /// their ids, in the order in which they were processed.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(matches).
  std::vector<Match> decisions() const { return list<Match>(cairn_team_decisions); }

  //~ cairn_team_leave
  /// Leaves the team: makes a last packet, the farewell, after which the teammates do not wait for this vehicle any
  /// more. Own steps are then refused. Packets of teammates are still used.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorState (the vehicle has already left); Status::kErrorMemory.
  ///
  /// Complexity: O(1).
  void leave() { change(cairn_team_leave); }

  //~ cairn_team_take_packet
  /// Takes the next packet that is to be sent to all teammates: a step of this vehicle, a repetition that a teammate
  /// asked for, or a request for missing packets. `needed` gets its size in bytes, 0 if there is no packet. The packet
  /// leaves the queue when it was copied. Own steps wait until they are taken. A packet that was asked for waits once,
  /// however often it was asked for, and so does the request to each teammate: beside own steps the queue holds at most
  /// `history` repetitions and `max_vehicles` requests.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(size of the packet).
  std::vector<std::uint8_t> take_packet() {
    std::vector<std::uint8_t> packet;
    change([&](cairn_team* team, cairn_error* error) {
      std::size_t needed = 0;
      const cairn_status status = cairn_team_take_packet(team, nullptr, 0, &needed, error);
      if (status != CAIRN_OK || needed == 0) return status;
      packet.resize(needed);
      return cairn_team_take_packet(team, packet.data(), packet.size(), &needed, error);
    });
    return packet;
  }

  //~ cairn_team_ask
  /// Asks the teammates for all missing packets. The team does so itself when it finds a gap at a step of this vehicle;
  /// call this function at the end of a mission or after a long silence.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorMemory (mode TeamMode::kSubmaps).
  ///
  /// Complexity: O(missing packets).
  void ask() { change(cairn_team_ask); }

  //~ cairn_team_receive
  /// Receives a packet of a teammate. Packets may come late, repeatedly and in any order. `result` gets one of the
  /// CAIRN_PACKET_ constants. A refused packet is counted and changes nothing; the call succeeds all the same.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorMemory.
  ///
  /// Complexity: O(n^2 m) for n states and m rows of each packet that has its turn.
  Packet receive(Input<std::uint8_t> packet) {
    cairn_packet result = 0;
    change(cairn_team_receive, packet.data(), packet.size(), &result);
    return static_cast<Packet>(result);
  }

  //~ cairn_team_pose
  /// Pose of a vehicle of the team, and the covariance of its error [dp; dtheta] (6x6 row-major). The own pose is the
  /// present one: it includes the motions of own steps that still wait for teammates, but not their scans. The pose of
  /// a teammate is that of its last packet that is part of the estimate; only the modes TeamMode::kJoint and
  /// TeamMode::kSubmaps have it.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound (not in the team, or its pose is unknown).
  ///
  /// Complexity: O(own motions that wait for teammates).
  PoseEstimate pose(std::uint64_t vehicle) const {
    PoseEstimate result;
    query(cairn_team_pose, vehicle, detail::as_c(&result.pose), result.covariance.data());
    return result;
  }

  //~ cairn_team_pose_nees
  /// Normalised estimation error squared (NEES) of this vehicle's pose against the true pose, in the error coordinates
  /// of the filter. The pose is the one that Team::pose returns. A consistent filter has 3 on average.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical (the covariance of this pose is singular, as it is
  /// at a known start).
  ///
  /// Complexity: O(own motions that wait for teammates).
  double pose_nees(const Pose& truth) const { return get<double>(cairn_team_pose_nees, detail::as_c(&truth)); }

  //~ cairn_team_map
  /// The team's map. The team owns this map; it lives as long as the team and follows it.
  ///
  /// Complexity: O(1).
  MapView map() const { return {shared(), lend(cairn_team_map), detail::TeamKind::name}; }

  //~ cairn_team_score
  /// Compares the present pose of this vehicle with the true pose. With the option `baseline` it compares the pose of
  /// the second filter, too. Team::last_report returns the means.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(own motions that wait for teammates).
  void score(const Pose& truth) { change(cairn_team_score, detail::as_c(&truth)); }

  //~ cairn_team_last_report
  /// Reports on the team so far.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  TeamReport last_report() const { return get<TeamReport>(cairn_team_last_report); }
};

}  // namespace cairn

#endif
