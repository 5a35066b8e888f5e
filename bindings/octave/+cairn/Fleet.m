classdef Fleet < cairn.internal.Handle
  % A square of sea with boats that drive in it.
  %
  % fleet = cairn.Fleet(Name, Value, ...)
  % Creates a fleet before its first step. Options of an older or a newer header are used as far as both sides know
  % them. Each boat is commanded once around a circle of radius R = course_length / (2 pi), anticlockwise, at the
  % constant speed course_length / duration and rate 2 pi / duration. It starts at the southernmost point of the circle,
  % heading east. The centres of the circles are `separation` apart. The centre of a single boat is the origin. The
  % centres of two boats are (-separation / 2, 0) and (separation / 2, 0). The centres of more boats form a square grid
  % about the origin, with as many columns as rows or one more. They are numbered from west to east and row by row from
  % the south; a last row that is not full is centred. A grid wider than half of `area` is shrunk to that. With
  % cairn.FleetLayout.COAST all circles must lie south of the coast line.
  %
  %   options: fields of cairn.fleet_options
  %
  % Errors: cairn:ARGUMENT, cairn:MEMORY.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  methods
    function self = Fleet(varargin)
      % fleet = cairn.Fleet(Name, Value, ...)
      % Creates a fleet before its first step. Options of an older or a newer header are used as far as both sides know
      % them. Each boat is commanded once around a circle of radius R = course_length / (2 pi), anticlockwise, at the
      % constant speed course_length / duration and rate 2 pi / duration. It starts at the southernmost point of the
      % circle, heading east. The centres of the circles are `separation` apart. The centre of a single boat is the
      % origin. The centres of two boats are (-separation / 2, 0) and (separation / 2, 0). The centres of more boats
      % form a square grid about the origin, with as many columns as rows or one more. They are numbered from west to
      % east and row by row from the south; a last row that is not full is centred. A grid wider than half of `area` is
      % shrunk to that. With cairn.FleetLayout.COAST all circles must lie south of the coast line.
      %
      %   options: fields of cairn.fleet_options
      %
      % Errors: cairn:ARGUMENT, cairn:MEMORY.
      cairn.internal.library();
      self.handle = cairn_mex('fleet_create', cairn.internal.options(varargin));
    end

    function step = next(self)
      % step = fleet.next()
      % Returns the next step. During a period each boat keeps its executed speed and rate, and its true pose is their
      % exact integral. Then each boat measures all features and all other boats within `radar_range` (true distance,
      % not 0). Each measurement has its own noise: two boats that see each other have independent errors. Nothing is
      % stored, so memory does not grow with the drive.
      %
      %   step: struct: number, time, dt, vehicle_count
      %
      % Errors: cairn:ARGUMENT, cairn:STATE (there are no more steps), cairn:MEMORY (the next call returns the same
      % step).
      step = cairn_mex('fleet_next', self.handle);
    end

    function vehicles = vehicles(self)
      % vehicles = fleet.vehicles()
      % The boats at the end of the last step, boat 1 first; none before the first step.
      %
      %   vehicles: struct with a column for each element: speed, rate, x, y, heading, feature_count, vehicle_count
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      vehicles = cairn_mex('fleet_vehicles', self.handle);
    end

    function features = seen_features(self, vehicle)
      % features = fleet.seen_features(vehicle)
      % The features that boat `vehicle` (counted from 1) measured in the last step, by ascending id; none before the
      % first step.
      %
      %   vehicle: uint64
      %   features: struct with a column for each element: id, range, bearing
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND (boat), cairn:BUFFER.
      features = cairn_mex('fleet_seen_features', self.handle, vehicle);
    end

    function vehicles = seen_vehicles(self, vehicle)
      % vehicles = fleet.seen_vehicles(vehicle)
      % The other boats that boat `vehicle` (counted from 1) measured in the last step, by ascending id; none before the
      % first step.
      %
      %   vehicle: uint64
      %   vehicles: struct with a column for each element: id, range, bearing
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND (boat), cairn:BUFFER.
      vehicles = cairn_mex('fleet_seen_vehicles', self.handle, vehicle);
    end

    function rewind(self)
      % fleet.rewind()
      % Goes back to before the first step. The same steps follow, bit for bit.
      %
      % Errors: cairn:ARGUMENT.
      cairn_mex('fleet_rewind', self.handle);
    end

    function steps = steps(self)
      % steps = fleet.steps()
      % Number of steps: 1 plus the number of whole periods in the duration.
      %
      %   steps: integer
      %
      % Errors: cairn:ARGUMENT.
      steps = cairn_mex('fleet_steps', self.handle);
    end

    function positions = features(self)
      % positions = fleet.features()
      % True positions of all features, x y each, m; the feature with id 1 is the first.
      %
      %   positions: 2 x n, m
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      positions = cairn_mex('fleet_features', self.handle);
    end

    function points = coast(self)
      % points = fleet.coast()
      % The coast line from west to east: a polyline, x y each, m. The land is north of it.
      %
      %   points: 2 x n, m
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      points = cairn_mex('fleet_coast', self.handle);
    end
  end
end
