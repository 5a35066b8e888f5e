classdef Systematic
  % Kinds of systematic errors.
  %
  % cairn.Systematic.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % of the measured body velocity, m/s; components x, y, z
    VELOCITY_BIAS = 0;
    % of the measured body rate, rad/s; components x, y, z
    RATE_BIAS = 1;
    % of a wheel's measured rate; components left and right
    WHEEL_SCALE = 2;
    % of a sensor against the body, m; components x, y, z
    MOUNT_SHIFT = 3;
    % of a sensor about the origin of the body: a rotation vector, rad
    MOUNT_TURN = 4;
    % of the values of a sensor's observations, in their units
    OFFSET = 5;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2, 3, 4, 5];
      names = {'VELOCITY_BIAS', 'RATE_BIAS', 'WHEEL_SCALE', 'MOUNT_SHIFT', 'MOUNT_TURN', 'OFFSET'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
