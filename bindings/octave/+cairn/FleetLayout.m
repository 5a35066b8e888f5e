classdef FleetLayout
  % Where the features are. Both layouts have the coast line, but the radars see only features.
  %
  % cairn.FleetLayout.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % uniform in the square, on both sides of the coast line; the default
    UNIFORM = 0;
    % along the coast line, in a strip of width `coast_strip` south of it. The coast line runs north of the boats, from
    % the western side of the square to the eastern side
    COAST = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'UNIFORM', 'COAST'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
