classdef Association
  % How the filter finds the landmark of an observation (docs/association.md).
  %
  % cairn.Association.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % by the id of the observation; the default
    KNOWN = 0;
    % nearest neighbour by Mahalanobis distance; each landmark is matched at most once in a frame. Ids of observations
    % are ignored, and landmarks are numbered from 0 in the order in which they are placed
    NEAREST = 1;
    % the largest set of pairs that are jointly compatible (branch and bound); ids as for cairn.Association.NEAREST
    JOINT = 2;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2];
      names = {'KNOWN', 'NEAREST', 'JOINT'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
