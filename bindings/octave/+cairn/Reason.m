classdef Reason
  % Why an observation was refused.
  %
  % cairn.Reason.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % it was not refused
    NONE = 0;
    % its distance exceeds the threshold of the gate of one observation (chi-square)
    GATE = 1;
    % it passed its own gate, but was removed so that the whole batch passes the batch gate
    BATCH_GATE = 2;
    % the estimated landmark cannot give an observation: behind the lens, too near, too steep
    NO_IMAGE = 3;
    % the observation cannot place a landmark: disparity or range too small, range too large beside its noise, or the
    % sensor never places landmarks
    NO_PLACE = 4;
    % unknown ids: it passed its own gate, but the best set of pairs does not contain it
    AMBIGUOUS = 5;
    % the observation could place a landmark, but the map is full
    NO_ROOM = 6;
    % the observation could place a landmark, but most of what is seen contradicts the pose: nothing is placed until it
    % is decided what is wrong.
    CONTRADICTED = 7;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2, 3, 4, 5, 6, 7];
      names = {'NONE', 'GATE', 'BATCH_GATE', 'NO_IMAGE', 'NO_PLACE', 'AMBIGUOUS', 'NO_ROOM', 'CONTRADICTED'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
