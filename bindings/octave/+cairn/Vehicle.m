classdef Vehicle
  % Space in which the vehicle moves (docs/plane.md). The interface of a planar vehicle is the same as that of a spatial
  % one: the vehicle lies in z = 0 and turns about z. The filter reads only the rows and columns of x, y and yaw of
  % covariances and Jacobians that it gets. Covariances that it returns have zeros elsewhere.
  %
  % cairn.Vehicle.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % six degrees of freedom; the default
    SPATIAL = 0;
    % x, y and heading; landmarks x and y
    PLANAR = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'SPATIAL', 'PLANAR'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
