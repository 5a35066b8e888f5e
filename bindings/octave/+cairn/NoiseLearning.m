classdef NoiseLearning
  % What becomes of the noise that the filter learns from its innovations (docs/trust.md).
  %
  % cairn.NoiseLearning.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % cairn.Filter.health reports it; the default
    REPORTED = 0;
    % from when it is known, it scales the stated noise of each sensor and of the motion
    APPLIED = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'REPORTED', 'APPLIED'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
