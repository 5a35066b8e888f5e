classdef Distance
  % Distance by which cairn.Association.NEAREST chooses among landmarks.
  %
  % cairn.Distance.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % the squared Mahalanobis distance d^2; the default
    MAHALANOBIS = 0;
    % d^2 + log det S, which is -2 log of the likelihood: if two landmarks have the same d^2, the better known one is
    % chosen. The gates still use d^2
    LIKELIHOOD = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'MAHALANOBIS', 'LIKELIHOOD'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
