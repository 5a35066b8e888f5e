classdef Encoder
  % How the noise of the two encoders of a head enters (cairn.stereo_head).
  %
  % cairn.Encoder.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % the head moves between observations: each has independent noise; the default
    OBSERVATION = 0;
    % the head stands still: all observations of a frame have the same encoder error
    FRAME = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'OBSERVATION', 'FRAME'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
