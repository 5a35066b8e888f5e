classdef Accelerometer
  % Noise of the accelerometer. Table 1 of the paper gives it in m/s.
  %
  % cairn.Accelerometer.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % white noise of the body velocity, m/s a sample; the default
    VELOCITY = 0;
    % white noise of the acceleration, m/s^2 a sample: the velocity comes from dead reckoning of specific force and rate
    % from a known start, and drifts
    ACCELERATION = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'VELOCITY', 'ACCELERATION'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
