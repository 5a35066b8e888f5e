classdef ClosedBy
  % Why a submap was closed.
  %
  % cairn.ClosedBy.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % no submap was closed yet
    NONE = 0;
    % cairn.Filter.close_submap
    CALLER = 1;
    % submap_landmarks
    LANDMARKS = 2;
    % submap_distance
    DISTANCE = 3;
    % submap_extent
    EXTENT = 4;
    % submap_sigma
    SIGMA = 5;
    % an absolute position, attitude or heading could not be taken in otherwise
    FIX = 6;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2, 3, 4, 5, 6];
      names = {'NONE', 'CALLER', 'LANDMARKS', 'DISTANCE', 'EXTENT', 'SIGMA', 'FIX'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
