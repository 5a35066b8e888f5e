classdef MapForm
  % How a map holds the joint uncertainty of its landmarks. Only maps of the same kind can be merged.
  %
  % cairn.MapForm.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % positions and their joint covariance: a single map, or densely joined submaps
    DENSE = 0;
    % submaps and the factor of their information: sparsely joined submaps
    SPARSE = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'DENSE', 'SPARSE'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
