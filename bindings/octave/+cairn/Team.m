classdef Team < cairn.internal.Handle
  % One vehicle's view of its team. Each vehicle has its own handle, on its own computer. The vehicles exchange packets
  % by any transport. Unlike a filter, a team allocates memory in its calls. A call that fails leaves the team as it
  % was, also if memory runs out; the call can be repeated. Exceptions: cairn.Team.observe tells what it keeps of a step
  % that the filter refuses and of a time that is refused. In mode cairn.TeamMode.SUBMAPS a closing that runs out of
  % memory does not fail the call: the packets that have their turn after it wait, and the next call first makes up for
  % it (`interrupted` of team_report). If there is still no memory, this next call fails.
  %
  % team = cairn.Team(options, filter, radar)
  % Creates a vehicle's view of its team. `filter` holds the options of the filter that the team runs: `vehicle` must be
  % cairn.Vehicle.PLANAR, `initial_pose` is the start of this vehicle in the frame of the team, and `submap_landmarks`
  % must be greater than 0 in mode cairn.TeamMode.SUBMAPS and 0 in all other modes. `radar` is the sensor of all
  % vehicles. With extended observations it must be mounted at the body's origin.
  %
  %   options: fields of cairn.team_options
  %   filter: fields of cairn.filter_options
  %   radar: fields of cairn.range_bearing
  %
  % Errors: cairn:ARGUMENT, cairn:MEMORY.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  methods
    function self = Team(options, filter, radar)
      % team = cairn.Team(options, filter, radar)
      % Creates a vehicle's view of its team. `filter` holds the options of the filter that the team runs: `vehicle`
      % must be cairn.Vehicle.PLANAR, `initial_pose` is the start of this vehicle in the frame of the team, and
      % `submap_landmarks` must be greater than 0 in mode cairn.TeamMode.SUBMAPS and 0 in all other modes. `radar` is
      % the sensor of all vehicles. With extended observations it must be mounted at the body's origin.
      %
      %   options: fields of cairn.team_options
      %   filter: fields of cairn.filter_options
      %   radar: fields of cairn.range_bearing
      %
      % Errors: cairn:ARGUMENT, cairn:MEMORY.
      cairn.internal.library();
      self.handle = cairn_mex('team_create', options, filter, radar);
    end

    function add(self, vehicle, start, covariance)
      % team.add(vehicle, start, covariance)
      % Adds a teammate. `start` is its pose before its first packet, and `covariance` (6x6; []: known exactly) the
      % covariance of the error of `start`. Both must be the values that the teammate itself starts with. `start` []:
      % the start is unknown. It is solved from the first mutual sighting, at one time, between the teammate and a
      % vehicle whose pose is known. Modes with extended observations need no start.
      %
      %   vehicle: uint64
      %   start: struct: position, quaternion; [] or missing: none
      %   covariance: 6 x 6, pose^2; [] or missing: none
      %
      % Errors: cairn:ARGUMENT (also a teammate that exists, and in mode cairn.TeamMode.SUBMAPS one that was removed,
      % for its submaps are in the map), cairn:CAPACITY, cairn:STATE (mode cairn.TeamMode.SUBMAPS and no start),
      % cairn:MEMORY.
      if nargin < 3, start = []; end
      if nargin < 4, covariance = []; end
      cairn_mex('team_add', self.handle, vehicle, start, covariance);
    end

    function remove(self, vehicle)
      % team.remove(vehicle)
      % Removes a teammate: the team neither waits for it nor uses its packets any more. The information from its
      % earlier packets stays.
      %
      %   vehicle: uint64
      %
      % Errors: cairn:ARGUMENT (this vehicle), cairn:NOT_FOUND, cairn:MEMORY.
      cairn_mex('team_remove', self.handle, vehicle);
    end

    function vehicles = members(self)
      % vehicles = team.members()
      % Numbers of the vehicles of the team, this vehicle's number first.
      %
      %   vehicles: uint64
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      vehicles = cairn_mex('team_members', self.handle);
    end

    function predict_increment(self, T_before_after, covariance)
      % team.predict_increment(T_before_after, covariance)
      % Moves this vehicle by a relative pose, like cairn.Filter.predict_increment. The teammates learn of this motion
      % by the packet of the next cairn.Team.observe.
      %
      %   T_before_after: struct: position, quaternion
      %   covariance: 6 x 6, pose^2
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL (more than 1e9 m, or noise of more than 1e9 m or a whole turn),
      % cairn:CAPACITY (65535 motions without an observation), cairn:MEMORY.
      cairn_mex('team_predict_increment', self.handle, T_before_after, covariance);
    end

    function predict_twist(self, dt, velocity, rate, varargin)
      % team.predict_twist(dt, velocity, rate, Name, Value, ...)
      % Moves this vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0). `noise` []: that of
      % cairn.twist_noise.
      %
      %   dt: number, s
      %   velocity: 3 numbers, m/s
      %   rate: 3 numbers, rad/s
      %   noise: fields of cairn.twist_noise; [] or missing: none
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL, cairn:CAPACITY, cairn:MEMORY.
      cairn_mex('team_predict_twist', self.handle, dt, velocity, rate, cairn.internal.options(varargin));
    end

    function observe(self, time, landmarks, vehicles)
      % team.observe(time, landmarks, vehicles)
      % Ends a step of this vehicle at `time` with its scan. `time` is in s, by a clock that all vehicles share, and
      % must be later than the last one. The scan is ranges and bearings of `landmarks`, by their ids, and of
      % `vehicles`, by their numbers; both may be empty. Motion and scan become a packet for cairn.Team.take_packet. The
      % filter is updated by the step when the packets of all teammates up to this time have arrived; the order is the
      % same at every vehicle. If the update by this vehicle's scan fails, the call fails, but the packet is sent all
      % the same. A time that is more than `max_jump` after the last one is refused, and the motions are kept for the
      % next call. If the next call has a later time, by at most `max_jump`, both were right, and it succeeds.
      %
      %   time: number, s
      %   landmarks: struct with a column for each element: id, z, covariance
      %   vehicles: struct with a column for each element: id, z, covariance
      %
      % Errors: cairn:ARGUMENT (also a time in the past, an id or a number twice, cairn.Constants.ID_NONE, this
      % vehicle's number), cairn:CAPACITY, cairn:NUMERICAL, cairn:STATE (the vehicle has left the team), cairn:MEMORY.
      cairn_mex('team_observe', self.handle, time, landmarks, vehicles);
    end

    function matches = decisions(self)
      % matches = team.decisions()
      % Matches of the last scan of this vehicle that updated the filter: those of landmarks, then those of vehicles, by
      % their ids, in the order in which they were processed.
      %
      %   matches: struct with a column for each element: landmark, result, reason, distance, threshold
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      matches = cairn_mex('team_decisions', self.handle);
    end

    function leave(self)
      % team.leave()
      % Leaves the team: makes a last packet, the farewell, after which the teammates do not wait for this vehicle any
      % more. Own steps are then refused. Packets of teammates are still used.
      %
      % Errors: cairn:ARGUMENT, cairn:STATE (the vehicle has already left), cairn:MEMORY.
      cairn_mex('team_leave', self.handle);
    end

    function packet = take_packet(self)
      % packet = team.take_packet()
      % Takes the next packet that is to be sent to all teammates: a step of this vehicle, a repetition that a teammate
      % asked for, or a request for missing packets. The packet leaves the queue when it was copied. Own steps wait
      % until they are taken. A packet that was asked for waits once, however often it was asked for, and so does the
      % request to each teammate: beside own steps the queue holds at most `history` repetitions and `max_vehicles`
      % requests.
      %
      %   packet: uint8
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      packet = cairn_mex('team_take_packet', self.handle);
    end

    function ask(self)
      % team.ask()
      % Asks the teammates for all missing packets. The team does so itself when it finds a gap at a step of this
      % vehicle; call this function at the end of a mission or after a long silence.
      %
      % Errors: cairn:ARGUMENT, cairn:MEMORY (mode cairn.TeamMode.SUBMAPS).
      cairn_mex('team_ask', self.handle);
    end

    function result = receive(self, packet)
      % result = team.receive(packet)
      % Receives a packet of a teammate. Packets may come late, repeatedly and in any order. `result` (or []) gets one
      % of the CAIRN_PACKET_ constants. A refused packet is counted and changes nothing; the call succeeds all the same.
      %
      %   packet: vector
      %   result: cairn.Packet
      %
      % Errors: cairn:ARGUMENT, cairn:MEMORY.
      result = cairn_mex('team_receive', self.handle, packet);
    end

    function [pose, covariance] = pose(self, vehicle)
      % [pose, covariance] = team.pose(vehicle)
      % Pose of a vehicle of the team, and the covariance of its error [dp; dtheta] (6x6 row-major). The own pose is the
      % present one: it includes the motions of own steps that still wait for teammates, but not their scans. The pose
      % of a teammate is that of its last packet that is part of the estimate; only the modes cairn.TeamMode.JOINT and
      % cairn.TeamMode.SUBMAPS have it.
      %
      %   vehicle: uint64
      %   pose: struct: position, quaternion
      %   covariance: 6 x 6, pose^2
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND (not in the team, or its pose is unknown).
      [pose, covariance] = cairn_mex('team_pose', self.handle, vehicle);
    end

    function nees = pose_nees(self, truth)
      % nees = team.pose_nees(truth)
      % Normalised estimation error squared (NEES) of this vehicle's pose against the true pose, in the error
      % coordinates of the filter. The pose is the one that cairn.Team.pose returns. A consistent filter has 3 on
      % average.
      %
      %   truth: struct: position, quaternion
      %   nees: number
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL (the covariance of this pose is singular, as it is at a known start).
      nees = cairn_mex('team_pose_nees', self.handle, truth);
    end

    function result = map(self)
      % result = team.map()
      % The team's map. Fails only for [], and then returns [].
      result = cairn.Map(self, cairn_mex('team_map', self.handle));
    end

    function score(self, truth)
      % team.score(truth)
      % Compares the present pose of this vehicle with the true pose. With the option `baseline` it compares the pose of
      % the second filter, too. cairn.Team.last_report returns the means.
      %
      %   truth: struct: position, quaternion
      %
      % Errors: cairn:ARGUMENT.
      cairn_mex('team_score', self.handle, truth);
    end

    function report = last_report(self)
      % report = team.last_report()
      % Reports on the team so far.
      %
      %   report: struct: unsettled, interrupted, sent, resent, requested, received, taken, reordered, repeated, own,
      %     ignored, unknown, past, ahead, conflict, full, foreign, version, cut, corrupt, nonsense, lost, matched,
      %     placed, rejected, sightings_used, sightings_refused, vehicles_found, failed, scored, scored_nees,
      %     position_rmse, anees_per_dof, claimed_improvement, true_improvement
      %
      % Errors: cairn:ARGUMENT.
      report = cairn_mex('team_last_report', self.handle);
    end
  end
end
