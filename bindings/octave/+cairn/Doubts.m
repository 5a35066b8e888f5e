classdef Doubts
  % The reasons of a verdict, one bit each.
  %
  % cairn.Doubts.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % the normalised innovations of the window lie above their band
    NIS = 1;
    % the gates refuse more than they refuse of honest observations
    REFUSALS = 2;
    % the motion was widened, because most of what was seen contradicted it
    WIDENED = 4;
    % a sensor's noise is more than 1.5 times what is stated
    SENSOR_NOISE = 8;
    % the motion's noise is clearly more than what is stated
    MOTION_NOISE = 16;
    % the corrections of the pose have a mean: the motion has a constant error
    BIAS = 32;
    % a frame contradicts the motion since the last frame: a slip, or another place
    JUMP = 64;
    % single landmarks contradict the rest: moved, or under a wrong id
    LANDMARKS = 128;
    % a closed submap contradicted the map
    CLOSING = 256;
    % directions of the pose about which the last frames say nothing
    BLIND = 512;
    % the covariance of the pose is not positive semidefinite
    DEFINITE = 1024;
  end

  methods (Static)
    function text = name(value)
      % Name of a value, or of a sum of values.
      values = [1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024];
      names = {'NIS', 'REFUSALS', 'WIDENED', 'SENSOR_NOISE', 'MOTION_NOISE', 'BIAS', 'JUMP', 'LANDMARKS', ...
      'CLOSING', 'BLIND', 'DEFINITE'};
      text = cairn.internal.constant_name(value, values, names, true);
    end
  end
end
