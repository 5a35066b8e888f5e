classdef Status
  % Status of every fallible call: 0 is success, a negative value an error. A value never changes its meaning. A refused
  % observation is not an error: its match reports the refusal.
  %
  % cairn.Status.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % success
    OK = 0;
    % an argument is [], not finite, out of range or not a covariance
    ERROR_ARGUMENT = -1;
    ERROR_BUFFER = -2;
    % a capacity set at creation is exhausted (landmarks, observations, sensors)
    ERROR_CAPACITY = -3;
    % no landmark, sensor or vehicle has this id
    ERROR_NOT_FOUND = -4;
    % a covariance would lose positive definiteness, or a result is not finite
    ERROR_NUMERICAL = -5;
    % there is not enough memory
    ERROR_MEMORY = -6;
    % the handle is in a state that does not allow this call
    ERROR_STATE = -7;
    % a defect of the library; please report it
    ERROR_INTERNAL = -8;
    % a callback of the caller returned a negative value and so aborted the call
    ERROR_CALLBACK = -9;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, -1, -2, -3, -4, -5, -6, -7, -8, -9];
      names = {'OK', 'ERROR_ARGUMENT', 'ERROR_BUFFER', 'ERROR_CAPACITY', 'ERROR_NOT_FOUND', 'ERROR_NUMERICAL', ...
      'ERROR_MEMORY', 'ERROR_STATE', 'ERROR_INTERNAL', 'ERROR_CALLBACK'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
