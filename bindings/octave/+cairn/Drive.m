classdef Drive
  % Measurements that the motion samples of a step hold as `velocity` and `rate`.
  %
  % cairn.Drive.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % body velocity and body rate from the IMU; the default
    TWIST = 0;
    % forward velocity from the wheels (Mars paper, eq. 1), zero along y and z; body rate from the gyro
    WHEELS_GYRO = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'TWIST', 'WHEELS_GYRO'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
