classdef Result
  % Result of an observation.
  %
  % cairn.Result.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % it updated the landmark
    MATCHED = 1;
    % it placed a new landmark, or placed a landmark again that had been placed wrongly; then `distance` and `threshold`
    % are those of its test against the former place
    NEW = 2;
    % it was refused and changed nothing; `reason` says why
    REJECTED = 3;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [1, 2, 3];
      names = {'MATCHED', 'NEW', 'REJECTED'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
