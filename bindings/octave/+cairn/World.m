classdef World < cairn.internal.Handle
  % A world with one rover that drives through it.
  %
  % world = cairn.World(Name, Value, ...)
  % Creates a world before its first step. Options of an older or a newer header are used as far as both sides know
  % them.
  %
  %   options: fields of cairn.world_options
  %
  % Errors: cairn:ARGUMENT, cairn:MEMORY, cairn:NUMERICAL (the ground is too rough for four wheels).
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  methods
    function self = World(varargin)
      % world = cairn.World(Name, Value, ...)
      % Creates a world before its first step. Options of an older or a newer header are used as far as both sides know
      % them.
      %
      %   options: fields of cairn.world_options
      %
      % Errors: cairn:ARGUMENT, cairn:MEMORY, cairn:NUMERICAL (the ground is too rough for four wheels).
      cairn.internal.library();
      self.handle = cairn_mex('world_create', cairn.internal.options(varargin));
    end

    function step = next(self)
      % step = world.next()
      % Returns the next step. Nothing is stored, so memory does not grow with the drive.
      %
      %   step: struct: number, time, truth, velocity_sigma, rate_sigma, pan, stick, motion_count, observation_count
      %
      % Errors: cairn:ARGUMENT, cairn:STATE (there are no more steps), cairn:NUMERICAL (the ground is too rough for four
      % wheels).
      step = cairn_mex('world_next', self.handle);
    end

    function motions = motions(self)
      % motions = world.motions()
      % The motion samples of the last step, in order; none before the first step.
      %
      %   motions: struct with a column for each element: dt, velocity, rate, wheels, true_velocity, true_rate,
      %     true_wheels
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      motions = cairn_mex('world_motions', self.handle);
    end

    function observations = observations(self)
      % observations = world.observations()
      % The observations of the last step's frame, by ascending id, z as cairn.stereo_head defines it, covariance zero;
      % none before the first step.
      %
      %   observations: struct with a column for each element: id, z, covariance
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      observations = cairn_mex('world_observations', self.handle);
    end

    function rewind(self)
      % world.rewind()
      % Goes back to before the first step. The same drive follows, bit for bit.
      %
      % Errors: cairn:ARGUMENT.
      cairn_mex('world_rewind', self.handle);
    end

    function steps = steps(self)
      % steps = world.steps()
      % Number of steps, including the start.
      %
      %   steps: integer
      %
      % Errors: cairn:ARGUMENT.
      steps = cairn_mex('world_steps', self.handle);
    end

    function count = most_observations(self)
      % count = world.most_observations()
      % Upper bound of the number of observations in a frame, for cairn.filter_options.
      %
      %   count: integer
      %
      % Errors: cairn:ARGUMENT.
      count = cairn_mex('world_most_observations', self.handle);
    end

    function head = head(self)
      % head = world.head()
      % The stereo head of the world, to be added to a filter: mount, noise, encoder mode.
      %
      %   head: struct: encoder_mode, platform, stick, camera_quaternion, range_sigma, azimuth_sigma, elevation_sigma,
      %     pan_sigma, stick_sigma, near_range, max_elevation
      %
      % Errors: cairn:ARGUMENT.
      head = cairn_mex('world_head', self.handle);
    end

    function wheels = wheels(self)
      % wheels = world.wheels()
      % The wheels of the rover, for cairn.Filter.set_wheels, with the noise of the wheel rates of one motion sample.
      % The noise of rates that wheels do not measure is that of cairn.wheels.
      %
      %   wheels: struct: yaw_sign, radius, track, rate_sigma, slip_sigma, lateral_sigma, vertical_sigma,
      %     roll_rate_sigma, pitch_rate_sigma
      %
      % Errors: cairn:ARGUMENT.
      wheels = cairn_mex('world_wheels', self.handle);
    end

    function pose = pose(self, time)
      % pose = world.pose(time)
      % True pose of the body in the map at `time` (s, 0 to the end of the drive). The origin of the body lies on the
      % ground in the middle between the wheels.
      %
      %   time: number, s
      %   pose: struct: position, quaternion
      %
      % Errors: cairn:ARGUMENT.
      pose = cairn_mex('world_pose', self.handle, time);
    end

    function points = contacts(self, time)
      % points = world.contacts(time)
      % Points at which the wheels touch the ground at `time`: front left, front right, rear left, rear right, x y z
      % each, in the map, m.
      %
      %   time: number, s
      %   points: 12 numbers, m
      %
      % Errors: cairn:ARGUMENT, cairn:STATE (cairn.Contact.POINT).
      points = cairn_mex('world_contacts', self.handle, time);
    end

    function height = height(self, x, y)
      % height = world.height(x, y)
      % Height of the ground at x, y (m), m.
      %
      %   x: number, m
      %   y: number, m
      %   height: number, m
      %
      % Errors: cairn:ARGUMENT.
      height = cairn_mex('world_height', self.handle, x, y);
    end

    function [lower, upper] = extent(self)
      % [lower, upper] = world.extent()
      % The rectangle in the xy plane that contains the course and all landmarks, m.
      %
      %   lower: 2 numbers, m
      %   upper: 2 numbers, m
      %
      % Errors: cairn:ARGUMENT.
      [lower, upper] = cairn_mex('world_extent', self.handle);
    end

    function position = landmark(self, id)
      % position = world.landmark(id)
      % True position (m) of the landmark `id`, 0 to the number of landmarks minus 1.
      %
      %   id: uint64
      %   position: 3 numbers, m
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND.
      position = cairn_mex('world_landmark', self.handle, id);
    end

    function positions = landmarks(self)
      % positions = world.landmarks()
      % True positions of all landmarks, x y z each, m, by ascending id.
      %
      %   positions: 3 x n, m
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      positions = cairn_mex('world_landmarks', self.handle);
    end
  end
end
