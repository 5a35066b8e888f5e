classdef Loss
  % Loss of a residual at the distance d, in standard deviations (docs/update.md, "Robust losses").
  %
  % cairn.Loss.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % d^2 / 2: least squares; the default
    NONE = 0;
    % d^2 / 2 up to the width k, k d - k^2 / 2 beyond: the influence of an observation is bounded
    HUBER = 1;
    % c^2 / 2 log(1 + d^2 / c^2): the influence falls with the distance, and gross outliers have nearly none
    CAUCHY = 2;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2];
      names = {'NONE', 'HUBER', 'CAUCHY'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
