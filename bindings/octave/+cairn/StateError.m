classdef StateError
  % Error of the state that the filter's covariance describes (docs/invariant_error.md).
  %
  % cairn.StateError.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % right-invariant error on SE_{K+1}(3): consistent; the default
    INVARIANT = 0;
    % separate errors of position, attitude and landmarks: standard EKF-SLAM, for comparison
    STANDARD = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'INVARIANT', 'STANDARD'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
