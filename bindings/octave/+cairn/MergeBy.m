classdef MergeBy
  % How cairn.Map.merge finds the landmarks that both maps hold, the common landmarks.
  %
  % cairn.MergeBy.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % landmarks with the same id
    ID = 0;
    % landmarks that lie in the same way relative to each other; ids are ignored
    GEOMETRY = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'ID', 'GEOMETRY'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
