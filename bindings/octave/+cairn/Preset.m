classdef Preset
  % Worlds for measurements. In the rows, velocity and rate noise are those of a sample of 0.2 s. The rows use
  % cairn.Terrain.WAVES, cairn.Contact.POINT and a radius of 101.98 m.
  %
  % cairn.Preset.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % the defaults: Table 1 as printed
    PAPER = 0;
    % 0.002 m/s, 0.02 degrees/s, 1 lap in 400 s
    ROW1 = 1;
    % 0.05 m/s, 0.2 degrees/s, 1 lap in 400 s
    ROW2 = 2;
    % 0.05 m/s, 0.2 degrees/s, 2 laps in 400 s
    ROW3 = 3;
    % 0.2 m/s, 1 degree/s, 2 laps in 400 s
    ROW4 = 4;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2, 3, 4];
      names = {'PAPER', 'ROW1', 'ROW2', 'ROW3', 'ROW4'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
