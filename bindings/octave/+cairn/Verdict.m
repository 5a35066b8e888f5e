classdef Verdict
  % The verdict on a filter.
  %
  % cairn.Verdict.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % what is seen agrees with the estimate and with the stated noise
    GOOD = 0;
    % something does not agree; the reasons say what
    DOUBTFUL = 1;
    % most of what is seen contradicts the estimate
    LOST = 2;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2];
      names = {'GOOD', 'DOUBTFUL', 'LOST'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
