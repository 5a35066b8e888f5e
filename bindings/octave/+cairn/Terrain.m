classdef Terrain
  % Ground.
  %
  % cairn.Terrain.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % seeded smooth hills, shifted to `start_height` at (100, 20); the default
    ROLLING = 0;
    % z = sin(x / 15) + 0.8 cos(y / 12); the same for every seed; not shifted
    WAVES = 1;
    % z = 0
    FLAT = 2;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2];
      names = {'ROLLING', 'WAVES', 'FLAT'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
