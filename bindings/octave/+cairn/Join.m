classdef Join
  % How a closed submap joins the map (docs/submaps.md).
  %
  % cairn.Join.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % dense if max_landmarks is at most 100, sparse otherwise; the default
    AUTO = 0;
    % a filter with the covariance of the whole map: a closing costs O(n^2) for n states of the map
    DENSE = 1;
    % solves for all submaps together on a sparse factor and relinearises them: the total cost is nearly linear
    SPARSE = 2;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2];
      names = {'AUTO', 'DENSE', 'SPARSE'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
