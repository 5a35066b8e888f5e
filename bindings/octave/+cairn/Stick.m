classdef Stick
  % How the noise of the stick angle enters.
  %
  % cairn.Stick.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % independent in each observation's elevation; the default
    OBSERVATION = 0;
    % all observations of a frame share one encoder error; the image adds noise of `image_sigma` to each elevation
    FRAME = 1;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [0, 1];
      names = {'OBSERVATION', 'FRAME'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
