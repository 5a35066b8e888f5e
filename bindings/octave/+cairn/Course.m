classdef Course
  % Courses. On each the rover has a constant speed over the xy plane of the map.
  %
  % cairn.Course.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % the course of the paper: a circle, driven anticlockwise; the default
    CIRCLE = 0;
    % a wandering closed curve, driven several times
    LAPS = 1;
    % a long drive: a chain of circles, alternately left and right. Each circle is driven 1.25 times before the next one
    % is entered where both touch. So each circle closes a loop, and a quarter of it is seen again
    TRAVERSE = 2;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2];
      names = {'CIRCLE', 'LAPS', 'TRAVERSE'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
