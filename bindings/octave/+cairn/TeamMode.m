classdef TeamMode
  % Mode: how a vehicle uses the packets of its teammates.
  %
  % cairn.TeamMode.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % it ignores them; for comparison
    MONO = 0;
    % extended observations with independent noise, as printed in the cooperative paper: overconfident, and more so with
    % more landmarks
    EO_DIAGONAL = 1;
    % extended observations with the noise that all observations of a scan share through the sighting
    EO_FULL = 2;
    % every vehicle runs the same filter over all poses and all landmarks; the default
    JOINT = 3;
    % every vehicle works in its own submaps, which are fused by their common landmarks; sightings between vehicles are
    % not used
    SUBMAPS = 4;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1, 2, 3, 4];
      names = {'MONO', 'EO_DIAGONAL', 'EO_FULL', 'JOINT', 'SUBMAPS'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
