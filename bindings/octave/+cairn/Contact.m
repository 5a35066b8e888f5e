classdef Contact
  % How the rover stands on the ground. Seen from above, its x axis points along the course.
  %
  % cairn.Contact.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % on four wheels; a differential averages the left and the right rocker. All four wheels touch the ground, and
    % height and attitude are those of the chassis between them; the default
    WHEELS = 0;
    % at one point; its z axis is the normal of the ground
    POINT = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'WHEELS', 'POINT'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
