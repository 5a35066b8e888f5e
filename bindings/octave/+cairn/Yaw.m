classdef Yaw
  % Sign of the yaw rate that follows from two wheel rates.
  %
  % cairn.Yaw.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % z up: the vehicle turns left (positive yaw rate) when the right wheels turn faster; the default
    RIGHT_MINUS_LEFT = 0;
    % z down: eq. 1 as printed in the Mars paper
    LEFT_MINUS_RIGHT = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'RIGHT_MINUS_LEFT', 'LEFT_MINUS_RIGHT'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
